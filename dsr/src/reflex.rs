//! Reflexes: edits made in the very commit that breaks a condition of a running activity.
//!
//! Problem: a robot goes on speaking to an empty chair until its planner notices. Idea: an activity registers with the
//! graph the conditions that must keep holding, and the edits to make when one no longer holds. Each commit, before it
//! is published, lets the broken reflexes write as their owners. So no version shows the person gone and the robot
//! still speaking.
//!
//! This file says what a reflex is; `transaction::reflexes` registers and fires them.
//!
//! Source: the agents' "grammar" of Marfil et al., §3.2 and §4.3; the authors leave this to each agent.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::id::{AgentId, NodeId, ResourceId};
use crate::pattern::{Pattern, PatternError, PatternSource, Variable};
use crate::state::State;
use crate::transaction::edit::Edit;
use crate::vocabulary::Vocabulary;

/// A pattern with nodes for some of its variables. With `P` = [`PatternSource`] it is plain data, and so are [`Keep`]
/// and [`Reflex`].
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Bound<P = Arc<Pattern>> {
    /// The pattern.
    pub pattern: P,
    /// The fixed variables.
    pub binding: Vec<(Variable, NodeId)>,
}

/// A condition that must keep holding: at least one of the alternatives has a match.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Keep<P = Arc<Pattern>> {
    /// The alternatives.
    pub any: Vec<Bound<P>>,
}

impl From<Bound> for Keep {
    fn from(bound: Bound) -> Self {
        Self { any: vec![bound] }
    }
}

impl Keep {
    pub(crate) fn holds(&self, state: &State) -> bool {
        self.any.iter().any(|bound| bound.pattern.holds_in(state, &bound.binding))
    }
}

/// A reflex of an activity.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Reflex<P = Arc<Pattern>> {
    /// The agent of the activity, which must be the writer of the transaction that registers the reflex.
    pub owner: AgentId,
    /// The conditions, all of which must keep holding.
    pub keep: Vec<Keep<P>>,
    /// The edits to make when one no longer holds. An edit that names a removed node is left out; if another one is
    /// rejected, none is made. They may not claim or await a lease.
    pub on_break: Vec<Edit>,
    /// Leases that the activity needs. Losing one breaks the reflex; when it fires or is dismissed, it releases them.
    pub leases: Vec<ResourceId>,
}

impl Reflex<PatternSource> {
    /// Compiles the patterns of the reflex for a vocabulary.
    pub fn build(self, vocabulary: &Vocabulary) -> Result<Reflex, PatternError> {
        let bound = |Bound { pattern, binding }: Bound<PatternSource>| {
            let pattern = Arc::new(pattern.build(vocabulary)?);
            match binding.iter().find(|(variable, _)| !pattern.gives(*variable)) {
                Some((variable, _)) => Err(PatternError::OutOfScope { variable: *variable }),
                None => Ok(Bound { pattern, binding }),
            }
        };
        let keep = |keep: Keep<PatternSource>| {
            Ok(Keep { any: keep.any.into_iter().map(bound).collect::<Result<_, PatternError>>()? })
        };
        let Self { owner, keep: kept, on_break, leases } = self;
        Ok(Reflex {
            owner,
            keep: kept.into_iter().map(keep).collect::<Result<_, PatternError>>()?,
            on_break,
            leases,
        })
    }
}
