//! Rules: from an agent's file to patterns and edits.
//!
//! Floors, from the ground up: `error`, `regress` → `rule` (one compiled rule) → `agent` (all rules, and the part of
//! the graph that they read) → `compile`.

mod agent;
mod compile;
mod error;
mod regress;
mod rule;

pub use agent::Agent;
pub(crate) use agent::{Concern, RuleId};
pub use compile::compile;
pub use error::{RuleError, RuleErrorKind};
pub(crate) use rule::{Parameters, Rule};
