//! A device operation as a step function over the room.
//!
//! Idea: `poll` takes the lock, runs the step, and sleeps until the instant that the step names or until the room
//! changes. An operation that is dropped before it is done runs its `stop`, which stops the device. Wakers are called
//! without the lock, in the order of their registration.

use std::future::Future;
use std::marker::PhantomData;
use std::pin::Pin;
use std::task::{Context, Poll};

use tokio::time::{Instant, Sleep, sleep_until};

use super::room::SimRoom;
use super::state::State;
use crate::{DeviceError, Operation};

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

    /// Stops at once. It runs if the operation is dropped after its first step and before its end.
    fn stop(&mut self, _state: &mut State, _now: Instant) {}
}

/// A step that needs no stop.
impl<T, F: FnMut(&mut State, Instant) -> Step<Result<T, DeviceError>>> Activity<T> for F {
    fn step(&mut self, state: &mut State, now: Instant) -> Step<Result<T, DeviceError>> {
        self(state, now)
    }
}

impl SimRoom {
    pub(super) fn operate<'a, T: 'a>(
        &self,
        activity: impl Activity<T> + Send + Unpin + 'a,
    ) -> Operation<'a, T> {
        let room = self.clone();
        Box::pin(Waiting {
            room,
            activity,
            progress: Progress::New,
            sleep: None,
            waker: None,
            result: PhantomData::<fn() -> T>,
        })
    }
}

#[derive(PartialEq, Eq)]
enum Progress {
    New,
    Begun,
    Done,
}

struct Waiting<T, A: Activity<T>> {
    room: SimRoom,
    activity: A,
    progress: Progress,
    sleep: Option<Pin<Box<Sleep>>>,
    waker: Option<u64>,
    result: PhantomData<fn() -> T>,
}

impl<T, A: Activity<T>> Waiting<T, A> {
    fn forget_waker(&mut self) {
        if let Some(id) = self.waker.take() {
            self.room.change(|state, _| state.wakers.remove(&id));
        }
    }
}

impl<T, A: Activity<T> + Unpin> Future for Waiting<T, A> {
    type Output = Result<T, DeviceError>;

    fn poll(self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Self::Output> {
        let this = self.get_mut();
        this.progress = Progress::Begun;
        loop {
            match this.room.change(|state, now| this.activity.step(state, now)) {
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
        if self.progress == Progress::Begun {
            self.room.change(|state, now| self.activity.stop(state, now));
        }
    }
}
