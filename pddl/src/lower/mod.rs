//! Tree to model: names, arities and types resolved, every error reported.
//!
//! Problem: one mistake must not hide the others, and a model must never be half right. Idea: each part of
//! the language has a file here that reads nodes ([`crate::syntax::Node`]), takes declarations from the
//! `World`, and reports errors to the `Sink`. Wrong parts become placeholders, and reading continues at the
//! next balanced list. The model is handed out only if there was no error. Cost: linear in the tree times
//! the depth of the type hierarchy.

mod action;
mod axiom;
mod body;
mod condition;
mod constants;
mod constraint;
mod continuous;
mod derived_function;
mod domain;
mod durative;
mod effect;
mod expression;
mod function_term;
mod functions;
mod header;
mod htn;
mod imports;
mod init;
mod invariant;
mod keys;
mod metric;
mod permissions;
mod plan;
mod predicates;
mod preference;
mod problem;
mod process;
mod requirements;
mod schema;
mod sink;
mod timed;
mod typed_list;
mod types;
mod world;

pub(crate) use domain::domain;
pub(crate) use plan::plan;
pub(crate) use problem::problem;
pub(crate) use sink::{Lowered, Sink};
