//! Skills at work, each isolated from every other and from the agent.
//!
//! Problem: a driver panics, or blocks its thread and never comes back. The agent whose skill calls it must go on: it
//! writes what the failure means, and stops its other skills. Idea: a panic becomes the outcome `failure`, and
//! [`Housing`] says on which thread skills work. On a thread of its own, a skill that is stuck holds up nothing. The
//! agent drops it like any other; its thread is then *abandoned* until the driver returns.
//!
//! Invariants: dropping a work requests the stop of the device at once. Not more than [`MOST_ABANDONED`] threads are
//! abandoned: beyond that, a launch is a failure.

use std::future::Future;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::pin::Pin;
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::task::{Context, Poll};
use std::time::Duration;

use tokio::sync::oneshot;
use tracing::error;

use crate::skill::{Call, Ended, Equipment, Outcome, Skill, Work};

/// Where agents and skills work.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Housing {
    /// All in the task of the caller, in a fixed order: the same wakings give the same commits, also on a paused clock. A
    /// driver that blocks its thread holds up all of them.
    #[default]
    Together,
    /// Each agent and each skill on a thread of its own, on a clock that runs.
    Apart,
}

/// The most threads of stuck agents and drivers that a program leaves behind.
pub(super) const MOST_ABANDONED: usize = 16;

/// How long the end of a run waits for threads to stop.
const FAREWELL: Duration = Duration::from_secs(1);

/// The threads that work, and those that were abandoned.
#[derive(Debug, Default)]
pub(super) struct Threads {
    counts: Mutex<Counts>,
    fewer: Condvar,
}

#[derive(Debug, Default)]
struct Counts {
    all: usize,
    abandoned: usize,
}

impl Threads {
    /// Runs a future on a thread of its own; `None` if too many threads are stuck, or the system gives no more.
    pub(super) fn run<F, T>(
        self: &Arc<Self>,
        name: &str,
        make: impl FnOnce() -> F + Send + 'static,
    ) -> Option<Errand<T>>
    where
        F: Future<Output = T>,
        T: Send + 'static,
    {
        if self.count(|counts| counts.abandoned) >= MOST_ABANDONED {
            error!(name, "too many drivers are stuck");
            return None;
        }
        let (done, result) = oneshot::channel();
        let (stop, stopped) = oneshot::channel::<()>();
        let present = Present::new(Arc::clone(self));
        let abandoned = Arc::clone(&present.abandoned);
        let work = move || {
            let present = present;
            let ended = catch_unwind(AssertUnwindSafe(|| block_on(make, stopped))).unwrap_or(None);
            // Before the result is known, so that no thread is counted that has nothing left to do.
            drop(present);
            if let Some(ended) = ended {
                let _ = done.send(ended);
            }
        };
        let spawned = std::thread::Builder::new().name(name.to_owned()).spawn(work);
        if let Err(error) = spawned {
            error!(name, %error, "the system gives no thread");
            return None;
        }
        Some(Errand { result, _stop: stop, threads: Arc::clone(self), abandoned })
    }

    /// Waits until all threads have stopped, or no longer.
    pub(super) fn farewell(&self) {
        let counts = self.counts.lock().unwrap_or_else(PoisonError::into_inner);
        let waited = self.fewer.wait_timeout_while(counts, FAREWELL, |counts| counts.all > 0);
        let (counts, waited) = waited.unwrap_or_else(PoisonError::into_inner);
        if waited.timed_out() {
            error!(threads = counts.all, "stuck threads are left behind");
        }
    }

    /// How many threads are stuck.
    pub(super) fn abandoned(&self) -> usize {
        self.count(|counts| counts.abandoned)
    }

    fn count<T>(&self, look: impl FnOnce(&mut Counts) -> T) -> T {
        look(&mut self.counts.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

/// Polls until the end, or until the stop; `None` if it was stopped.
fn block_on<F: Future>(make: impl FnOnce() -> F, stopped: oneshot::Receiver<()>) -> Option<F::Output> {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_time().build();
    let runtime = runtime.map_err(|error| error!(%error, "the system gives no timers")).ok()?;
    runtime.block_on(async move {
        tokio::select! {
            biased;
            _ = stopped => None,
            ended = async { make().await } => Some(ended),
        }
    })
}

/// A thread that is counted as long as it works.
struct Present {
    threads: Arc<Threads>,
    abandoned: Arc<Mutex<bool>>,
}

impl Present {
    fn new(threads: Arc<Threads>) -> Self {
        threads.count(|counts| counts.all += 1);
        Self { threads, abandoned: Arc::default() }
    }
}

impl Drop for Present {
    fn drop(&mut self) {
        let mut abandoned = self.abandoned.lock().unwrap_or_else(PoisonError::into_inner);
        self.threads.count(|counts| {
            counts.all -= 1;
            counts.abandoned -= usize::from(*abandoned);
        });
        // It is no longer there to be abandoned.
        *abandoned = true;
        self.threads.fewer.notify_all();
    }
}

/// The work of another thread. Dropping it stops that work, and abandons the thread until it has stopped.
pub(super) struct Errand<T> {
    result: oneshot::Receiver<T>,
    _stop: oneshot::Sender<()>,
    threads: Arc<Threads>,
    abandoned: Arc<Mutex<bool>>,
}

impl<T> Future for Errand<T> {
    /// `None` if the thread panicked.
    type Output = Option<T>;

    fn poll(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Option<T>> {
        Pin::new(&mut self.result).poll(context).map(Result::ok)
    }
}

impl<T> Drop for Errand<T> {
    fn drop(&mut self) {
        let mut abandoned = self.abandoned.lock().unwrap_or_else(PoisonError::into_inner);
        if !std::mem::replace(&mut *abandoned, true) {
            self.threads.count(|counts| counts.abandoned += 1);
        }
    }
}

/// A future that may panic. It ends with `None` then, and its remains are dropped without another panic.
pub(super) struct Caught<F>(Option<Pin<Box<F>>>);

impl<F> Caught<F> {
    pub(super) fn new(work: F) -> Self {
        Self(Some(Box::pin(work)))
    }

    fn bury(&mut self) {
        let work = self.0.take();
        let _ = catch_unwind(AssertUnwindSafe(|| drop(work)));
    }
}

impl<F: Future> Future for Caught<F> {
    type Output = Option<F::Output>;

    fn poll(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Option<F::Output>> {
        let Some(work) = &mut self.0 else { return Poll::Ready(None) };
        let polled = catch_unwind(AssertUnwindSafe(|| work.as_mut().poll(context)));
        match polled {
            Ok(Poll::Pending) => Poll::Pending,
            Ok(Poll::Ready(output)) => {
                self.bury();
                Poll::Ready(Some(output))
            }
            Err(_) => {
                self.bury();
                Poll::Ready(None)
            }
        }
    }
}

impl<F> Drop for Caught<F> {
    fn drop(&mut self) {
        self.bury();
    }
}

/// Launches skills where the housing wants them.
#[derive(Clone)]
pub(super) struct Launcher {
    pub(super) housing: Housing,
    pub(super) threads: Arc<Threads>,
}

impl Launcher {
    /// The skill at work. It fails if the driver panics.
    pub(super) fn launch(&self, skill: Arc<dyn Skill>, call: Call, equipment: &Equipment) -> Work {
        let name = skill.signature().name;
        let ended = move |ended: Option<Ended>| {
            ended.unwrap_or_else(|| {
                error!(skill = name, "a skill panicked or could not run");
                Ended::otherwise(Outcome::FAILURE)
            })
        };
        match self.housing {
            Housing::Together => {
                let work = catch_unwind(AssertUnwindSafe(|| skill.launch(call, equipment)));
                let work = work.ok().map(Caught::new);
                Box::pin(async move {
                    ended(match work {
                        Some(work) => work.await,
                        None => None,
                    })
                })
            }
            Housing::Apart => {
                let equipment = equipment.clone();
                let errand = self.threads.run(name, move || skill.launch(call, &equipment));
                Box::pin(async move {
                    ended(match errand {
                        Some(errand) => errand.await,
                        None => None,
                    })
                })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn threads_of_stuck_drivers_are_bounded_in_number_and_forgotten_when_they_end() {
        let threads = Arc::new(Threads::default());
        let mut hold = Vec::new();
        let mut stuck = || {
            let (release, released) = std::sync::mpsc::channel::<()>();
            let (begin, begun) = std::sync::mpsc::channel();
            hold.push(release);
            let errand = threads.run("stuck", move || async move {
                let _ = begin.send(());
                released.recv().is_ok()
            });
            // A thread that is stopped before it begins is not stuck.
            begun.recv().ok().and(errand)
        };
        for count in 0..MOST_ABANDONED {
            assert_eq!(threads.abandoned(), count);
            drop(stuck().expect("a thread"));
        }
        assert!(stuck().is_none());
        drop(hold);
        threads.farewell();
        assert_eq!(threads.abandoned(), 0);
        assert!(threads.run("free", || std::future::ready(())).is_some());
    }

    fn mistake() -> u8 {
        panic!("a driver's mistake")
    }

    #[test]
    fn an_errand_ends_with_its_result_or_with_none_after_a_panic() {
        let threads = Arc::new(Threads::default());
        let runtime = tokio::runtime::Builder::new_current_thread().build().expect("no drivers");
        let well = threads.run("well", || async { 7 }).expect("a thread");
        assert_eq!(runtime.block_on(well), Some(7));
        let ill = threads.run("ill", || async { mistake() }).expect("a thread");
        assert_eq!(runtime.block_on(ill), None);
        threads.farewell();
        assert_eq!(threads.abandoned(), 0);
    }
}
