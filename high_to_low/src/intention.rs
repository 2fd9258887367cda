//! One intention under way: waiting, written, seen or failed.
//!
//! Invariant: an intention is done when its expectation holds in a version *later* than the one on which it was written,
//! or at once if no edit was necessary. If its `at end` effects include a token that its `at start` edits make false, a
//! fact that is left over from an earlier intention never counts.

use crate::event::RefinementEvent;
use crate::failure::Reason;
use crate::ground::GroundTask;
use crate::library::{Intention, Methods};
use crate::turn::Turn;
use dsr::{Edit, HolderRef, NodeId, NodeRef, Snapshot, Time, Version};
use pddl::model::Idx;
use vocabulary::{Binding, Unmet, is_redundant};

/// An intention with its arguments.
#[derive(Clone, Debug)]
pub(crate) struct Activity {
    intention: usize,
    binding: Binding,
    ground: GroundTask,
    /// When it fails.
    deadline: Option<Time>,
    state: State,
}

#[derive(Clone, Debug)]
enum State {
    /// Its precondition does not hold yet.
    Waiting,
    /// Written on this version.
    Written { on: Option<Version>, edits: Vec<Edit> },
}

/// The state of an intention after a turn.
pub(crate) enum Standing {
    Running,
    Seen,
    Failed(Reason),
}

impl Activity {
    pub(crate) fn new(
        methods: &Methods,
        intention: usize,
        arguments: &[NodeId],
        ground: GroundTask,
        now: Time,
    ) -> Self {
        let compiled = &methods.intentions[intention];
        let mut binding = Binding::of(&compiled.variables);
        for (i, &node) in arguments.iter().enumerate() {
            binding.bind(Idx::from_index(i), node);
        }
        let deadline = compiled.deadline.map(|seconds| after(now, seconds));
        Self { intention, binding, ground, deadline, state: State::Waiting }
    }

    /// Advances it as far as the graph allows.
    pub(crate) fn step(&mut self, methods: &Methods, turn: &mut Turn<'_>) -> Standing {
        let compiled = &methods.intentions[self.intention];
        if matches!(self.state, State::Waiting) {
            if !compiled.before.holds(turn.snapshot, &self.binding) {
                return self.wait(turn, |unmet, intention| Reason::NotBegun { intention, unmet }, compiled);
            }
            if let Err(reason) = self.write(compiled, turn) {
                return Standing::Failed(reason);
            }
        }
        let State::Written { on, .. } = &self.state else { return Standing::Running };
        let later = on.is_none_or(|version| turn.snapshot.version() > version);
        if later && compiled.expects.holds(turn.snapshot, &self.binding) {
            turn.events.push(RefinementEvent::Seen { intention: self.ground.clone() });
            return Standing::Seen;
        }
        if later && let Some(unmet) = compiled.keep.why_not(turn.snapshot, &self.binding) {
            self.withdraw(turn.snapshot, turn.edits);
            return self.fail(turn, Reason::Broken { intention: self.ground.clone(), unmet });
        }
        let seconds = compiled.deadline.unwrap_or_default();
        self.wait(turn, |unmet, intention| Reason::Missed { intention, seconds, unmet }, compiled)
    }

    /// Writes its edits, except those that would not change the graph.
    fn write(&mut self, compiled: &Intention, turn: &mut Turn<'_>) -> Result<(), Reason> {
        let edits = compiled
            .writes
            .edits(turn.snapshot, &self.binding)
            .map_err(|error| Reason::NoEdits { intention: self.ground.clone(), error })?;
        let edits = net(edits, turn.snapshot);
        let on = (!edits.is_empty()).then(|| turn.snapshot.version());
        if on.is_some() {
            turn.events.push(RefinementEvent::Written { intention: self.ground.clone() });
        }
        turn.edits.extend(edits.iter().cloned());
        self.state = State::Written { on, edits };
        Ok(())
    }

    /// Waits on, unless the deadline has passed.
    fn wait(
        &mut self,
        turn: &mut Turn<'_>,
        reason: impl FnOnce(Option<Unmet>, GroundTask) -> Reason,
        compiled: &Intention,
    ) -> Standing {
        match self.deadline {
            Some(deadline) if turn.moment.seen > deadline => {
                let written = matches!(self.state, State::Written { .. });
                let awaited = if written { &compiled.expects } else { &compiled.before };
                let unmet = awaited.why_not(turn.snapshot, &self.binding);
                self.withdraw(turn.snapshot, turn.edits);
                // An intention that was never written doubts no device.
                if written && let Ok(edits) = compiled.on_timeout.edits(turn.snapshot, &self.binding) {
                    turn.edits.extend(edits);
                }
                self.fail(turn, reason(unmet, self.ground.clone()))
            }
            Some(deadline) => {
                turn.wake_after(deadline);
                Standing::Running
            }
            None => Standing::Running,
        }
    }

    fn fail(&self, turn: &mut Turn<'_>, reason: Reason) -> Standing {
        turn.events.push(RefinementEvent::Failed { intention: self.ground.clone(), why: reason.clone() });
        Standing::Failed(reason)
    }

    /// What takes back the tokens that it has added, if nothing more can be decided about them: PELEA is gone. An
    /// intention that awaits nothing was achieved when it was written.
    pub(crate) fn withdrawal(&self, methods: &Methods, edits: &mut Vec<Edit>) {
        let State::Written { edits: written, .. } = &self.state else { return };
        if methods.intentions[self.intention].expects.is_always() {
            return;
        }
        edits.extend(written.iter().filter_map(|edit| match edit {
            Edit::AddEdge { from, label, to }
            | Edit::SetAttribute { holder: HolderRef::Edge { from, label, to }, .. } => {
                Some(Edit::RemoveEdge { from: from.clone(), label: *label, to: to.clone() })
            }
            Edit::SetAttribute { holder: holder @ HolderRef::Node(_), attribute, .. } => {
                Some(Edit::ClearAttribute { holder: holder.clone(), attribute: *attribute })
            }
            _ => None,
        }));
    }

    /// The edits that it has written.
    pub(crate) fn written(&self) -> &[Edit] {
        match &self.state {
            State::Waiting => &[],
            State::Written { edits, .. } => edits,
        }
    }

    /// Takes back the tokens that it has added, if they are still as it wrote them. It does not restore the tokens that
    /// it has removed: they were true once, and need not be true now.
    pub(crate) fn withdraw(&self, snapshot: &Snapshot, edits: &mut Vec<Edit>) {
        let State::Written { on, edits: written } = &self.state else { return };
        if *on == Some(snapshot.version()) {
            // Its edits were requested in this step, and are not in the graph yet.
            edits.retain(|edit| !written.contains(edit));
            return;
        }
        for edit in written {
            match edit {
                Edit::AddEdge { from, label, to } => {
                    let edge = HolderRef::Edge { from: from.clone(), label: *label, to: to.clone() };
                    let rewritten = written.iter().any(|other| match other {
                        Edit::SetAttribute { holder, .. } => {
                            *holder == edge && !is_redundant(snapshot, other)
                        }
                        _ => false,
                    });
                    if !rewritten {
                        take_back(from, *label, to, snapshot, edits);
                    }
                }
                Edit::SetAttribute { holder: HolderRef::Edge { from, label, to }, .. }
                    if is_redundant(snapshot, edit) =>
                {
                    take_back(from, *label, to, snapshot, edits);
                }
                Edit::SetAttribute { holder: holder @ HolderRef::Node(_), attribute, .. }
                    if is_redundant(snapshot, edit) =>
                {
                    edits.push(Edit::ClearAttribute { holder: holder.clone(), attribute: *attribute });
                }
                _ => {}
            }
        }
    }
}

/// The edits that would change the graph. As in PDDL, a token that is both deleted and added is added.
fn net(edits: Vec<Edit>, snapshot: &Snapshot) -> Vec<Edit> {
    let added: Vec<_> = edits.iter().filter_map(as_removal).collect();
    edits.into_iter().filter(|edit| !added.contains(edit) && !is_redundant(snapshot, edit)).collect()
}

/// The edit that undoes the adding of an edge.
fn as_removal(edit: &Edit) -> Option<Edit> {
    match edit {
        Edit::AddEdge { from, label, to } => {
            Some(Edit::RemoveEdge { from: from.clone(), label: *label, to: to.clone() })
        }
        _ => None,
    }
}

fn take_back(from: &NodeRef, label: dsr::LabelId, to: &NodeRef, snapshot: &Snapshot, edits: &mut Vec<Edit>) {
    let removal = Edit::RemoveEdge { from: from.clone(), label, to: to.clone() };
    if !is_redundant(snapshot, &removal) && !edits.contains(&removal) {
        edits.push(removal);
    }
}

/// `seconds` after `now`, or the last instant that a `Time` can name.
fn after(now: Time, seconds: f64) -> Time {
    let nanos = std::time::Duration::try_from_secs_f64(seconds).map_or(u128::MAX, |d| d.as_nanos());
    Time(now.0.saturating_add(u64::try_from(nanos).unwrap_or(u64::MAX)))
}
