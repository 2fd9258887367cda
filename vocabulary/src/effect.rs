//! An effect on the graph, compiled to edits.
//!
//! Semantics: the guards of `when` and the ranges of `forall` are evaluated in the snapshot before the effect. Deletes
//! come before adds, so that an add of the same token wins, as in PDDL. An assignment to a binary function adds its edge
//! and sets its attribute; `undefined` removes the edge. `increase`, `decrease` and the scalings start from the value in
//! the snapshot.

use std::sync::Arc;

use dsr::{AttributeId, Edit, HolderRef, Isometry3, LabelId, Mentions, NewValue, NodeRef, Snapshot};
use pddl::Span;
use pddl::model::{AssignOperator, Name, VariableId};

use crate::binding::{Binding, Datum};
use crate::condition::Condition;
use crate::formula::{Holder, Term};
use crate::number::{Number, mention_attribute};
use crate::scope::Scope;

/// Why an effect cannot be written now.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the fields are what the variant is about")]
pub enum EffectError {
    /// A variable is unbound, or bound to a value of another kind.
    #[error("`?{variable}` is unbound here")]
    Unbound { variable: Name },
    /// A number in the new value is undefined.
    #[error("the new value is undefined")]
    Undefined { span: Span },
}

/// A compiled effect of one schema.
#[derive(Debug, Clone)]
pub struct Effect {
    pub(crate) scope: Scope,
    pub(crate) updates: Vec<Update>,
}

/// One change, for each binding of its guard.
#[derive(Debug, Clone)]
pub(crate) struct Update {
    pub(crate) guard: Option<Condition>,
    pub(crate) change: Change,
    pub(crate) span: Span,
}

#[derive(Debug, Clone)]
pub(crate) enum Change {
    AddEdge { from: Term, label: LabelId, to: Term },
    RemoveEdge { from: Term, label: LabelId, to: Term },
    Set { holder: Holder, attribute: AttributeId, given: Given },
    Adjust { holder: Holder, attribute: AttributeId, operator: AssignOperator, by: Number },
    Clear { holder: Holder, attribute: AttributeId },
    SetTransform { parent: Term, child: Term, pose: VariableId },
    RemoveTransform { parent: Term, child: Term },
}

/// A new value.
#[derive(Debug, Clone)]
pub(crate) enum Given {
    Value(dsr::Value),
    Node(Term),
    /// The text or truth value that a variable is bound to.
    Result(VariableId),
    Number(Number),
}

impl Effect {
    /// The tokens that it reads or writes.
    pub fn mentions(&self) -> Mentions {
        let mut mentions = Mentions::default();
        for update in &self.updates {
            if let Some(guard) = &update.guard {
                mentions.extend(guard.mentions());
            }
            match &update.change {
                Change::Adjust { by: number, .. } | Change::Set { given: Given::Number(number), .. } => {
                    number.mention(&mut mentions);
                }
                _ => {}
            }
            match &update.change {
                Change::AddEdge { label, .. } | Change::RemoveEdge { label, .. } => {
                    mentions.add_label(*label);
                }
                Change::Set { holder, attribute, .. }
                | Change::Adjust { holder, attribute, .. }
                | Change::Clear { holder, attribute } => {
                    mention_attribute(holder, *attribute, &mut mentions);
                }
                Change::SetTransform { .. } | Change::RemoveTransform { .. } => mentions.add_transforms(),
            }
        }
        mentions
    }

    /// The edits for a binding of the schema's parameters and of the results that the effect uses.
    pub fn edits(&self, snapshot: &Snapshot, binding: &Binding) -> Result<Vec<Edit>, EffectError> {
        let mut deletes = Vec::new();
        let mut adds = Vec::new();
        for update in &self.updates {
            let bindings = match &update.guard {
                None => vec![binding.clone()],
                Some(guard) => guard.bindings(snapshot, binding),
            };
            for bound in &bindings {
                let writing = Writing { scope: &self.scope, snapshot, binding: bound };
                writing.change(update, &mut deletes, &mut adds)?;
            }
        }
        deletes.append(&mut adds);
        Ok(deletes)
    }
}

struct Writing<'a> {
    scope: &'a Scope,
    snapshot: &'a Snapshot,
    binding: &'a Binding,
}

impl Writing<'_> {
    fn change(
        &self,
        update: &Update,
        deletes: &mut Vec<Edit>,
        adds: &mut Vec<Edit>,
    ) -> Result<(), EffectError> {
        match &update.change {
            Change::AddEdge { from, label, to } => {
                adds.push(Edit::AddEdge { from: self.node(from)?, label: *label, to: self.node(to)? });
            }
            Change::RemoveEdge { from, label, to } => {
                deletes.push(Edit::RemoveEdge { from: self.node(from)?, label: *label, to: self.node(to)? });
            }
            Change::Set { holder, attribute, given } => {
                let value = self.given(given, update.span)?;
                self.set(holder, *attribute, value, adds)?;
            }
            Change::Adjust { holder, attribute, operator, by } => {
                let undefined = || EffectError::Undefined { span: update.span };
                let present = Number::Attribute(holder.clone(), *attribute);
                let old = present.value(self.snapshot, self.binding).ok_or_else(undefined)?;
                let by = by.value(self.snapshot, self.binding).ok_or_else(undefined)?;
                let new = adjusted(*operator, old, by).ok_or_else(undefined)?;
                self.set(holder, *attribute, NewValue::Number(new), adds)?;
            }
            Change::Clear { holder: Holder::Node(node), attribute } => {
                let holder = HolderRef::Node(self.node(node)?);
                deletes.push(Edit::ClearAttribute { holder, attribute: *attribute });
            }
            Change::Clear { holder: Holder::Edge { from, label, to }, .. } => {
                deletes.push(Edit::RemoveEdge { from: self.node(from)?, label: *label, to: self.node(to)? });
            }
            Change::SetTransform { parent, child, pose } => {
                let (parent, child, pose) = (self.node(parent)?, self.node(child)?, self.pose(*pose)?.into());
                adds.push(Edit::SetTransform { parent, child, pose });
            }
            Change::RemoveTransform { parent, child } => {
                deletes.push(Edit::RemoveTransform { parent: self.node(parent)?, child: self.node(child)? });
            }
        }
        Ok(())
    }

    fn set(
        &self,
        holder: &Holder,
        attribute: AttributeId,
        value: NewValue,
        adds: &mut Vec<Edit>,
    ) -> Result<(), EffectError> {
        let holder = match holder {
            Holder::Node(node) => HolderRef::Node(self.node(node)?),
            Holder::Edge { from, label, to } => {
                let (from, label, to) = (self.node(from)?, *label, self.node(to)?);
                adds.push(Edit::AddEdge { from: from.clone(), label, to: to.clone() });
                HolderRef::Edge { from, label, to }
            }
        };
        adds.push(Edit::SetAttribute { holder, attribute, value });
        Ok(())
    }

    fn given(&self, given: &Given, span: Span) -> Result<NewValue, EffectError> {
        Ok(match given {
            Given::Value(value) => value.clone().into(),
            Given::Node(node) => NewValue::Node(self.node(node)?),
            Given::Result(variable) => match self.binding.value(*variable) {
                Some(Datum::Value(value)) => value.clone().into(),
                _ => return Err(self.unbound(*variable)),
            },
            Given::Number(number) => {
                let value = number.value(self.snapshot, self.binding);
                NewValue::Number(value.ok_or(EffectError::Undefined { span })?)
            }
        })
    }

    fn node(&self, term: &Term) -> Result<NodeRef, EffectError> {
        match term {
            Term::Named(name) => Ok(NodeRef::Name(Arc::from(name.as_str()))),
            Term::Variable(variable) => {
                self.binding.node(*variable).map(NodeRef::Id).ok_or_else(|| self.unbound(*variable))
            }
        }
    }

    fn pose(&self, variable: VariableId) -> Result<Isometry3<f64>, EffectError> {
        match self.binding.value(variable) {
            Some(Datum::Pose(pose)) => Ok(*pose),
            _ => Err(self.unbound(variable)),
        }
    }

    fn unbound(&self, variable: VariableId) -> EffectError {
        EffectError::Unbound { variable: self.scope.slot(variable).name.clone() }
    }
}

fn adjusted(operator: AssignOperator, old: f64, by: f64) -> Option<f64> {
    let new = match operator {
        AssignOperator::Assign => by,
        AssignOperator::Increase => old + by,
        AssignOperator::Decrease => old - by,
        AssignOperator::ScaleUp => old * by,
        AssignOperator::ScaleDown => old / by,
    };
    new.is_finite().then_some(new)
}

/// Whether the edit would leave this snapshot unchanged. False for an edit that concerns no token, and for one that the
/// graph would refuse.
pub fn is_redundant(snapshot: &Snapshot, edit: &Edit) -> bool {
    let node = |node: &NodeRef| match node {
        NodeRef::Id(id) => Some(*id),
        NodeRef::Name(name) => snapshot.node(name),
    };
    let edge =
        |from: &NodeRef, label: LabelId, to: &NodeRef| Some(snapshot.has_edge(node(from)?, label, node(to)?));
    let value = |holder: &HolderRef, attribute: AttributeId| {
        let holder = match holder {
            HolderRef::Node(on) => dsr::Holder::Node(node(on)?),
            HolderRef::Edge { from, label, to } => {
                dsr::Holder::Edge(dsr::EdgeKey { from: node(from)?, label: *label, to: node(to)? })
            }
        };
        Some(snapshot.attribute(holder, attribute).cloned())
    };
    let parent =
        |child: &NodeRef| Some(snapshot.get(node(child)?)?.parent().map(|(id, pose, _)| (id, pose.clone())));
    match edit {
        Edit::AddEdge { from, label, to } => edge(from, *label, to) == Some(true),
        Edit::RemoveEdge { from, label, to } => edge(from, *label, to) == Some(false),
        Edit::SetAttribute { holder, attribute, value: new } => match (value(holder, *attribute), new) {
            (Some(Some(dsr::Value::Node(old))), NewValue::Node(new)) => node(new) == Some(old),
            (Some(Some(old)), new) => NewValue::from(old) == *new,
            _ => false,
        },
        Edit::ClearAttribute { holder, attribute } => value(holder, *attribute) == Some(None),
        Edit::SetTransform { parent: on, child, pose } => {
            parent(child) == Some(node(on).map(|on| (on, pose.clone())))
        }
        Edit::RemoveTransform { parent: on, child } => {
            parent(child).is_some_and(|found| found.is_none_or(|(id, _)| Some(id) != node(on)))
        }
        _ => false,
    }
}
