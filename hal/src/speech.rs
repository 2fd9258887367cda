//! Speech: a loudspeaker that says text, an ear that recognises phrases.

use serde::{Deserialize, Serialize};

use crate::{Operation, Question};

/// Text to speech.
pub trait SpeechOut: Send + Sync {
    /// Says `text`; done when the last word has been said. Dropped, it falls silent at once.
    fn say<'a>(&'a self, text: &'a str, language: &'a str) -> Operation<'a, ()>;
}

/// What an ear made of what was said.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Heard {
    /// The phrase of this id.
    Phrase(String),
    /// Something that is none of the phrases, as far as it was understood.
    NotUnderstood(String),
}

/// Speech recognition. Several operations may listen at once.
pub trait SpeechIn: Send + Sync {
    /// Waits until somebody says something, and holds it against the question's phrases.
    fn listen<'a>(&'a self, question: &'a Question) -> Operation<'a, Heard>;

    /// Waits until somebody says one of the phrases, whatever else is said. The question's topic names what
    /// is wanted.
    fn spot<'a>(&'a self, request: &'a Question) -> Operation<'a, ()>;
}
