//! A switch that several threads share.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// A switch that can only be turned on. Clones are the same switch.
#[derive(Clone, Debug, Default)]
pub struct Cancellation(Arc<AtomicBool>);

impl Cancellation {
    /// Turns it on.
    pub fn cancel(&self) {
        self.0.store(true, Relaxed);
    }

    /// Whether it is on.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Relaxed)
    }
}

#[cfg(test)]
mod tests {
    use super::Cancellation;

    #[test]
    fn clones_share_one_switch() {
        let cancellation = Cancellation::default();
        let other = cancellation.clone();
        assert!(!cancellation.is_cancelled());
        std::thread::scope(|scope| scope.spawn(|| other.cancel()).join()).expect("no panic");
        assert!(cancellation.is_cancelled());
    }
}
