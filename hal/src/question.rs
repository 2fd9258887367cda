//! What a person is asked: the grammar of an ear, the buttons of a touchscreen.

use serde::{Deserialize, Serialize};

/// One of the things that a person may say or touch.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Phrase {
    /// How the device reports it.
    pub id: String,
    /// How it sounds or reads.
    pub words: String,
}

/// A question with the answers that a device shall recognise.
///
/// `topic` and `name` mean nothing to a device; they let a log, or a simulated person, tell one question from
/// another. A question that is put again after an interruption has the same topic and name.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Question {
    /// What it is about.
    pub topic: String,
    /// Which of the questions about it; empty where there is one only.
    pub name: String,
    /// The language of the phrases, as in `en`.
    pub language: String,
    /// What may be answered.
    pub options: Vec<Phrase>,
}
