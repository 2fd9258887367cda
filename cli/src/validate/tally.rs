//! The number of plans with each verdict, and the exit code that follows.

use crate::exit::Exit;
use serde::Serialize;
use validator::Word;

/// The number of plans with each verdict.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Tally {
    kind: &'static str,
    valid: usize,
    invalid: usize,
    unreadable: usize,
    unsupported: usize,
}

impl Default for Tally {
    fn default() -> Self {
        Self { kind: "verdicts", valid: 0, invalid: 0, unreadable: 0, unsupported: 0 }
    }
}

impl Tally {
    pub(super) fn count(&mut self, word: Word) {
        *match word {
            Word::Valid => &mut self.valid,
            Word::Invalid => &mut self.invalid,
            Word::Unreadable => &mut self.unreadable,
            Word::Unsupported => &mut self.unsupported,
        } += 1;
    }

    pub(super) fn plans(&self) -> usize {
        self.valid + self.invalid + self.unreadable + self.unsupported
    }

    pub(super) fn line(&self) -> String {
        let parts = [
            (self.valid, Word::Valid),
            (self.invalid, Word::Invalid),
            (self.unreadable, Word::Unreadable),
            (self.unsupported, Word::Unsupported),
        ];
        let parts: Vec<String> =
            parts.iter().filter(|(n, _)| *n > 0).map(|(n, word)| format!("{n} {}", word.text())).collect();
        format!("{} plans: {}", self.plans(), parts.join(", "))
    }

    /// The worst outcome; without any plan it is an error.
    pub(super) fn exit(&self) -> Exit {
        let outcomes = [
            (self.invalid > 0, Exit::No),
            (self.unreadable > 0 || self.plans() == 0, Exit::Unreadable),
            (self.unsupported > 0, Exit::Unsupported),
        ];
        outcomes.iter().filter(|(so, _)| *so).fold(Exit::Yes, |all, (_, exit)| all.and(*exit))
    }
}
