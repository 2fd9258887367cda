//! What the planner and the lints both ask of a domain before any search: which atoms exclude each other.
//!
//! | module | holds |
//! |---|---|
//! | [`invariants`] | sets of atoms of which at most one holds at a time |

pub mod invariants;
