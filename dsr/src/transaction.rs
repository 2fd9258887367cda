//! Transactions: a list of edits by one writer that is applied as a whole or not at all.
//!
//! A transaction is plain data, made without the graph and checked at commit. To follow one from first to last, read
//! `commit` (the order of the stages), `apply` (one edit), `check` (its rules), then `crate::state::write` (written and
//! logged), `invariants` (the rules for the whole graph, with `tree` and `degree`), `reflexes`, and `crate::delta` (the
//! log as the published changes). `claim` writes leases.

mod apply;
mod check;
mod claim;
pub(crate) mod commit;
mod degree;
pub(crate) mod edit;
mod error;
pub(crate) mod invariants;
mod names;
pub(crate) mod reflexes;
mod tree;

use std::sync::Arc;

use serde::{Deserialize, Serialize};

pub use self::edit::{Edit, HolderRef};
pub use self::error::TransactionError;
use crate::id::{AgentId, AttributeId, Epoch, LabelId, ReflexId, ResourceId, Time, TypeId, Version};
use crate::lease::{Preemption, Priority};
use crate::pattern::{Pattern, PatternError, PatternSource};
use crate::pose::Pose;
use crate::reflex::Reflex;
use crate::value::{NewValue, NodeRef};
use crate::vocabulary::Vocabulary;

/// A list of edits by one writer. With `P` = [`PatternSource`] it is plain data, which [`Transaction::build`] compiles
/// for a vocabulary.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Transaction<P = Arc<Pattern>> {
    pub(crate) writer: AgentId,
    pub(crate) expected: Option<Version>,
    #[serde(default)]
    pub(crate) life: Option<(AgentId, Epoch)>,
    pub(crate) edits: Vec<Edit>,
    pub(crate) guards: Vec<Reflex<P>>,
    pub(crate) dismissed: Vec<ReflexId>,
}

impl Transaction<PatternSource> {
    /// Compiles the patterns of the transaction for a vocabulary.
    pub fn build(self, vocabulary: &Vocabulary) -> Result<Transaction, PatternError> {
        let Self { writer, expected, life, edits, guards, dismissed } = self;
        let guards = guards.into_iter().map(|guard| guard.build(vocabulary)).collect::<Result<_, _>>()?;
        Ok(Transaction { writer, expected, life, edits, guards, dismissed })
    }
}

impl Transaction {
    /// An empty transaction of this writer.
    pub fn new(writer: AgentId) -> Self {
        Self {
            writer,
            expected: None,
            life: None,
            edits: Vec::new(),
            guards: Vec::new(),
            dismissed: Vec::new(),
        }
    }

    /// The agent that writes.
    pub fn writer(&self) -> AgentId {
        self.writer
    }

    /// The edits so far.
    pub fn edits(&self) -> &[Edit] {
        &self.edits
    }

    /// Makes the commit fail if the graph is no longer at this version.
    pub fn expect_version(&mut self, version: Version) -> &mut Self {
        self.expected = Some(version);
        self
    }

    /// Makes the commit fail if this life of the agent is over. An agent that was declared dead and is not can then no
    /// longer interfere with its successor.
    pub fn in_epoch(&mut self, agent: AgentId, epoch: Epoch) -> &mut Self {
        self.life = Some((agent, epoch));
        self
    }

    /// Fails if `current` is not the expected version.
    pub(crate) fn stale_at(&self, current: Version) -> Result<(), TransactionError> {
        match self.expected {
            Some(expected) if expected != current => Err(TransactionError::Stale { expected, current }),
            _ => Ok(()),
        }
    }

    /// Appends an edit.
    pub fn push(&mut self, edit: Edit) -> &mut Self {
        self.edits.push(edit);
        self
    }

    /// Appends edits.
    pub fn extend(&mut self, edits: impl IntoIterator<Item = Edit>) -> &mut Self {
        self.edits.extend(edits);
        self
    }

    /// Adds a node.
    pub fn add_node(&mut self, name: impl Into<Arc<str>>, node_type: TypeId) -> &mut Self {
        self.push(Edit::AddNode { name: name.into(), node_type })
    }

    /// Removes a node with its edges, attributes and transforms, and with the attributes that refer to it.
    pub fn remove_node(&mut self, node: impl Into<NodeRef>) -> &mut Self {
        self.push(Edit::RemoveNode { node: node.into() })
    }

    /// Adds an edge.
    pub fn add_edge(
        &mut self,
        from: impl Into<NodeRef>,
        label: LabelId,
        to: impl Into<NodeRef>,
    ) -> &mut Self {
        self.push(Edit::AddEdge { from: from.into(), label, to: to.into() })
    }

    /// Removes an edge with its attributes.
    pub fn remove_edge(
        &mut self,
        from: impl Into<NodeRef>,
        label: LabelId,
        to: impl Into<NodeRef>,
    ) -> &mut Self {
        self.push(Edit::RemoveEdge { from: from.into(), label, to: to.into() })
    }

    /// Sets an attribute of a node or of an edge.
    pub fn set_attribute(
        &mut self,
        holder: impl Into<HolderRef>,
        attribute: AttributeId,
        value: impl Into<NewValue>,
    ) -> &mut Self {
        self.push(Edit::SetAttribute { holder: holder.into(), attribute, value: value.into() })
    }

    /// Removes an attribute.
    pub fn clear_attribute(&mut self, holder: impl Into<HolderRef>, attribute: AttributeId) -> &mut Self {
        self.push(Edit::ClearAttribute { holder: holder.into(), attribute })
    }

    /// Sets the pose of `child` in the frame of `parent`.
    pub fn set_transform(
        &mut self,
        parent: impl Into<NodeRef>,
        child: impl Into<NodeRef>,
        pose: impl Into<Pose>,
    ) -> &mut Self {
        self.push(Edit::SetTransform { parent: parent.into(), child: child.into(), pose: pose.into() })
    }

    /// Adds the pose of `child` in the frame of `parent` at a time.
    pub fn sample_transform(
        &mut self,
        parent: impl Into<NodeRef>,
        child: impl Into<NodeRef>,
        time: Time,
        pose: impl Into<Pose>,
    ) -> &mut Self {
        self.push(Edit::SampleTransform {
            parent: parent.into(),
            child: child.into(),
            time,
            pose: pose.into(),
        })
    }

    /// Removes the transform between `parent` and `child`.
    pub fn remove_transform(&mut self, parent: impl Into<NodeRef>, child: impl Into<NodeRef>) -> &mut Self {
        self.push(Edit::RemoveTransform { parent: parent.into(), child: child.into() })
    }

    /// Claims a lease.
    pub fn claim(&mut self, resource: ResourceId, priority: Priority, preemption: Preemption) -> &mut Self {
        self.push(Edit::Claim { resource, priority, preemption })
    }

    /// Claims a lease, or waits for it.
    pub fn await_lease(
        &mut self,
        resource: ResourceId,
        priority: Priority,
        preemption: Preemption,
    ) -> &mut Self {
        self.push(Edit::Await { resource, priority, preemption })
    }

    /// Releases a lease, or stops waiting for it.
    pub fn release(&mut self, resource: ResourceId) -> &mut Self {
        self.push(Edit::Release { resource })
    }

    /// Registers a reflex, which lives from this commit until it fires or is dismissed. Its id is in
    /// [`Commit::guards`](crate::Commit::guards), in the order of the calls.
    pub fn guard(&mut self, reflex: Reflex) -> &mut Self {
        self.guards.push(reflex);
        self
    }

    /// Ends a reflex of the writer and releases the leases with which it was registered. If it has fired, the whole
    /// transaction is rejected: the reflex has already undone what the transaction would conclude.
    pub fn dismiss(&mut self, reflex: ReflexId) -> &mut Self {
        self.dismissed.push(reflex);
        self
    }
}
