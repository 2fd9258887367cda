//! Incremental updates equal a derivation from scratch: random edits of `cases/perceived.pddl`, one delta at a time.

#[path = "../../vocabulary/tests/support/case_file.rs"]
#[expect(dead_code, reason = "only the sources are needed here")]
mod case_file;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use dsr::{AgentId, Edit, Graph, HolderRef, Isometry3, NewValue, NodeRef, Snapshot, Time};
use low_to_high::{Fact, Fluent, LowToHigh, Perception};
use pddl::{parse_domain, parse_problem};
use proptest::prelude::*;
use vocabulary::{FunctionToken, Tokens};

struct World {
    tokens: Tokens,
    perception: Arc<Perception>,
    graph: Graph,
}

fn world() -> World {
    let sources = case_file::sources(include_str!("cases/perceived.pddl"));
    let source = |at: usize| &sources[at].1;
    let words = parse_domain(source(0), &[]).model.expect("the case is well formed");
    let planning = parse_domain(source(1), &[]).model.expect("the case is well formed");
    let problem = parse_problem(source(2), &words).model.expect("the case is well formed");
    let perception = parse_domain(source(3), &[&words, &planning]).model.expect("the case is well formed");
    let tokens = Tokens::new(&words).expect("the case is well formed");
    let perception = Arc::new(Perception::new(&perception, &tokens).expect("the case is well formed"));
    let graph = tokens.populate(&[&problem], Time(0)).expect("the case is well formed");
    World { tokens, perception, graph }
}

/// An edit by small numbers; they select among the nodes that exist.
#[derive(Debug, Clone)]
enum Random {
    Toggle { label: usize, from: usize, to: usize },
    Label { part: usize, utterance: Option<usize> },
    Score { item: usize, score: Option<u8> },
    Move { body: usize, x: u8 },
    Node { name: u8, of: usize },
}

fn random() -> impl Strategy<Value = Random> {
    let n = || 0usize..32;
    prop_oneof![
        8 => (n(), n(), n()).prop_map(|(label, from, to)| Random::Toggle { label, from, to }),
        2 => (n(), proptest::option::of(n())).prop_map(|(part, utterance)| Random::Label { part, utterance }),
        1 => (n(), proptest::option::of(0u8..20)).prop_map(|(item, score)| Random::Score { item, score }),
        1 => (n(), 0u8..8).prop_map(|(body, x)| Random::Move { body, x }),
        1 => (0u8..4, n()).prop_map(|(name, of)| Random::Node { name, of }),
    ]
}

fn edits(world: &World, snapshot: &Snapshot, random: &Random) -> Vec<Edit> {
    let vocabulary = world.tokens.vocabulary();
    let of = |name: &str, at: usize| {
        let all: Vec<_> =
            snapshot.nodes_of(vocabulary.node_type(name).expect("the case is well formed")).collect();
        NodeRef::Id(all[at % all.len()])
    };
    let id = |node: &NodeRef| match node {
        NodeRef::Id(id) => *id,
        NodeRef::Name(_) => unreachable!("made above"),
    };
    match random {
        Random::Toggle { label, from, to } => {
            const LABELS: [(&str, &str, &str); 9] = [
                ("is", "device", "state"),
                ("is", "test", "state"),
                ("precedes", "part", "part"),
                ("offers", "item", "option"),
                ("is_with", "person", "robot"),
                ("was_said_in", "utterance", "part"),
                ("was_shown_in", "option", "part"),
                ("was_chosen_in", "option", "item"),
                ("attended", "clinician", "state"),
            ];
            let (name, start, end) = LABELS[label % LABELS.len()];
            let (label, from, to) =
                (vocabulary.label(name).expect("the case is well formed"), of(start, *from), of(end, *to));
            if from == to {
                return Vec::new();
            }
            vec![if snapshot.has_edge(id(&from), label, id(&to)) {
                Edit::RemoveEdge { from, label, to }
            } else {
                Edit::AddEdge { from, label, to }
            }]
        }
        Random::Label { part, utterance } => {
            let Some(FunctionToken::Edge { label, attribute }) = world.tokens.function("label") else {
                unreachable!("declared in the case")
            };
            let (from, to) = (of("test", 0), of("part", *part));
            match utterance {
                None => vec![Edit::RemoveEdge { from, label, to }],
                Some(at) => vec![
                    Edit::AddEdge { from: from.clone(), label, to: to.clone() },
                    Edit::SetAttribute {
                        holder: HolderRef::Edge { from, label, to },
                        attribute,
                        value: NewValue::Node(of("utterance", *at)),
                    },
                ],
            }
        }
        Random::Score { item, score } => {
            let attribute = vocabulary.attribute("score").expect("the case is well formed");
            let holder = HolderRef::Node(of("item", *item));
            vec![match score {
                None => Edit::ClearAttribute { holder, attribute },
                Some(score) => Edit::SetAttribute { holder, attribute, value: f64::from(*score).into() },
            }]
        }
        Random::Move { body, x } => {
            let mut transform = Isometry3::identity();
            transform.translation.vector.x = f64::from(*x);
            vec![Edit::SetTransform {
                parent: "hall".into(),
                child: of("body", *body),
                pose: transform.into(),
            }]
        }
        Random::Node { name, of } => {
            let name = format!("new-{name}");
            if let Some(node) = snapshot.node(&name) {
                return vec![Edit::RemoveNode { node: node.into() }];
            }
            const TYPES: [&str; 6] = ["item", "phase", "option", "person", "utterance", "clinician"];
            let node_type = vocabulary.node_type(TYPES[of % TYPES.len()]).expect("the case is well formed");
            vec![Edit::AddNode { name: name.into(), node_type }]
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn an_update_equals_a_derivation_from_scratch(commits in prop::collection::vec(prop::collection::vec(random(), 1..4), 1..25)) {
        let world = world();
        let mut seen = LowToHigh::new(Arc::clone(&world.perception), &world.graph.snapshot());
        for commit in &commits {
            let snapshot = world.graph.snapshot();
            let edits: Vec<Edit> = commit.iter().flat_map(|random| edits(&world, &snapshot, random)).collect();
            // A refused transaction (a removed node named again) changes nothing.
            let Ok(done) = world.graph.edit(AgentId::DSR, Time(0), |tx| { tx.extend(edits); }) else { continue };
            let before: Vec<Fact> = seen.facts().cloned().collect();
            let numbers = seen.clone();
            let change = seen.update(&done.snapshot, &done.delta);
            let scratch = LowToHigh::new(Arc::clone(&world.perception), &done.snapshot);
            prop_assert_eq!(seen.derived().collect::<Vec<_>>(), scratch.derived().collect::<Vec<_>>());
            prop_assert_eq!(seen.facts().collect::<Vec<_>>(), scratch.facts().collect::<Vec<_>>());
            let after: Vec<Fact> = seen.facts().cloned().collect();
            let appeared: Vec<_> = after.iter().filter(|f| !before.contains(f)).cloned().collect();
            let disappeared: Vec<_> = before.iter().filter(|f| !after.contains(f)).cloned().collect();
            prop_assert_eq!(change.appeared, appeared);
            prop_assert_eq!(change.disappeared, disappeared);
            prop_assert_eq!(seen.numbers().collect::<Vec<_>>(), scratch.numbers().collect::<Vec<_>>());
            let default: BTreeMap<_, _> = world.perception.numbers().collect();
            let value = |of: &LowToHigh, fluent: &Fluent| {
                let known = of.numbers().find(|(other, _)| *other == fluent).map(|(_, value)| value);
                known.or(default[&fluent.function])
            };
            let fluents = numbers.numbers().chain(seen.numbers()).map(|(fluent, _)| fluent);
            let changed = fluents.collect::<BTreeSet<_>>().into_iter();
            let changed = changed.filter(|f| value(&numbers, f) != value(&seen, f));
            let changed: Vec<_> = changed.map(|f| (f.clone(), value(&seen, f))).collect();
            prop_assert_eq!(change.numbers, changed);
            for fact in &after {
                prop_assert!(!matches!(seen.why(&done.snapshot, fact), low_to_high::Explanation::NotPerceived));
            }
        }
    }
}
