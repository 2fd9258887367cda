//! Publication: readers take the present value and never wait; one writer at a time makes the next one.
//!
//! Problem: a value that is edited in place cannot be read meanwhile, so whoever comes then must wait; one that is
//! copied for every edit costs more than the edit. Idea: two values, twins. Readers have the present one. The writer
//! has the other one to itself, one change behind: it lets it follow that change, edits it, and exchanges the two in
//! one store. What was the present value is the other one now, and follows when the next writer comes. Where a
//! reader still holds it, it is left to that reader and the present one is cloned instead, which for pages behind
//! reference counts is a handful of counts, and a copy of what is then touched.
//!
//! Invariants: what is published is never edited; the other value has no second holder while it is edited. An edit
//! that fails says that it has put everything back, or its value is given up; so does one that panics, whatever it
//! had done by then. Reading is one load from the slot. Cost: an edit is made twice, the second time as a change that
//! is already known to fit.
//!
//! Source: Ramalhete and Correia, "Left-Right", 2013, with the second copy given away to readers that are slow rather
//! than waited for.

use super::sync::{Arc, Mutex, MutexGuard, PoisonError, Slot};

/// A value that can be made the next one by a change.
pub(crate) trait Twin: Clone {
    /// What makes of one value the next one.
    type Change;

    /// Makes the value the next one; false if it cannot, then it is given up.
    fn follow(&mut self, change: &Self::Change) -> bool;
}

/// A value for readers and writers, and what only writers have.
pub(crate) struct LeftRight<T: Twin, W> {
    present: Slot<T>,
    writers: Mutex<Side<T, W>>,
}

/// What the lock guards.
struct Side<T: Twin, W> {
    twin: Option<Arc<T>>,
    /// What the twin has yet to follow.
    behind: Option<T::Change>,
    /// An edit has begun and neither ended nor been taken back.
    editing: bool,
    own: W,
}

impl<T: Twin, W> LeftRight<T, W> {
    pub(crate) fn new(value: T, own: W) -> Self {
        let side = Side { twin: None, behind: None, editing: false, own };
        Self { present: Slot::new(Arc::new(value)), writers: Mutex::new(side) }
    }

    /// The present value. Waits for nobody.
    pub(crate) fn read(&self) -> Arc<T> {
        self.present.load()
    }

    /// Waits until no other writer is left.
    pub(crate) fn write(&self) -> Writing<'_, T, W> {
        // A writer that panicked leaves nothing but its twin, which `editing` gives up.
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
    /// What only writers have.
    pub(crate) fn own(&mut self) -> &mut W {
        &mut self.side.own
    }

    /// The present value, which stays that until `publish`.
    pub(crate) fn present(&self) -> Arc<T> {
        self.states.present.load()
    }

    /// What will most likely be given by `next`, as it is now: for having it in the cache.
    pub(crate) fn ahead(&self) -> Option<&T> {
        self.side.twin.as_deref()
    }

    /// A value like the present one, for the writer alone. What becomes of it is said by `publish` or `leave`.
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

    /// The value of `next` is as it was given.
    pub(crate) fn leave(&mut self) {
        self.side.editing = false;
    }

    /// Makes the value of `next` the present one, and gives it, with what it replaces if nobody is to follow: that is
    /// let go of after the lock. Without a change the next writer clones.
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
