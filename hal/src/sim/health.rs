//! Health: what the robot finds out about its devices beside their work.

use std::time::Duration;

use tokio::time::Instant;

use super::behaviour::Behaviour;
use super::room::SimRoom;
use super::state::{State, seconds};
use super::waiting::Step;
use crate::{Device, DeviceError, Health, Operation};

/// How long a device may leave a request without an answer.
const SECONDS_TO_ANSWER: f64 = 3.0;
/// How long a test takes.
const SECONDS_TO_TEST: f64 = 1.0;

impl Health for SimRoom {
    fn await_fault(&self, device: Device) -> Operation<'_, ()> {
        self.observe_devices(move |state: &mut State, now: Instant| {
            let (behaviour, since) = state.behaviour_since(device);
            let at = since.unwrap_or(state.started);
            match behaviour {
                Behaviour::Fails | Behaviour::Panics => Step::Done(Ok(())),
                Behaviour::Stalls => from(at + seconds(SECONDS_TO_ANSWER), now),
                Behaviour::Works | Behaviour::Lies | Behaviour::Slow | Behaviour::Refuses => Step::Idle,
            }
        })
    }

    fn await_recovery(&self, device: Device, steady: Duration) -> Operation<'_, ()> {
        self.observe_devices(move |state: &mut State, now: Instant| match state.behaviour_since(device) {
            (Behaviour::Fails | Behaviour::Stalls | Behaviour::Panics, _) => Step::Idle,
            (_, None) => Step::Done(Ok(())),
            (_, Some(since)) => from(since + steady, now),
        })
    }

    fn test(&self, device: Device) -> Operation<'_, ()> {
        let mut begun = None;
        self.operate(device, move |state: &mut State, now: Instant| {
            let ready = *begun.get_or_insert(now) + seconds(SECONDS_TO_TEST);
            if now < ready {
                return Step::Until(ready);
            }
            let sensed = match device {
                // Each is tested against the other.
                Device::SpeechOut | Device::SpeechIn => {
                    state.works(Device::SpeechOut) && state.works(Device::SpeechIn)
                }
                Device::Screen | Device::Buttons | Device::Skeleton | Device::Clinic => state.works(device),
            };
            Step::Done(if sensed { Ok(()) } else { Err(DeviceError::NotSensed { device }) })
        })
    }
}

fn from(at: Instant, now: Instant) -> Step<Result<(), DeviceError>> {
    if now < at { Step::Until(at) } else { Step::Done(Ok(())) }
}
