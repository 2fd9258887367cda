//! A small ward for the tests: a robot, a person, a test with parts, three agents and two resources.
//!
//! The cases write edits as lines of words ("edge clarc is speaking"), so that adding one is adding text.
#![allow(dead_code, reason = "each test binary uses its own part of the ward")]
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use dsr::{
    AgentId, Covariance, Degree, End, Graph, HolderRef, Isometry3, Kind, Matches, Matrix6, Nature, NewValue,
    NodeRef, PatternBuilder, Permission, Pose, Preemption, Priority, Time, Token, Transaction, TypeId,
    Vocabulary, VocabularyBuilder,
};

/// Types: `place` > (`robot`, `person`, `part`), `activity`, `test`. Agents: `speech` may say what is and what
/// has finished at `speaking`; `person_agent` writes `is_with` and the pose of persons; `pelea` writes tests.
pub(crate) fn vocabulary() -> Arc<Vocabulary> {
    let mut b = VocabularyBuilder::new();
    let place = b.node_type("place", None, Nature::Geometric).unwrap();
    let robot = b.node_type("robot", Some(place), Nature::Symbolic).unwrap();
    let person = b.node_type("person", Some(place), Nature::Symbolic).unwrap();
    let activity = b.node_type("activity", None, Nature::Symbolic).unwrap();
    let test = b.node_type("test", None, Nature::Symbolic).unwrap();
    let part = b.node_type("part", None, Nature::Symbolic).unwrap();
    let is = b.label("is", robot, activity).unwrap();
    b.label("is", person, activity).unwrap();
    let finished = b.label("finished", robot, activity).unwrap();
    let is_with = b.label("is_with", person, robot).unwrap();
    let is_in = b.label("is_in", test, part).unwrap();
    let knows = b.label("knows", TypeId::OBJECT, TypeId::OBJECT).unwrap();
    let sits_at = b.label("sits_at", person, place).unwrap();
    b.limit(sits_at, Degree { leaving: Some(1), reaching: Some(1) }).unwrap();
    let score = b.attribute_on_node("score", test, Kind::Number).unwrap();
    b.attribute_on_node("patient", test, Kind::Node(person)).unwrap();
    b.attribute_on_node("urgent", test, Kind::Bool).unwrap();
    let says = b.attribute_on_edge("says", is_in, (test, part), Kind::Text).unwrap();
    b.attribute_on_edge("since", knows, (place, place), Kind::Number).unwrap();
    b.attribute_on_edge("of", knows, (place, place), Kind::Node(place)).unwrap();

    let speech = b.agent("speech").unwrap();
    b.permit(speech, Permission::between(Token::Label(is), End::OfType(robot), End::named("speaking")))
        .unwrap();
    b.permit(speech, Permission::between(Token::Label(finished), End::Any, End::named("speaking"))).unwrap();
    let watcher = b.agent("watcher").unwrap();
    b.permit(watcher, Permission::anywhere(Token::Label(is_with))).unwrap();
    b.permit(watcher, Permission::between(Token::Transform, End::Any, End::OfType(person))).unwrap();
    b.permit(watcher, Permission::anywhere(Token::Node(person))).unwrap();
    let pelea = b.agent("pelea").unwrap();
    for token in [Token::Label(is_in), Token::Attribute(says), Token::Attribute(score), Token::Label(is)] {
        b.permit(pelea, Permission::anywhere(token)).unwrap();
    }
    b.resource("speaker").unwrap();
    b.resource("screen").unwrap();
    b.build()
}

/// The ward with its nodes: world > clarc > camera, world > carlos; barthel with two parts.
pub(crate) fn ward() -> Graph {
    let graph = Graph::new(vocabulary());
    let lines = "node world place\nnode clarc robot\nnode camera place\nnode carlos person\n\
        node speaking activity\nnode listening activity\nnode barthel test\nnode feeding part\n\
        node bathing part\ntransform world clarc 1 0 0 0\ntransform clarc camera 0 0 1.5 0\n\
        transform world carlos 3 0 0 0\nedge carlos is_with clarc\nedge barthel is_in feeding";
    commit(&graph, "dsr", lines).unwrap();
    graph
}

/// Commits the edits of `lines` as `writer`.
pub(crate) fn commit(graph: &Graph, writer: &str, lines: &str) -> Result<dsr::Commit, dsr::TransactionError> {
    graph.commit(&transaction(graph, writer, lines), Time(graph.snapshot().version().0 + 1))
}

pub(crate) fn transaction(graph: &Graph, writer: &str, lines: &str) -> Transaction {
    let vocabulary = graph.vocabulary();
    let mut transaction = Transaction::new(agent(&vocabulary, writer));
    for line in lines.lines().map(str::trim).filter(|line| !line.is_empty()) {
        edit(&vocabulary, &mut transaction, line);
    }
    transaction
}

pub(crate) fn agent(vocabulary: &Vocabulary, name: &str) -> AgentId {
    vocabulary.agent(name).unwrap_or_else(|| panic!("no agent {name}"))
}

/// Appends the edit that a line writes.
pub(crate) fn edit(vocabulary: &Vocabulary, transaction: &mut Transaction, line: &str) {
    let words: Vec<_> = line.split_whitespace().collect();
    let label = |name| vocabulary.label(name).unwrap_or_else(|| panic!("no label {name}"));
    let attribute = |name| vocabulary.attribute(name).unwrap_or_else(|| panic!("no attribute {name}"));
    let node_type = |name| vocabulary.node_type(name).unwrap_or_else(|| panic!("no type {name}"));
    let resource = |name| vocabulary.resource(name).unwrap_or_else(|| panic!("no resource {name}"));
    let number = |word: &str| word.parse::<f64>().unwrap();
    match words[..] {
        ["node", name, kind] => transaction.add_node(name, node_type(kind)),
        ["nameless", kind] => transaction.add_node("", node_type(kind)),
        ["no-node", name] => transaction.remove_node(name),
        ["edge", from, l, to] => transaction.add_edge(from, label(l), to),
        ["no-edge", from, l, to] => transaction.remove_edge(from, label(l), to),
        ["set", holder, a, ref value @ ..] => {
            transaction.set_attribute(HolderRef::node(holder), attribute(a), new_value(value))
        }
        ["set-edge", from, l, to, a, ref value @ ..] => {
            transaction.set_attribute(HolderRef::edge(from, label(l), to), attribute(a), new_value(value))
        }
        ["clear", holder, a] => transaction.clear_attribute(HolderRef::node(holder), attribute(a)),
        ["clear-edge", from, l, to, a] => {
            transaction.clear_attribute(HolderRef::edge(from, label(l), to), attribute(a))
        }
        ["transform", parent, child, x, y, z, yaw, ref variance @ ..] => {
            let pose = pose([x, y, z, yaw].map(number));
            transaction.set_transform(parent, child, known(pose, variance))
        }
        ["sample", parent, child, time, x, y, ref variance @ ..] => {
            let pose = known(pose([number(x), number(y), 0.0, 0.0]), variance);
            transaction.sample_transform(parent, child, Time(time.parse().unwrap()), pose)
        }
        ["no-transform", parent, child] => transaction.remove_transform(parent, child),
        ["claim", r, priority, yields] => {
            let preemption = if yields == "yields" { Preemption::Yields } else { Preemption::Finishes };
            transaction.claim(resource(r), Priority(priority.parse().unwrap()), preemption)
        }
        ["release", r] => transaction.release(resource(r)),
        ["expect", version] => transaction.expect_version(dsr::Version(version.parse().unwrap())),
        ["expire", name] => transaction.push(dsr::Edit::Expire { agent: agent(vocabulary, name) }),
        _ => panic!("no edit: {line}"),
    };
}

fn new_value(words: &[&str]) -> NewValue {
    match words {
        ["number", number] => NewValue::Number(number.parse().unwrap()),
        ["bool", truth] => NewValue::Bool(truth.parse().unwrap()),
        ["node", name] => NewValue::Node(NodeRef::from(*name)),
        ["text", rest @ ..] => rest.join(" ").as_str().into(),
        _ => panic!("no value: {words:?}"),
    }
}

pub(crate) fn pose([x, y, z, yaw]: [f64; 4]) -> Isometry3<f64> {
    Isometry3::new([x, y, z].into(), [0.0, 0.0, yaw].into())
}

/// With that variance along each axis, if one is given.
fn known(transform: Isometry3<f64>, variance: &[&str]) -> Pose {
    match variance {
        [variance] => {
            let variance: f64 = variance.parse().unwrap();
            Pose::new(transform, Covariance::new(Matrix6::identity() * variance).unwrap())
        }
        _ => transform.into(),
    }
}

pub(crate) fn bytes(graph: &Graph) -> String {
    serde_json::to_string(&graph.snapshot().export()).unwrap()
}

/// Subscribes, looks at what is there, and counts from then on how often it is told of something.
pub(crate) fn watch(
    graph: &Graph,
    write: impl Fn(&mut PatternBuilder<'_>, &Vocabulary),
) -> (Matches, Arc<AtomicU32>) {
    let vocabulary = graph.vocabulary();
    let mut pattern = PatternBuilder::new(&vocabulary);
    write(&mut pattern, &vocabulary);
    let mut matches = graph.subscribe(pattern.build().unwrap());
    while matches.try_recv().is_some() {}
    let told = Arc::new(AtomicU32::new(0));
    let counter = Arc::clone(&told);
    matches.on_wake(move || _ = counter.fetch_add(1, Ordering::SeqCst));
    (matches, told)
}
