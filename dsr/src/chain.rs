//! Kinematic chains: from one frame to another through their closest common ancestor.
//!
//! Convention: `transform(from, to)` maps coordinates of frame `to` into frame `from`, so it is the pose of `to` as
//! seen from `from`; `transform(world, robot)` is where the robot is in the world. An RT edge from parent to child
//! holds `transform(parent, child)`. With `w` the closest common ancestor,
//!
//! ```text
//! transform(from, to) = transform(w, from)⁻¹ · transform(w, to)
//! ```
//!
//! that is, inverses on the way up and products on the way down. Each edge contributes its newest pose, or its pose at
//! a time. Invariant: a chain is read from one snapshot, so all its poses are of one version; edges above the common
//! ancestor do not matter. Cost: one product per RT edge. A frame and its ancestor need one walk; two branches need
//! another walk from each to the root, to find where they meet.
//!
//! Source: Marfil et al., §3.1, "kinematic chain"; Foote, "tf: the transform library", TePRA 2013, for common times.

use std::cell::Cell;
use std::sync::Arc;

use nalgebra::Isometry3;
use smallvec::SmallVec;

use crate::block::{Frames, Joint, place};
use crate::id::{NodeId, Time};
use crate::pose::{Pose, Uncertain};
use crate::state::State;
use crate::vocabulary::Nature;

/// Why there is no transform between two frames.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ChainError {
    /// No such node.
    #[error("no node {node}")]
    UnknownNode {
        /// The id.
        node: NodeId,
    },
    /// The node's type is not geometric.
    #[error("'{node}' is not geometric")]
    NotGeometric {
        /// The node's name.
        node: Arc<str>,
    },
    /// No chain of transforms connects the two now.
    #[error("no chain from '{from}' to '{to}'")]
    NotConnected {
        /// The first frame.
        from: Arc<str>,
        /// The second frame.
        to: Arc<str>,
    },
    /// An edge of the chain has no pose at the time.
    #[error("'{child}' in '{parent}' is known from {} to {} ns, not at {}", first.0, last.0, asked.0)]
    Extrapolation {
        /// The parent of the edge.
        parent: Arc<str>,
        /// The child of the edge.
        child: Arc<str>,
        /// The requested time.
        asked: Time,
        /// The first time for which the edge has a pose.
        first: Time,
        /// The last one.
        last: Time,
    },
}

/// A walk up the tree. The frames of a robot usually share a block, which is looked up once.
struct Climb<'a> {
    state: &'a State,
    at: NodeId,
    block: usize,
    frames: Option<&'a Frames>,
}

impl<'a> Climb<'a> {
    fn new(state: &'a State, at: NodeId) -> Self {
        let block = place(at).0;
        Self { state, at, block, frames: state.frames(block) }
    }

    /// Goes to the parent. Returns the frame that it leaves and its transform.
    fn step(&mut self) -> Option<(NodeId, &'a Joint)> {
        let (child, (block, slot)) = (self.at, place(self.at));
        if block != self.block {
            (self.block, self.frames) = (block, self.state.frames(block));
        }
        let joint = self.frames?.joints[slot].as_ref()?;
        self.at = joint.parent;
        Some((child, joint))
    }
}

/// The transforms above a frame, from the frame upwards.
type Path<'a> = SmallVec<[(NodeId, &'a Joint); 32]>;

/// The chain between two frames: the transforms from each up to their common ancestor.
struct Between<'a> {
    up: Path<'a>,
    down: Path<'a>,
}

/// The pose of `to` in `from`, by the newest poses.
pub(crate) fn transform(state: &State, from: NodeId, to: NodeId) -> Result<Isometry3<f64>, ChainError> {
    chain(state, from, to, |_, joint| Ok(joint.pose.transform))
}

/// The pose of `to` in `from` at a time.
pub(crate) fn transform_at(
    state: &State,
    from: NodeId,
    to: NodeId,
    time: Time,
) -> Result<Isometry3<f64>, ChainError> {
    chain(state, from, to, |child, joint| match &joint.track {
        None => Ok(joint.pose.transform),
        Some(track) => track.at(time).map_err(|known| outside(state, child, joint, time, known)),
    })
}

fn outside(
    state: &State,
    child: NodeId,
    joint: &Joint,
    asked: Time,
    (first, last): (Time, Time),
) -> ChainError {
    let (parent, child) = (state.name(joint.parent), state.name(child));
    ChainError::Extrapolation { parent, child, asked, first, last }
}

/// Like [`transform`], with the covariance.
pub(crate) fn pose(state: &State, from: NodeId, to: NodeId) -> Result<Pose, ChainError> {
    uncertain(state, from, to, |_, joint| Ok(Uncertain::of(&joint.pose, joint.track.is_some())))
}

/// Like [`transform_at`], with the covariance.
pub(crate) fn pose_at(state: &State, from: NodeId, to: NodeId, time: Time) -> Result<Pose, ChainError> {
    uncertain(state, from, to, |child, joint| match &joint.track {
        None => Ok(Uncertain::of(&joint.pose, false)),
        Some(track) => {
            let pose = track.pose_at(time).map_err(|known| outside(state, child, joint, time, known))?;
            Ok(Uncertain::of(&pose, true))
        }
    })
}

fn uncertain(
    state: &State,
    from: NodeId,
    to: NodeId,
    pose: impl Fn(NodeId, &Joint) -> Result<Uncertain, ChainError>,
) -> Result<Pose, ChainError> {
    let Between { up, down } = between(state, from, to)?;
    let along = |path: Path<'_>| {
        path.into_iter()
            .try_fold(Uncertain::identity(), |below, (child, joint)| Ok(pose(child, joint)? * below))
    };
    Ok((along(up)?.inverse() * along(down)?).pose())
}

/// The pose of `to` in `from` at their newest common time. Usually all edges have the same newest time; then the newest
/// poses are the answer.
pub(crate) fn transform_together(
    state: &State,
    from: NodeId,
    to: NodeId,
) -> Result<Isometry3<f64>, ChainError> {
    let (oldest, newest) = (Cell::new(Time(u64::MAX)), Cell::new(Time(0)));
    let pose = chain(state, from, to, |_, joint| {
        if joint.track.is_some() {
            oldest.set(oldest.get().min(joint.newest));
            newest.set(newest.get().max(joint.newest));
        }
        Ok(joint.pose.transform)
    })?;
    // The walk may have read edges above the common ancestor too; then the times are compared again without them.
    if oldest.get() >= newest.get() {
        return Ok(pose);
    }
    match common_time(state, from, to)? {
        Some(time) => transform_at(state, from, to, time),
        None => Ok(pose),
    }
}

/// The oldest of the newest times of the moving edges between two frames.
pub(crate) fn common_time(state: &State, from: NodeId, to: NodeId) -> Result<Option<Time>, ChainError> {
    let Between { up, down } = between(state, from, to)?;
    Ok(up.iter().chain(&down).filter(|(_, joint)| joint.track.is_some()).map(|(_, joint)| joint.newest).min())
}

pub(crate) fn distance(state: &State, from: NodeId, to: NodeId) -> Result<f64, ChainError> {
    Ok(transform(state, from, to)?.translation.vector.norm())
}

pub(crate) fn bearing(state: &State, from: NodeId, to: NodeId) -> Result<f64, ChainError> {
    let at = transform(state, from, to)?.translation.vector;
    Ok(at.y.atan2(at.x))
}

fn known_frame(state: &State, id: NodeId) -> Result<(), ChainError> {
    let node = state.node(id).ok_or(ChainError::UnknownNode { node: id })?;
    if state.vocabulary.nature(node.node_type()) == Some(Nature::Geometric) {
        return Ok(());
    }
    Err(ChainError::NotGeometric { node: state.name(id) })
}

/// The pose of `frame` in its ancestor `above`; `None` if it is not an ancestor, or if an edge on the way has no pose.
fn below(
    state: &State,
    above: NodeId,
    frame: NodeId,
    pose: impl Fn(NodeId, &Joint) -> Result<Isometry3<f64>, ChainError>,
) -> Option<Isometry3<f64>> {
    let mut climb = Climb::new(state, frame);
    let (child, joint) = climb.step()?;
    let mut found = pose(child, joint).ok()?;
    while climb.at != above {
        let (child, joint) = climb.step()?;
        found = pose(child, joint).ok()? * found;
    }
    Some(found)
}

fn chain(
    state: &State,
    from: NodeId,
    to: NodeId,
    pose: impl Fn(NodeId, &Joint) -> Result<Isometry3<f64>, ChainError>,
) -> Result<Isometry3<f64>, ChainError> {
    // Usually one frame is an ancestor of the other, which one walk finds out. If not, the general way finds the error.
    if from != to {
        if let Some(found) = below(state, from, to, &pose) {
            return Ok(found);
        }
        if let Some(found) = below(state, to, from, &pose) {
            return Ok(found.inverse());
        }
    }
    let Between { up, down } = between(state, from, to)?;
    let along = |path: Path<'_>| {
        path.into_iter()
            .try_fold(Isometry3::identity(), |below, (child, joint)| Ok(pose(child, joint)? * below))
    };
    Ok(along(up)?.inv_mul(&along(down)?))
}

fn between(state: &State, from: NodeId, to: NodeId) -> Result<Between<'_>, ChainError> {
    known_frame(state, from)?;
    known_frame(state, to)?;
    let path = |start, end| {
        let mut climb = Climb::new(state, start);
        let mut path = Path::new();
        while climb.at != end
            && let Some(step) = climb.step()
        {
            path.push(step);
        }
        (path, climb.at)
    };
    let (mut down, top) = path(to, from);
    if top == from {
        return Ok(Between { up: Path::new(), down });
    }
    let (mut up, other) = path(from, to);
    if other == to {
        return Ok(Between { up, down: Path::new() });
    }
    if top != other {
        return Err(ChainError::NotConnected { from: state.name(from), to: state.name(to) });
    }
    // Both paths lead to the root. The edges that they share lie above the common ancestor.
    while let (Some((a, _)), Some((b, _))) = (up.last(), down.last())
        && a == b
    {
        up.pop();
        down.pop();
    }
    Ok(Between { up, down })
}
