//! The clinician: comes when called, or does not come; presses commands; receives the report.

use std::time::Duration;

use tokio::time::Instant;

use super::event::RoomEvent;
use super::room::SimRoom;
use super::state::{State, seconds};
use super::waiting::{Activity, Step};
use crate::{Clinic, Device, DeviceError, Operation, Urgency};

/// How long the server takes to acknowledge a report.
const TO_DELIVER: Duration = Duration::from_millis(100);

impl Clinic for SimRoom {
    fn call<'a>(&'a self, id: &'a str, need: &'a str, urgency: Urgency) -> Operation<'a, ()> {
        self.operate(Device::Clinic, Calling { id, need, urgency, called: None, arrived: None })
    }

    fn next_command<'a>(&'a self, name: &'a str) -> Operation<'a, ()> {
        self.operate(Device::Clinic, move |state: &mut State, _: Instant| {
            if state.works(Device::Clinic) && state.pressed.as_deref() == Some(name) {
                state.pressed = None;
                return Step::Done(Ok(()));
            }
            Step::Idle
        })
    }

    fn deliver<'a>(&'a self, id: &'a str, report: &'a serde_json::Value) -> Operation<'a, ()> {
        let mut since = None;
        self.operate(Device::Clinic, move |state: &mut State, now: Instant| {
            let ready = *since.get_or_insert(now) + TO_DELIVER;
            if now < ready {
                return Step::Until(ready);
            }
            if state.works(Device::Clinic) {
                state.happens(now, RoomEvent::ReportDelivered { report: report.clone(), id: id.to_owned() });
            }
            Step::Done(Ok(()))
        })
    }
}

struct Calling<'a> {
    id: &'a str,
    need: &'a str,
    urgency: Urgency,
    called: Option<Instant>,
    arrived: Option<Instant>,
}

impl Activity<()> for Calling<'_> {
    fn step(&mut self, state: &mut State, now: Instant) -> Step<Result<(), DeviceError>> {
        // A link that lies takes the call, and nobody hears of it.
        if !state.works(Device::Clinic) {
            return Step::Idle;
        }
        let urgent = self.urgency == Urgency::Urgent;
        let need = || self.need.to_owned();
        let called = *self.called.get_or_insert_with(|| {
            state.happens(now, RoomEvent::ClinicianCalled { need: need(), urgent, id: self.id.to_owned() });
            now
        });
        let since = match self.arrived {
            Some(since) => since,
            None => {
                let due = called + seconds(state.clinician.after);
                if !std::mem::take(&mut state.clinician_comes_now) {
                    if !state.clinician.comes || (state.clinician.only_urgent && !urgent) {
                        return Step::Idle;
                    }
                    if now < due {
                        return Step::Until(due);
                    }
                }
                state.happens(now, RoomEvent::ClinicianArrives { need: need() });
                if state.clinician.fetches && !state.view.inside {
                    state.set_view("", true, now, RoomEvent::PersonReturns);
                }
                *self.arrived.insert(now)
            }
        };
        let over = since + seconds(state.clinician.stays);
        if now < over {
            return Step::Until(over);
        }
        state.happens(now, RoomEvent::ClinicianGoes { need: need() });
        Step::Done(Ok(()))
    }

    fn stop(&mut self, state: &mut State, now: Instant) {
        if self.called.is_some() {
            state.happens(now, RoomEvent::CallWithdrawn { need: self.need.to_owned() });
        }
    }
}
