//! What the simulated person and clinician will do: plain data, as a scenario file gives it.

use serde::{Deserialize, Serialize};

/// How an answer is given.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum By {
    /// Said aloud; touched where only the screen takes the answer and offers it.
    #[default]
    Voice,
    /// Touched where the screen offers it, otherwise said aloud.
    Touch,
}

/// What the person does when asked.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Reply {
    /// Chooses an option.
    Answer {
        /// Which, counted from 0 in the order in which the question lists them; past the end: the last.
        option: usize,
        /// Seconds from when a device begins to wait for the answer.
        #[serde(default = "two_seconds")]
        delay: f64,
        /// How.
        #[serde(default)]
        by: By,
    },
    /// Says something that is no option.
    Misheard {
        /// What.
        words: String,
        /// Seconds from when a device begins to wait for the answer.
        #[serde(default = "two_seconds")]
        delay: f64,
    },
    /// Stays silent.
    Silent,
}

impl Reply {
    /// Says the option after two seconds.
    pub fn option(option: usize) -> Self {
        Self::Answer { option, delay: two_seconds(), by: By::Voice }
    }

    /// Seconds from when a device begins to wait; `None` for a silence.
    pub(super) fn delay(&self) -> Option<f64> {
        match self {
            Self::Answer { delay, .. } | Self::Misheard { delay, .. } => Some(*delay),
            Self::Silent => None,
        }
    }
}

fn two_seconds() -> f64 {
    2.0
}

/// An exception to what the person does otherwise.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReplyRule {
    /// For questions about this topic.
    pub topic: String,
    /// For the question of this name; `None`: for every question about the topic.
    #[serde(default)]
    pub question: Option<String>,
    /// The reply.
    pub reply: Reply,
}

/// The simulated person.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PatientScript {
    /// Whether they are in view when the simulation starts.
    pub in_view: bool,
    /// Where they are then and whenever they are in view: metres in the frame of the world.
    pub position: [f64; 3],
    /// The exceptions; one for the very question goes before one for its topic, then the first goes.
    pub replies: Vec<ReplyRule>,
    /// The reply where there is no exception.
    pub otherwise: Reply,
}

impl PatientScript {
    /// What the person replies to a question.
    pub fn reply(&self, topic: &str, question: &str) -> &Reply {
        let of_topic = || self.replies.iter().filter(|rule| rule.topic == topic);
        let exact = of_topic().find(|rule| rule.question.as_deref() == Some(question));
        exact
            .or_else(|| of_topic().find(|rule| rule.question.is_none()))
            .map_or(&self.otherwise, |rule| &rule.reply)
    }
}

impl Default for PatientScript {
    fn default() -> Self {
        Self { in_view: true, position: [1.2, 0.0, 0.0], replies: Vec::new(), otherwise: Reply::option(0) }
    }
}

/// The simulated clinician.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ClinicianScript {
    /// Whether they come when called.
    pub comes: bool,
    /// How many seconds after the call.
    pub after: f64,
    /// For how many seconds they stay; then the call is over.
    pub stays: f64,
    /// Whether they bring a person who is out of view back in front of the robot.
    pub fetches: bool,
}

impl Default for ClinicianScript {
    fn default() -> Self {
        Self { comes: true, after: 20.0, stays: 5.0, fetches: true }
    }
}
