//! Initial poses, written as numbers.
//!
//! Problem: PDDL has no literal for a rigid transform. Idea: six numeric functions of a pair of frames; a problem gives
//! those that are not zero: `(= (rt_x robot screen) 0.2)`. One of them is enough to make the second frame a child of the
//! first. Units are metres and radians. The rotation is roll about x, then pitch about y, then yaw about z, all about the
//! axes of the parent.

use nalgebra::{Isometry3, Translation3, UnitQuaternion};
use pddl::model::Name;

/// One of the six numbers of a pose.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[expect(missing_docs, reason = "the names say it")]
pub enum PoseComponent {
    X,
    Y,
    Z,
    Roll,
    Pitch,
    Yaw,
}

impl PoseComponent {
    /// The component that a function of this name gives.
    pub fn named(name: &Name) -> Option<Self> {
        Some(match name.as_str() {
            "rt_x" => Self::X,
            "rt_y" => Self::Y,
            "rt_z" => Self::Z,
            "rt_roll" => Self::Roll,
            "rt_pitch" => Self::Pitch,
            "rt_yaw" => Self::Yaw,
            _ => return None,
        })
    }
}

/// The numbers given so far.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct PoseNumbers([f64; 6]);

impl PoseNumbers {
    pub(crate) fn set(&mut self, component: PoseComponent, number: f64) {
        self.0[component as usize] = number;
    }

    pub(crate) fn isometry(self) -> Isometry3<f64> {
        let [x, y, z, roll, pitch, yaw] = self.0;
        let rotation = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
        Isometry3::from_parts(Translation3::new(x, y, z), rotation)
    }
}
