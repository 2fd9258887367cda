//! Records: the content of frames as bytes, in postcard, one record after the other.
//!
//! A state is written as its export, part by part, so a large one is never in memory twice. Reading goes through the
//! checks of an export, so bytes that are not a state of the vocabulary are rejected with an error.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::feed::{Entry, Present};
use super::frame::Kind;
use crate::delta::Delta;
use crate::export::{
    Export, ExportedAttribute, ExportedEdge, ExportedNode, ExportedSample, ExportedTransform,
};
use crate::id::{NodeId, ReflexId, Time, Version};
use crate::pose::Covariance;
use crate::transaction::reflexes::Guard;
use crate::vocabulary::Vocabulary;

/// The number of the format. A segment with another number is rejected, except from [`OLDEST`] on; before 4, no
/// reflexes were recorded.
const FORMAT: u32 = 4;
/// The oldest format that can be read. It does not record gaps: [`Follows::Directly`] may be [`Follows::AfterGap`].
const OLDEST: u32 = 2;

/// What precedes a segment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Follows {
    /// Nothing, or what another journal wrote.
    Nothing,
    /// The same journal wrote the segment before it, which ends in the state with which this one begins.
    Directly,
    /// The same, but commits in between may have been left out.
    AfterGap,
}

/// A part of a state. The types of the export omit empty lists, which only self-describing formats support.
#[derive(Serialize, Deserialize)]
enum Part {
    Head(Version, Time, NodeId),
    Node(NodeId, Arc<str>, Arc<str>, Version, Vec<ExportedAttribute>),
    Edge(Arc<str>, Arc<str>, Arc<str>, Version, Vec<ExportedAttribute>),
    Transform(Arc<str>, Arc<str>, Placed, Version, Vec<(Time, Placed)>),
    End,
    Guard(Guard),
}

/// Translation, rotation and covariance.
type Placed = ([f64; 3], [f64; 4], Option<Arc<Covariance>>);

/// Why bytes with a valid checksum are invalid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Malformed {
    Format(u32),
    Bytes,
}

fn put(record: &impl Serialize, bytes: &mut Vec<u8>) {
    // Writing to memory cannot fail, and all these types have a known length.
    let _ = postcard::to_io(record, bytes);
}

/// The first record of a segment.
pub(super) fn put_start(follows: Follows, vocabulary: &Vocabulary, bytes: &mut Vec<u8>) {
    put(&(FORMAT, follows, vocabulary), bytes);
}

/// Writes a commit. Returns the kind of frame that it belongs in.
pub(super) fn put_commit(Entry { delta, registered, dismissed }: &Entry, bytes: &mut Vec<u8>) -> Kind {
    let kind = if registered.is_empty() && dismissed.is_empty() {
        Kind::Deltas
    } else {
        put(&(registered, dismissed), bytes);
        Kind::Guarded
    };
    put(&**delta, bytes);
    kind
}

/// What a commit did to the registered reflexes, and the bytes of its delta.
pub(super) fn guards(kind: Kind, bytes: &[u8]) -> Result<(Guards, &[u8]), Malformed> {
    match kind {
        Kind::Guarded => postcard::take_from_bytes(bytes).map_err(|_| Malformed::Bytes),
        _ => Ok((Guards::default(), bytes)),
    }
}

/// The reflexes that a commit registered, and those that it dismissed.
pub(super) type Guards = (Vec<Guard>, Vec<ReflexId>);

/// What precedes the segment, and the bytes of the vocabulary.
pub(super) fn start(payload: &[u8]) -> Result<(Follows, &[u8]), Malformed> {
    let (format, rest) = postcard::take_from_bytes::<u32>(payload).map_err(|_| Malformed::Bytes)?;
    if !(OLDEST..=FORMAT).contains(&format) {
        return Err(Malformed::Format(format));
    }
    let (follows, vocabulary) = postcard::take_from_bytes(rest).map_err(|_| Malformed::Bytes)?;
    let knows = format > OLDEST || follows == Follows::Nothing;
    Ok((if knows { follows } else { Follows::AfterGap }, vocabulary))
}

pub(super) fn vocabulary(bytes: &[u8]) -> Result<Vocabulary, Malformed> {
    postcard::from_bytes(bytes).map_err(|_| Malformed::Bytes)
}

/// Writes the state part by part. `full` is called after each and may take the bytes.
pub(super) fn put_state<E>(
    Present { snapshot, reflexes }: &Present,
    bytes: &mut Vec<u8>,
    mut full: impl FnMut(&mut Vec<u8>) -> Result<(), E>,
) -> Result<(), E> {
    put(&Part::Head(snapshot.version(), snapshot.time(), snapshot.state().next), bytes);
    for ExportedNode { id, name, node_type, since, attributes } in snapshot.exported_nodes() {
        put(&Part::Node(id, name, node_type, since, attributes), bytes);
        full(bytes)?;
    }
    for ExportedEdge { from, label, to, since, attributes } in snapshot.exported_edges() {
        put(&Part::Edge(from, label, to, since, attributes), bytes);
        full(bytes)?;
    }
    for t in snapshot.exported_transforms() {
        let samples = t.samples.into_iter().map(|s| (s.time, (s.translation, s.rotation, s.covariance)));
        let placed = (t.translation, t.rotation, t.covariance);
        put(&Part::Transform(t.parent, t.child, placed, t.since, samples.collect()), bytes);
        full(bytes)?;
    }
    for guard in reflexes.guards() {
        put(&Part::Guard(guard), bytes);
        full(bytes)?;
    }
    put(&Part::End, bytes);
    Ok(())
}

/// Collects a state from its frames.
#[derive(Debug, Default)]
pub(super) struct Gathered {
    export: Option<Export>,
    guards: Vec<Guard>,
    ended: bool,
}

impl Gathered {
    /// Adds the parts of one frame.
    pub(super) fn take(&mut self, mut payload: &[u8]) -> Result<(), Malformed> {
        while !payload.is_empty() {
            let (part, rest) = postcard::take_from_bytes(payload).map_err(|_| Malformed::Bytes)?;
            payload = rest;
            self.add(part).ok_or(Malformed::Bytes)?;
        }
        Ok(())
    }

    fn add(&mut self, part: Part) -> Option<()> {
        if self.ended {
            return None;
        }
        match (part, &mut self.export) {
            (Part::Head(version, time, next), empty @ None) => {
                let (nodes, edges, transforms) = (Vec::new(), Vec::new(), Vec::new());
                *empty = Some(Export { version, time, next, nodes, edges, transforms });
            }
            (Part::Node(id, name, node_type, since, attributes), Some(export)) => {
                export.nodes.push(ExportedNode { id, name, node_type, since, attributes });
            }
            (Part::Edge(from, label, to, since, attributes), Some(export)) => {
                export.edges.push(ExportedEdge { from, label, to, since, attributes });
            }
            (Part::Transform(parent, child, placed, since, samples), Some(export)) => {
                let (translation, rotation, covariance) = placed;
                let samples = samples.into_iter().map(|(time, (translation, rotation, covariance))| {
                    ExportedSample { time, translation, rotation, covariance }
                });
                export.transforms.push(ExportedTransform {
                    parent,
                    child,
                    translation,
                    rotation,
                    covariance,
                    since,
                    samples: samples.collect(),
                });
            }
            (Part::Guard(guard), Some(_)) => self.guards.push(guard),
            (Part::End, Some(_)) => self.ended = true,
            _ => return None,
        }
        Some(())
    }

    /// The state and its reflexes, if it is complete.
    pub(super) fn whole(self) -> Option<(Export, Vec<Guard>)> {
        self.export.filter(|_| self.ended).map(|export| (export, self.guards))
    }
}

/// Version and time of the state whose first frame this is.
pub(super) fn head(payload: &[u8]) -> Result<(Version, Time), Malformed> {
    match postcard::take_from_bytes(payload) {
        Ok((Part::Head(version, time, _), _)) => Ok((version, time)),
        _ => Err(Malformed::Bytes),
    }
}

/// Whether a state ends with this frame, which is its first one or not.
pub(super) fn ends(mut payload: &[u8], is_first: bool) -> Result<bool, Malformed> {
    let (mut begun, mut ended) = (!is_first, false);
    while !payload.is_empty() {
        let (part, rest) = postcard::take_from_bytes::<Part>(payload).map_err(|_| Malformed::Bytes)?;
        let is_head = matches!(part, Part::Head(..));
        if ended || is_head == begun {
            return Err(Malformed::Bytes);
        }
        (begun, ended, payload) = (true, matches!(part, Part::End), rest);
    }
    Ok(ended)
}

/// The first delta of the bytes, and the bytes after it.
pub(super) fn delta(bytes: &[u8]) -> Result<(Delta, &[u8]), Malformed> {
    postcard::take_from_bytes(bytes).map_err(|_| Malformed::Bytes)
}
