//! What no graph has written is refused when it is read, by name, and without waiting for ever.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

mod world;

use dsr::{
    AgentId, AttributeId, Change, Delta, EdgeKey, Export, ExportedEdge, ExportedTransform, Graph, Holder,
    Isometry3, LabelId, Nature, NodeId, Pose, ReplayError, RestoreError, Snapshot, Time, TransactionError,
    TypeId, Value, Version, VocabularyBuilder,
};
use nalgebra::{Quaternion, UnitQuaternion};

/// Twice as long as a rotation is.
fn no_rotation() -> Isometry3<f64> {
    let twice = UnitQuaternion::new_unchecked(Quaternion::new(2.0, 0.0, 0.0, 0.0));
    Isometry3::from_parts([1.0, 0.0, 0.0].into(), twice)
}

#[test]
fn a_rotation_that_is_none_is_refused_live_as_when_it_is_read() {
    let graph = world::ward();
    let before = world::bytes(&graph);
    let refused = TransactionError::NotRigid { parent: "world".into(), child: "clarc".into() };
    let set = graph.edit(AgentId::DSR, Time(0), |tx| _ = tx.set_transform("world", "clarc", no_rotation()));
    assert_eq!(set.unwrap_err(), refused);
    let sample = |tx: &mut dsr::Transaction| {
        tx.remove_transform("world", "clarc").sample_transform("world", "clarc", Time(0), no_rotation());
    };
    assert_eq!(graph.edit(AgentId::DSR, Time(0), sample).unwrap_err(), refused);
    assert_eq!(world::bytes(&graph), before);
    let mut export = graph.snapshot().export();
    export.transforms[0].rotation = [0.0, 0.0, 0.0, 2.0];
    let restored = Graph::restore(graph.vocabulary(), &export);
    assert!(matches!(restored, Err(RestoreError::WrongTransform { .. })));
}

fn replay(graph: &Graph, changes: Vec<Change>) -> Result<Graph, ReplayError> {
    let now = graph.snapshot();
    let version = Version(now.version().0 + 1);
    let delta = Delta { version, time: Time(0), writer: AgentId::DSR, changes, reflexes: Vec::new() };
    Graph::replay(graph.vocabulary(), &now.export(), [&delta])
}

fn id(now: &Snapshot, name: &str) -> NodeId {
    now.node(name).unwrap_or_else(|| panic!("no node {name}"))
}

#[test]
fn a_delta_that_no_graph_made_does_not_fit() {
    let graph = world::ward();
    let now = graph.snapshot();
    let vocabulary = graph.vocabulary();
    let next = now.export().next;
    let node = |name: &str| id(&now, name);
    let edge = |from, label, to| EdgeKey { from: node(from), label, to: node(to) };
    let attribute = |name| vocabulary.attribute(name).unwrap();
    let added = |holder: NodeId, attribute: AttributeId, new: Value| Change::AttributeAdded {
        holder: Holder::Node(holder),
        attribute,
        new,
    };
    let hung = |parent, child, pose: Isometry3<f64>| Change::TransformAdded {
        parent: node(parent),
        child: node(child),
        new: Pose::from(pose),
        time: None,
    };
    let holds = |who| Change::EdgeAdded { edge: edge(who, LabelId::HOLDS, "speaker") };
    let awaits = |who, what| Change::EdgeAdded { edge: edge(who, LabelId::AWAITS, what) };
    let comes = |name: &str, node_type| Change::NodeAdded { node: next, name: name.into(), node_type };
    let gone = |name: &str, node_type| Change::NodeRemoved { node: node(name), name: name.into(), node_type };
    let misfits = [
        vec![gone("speech", TypeId::AGENT)],
        vec![gone("speaker", TypeId::RESOURCE)],
        vec![comes("second", TypeId::AGENT)],
        vec![comes("", vocabulary.node_type("part").unwrap())],
        vec![added(node("clarc"), attribute("score"), Value::Number(1.0))],
        vec![added(node("barthel"), attribute("score"), Value::Number(f64::NAN))],
        vec![added(node("barthel"), attribute("patient"), Value::Node(node("clarc")))],
        vec![hung("world", "speaking", Isometry3::identity())],
        vec![Change::TransformChanged {
            parent: node("world"),
            child: node("clarc"),
            old: Pose::from(world::pose([1.0, 0.0, 0.0, 0.0])),
            new: Pose::from(no_rotation()),
        }],
        vec![holds("speech"), holds("watcher")],
        vec![awaits("speech", "speaker")],
        vec![holds("speech"), awaits("speech", "speaker")],
    ];
    for changes in misfits {
        let replayed = replay(&graph, changes.clone()).err();
        assert!(matches!(replayed, Some(ReplayError::Misfit { .. })), "{changes:?}: {replayed:?}");
    }
    assert!(replay(&graph, vec![holds("speech"), awaits("watcher", "speaker")]).is_ok());
}

#[test]
fn an_export_that_no_graph_made_is_refused() {
    let graph = world::ward();
    let with = |change: &dyn Fn(&mut Export)| {
        let mut export = graph.snapshot().export();
        change(&mut export);
        Graph::restore(graph.vocabulary(), &export).map(|_| ()).unwrap_err()
    };
    let edge = |from: &str, label: &str, to: &str| {
        let since = Version(0);
        ExportedEdge { from: from.into(), label: label.into(), to: to.into(), since, attributes: Vec::new() }
    };
    assert_eq!(
        with(&|e| e.version = Version(u64::MAX)),
        RestoreError::NoVersion { found: Version(u64::MAX) }
    );
    let circle = [
        edge("speech", "holds", "speaker"),
        edge("watcher", "holds", "screen"),
        edge("speech", "awaits", "screen"),
        edge("watcher", "awaits", "speaker"),
    ];
    assert_eq!(with(&|e| e.edges.extend(circle.clone())), RestoreError::WrongLeases);
    let twice = [edge("speech", "holds", "speaker"), edge("watcher", "holds", "speaker")];
    assert_eq!(with(&|e| e.edges.extend(twice.clone())), RestoreError::WrongLeases);
    let two = [edge("speech", "holds", "speaker"), edge("pelea", "holds", "screen")];
    let both = [edge("watcher", "awaits", "speaker"), edge("watcher", "awaits", "screen")];
    assert_eq!(with(&|e| e.edges.extend(two.iter().chain(&both).cloned())), RestoreError::WrongLeases);
}

/// Every agent holds a resource and waits for all: followed as if it were sound, that would take 19^20 steps. And a
/// long chain of frames, with a circle at its end: each of its nodes leads there.
#[test]
fn what_is_refused_is_refused_soon() {
    let mut builder = VocabularyBuilder::new();
    let place = builder.node_type("place", None, Nature::Geometric).unwrap();
    for at in 0..20 {
        builder.agent(format!("a{at}").as_str()).unwrap();
        builder.resource(format!("r{at}").as_str()).unwrap();
    }
    let graph = Graph::new(builder.build());
    let mut export = graph.snapshot().export();
    for agent in 0..20 {
        for resource in 0..20 {
            let label = if agent == resource { "holds" } else { "awaits" };
            export.edges.push(ExportedEdge {
                from: format!("a{agent}").into(),
                label: label.into(),
                to: format!("r{resource}").into(),
                since: Version(0),
                attributes: Vec::new(),
            });
        }
    }
    let refused = Graph::restore(graph.vocabulary(), &export).map(|_| ());
    assert_eq!(refused.unwrap_err(), RestoreError::WrongLeases);

    const DEEP: usize = 20_000;
    let add = |tx: &mut dsr::Transaction| (0..=DEEP).for_each(|at| _ = tx.add_node(format!("n{at}"), place));
    graph.edit(AgentId::DSR, Time(0), add).unwrap();
    let mut export = graph.snapshot().export();
    let below = |parent: usize, child: usize| ExportedTransform {
        parent: format!("n{parent}").into(),
        child: format!("n{child}").into(),
        translation: [0.0; 3],
        rotation: [0.0, 0.0, 0.0, 1.0],
        covariance: None,
        since: Version(0),
        samples: Vec::new(),
    };
    export.transforms = (1..=DEEP).map(|child| below(child - 1, child)).collect();
    assert!(Graph::restore(graph.vocabulary(), &export).is_ok(), "deep is not wrong");
    export.transforms.push(below(2, 0));
    assert!(matches!(
        Graph::restore(graph.vocabulary(), &export).map(|_| ()),
        Err(RestoreError::Unsound(TransactionError::Cycle { .. }))
    ));
}
