//! What a witness can hear and see in the room: the record of a simulation, and the dialogue on a terminal.

use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::{Device, Page};

/// An event that a witness can hear or see.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "event", rename_all = "snake_case")]
#[expect(missing_docs, reason = "the fields are the terms of the variant")]
pub enum RoomEvent {
    /// The robot begins a sentence.
    RobotSays { text: String },
    /// The robot stops within a sentence.
    RobotStops { said: String },
    /// The screen shows a page.
    ScreenShows { page: Page },
    /// The screen is empty.
    ScreenClears,
    /// The person answers aloud.
    PersonSays { words: String },
    /// The person touches an option.
    PersonTouches { option: String, words: String },
    /// A person asks for something. The patient has no name here.
    PersonAsks {
        request: String,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        person: Option<String>,
    },
    /// The person is out of view.
    PersonLeaves,
    /// The person is out of the room, and out of view.
    PersonLeavesRoom,
    /// The person is in view again.
    PersonReturns,
    /// Another person comes into view.
    VisitorComes { name: String },
    /// Another person is out of view again.
    VisitorGoes { name: String },
    /// The robot calls the clinician.
    ClinicianCalled {
        need: String,
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        urgent: bool,
        #[serde(default)]
        id: String,
    },
    /// The robot withdraws its call.
    CallWithdrawn { need: String },
    /// The clinician enters.
    ClinicianArrives { need: String },
    /// The clinician has attended to the need, and goes.
    ClinicianGoes { need: String },
    /// The clinician presses a command.
    ClinicianCommands { command: String },
    /// The clinician receives the report.
    ReportDelivered {
        report: serde_json::Value,
        #[serde(default)]
        id: String,
    },
    /// A device fails from now on.
    DeviceFails { device: Device },
    /// A device reports success from now on, and does nothing.
    DeviceLies { device: Device },
    /// A device neither works nor fails from now on.
    DeviceStalls { device: Device },
    /// A device reports everything late from now on.
    DeviceSlows { device: Device },
    /// A device rejects every request from now on.
    DeviceRefuses { device: Device },
    /// The driver of a device panics from now on.
    DevicePanics { device: Device },
    /// A device works again.
    DeviceRecovers { device: Device },
}

/// An event with its time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Moment {
    /// Since the simulation started.
    pub at: Duration,
    /// The event.
    #[serde(flatten)]
    pub event: RoomEvent,
}
