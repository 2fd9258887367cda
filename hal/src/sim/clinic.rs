//! The clinician: comes when called, or does not come; presses commands; receives the report.

use std::time::Duration;

use tokio::time::Instant;

use super::event::RoomEvent;
use super::room::SimRoom;
use super::state::{State, seconds};
use super::waiting::{Activity, Step};
use crate::{Clinic, Device, DeviceError, Operation};

/// How long the server takes to acknowledge a report.
const TO_DELIVER: Duration = Duration::from_millis(100);

impl Clinic for SimRoom {
    fn call<'a>(&'a self, need: &'a str) -> Operation<'a, ()> {
        self.operate(Calling { need, called: None, arrived: None })
    }

    fn next_command<'a>(&'a self, name: &'a str) -> Operation<'a, ()> {
        self.operate(move |state: &mut State, _: Instant| {
            if let Err(error) = state.check(Device::Clinic) {
                return Step::Done(Err(error));
            }
            if state.works(Device::Clinic) && state.pressed.as_deref() == Some(name) {
                state.pressed = None;
                return Step::Done(Ok(()));
            }
            Step::Idle
        })
    }

    fn deliver<'a>(&'a self, report: &'a serde_json::Value) -> Operation<'a, ()> {
        let mut since = None;
        self.operate(move |state: &mut State, now: Instant| {
            if let Err(error) = state.check(Device::Clinic) {
                return Step::Done(Err(error));
            }
            let ready = *since.get_or_insert(now) + TO_DELIVER;
            if now < ready {
                return Step::Until(ready);
            }
            if state.works(Device::Clinic) {
                state.happens(now, RoomEvent::ReportDelivered { report: report.clone() });
            }
            Step::Done(Ok(()))
        })
    }
}

struct Calling<'a> {
    need: &'a str,
    called: Option<Instant>,
    arrived: Option<Instant>,
}

impl Activity<()> for Calling<'_> {
    fn step(&mut self, state: &mut State, now: Instant) -> Step<Result<(), DeviceError>> {
        if let Err(error) = state.check(Device::Clinic) {
            return Step::Done(Err(error));
        }
        if !state.works(Device::Clinic) {
            return Step::Done(Ok(()));
        }
        let need = || self.need.to_owned();
        let called = *self.called.get_or_insert_with(|| {
            state.happens(now, RoomEvent::ClinicianCalled { need: need() });
            now
        });
        let since = match self.arrived {
            Some(since) => since,
            None => {
                let due = called + seconds(state.clinician.after);
                if !std::mem::take(&mut state.clinician_comes_now) {
                    if !state.clinician.comes {
                        return Step::Idle;
                    }
                    if now < due {
                        return Step::Until(due);
                    }
                }
                state.happens(now, RoomEvent::ClinicianArrives { need: need() });
                if state.clinician.fetches && !state.in_view {
                    state.set_view(true, now, RoomEvent::PersonReturns);
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
        state.happens(now, RoomEvent::CallWithdrawn { need: self.need.to_owned() });
    }
}
