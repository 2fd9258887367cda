//! Preferences: what a good plan satisfies and any plan may violate.
//!
//! A preference stands beside the hard part of its condition, which the model stores without it. A `forall`
//! around it makes one instance for each binding, and several preferences may share a name: `(is-violated
//! name)` counts the instances that a plan violates.
//!
//! Source: Gerevini & Long, "Plan constraints and preferences in PDDL3", 2005.

use super::{Name, VariableId};
use crate::Span;

/// `(forall (?x …) (preference name body))`.
#[derive(Clone, Debug)]
pub struct Preference<T> {
    /// Its name; a preference without a name cannot appear in a metric and so costs nothing.
    pub name: Option<Name>,
    /// The slots of all `forall`s around it, outermost first.
    pub forall: Vec<VariableId>,
    /// What should hold.
    pub body: T,
    /// `(preference …)` without the `forall`s.
    pub span: Span,
    /// The name, or the word `preference` if it has no name.
    pub name_span: Span,
}
