//! Patterns as text against what the text says: random small texts, all assignments of all nodes, and subscriptions.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

mod world;

use std::collections::BTreeMap;
use std::fmt;

use dsr::{NodeId, Pattern, PatternTextError, Snapshot, Value};
use proptest::prelude::*;

/// The meaning of a text, by a reader of this test's own.
#[derive(Debug, Clone)]
enum Said {
    Is(&'static str, &'static str),
    Edge(&'static str, &'static str, &'static str),
    Distinct(&'static str, &'static str),
    Above(&'static str, u8),
    Refers(&'static str, &'static str),
    And(Vec<Self>),
    Not(Box<Self>),
}

impl fmt::Display for Said {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Is(kind, node) => write!(f, "({kind} {node})"),
            Self::Edge(label, from, to) => write!(f, "({label} {from} {to})"),
            Self::Distinct(a, b) => write!(f, "(distinct {a} {b})"),
            Self::Above(node, number) => write!(f, "(> (score {node}) {number})"),
            Self::Refers(node, other) => write!(f, "(= (patient {node}) {other})"),
            Self::And(parts) => {
                f.write_str("(and")?;
                parts.iter().try_for_each(|part| write!(f, " {part}"))?;
                f.write_str(")")
            }
            Self::Not(part) => write!(f, "(not {part})"),
        }
    }
}

type Rows = Vec<BTreeMap<&'static str, NodeId>>;

impl Said {
    fn nodes(&self) -> Vec<&'static str> {
        match self {
            Self::Is(_, a) | Self::Above(a, _) => vec![a],
            Self::Edge(_, a, b) | Self::Distinct(a, b) | Self::Refers(a, b) => vec![a, b],
            Self::And(parts) => parts.iter().flat_map(Self::nodes).collect(),
            Self::Not(_) => Vec::new(),
        }
    }

    fn negates(&self) -> bool {
        match self {
            Self::And(parts) => parts.iter().any(Self::negates),
            Self::Not(_) => true,
            _ => false,
        }
    }

    /// Gives the variables outside of any `not` that have no node yet every combination of nodes.
    fn rows(&self, outer: &BTreeMap<&'static str, NodeId>, s: &Snapshot) -> Rows {
        let mut rows = vec![outer.clone()];
        for variable in self.nodes().into_iter().filter(|word| word.starts_with('?')) {
            if rows[0].contains_key(variable) {
                continue;
            }
            let with = |row: &BTreeMap<&'static str, NodeId>, id| {
                let mut row = row.clone();
                row.insert(variable, id);
                row
            };
            rows = rows.iter().flat_map(|row| s.nodes().map(move |node| with(row, node.id))).collect();
        }
        rows
    }

    fn holds(&self, row: &BTreeMap<&'static str, NodeId>, s: &Snapshot) -> bool {
        let node = |word: &str| row.get(word).copied().or_else(|| s.node(word));
        let d = s.vocabulary();
        let value = |word: &str, attribute| s.attribute(node(word)?, d.attribute(attribute).unwrap());
        match self {
            Self::Is(kind, a) => {
                let kind = d.node_type(kind).unwrap();
                node(a).and_then(|id| s.get(id)).is_some_and(|found| d.is_a(found.node_type(), kind))
            }
            Self::Edge(label, a, b) => matches!((node(a), node(b)), (Some(a), Some(b))
                if s.has_edge(a, d.label(label).unwrap(), b)),
            Self::Distinct(a, b) => matches!((node(a), node(b)), (Some(a), Some(b)) if a != b),
            Self::Above(a, number) => {
                value(a, "score").and_then(Value::as_number).is_some_and(|found| found > f64::from(*number))
            }
            Self::Refers(a, b) => {
                let found = value(a, "patient").and_then(Value::as_node);
                found.is_some() && found == node(b)
            }
            Self::And(parts) => parts.iter().all(|part| part.holds(row, s)),
            Self::Not(part) => !part.rows(row, s).iter().any(|row| part.holds(row, s)),
        }
    }
}

fn said() -> impl Strategy<Value = Said> {
    let variable = || prop::sample::select(&["?x", "?y"][..]);
    let node =
        || prop::sample::select(&["?x", "?x", "?x", "?y", "?y", "?y", "clarc", "carlos", "nobody"][..]);
    let kind = prop::sample::select(&["object", "place", "place", "robot", "person", "test", "activity"][..]);
    let label = prop::sample::select(&["knows", "knows", "knows", "is_with", "is"][..]);
    let atom = prop_oneof![
        4 => (kind, node()).prop_map(|(kind, a)| Said::Is(kind, a)),
        4 => (label, node(), node()).prop_map(|(label, a, b)| Said::Edge(label, a, b)),
        1 => (node(), node()).prop_map(|(a, b)| Said::Distinct(a, b)),
        1 => (variable(), 4..8_u8).prop_map(|(a, number)| Said::Above(a, number)),
        1 => (variable(), node()).prop_map(|(a, b)| Said::Refers(a, b)),
    ];
    atom.prop_recursive(3, 10, 3, |inner| {
        prop_oneof![
            3 => prop::collection::vec(inner.clone(), 0..4).prop_map(Said::And),
            2 => inner.prop_map(|part| Said::Not(Box::new(part))),
        ]
    })
}

const EDITS: [&str; 14] = [
    "node anna person\nedge anna knows carlos",
    "no-node anna",
    "node bob robot\nedge carlos knows bob\nedge bob knows anna",
    "no-node bob",
    "edge anna is_with clarc",
    "edge carlos knows clarc",
    "no-edge carlos knows clarc",
    "edge clarc knows barthel",
    "set barthel score number 5",
    "set barthel score number 7",
    "set barthel patient node carlos",
    "edge clarc is speaking",
    "no-edge clarc is speaking",
    "no-node carlos",
];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(192))]
    #[test]
    fn a_text_means_what_it_says(
        texts in prop::collection::vec(prop::collection::vec(said(), 1..4).prop_map(Said::And), 8),
        history in prop::collection::vec(0..EDITS.len(), 1..8),
    ) {
        let graph = world::ward();
        let mut watched = Vec::new();
        for said in &texts {
            match Pattern::parse(&graph.vocabulary(), &said.to_string()) {
                Ok(pattern) => watched.push((said, graph.subscribe(pattern.clone()), pattern)),
                // Refused is what never holds, inside of a `not` or outside.
                Err(error) => {
                    prop_assert!(
                        matches!(error, PatternTextError::Wrong { .. } | PatternTextError::Disjoint { .. }),
                        "{said}: {error}"
                    );
                    let s = graph.snapshot();
                    let any = said.rows(&BTreeMap::new(), &s).iter().any(|row| said.holds(row, &s));
                    prop_assert!(said.negates() || !any, "{said}: {error}");
                }
            }
        }
        for edit in history.iter().map(|at| EDITS[*at]).chain([""]) {
            let _ = world::commit(&graph, "dsr", edit);
            let s = graph.snapshot();
            for (said, watcher, pattern) in &mut watched {
                let names: Vec<_> = pattern.variables().map(|(name, _)| format!("?{name}")).collect();
                let rows = said.rows(&BTreeMap::new(), &s).into_iter().filter(|row| said.holds(row, &s));
                let mut wanted: Vec<Vec<NodeId>> =
                    rows.map(|row| names.iter().map(|name| row[name.as_str()]).collect()).collect();
                wanted.sort();
                let found: Vec<_> = pattern.matches(&s).iter().map(|row| row.to_vec()).collect();
                prop_assert_eq!(&found, &wanted, "{}", said);
                while watcher.try_recv().is_some() {}
                let held: Vec<_> = watcher.held().iter().map(|row| row.to_vec()).collect();
                prop_assert_eq!(&held, &wanted, "watched: {}", said);
            }
        }
    }
}
