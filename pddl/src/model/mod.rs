//! The typed model: what a file means once every name is resolved.
//!
//! Problem: planners, validators and translators must not look at text. Idea: one plain data structure for
//! each kind of file. Names are interned per domain, every reference is a typed id, and every variable is a
//! slot of its schema. Invariant: a model exists only if its file had no errors, so ids are in range and
//! arities and types fit. Every node carries its span.
//!
//! Source: Fox & Long, "PDDL2.1", JAIR 2003; Kovacs, "BNF definition of PDDL 3.1", 2011; Höller et al.,
//! "HDDL", AAAI 2020. [`Domain`] and [`Rule`] describe the deviations (`:import`, `:writes`, outcomes of
//! rules).

mod action;
mod condition;
mod constraint;
mod domain;
mod effect;
mod expression;
mod fact;
mod feature;
mod htn;
mod ids;
mod index;
mod invariant;
mod name;
mod object;
mod preference;
mod problem;
mod process;
mod requirements;
mod term;
mod types;
mod variables;

pub use action::{
    Action, DurationConstraint, DurativeAction, Given, Rule, SkillCall, TimeSpecifier, TimedCondition,
    TimedEffect,
};
pub use condition::{Atom, Comparison, Condition, ConditionKind};
pub use constraint::{Constraint, ConstraintKind, Constraints};
pub use domain::{
    Axiom, DerivedFunction, DerivedValue, Domain, Function, FunctionValue, Permission, Predicate,
    TokenPattern, TokenSymbol,
};
pub use effect::{AssignOperator, AssignedValue, Effect, EffectKind};
pub use expression::{Application, ArithmeticOperator, Expression, ExpressionKind};
pub use fact::Fact;
pub use feature::Feature;
pub use htn::{CompoundTask, Method, Ordering, Subtask, SubtaskHead, TaskNetwork};
pub use ids::{
    ActionId, DurativeActionId, EventId, FunctionId, MethodId, ObjectId, PredicateId, ProcessId, TaskId,
    TypeId, VariableId,
};
pub use index::{Idx, IndexVec};
pub use invariant::{Invariant, Word};
pub use name::Name;
pub use object::{Extent, Object, ObjectTypes};
pub use preference::Preference;
pub use problem::{
    FluentFact, FluentValue, GroundApplication, Metric, Objective, Problem, TimedChange, TimedInitial,
};
pub use process::{ContinuousEffect, Direction, Event, FunctionTerm, Process};
pub use requirements::{Requirement, Requirements};
pub use term::Term;
pub use types::{Type, TypeSet, TypeTable};
pub use variables::{Variable, Variables};
