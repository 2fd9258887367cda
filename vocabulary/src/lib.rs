//! PDDL read as graph: vocabulary, conditions as patterns, effects as edits.
//!
//! Problem: the robot's vocabulary, the agents' rules, the methods and the perception of every test are PDDL, but the
//! world is a graph of binary tokens. Idea: this crate alone translates one into the other. [`Tokens`] is a domain read
//! as a [`dsr::Vocabulary`]. A [`Link`] compiles the schemas of a domain that imports it: a condition becomes patterns
//! ([`Condition`]), an effect becomes edits ([`Effect`]), and the expectation of an effect is the condition under which
//! the effect can be *seen*.
//!
//! ```
//! use dsr::{AgentId, Time};
//! use pddl::{Source, parse_domain, parse_problem};
//! use vocabulary::{Binding, Tokens};
//!
//! let words = Source::new("words.pddl", "(define (domain words) (:requirements :typing :vocabulary)
//!     (:types robot state - object) (:constants speaking - state)
//!     (:predicates (is ?r - robot ?s - state)))");
//! let words = parse_domain(&words, &[]).model.expect("no errors");
//! let tokens = Tokens::new(&words).expect("every token is binary");
//!
//! let world = Source::new("world.pddl", "(define (problem world) (:domain words)
//!     (:objects clarc - robot) (:init (is clarc speaking)) (:goal (and)))");
//! let world = parse_problem(&world, &words).model.expect("no errors");
//! let graph = tokens.populate(&[&world], Time(0)).expect("fits the vocabulary");
//!
//! let rules = Source::new("rules.pddl", "(define (domain rules) (:requirements :typing) (:import words)
//!     (:action hush :parameters (?r - robot) :precondition (is ?r speaking)
//!         :effect (not (is ?r speaking))))");
//! let rules = parse_domain(&rules, &[&words]).model.expect("no errors");
//! let hush = rules.actions.iter().next().expect("there is one");
//!
//! let link = tokens.link(&rules);
//! let before = link.condition(&hush.variables, [&hush.precondition]).expect("made of tokens");
//! let effect = link.effect(&hush.variables, [&hush.effect]).expect("made of tokens");
//! let snapshot = graph.snapshot();
//! let who = before.bindings(&snapshot, &Binding::of(&hush.variables)).remove(0);
//! graph.edit(AgentId::DSR, Time(1), |tx| {
//!     tx.extend(effect.edits(&snapshot, &who).expect("all bound"));
//! }).expect("allowed");
//! let why = before.why_not(&graph.snapshot(), &who).expect("no longer");
//! assert_eq!(why.to_string(), "clarc is not speaking");
//! ```
//!
//! Map, from the ground up: `located` (errors with places), `pose` → `tokens` (the names) → `token_error`,
//! `declarations`, `permission` (reading them) → `populate` (the initial graph) → `formula`, `scope`, `disjuncts`,
//! `number`, `binding`, `link_error`, `translate` (conditions as logic over tokens) → `alternative`, `condition` (as
//! patterns) → `effect`, `lower_effect`, `expectation` (effects as edits) → `sentence`, `unmet` (conditions in words) →
//! `link` (where importing domains enter).

mod alternative;
mod binding;
mod condition;
mod declarations;
mod disjuncts;
mod effect;
mod expectation;
mod formula;
mod link;
mod link_error;
mod located;
mod lower_effect;
mod number;
mod permission;
mod populate;
mod pose;
mod scope;
mod sentence;
mod token_error;
mod tokens;
mod translate;
mod unmet;

pub use alternative::Alternative;
pub use binding::{Binding, Datum};
pub use condition::Condition;
pub use disjuncts::{Conjunction, MAX_ALTERNATIVES};
pub use effect::{Effect, EffectError, is_redundant};
pub use formula::{Formula, Holder, Literal, Right, Term};
pub use link::Link;
pub use link_error::{LinkError, LinkErrorKind};
pub use located::Located;
pub use populate::{PopulateError, PopulateErrorKind};
pub use pose::PoseComponent;
pub use scope::{Scope, Slot};
pub use sentence::{Sentence, Speaker};
pub use token_error::{TokenError, TokenErrorKind};
pub use tokens::{FunctionToken, Sort, Tokens, ValueSort};
pub use unmet::Unmet;
