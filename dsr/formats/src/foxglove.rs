//! The message schemas that Foxglove shows by itself: poses in its 3D panel, sentences in its log panel.
//!
//! Between two messages Foxglove interpolates the pose of a frame. A moving frame is interpolated in the graph too. A
//! static frame that is moved at once is therefore written twice: its old pose until then, and its new one.
//!
//! Source: Foxglove's schemas `FrameTransforms` and `Log`.

use dsr::{Change, Delta, ExportedTransform, NodeId, Pose, Snapshot, Time};
use serde::Serialize;

/// The schema of [`Transforms`], by its name.
pub(super) const TRANSFORMS: (&str, &str) = (
    "foxglove.FrameTransforms",
    r#"{"title": "foxglove.FrameTransforms", "type": "object", "properties": {"transforms": {"type": "array", "items": {
 "title": "foxglove.FrameTransform", "type": "object", "properties": {
  "timestamp": {"type": "object", "title": "time", "properties": {
   "sec": {"type": "integer", "minimum": 0}, "nsec": {"type": "integer", "minimum": 0, "maximum": 999999999}}},
  "parent_frame_id": {"type": "string"}, "child_frame_id": {"type": "string"},
  "translation": {"title": "foxglove.Vector3", "type": "object", "properties": {
   "x": {"type": "number"}, "y": {"type": "number"}, "z": {"type": "number"}}},
  "rotation": {"title": "foxglove.Quaternion", "type": "object", "properties": {
   "x": {"type": "number"}, "y": {"type": "number"}, "z": {"type": "number"}, "w": {"type": "number"}}}}}}}}"#,
);

/// The schema of [`Log`], by its name.
pub(super) const LOG: (&str, &str) = (
    "foxglove.Log",
    r#"{"title": "foxglove.Log", "type": "object", "properties": {
 "timestamp": {"type": "object", "title": "time", "properties": {
  "sec": {"type": "integer", "minimum": 0}, "nsec": {"type": "integer", "minimum": 0, "maximum": 999999999}}},
 "level": {"type": "integer", "oneOf": [{"title": "UNKNOWN", "const": 0}, {"title": "DEBUG", "const": 1},
  {"title": "INFO", "const": 2}, {"title": "WARNING", "const": 3}, {"title": "ERROR", "const": 4},
  {"title": "FATAL", "const": 5}]},
 "message": {"type": "string"}, "name": {"type": "string"}, "file": {"type": "string"},
 "line": {"type": "integer", "minimum": 0}}}"#,
);

#[derive(Serialize)]
struct Stamp {
    sec: u64,
    nsec: u64,
}

impl From<Time> for Stamp {
    fn from(Time(nanoseconds): Time) -> Self {
        Self { sec: nanoseconds / 1_000_000_000, nsec: nanoseconds % 1_000_000_000 }
    }
}

#[derive(Serialize)]
struct Vector {
    x: f64,
    y: f64,
    z: f64,
}

#[derive(Serialize)]
struct Quaternion {
    x: f64,
    y: f64,
    z: f64,
    w: f64,
}

#[derive(Serialize)]
struct Transform {
    timestamp: Stamp,
    parent_frame_id: String,
    child_frame_id: String,
    translation: Vector,
    rotation: Quaternion,
}

/// Poses of frames.
#[derive(Serialize)]
pub(super) struct Transforms {
    transforms: Vec<Transform>,
}

impl Transforms {
    /// All poses of a state.
    pub(super) fn of_state(snapshot: &Snapshot) -> Option<Self> {
        let of = |transform: &ExportedTransform| {
            let at = |time, [x, y, z]: [f64; 3], [i, j, k, w]: [f64; 4]| Transform {
                timestamp: Stamp::from(time),
                parent_frame_id: transform.parent.to_string(),
                child_frame_id: transform.child.to_string(),
                translation: Vector { x, y, z },
                rotation: Quaternion { x: i, y: j, z: k, w },
            };
            let samples = transform.samples.iter().map(|s| at(s.time, s.translation, s.rotation));
            let stands = at(snapshot.time(), transform.translation, transform.rotation);
            samples.chain(transform.samples.is_empty().then_some(stands)).collect::<Vec<_>>()
        };
        Self::some(snapshot.export().transforms.iter().flat_map(of).collect())
    }

    /// The poses that a commit changed. `names` is the state after it. A removed transform is not written, because the
    /// schema has no way to express it.
    pub(super) fn of_commit(delta: &Delta, names: &Snapshot) -> Option<Self> {
        let at = |time: Time, parent: NodeId, child: NodeId, pose: &Pose| {
            let (place, turn) = (&pose.transform.translation.vector, &pose.transform.rotation.coords);
            Some(Transform {
                timestamp: Stamp::from(time),
                parent_frame_id: names.name(parent)?.to_owned(),
                child_frame_id: names.name(child)?.to_owned(),
                translation: Vector { x: place.x, y: place.y, z: place.z },
                rotation: Quaternion { x: turn.x, y: turn.y, z: turn.z, w: turn.w },
            })
        };
        let moved = delta.changes.iter().flat_map(|change| match *change {
            Change::TransformAdded { parent, child, ref new, time } => {
                [None, at(time.unwrap_or(delta.time), parent, child, new)]
            }
            Change::TransformChanged { parent, child, ref old, ref new } => {
                let before = delta.time.0.checked_sub(1).map(Time);
                [before.and_then(|time| at(time, parent, child, old)), at(delta.time, parent, child, new)]
            }
            Change::TransformSampled { parent, child, time, ref new, .. } => {
                [None, at(time, parent, child, new)]
            }
            _ => [None, None],
        });
        Self::some(moved.flatten().collect())
    }

    fn some(transforms: Vec<Transform>) -> Option<Self> {
        (!transforms.is_empty()).then_some(Self { transforms })
    }
}

/// A line of a log.
#[derive(Serialize)]
pub(super) struct Log<'a> {
    timestamp: Stamp,
    level: u8,
    message: String,
    name: &'a str,
    file: &'static str,
    line: u32,
}

impl<'a> Log<'a> {
    /// The sentences of a commit. A commit that only moves frames has the level debug, one in which a reflex fired the
    /// level warning.
    pub(super) fn of_commit(delta: &Delta, sentences: &[String], writer: &'a str) -> Self {
        let moves = |change: &Change| {
            matches!(change, Change::TransformChanged { .. } | Change::TransformSampled { .. })
        };
        let level = match delta.reflexes.is_empty() {
            false => 3,
            true if delta.changes.iter().all(moves) => 1,
            true => 2,
        };
        let (timestamp, message) = (Stamp::from(delta.time), sentences.join("; "));
        Self { timestamp, level, message, name: writer, file: "", line: 0 }
    }
}
