//! What a robot knows about its own output.

use serde::{Deserialize, Serialize};

/// Why an output counts as done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Evidence {
    /// A sensor that is independent of the output noticed it: a microphone heard the loudspeaker, the screen reported
    /// its page.
    Sensed,
    /// The output device says so, and no sensor can confirm it now.
    Claimed,
}
