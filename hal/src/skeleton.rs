//! The person in front of the robot.

use crate::Operation;

/// The pose of a person: metres and radians, in the frame of the world.
pub type Pose = nalgebra::Isometry3<f64>;

/// A tracker of upper bodies.
///
/// Both operations wait for a state, not for a change: if the person is in view already, `await_person` ends after the
/// frames that its hysteresis needs. A back end hides single lost or spurious frames.
pub trait Skeleton: Send + Sync {
    /// Waits until a person has been in view for several frames. Returns their pose.
    fn await_person(&self) -> Operation<'_, Pose>;

    /// Waits until no person has been in view for several frames.
    fn await_loss(&self) -> Operation<'_, ()>;
}
