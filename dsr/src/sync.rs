//! What `left_right` takes from the machine: a lock, a reference count, and a slot that is read without waiting.
//!
//! Kept apart so that the model test (`tests/loom.rs`) can put loom's in their place.

pub(crate) use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use arc_swap::ArcSwap;

/// Holds one value for everybody. Neither reading nor writing it waits for anyone.
pub(crate) struct Slot<T>(ArcSwap<T>);

impl<T> Slot<T> {
    pub(crate) fn new(value: Arc<T>) -> Self {
        Self(ArcSwap::new(value))
    }

    pub(crate) fn load(&self) -> Arc<T> {
        self.0.load_full()
    }

    /// Puts a value in place of the one there; gives that, with every reader's reference counted.
    pub(crate) fn swap(&self, value: Arc<T>) -> Arc<T> {
        self.0.swap(value)
    }
}
