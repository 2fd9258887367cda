//! The limits that end a search, in words.

use planner::Limit;

/// The limit as a clause of a sentence.
pub(crate) fn limit_words(limit: Limit) -> &'static str {
    match limit {
        Limit::Interrupted => "the time is over",
        Limit::Expansions => "as many states were expanded as allowed",
        Limit::Memory => "the memory is used up",
        Limit::Incomplete => "this search is incomplete and gave up; another one may find a plan",
    }
}
