//! The handle of a simulated room, with the actions of a scenario's director.

use std::fmt;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tokio::time::Instant;

use super::behaviour::Behaviour;
use super::event::{Moment, RoomEvent};
use super::script::{By, ClinicianScript, PatientScript, Reply, ReplyRule};
use super::state::{Asked, State};
use crate::{Device, Devices};

type Observer = Box<dyn FnMut(&Moment) + Send>;

/// A simulated room. Clones are the same room.
#[derive(Clone)]
pub struct SimRoom {
    inner: Arc<Inner>,
}

struct Inner {
    state: Mutex<State>,
    /// The observers, and the number of moments that they have received.
    observers: Mutex<(Vec<Observer>, usize)>,
}

impl fmt::Debug for SimRoom {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SimRoom").finish_non_exhaustive()
    }
}

impl SimRoom {
    /// A room whose time starts now, on tokio's clock.
    pub fn new(patient: PatientScript, clinician: ClinicianScript) -> Self {
        Self::since(Instant::now(), patient, clinician)
    }

    /// A room whose time started at an instant, on tokio's clock.
    pub fn since(started: Instant, patient: PatientScript, clinician: ClinicianScript) -> Self {
        let state = Mutex::new(State::new(patient, clinician, started));
        Self { inner: Arc::new(Inner { state, observers: Mutex::new((Vec::new(), 0)) }) }
    }

    /// Puts people and devices where these moments of an earlier simulation left them: who is in view, and how each
    /// device behaves. What the robot did there ended with it.
    pub fn go_on_after(&self, moments: &[Moment]) {
        self.change(|state, _| moments.iter().for_each(|moment| state.take_over(moment)));
    }

    /// The devices in it.
    pub fn devices(&self) -> Devices {
        let room = || Arc::new(self.clone());
        Devices {
            speech_out: room(),
            speech_in: room(),
            screen: room(),
            buttons: room(),
            skeleton: room(),
            clinic: room(),
            health: room(),
        }
    }

    /// Calls `observer` for each moment from now on, in order. It must not touch the room.
    pub fn observe(&self, observer: impl FnMut(&Moment) + Send + 'static) {
        lock(&self.inner.observers).0.push(Box::new(observer));
    }

    /// Every moment so far.
    pub fn moments(&self) -> Vec<Moment> {
        lock(&self.inner.state).moments.clone()
    }

    /// Whether the patient is in view.
    pub fn person_in_view(&self) -> bool {
        lock(&self.inner.state).view.inside
    }

    /// The patient goes out of view.
    pub fn lose_person(&self) {
        self.change(|state, now| state.set_view("", false, now, RoomEvent::PersonLeaves));
    }

    /// The patient leaves the room. The devices see no difference to [`SimRoom::lose_person`].
    pub fn leave_room(&self) {
        self.change(|state, now| state.set_view("", false, now, RoomEvent::PersonLeavesRoom));
    }

    /// The patient comes back into view.
    pub fn return_person(&self) {
        self.change(|state, now| state.set_view("", true, now, RoomEvent::PersonReturns));
    }

    /// Another person, by the name of their node, comes into view.
    pub fn visitor_comes(&self, name: &str) {
        let event = RoomEvent::VisitorComes { name: name.to_owned() };
        self.change(|state, now| state.set_view(name, true, now, event));
    }

    /// Another person goes out of view.
    pub fn visitor_goes(&self, name: &str) {
        let event = RoomEvent::VisitorGoes { name: name.to_owned() };
        self.change(|state, now| state.set_view(name, false, now, event));
    }

    /// The patient asks for something, by voice or touch, whatever works; see [`SimRoom::ask_by`].
    pub fn ask(&self, request: &str) {
        self.ask_by(request, "", None);
    }

    /// A person, the patient if the name is empty, asks for something, again and again, until a device that waits for it
    /// takes it. A voice is heard wherever they are; a touch needs them in view.
    pub fn ask_by(&self, request: &str, person: &str, by: Option<By>) {
        let asked = Asked { request: request.to_owned(), person: person.to_owned(), by };
        self.change(|state, _| {
            state.requests.push_back(asked);
            state.changed = true;
        });
    }

    /// The clinician presses a command.
    pub fn command(&self, name: &str) {
        self.change(|state, now| {
            state.pressed = Some(name.to_owned());
            state.happens(now, RoomEvent::ClinicianCommands { command: name.to_owned() });
        });
    }

    /// The clinician comes at once, to the open call or to the next one.
    pub(super) fn clinician_comes(&self) {
        self.change(|state, _| {
            state.clinician_comes_now = true;
            state.changed = true;
        });
    }

    /// From now on the person gives this reply to every question about the topic.
    pub(super) fn will_reply(&self, topic: &str, reply: Reply) {
        let rule = ReplyRule { topic: topic.to_owned(), question: None, reply };
        self.change(|state, _| state.patient.replies.insert(0, rule));
    }

    /// From now on the person gives this reply to every question.
    pub fn will_answer(&self, reply: Reply) {
        self.change(|state, _| {
            state.patient.replies.clear();
            state.patient.otherwise = reply;
        });
    }

    /// From now on the device fails. Its present operations fail at once.
    pub fn fail(&self, device: Device) {
        self.behave(device, Behaviour::Fails);
    }

    /// From now on the device reports success and does nothing. A sensor senses nothing.
    pub fn lie(&self, device: Device) {
        self.behave(device, Behaviour::Lies);
    }

    /// The device works again.
    pub fn recover(&self, device: Device) {
        self.behave(device, Behaviour::Works);
    }

    /// From now on the device behaves so.
    pub fn behave(&self, device: Device, behaviour: Behaviour) {
        let event = match behaviour {
            Behaviour::Works => RoomEvent::DeviceRecovers { device },
            Behaviour::Fails => RoomEvent::DeviceFails { device },
            Behaviour::Lies => RoomEvent::DeviceLies { device },
            Behaviour::Stalls => RoomEvent::DeviceStalls { device },
            Behaviour::Slow => RoomEvent::DeviceSlows { device },
            Behaviour::Refuses => RoomEvent::DeviceRefuses { device },
            Behaviour::Panics => RoomEvent::DevicePanics { device },
        };
        self.change(|state, now| {
            state.behaviour.insert(device, (behaviour, now));
            state.happens(now, event);
        });
    }

    /// Runs `edit` on the state. Then, without the lock, notifies the observers and wakes the waiting operations.
    pub(super) fn change<R>(&self, edit: impl FnOnce(&mut State, Instant) -> R) -> R {
        let (result, wakers, grown) = {
            let mut state = lock(&self.inner.state);
            let before = state.moments.len();
            let result = edit(&mut state, Instant::now());
            let wakers = if std::mem::take(&mut state.changed) {
                std::mem::take(&mut state.wakers)
            } else {
                Default::default()
            };
            (result, wakers, state.moments.len() > before)
        };
        if grown {
            self.notify();
        }
        for waker in wakers.into_values() {
            waker.wake();
        }
        result
    }

    fn notify(&self) {
        let mut guard = lock(&self.inner.observers);
        let (observers, received) = &mut *guard;
        let news = lock(&self.inner.state).moments[*received..].to_vec();
        *received += news.len();
        for moment in &news {
            for observer in &mut *observers {
                observer(moment);
            }
        }
    }
}

/// Locks a mutex. A panic of another holder leaves the state consistent, so poisoning is ignored.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
