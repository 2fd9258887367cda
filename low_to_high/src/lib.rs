//! LowToHigh: from binary tokens and metric attributes to n-ary predicates.
//!
//! Problem: the graph says `introduction was said in feeding`; the planner plans with `(introduced feeding)`. Idea: a
//! test's `perception.pddl` derives the second from the first by axioms. [`Perception`] is that file, compiled.
//! [`LowToHigh`] keeps the derived facts up to date, delta by delta, and explains which tokens support a fact or are
//! missing for it.
//!
//! ```
//! use std::sync::Arc;
//! use dsr::{AgentId, Time};
//! use low_to_high::{LowToHigh, Perception};
//! use pddl::{Source, parse_domain, parse_problem};
//! use vocabulary::Tokens;
//!
//! let read = |text: &str, imports: &[&_]| parse_domain(&Source::new("", text), imports).model.expect("no errors");
//! let words = read("(define (domain words) (:requirements :typing :vocabulary)
//!     (:types robot person - object) (:predicates (is_with ?p - person ?r - robot)))", &[]);
//! let planning = read("(define (domain test) (:requirements :typing)
//!     (:types person - object) (:predicates (present ?p - person)))", &[]);
//! let perception = read("(define (domain seen) (:requirements :adl :derived-predicates) (:import words test)
//!     (:derived (present ?p - person) (exists (?r - robot) (is_with ?p ?r))))", &[&words, &planning]);
//! let world = Source::new("", "(define (problem world) (:domain words)
//!     (:objects clarc - robot ann - person) (:init) (:goal (and)))");
//! let world = parse_problem(&world, &words).model.expect("no errors");
//!
//! let tokens = Tokens::new(&words).expect("every token is binary");
//! let graph = tokens.populate(&[&world], Time(0)).expect("fits the vocabulary");
//! let perception = Perception::new(&perception, &tokens).expect("made of tokens");
//! let mut seen = LowToHigh::new(Arc::new(perception), &graph.snapshot());
//! assert_eq!(seen.facts().count(), 0);
//!
//! let is_with = tokens.label("is_with").expect("declared");
//! let commit = graph.edit(AgentId::DSR, Time(1), |tx| { tx.add_edge("ann", is_with, "clarc"); }).expect("allowed");
//! let change = seen.update(&commit.snapshot, &commit.delta);
//! assert_eq!(change.appeared[0].to_string(), "(present ann)");
//! assert_eq!(seen.explain(&commit.snapshot, &change.appeared[0]), ["ann is with clarc"]);
//! ```
//!
//! Map, from the ground up: `fact` → `axiom`, `strata`, `perception_error`, `measure`, `perception` (the file, compiled) → `relations` (the derived
//! facts), `query` (matching a body) → `touched` (the heads that a delta can change) → `low_to_high` → `explain`.

mod axiom;
mod explain;
mod fact;
mod low_to_high;
mod measure;
mod perception;
mod perception_error;
mod query;
mod relations;
mod strata;
mod touched;

pub use explain::Explanation;
pub use fact::{Change, Fact, Fluent};
pub use low_to_high::LowToHigh;
pub use perception::{Perception, Role};
pub use perception_error::{PerceptionError, PerceptionErrorKind};
