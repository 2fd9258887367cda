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
    fn await_person(&self) -> Operation<'_, Pose> {
        self.operate(|state: &mut State, now: Instant| {
            let [x, y, z] = state.patient.position;
            sure(state, now, true, SECONDS_TO_SEE, Pose::translation(x, y, z))
        })
    }

    fn await_loss(&self) -> Operation<'_, ()> {
        self.operate(|state: &mut State, now: Instant| sure(state, now, false, SECONDS_TO_LOSE, ()))
    }
}

/// Done once the person has been in view, or out of view, for long enough.
fn sure<T>(
    state: &State,
    now: Instant,
    in_view: bool,
    after: f64,
    result: T,
) -> Step<Result<T, DeviceError>> {
    if let Err(error) = state.check(Device::Skeleton) {
        return Step::Done(Err(error));
    }
    if state.in_view != in_view || !state.works(Device::Skeleton) {
        return Step::Idle;
    }
    let at = state.view_changed + seconds(after);
    if now < at { Step::Until(at) } else { Step::Done(Ok(result)) }
}
