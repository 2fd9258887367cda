//! Patterns that measure, while frames move, change their parents, and come and go: what a subscriber holds against a
//! naive machine that judges every assignment of nodes after every commit. And which subscribers receive a move.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

mod world;

use std::collections::BTreeSet;
use std::num::NonZeroUsize;
use std::sync::Arc;
use std::sync::atomic::Ordering;

use dsr::{
    Comparison, Delivery, Graph, Kind, Matches, Metric, Nature, NodeId, Pattern, PatternBuilder, Snapshot,
    Threshold, Vocabulary, VocabularyBuilder,
};
use proptest::prelude::*;

/// What there is at first. The last three are no place, so that they fit other variables.
const NODES: [(&str, &str); 10] = [
    ("hall", "place"),
    ("room", "place"),
    ("arm", "place"),
    ("one", "robot"),
    ("two", "robot"),
    ("anna", "person"),
    ("bea", "person"),
    ("carl", "person"),
    ("cup", "tool"),
    ("pen", "tool"),
];

/// What others may hang below.
const PARENTS: [&str; 5] = ["hall", "room", "arm", "one", "anna"];

fn vocabulary() -> Arc<Vocabulary> {
    let mut b = VocabularyBuilder::new();
    let place = b.node_type("place", None, Nature::Geometric).unwrap();
    let robot = b.node_type("robot", Some(place), Nature::Symbolic).unwrap();
    let person = b.node_type("person", Some(place), Nature::Symbolic).unwrap();
    b.node_type("tool", None, Nature::Geometric).unwrap();
    b.label("with", person, robot).unwrap();
    b.attribute_on_node("reach", robot, Kind::Number).unwrap();
    b.build()
}

/// Everybody, in one tree: hall > room > one > arm > cup, the rest in the room.
fn house() -> Graph {
    let graph = Graph::new(vocabulary());
    let mut lines: Vec<_> = NODES.iter().map(|(name, kind)| format!("node {name} {kind}")).collect();
    lines.extend(["hall room", "room one", "one arm", "arm cup", "room two"].map(|edge| hang(edge, "5 5")));
    lines.extend(["room anna", "room bea", "hall carl", "anna pen"].map(|edge| hang(edge, "0 5")));
    world::commit(&graph, "dsr", &lines.join("\n")).unwrap();
    graph
}

fn hang(edge: &str, at: &str) -> String {
    format!("transform {edge} {at} 0 0")
}

/// Takes a frame off whatever it hangs below.
fn off(child: &str) -> String {
    let lines = PARENTS.iter().filter(|parent| **parent != child);
    lines.map(|parent| format!("no-transform {parent} {child}\n")).collect()
}

/// The lines of one edit, or of two that belong together. Some are refused, and their transaction with them.
fn edit() -> impl Strategy<Value = String> {
    let frame = || prop::sample::select(&NODES[..]).prop_map(|(name, _)| name);
    let parent = || prop::sample::select(&PARENTS[..]);
    let kept = prop::sample::select(
        &[
            ("hall", "room"),
            ("room", "one"),
            ("one", "arm"),
            ("arm", "cup"),
            ("room", "two"),
            ("room", "anna"),
            ("room", "bea"),
            ("hall", "carl"),
            ("anna", "pen"),
        ][..],
    );
    let at = || (0..4, 0..4, prop::sample::select(&["0", "1.5", "-0.7"][..]));
    prop_oneof![
        // Where it hangs at first: refused when it has another parent by now.
        6 => (kept.clone(), at()).prop_map(|((a, b), (x, y, yaw))| format!("transform {a} {b} {x} {y} 0 {yaw}")),
        4 => (kept, 0..6, at()).prop_map(|((a, b), t, (x, y, _))| format!("sample {a} {b} {t} {x} {y}")),
        // Wherever it hangs.
        5 => (parent(), frame(), at())
            .prop_map(|(a, b, (x, y, yaw))| format!("{}transform {a} {b} {x} {y} 0 {yaw}", off(b))),
        3 => (parent(), frame(), 0..6, at())
            .prop_map(|(a, b, t, (x, y, _))| format!("{}sample {a} {b} {t} {x} {y}", off(b))),
        2 => frame().prop_map(off),
        1 => frame().prop_map(|name| format!("no-node {name}")),
        2 => prop::sample::select(&NODES[..]).prop_map(|(name, kind)| format!("node {name} {kind}")),
        2 => (prop::sample::select(&["one", "two"][..]), 0..4)
            .prop_map(|(name, reach)| format!("set {name} reach number {reach}.1")),
        1 => prop::sample::select(&["one", "two"][..]).prop_map(|name| format!("clear {name} reach")),
        2 => (prop::sample::select(&["anna", "bea", "carl"][..]), prop::sample::select(&["one", "two"][..]), any::<bool>())
            .prop_map(|(a, b, on)| format!("{} {a} with {b}", if on { "edge" } else { "no-edge" })),
    ]
}

fn history() -> impl Strategy<Value = Vec<String>> {
    let transaction = prop_oneof![
        4 => prop::collection::vec(edit(), 1..2),
        3 => prop::collection::vec(edit(), 2..4),
        1 => prop::collection::vec(edit(), 4..7),
    ];
    prop::collection::vec(transaction.prop_map(|edits| edits.join("\n")), 1..40)
}

/// Which of two numbers counts: what it takes to come, or to stay.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Level {
    Comes,
    Stays,
}

const NEAR: Threshold = Threshold { appears: 1.2, disappears: 2.1 };
const FAR: Threshold = Threshold { appears: 2.1, disappears: 1.2 };
const AHEAD: Threshold = Threshold { appears: 0.5, disappears: 1.2 };

impl Level {
    fn of(self, threshold: Threshold) -> f64 {
        if self == Self::Comes { threshold.appears } else { threshold.disappears }
    }

    fn negated(self) -> Self {
        if self == Self::Comes { Self::Stays } else { Self::Comes }
    }

    fn near(self, s: &Snapshot, a: NodeId, b: NodeId) -> bool {
        s.distance(a, b).is_ok_and(|metres| metres < self.of(NEAR))
    }
}

fn nodes(s: &Snapshot, kind: &str) -> Vec<NodeId> {
    s.nodes_of(s.vocabulary().node_type(kind).unwrap()).collect()
}

fn with(s: &Snapshot, who: NodeId, robot: NodeId) -> bool {
    s.has_edge(who, s.vocabulary().label("with").unwrap(), robot)
}

fn reachable(s: &Snapshot, robot: NodeId, what: NodeId) -> bool {
    s.reachable(robot, what, s.vocabulary().attribute("reach").unwrap()).is_ok_and(|reached| reached)
}

/// Whether a row of nodes for the variables is a match, by itself.
type Condition = fn(&Snapshot, &[NodeId], Level) -> bool;

fn patterns(d: &Vocabulary) -> Vec<(&'static str, Pattern, Condition)> {
    let kind = |name: &str| d.node_type(name).unwrap();
    let (label, reach) = (d.label("with").unwrap(), d.attribute("reach").unwrap());
    let less = Comparison::Less;
    let mut list: Vec<(&'static str, Pattern, Condition)> = Vec::new();
    let mut add = |name, condition: Condition, write: &dyn Fn(&mut PatternBuilder<'_>)| {
        let mut pattern = PatternBuilder::new(d);
        write(&mut pattern);
        list.push((name, pattern.build().unwrap(), condition));
    };
    add("a person near a robot", |s, n, level| level.near(s, n[0], n[1]), &|p| {
        let (who, robot) = (p.variable("who", kind("person")), p.variable("robot", kind("robot")));
        p.distance(who, robot, less, NEAR);
    });
    let near_one: Condition = |s, n, level| s.node("one").is_some_and(|one| level.near(s, n[0], one));
    add("anything near the robot named one", near_one, &|p| {
        let what = p.variable("what", dsr::TypeId::OBJECT);
        p.distance(what, "one", less, NEAR);
    });
    let named: Condition =
        |s, _, level| s.node("anna").zip(s.node("one")).is_some_and(|(anna, one)| level.near(s, anna, one));
    add("a tool while two that are named are near each other", named, &|p| {
        p.variable("tool", kind("tool"));
        p.distance("anna", "one", less, NEAR);
    });
    let ahead: Condition = |s, n, level| {
        with(s, n[0], n[1]) && s.bearing(n[1], n[0]).is_ok_and(|angle| angle.abs() < level.of(AHEAD))
    };
    add("a robot that faces who is with it", ahead, &|p| {
        let (who, robot) = (p.variable("who", kind("person")), p.variable("robot", kind("robot")));
        p.edge(who, label, robot).metric(Metric::Bearing, robot, who, less, AHEAD);
    });
    add("a tool in reach", |s, n, _| reachable(s, n[0], n[1]), &|p| {
        let (robot, tool) = (p.variable("robot", kind("robot")), p.variable("tool", kind("tool")));
        p.reachable(robot, tool, reach);
    });
    let close: Condition = |s, n, _| n[0] != n[1] && s.distance(n[0], n[1]).is_ok_and(|m| m <= 1.5);
    add("two places near each other", close, &|p| {
        let (a, b) = (p.variable("a", kind("place")), p.variable("b", kind("place")));
        p.distance(a, b, Comparison::LessOrEqual, 1.5).distinct(a, b);
    });
    add("a person as far from themselves as ever", |_, _, _| true, &|p| {
        let who = p.variable("who", kind("person"));
        p.distance(who, who, less, 0.1);
    });
    let chain: Condition = |s, n, level| {
        level.near(s, n[0], n[1]) && s.distance(n[1], n[2]).is_ok_and(|metres| metres > level.of(FAR))
    };
    add("a person near a robot that is far from a tool", chain, &|p| {
        let (who, robot) = (p.variable("who", kind("person")), p.variable("robot", kind("robot")));
        let tool = p.variable("tool", kind("tool"));
        p.distance(who, robot, less, NEAR).distance(robot, tool, Comparison::Greater, FAR);
    });
    let alone: Condition =
        |s, n, level| !nodes(s, "robot").into_iter().any(|robot| level.negated().near(s, n[0], robot));
    add("a person with no robot near", alone, &|p| {
        let who = p.variable("who", kind("person"));
        p.without(|p| {
            let robot = p.variable("robot", kind("robot"));
            p.distance(who, robot, less, NEAR);
        });
    });
    let apart: Condition = |s, n, level| with(s, n[0], n[1]) && !level.negated().near(s, n[0], n[1]);
    add("a person not near the robot they are with", apart, &|p| {
        let (who, robot) = (p.variable("who", kind("person")), p.variable("robot", kind("robot")));
        p.edge(who, label, robot);
        p.without(|p| _ = p.distance(who, robot, less, NEAR));
    });
    let idle: Condition = |s, _, level| {
        let tools = nodes(s, "tool");
        let near = |robot| tools.iter().any(|tool| level.negated().near(s, robot, *tool));
        !nodes(s, "robot").into_iter().any(near)
    };
    add("a person while no robot is near a tool", idle, &|p| {
        p.variable("who", kind("person"));
        p.without(|p| {
            let (robot, tool) = (p.variable("robot", kind("robot")), p.variable("tool", kind("tool")));
            p.distance(robot, tool, less, NEAR);
        });
    });
    let spread: Condition = |s, _, _| {
        let tools = nodes(s, "tool");
        let near = |robot| tools.iter().any(|tool| s.distance(robot, *tool).is_ok_and(|m| m <= 1.5));
        !nodes(s, "robot").into_iter().any(near)
    };
    add("a person while no robot is near a tool, without hysteresis", spread, &|p| {
        p.variable("who", kind("person"));
        p.without(|p| {
            let (robot, tool) = (p.variable("robot", kind("robot")), p.variable("tool", kind("tool")));
            p.distance(robot, tool, Comparison::LessOrEqual, 1.5);
        });
    });
    let empty_handed: Condition = |s, n, _| {
        let near = |tool| s.distance(n[1], tool).is_ok_and(|metres| metres <= 1.5);
        with(s, n[0], n[1]) && !nodes(s, "tool").into_iter().any(near)
    };
    add("a person with a robot that has no tool near", empty_handed, &|p| {
        let (who, robot) = (p.variable("who", kind("person")), p.variable("robot", kind("robot")));
        p.edge(who, label, robot);
        p.without(|p| {
            let tool = p.variable("tool", kind("tool"));
            p.distance(robot, tool, Comparison::LessOrEqual, 1.5);
        });
    });
    let unserved: Condition = |s, n, _| {
        let near = |robot| {
            let at = |name| s.node(name).and_then(|node| s.distance(robot, node).ok());
            at("cup").is_some_and(|m| m <= 1.5) && at("carl").is_some_and(|m| m <= 3.5)
        };
        !nodes(s, "robot").into_iter().any(|robot| with(s, n[0], robot) && near(robot))
    };
    add("a person none of whose robots is near the cup and Carl", unserved, &|p| {
        let who = p.variable("who", kind("person"));
        p.without(|p| {
            let robot = p.variable("robot", kind("robot"));
            p.edge(who, label, robot).distance(robot, "cup", Comparison::LessOrEqual, 1.5);
            p.distance("carl", robot, Comparison::LessOrEqual, 3.5);
        });
    });
    // Under two negations the first number is the one to come by again.
    let served: Condition = |s, n, level| {
        let near = |robot| s.node("cup").is_some_and(|cup| level.near(s, robot, cup));
        !nodes(s, "robot").into_iter().any(|robot| with(s, n[0], robot) && !near(robot))
    };
    add("a person all of whose robots are near the cup", served, &|p| {
        let who = p.variable("who", kind("person"));
        p.without(|p| {
            let robot = p.variable("robot", kind("robot"));
            p.edge(who, label, robot);
            p.without(|p| _ = p.distance(robot, "cup", less, NEAR));
        });
    });
    let out_of_reach: Condition =
        |s, n, _| !nodes(s, "person").into_iter().any(|who| reachable(s, n[0], who));
    add("a robot with nobody in reach", out_of_reach, &|p| {
        let robot = p.variable("robot", kind("robot"));
        p.without(|p| {
            let who = p.variable("who", kind("person"));
            p.reachable(robot, who, reach);
        });
    });
    list
}

/// A subscriber, and what it should hold: all that comes by the state it looks at, and of what it held what stays.
struct Watched {
    name: &'static str,
    condition: Condition,
    matches: Matches,
    expected: BTreeSet<Vec<NodeId>>,
}

impl Watched {
    fn all(graph: &Graph, mailbox: impl Into<dsr::Mailbox> + Copy) -> Vec<Self> {
        let patterns = patterns(&graph.vocabulary()).into_iter();
        let mut all: Vec<_> = patterns
            .map(|(name, pattern, condition)| {
                let (matches, expected) = (graph.subscribe_with(pattern, mailbox), BTreeSet::new());
                Self { name, condition, matches, expected }
            })
            .collect();
        all.iter_mut().for_each(|watched| watched.look(graph).unwrap());
        all
    }

    fn look(&mut self, graph: &Graph) -> Result<(), TestCaseError> {
        let now = graph.snapshot();
        let mut told = self.matches.held().clone();
        while let Some(change) = self.matches.try_recv() {
            for gone in &change.disappeared {
                prop_assert!(told.remove(gone), "{}: told to be gone, and was not there", self.name);
            }
            for new in change.appeared {
                prop_assert!(told.insert(new), "{}: told to be new, and was there", self.name);
            }
        }
        prop_assert_eq!(&told, self.matches.held());
        let mut rows = vec![Vec::new()];
        for (_, kind) in self.matches.pattern().variables() {
            let nodes: Vec<_> = now.nodes_of(kind).collect();
            rows =
                rows.iter().flat_map(|row| nodes.iter().map(|&n| [row.as_slice(), &[n]].concat())).collect();
        }
        let comes: BTreeSet<_> =
            rows.iter().filter(|row| (self.condition)(&now, row, Level::Comes)).cloned().collect();
        let scratch = self.matches.pattern().matches(&now);
        prop_assert!(scratch.iter().map(|row| row.to_vec()).eq(comes.iter().cloned()), "{}", self.name);
        rows.retain(|row| {
            comes.contains(row) || (self.expected.contains(row) && (self.condition)(&now, row, Level::Stays))
        });
        self.expected = rows.into_iter().collect();
        let held: BTreeSet<_> = told.iter().map(|row| row.to_vec()).collect();
        prop_assert_eq!(&held, &self.expected, "{}", self.name);
        Ok(())
    }
}

fn check(history: &[String]) -> Result<(), TestCaseError> {
    let graph = house();
    let mut each = Watched::all(&graph, Delivery::Each);
    // A subscriber that reads after every third commit and receives the three as one.
    let mut newest = Watched::all(&graph, Delivery::Newest);
    // Who looks as seldom, and has no room for more than one.
    let mut small = Watched::all(&graph, NonZeroUsize::new(1).unwrap());
    for (at, lines) in history.iter().enumerate() {
        // A rejected transaction changes nothing and reaches no subscriber.
        let _ = world::commit(&graph, "dsr", lines);
        each.iter_mut().try_for_each(|watched| watched.look(&graph))?;
        if at % 3 == 2 {
            newest.iter_mut().try_for_each(|watched| watched.look(&graph))?;
            // Who lags looks at the newest state only; who does not, at the one commit that concerned it.
            small.iter_mut().try_for_each(|watched| watched.look(&graph))?;
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn what_is_held_is_what_a_naive_machine_holds(history in history()) {
        check(&history)?;
    }
}

/// The cup comes into the band, where those who were matches stay so; who comes then is none before it has left the band.
#[test]
fn one_that_is_held_in_the_band_speaks_for_no_other() {
    let history = [
        "transform one arm 0 0 0 0\ntransform arm cup 0 1.5 0 0",
        "node dora person",
        "transform arm cup 0 1.7 0 0",
        "transform arm cup 0 3 0 0",
        "transform arm cup 0 1.5 0 0",
        "transform arm cup 0 1 0 0",
        "transform arm cup 0 1.5 0 0",
    ];
    check(&history.map(str::to_owned)).unwrap();
}

/// Each line is a commit, with whether each watcher received it and how many matches it has.
#[test]
fn who_measures_nothing_that_moves_is_not_told() {
    let graph = house();
    let near = |a: &'static str, b: &'static str| {
        world::watch(&graph, move |p, d| {
            let [a, b] = [a, b].map(|name| p.variable(name, d.node_type(name).unwrap()));
            p.distance(a, b, Comparison::Less, 1.2);
        })
    };
    let near_one = world::watch(&graph, |p, d| {
        let who = p.variable("who", d.node_type("person").unwrap());
        p.distance(who, "one", Comparison::Less, 1.2);
    });
    let mut watchers = [near("person", "robot"), near("robot", "tool"), near_one];
    let mut seen = String::new();
    for line in [
        "transform room bea 5 4 0 0",
        "transform one arm 0 0 0 0",
        "transform arm cup 0 1 0 0",
        "transform room one 0 4 0 0",
        "transform room two 1 1 0 0",
        "transform hall room 1 1 0 0",
        "sample hall carl 10 1 5",
        "sample hall carl 9 1 5",
        "no-transform room bea",
        "no-transform anna pen",
    ] {
        let before: Vec<_> = watchers.iter().map(|(_, told)| told.load(Ordering::SeqCst)).collect();
        world::commit(&graph, "dsr", line).unwrap();
        let mut row = String::new();
        for ((matches, told), before) in watchers.iter_mut().zip(before) {
            while matches.try_recv().is_some() {}
            assert!(matches.held().iter().eq(&matches.pattern().matches(&graph.snapshot())), "{line}");
            row += &format!(" {}/{}", told.load(Ordering::SeqCst) - before, matches.held().len());
        }
        seen += &format!("{line}:{row}\n");
    }
    expect_test::expect![[r#"
        transform room bea 5 4 0 0: 1/2 0/0 1/1
        transform one arm 0 0 0 0: 0/2 1/0 0/1
        transform arm cup 0 1 0 0: 0/2 1/2 0/1
        transform room one 0 4 0 0: 1/2 1/1 1/1
        transform room two 1 1 0 0: 1/1 1/1 0/1
        transform hall room 1 1 0 0: 1/2 1/1 1/2
        sample hall carl 10 1 5: 1/2 0/1 1/2
        sample hall carl 9 1 5: 0/2 0/1 0/2
        no-transform room bea: 1/2 0/1 1/2
        no-transform anna pen: 0/2 1/1 0/2
    "#]]
    .assert_eq(&seen);
}
