//! Objects that appear at run time: a second person, a chair that was not there.
//!
//! Problem: a plan is about the objects of the problem, and the world gets others. Idea: a node that is not in the graph at
//! the start, and whose type is one of the planning domain, is one more object of the problem for as long as it is there.
//! The problem is then grounded anew with these objects, in the thread that decides; until a plan for the new model is
//! adopted, the old one goes on. Invariant: objects of the problem keep their ids, and are never taken away.

use dsr::{Snapshot, TypeId};
use pddl::model::{Domain, Name};
use rustc_hash::FxHashSet;
use serde::Serialize;

/// An object that appeared.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Arrival {
    /// The name of its node.
    pub name: Name,
    /// Its type in the planning domain.
    pub of: Name,
}

/// Which nodes of a graph have appeared as objects.
#[derive(Clone, Debug)]
pub struct Arrivals {
    /// The types that the planning domain shares with the graph.
    types: Vec<(TypeId, Name)>,
    /// The nodes that were there at the start.
    known: FxHashSet<Name>,
}

impl Arrivals {
    /// For a mission that starts with this graph.
    pub fn new(domain: &Domain, start: &Snapshot) -> Self {
        let types = domain.types.enumerate();
        let shared =
            types.filter_map(|(_, of)| Some((start.vocabulary().node_type(&of.name)?, of.name.clone())));
        Self { types: shared.collect(), known: start.nodes().map(|node| Name::new(node.name())).collect() }
    }

    /// The objects that have appeared and are still there, sorted.
    pub(crate) fn in_graph(&self, snapshot: &Snapshot) -> Vec<Arrival> {
        let vocabulary = snapshot.vocabulary();
        let mut found: Vec<Arrival> = snapshot
            .nodes()
            .filter(|node| !self.known.contains(node.name()))
            .filter_map(|node| {
                let fits = |(of, _): &&(TypeId, Name)| vocabulary.is_a(node.node_type(), *of);
                // The narrowest type: the one that is below all others.
                let fitting: Vec<_> = self.types.iter().filter(fits).collect();
                let narrow =
                    |(of, _): &&&(TypeId, Name)| fitting.iter().all(|(up, _)| vocabulary.is_a(*of, *up));
                let (_, of) = fitting.iter().find(narrow)?;
                Some(Arrival { name: Name::new(node.name()), of: of.clone() })
            })
            .collect();
        found.sort_unstable();
        found
    }
}
