//! Futures side by side that are polled only when they were woken.
//!
//! Problem: five agents with dozens of skills share one task where all work together, and one waking would poll all of
//! them. Idea: each future has a bell of its own; ringing it wakes the task, and only futures whose bell has rung are
//! polled, in the order in which they stand. Invariant: a future is polled at first, and after each waking, as if it
//! were alone.

use std::future::Future;
use std::pin::Pin;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::task::{Context, Poll, Wake, Waker};

/// A future with a bell.
pub(super) struct Attentive<F> {
    work: F,
    bell: Arc<Bell>,
    ours: Waker,
}

impl<F: Future + Unpin> Attentive<F> {
    pub(super) fn new(work: F) -> Self {
        let bell = Arc::new(Bell { rung: AtomicBool::new(true), task: Mutex::new(Waker::noop().clone()) });
        Self { work, ours: Waker::from(Arc::clone(&bell)), bell }
    }

    /// Polls it if it was woken.
    pub(super) fn attend(&mut self, context: &Context<'_>) -> Poll<F::Output> {
        self.bell.belongs_to(context.waker());
        // After that: a bell that rings now wakes this task.
        if !self.bell.rung.swap(false, Ordering::AcqRel) {
            return Poll::Pending;
        }
        Pin::new(&mut self.work).poll(&mut Context::from_waker(&self.ours))
    }
}

struct Bell {
    rung: AtomicBool,
    /// Who polls the future.
    task: Mutex<Waker>,
}

impl Bell {
    fn belongs_to(&self, waker: &Waker) {
        let mut task = self.task.lock().unwrap_or_else(PoisonError::into_inner);
        task.clone_from(waker);
    }
}

impl Wake for Bell {
    fn wake(self: Arc<Self>) {
        self.wake_by_ref();
    }

    fn wake_by_ref(self: &Arc<Self>) {
        if !self.rung.swap(true, Ordering::AcqRel) {
            let task = self.task.lock().unwrap_or_else(PoisonError::into_inner).clone();
            task.wake();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Attentive;
    use std::cell::Cell;
    use std::future::poll_fn;
    use std::task::{Context, Poll, Waker};

    #[test]
    fn a_future_is_polled_at_first_and_when_it_was_woken() {
        let (polls, kept) = (Cell::new(0), Cell::new(None));
        let work = poll_fn(|context| {
            polls.set(polls.get() + 1);
            kept.set(Some(context.waker().clone()));
            if polls.get() == 3 { Poll::Ready(()) } else { Poll::Pending }
        });
        let mut attentive = Attentive::new(work);
        let context = Context::from_waker(Waker::noop());
        for _ in 0..3 {
            assert_eq!(attentive.attend(&context), Poll::Pending);
        }
        assert_eq!(polls.get(), 1);
        let wake = || kept.take().map(Waker::wake);
        wake();
        assert_eq!(attentive.attend(&context), Poll::Pending);
        assert_eq!(attentive.attend(&context), Poll::Pending);
        assert_eq!(polls.get(), 2);
        wake();
        assert_eq!(attentive.attend(&context), Poll::Ready(()));
    }
}
