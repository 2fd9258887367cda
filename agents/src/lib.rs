//! The rule runtime and the skills of the reactive agents.
//!
//! An agent does not receive commands. It watches its part of the graph, and when that looks like the *before* of one of
//! its rules, it makes it look like the *during*, runs a skill on a device, and makes it look like the *after*.
//! Everything it does is in its file of rules; nothing in this crate knows a test, a sentence or an item.
//!
//! ```
//! use agents::{Runtime, compile, skills};
//! use dsr::Time;
//! use pddl::{Source, parse_domain, parse_problem};
//! use vocabulary::Tokens;
//!
//! let words = Source::new("lab.pddl", "(define (domain lab) (:requirements :typing :vocabulary)
//!     (:types symbol agent resource - object  robot wish - symbol)
//!     (:constants speech - agent)
//!     (:predicates (wants ?r - robot ?w - wish) (says ?r - robot ?w - wish))
//!     (:writes speech says wants))");
//! let words = parse_domain(&words, &[]).model.expect("no errors");
//! let vocabulary = Tokens::new(&words).expect("every token is binary");
//! let rules = Source::new("speech.pddl", "(define (domain speech)
//!     (:requirements :typing :durative-actions :agent-rules) (:import lab)
//!     (:durative-action say
//!       :parameters (?r - robot ?w - wish)
//!       :condition (over all (wants ?r ?w))
//!       :effect (and (at start (says ?r ?w)) (at end (not (says ?r ?w))) (at end (not (wants ?r ?w)))
//!                    (at abort (not (says ?r ?w))))
//!       :skill (say ?r ?w)))");
//! let rules = parse_domain(&rules, &[&words]).model.expect("no errors");
//! let agent = compile(&rules, &vocabulary, &skills::standard()).expect("no mistakes");
//!
//! let world = Source::new("world.pddl", "(define (problem world) (:domain lab)
//!     (:objects clarc - robot  tea - wish) (:init (wants clarc tea)) (:goal (and)))");
//! let world = parse_problem(&world, &words).model.expect("no errors");
//! let graph = vocabulary.populate(&[&world], Time(0)).expect("fits the vocabulary");
//!
//! let mut subscription = graph.subscribe_to(agent.interest());
//! let mut runtime = Runtime::new(agent.into());
//! runtime.changed(&subscription.try_recv().expect("the start is news"));
//! let agents::Action::Commit(start) = runtime.next_action(&graph.snapshot(), Time(1)).expect("a rule matches")
//!     else { panic!() };
//! let commit = graph.commit(&start, Time(1));
//! runtime.committed(commit.as_ref(), Time(1));
//! assert_eq!(graph.snapshot().sentences(), ["clarc wants tea", "clarc says tea"]);
//! let next = runtime.next_action(&graph.snapshot(), Time(1));
//! assert!(matches!(next, Some(agents::Action::Launch { .. })));
//! ```
//!
//! Map, from the ground up: `words` (what the caller hands in) → `skill` (what a skill is), [`skills`] (a file each) →
//! `rules` (rules compiled to patterns and edits, and the agent's part of the graph) → `runtime` (the pure state
//! machine) → `shell` (the driver over the real graph, clock and devices).
//!
//! **Invariant:** the agents never know the executive. They meet in the graph.

pub mod skills;

mod rules;
mod runtime;
mod shell;
mod skill;
mod words;

pub use rules::{Agent, RuleError, RuleErrorKind, compile};
pub use runtime::{Action, InstanceId, Rest, Runtime};
pub use shell::{Absence, Clock, Environment, Housing, TokioClock, run_all};
pub use skill::{Call, Datum, DatumKind, Ended, Equipment, Outcome, Signature, Skill, Skills, Work};
pub use words::{Reporter, Words};
