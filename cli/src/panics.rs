//! Runs whose drivers may panic on purpose, and that may panic themselves.
//!
//! A scenario lets a driver panic; the agents survive it, and nobody needs to read of it. A run that does not survive is
//! a result of the run, not the end of the program.

use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe, PanicHookInfo, catch_unwind};
use std::sync::Arc;

type PanicHook = dyn Fn(&PanicHookInfo<'_>) + Send + Sync;

thread_local! {
    /// Whether this thread plays a run.
    static PLAYING: Cell<bool> = const { Cell::new(false) };
}

/// Does not report the panics of runs that are played inside. Panics of the program itself are reported as before.
pub(crate) fn without_those_of_runs<T>(work: impl FnOnce() -> T) -> T {
    let before: Arc<PanicHook> = Arc::from(panic::take_hook());
    let reporter = Arc::clone(&before);
    panic::set_hook(Box::new(move |info| {
        if !PLAYING.get() {
            reporter(info);
        }
    }));
    let result = work();
    panic::set_hook(Box::new(move |info| before(info)));
    result
}

/// Plays a run on this thread; `None` if it panicked.
pub(crate) fn survive<T>(run: impl FnOnce() -> T) -> Option<T> {
    PLAYING.set(true);
    let played = catch_unwind(AssertUnwindSafe(run));
    PLAYING.set(false);
    played.ok()
}
