//! Kinematic chains: from one frame to another through their closest common ancestor.
//!
//! Convention: `transform(from, to)` maps coordinates of frame `to` into frame `from`, so it is the pose of `to`
//! as seen from `from`, and `transform(world, robot)` is where the robot is in the world. An RT edge from parent
//! to child holds `transform(parent, child)`. With `w` the closest common ancestor,
//!
//! ```text
//! transform(from, to) = transform(w, from)⁻¹ · transform(w, to)
//! ```
//!
//! that is, inverses on the way up, products on the way down. Cost: one product per RT edge of the chain and one
//! inversion, after one walk to the root per end to level their depths.
//!
//! Source: Marfil et al., §3.1, "kinematic chain".

use std::sync::Arc;

use nalgebra::Isometry3;

use crate::dictionary::Nature;
use crate::id::NodeId;
use crate::state::State;

/// Why there is no chain.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ChainError {
    /// No such node.
    #[error("no node {node}")]
    UnknownNode {
        /// The id.
        node: NodeId,
    },
    /// The node's type has no place in the geometric quiver.
    #[error("'{node}' is not geometric")]
    NotGeometric {
        /// The node's name.
        node: Arc<str>,
    },
    /// No transform connects the two now.
    #[error("no chain from '{from}' to '{to}'")]
    NotConnected {
        /// The first frame.
        from: Arc<str>,
        /// The second frame.
        to: Arc<str>,
    },
}

impl State {
    pub(crate) fn transform(&self, from: NodeId, to: NodeId) -> Result<Isometry3<f64>, ChainError> {
        let (mut up, mut down) = (self.depth(from)?, self.depth(to)?);
        let disconnected = || ChainError::NotConnected { from: self.name(from), to: self.name(to) };
        let (mut a, mut b) = (from, to);
        // Poses of `from` and `to` in the frames reached so far.
        let (mut from_pose, mut to_pose) = (Isometry3::identity(), Isometry3::identity());
        let step = |at: &mut NodeId, pose: &mut Isometry3<f64>| {
            let joint = self.joint(*at).ok_or_else(disconnected)?;
            *pose = joint.transform * *pose;
            *at = joint.parent;
            Ok(())
        };
        // Whichever is deeper goes up; on a level, both do, and meet at the closest common ancestor.
        while a != b {
            let (a_rises, b_rises) = (up >= down, down >= up);
            if a_rises {
                step(&mut a, &mut from_pose)?;
                up = up.saturating_sub(1);
            }
            if b_rises {
                step(&mut b, &mut to_pose)?;
                down = down.saturating_sub(1);
            }
        }
        Ok(from_pose.inv_mul(&to_pose))
    }

    pub(crate) fn distance(&self, from: NodeId, to: NodeId) -> Result<f64, ChainError> {
        Ok(self.transform(from, to)?.translation.vector.norm())
    }

    /// How many transforms lie above a node.
    fn depth(&self, id: NodeId) -> Result<u32, ChainError> {
        let node = self.node(id).ok_or(ChainError::UnknownNode { node: id })?;
        if self.dictionary.nature(node.node_type()) != Some(Nature::Geometric) {
            return Err(ChainError::NotGeometric { node: self.name(id) });
        }
        let (mut at, mut depth) = (id, 0);
        while let Some(joint) = self.joint(at) {
            at = joint.parent;
            depth += 1;
        }
        Ok(depth)
    }
}
