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

impl Device {
    /// Every device, in the order of their declaration.
    pub const ALL: [Self; 6] =
        [Self::SpeechOut, Self::SpeechIn, Self::Screen, Self::Buttons, Self::Skeleton, Self::Clinic];
}

impl fmt::Display for Device {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::SpeechOut => "speech-out",
            Self::SpeechIn => "speech-in",
            Self::Screen => "screen",
            Self::Buttons => "buttons",
            Self::Skeleton => "skeleton",
            Self::Clinic => "clinic",
        })
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
    /// The device rejected the request.
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
            Self::Disconnected { device } | Self::Timeout { device, .. } | Self::Refused { device, .. } => {
                *device
            }
        }
    }
}
