//! The primitives of `left_right`: a lock, a reference count, and a slot that is read without waiting.
//!
//! They are apart so that the model test (`tests/loom.rs`) can replace them with loom's.

pub(crate) use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use arc_swap::ArcSwap;

/// Holds one shared value. Neither reading nor writing it waits.
pub(crate) struct Slot<T>(ArcSwap<T>);

impl<T> Slot<T> {
    pub(crate) fn new(value: Arc<T>) -> Self {
        Self(ArcSwap::new(value))
    }

    pub(crate) fn load(&self) -> Arc<T> {
        self.0.load_full()
    }

    /// Replaces the value. Returns the old one, whose reference count includes every reader.
    pub(crate) fn swap(&self, value: Arc<T>) -> Arc<T> {
        self.0.swap(value)
    }
}
