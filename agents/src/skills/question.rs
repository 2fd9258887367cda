//! What is asked: the options of a part as phrases that may be said or touched.

use hal::{Phrase, Question};

use crate::words::Words;

pub(super) fn options(words: &dyn Words, part: &str) -> Vec<Phrase> {
    words.options(part).into_iter().map(|(id, words)| Phrase { id, words }).collect()
}

pub(super) fn question(words: &dyn Words, part: &str, name: &str) -> Question {
    Question {
        topic: part.to_owned(),
        name: name.to_owned(),
        language: words.language().to_owned(),
        options: options(words, part),
    }
}
