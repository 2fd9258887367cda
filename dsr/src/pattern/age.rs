//! Since when a pattern holds: an identity of what it found that outlives the process.

use super::compiled::Pattern;
use super::source::Atom;
use super::term::{Term, Variable};
use crate::id::{NodeId, Version};
use crate::snapshot::Snapshot;

impl Pattern {
    /// The newest version in which an edge of its first match began; `None` without a match. The same as long as none of
    /// these edges is removed, also in a graph that was restored.
    pub fn since(&self, snapshot: &Snapshot, fixed: &[(Variable, NodeId)]) -> Option<Version> {
        let matched = self.matches_with(snapshot, fixed).into_iter().next()?;
        let node = |term: &Term| match term {
            Term::Variable(variable) => matched.get(*variable),
            Term::Node(node) => Some(*node),
            Term::Named(name) => snapshot.node(name),
        };
        let since = |atom: &Atom<Term>| match atom {
            Atom::Edge { from, label, to } => Some(snapshot.edge(node(from)?, *label, node(to)?)?.since()),
            _ => None,
        };
        Some(self.source.body.atoms.iter().filter_map(since).max().unwrap_or_default())
    }
}
