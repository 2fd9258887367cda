//! How far the derived relations lag behind the facts.

use crate::relation::Mark;

/// How far the components' readings of their inputs have come.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lag(pub(crate) Vec<Option<Seen>>);

/// What a component saw when it was last derived.
#[derive(Clone, Debug)]
pub(crate) struct Seen {
    pub(crate) inputs: Vec<Mark>,
    pub(crate) functions: Vec<u64>,
}
