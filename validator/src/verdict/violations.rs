//! The preferences that a plan violates.

use crate::number::Number;
use indexmap::IndexMap;
use pddl::Span;
use pddl::model::{Name, ObjectId};

/// A preference that a plan does not satisfy, for one binding of its enclosing `forall`s.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ViolatedPreference {
    /// Its name, if it has one.
    pub name: Option<Name>,
    /// The values of the variables of these `forall`s.
    pub binding: Vec<(Name, ObjectId)>,
    /// Its place.
    pub span: Span,
}

/// The violated instances of preferences, counted by name.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Violations {
    counts: IndexMap<Name, u64>,
    instances: Vec<ViolatedPreference>,
}

impl Violations {
    /// The number of violated instances with this name.
    pub fn count(&self, name: &Name) -> Number {
        let count = self.counts.get(name).copied().unwrap_or(0);
        Number::integer(i64::try_from(count).unwrap_or(i64::MAX))
    }

    /// Every violated instance, in the order of judgement.
    pub fn instances(&self) -> &[ViolatedPreference] {
        &self.instances
    }

    /// Counts an instance.
    pub(crate) fn add(&mut self, violated: ViolatedPreference) {
        if let Some(name) = &violated.name {
            *self.counts.entry(name.clone()).or_insert(0) += 1;
        }
        self.instances.push(violated);
    }
}
