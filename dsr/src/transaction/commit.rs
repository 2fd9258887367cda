//! A transaction, from first to last: a function from a state to the next one, or to the rule that it breaks.
//!
//! 1. The reflexes that the writer dismisses end.
//! 2. Each edit is checked and written, and logs what it overwrites (`apply`).
//! 3. The rules for the whole graph are checked (`invariants`).
//! 4. Leases pass to waiting agents that have become more urgent (`claim`).
//! 5. The writer's new reflexes are registered, and the broken ones fire, each as a small transaction of its owner
//!    (`reflexes`).
//! 6. The log becomes the delta (`crate::delta`), and the state gets its version.
//!
//! Invariant: after an error the state is the one before, to the byte, and the reflexes are those before. Cost: for
//! each edit a few binary searches and one look-up of permissions; see `BENCHMARKS.md`.

use super::Transaction;
use super::apply::apply;
use super::edit::{Edit, HolderRef};
use super::error::TransactionError;
use super::reflexes::Registry;
use super::{claim, invariants};
use crate::delta::{self, Change, Delta};
use crate::id::{NodeId, ReflexId, Time, Version};
use crate::state::State;
use crate::state::log::Mark;
use crate::state::warm::Side;
use crate::value::NodeRef;

/// What a transaction made, beside the next state.
pub(crate) struct Outcome {
    pub(crate) delta: Delta,
    /// The reflexes that the transaction registered.
    pub(crate) guards: Vec<ReflexId>,
    /// The reflexes of the next state.
    pub(crate) reflexes: Registry,
}

/// Makes the state the next one, or leaves it as it is.
pub(crate) fn transact(
    state: &mut State,
    mut reflexes: Registry,
    transaction: &Transaction,
    time: Time,
) -> Result<Outcome, TransactionError> {
    let writer = transaction.writer;
    state.vocabulary.agent_name(writer).ok_or(TransactionError::UnknownAgent { id: writer })?;

    let start = state.mark();
    let done = run(state, &mut reflexes, transaction, start);
    if done.is_err() {
        state.roll_back(start);
        state.log.clear();
    }
    let (guards, fired) = done?;
    let changes = delta::settle(state);
    if !changes.is_empty() || !fired.is_empty() {
        (state.version, state.time) = (Version(state.version.0 + 1), time);
    }
    // The id of a node that was added and removed again is free: the delta does not mention it, so a replay would not
    // know that it is taken.
    let added =
        |change: &Change| if let Change::NodeAdded { node, .. } = change { Some(*node) } else { None };
    let last = changes.iter().filter_map(added).max();
    state.next = last.map_or(start.next(), |last| NodeId(last.0 + 1));
    state.log.clear();
    let delta = Delta { version: state.version, time: state.time, writer, changes, reflexes: fired };
    Ok(Outcome { delta, guards, reflexes })
}

/// Returns the reflexes registered and those that fired.
fn run(
    state: &mut State,
    reflexes: &mut Registry,
    transaction: &Transaction,
    start: Mark,
) -> Result<(Vec<ReflexId>, Vec<ReflexId>), TransactionError> {
    let (writer, version) = (transaction.writer, Version(state.version.0 + 1));
    for &reflex in &transaction.dismissed {
        reflexes.dismiss(state, writer, reflex, version)?;
    }
    for edit in &transaction.edits {
        apply(state, writer, edit, version)?;
    }
    invariants::check(state, start)?;
    claim::settle(state, version);
    let mut guards = Vec::with_capacity(transaction.guards.len());
    for reflex in &transaction.guards {
        guards.push(reflexes.register(state, writer, reflex, version)?);
    }
    let fired = reflexes.fire_broken(state, version);
    Ok((guards, fired))
}

/// A graph with fewer nodes than this is in the cache anyway.
const LARGE: NodeId = NodeId(1 << 12);

/// Loads what the edits will need into the cache; see `crate::state::warm`.
pub(crate) fn warm(state: &State, edits: &[Edit]) {
    if state.next < LARGE {
        return;
    }
    let at = |node: &NodeRef, side| match node {
        NodeRef::Id(id) => state.warm(*id, side),
        NodeRef::Name(_) => 0,
    };
    let mut sum = 0;
    for edit in edits {
        sum += match edit {
            Edit::AddEdge { from, to, .. } | Edit::RemoveEdge { from, to, .. } => {
                at(from, Side::Start) + at(to, Side::End)
            }
            Edit::SetAttribute { holder, .. } | Edit::ClearAttribute { holder, .. } => match holder {
                HolderRef::Node(node) => at(node, Side::Holder),
                HolderRef::Edge { from, to, .. } => at(from, Side::Start) + at(to, Side::End),
            },
            _ => 0,
        };
    }
    std::hint::black_box(sum);
}
