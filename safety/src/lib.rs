//! Invariants as PDDL, held against every version of a graph.
//!
//! Problem: what a robot owes a person ("a call for help is acted upon within two seconds, whatever is broken") must be
//! checked in every run, not in the scenarios that somebody thought of, and must be readable by those who answer for it.
//! Idea: invariants are text, `(:invariant NAME :parameters (…) :says (…) :constraint …)`, with the trajectory
//! constraints of PDDL3 over the tokens of the graph. A [`Monitor`] reads the graph as any subscriber does, rewrites each
//! invariant to what is still open after each version, and reports the version that leaves nothing that could hold.
//!
//! ```
//! use dsr::{AgentId, Time};
//! use pddl::{Source, parse_domain, parse_problem};
//! use safety::{Invariants, Monitor};
//! use std::sync::Arc;
//! use vocabulary::Tokens;
//!
//! let ward = Source::new("ward.pddl", "(define (domain ward) (:requirements :typing :vocabulary)
//!     (:types person state - object) (:constants ringing heard - state)
//!     (:predicates (is ?p - person ?s - state)))");
//! let ward = parse_domain(&ward, &[]).model.expect("no errors");
//! let tokens = Tokens::new(&ward).expect("every token is binary");
//! let world = Source::new("world.pddl", "(define (problem world) (:domain ward)
//!     (:objects ann - person) (:init) (:goal (and)))");
//! let world = parse_problem(&world, &ward).model.expect("no errors");
//! let graph = tokens.populate(&[&world], Time(0)).expect("fits the vocabulary");
//!
//! let safety = Source::new("safety.pddl", "(define (domain ward-safety)
//!     (:requirements :typing :invariants) (:import ward)
//!     (:invariant bell-is-heard :parameters (?p - person)
//!       :says (the bell of ?p is heard within two seconds)
//!       :constraint (always-within 2 (is ?p ringing) (is ?p heard))))");
//! let safety = parse_domain(&safety, &[&ward]).model.expect("no errors");
//! let invariants = Invariants::new([&safety], &tokens).expect("made of tokens");
//!
//! let mut monitor = Monitor::new(Arc::new(invariants));
//! let mut subscription = graph.subscribe_to(monitor.interest(&graph.snapshot()));
//! let (ann, ringing) = (graph.snapshot().node("ann"), graph.snapshot().node("ringing"));
//! let is = tokens.label("is").expect("declared");
//! graph.edit(AgentId::DSR, Time(1_000_000_000), |tx| {
//!     tx.add_edge(ann.expect("there"), is, ringing.expect("there"));
//! }).expect("allowed");
//! while let Some(news) = subscription.try_recv() {
//!     assert!(monitor.changed(&news).is_empty());
//! }
//! let broken = monitor.passed(Time(4_000_000_000));
//! assert_eq!(broken[0].says, "the bell of ann is heard within two seconds");
//! assert_eq!(broken[0].time, Time(3_000_000_000));
//! ```
//!
//! Map, from the ground up: `error`, `formula` (an invariant without text) → `compile` → `invariants` → `facts` (what
//! holds now) → `residue` (what is left of a formula) → `broken` → `monitor`.

#![forbid(unsafe_code)]

mod broken;
mod compile;
mod error;
mod facts;
mod formula;
mod invariants;
mod monitor;
mod residue;

pub use broken::{Broken, Cause};
pub use error::{Error, ErrorKind};
pub use invariants::Invariants;
pub use monitor::Monitor;
