//! One rule: the graph before, meanwhile and after, as patterns and edits.
//!
//! Problem: Marfil et al. (§4.3) hand-code in each agent which subgraph makes it act and which edges it then writes.
//! Idea: a rule is a durative action. Its condition at start is the graph before; its effects at start are the
//! graph meanwhile; its condition over all must keep holding, or a reflex stops the skill in the same commit;
//! its effects at an outcome are the graph after. A rule is compiled once into patterns and edits.
//!
//! Semantics. A rule starts for a binding of its parameters when, in the present graph, its condition at start
//! holds and, in the graph after its effects at start, its condition over all holds. So the rule's own start may
//! establish its condition over all. An outcome for which the rule has no effects ends like `abort`, so
//! that no effect at start is left behind; `end` never does.
//!
//! Source: Marfil et al., §3.2 and Fig. 3 ("states of the DSR after, during and before"); outcomes beside the
//! end, results, claims and priorities are ours.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;
use std::time::Duration;

use dsr::{AgentId, Edit, Mentions, NodeId, Pattern, Priority, Reflex, ResourceId, Snapshot, Version};
use pddl::model::{Name, VariableId, Variables};
use vocabulary::{Binding, Condition, Effect, EffectError};

use crate::skill::{Datum, Ended, Outcome, Skill};

/// The nodes that stand for a rule's parameters, in their order.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct Parameters(Vec<NodeId>);

impl Parameters {
    pub(crate) fn nodes(&self) -> &[NodeId] {
        &self.0
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
    pub(super) variables: Variables,
    /// What must hold before the start.
    pub(super) trigger: Condition,
    /// What must hold from after the effects at start to the end.
    pub(super) keep: Condition,
    pub(super) start: Effect,
    /// The tokens on which it depends whether the condition over all holds after the effects at start, where that does
    /// not follow from the condition before.
    pub(super) unsure: Mentions,
    pub(super) outcomes: BTreeMap<Outcome, Effect>,
    pub(super) results: Vec<VariableId>,
    pub(crate) skill: Option<(Arc<dyn Skill>, Vec<Argument>)>,
    pub(crate) claims: Vec<ResourceId>,
    pub(crate) priority: Priority,
    /// After this time the outcome is `timeout`.
    pub(crate) limit: Option<Duration>,
}

/// Why the effects of an ending cannot be written.
#[derive(Debug, thiserror::Error)]
pub(crate) enum EndError {
    /// The skill named a node that does not exist.
    #[error("the skill's result '{0}' is no node")]
    NoSuchNode(Arc<str>),
    /// The effects cannot be written as edits.
    #[error(transparent)]
    Effect(#[from] EffectError),
}

impl Rule {
    /// The patterns of which each match is a binding for which the condition before holds.
    pub(crate) fn triggers(&self) -> impl Iterator<Item = &Arc<Pattern>> {
        self.trigger.alternatives().iter().map(vocabulary::Alternative::pattern)
    }

    /// The tokens of which every change may let the rule start, whatever matches its triggers. Empty for a rule whose
    /// condition over all follows from its condition before and its effects at start, as it does for most.
    pub(crate) fn unsure(&self) -> &Mentions {
        &self.unsure
    }

    /// The parameters in a match of a trigger; `None` if the trigger does not bind them all.
    pub(crate) fn parameters(&self, alternative: usize, matched: &dsr::Binding) -> Option<Parameters> {
        let alternative = self.trigger.alternatives().get(alternative)?;
        let node = |id: VariableId| {
            let (_, own) = alternative.variables().find(|(variable, _)| *variable == id)?;
            matched.get(own)
        };
        self.variables.parameter_ids().map(node).collect::<Option<_>>().map(Parameters)
    }

    /// Whether the condition before holds for this binding.
    pub(crate) fn may_start(&self, snapshot: &Snapshot, parameters: &Parameters) -> bool {
        self.trigger.holds(snapshot, &self.binding(parameters))
    }

    /// Since when a rule that has started is about what it is about: what must hold over all; without such a condition, what
    /// held before. The same when the rule starts again after the end of the process, if these tokens stand.
    pub(crate) fn since(&self, snapshot: &Snapshot, parameters: &Parameters) -> Option<Version> {
        let lasting = if self.keep.is_always() { &self.trigger } else { &self.keep };
        let keep = lasting.keep(&self.binding(parameters));
        keep.any.iter().filter_map(|bound| bound.pattern.since(snapshot, &bound.binding)).min()
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

    /// The reflex that stops the rule. Conditional effects of `abort` are decided now.
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
