//! HighToLow: a high-level action refined into intentions on the graph.
//!
//! A step of the plan names a task of the mission's `methods.hddl`. [`Methods`] is that file, compiled. A [`Refinement`]
//! executes one task at run time: it chooses a method whose precondition holds in the graph *now*, and decomposes the
//! task into *intentions*. An intention has edits that PELEA writes, an expectation that must be seen in the graph, a
//! condition that must hold meanwhile, and a deadline. It is done only when its expectation is seen. When an intention
//! fails, the refinement tries the next method.
//!
//! ```
//! use dsr::{AgentId, Time};
//! use high_to_low::{Methods, Moment, Refinement, Status};
//! use pddl::{Source, parse_domain, parse_problem};
//! use vocabulary::Tokens;
//!
//! let words = Source::new("words", "(define (domain words) (:requirements :typing :vocabulary)
//!     (:types lamp state - object) (:constants wanted lit - state)
//!     (:predicates (is ?l - lamp ?s - state)))");
//! let words = parse_domain(&words, &[]).model.unwrap();
//! let tokens = Tokens::new(&words).unwrap();
//! let world = Source::new("w", "(define (problem w) (:domain words) (:objects l - lamp) (:init) (:goal (and)))");
//! let world = parse_problem(&world, &words).model.unwrap();
//! let graph = tokens.populate(&[&world], Time(0)).unwrap();
//!
//! let methods = Source::new("m", "(define (domain m) (:requirements :typing :durative-actions :hierarchy)
//!     (:import words)
//!     (:durative-action want :parameters (?l - lamp) :duration (<= ?duration 5)
//!        :effect (and (at start (is ?l wanted)) (at end (is ?l lit))))
//!     (:task light :parameters (?l - lamp))
//!     (:method by-wanting :parameters (?l - lamp) :task (light ?l) :ordered-subtasks (want ?l)))");
//! let methods = parse_domain(&methods, &[&words]).model.unwrap();
//! let methods = Methods::new(&methods, &tokens).unwrap();
//!
//! let mut light = Refinement::new(&methods, &graph.snapshot(), "light", &[pddl::model::Name::new("l")]).unwrap();
//! let step = light.step(&methods, &graph.snapshot(), Moment::at(Time(0)));
//! assert_eq!(step.edits.len(), 1); // the intention
//! assert!(matches!(step.status, Status::Running { .. })); // nothing is lit yet
//! ```
//!
//! Map, from the ground up: `ground` (a task with its arguments), `library` (methods.hddl, compiled) → `failure` (why a
//! task failed), `event` (what a refinement did) → `turn`, `intention` (one primitive on its way) → `refinement` (the tree of
//! tasks) → `wording` (events and failures as sentences).
//!
//! Source: refinement acting, Ghallab, Nau & Traverso, "Automated Planning and Acting", 2016, §3.2 (RAE);
//! HighToLow, §4.2 of the CORTEX/CLARC paper.

mod event;
mod failure;
mod ground;
mod intention;
mod library;
mod refinement;
mod turn;
mod wording;

pub use event::RefinementEvent;
pub use failure::{Failure, Reason, StartError};
pub use ground::GroundTask;
pub use library::{Methods, MethodsError};
pub use refinement::{Refinement, Status, Step};
pub use turn::Moment;
