//! Who is in front of the robot.

use crate::Operation;

/// Where somebody is: metres and radians, in the frame of the world.
pub type Pose = nalgebra::Isometry3<f64>;

/// A tracker of upper bodies.
///
/// Both waits are about a state, not an edge: if the person is in view already, `await_person` ends after the
/// frames that it takes to be sure. A back end hides single lost or spurious frames (hysteresis).
pub trait Skeleton: Send + Sync {
    /// Waits until somebody is in view for several frames; where.
    fn await_person(&self) -> Operation<'_, Pose>;

    /// Waits until nobody is in view for several frames.
    fn await_loss(&self) -> Operation<'_, ()>;
}
