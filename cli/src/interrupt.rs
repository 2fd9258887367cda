//! Ctrl-C: the first one asks a run to end in order, the second one ends the process.
//!
//! A termination (`kill`, a closed terminal) is an interruption, too. Commands that never call [`first`] are ended at
//! once, as any program.

use crate::exit::Exit;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use tokio::sync::Notify;

#[derive(Default)]
struct Interrupt {
    happened: AtomicBool,
    news: Notify,
}

static INTERRUPT: OnceLock<Interrupt> = OnceLock::new();

/// Waits for the first interruption from now on; for ever if the system does not let us handle it.
pub(crate) async fn first() {
    let interrupt = INTERRUPT.get_or_init(|| {
        // Refused by the system: Ctrl-C then ends the process at once, as it would without us.
        let _ = ctrlc::set_handler(|| {
            let Some(interrupt) = INTERRUPT.get() else { return };
            if interrupt.happened.swap(true, Ordering::SeqCst) {
                std::process::exit(Exit::Interrupted.code().into());
            }
            interrupt.news.notify_one();
        });
        Interrupt::default()
    });
    interrupt.news.notified().await;
}
