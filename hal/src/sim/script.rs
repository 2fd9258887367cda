//! The scripts of the simulated person and clinician: plain data, from a scenario file.

use serde::{Deserialize, Serialize};

/// How an answer is given.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum By {
    /// Said aloud; touched if only the screen accepts the answer and offers the option.
    #[default]
    Voice,
    /// Touched if the screen offers the option, otherwise said aloud.
    Touch,
    /// Said aloud, and the next option touched at the same time.
    Both,
}

/// The person's reply to a question.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Reply {
    /// Chooses an option.
    Answer {
        /// The option's number, from 0, in the order of the question's options. A number past the end is the last option.
        option: usize,
        /// Seconds from when a device begins to wait for the answer.
        #[serde(default = "two_seconds")]
        delay: f64,
        /// By voice or by touch.
        #[serde(default)]
        by: By,
    },
    /// Says words that are not an option.
    Misheard {
        /// The words.
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

/// An exception to the person's usual reply.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReplyRule {
    /// For questions about this topic.
    pub topic: String,
    /// For the question of this name; `None` for every question about the topic.
    #[serde(default)]
    pub question: Option<String>,
    /// The reply.
    pub reply: Reply,
}

/// The simulated person.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PatientScript {
    /// The node that stands for them.
    pub name: String,
    /// Whether they are in view when the simulation starts.
    pub in_view: bool,
    /// Their position whenever they are in view: metres in the frame of the world.
    pub position: [f64; 3],
    /// The exceptions. One for a question precedes one for its topic; among several, the first applies.
    pub replies: Vec<ReplyRule>,
    /// The reply without an exception.
    pub otherwise: Reply,
}

impl PatientScript {
    /// The person's reply to a question.
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
        Self {
            name: "person".into(),
            in_view: true,
            position: [1.2, 0.0, 0.0],
            replies: Vec::new(),
            otherwise: Reply::option(0),
        }
    }
}

/// The simulated clinician.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ClinicianScript {
    /// Whether they come when called.
    pub comes: bool,
    /// Whether they come only to an urgent call.
    pub only_urgent: bool,
    /// How many seconds after the call they come.
    pub after: f64,
    /// How many seconds they stay; then the call is finished.
    pub stays: f64,
    /// Whether they bring a person who is out of view back in front of the robot.
    pub fetches: bool,
}

impl Default for ClinicianScript {
    fn default() -> Self {
        Self { comes: true, only_urgent: false, after: 20.0, stays: 5.0, fetches: true }
    }
}
