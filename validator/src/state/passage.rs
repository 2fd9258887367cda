//! Fluents at an instant in the middle of continuous change.

use crate::curve::Curve;
use crate::root::Instant;
use pddl::model::GroundApplication;
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// The fluents that change continuously, each with its curve.
pub(crate) type Curves = FxHashMap<GroundApplication, Curve>;

/// An instant in the middle of continuous change at which the value of a fluent has no exact number.
#[derive(Clone, Debug)]
pub(crate) struct Passage {
    pub(crate) curves: Arc<Curves>,
    pub(crate) at: Instant,
}

impl Passage {
    /// Removes the curve of a fluent, so that its value in the state counts again.
    pub(crate) fn forget(&mut self, fluent: &GroundApplication) {
        if self.curves.contains_key(fluent) {
            Arc::make_mut(&mut self.curves).remove(fluent);
        }
    }
}
