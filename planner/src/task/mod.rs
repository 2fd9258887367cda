//! The grounded task: facts, operators, axioms, an initial state and a goal.
//!
//! Problem: a search must not read schemas or names. Idea: changing atoms became numbered facts,
//! and actions became operators over sets of facts. The structures that serve every query on the
//! task (successor tree, relaxation, axiom program) are built once, so a replan needs only a state
//! and a goal. Invariant: a [`State`] that a task creates is closed under its axioms.

mod atoms;
mod axioms;
mod blocks;
mod cliques;
mod domination;
mod fact;
mod fluents;
mod goal;
mod grounded;
mod literals;
mod metric;
mod mutexes;
mod names;
mod naming;
mod numeric;
mod operator;
mod operators;
mod packing;
mod quality;
mod regression;
mod relax;
mod relaxation;
mod repetition;
mod rows;
mod sort;
mod state;
mod successors;
mod values;
mod ways;

pub(crate) use atoms::{AtomTable, RowKeys};
pub use axioms::AxiomRule;
pub(crate) use axioms::{AxiomProgram, NoProgram};
pub use blocks::{ConditionalEffect, ConditionalEffects};
pub(crate) use cliques::ALONE;
pub(crate) use domination::undominated;
pub use fact::{AtomStatus, Fact, GroundAtom, ObjectValue};
pub use goal::{Goal, Impossible};
pub use grounded::Task;
pub use literals::{Literals, LiteralsRef};
pub(crate) use metric::{Metric, Tally};
pub(crate) use mutexes::variables;
pub use mutexes::{Mutexes, Variable};
pub(crate) use names::Names;
pub(crate) use numeric::{Fluent, Numeric, NumericEffects, Update, changed};
pub use operator::Operator;
pub(crate) use operators::NewOperator;
pub use operators::Operators;
pub(crate) use packing::Packing;
pub(crate) use regression::Kernel;
pub use regression::Suffixes;
pub(crate) use relaxation::{AXIOM, Relaxation};
pub(crate) use repetition::Way;
pub(crate) use rows::Rows;
pub use state::State;
pub(crate) use state::{contains, for_each_set, set, unset};
pub(crate) use successors::SuccessorTree;
pub(crate) use values::ValuePredicates;
