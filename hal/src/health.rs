//! What a robot can find out about its devices beside their work.

use std::time::Duration;

use crate::{Device, Operation};

/// Health of devices.
///
/// Both waiting operations wait for a state, not for a change, and report what is sensed: a link that is down, a driver
/// that does not answer. A device that claims success and does nothing is healthy by these two; [`Health::test`] finds it.
pub trait Health: Send + Sync {
    /// Waits until the device is out of order: disconnected, or without an answer for some seconds.
    fn await_fault(&self, device: Device) -> Operation<'_, ()>;

    /// Waits until the device has been in order for this long.
    fn await_recovery(&self, device: Device, steady: Duration) -> Operation<'_, ()>;

    /// Tests the device once against an independent sensor, in a way that does not disturb a person: a loudspeaker
    /// against the microphone, a page against the screen's report. Fails with
    /// [`DeviceError::NotSensed`](crate::DeviceError) if the sensor noticed nothing, or if there is none.
    fn test(&self, device: Device) -> Operation<'_, ()>;
}
