//! How far the derived relations lag behind the facts.

use crate::relation::Mark;

/// By component: the inputs that it has read.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lag(pub(crate) Vec<Option<Seen>>);

/// The state of a component's inputs when it was last derived.
#[derive(Clone, Debug)]
pub(crate) struct Seen {
    pub(crate) inputs: Vec<Mark>,
    pub(crate) functions: Vec<u64>,
}
