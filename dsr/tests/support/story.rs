//! What fuzzing a journal does with its bytes.
//!
//! Problem: of random bytes hardly any are a delta that fits a state, so what reads them is never tried. Idea: the first
//! byte says what the others are: a whole segment, a frame of one with a right checksum, or a *story*: choices that become
//! edits of a graph, whose deltas and first state are then spoilt a little, a field, a change or a commit at a time, and
//! written with right checksums.
//!
//! Properties: what was committed is read back as it was; of spoilt bytes either less can be read, or what is read is a
//! state: it can be exported and restored, looked at, and a graph goes on from it, whose deltas lead where it went.

use std::sync::{Arc, LazyLock};

use arbitrary::{Arbitrary, Result, Unstructured};
use dsr::{
    AgentId, Change, Covariance, Degree, Delta, Edit, Export, ExportedAttribute, ExportedValue, Graph,
    Holder, HolderRef, Isometry3, Kind, Matrix6, Memory, Nature, NewValue, NodeId, NodeRef, Permission, Pose,
    Preemption, Priority, Recording, ResourceId, Settings, Snapshot, Time, Token, Transaction, Unit, Value,
    Version, VocabularyBuilder,
};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// The kinds of frames, as `dsr/src/journal/frame.rs` numbers them.
const START: u32 = 0;
const STATE: u32 = 1;
const DELTAS: u32 = 2;
const GUARDED: u32 = 3;
/// Bytes of a frame's header.
const HEADER: usize = 28;
const SECOND: u64 = 1_000_000_000;

/// A small graph with samples, covariances, leases and a wait, and a journal of how it came to be.
struct World {
    snapshot: Snapshot,
    /// The payload of a segment's first frame.
    start: Vec<u8>,
    segment: Vec<u8>,
}

static WORLD: LazyLock<World> = LazyLock::new(|| {
    let mut b = VocabularyBuilder::new();
    let place = b.node_type("place", None, Nature::Geometric).expect("new");
    let robot = b.node_type("robot", Some(place), Nature::Geometric).expect("new");
    let thing = b.node_type("thing", None, Nature::Symbolic).expect("new");
    let near = b.label("near", place, place).expect("new");
    b.limit(near, Degree { leaving: Some(1), reaching: Some(2) }).expect("it is there");
    let has = b.label("has", robot, thing).expect("new");
    let size = b.attribute_on_node("size", place, Kind::Number).expect("new");
    b.measured_in(size, Unit::Metre).expect("a number");
    b.attribute_on_node("heavy", thing, Kind::Bool).expect("new");
    b.attribute_on_node("called", thing, Kind::Text).expect("new");
    let owner = b.attribute_on_edge("owner", has, (robot, thing), Kind::Node(place)).expect("new");
    b.attribute_on_edge("since", near, (place, place), Kind::Number).expect("new");
    let eye = b.agent("eye").expect("new");
    b.permit(eye, Permission::anywhere(Token::Transform)).expect("it is there");
    b.permit(eye, Permission::anywhere(Token::Label(near))).expect("it is there");
    let hand = b.agent("hand").expect("new");
    b.permit(hand, Permission::anywhere(Token::Attribute(size))).expect("it is there");
    let speaker = b.resource("speaker").expect("new");
    b.resource("screen").expect("new");
    let graph = Graph::new(b.build());
    let memory = Memory::default();
    let journal = graph.journal(memory.clone(), Settings::default()).expect("there are threads");
    let at = |x: f64, turn: f64| Isometry3::new([x, 0.0, 0.0].into(), [0.0, 0.0, turn].into());
    let edit = |agent, time, edits: &mut dyn FnMut(&mut Transaction)| {
        let commit = graph.edit(agent, Time(time), edits).expect("it fits");
        // One by one, so that the bytes are the same each time.
        journal.wait(commit.version).expect("memory does not fail");
    };
    edit(AgentId::DSR, 0, &mut |tx| {
        tx.add_node("world", place)
            .add_node("robot", robot)
            .add_node("camera", place)
            .add_node("anna", place);
        tx.add_node("cup", thing).set_transform("world", "robot", at(1.0, 0.5));
        let sure = Covariance::new(Matrix6::identity() * 0.01).expect("it is one");
        tx.set_transform("robot", "camera", Pose::new(at(0.0, 0.1), sure));
        tx.add_edge("robot", has, "cup").set_attribute("anna", size, (170.0, Unit::Centimetre));
        tx.set_attribute(HolderRef::edge("robot", has, "cup"), owner, NodeRef::from("anna"));
    });
    for second in 1..4 {
        edit(eye, second * SECOND, &mut |tx| {
            #[expect(clippy::cast_precision_loss, reason = "small")]
            let x = second as f64;
            let unsure = Covariance::new(Matrix6::identity() * x).expect("it is one");
            tx.sample_transform("camera", "anna", Time(second * SECOND), Pose::new(at(x, x), unsure));
            tx.add_edge("anna", near, "robot");
        });
    }
    edit(eye, 5 * SECOND, &mut |tx| _ = tx.claim(speaker, Priority(1), Preemption::Finishes));
    edit(hand, 6 * SECOND, &mut |tx| _ = tx.await_lease(speaker, Priority(2), Preemption::Yields));
    journal.close().expect("memory does not fail");
    let segment = memory.segments().remove(0);
    let length = u32::from_le_bytes(segment[8..12].try_into().expect("four bytes")) as usize;
    World { snapshot: graph.snapshot(), start: segment[HEADER..HEADER + length].to_vec(), segment }
});

/// The journal of the small graph: a seed, and what frames are added to.
pub(crate) fn segment() -> &'static [u8] {
    &WORLD.segment
}

/// Does what the bytes say, and panics if a property does not hold.
pub(crate) fn check(bytes: &[u8]) {
    let Some((first, rest)) = bytes.split_first() else { return };
    let world = &*WORLD;
    let read = match first % 8 {
        // The first byte of a segment is 5 in this count.
        5 => read(bytes.to_vec()),
        0 => {
            let _ = read([segment(), &frame(GUARDED, rest)].concat());
            read([segment(), &frame(DELTAS, rest)].concat())
        }
        1 => read([frame(START, &world.start), frame(STATE, rest)].concat()),
        2 => read([&frame(START, rest), &segment()[HEADER + world.start.len()..]].concat()),
        _ => {
            // It ends where the choices do.
            let _ = story(&mut Unstructured::new(rest));
            return;
        }
    };
    if let Some(snapshot) = read {
        look(&snapshot, Time(SECOND));
    }
}

/// A frame with this payload, as `dsr/src/journal/frame.rs` has it.
fn frame(kind: u32, payload: &[u8]) -> Vec<u8> {
    let mut frame = b"\xd5DSR".to_vec();
    frame.extend(kind.to_le_bytes());
    frame.extend(u32::try_from(payload.len()).expect("short").to_le_bytes());
    frame.extend(crc32fast::hash(payload).to_le_bytes());
    frame.extend([0; 8]);
    frame.extend(crc32fast::hash(&frame).to_le_bytes());
    frame.extend(payload);
    frame
}

/// A part of a state, as `dsr/src/journal/record.rs` has it.
#[derive(Serialize)]
enum Part<'e> {
    Head(Version, Time, NodeId),
    Node(NodeId, &'e str, &'e str, Version, &'e [ExportedAttribute]),
    Edge(&'e str, &'e str, &'e str, Version, &'e [ExportedAttribute]),
    Transform(&'e str, &'e str, Placed<'e>, Version, Vec<(Time, Placed<'e>)>),
    End,
}

type Placed<'e> = (&'e [f64; 3], &'e [f64; 4], &'e Option<Arc<Covariance>>);

/// A segment with this state and these deltas.
fn journal(export: &Export, deltas: &[Delta]) -> Vec<u8> {
    let mut parts = vec![Part::Head(export.version, export.time, export.next)];
    parts
        .extend(export.nodes.iter().map(|n| Part::Node(n.id, &n.name, &n.node_type, n.since, &n.attributes)));
    parts.extend(export.edges.iter().map(|e| Part::Edge(&e.from, &e.label, &e.to, e.since, &e.attributes)));
    parts.extend(export.transforms.iter().map(|t| {
        let samples = t.samples.iter().map(|s| (s.time, (&s.translation, &s.rotation, &s.covariance)));
        let placed = (&t.translation, &t.rotation, &t.covariance);
        Part::Transform(&t.parent, &t.child, placed, t.since, samples.collect())
    }));
    parts.push(Part::End);
    let bytes = |parts: &[u8], part: &Vec<u8>| [parts, part].concat();
    let encoded = parts.iter().map(|part| postcard::to_stdvec(part).expect("it is in memory"));
    let state = encoded.fold(Vec::new(), |all, part| bytes(&all, &part));
    let mut segment = [frame(START, &WORLD.start), frame(STATE, &state)].concat();
    for delta in deltas {
        segment.extend(frame(DELTAS, &postcard::to_stdvec(delta).expect("it is in memory")));
    }
    segment
}

/// Reads a journal and replays all its versions; returns the last one.
fn read(bytes: Vec<u8>) -> Option<Snapshot> {
    let recording = Recording::read([bytes]).ok()?;
    let mut replay = recording.replay().ok()?;
    hold(&replay.snapshot());
    while let Some(Ok(_)) = replay.next() {
        hold(&replay.snapshot());
    }
    // After a delta that does not fit, too, it is where it was.
    let snapshot = replay.snapshot();
    hold(&snapshot);
    assert_eq!(recording.at(snapshot.version()).expect("was replayed").export(), snapshot.export());
    let then = recording.at_time(snapshot.time());
    assert!(then.is_err() || then.is_ok_and(|then| then.time() <= snapshot.time()));
    Some(snapshot)
}

/// A state is one that can be exported and restored.
fn hold(snapshot: &Snapshot) {
    let export = snapshot.export();
    let graph = Graph::restore(snapshot.vocabulary().clone(), &export).expect("a state is a state");
    assert_eq!(graph.snapshot().export(), export);
}

/// Asks a state what can be asked.
fn look(snapshot: &Snapshot, time: Time) {
    let placed = |node: &dsr::NodeView<'_>| node.parent().is_some() || !node.children().is_empty();
    let nodes: Vec<_> = snapshot.nodes().filter(placed).map(|node| node.id).take(8).collect();
    for &from in &nodes {
        for &to in &nodes {
            let _ = snapshot.pose(from, to);
            let _ = snapshot.pose_at(from, to, time);
            let known = snapshot.common_time(from, to);
            let together = snapshot.transform_together(from, to);
            assert!(known.is_ok() || together.is_err(), "who answers knows when");
        }
    }
    let _ = snapshot.sentences();
    for node in snapshot.nodes() {
        let _ = (snapshot.place_sentence(node.id), snapshot.attribute_sentences(Holder::Node(node.id)));
    }
    for resource in snapshot.vocabulary().resources() {
        let _ = (snapshot.lease(resource), snapshot.waiting(resource));
    }
}

fn story(dice: &mut Unstructured<'_>) -> Result<()> {
    let graph = Graph::from_snapshot(&WORLD.snapshot);
    let mut export = graph.snapshot().export();
    let mut deltas = go_on(&graph, dice)?;
    let honest = read(journal(&export, &deltas)).expect("nothing is wrong with it");
    assert_eq!(honest.export(), graph.snapshot().export(), "a replay is what was");
    for _ in 0..dice.int_in_range(1..=4)? {
        spoil(&mut export, &mut deltas, dice)?;
    }
    if let Some(snapshot) = read(journal(&export, &deltas)) {
        go_on(&Graph::from_snapshot(&snapshot), dice)?;
    }
    Ok(())
}

/// Commits a few transactions; their deltas.
fn go_on(graph: &Graph, dice: &mut Unstructured<'_>) -> Result<Vec<Delta>> {
    let mut deltas = Vec::new();
    for _ in 0..dice.int_in_range(0..=8)? {
        let before = graph.snapshot();
        let agents: Vec<_> = graph.vocabulary().agents().collect();
        let writer = if dice.ratio(1, 2)? { AgentId::DSR } else { *dice.choose(&agents)? };
        let edits = (0..dice.int_in_range(1..=4)?).map(|_| edit(dice)).collect::<Result<Vec<_>>>()?;
        let time = time(dice)?;
        // What is refused as a whole is tried edit by edit.
        if !commit(graph, writer, &edits, time, &mut deltas) {
            assert_eq!(graph.snapshot().export(), before.export(), "what is refused leaves no trace");
            for edit in &edits {
                commit(graph, writer, std::slice::from_ref(edit), time, &mut deltas);
            }
        }
    }
    look(&graph.snapshot(), time(dice)?);
    Ok(deltas)
}

/// Commits some edits if that can be, and adds their delta.
fn commit(graph: &Graph, writer: AgentId, edits: &[Edit], time: Time, deltas: &mut Vec<Delta>) -> bool {
    let before = graph.snapshot();
    let mut transaction = Transaction::new(writer);
    transaction.extend(edits.iter().cloned());
    let Ok(commit) = graph.commit(&transaction, time) else { return false };
    if commit.version != before.version() {
        hold(&commit.snapshot);
        let replayed = Graph::replay(graph.vocabulary(), &before.export(), [&*commit.delta]);
        assert_eq!(replayed.expect("it was committed").snapshot().export(), commit.snapshot.export());
        deltas.push((*commit.delta).clone());
    }
    true
}

/// An id of any kind.
fn id<T: DeserializeOwned>(dice: &mut Unstructured<'_>, below: u8) -> Result<T> {
    Ok(postcard::from_bytes(&[dice.int_in_range(0..=below.saturating_sub(1))?]).expect("a small number"))
}

fn name(dice: &mut Unstructured<'_>) -> Result<Arc<str>> {
    let names = ["world", "robot", "camera", "anna", "cup", "speaker", "eye", "a", "b", ""];
    Ok(Arc::from(*dice.choose(&names)?))
}

fn node(dice: &mut Unstructured<'_>) -> Result<NodeRef> {
    Ok(if dice.ratio(1, 4)? { NodeRef::Id(id(dice, 16)?) } else { NodeRef::Name(name(dice)?) })
}

fn time(dice: &mut Unstructured<'_>) -> Result<Time> {
    Ok(Time(match dice.int_in_range(0..=9)? {
        0 => u64::MAX - u64::arbitrary(dice)? % 2,
        1 => u64::arbitrary(dice)?,
        _ => u64::from(u8::arbitrary(dice)?) * SECOND / 8,
    }))
}

fn number(dice: &mut Unstructured<'_>) -> Result<f64> {
    Ok(match dice.int_in_range(0..=9)? {
        0 => f64::arbitrary(dice)?,
        _ => f64::from(i8::arbitrary(dice)?) / 8.0,
    })
}

fn pose(dice: &mut Unstructured<'_>) -> Result<Pose> {
    let place = [number(dice)?, number(dice)?, number(dice)?];
    let mut transform = Isometry3::new(place.into(), [0.0, number(dice)?, number(dice)?].into());
    if dice.ratio(1, 8)? {
        transform.rotation.as_mut_unchecked().coords *= number(dice)?;
    }
    if dice.ratio(1, 2)? {
        return Ok(transform.into());
    }
    let mut root = Matrix6::zeros();
    for row in 0..dice.int_in_range(0..=6)? {
        root[(row, dice.int_in_range(0..=5)?)] = number(dice)?;
    }
    let covariance = Covariance::new(root * root.transpose());
    Ok(Pose { transform, covariance: covariance.ok().map(Arc::new) })
}

fn edit(dice: &mut Unstructured<'_>) -> Result<Edit> {
    let (mut from, mut to) = (node(dice)?, node(dice)?);
    let kind = dice.int_in_range(0..=13)?;
    if (8..=10).contains(&kind) && dice.ratio(3, 4)? {
        let hung = [("world", "robot"), ("robot", "camera"), ("camera", "anna")];
        let &(parent, child) = dice.choose(&hung)?;
        (from, to) = (NodeRef::from(parent), NodeRef::from(child));
    }
    let holder = |dice: &mut Unstructured<'_>, node: NodeRef, to| {
        let label = id(dice, 8)?;
        Ok(if dice.ratio(1, 2)? { HolderRef::edge(node, label, to) } else { HolderRef::node(node) })
    };
    let preemption = |finishes| if finishes { Preemption::Finishes } else { Preemption::Yields };
    Ok(match kind {
        0 => Edit::AddNode { name: name(dice)?, node_type: id(dice, 8)? },
        1 => Edit::RemoveNode { node: from },
        2 | 3 => Edit::AddEdge { from, label: id(dice, 8)?, to },
        4 => Edit::RemoveEdge { from, label: id(dice, 8)?, to },
        5 | 6 => {
            let value = match dice.int_in_range(0..=4)? {
                0 => NewValue::Number(number(dice)?),
                1 => NewValue::Quantity(number(dice)?, Unit::Centimetre),
                2 => NewValue::Text(name(dice)?),
                3 => NewValue::Bool(bool::arbitrary(dice)?),
                _ => NewValue::Node(node(dice)?),
            };
            Edit::SetAttribute { holder: holder(dice, from, to)?, attribute: id(dice, 12)?, value }
        }
        7 => Edit::ClearAttribute { holder: holder(dice, from, to)?, attribute: id(dice, 12)? },
        8 => Edit::SetTransform { parent: from, child: to, pose: pose(dice)? },
        9 => Edit::SampleTransform { parent: from, child: to, time: time(dice)?, pose: pose(dice)? },
        10 => Edit::RemoveTransform { parent: from, child: to },
        11 | 12 => {
            let resource: ResourceId = id(dice, 3)?;
            let (priority, preemption) =
                (Priority(i8::arbitrary(dice)?.into()), preemption(bool::arbitrary(dice)?));
            match dice.int_in_range(0..=2)? {
                0 => Edit::Claim { resource, priority, preemption },
                1 => Edit::Await { resource, priority, preemption },
                _ => Edit::Release { resource },
            }
        }
        _ => Edit::Expire { agent: id(dice, 4)? },
    })
}

/// Changes a thing or two that a disk or another program might.
fn spoil(export: &mut Export, deltas: &mut Vec<Delta>, dice: &mut Unstructured<'_>) -> Result<()> {
    let which = dice.int_in_range(0..=7)?;
    if which == 7 {
        return spoil_state(export, dice);
    }
    if deltas.is_empty() {
        let version = Version(export.version.0.wrapping_add(1));
        let (changes, reflexes) = (Vec::new(), Vec::new());
        deltas.push(Delta { version, time: export.time, writer: AgentId::DSR, changes, reflexes });
    }
    let (from, to) = (dice.choose_index(deltas.len())?, dice.choose_index(deltas.len())?);
    let changes = deltas[from].changes.len();
    match which {
        0 if changes > 0 => _ = deltas[from].changes.remove(dice.choose_index(changes)?),
        1 if changes > 0 => {
            let (a, b) = (dice.choose_index(changes)?, dice.choose_index(changes)?);
            deltas[from].changes.swap(a, b);
        }
        2 | 3 if changes > 0 => {
            let mut change = deltas[from].changes[dice.choose_index(changes)?].clone();
            spoil_change(&mut change, dice)?;
            let at = dice.int_in_range(0..=deltas[to].changes.len())?;
            deltas[to].changes.insert(at, change);
        }
        4 => {
            let change = made_up(dice)?;
            deltas[to].changes.push(change);
        }
        5 => (deltas[from].time, deltas[from].writer) = (time(dice)?, id(dice, 6)?),
        6 => {
            // A commit less, and those behind it a version earlier.
            deltas.remove(from);
            deltas[from..].iter_mut().for_each(|delta| delta.version.0 = delta.version.0.wrapping_sub(1));
        }
        _ => {}
    }
    Ok(())
}

/// Another value somewhere in a change.
fn spoil_change(change: &mut Change, dice: &mut Unstructured<'_>) -> Result<()> {
    match change {
        Change::AttributeRemoved { holder, attribute, old: value }
        | Change::AttributeAdded { holder, attribute, new: value }
        | Change::AttributeChanged { holder, attribute, new: value, .. } => match dice.int_in_range(0..=2)? {
            0 => *holder = some_holder(dice)?,
            1 => *attribute = id(dice, 12)?,
            _ => *value = some_value(dice)?,
        },
        Change::EdgeRemoved { edge } | Change::EdgeAdded { edge } => match dice.int_in_range(0..=2)? {
            0 => edge.from = id(dice, 16)?,
            1 => edge.label = id(dice, 8)?,
            _ => edge.to = id(dice, 16)?,
        },
        Change::NodeRemoved { node, name: called, node_type }
        | Change::NodeAdded { node, name: called, node_type } => match dice.int_in_range(0..=2)? {
            0 => *node = id(dice, 32)?,
            1 => *called = name(dice)?,
            _ => *node_type = id(dice, 8)?,
        },
        Change::TransformRemoved { parent, child, old: new }
        | Change::TransformAdded { parent, child, new, .. }
        | Change::TransformSampled { parent, child, new, .. }
        | Change::TransformChanged { parent, child, new, .. } => match dice.int_in_range(0..=2)? {
            0 => *parent = id(dice, 16)?,
            1 => *child = id(dice, 16)?,
            _ => *new = pose(dice)?,
        },
    }
    if let Change::TransformSampled { time: when, .. } | Change::TransformAdded { time: Some(when), .. } =
        change
        && dice.ratio(1, 2)?
    {
        *when = time(dice)?;
    }
    Ok(())
}

fn some_holder(dice: &mut Unstructured<'_>) -> Result<Holder> {
    if dice.ratio(1, 2)? {
        return Ok(Holder::Node(id(dice, 16)?));
    }
    Ok(Holder::Edge(dsr::EdgeKey { from: id(dice, 16)?, label: id(dice, 8)?, to: id(dice, 16)? }))
}

fn some_value(dice: &mut Unstructured<'_>) -> Result<Value> {
    Ok(match dice.int_in_range(0..=3)? {
        0 => Value::Number(number(dice)?),
        1 => Value::Text(name(dice)?),
        2 => Value::Bool(bool::arbitrary(dice)?),
        _ => Value::Node(id(dice, 16)?),
    })
}

/// A change that nothing has led to.
fn made_up(dice: &mut Unstructured<'_>) -> Result<Change> {
    let (parent, child) = (id(dice, 16)?, id(dice, 16)?);
    Ok(match dice.int_in_range(0..=7)? {
        0 => Change::NodeAdded { node: id(dice, 64)?, name: name(dice)?, node_type: id(dice, 8)? },
        1 => Change::NodeRemoved { node: parent, name: name(dice)?, node_type: id(dice, 8)? },
        2 => Change::EdgeAdded { edge: dsr::EdgeKey { from: parent, label: id(dice, 8)?, to: child } },
        3 => Change::EdgeRemoved { edge: dsr::EdgeKey { from: parent, label: id(dice, 8)?, to: child } },
        4 => {
            let (holder, attribute) = (some_holder(dice)?, id(dice, 12)?);
            Change::AttributeAdded { holder, attribute, new: some_value(dice)? }
        }
        5 => {
            let when = if dice.ratio(1, 2)? { Some(time(dice)?) } else { None };
            Change::TransformAdded { parent, child, new: pose(dice)?, time: when }
        }
        6 => Change::TransformSampled { parent, child, time: time(dice)?, old: None, new: pose(dice)? },
        _ => Change::TransformRemoved { parent, child, old: pose(dice)? },
    })
}

fn spoil_state(export: &mut Export, dice: &mut Unstructured<'_>) -> Result<()> {
    let (nodes, edges) = (dice.choose_index(export.nodes.len())?, dice.choose_index(export.edges.len())?);
    let transform = dice.choose_index(export.transforms.len())?;
    match dice.int_in_range(0..=11)? {
        0 => _ = export.nodes.remove(nodes),
        1 => export.nodes[nodes].id = id(dice, 32)?,
        2 => export.nodes[nodes].name = name(dice)?,
        3 => export.nodes.swap(nodes, 0),
        4 => _ = export.edges.remove(edges),
        5 => export.edges[edges].to = name(dice)?,
        6 => {
            let edge = &mut export.edges[edges];
            if let Some(attribute) = edge.attributes.first_mut() {
                attribute.value = ExportedValue::Number(number(dice)?);
            }
        }
        7 => (export.next, export.version) = (id(dice, 64)?, Version(u64::arbitrary(dice)?)),
        8 => _ = export.transforms.remove(transform),
        9 => export.transforms[transform].parent = name(dice)?,
        10 => {
            let Isometry3 { translation, rotation } = pose(dice)?.transform;
            let transform = &mut export.transforms[transform];
            (transform.translation, transform.rotation) = (translation.vector.into(), rotation.coords.into());
        }
        _ => {
            let (when, samples) = (time(dice)?, &mut export.transforms[transform].samples);
            if let Some(sample) = samples.first_mut() {
                sample.time = when;
            }
            samples.reverse();
        }
    }
    Ok(())
}
