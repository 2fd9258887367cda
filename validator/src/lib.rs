//! Plan validation by the semantics of PDDL, with an independent evaluator.
//!
//! The planner that finds a plan must not judge it. This crate therefore shares with it only
//! `pddl`'s typed model and `budget`'s counters: no grounding, no compiled operators. Conditions
//! and effects are read from the model, over one state that is changed in place.
//!
//! ```
//! use pddl::{Source, parse_domain, parse_plan, parse_problem};
//!
//! let domain = Source::new("d.pddl", "(define (domain d) (:predicates (lit))
//!     (:action light :parameters () :precondition (not (lit)) :effect (lit)))");
//! let domain = parse_domain(&domain, &[]).model.expect("a domain");
//! let problem = Source::new("p.pddl", "(define (problem p) (:domain d) (:init) (:goal (lit)))");
//! let problem = parse_problem(&problem, &domain).model.expect("a problem");
//! let plan = parse_plan(&Source::new("plan", "(light)"), &domain, &problem).model.expect("a plan");
//! let plan = plan.into_sequential().expect("no times and no tasks");
//!
//! let verdict = validator::validate(&domain, &problem, &plan);
//! assert!(verdict.is_valid());
//! ```
//!
//! From the ground up: `number` to `relation` (exact numbers, objects, atoms), `verdict` (the outcome, as data),
//! `state` and `scene`, `condition`, `axiom` and `effect` (what holds, what follows, what changes), `prepared` (a task),
//! `sequential`, `temporal` and `htn` (the three kinds of plans), [`Validator`] (the entry), `advice` ([`Repair`]),
//! `report` (text, JSON, HTML). The README has the whole map.

mod advice;
mod axiom;
mod cause;
mod condition;
mod curve;
mod demands;
mod effect;
mod evolution;
mod expression;
mod fraction;
mod htn;
mod number;
mod plan;
mod preference;
mod prepare;
mod prepared;
mod reads;
mod recorder;
mod relation;
mod report;
mod root;
mod scene;
mod sequential;
mod solve;
mod state;
mod temporal;
mod trace;
mod trajectory;
mod universe;
mod validator;
mod value;
mod verdict;
mod why;
mod work;

pub use advice::{AdviceLimits, Repair};
pub use cause::Cause;
pub use number::Number;
pub use plan::{PlanRef, StepIndex};
pub use prepared::Precision;
pub use report::html;
pub use report::{
    Finding, Place, Subject, VerdictRecord, Word, explain, show_application, show_atom, show_cause,
    show_diff, show_repair,
};
pub use trace::{Demand, Diff, FluentChange, Happening, Stretch, Trace, Watched};
pub use validator::{Validator, validate};
pub use value::{GroundAtom, Value};
pub use verdict::{
    Breach, ChangeFault, EffectFault, Failure, Feature, File, IllFormed, MetricValue, Near, NetworkFault,
    NumericFault, Operand, Parent, Shared, Shortfall, StepFault, Unsatisfied, Unsupported, Valid, Verdict,
    ViolatedPreference, Violations,
};
