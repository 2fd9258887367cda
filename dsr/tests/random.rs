//! Random transactions: the graph against a naive model, failed ones against the bytes before, incremental matches
//! against matches from scratch and against brute force, replay against live.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

mod world;

use std::collections::{BTreeMap, BTreeSet};
use std::num::NonZeroUsize;
use std::sync::Arc;

use dsr::{
    Comparison, Covariance, Delivery, Event, Graph, HolderTerm, NodeId, Operand, Pattern, PatternBuilder,
    Snapshot, Term, Vocabulary,
};
use proptest::prelude::*;

const NODES: [(&str, &str); 8] = [
    ("world", "place"),
    ("clarc", "robot"),
    ("camera", "place"),
    ("carlos", "person"),
    ("anna", "person"),
    ("speaking", "activity"),
    ("barthel", "test"),
    ("feeding", "part"),
];

/// What the graph should hold, kept in the plainest way.
#[derive(Debug, Clone, Default, PartialEq)]
struct Model {
    nodes: BTreeMap<String, String>,
    edges: BTreeSet<[String; 3]>,
    /// Holder (one word, or three), attribute, value.
    attributes: BTreeMap<(Vec<String>, String), Vec<String>>,
    /// Child to parent and place; "moves" for one that moves.
    transforms: BTreeMap<String, (String, String)>,
    /// Child and time to place.
    samples: BTreeMap<(String, u64), String>,
}

impl Model {
    fn is_a(sub: &str, sup: &str) -> bool {
        sub == sup || sup == "object" || (sup == "place" && (sub == "robot" || sub == "person"))
    }

    fn typed(&self, node: &str, wanted: &str) -> bool {
        self.nodes.get(node).is_some_and(|found| Self::is_a(found, wanted))
    }

    fn edge_fits(&self, from: &str, label: &str, to: &str) -> bool {
        let signatures: &[_] = match label {
            "is" => &[("robot", "activity"), ("person", "activity")],
            "is_with" => &[("person", "robot")],
            "sits_at" => &[("person", "place")],
            "is_in" => &[("test", "part")],
            _ => &[("object", "object")],
        };
        from != to && signatures.iter().any(|(a, b)| self.typed(from, a) && self.typed(to, b))
    }

    /// Whether the value fits the attribute of that holder.
    fn holder_fits(&self, holder: &[&str], attribute: &str) -> bool {
        match (holder, attribute) {
            ([node], "score" | "patient" | "urgent") => self.typed(node, "test"),
            ([from, "is_in", to], "says") => self.typed(from, "test") && self.typed(to, "part"),
            ([from, "knows", to], "of" | "since") => self.typed(from, "place") && self.typed(to, "place"),
            _ => false,
        }
    }

    fn value_fits(&self, attribute: &str, value: &[&str]) -> bool {
        match (attribute, value) {
            ("score" | "since", ["number", _]) | ("urgent", ["bool", _]) | ("says", ["text", ..]) => true,
            ("patient", ["node", node]) => self.typed(node, "person"),
            ("of", ["node", node]) => self.typed(node, "place"),
            _ => false,
        }
    }

    fn drop_edge(&mut self, edge: &[String; 3]) {
        self.edges.remove(edge);
        self.attributes.retain(|(holder, _), _| holder != edge);
    }

    /// The edit that a line writes; false if it is refused.
    fn edit(&mut self, line: &str) -> bool {
        let words: Vec<_> = line.split_whitespace().collect();
        let own = |words: &[&str]| words.iter().map(ToString::to_string).collect::<Vec<_>>();
        match words[..] {
            ["node", name, kind] => self.nodes.insert(name.into(), kind.into()).is_none(),
            ["no-node", name] => {
                let edges: Vec<_> =
                    self.edges.iter().filter(|e| e[0] == name || e[2] == name).cloned().collect();
                edges.iter().for_each(|edge| self.drop_edge(edge));
                self.attributes
                    .retain(|(holder, _), value| holder[..] != [name] && value[..] != ["node", name]);
                self.transforms.retain(|child, (parent, _)| child != name && parent != name);
                self.samples.retain(|(child, _), _| self.transforms.contains_key(child));
                self.nodes.remove(name).is_some()
            }
            ["edge", from, label, to] => {
                self.edges.insert([from, label, to].map(str::to_owned));
                self.edge_fits(from, label, to)
            }
            ["no-edge", from, label, to] => {
                self.drop_edge(&[from, label, to].map(str::to_owned));
                self.edge_fits(from, label, to)
            }
            ["set", holder, attribute, ref value @ ..] => {
                self.attributes.insert((own(&[holder]), attribute.into()), own(value));
                self.holder_fits(&[holder], attribute) && self.value_fits(attribute, value)
            }
            ["set-edge", from, label, to, attribute, ref value @ ..] => {
                self.attributes.insert((own(&[from, label, to]), attribute.into()), own(value));
                self.edges.contains(&[from, label, to].map(str::to_owned))
                    && self.holder_fits(&[from, label, to], attribute)
                    && self.value_fits(attribute, value)
            }
            ["clear", holder, attribute] => {
                self.attributes.remove(&(own(&[holder]), attribute.into()));
                self.holder_fits(&[holder], attribute)
            }
            ["transform", parent, child, ..] => {
                let place = words[3..].join(" ");
                self.samples.retain(|(moving, _), _| moving != child);
                let old = self.transforms.insert(child.into(), (parent.into(), place));
                parent != child
                    && old.is_none_or(|(other, _)| other == parent)
                    && self.typed(parent, "place")
                    && self.typed(child, "place")
            }
            ["sample", parent, child, time, x, y, ref variance @ ..] => {
                let old = self.transforms.insert(child.into(), (parent.into(), "moves".into()));
                if old.as_ref().is_none_or(|(_, place)| place != "moves") {
                    self.samples.retain(|(moving, _), _| moving != child);
                }
                self.samples.insert(
                    (child.into(), time.parse().unwrap()),
                    [&[x, y, "0", "0"], variance].concat().join(" "),
                );
                parent != child
                    && old.is_none_or(|(other, _)| other == parent)
                    && self.typed(parent, "place")
                    && self.typed(child, "place")
            }
            ["no-transform", parent, child] => {
                if self.transforms.get(child).is_some_and(|(found, _)| found == parent) {
                    self.transforms.remove(child);
                    self.samples.retain(|(moving, _), _| moving != child);
                }
                self.typed(parent, "place") && self.typed(child, "place")
            }
            _ => panic!("no edit: {line}"),
        }
    }

    fn commit(&mut self, lines: &[String]) -> bool {
        let mut next = self.clone();
        let fine = lines.iter().all(|line| next.edit(line)) && next.is_tree() && next.all_sit_apart();
        if fine {
            *self = next;
        }
        fine
    }

    /// One person per seat, and one seat per person.
    fn all_sit_apart(&self) -> bool {
        let sits: Vec<_> = self.edges.iter().filter(|edge| edge[1] == "sits_at").collect();
        let all = |end: usize| sits.iter().map(|edge| &edge[end]).collect::<BTreeSet<_>>().len();
        all(0) == sits.len() && all(2) == sits.len()
    }

    /// One component and no cycle, by petgraph.
    fn is_tree(&self) -> bool {
        let edges = self.transforms.iter().map(|(child, (parent, _))| (parent.as_str(), child.as_str()));
        let quiver = petgraph::graphmap::DiGraphMap::<&str, ()>::from_edges(edges);
        !petgraph::algo::is_cyclic_directed(&quiver) && petgraph::algo::connected_components(&quiver) <= 1
    }

    /// The model that a snapshot shows.
    fn of(snapshot: &Snapshot) -> Self {
        let export = snapshot.export();
        let mut model = Self::default();
        let value = |value: &dsr::ExportedValue| match value {
            dsr::ExportedValue::Number(n) => vec!["number".into(), n.to_string()],
            dsr::ExportedValue::Text(text) => vec!["text".into(), text.to_string()],
            dsr::ExportedValue::Bool(truth) => vec!["bool".into(), truth.to_string()],
            dsr::ExportedValue::Node(name) => vec!["node".into(), name.to_string()],
        };
        for node in export.nodes.iter().filter(|node| !["agent", "resource"].contains(&&*node.node_type)) {
            model.nodes.insert(node.name.to_string(), node.node_type.to_string());
            for a in &node.attributes {
                model.attributes.insert((vec![node.name.to_string()], a.name.to_string()), value(&a.value));
            }
        }
        for edge in &export.edges {
            let key = [&edge.from, &edge.label, &edge.to].map(ToString::to_string);
            for a in &edge.attributes {
                model.attributes.insert((key.to_vec(), a.name.to_string()), value(&a.value));
            }
            model.edges.insert(key);
        }
        for t in &export.transforms {
            let place = |[x, y, _]: [f64; 3], covariance: &Option<Arc<Covariance>>| {
                let variance = covariance.as_ref().map(|known| format!(" {}", known.matrix()[(0, 0)]));
                format!("{x} {y} 0 0{}", variance.unwrap_or_default())
            };
            for sample in &t.samples {
                model.samples.insert(
                    (t.child.to_string(), sample.time.0),
                    place(sample.translation, &sample.covariance),
                );
            }
            if let Some(newest) = t.samples.last() {
                assert_eq!(newest.translation, t.translation, "the newest pose is the pose");
            }
            let kind =
                if t.samples.is_empty() { place(t.translation, &t.covariance) } else { "moves".into() };
            model.transforms.insert(t.child.to_string(), (t.parent.to_string(), kind));
        }
        model
    }
}

fn line() -> impl Strategy<Value = String> {
    let node = || prop::sample::select(&NODES[..]).prop_map(|(name, _)| name);
    let place = || prop::sample::select(&NODES[..5]).prop_map(|(name, _)| name);
    let label = prop::sample::select(&["is", "is_with", "is_in", "knows"][..]);
    let fitting = prop::sample::select(
        &[
            "clarc is speaking",
            "carlos is speaking",
            "carlos is_with clarc",
            "anna is_with clarc",
            "barthel is_in feeding",
            "carlos sits_at clarc",
            "carlos sits_at world",
            "anna sits_at world",
            "carlos knows anna",
            "anna knows carlos",
            "clarc knows carlos",
        ][..],
    );
    let value = prop::sample::select(
        &[
            "barthel score number 5",
            "barthel score number 10",
            "barthel patient node carlos",
            "barthel patient node anna",
            "barthel urgent bool true",
            "barthel score bool true",
            "clarc score number 5",
        ][..],
    );
    let edge_value = prop::sample::select(
        &[
            "barthel is_in feeding says text yyy",
            "barthel is_in feeding says text xxx",
            "carlos knows anna of node clarc",
            "clarc knows carlos of node anna",
            "carlos knows anna since number 1",
        ][..],
    );
    prop_oneof![
        3 => prop::sample::select(&NODES[..]).prop_map(|(name, kind)| format!("node {name} {kind}")),
        1 => node().prop_map(|name| format!("no-node {name}")),
        1 => (node(), label, node()).prop_map(|(a, l, b)| format!("edge {a} {l} {b}")),
        8 => fitting.clone().prop_map(|edge| format!("edge {edge}")),
        5 => fitting.prop_map(|edge| format!("no-edge {edge}")),
        4 => value.prop_map(|value| format!("set {value}")),
        4 => edge_value.prop_map(|value| format!("set-edge {value}")),
        1 => prop::sample::select(&["score", "patient"][..]).prop_map(|a| format!("clear barthel {a}")),
        4 => (place(), place(), 0..3, 0..3).prop_map(|(a, b, x, y)| format!("transform {a} {b} {x} {y} 0 0")),
        4 => (place(), place(), 0..6, 0..3).prop_map(|(a, b, t, x)| format!("sample {a} {b} {t} {x} 0")),
        1 => (place(), place(), 0..3, 0..2).prop_map(|(a, b, x, v)| format!("transform {a} {b} {x} 0 0 0 {v}")),
        2 => (place(), place(), 0..6, 0..2).prop_map(|(a, b, t, v)| format!("sample {a} {b} {t} 1 0 {v}")),
        2 => (place(), place()).prop_map(|(a, b)| format!("no-transform {a} {b}")),
    ]
}

/// Long transactions seldom succeed, so most are short.
fn history() -> impl Strategy<Value = Vec<Vec<String>>> {
    let transaction = prop_oneof![
        4 => prop::collection::vec(line(), 1..2),
        2 => prop::collection::vec(line(), 2..4),
        1 => prop::collection::vec(line(), 4..8),
    ];
    prop::collection::vec(transaction, 1..60)
}

type Brute = fn(&Snapshot, &[NodeId]) -> bool;

/// Patterns, and the same conditions written as plain code over all assignments.
fn patterns(d: &Vocabulary) -> Vec<(Pattern, Brute)> {
    let kind = |name: &str| d.node_type(name).unwrap();
    let label = |name: &str| d.label(name).unwrap();
    let attribute = |name: &str| d.attribute(name).unwrap();
    let mut list: Vec<(Pattern, Brute)> = Vec::new();

    let mut p = PatternBuilder::new(d);
    let (who, robot) = (p.variable("who", kind("person")), p.variable("robot", kind("robot")));
    p.edge(who, label("is_with"), robot).edge(robot, label("is"), "speaking");
    list.push((p.build().unwrap(), |s, n| {
        edge(s, Some(n[0]), "is_with", Some(n[1])) && edge(s, Some(n[1]), "is", s.node("speaking"))
    }));

    let mut p = PatternBuilder::new(d);
    let who = p.variable("who", kind("person"));
    p.without(|p| {
        p.edge(who, label("is_with"), "clarc").edge("clarc", label("is"), "speaking").distinct(who, "anna");
    });
    list.push((p.build().unwrap(), |s, n| {
        let inner = edge(s, Some(n[0]), "is_with", s.node("clarc"))
            && edge(s, s.node("clarc"), "is", s.node("speaking"))
            && s.node("anna").is_some_and(|anna| anna != n[0]);
        !inner
    }));

    let mut p = PatternBuilder::new(d);
    let (test, who) = (p.variable("test", kind("test")), p.variable("who", kind("person")));
    p.guard(test, attribute("patient"), Comparison::Equal, who).guard(
        test,
        attribute("score"),
        Comparison::Less,
        10.0,
    );
    list.push((p.build().unwrap(), |s, n| {
        let a = |name| s.attribute(n[0], s.vocabulary().attribute(name).unwrap());
        a("patient").and_then(dsr::Value::as_node) == Some(n[1])
            && a("score").and_then(dsr::Value::as_number).is_some_and(|score| score < 10.0)
    }));

    // A person who knows no person that is with a robot: a negated part in a negated part.
    let mut p = PatternBuilder::new(d);
    let who = p.variable("who", kind("place"));
    p.without(|p| {
        let friend = p.variable("friend", kind("place"));
        p.edge(who, label("knows"), friend);
        p.without(|p| {
            let robot = p.variable("robot", kind("robot"));
            p.edge(friend, label("is_with"), robot);
        });
    });
    list.push((p.build().unwrap(), |s, n| {
        let place = s.vocabulary().node_type("place").unwrap();
        let robot = s.vocabulary().node_type("robot").unwrap();
        !s.nodes_of(place).any(|friend| {
            edge(s, Some(n[0]), "knows", Some(friend))
                && !s.nodes_of(robot).any(|robot| edge(s, Some(friend), "is_with", Some(robot)))
        })
    }));

    // The only person: a local variable that nothing but its type binds.
    let mut p = PatternBuilder::new(d);
    let who = p.variable("who", kind("person"));
    p.without(|p| {
        let other = p.variable("other", kind("person"));
        p.distinct(who, other);
    });
    list.push((p.build().unwrap(), |s, n| {
        let person = s.vocabulary().node_type("person").unwrap();
        !s.nodes_of(person).any(|other| other != n[0])
    }));

    // Three nodes in a row, and the last does not know the first.
    let mut p = PatternBuilder::new(d);
    let (a, b) = (p.variable("a", kind("place")), p.variable("b", kind("place")));
    let c = p.variable("c", kind("object"));
    p.edge(a, label("knows"), b).edge(b, label("knows"), c);
    p.without(|p| _ = p.edge(c, label("knows"), a));
    list.push((p.build().unwrap(), |s, n| {
        let knows = |from, to| edge(s, Some(from), "knows", Some(to));
        knows(n[0], n[1]) && knows(n[1], n[2]) && !knows(n[2], n[0])
    }));

    let mut p = PatternBuilder::new(d);
    let (a, b) = (p.variable("a", kind("place")), p.variable("b", kind("place")));
    p.distance(a, b, Comparison::LessOrEqual, 1.5).distinct(a, b);
    list.push((p.build().unwrap(), |s, n| {
        n[0] != n[1] && s.distance(n[0], n[1]).is_ok_and(|metres| metres <= 1.5)
    }));

    let mut p = PatternBuilder::new(d);
    let (test, part) = (p.variable("test", kind("test")), p.variable("part", kind("part")));
    let says = HolderTerm::edge(test, label("is_in"), part);
    p.guard(says, attribute("says"), Comparison::NotEqual, dsr::Value::text("xxx"));
    p.without(|p| {
        p.present(test, attribute("urgent")).present(test, attribute("patient")).edge(
            test,
            label("knows"),
            part,
        );
    });
    list.push((p.build().unwrap(), |s, n| {
        let key = dsr::EdgeKey { from: n[0], label: s.vocabulary().label("is_in").unwrap(), to: n[1] };
        let has = |name| s.attribute(n[0], s.vocabulary().attribute(name).unwrap()).is_some();
        s.attribute(key, s.vocabulary().attribute("says").unwrap())
            .and_then(dsr::Value::as_text)
            .is_some_and(|text| text != "xxx")
            && !(has("urgent") && has("patient") && edge(s, Some(n[0]), "knows", Some(n[1])))
    }));

    // No constant node, but a value: the pattern that an edge concerns is found by the value at its end.
    let mut p = PatternBuilder::new(d);
    let (test, part) = (p.variable("test", kind("test")), p.variable("part", kind("part")));
    p.edge(test, label("is_in"), part).guard(test, attribute("score"), Comparison::Equal, 5.0);
    list.push((p.build().unwrap(), |s, n| {
        let score = s.attribute(n[0], s.vocabulary().attribute("score").unwrap());
        edge(s, Some(n[0]), "is_in", Some(n[1])) && score.and_then(dsr::Value::as_number) == Some(5.0)
    }));

    // The same under a negation, with a number to be crossed.
    let mut p = PatternBuilder::new(d);
    let part = p.variable("part", kind("part"));
    p.without(|p| {
        let test = p.variable("test", kind("test"));
        p.edge(test, label("is_in"), part).guard(test, attribute("score"), Comparison::Greater, 5.0);
    });
    list.push((p.build().unwrap(), |s, n| {
        let (test, score) = (s.vocabulary().node_type("test").unwrap(), s.vocabulary().attribute("score"));
        let high = |id| s.attribute(id, score.unwrap()).and_then(dsr::Value::as_number) > Some(5.0);
        !s.nodes_of(test).any(|test| edge(s, Some(test), "is_in", Some(n[0])) && high(test))
    }));

    // No constant and no value: the pattern that an edge concerns is found by the other edge.
    let mut p = PatternBuilder::new(d);
    let (a, b) = (p.variable("a", kind("place")), p.variable("b", kind("person")));
    let c = p.variable("c", kind("robot"));
    p.edge(a, label("knows"), b).edge(b, label("is_with"), c);
    p.without(|p| {
        let what = p.variable("what", kind("activity"));
        p.edge(c, label("is"), what).edge(b, label("is"), what);
    });
    list.push((p.build().unwrap(), |s, n| {
        let activity = s.vocabulary().node_type("activity").unwrap();
        let is = |who, what| edge(s, Some(who), "is", Some(what));
        edge(s, Some(n[0]), "knows", Some(n[1]))
            && edge(s, Some(n[1]), "is_with", Some(n[2]))
            && !s.nodes_of(activity).any(|what| is(n[2], what) && is(n[1], what))
    }));

    // A text on an edge.
    let mut p = PatternBuilder::new(d);
    let (test, part) = (p.variable("test", kind("test")), p.variable("part", kind("object")));
    let says = HolderTerm::edge(test, label("is_in"), part);
    p.guard(says, attribute("says"), Comparison::Equal, dsr::Value::text("yyy"));
    list.push((p.build().unwrap(), |s, n| {
        let key = dsr::EdgeKey { from: n[0], label: s.vocabulary().label("is_in").unwrap(), to: n[1] };
        let says = s.attribute(key, s.vocabulary().attribute("says").unwrap());
        says.and_then(dsr::Value::as_text) == Some("yyy")
    }));

    // Two attributes held against each other; a node found through an edge's attribute.
    let mut p = PatternBuilder::new(d);
    let (a, b) = (p.variable("a", kind("place")), p.variable("b", kind("place")));
    let (c, whom) = (p.variable("c", kind("place")), p.variable("whom", kind("place")));
    let of = |a, b| HolderTerm::edge(a, label("knows"), b);
    p.guard(of(a, b), attribute("of"), Comparison::Equal, Term::from(whom));
    p.guard(of(b, c), attribute("of"), Comparison::NotEqual, Operand::Attribute(of(a, b), attribute("of")));
    list.push((p.build().unwrap(), |s, n| {
        let of = |from, to| {
            let key = dsr::EdgeKey { from, label: s.vocabulary().label("knows").unwrap(), to };
            s.attribute(key, s.vocabulary().attribute("of").unwrap()).and_then(dsr::Value::as_node)
        };
        of(n[0], n[1]) == Some(n[3]) && of(n[1], n[2]).is_some_and(|other| other != n[3])
    }));
    list
}

fn edge(s: &Snapshot, from: Option<NodeId>, label: &str, to: Option<NodeId>) -> bool {
    matches!((from, to), (Some(from), Some(to)) if s.has_edge(from, s.vocabulary().label(label).unwrap(), to))
}

/// All assignments of nodes of the right types for which the condition holds, in order.
fn brute(pattern: &Pattern, condition: Brute, snapshot: &Snapshot) -> Vec<Vec<NodeId>> {
    let mut rows = vec![Vec::new()];
    for (_, kind) in pattern.variables() {
        let nodes: Vec<_> = snapshot.nodes_of(kind).collect();
        rows = rows.iter().flat_map(|row| nodes.iter().map(|&n| [row.as_slice(), &[n]].concat())).collect();
    }
    rows.retain(|row| condition(snapshot, row));
    rows.sort();
    rows
}

/// Runs a history and compares, after each transaction and at the end, everything that must agree.
fn check(history: &[Vec<String>]) -> Result<(), TestCaseError> {
    let graph = Graph::new(world::vocabulary());
    let initial = graph.snapshot().export();
    let feed = graph.subscribe_deltas();
    let patterns = patterns(&graph.vocabulary());
    let mut watchers: Vec<_> = patterns.iter().map(|(p, _)| graph.subscribe(p.clone())).collect();
    // One that never listens until the end, with room for two commits.
    let two = NonZeroUsize::new(2).unwrap();
    let mut sleepers: Vec<_> = patterns.iter().map(|(p, _)| graph.subscribe_with(p.clone(), two)).collect();
    // A subscriber that reads only at the end, and receives all commits at once.
    let mut dreamers: Vec<_> =
        patterns.iter().map(|(p, _)| graph.subscribe_with(p.clone(), Delivery::Newest)).collect();
    dreamers.iter_mut().for_each(|dreamer| while dreamer.try_recv().is_some() {});
    let (mut model, mut deltas) = (Model::default(), Vec::new());
    // The same history without subscribers and snapshots are held only now and then, so that most transactions
    // are applied and taken back in place.
    let alone = Graph::new(world::vocabulary());
    let mut held = Vec::new();
    // Everybody is there at first, so that most edits have something to work on.
    let everybody: Vec<_> = NODES.iter().map(|(name, kind)| format!("node {name} {kind}")).collect();

    for lines in std::iter::once(&everybody).chain(history) {
        let before = graph.snapshot();
        let bytes = world::bytes(&graph);
        let fine = model.commit(lines);
        let result = world::commit(&graph, "dsr", &lines.join("\n"));
        prop_assert_eq!(result.is_ok(), fine, "{:?}: {:?}", lines, result);
        if (lines.len() + lines[0].len()).is_multiple_of(4) {
            held.push((alone.snapshot(), bytes.clone()));
        }
        let twin = world::commit(&alone, "dsr", &lines.join("\n"));
        prop_assert_eq!(world::bytes(&alone), world::bytes(&graph), "held or not, the same");
        prop_assert_eq!(twin.as_ref().map(|c| &c.delta), result.as_ref().map(|c| &c.delta));
        let after = graph.snapshot();
        prop_assert_eq!(&Model::of(&after), &model, "{:?}", lines);
        match result {
            Err(_) => prop_assert_eq!(&world::bytes(&graph), &bytes),
            Ok(commit) if commit.delta.changes.is_empty() => {
                prop_assert_eq!(&world::bytes(&graph), &bytes);
                prop_assert!(feed.try_recv().is_none());
            }
            Ok(commit) => {
                prop_assert_eq!(after.version().0, before.version().0 + 1);
                let Some(Event::Committed(told)) = feed.try_recv() else {
                    panic!("every commit is delivered")
                };
                prop_assert_eq!(&told.delta, &commit.delta);
                deltas.push((*commit.delta).clone());
            }
        }
        prop_assert_eq!(serde_json::to_string(&before.export()).unwrap(), bytes, "a snapshot never changes");

        for ((pattern, condition), watcher) in patterns.iter().zip(&mut watchers) {
            let mut told = watcher.held().clone();
            while let Some(change) = watcher.try_recv() {
                for gone in &change.disappeared {
                    prop_assert!(told.remove(gone));
                }
                for new in change.appeared {
                    prop_assert!(told.insert(new));
                }
            }
            let scratch = pattern.matches(&after);
            prop_assert!(told.iter().eq(&scratch), "incremental is from scratch");
            prop_assert_eq!(pattern.holds(&after), !scratch.is_empty());
            let rows: Vec<_> = scratch.iter().map(|row| row.to_vec()).collect();
            prop_assert_eq!(&rows, &brute(pattern, *condition, &after));
            for row in rows {
                // Fixing any one variable of a match finds exactly the matches that agree.
                for (at, (name, _)) in pattern.variables().enumerate() {
                    let fixed = [(pattern.variable(name).unwrap(), row[at])];
                    let found = pattern.matches_with(&after, &fixed);
                    let agreeing = scratch.iter().filter(|other| other[at] == row[at]);
                    prop_assert!(found.iter().eq(agreeing));
                    prop_assert!(pattern.holds_with(&after, &fixed));
                }
            }
        }
    }

    for ((watcher, sleeper), dreamer) in watchers.iter().zip(&mut sleepers).zip(&mut dreamers) {
        while sleeper.try_recv().is_some() {}
        prop_assert_eq!(watcher.held(), sleeper.held(), "who lagged has caught up");
        if let Some(change) = dreamer.try_recv() {
            prop_assert_eq!(change.missed, 0);
        }
        prop_assert!(dreamer.try_recv().is_none(), "everything is delivered at once");
        prop_assert_eq!(watcher.held(), dreamer.held());
    }
    for (snapshot, bytes) in held {
        prop_assert_eq!(serde_json::to_string(&snapshot.export()).unwrap(), bytes, "held to the end");
    }
    // Through JSON, as a journal would.
    let json = serde_json::to_string(&deltas).unwrap();
    let read: Vec<dsr::Delta> = serde_json::from_str(&json).unwrap();
    let replayed = Graph::replay(graph.vocabulary(), &initial, &read).unwrap();
    prop_assert_eq!(world::bytes(&replayed), world::bytes(&graph));
    let restored = Graph::restore(graph.vocabulary(), &graph.snapshot().export()).unwrap();
    prop_assert_eq!(world::bytes(&restored), world::bytes(&graph));
    Ok(())
}

proptest! {
    // A case is up to sixty transactions, each compared with brute force; more cases take minutes.
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn the_graph_is_its_model_its_deltas_and_its_subscriptions(history in history()) {
        check(&history)?;
    }
}

fn history_of(lines: &[&[&str]]) -> Vec<Vec<String>> {
    lines.iter().map(|lines| lines.iter().map(ToString::to_string).collect()).collect()
}

/// The attribute goes with the node that it named and comes back in the same commit: a replay must see both.
#[test]
fn an_attribute_outlives_the_node_that_it_named() {
    let lines: &[&[&str]] =
        &[&["set barthel patient node carlos"], &["no-node carlos", "set barthel patient node anna"]];
    check(&history_of(lines)).unwrap();
}

/// A node that comes and goes in one commit is in no delta, so its id must not be used up.
#[test]
fn a_node_that_comes_and_goes_leaves_no_trace() {
    let lines: &[&[&str]] = &[&["node bob person", "no-node bob"], &["node bob person"]];
    check(&history_of(lines)).unwrap();
}

/// An attribute that names another node now must not go with the one that it named before.
#[test]
fn a_reference_follows_its_last_value() {
    let lines: &[&[&str]] =
        &[&["set barthel patient node carlos"], &["set barthel patient node anna"], &["no-node carlos"]];
    check(&history_of(lines)).unwrap();
}

/// What is put back as it was makes no version, a frame that moves too.
#[test]
fn a_frame_that_goes_and_comes_back_as_it_was_leaves_no_trace() {
    let graph = world::ward();
    world::commit(&graph, "dsr", "node anna person\nsample world anna 5 1 0").unwrap();
    let before = world::bytes(&graph);
    let back = "no-transform world anna\nsample world anna 5 1 0";
    let commit = world::commit(&graph, "dsr", back).unwrap();
    assert!(commit.delta.changes.is_empty());
    assert_eq!(world::bytes(&graph), before);
    let lines: &[&[&str]] = &[
        &["transform world clarc 1 0 0 0"],
        &["sample world carlos 5 1 0"],
        &["no-transform world carlos", "sample world carlos 5 1 0"],
    ];
    check(&history_of(lines)).unwrap();
    // But not if it was somewhere else before it went.
    let lines: &[&[&str]] = &[
        &["transform world clarc 1 0 0 0"],
        &["sample world carlos 5 1 0"],
        &[
            "sample world carlos 4 2 0",
            "no-transform world carlos",
            "sample world carlos 5 1 0",
            "sample world carlos 4 2 0",
        ],
    ];
    check(&history_of(lines)).unwrap();
}
