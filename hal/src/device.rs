//! The devices of a robot, and how they fail.

use std::fmt;
use std::time::Duration;

use serde::{Deserialize, Serialize};

/// A capability, by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Device {
    /// Text to speech.
    SpeechOut,
    /// Speech recognition.
    SpeechIn,
    /// The touchscreen's display.
    Screen,
    /// The touchscreen's touch input.
    Buttons,
    /// The tracker of upper bodies.
    Skeleton,
    /// The clinician's console.
    Clinic,
}

/// Each device with its name in vocabularies, scenarios and messages.
const NAMES: [(Device, &str); 6] = [
    (Device::SpeechOut, "speaker"),
    (Device::SpeechIn, "microphone"),
    (Device::Screen, "screen"),
    (Device::Buttons, "touch"),
    (Device::Skeleton, "tracker"),
    (Device::Clinic, "console"),
];

impl Device {
    /// Every device, in the order of their declaration.
    pub const ALL: [Self; 6] =
        [Self::SpeechOut, Self::SpeechIn, Self::Screen, Self::Buttons, Self::Skeleton, Self::Clinic];

    /// Its name: the node of a vocabulary that stands for it.
    pub fn name(self) -> &'static str {
        NAMES.into_iter().find(|(device, _)| *device == self).map_or("", |(_, name)| name)
    }

    /// The device of that name.
    pub fn named(name: &str) -> Option<Self> {
        NAMES.into_iter().find(|(_, known)| *known == name).map(|(device, _)| device)
    }
}

impl fmt::Display for Device {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Why an operation of a device failed.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum DeviceError {
    /// The device is not connected, or no longer.
    #[error("{device} is disconnected")]
    Disconnected {
        /// Which one.
        device: Device,
    },
    /// The device did not answer in time.
    #[error("{device} did not answer within {after:?}")]
    Timeout {
        /// Which one.
        device: Device,
        /// How long the caller waited.
        after: Duration,
    },
    /// The device claims success, and the sensor that watches it noticed nothing.
    #[error("{device} claims success, but nothing of it was sensed")]
    NotSensed {
        /// Which one.
        device: Device,
    },
    /// The device rejected this request. It may accept another one.
    #[error("{device} refused: {reason}")]
    Refused {
        /// Which one.
        device: Device,
        /// The device's own words.
        reason: String,
    },
}

impl DeviceError {
    /// The device that failed.
    pub fn device(&self) -> Device {
        match self {
            Self::Disconnected { device }
            | Self::NotSensed { device }
            | Self::Timeout { device, .. }
            | Self::Refused { device, .. } => *device,
        }
    }
}
