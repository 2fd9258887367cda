//! Any bytes as a segment of a journal; and as the deltas of one, with checksums that are right.
#![no_main]

use std::sync::LazyLock;

use dsr::{AgentId, DictionaryBuilder, Graph, Isometry3, Kind, Memory, Nature, Recording, Settings, Time};

/// A segment with a state and a few deltas, to which frames can be added.
static SEGMENT: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let mut b = DictionaryBuilder::new();
    let place = b.node_type("place", None, Nature::Geometric).expect("new");
    let near = b.label("near", place, place).expect("new");
    let size = b.attribute_on_node("size", place, Kind::Number).expect("new");
    let owner = b.attribute_on_edge("owner", near, (place, place), Kind::Node(place)).expect("new");
    b.resource("speaker").expect("new");
    let graph = Graph::new(b.build());
    let memory = Memory::default();
    let journal = graph.journal(memory.clone(), Settings::default()).expect("there are threads");
    for time in 0..3 {
        graph
            .edit(AgentId::DSR, Time(time), |tx| {
                let (a, b) = (format!("a{time}"), format!("b{time}"));
                tx.add_node(a.as_str(), place).add_node(b.as_str(), place);
                tx.set_attribute(a.as_str(), size, 1.0).add_edge(a.as_str(), near, b.as_str());
                tx.set_attribute(dsr::HolderRef::edge(a.as_str(), near, b.as_str()), owner, dsr::NodeRef::from(a.as_str()));
                tx.sample_transform("a0", b.as_str(), Time(time), Isometry3::translation(1.0, 0.0, 0.0));
            })
            .expect("fits");
    }
    journal.close().expect("memory does not fail");
    memory.segments().remove(0)
});

/// Reads a journal and goes through all its versions.
fn read(bytes: Vec<u8>) {
    let Ok(recording) = Recording::read([bytes]) else { return };
    let Ok(mut replay) = recording.replay() else { return };
    for played in replay.by_ref() {
        if played.is_err() {
            return;
        }
    }
    let snapshot = replay.snapshot();
    let graph = Graph::restore(recording.dictionary().clone(), &snapshot.export()).expect("a state is a state");
    assert_eq!(graph.snapshot().export(), snapshot.export());
    assert_eq!(recording.at(snapshot.version()).expect("was replayed").export(), snapshot.export());
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

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    read(bytes.to_vec());
    // What a journal goes on with: deltas; and what one begins with: a dictionary and a state.
    read([SEGMENT.as_slice(), &frame(2, bytes)].concat());
    let start = SEGMENT.iter().skip(28).copied().take(4096).collect::<Vec<_>>();
    let length = u32::from_le_bytes([SEGMENT[8], SEGMENT[9], SEGMENT[10], SEGMENT[11]]) as usize;
    read([frame(0, &start[..length]), frame(1, bytes)].concat());
    read([frame(0, bytes), SEGMENT[28 + length..].to_vec()].concat());
});
