//! The state of the room, and the changes that keep it consistent.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::task::Waker;
use std::time::Duration;

use tokio::time::Instant;

use super::behaviour::Behaviour;
use super::event::{Moment, RoomEvent};
use super::script::{By, ClinicianScript, PatientScript, Reply};
use crate::{Device, Page, Question};

/// A question that the person can answer now: at least one device waits for the answer.
#[derive(Debug)]
pub(super) struct Window {
    pub(super) topic: String,
    pub(super) name: String,
    pub(super) opened: Instant,
    pub(super) reply: Reply,
    /// Whether the person has replied, by voice and by touch; they reply once, or once by each.
    answered: [bool; 2],
    /// Whether the person was asked this question before, as after an interruption.
    asked_before: bool,
    /// The number of percepts when the previous window closed.
    perceived_before: u64,
    devices: usize,
    /// How many of the devices are microphones.
    ears: usize,
}

impl Window {
    fn is_of(&self, question: &Question) -> bool {
        self.topic == question.topic && (self.name == question.name || question.name.is_empty())
    }

    /// Whether the person knows of the question.
    fn asked(&self, perceived: u64) -> bool {
        self.asked_before || perceived > self.perceived_before
    }
}

/// Whether a person is in view of the robot.
#[derive(Debug, Clone, Copy)]
pub(super) struct View {
    pub(super) inside: bool,
    pub(super) since: Instant,
}

/// A request of a person.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Asked {
    pub(super) request: String,
    pub(super) person: String,
    /// By voice or by touch; `None` by whatever works.
    pub(super) by: Option<By>,
}

#[derive(Debug)]
pub(super) struct State {
    pub(super) patient: PatientScript,
    pub(super) clinician: ClinicianScript,
    pub(super) started: Instant,
    /// The patient's.
    pub(super) view: View,
    /// Other people, by name, who have been in view.
    visitors: BTreeMap<String, View>,
    /// How each device behaves, and since when.
    pub(super) behaviour: BTreeMap<Device, (Behaviour, Instant)>,
    /// Whether the robot is speaking.
    pub(super) speaking: bool,
    pub(super) displayed: Option<Page>,
    /// How many sentences and pages the person has perceived.
    perceived: u64,
    perceived_at_last_window: u64,
    pub(super) window: Option<Window>,
    asked: BTreeSet<(String, String)>,
    /// Requests that no device has taken yet.
    pub(super) requests: VecDeque<Asked>,
    /// The last command, if no operation has taken it.
    pub(super) pressed: Option<String>,
    /// Whether the clinician comes to the next call at once.
    pub(super) clinician_comes_now: bool,
    pub(super) moments: Vec<Moment>,
    /// Whether a change may concern a waiting operation.
    pub(super) changed: bool,
    pub(super) wakers: BTreeMap<u64, Waker>,
    next_waker: u64,
}

impl State {
    pub(super) fn new(patient: PatientScript, clinician: ClinicianScript, now: Instant) -> Self {
        Self {
            view: View { inside: patient.in_view, since: now },
            visitors: BTreeMap::new(),
            patient,
            clinician,
            started: now,
            behaviour: BTreeMap::new(),
            speaking: false,
            displayed: None,
            perceived: 0,
            perceived_at_last_window: 0,
            window: None,
            asked: BTreeSet::new(),
            requests: VecDeque::new(),
            pressed: None,
            clinician_comes_now: false,
            moments: Vec::new(),
            changed: false,
            wakers: BTreeMap::new(),
            next_waker: 0,
        }
    }

    pub(super) fn happens(&mut self, now: Instant, event: RoomEvent) {
        self.moments.push(Moment { at: now - self.started, event });
        self.changed = true;
    }

    /// A moment of an earlier simulation whose outcome lasts.
    pub(super) fn take_over(&mut self, moment: &Moment) {
        let at = self.started + moment.at;
        let mut behave = |device: Device, behaviour| _ = self.behaviour.insert(device, (behaviour, at));
        match &moment.event {
            RoomEvent::PersonLeaves | RoomEvent::PersonLeavesRoom => {
                self.view = View { inside: false, since: at };
            }
            RoomEvent::PersonReturns => self.view = View { inside: true, since: at },
            RoomEvent::VisitorComes { name } => {
                self.visitors.insert(name.clone(), View { inside: true, since: at });
            }
            RoomEvent::VisitorGoes { name } => {
                self.visitors.insert(name.clone(), View { inside: false, since: at });
            }
            RoomEvent::DeviceFails { device } => behave(*device, Behaviour::Fails),
            RoomEvent::DeviceLies { device } => behave(*device, Behaviour::Lies),
            RoomEvent::DeviceStalls { device } => behave(*device, Behaviour::Stalls),
            RoomEvent::DeviceSlows { device } => behave(*device, Behaviour::Slow),
            RoomEvent::DeviceRefuses { device } => behave(*device, Behaviour::Refuses),
            RoomEvent::DevicePanics { device } => behave(*device, Behaviour::Panics),
            RoomEvent::DeviceRecovers { device } => behave(*device, Behaviour::Works),
            RoomEvent::RobotSays { .. }
            | RoomEvent::RobotStops { .. }
            | RoomEvent::ScreenShows { .. }
            | RoomEvent::ScreenClears
            | RoomEvent::PersonSays { .. }
            | RoomEvent::PersonTouches { .. }
            | RoomEvent::PersonAsks { .. }
            | RoomEvent::ClinicianCalled { .. }
            | RoomEvent::CallWithdrawn { .. }
            | RoomEvent::ClinicianArrives { .. }
            | RoomEvent::ClinicianGoes { .. }
            | RoomEvent::ClinicianCommands { .. }
            | RoomEvent::ReportDelivered { .. } => {}
        }
    }

    /// Stores a waker under the number of its operation, or under a new number.
    pub(super) fn keep_waker(&mut self, held: Option<u64>, waker: Waker) -> u64 {
        let id = held.unwrap_or(self.next_waker);
        self.next_waker = self.next_waker.max(id + 1);
        self.wakers.insert(id, waker);
        id
    }

    /// The patient perceives a finished sentence or a page that has stood, if they are in view.
    pub(super) fn perceive(&mut self) {
        if self.view.inside {
            self.perceived += 1;
            self.changed = true;
        }
    }

    /// Whether a person is in view; the patient if `person` is empty. A visitor who has never come is not.
    pub(super) fn view_of(&self, person: &str) -> View {
        if self.is_patient(person) {
            return self.view;
        }
        self.visitors.get(person).copied().unwrap_or(View { inside: false, since: self.started })
    }

    fn is_patient(&self, person: &str) -> bool {
        person.is_empty() || person == self.patient.name
    }

    pub(super) fn set_view(&mut self, person: &str, inside: bool, now: Instant, event: RoomEvent) {
        if self.view_of(person).inside != inside {
            let view = View { inside, since: now };
            if self.is_patient(person) {
                self.view = view;
                // A person who comes back sees the page on the screen.
                if inside && self.displayed.is_some() {
                    self.perceive();
                }
            } else {
                self.visitors.insert(person.to_owned(), view);
            }
        }
        self.happens(now, event);
    }

    /// Takes a request of this person by voice or by touch, if they have made one.
    pub(super) fn take_request(&mut self, request: &str, person: &str, by: By) -> Option<Asked> {
        let at = self.requests.iter().position(|asked| {
            asked.request == request
                && asked.by.is_none_or(|only| only == by)
                && (asked.person == person || (self.is_patient(person) && self.is_patient(&asked.person)))
        })?;
        self.requests.remove(at)
    }

    /// A device begins to wait for an answer. Another question than the open one replaces it.
    pub(super) fn open(&mut self, question: &Question, by: By, now: Instant) {
        let ears = usize::from(by == By::Voice);
        if let Some(window) = self.window_of(question) {
            window.devices += 1;
            window.ears += ears;
            return;
        }
        let key = (question.topic.clone(), question.name.clone());
        self.window = Some(Window {
            topic: question.topic.clone(),
            name: question.name.clone(),
            opened: now,
            reply: self.patient.reply(&question.topic, &question.name).clone(),
            answered: [false; 2],
            asked_before: self.asked.contains(&key),
            perceived_before: self.perceived_at_last_window,
            devices: 1,
            ears,
        });
    }

    /// The open window, if it belongs to this question. A question without a name matches every question of its topic.
    fn window_of(&mut self, question: &Question) -> Option<&mut Window> {
        self.window.as_mut().filter(|window| window.is_of(question))
    }

    /// A device stops waiting for an answer.
    pub(super) fn close(&mut self, question: &Question, by: By) {
        let perceived = self.perceived;
        let Some(window) = self.window_of(question) else { return };
        window.devices -= 1;
        window.ears -= usize::from(by == By::Voice);
        if window.devices > 0 {
            return;
        }
        let asked = window.asked(perceived).then(|| (window.topic.clone(), window.name.clone()));
        self.asked.extend(asked);
        self.perceived_at_last_window = self.perceived;
        self.window = None;
    }

    /// When and how the person replies to the open question; `None` if they do not reply now.
    pub(super) fn reply(&self, question: &Question, by: By) -> Option<(Instant, Reply)> {
        let window = self.window.as_ref().filter(|window| window.is_of(question))?;
        let answered = match &window.reply {
            Reply::Answer { by: By::Both, .. } => window.answered[usize::from(by == By::Touch)],
            _ => window.answered.contains(&true),
        };
        if answered || !self.view.inside || !window.asked(self.perceived) {
            return None;
        }
        let from = window.opened.max(self.view.since);
        Some((from + seconds(window.reply.delay()?), window.reply.clone()))
    }

    /// Whether a device listens for the answer.
    pub(super) fn is_listened_for(&self, question: &Question) -> bool {
        self.window.as_ref().is_some_and(|window| window.is_of(question) && window.ears > 0)
    }

    pub(super) fn answered(&mut self, by: By) {
        if let Some(window) = &mut self.window {
            window.answered[usize::from(by == By::Touch)] = true;
        }
    }

    /// Whether the person can touch this option on the screen.
    pub(super) fn offers(&self, option: &str) -> bool {
        self.works(Device::Buttons)
            && !matches!(self.behaviour(Device::Screen), Behaviour::Fails | Behaviour::Panics)
            && self.displayed.as_ref().is_some_and(|page| page.options.iter().any(|o| o.id == option))
    }
}

/// A scripted number of seconds; an invalid duration counts as zero.
pub(super) fn seconds(seconds: f64) -> Duration {
    Duration::try_from_secs_f64(seconds).unwrap_or_default()
}
