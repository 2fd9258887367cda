//! What the behaviour of a device does to an operation.

use std::time::Duration;

use tokio::time::Instant;

use super::behaviour::Behaviour;
use super::state::State;
use crate::{Device, DeviceError};

/// How late the results of a slow device are.
pub(super) const LATE: Duration = Duration::from_secs(3);

/// What a device lets an operation do now.
pub(super) enum Gate {
    Open,
    Failed(DeviceError),
    Shut,
}

impl State {
    pub(super) fn behaviour(&self, device: Device) -> Behaviour {
        self.behaviour.get(&device).map_or(Behaviour::Works, |(behaviour, _)| *behaviour)
    }

    /// How the device behaves, and since when; since the start if it never changed.
    pub(super) fn behaviour_since(&self, device: Device) -> (Behaviour, Option<Instant>) {
        self.behaviour
            .get(&device)
            .map_or((Behaviour::Works, None), |(behaviour, since)| (*behaviour, Some(*since)))
    }

    /// Whether the device does its work.
    pub(super) fn works(&self, device: Device) -> bool {
        matches!(self.behaviour(device), Behaviour::Works | Behaviour::Slow)
    }

    /// # Panics
    /// If that is how the device behaves.
    #[expect(clippy::panic, reason = "a driver that panics is what is simulated")]
    pub(super) fn gate(&self, device: Device) -> Gate {
        match self.behaviour(device) {
            Behaviour::Works | Behaviour::Lies | Behaviour::Slow => Gate::Open,
            Behaviour::Fails => Gate::Failed(DeviceError::Disconnected { device }),
            Behaviour::Refuses => {
                let reason = "it rejects every request".to_owned();
                Gate::Failed(DeviceError::Refused { device, reason })
            }
            Behaviour::Stalls => Gate::Shut,
            Behaviour::Panics => panic!("the driver of the {device} panics"),
        }
    }
}
