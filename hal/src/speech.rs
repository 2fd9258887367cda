//! Speech: a loudspeaker that says text, and a microphone whose recogniser knows phrases.

use serde::{Deserialize, Serialize};

use crate::{Evidence, Operation, Question};

/// Text to speech.
pub trait SpeechOut: Send + Sync {
    /// Says `text`; done when the last word has been said. Dropping the operation silences the loudspeaker at once.
    ///
    /// A robot with a loopback hears itself: [`Evidence::Sensed`], or [`DeviceError::NotSensed`](crate::DeviceError) if
    /// the loopback works and heard nothing.
    fn say<'a>(&'a self, text: &'a str, language: &'a str) -> Operation<'a, Evidence>;
}

/// The result of speech recognition.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Heard {
    /// A phrase, by its id.
    Phrase(String),
    /// Other words, as far as the recogniser understood them.
    NotUnderstood(String),
}

/// Speech recognition. Several operations may listen at once.
pub trait SpeechIn: Send + Sync {
    /// Waits until the person speaks, and compares their words with the question's phrases.
    fn listen<'a>(&'a self, question: &'a Question) -> Operation<'a, Heard>;

    /// Waits until this person, or a voice that the device cannot tell from theirs, says one of the phrases; ignores all
    /// other words. The question's topic names the request. The person need not be in view.
    fn spot<'a>(&'a self, request: &'a Question, person: &'a str) -> Operation<'a, ()>;
}
