//! A device operation as a step function over the room.
//!
//! Idea: `poll` takes the lock, asks the device's behaviour whether the operation may go on, runs the step, and sleeps
//! until the instant that the step names or until the room changes. An operation that is dropped, or fails, before it is
//! done runs its `stop`, which stops the device. Wakers are called without the lock, in the order of their registration.

use std::future::Future;
use std::pin::Pin;
use std::task::{Context, Poll};

use tokio::time::{Instant, Sleep, sleep_until};

use super::behaviour::Behaviour;
use super::gate::{Gate, LATE};
use super::room::SimRoom;
use super::state::State;
use crate::{Device, DeviceError, Operation};

/// The result of a step.
pub(super) enum Step<T> {
    /// It is done.
    Done(T),
    /// Nothing to do before this instant, unless the room changes.
    Until(Instant),
    /// Nothing to do until the room changes.
    Idle,
}

/// The work of a device operation.
pub(super) trait Activity<T> {
    /// Advances as far as possible now.
    fn step(&mut self, state: &mut State, now: Instant) -> Step<Result<T, DeviceError>>;

    /// Stops at once. It runs if the operation is dropped, or its device fails, after its first step and before its end.
    fn stop(&mut self, _state: &mut State, _now: Instant) {}
}

/// A step that needs no stop.
impl<T, F: FnMut(&mut State, Instant) -> Step<Result<T, DeviceError>>> Activity<T> for F {
    fn step(&mut self, state: &mut State, now: Instant) -> Step<Result<T, DeviceError>> {
        self(state, now)
    }
}

impl SimRoom {
    /// An operation of a device.
    pub(super) fn operate<'a, T: Send + Unpin + 'a>(
        &self,
        device: Device,
        activity: impl Activity<T> + Send + Unpin + 'a,
    ) -> Operation<'a, T> {
        self.wait(Some(device), activity)
    }

    /// An operation that no behaviour of a device disturbs.
    pub(super) fn observe_devices<'a, T: Send + Unpin + 'a>(
        &self,
        activity: impl Activity<T> + Send + Unpin + 'a,
    ) -> Operation<'a, T> {
        self.wait(None, activity)
    }

    fn wait<'a, T: Send + Unpin + 'a>(
        &self,
        device: Option<Device>,
        activity: impl Activity<T> + Send + Unpin + 'a,
    ) -> Operation<'a, T> {
        let room = self.clone();
        let waiting =
            Waiting { room, device, activity, progress: Progress::New, late: None, sleep: None, waker: None };
        Box::pin(waiting)
    }
}

enum Progress {
    New,
    Begun,
    Done,
}

struct Waiting<T, A: Activity<T>> {
    room: SimRoom,
    device: Option<Device>,
    activity: A,
    progress: Progress,
    /// The result of a slow device, and when it reports it.
    late: Option<(Instant, Result<T, DeviceError>)>,
    sleep: Option<Pin<Box<Sleep>>>,
    waker: Option<u64>,
}

impl<T, A: Activity<T>> Waiting<T, A> {
    fn forget_waker(&mut self) {
        if let Some(id) = self.waker.take() {
            self.room.change(|state, _| state.wakers.remove(&id));
        }
    }

    /// Advances as far as the device's behaviour lets it.
    fn advance(&mut self) -> Step<Result<T, DeviceError>> {
        let Self { room, device, activity, progress, late, .. } = self;
        room.change(|state, now| {
            if let Some((at, _)) = late {
                let at = *at;
                return match late.take_if(|_| at <= now) {
                    Some((_, result)) => Step::Done(result),
                    None => Step::Until(at),
                };
            }
            let Some(device) = *device else {
                *progress = Progress::Begun;
                return activity.step(state, now);
            };
            match state.gate(device) {
                Gate::Open => {}
                Gate::Shut => return Step::Idle,
                Gate::Failed(error) => {
                    if matches!(progress, Progress::Begun) {
                        activity.stop(state, now);
                    }
                    return Step::Done(Err(error));
                }
            }
            *progress = Progress::Begun;
            match activity.step(state, now) {
                Step::Done(result) if state.behaviour(device) == Behaviour::Slow => {
                    *progress = Progress::Done;
                    let at = now + LATE;
                    *late = Some((at, result));
                    Step::Until(at)
                }
                step => step,
            }
        })
    }
}

impl<T: Unpin, A: Activity<T> + Unpin> Future for Waiting<T, A> {
    type Output = Result<T, DeviceError>;

    fn poll(self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Self::Output> {
        let this = self.get_mut();
        loop {
            match this.advance() {
                Step::Done(result) => {
                    this.progress = Progress::Done;
                    this.forget_waker();
                    return Poll::Ready(result);
                }
                Step::Until(instant) => {
                    let mut sleep = Box::pin(sleep_until(instant));
                    if sleep.as_mut().poll(context).is_ready() {
                        continue;
                    }
                    this.sleep = Some(sleep);
                }
                Step::Idle => this.sleep = None,
            }
            let (held, waker) = (this.waker, context.waker().clone());
            this.waker = Some(this.room.change(|state, _| state.keep_waker(held, waker)));
            return Poll::Pending;
        }
    }
}

impl<T, A: Activity<T>> Drop for Waiting<T, A> {
    fn drop(&mut self) {
        self.forget_waker();
        if matches!(self.progress, Progress::Begun) {
            self.room.change(|state, now| self.activity.stop(state, now));
        }
    }
}
