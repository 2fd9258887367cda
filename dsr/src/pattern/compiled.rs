//! A compiled pattern: everything that matching needs, computed once.

use std::ops::Deref;
use std::sync::Arc;

use serde::{Deserialize, Serialize, Serializer};

use super::measure::End;
use super::part::Part;
use super::plan::Step;
use super::seed::Seedling;
use super::slot::Slot;
use super::source::{Conjunction, PatternSource};
use super::term::{Scope, Variable};
use crate::id::{NodeId, TypeId};
use crate::mentions::Mentions;
use crate::state::State;

#[derive(Debug, Clone)]
pub(super) enum Constant {
    Node(NodeId),
    Named(Arc<str>),
}

impl Serialize for Pattern {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.source.serialize(serializer)
    }
}

/// A compiled pattern. Written by serde as its [`PatternSource`].
#[derive(Debug, Clone)]
pub struct Pattern {
    pub(super) source: Arc<PatternSource>,
    /// The names and types of the top-level variables, which have the first slots.
    pub(super) variables: Vec<(Arc<str>, TypeId)>,
    /// The types of the local variables, which have the next slots.
    pub(super) locals: Vec<TypeId>,
    /// The constants, which have the last slots.
    pub(super) constants: Vec<Constant>,
    pub(super) body: Conjunction<Slot>,
    /// The seeds, from which joins begin after a change.
    pub(super) seeds: Vec<Seedling>,
    /// The ends of each metric, from which joins begin after a move.
    pub(super) measured: Vec<[End; 2]>,
    /// The negated parts that can be judged by the frames that have moved.
    pub(super) parts: Vec<Part>,
    /// The join order when no variable is fixed.
    pub(super) plan: Vec<Step>,
    /// The join order when all variables are.
    pub(super) judgement: Vec<Step>,
    pub(super) mentions: Mentions,
    /// Whether some threshold has hysteresis.
    pub(super) remembers: bool,
}

impl Pattern {
    /// The names and types of the variables, in the order of a [`Binding`].
    pub fn variables(&self) -> impl Iterator<Item = (&str, TypeId)> + '_ {
        self.variables.iter().map(|(name, node_type)| (&**name, *node_type))
    }

    /// The position of a variable in a match; `None` for a local variable or one of another pattern.
    pub(super) fn place_of(&self, variable: Variable) -> Option<usize> {
        variable.position().filter(|&at| at < self.variables.len())
    }

    /// Whether a match has a node for the variable.
    pub(crate) fn gives(&self, variable: Variable) -> bool {
        self.place_of(variable).is_some()
    }

    /// The pattern as it was written.
    pub fn source(&self) -> &Arc<PatternSource> {
        &self.source
    }

    /// The variable of that name.
    pub fn variable(&self, name: &str) -> Option<Variable> {
        let at = self.variables.iter().position(|(variable, _)| **variable == *name)?;
        Some(Variable { scope: Scope::Top, index: u16::try_from(at).ok()? })
    }

    /// The tokens on which the matches depend: a delta that changes none of them changes no match.
    pub fn mentions(&self) -> &Mentions {
        &self.mentions
    }

    /// The nodes of the constants in a state; [`NodeId::NOWHERE`] for a name that no node has.
    pub(super) fn constants_in(&self, state: &State) -> impl Iterator<Item = NodeId> {
        self.constants.iter().map(move |constant| match constant {
            Constant::Node(id) => *id,
            Constant::Named(name) => state.names.get(name).unwrap_or(NodeId::NOWHERE),
        })
    }

    /// The node of a slot in a state, if the slot is a constant.
    pub(super) fn constant(&self, slot: Slot, state: &State) -> Option<NodeId> {
        let at = usize::from(slot.0).checked_sub(self.variables.len() + self.locals.len())?;
        self.constants.get(at).map(|constant| match constant {
            Constant::Node(id) => *id,
            Constant::Named(name) => state.names.get(name).unwrap_or(NodeId::NOWHERE),
        })
    }

    /// The names of the nodes that are constants of the pattern.
    pub(crate) fn names(&self) -> impl Iterator<Item = &std::sync::Arc<str>> {
        self.constants.iter().filter_map(|constant| match constant {
            Constant::Named(name) => Some(name),
            Constant::Node(_) => None,
        })
    }

    /// The slot of a top-level variable.
    pub(super) fn variable_slot(&self, at: usize) -> Slot {
        slot(at)
    }

    pub(super) fn type_of(&self, slot: Slot) -> Option<TypeId> {
        let at = usize::from(slot.0);
        match self.variables.get(at) {
            Some((_, id)) => Some(*id),
            None => self.locals.get(at - self.variables.len()).copied(),
        }
    }
}

pub(super) fn slot(index: usize) -> Slot {
    Slot(u8::try_from(index).expect("a compiled pattern has at most 64 slots"))
}

/// One match: a node for each variable, in the order in which they were declared.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Binding(pub(super) Vec<NodeId>);

impl Binding {
    /// The node of a variable; `None` for a local of a negated part.
    pub fn get(&self, variable: Variable) -> Option<NodeId> {
        self.0.get(variable.position()?).copied()
    }
}

impl From<Vec<NodeId>> for Binding {
    fn from(nodes: Vec<NodeId>) -> Self {
        Self(nodes)
    }
}

impl Deref for Binding {
    type Target = [NodeId];

    fn deref(&self) -> &[NodeId] {
        &self.0
    }
}
