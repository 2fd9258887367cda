//! Questions to a person: the grammar of speech recognition, the buttons of a touchscreen.

use serde::{Deserialize, Serialize};

/// An answer that a person may say or touch.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Phrase {
    /// The name under which the device reports it.
    pub id: String,
    /// The spoken or written words.
    pub words: String,
}

/// A question with the answers that a device must recognise.
///
/// A device ignores `topic` and `name`. A log and the simulated person use them to distinguish questions. A question that
/// is asked again after an interruption has the same topic and name.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Question {
    /// Its topic.
    pub topic: String,
    /// Its name among the questions about the topic; empty if the topic has one question.
    pub name: String,
    /// The language of the phrases, as in `en`.
    pub language: String,
    /// The possible answers.
    pub options: Vec<Phrase>,
}
