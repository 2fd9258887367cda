//! Patterns: a small subgraph with variables, and the ways to find it in a snapshot.
//!
//! Problem: an agent needs the part of the graph that its actions depend on, not all of it, and which subgraph leads to
//! which action should be text, not code in each agent. Idea: a pattern is a conjunction of edges, types, attribute
//! guards, inequalities, metrics and negated conjunctions over typed variables. It is checked against the vocabulary
//! and compiled once, with a join order. A disjunction is a `Vec<Pattern>`.
//!
//! Semantics: a match gives each top-level variable a node of its type such that all parts hold. Two variables may have
//! the same node unless the pattern excludes it. A guard on an attribute without a value does not hold, whatever the
//! comparison. A negated part holds if its own conjunction has no match; its local variables are known only inside of
//! it. Matches come in the order of node ids, variable by variable, whatever the join order.
//!
//! From the ground up: `term`, `source` (as written) → `slot`, `plan` (the join order), `clue`, `seed`, `measure`,
//! `part` (what compiling works out) → `compiled` → `check` (compiles) → `builder`, `text` (two ways to write one) →
//! `fixed`, `held`, `rigid`, `negated`, `slice` (what a delta may change), `route` → `matcher` → `age`.

mod age;
mod builder;
mod check;
mod clue;
mod compiled;
mod fixed;
mod held;
mod matcher;
mod measure;
mod negated;
mod part;
mod plan;
mod rigid;
mod route;
mod seed;
mod slice;
mod slot;
mod source;
mod term;
mod text;

pub use self::builder::PatternBuilder;
pub use self::check::PatternError;
pub(crate) use self::clue::{Clue, Ordered, Tip, ValueKey, Way};
pub use self::compiled::{Binding, Pattern};
pub(crate) use self::fixed::{Fixed, Slices};
pub(crate) use self::held::Held;
pub(crate) use self::negated::{Known, Moves, Witnesses};
pub(crate) use self::plan::Plans;
pub(crate) use self::rigid::moved;
pub(crate) use self::route::Route;
pub use self::source::PatternSource;
pub use self::term::{Comparison, HolderTerm, Metric, Operand, Term, Threshold, Variable};
pub use self::text::PatternTextError;
