//! The skeleton tracker, with hysteresis: it reports a person, or their loss, after some frames.

use tokio::time::Instant;

use super::room::SimRoom;
use super::state::{State, seconds};
use super::waiting::Step;
use crate::{Device, DeviceError, Operation, Pose, Skeleton};

/// How long a person must be in view to count as seen.
const SECONDS_TO_SEE: f64 = 0.3;
/// How long a person must be out of view to count as lost.
const SECONDS_TO_LOSE: f64 = 0.3;

impl Skeleton for SimRoom {
    fn await_person<'a>(&'a self, person: &'a str) -> Operation<'a, Pose> {
        self.operate(Device::Skeleton, move |state: &mut State, now: Instant| {
            let [x, y, z] = state.patient.position;
            sure(state, person, now, true, SECONDS_TO_SEE, Pose::translation(x, y, z))
        })
    }

    fn await_loss<'a>(&'a self, person: &'a str) -> Operation<'a, ()> {
        self.operate(Device::Skeleton, move |state: &mut State, now: Instant| {
            sure(state, person, now, false, SECONDS_TO_LOSE, ())
        })
    }
}

/// Done once the person has been in view, or out of view, for long enough.
fn sure<T>(
    state: &State,
    person: &str,
    now: Instant,
    inside: bool,
    after: f64,
    result: T,
) -> Step<Result<T, DeviceError>> {
    let view = state.view_of(person);
    if view.inside != inside || !state.works(Device::Skeleton) {
        return Step::Idle;
    }
    let at = view.since + seconds(after);
    if now < at { Step::Until(at) } else { Step::Done(Ok(result)) }
}
