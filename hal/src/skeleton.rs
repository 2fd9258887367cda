//! The people in front of the robot.

use crate::Operation;

/// The pose of a person: metres and radians, in the frame of the world.
pub type Pose = nalgebra::Isometry3<f64>;

/// A tracker of upper bodies.
///
/// A person is named by the node that stands for them; a back end tells people apart as well as it can, and never reports
/// one body for two names. Both operations wait for a state, not for a change: if the person is in view already,
/// `await_person` ends after the frames that its hysteresis needs. A back end hides single lost or spurious frames.
pub trait Skeleton: Send + Sync {
    /// Waits until this person has been in view for several frames. Returns their pose.
    fn await_person<'a>(&'a self, person: &'a str) -> Operation<'a, Pose>;

    /// Waits until this person has been out of view for several frames.
    fn await_loss<'a>(&'a self, person: &'a str) -> Operation<'a, ()>;
}
