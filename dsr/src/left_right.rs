//! Publication: readers take the present value without waiting; one writer at a time makes the next one.
//!
//! Problem: a value that is edited in place cannot be read meanwhile, so readers would wait; copying the value for
//! every edit costs more than the edit. Idea: two values, twins. Readers have the present one. The writer has the other
//! one to itself, one change behind: it applies that change, edits the value, and exchanges the two in one store. The
//! value that was present catches up when the next writer comes. If a reader still holds it, it is left to that reader,
//! and the writer clones the present value instead; with pages behind reference counts, a clone is a few counts, and a
//! copy of each page that is edited.
//!
//! Invariants: a published value is never edited; the other value has no second holder while it is edited. A writer
//! whose edit fails has put everything back (`leave`), or its value is discarded; the value of a writer that panics is
//! discarded too. Reading is one load from the slot. Cost: each edit is made twice, the second time as a change that is
//! known to fit.
//!
//! Source: Ramalhete and Correia, "Left-Right", 2013; here the second copy is given away to slow readers instead of
//! waiting for them.

use super::sync::{Arc, Mutex, MutexGuard, PoisonError, Slot};

/// A value that a change turns into the next one.
pub(crate) trait Twin: Clone {
    /// The change from one value to the next.
    type Change;

    /// Turns the value into the next one. If it returns false, the value is discarded.
    fn follow(&mut self, change: &Self::Change) -> bool;
}

/// A value for readers and writers, and data for writers only.
pub(crate) struct LeftRight<T: Twin, W> {
    present: Slot<T>,
    writers: Mutex<Side<T, W>>,
}

/// What the lock guards.
struct Side<T: Twin, W> {
    twin: Option<Arc<T>>,
    /// The change that the twin has not applied yet.
    behind: Option<T::Change>,
    /// An edit has begun, and was neither published nor put back.
    editing: bool,
    own: W,
}

impl<T: Twin, W> LeftRight<T, W> {
    pub(crate) fn new(value: T, own: W) -> Self {
        let side = Side { twin: None, behind: None, editing: false, own };
        Self { present: Slot::new(Arc::new(value)), writers: Mutex::new(side) }
    }

    /// The present value. Never waits.
    pub(crate) fn read(&self) -> Arc<T> {
        self.present.load()
    }

    /// Waits for the present writer to finish.
    pub(crate) fn write(&self) -> Writing<'_, T, W> {
        // After a panic of a writer only its twin is in doubt, and `editing` marks it to be discarded.
        let mut side = self.writers.lock().unwrap_or_else(PoisonError::into_inner);
        if std::mem::take(&mut side.editing) {
            (side.twin, side.behind) = (None, None);
        }
        Writing { states: self, side }
    }
}

/// The right to make the next value.
pub(crate) struct Writing<'k, T: Twin, W> {
    states: &'k LeftRight<T, W>,
    side: MutexGuard<'k, Side<T, W>>,
}

impl<T: Twin, W> Writing<'_, T, W> {
    /// The data for writers only.
    pub(crate) fn own(&mut self) -> &mut W {
        &mut self.side.own
    }

    /// The present value, until `publish`.
    pub(crate) fn present(&self) -> Arc<T> {
        self.states.present.load()
    }

    /// The value that `next` will most likely return, as it is now: for loading it into the cache.
    pub(crate) fn ahead(&self) -> Option<&T> {
        self.side.twin.as_deref()
    }

    /// A value equal to the present one, for the writer alone. End the edit with `publish` or `leave`.
    pub(crate) fn next(&mut self) -> &mut T {
        let Side { twin, behind, editing, .. } = &mut *self.side;
        *editing = true;
        let behind = behind.take();
        let follows = |value: &mut T| behind.is_none_or(|change| value.follow(&change));
        if !twin.as_mut().and_then(Arc::get_mut).is_some_and(follows) {
            *twin = None;
        }
        let twin = twin.get_or_insert_with(|| Arc::new(T::clone(&self.states.present.load())));
        Arc::get_mut(twin).expect("just made, or just found to have no other holder")
    }

    /// Ends an edit that has put the value of `next` back as it was.
    pub(crate) fn leave(&mut self) {
        self.side.editing = false;
    }

    /// Makes the value of `next` the present one and returns it. Without a change, the next writer clones the present
    /// value; the old one is returned too, for the caller to free without the lock.
    pub(crate) fn publish(&mut self, change: Option<T::Change>) -> (Arc<T>, Option<Arc<T>>) {
        let next = self.side.twin.take().unwrap_or_else(|| self.states.present.load());
        let before = self.states.present.swap(Arc::clone(&next));
        self.side.editing = false;
        self.side.behind = change;
        if self.side.behind.is_none() {
            return (next, Some(before));
        }
        self.side.twin = Some(before);
        (next, None)
    }
}
