//! Rules: what an agent does when the graph looks so.
//!
//! Problem: Marfil et al. (§4.3) hand-code in each agent which subgraph makes it act and what it then writes.
//! Idea: a rule is a durative action. Its condition at start is the graph before; its effects at start are the
//! graph meanwhile; its condition over all must keep holding, or a reflex stops the skill in the same commit;
//! its effects at an outcome are the graph after. A rule is compiled once into patterns and edits.
//!
//! Semantics. A rule starts for a binding of its parameters when, in the present graph, its condition at start
//! holds and, in the graph after its effects at start, its condition over all holds: what must keep holding
//! may be what the rule itself begins. An outcome for which the rule writes no effects ends like `abort`, so
//! that nothing of the meanwhile is left behind; `end` never does.
//!
//! Source: Marfil et al., §3.2 and Fig. 3 ("states of the DSR after, during and before"); outcomes beside the
//! end, results, claims and priorities are ours.

mod compile;
mod error;
mod regress;

use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;
use std::time::Duration;

use dsr::{AgentId, Edit, Mentions, NodeId, Priority, Reflex, ResourceId, Snapshot};
use pddl::model::{Name, VariableId, Variables};
use vocabulary::{Binding, Condition, Effect, EffectError};

pub use self::compile::compile;
pub use self::error::{RuleError, RuleErrorKind};
use crate::skill::{Datum, Ended, Outcome, Skill};

/// The position of a rule in its agent.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct RuleId(usize);

/// The nodes that stand for a rule's parameters, in their order.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct Parameters(Vec<NodeId>);

/// An agent: a writer of the graph with its rules.
#[derive(Debug)]
pub struct Agent {
    /// Its name, as in the vocabulary.
    pub name: Name,
    /// Its identity as a writer.
    pub id: AgentId,
    /// Its rules, in the order of the file.
    rules: Vec<Rule>,
}

impl Agent {
    /// All rules' ids, in the order of the file.
    pub fn rule_ids(&self) -> impl Iterator<Item = RuleId> + use<> {
        (0..self.rules.len()).map(RuleId)
    }

    /// A rule's name.
    ///
    /// # Panics
    /// If the id is another agent's.
    pub fn rule_name(&self, id: RuleId) -> &Name {
        &self.rule(id).name
    }

    pub(crate) fn rule(&self, id: RuleId) -> &Rule {
        &self.rules[id.0]
    }

    pub(crate) fn enumerate(&self) -> impl Iterator<Item = (RuleId, &Rule)> {
        self.rules.iter().enumerate().map(|(index, rule)| (RuleId(index), rule))
    }
}

/// What an argument of a skill is.
#[derive(Debug, Clone)]
pub(crate) enum Argument {
    /// A parameter of the rule.
    Parameter(VariableId),
    /// A constant.
    Constant(Arc<str>),
}

/// A compiled rule.
pub(crate) struct Rule {
    pub(crate) name: Name,
    variables: Variables,
    /// What must hold before the start.
    trigger: Condition,
    /// What must hold from after the effects at start to the end.
    keep: Condition,
    start: Effect,
    outcomes: BTreeMap<Outcome, Effect>,
    results: Vec<VariableId>,
    pub(crate) skill: Option<(Arc<dyn Skill>, Vec<Argument>)>,
    pub(crate) claims: Vec<ResourceId>,
    pub(crate) priority: Priority,
    /// After this long the outcome is `timeout`.
    pub(crate) limit: Option<Duration>,
}

/// Why an ending cannot be written down.
#[derive(Debug, thiserror::Error)]
pub(crate) enum EndError {
    /// The skill named a node that is not there.
    #[error("the skill's result '{0}' is no node")]
    NoSuchNode(Arc<str>),
    /// The effects cannot be written as edits.
    #[error(transparent)]
    Effect(#[from] EffectError),
}

impl Rule {
    /// The tokens on which it depends whether the rule may start.
    pub(crate) fn mentions(&self) -> &Mentions {
        self.trigger.mentions()
    }

    /// The bindings for which the condition before holds, in the order of nodes.
    pub(crate) fn candidates(&self, snapshot: &Snapshot) -> Vec<Parameters> {
        let found = self.trigger.bindings(snapshot, &Binding::of(&self.variables));
        found
            .iter()
            .filter_map(|binding| self.variables.parameter_ids().map(|id| binding.node(id)).collect())
            .map(Parameters)
            .collect()
    }

    /// Whether the condition before holds for this binding.
    pub(crate) fn may_start(&self, snapshot: &Snapshot, parameters: &Parameters) -> bool {
        self.trigger.holds(snapshot, &self.binding(parameters))
    }

    /// Whether the condition over all holds for this binding.
    pub(crate) fn keeps(&self, snapshot: &Snapshot, parameters: &Parameters) -> bool {
        self.keep.holds(snapshot, &self.binding(parameters))
    }

    /// The effects at start.
    pub(crate) fn meanwhile(
        &self,
        snapshot: &Snapshot,
        parameters: &Parameters,
    ) -> Result<Vec<Edit>, EffectError> {
        self.start.edits(snapshot, &self.binding(parameters))
    }

    /// The reflex that stops the rule. What `abort` writes under a condition is decided now.
    pub(crate) fn reflex(
        &self,
        owner: AgentId,
        snapshot: &Snapshot,
        parameters: &Parameters,
    ) -> Result<Reflex, EffectError> {
        let binding = self.binding(parameters);
        let on_break = match self.outcomes.get(Outcome::ABORT) {
            Some(effect) => effect.edits(snapshot, &binding)?,
            None => Vec::new(),
        };
        let keep = if self.keep.is_always() { Vec::new() } else { vec![self.keep.keep(&binding)] };
        Ok(Reflex { owner, keep, on_break, leases: self.claims.clone() })
    }

    /// The effects at an ending.
    pub(crate) fn after(
        &self,
        snapshot: &Snapshot,
        parameters: &Parameters,
        ended: &Ended,
    ) -> Result<Vec<Edit>, EndError> {
        let name = ended.outcome.name();
        let effect = match self.outcomes.get(name) {
            Some(effect) => effect,
            None if name == Outcome::END || name == Outcome::NOTHING => return Ok(Vec::new()),
            None => match self.outcomes.get(Outcome::ABORT) {
                Some(effect) => effect,
                None => return Ok(Vec::new()),
            },
        };
        let mut binding = self.binding(parameters);
        for (&variable, datum) in self.results.iter().zip(&ended.results) {
            match datum {
                Datum::Node(name) => {
                    let node = snapshot.node(name).ok_or_else(|| EndError::NoSuchNode(Arc::clone(name)))?;
                    binding.bind(variable, node);
                }
                Datum::Pose(pose) => {
                    binding.bind_value(variable, vocabulary::Datum::Pose(*pose));
                }
            }
        }
        Ok(effect.edits(snapshot, &binding)?)
    }

    /// The name of the node that an argument of the skill is.
    pub(crate) fn argument(
        &self,
        argument: &Argument,
        snapshot: &Snapshot,
        parameters: &Parameters,
    ) -> Arc<str> {
        match argument {
            Argument::Parameter(variable) => {
                let node = self.binding(parameters).node(*variable);
                node.and_then(|node| snapshot.name(node)).unwrap_or_default().into()
            }
            Argument::Constant(name) => Arc::clone(name),
        }
    }

    fn binding(&self, parameters: &Parameters) -> Binding {
        let mut binding = Binding::of(&self.variables);
        for (variable, &node) in self.variables.parameter_ids().zip(&parameters.0) {
            binding.bind(variable, node);
        }
        binding
    }
}

impl fmt::Debug for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Rule")
            .field("name", &self.name)
            .field("claims", &self.claims)
            .field("priority", &self.priority)
            .field("limit", &self.limit)
            .field("outcomes", &self.outcomes.keys().collect::<Vec<_>>())
            .finish_non_exhaustive()
    }
}
