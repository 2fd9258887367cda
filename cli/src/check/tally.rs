//! The number of errors, warnings and unsupported features of a file or mission.

use crate::render::counted;
use pddl::Severity;
use serde::Serialize;

/// The findings of a file or mission, counted by severity.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub(super) struct Tally {
    pub(super) errors: usize,
    pub(super) warnings: usize,
    pub(super) unsupported: usize,
    /// False if an error in one file prevented the rest of a mission from being read.
    pub(super) checked: bool,
}

impl Tally {
    pub(super) fn of(severities: impl Iterator<Item = Severity>) -> Self {
        let mut tally = Self { checked: true, ..Self::default() };
        for severity in severities {
            match severity {
                Severity::Error => tally.errors += 1,
                Severity::Warning => tally.warnings += 1,
                Severity::Unsupported => tally.unsupported += 1,
            }
        }
        tally
    }

    /// `p.pddl: 2 errors, 1 warning`.
    pub(super) fn line(&self, file: &str) -> String {
        format!("{file}: {}", self.verdict())
    }

    /// `2 errors, 1 warning`.
    pub(super) fn verdict(&self) -> String {
        let parts = [
            (self.errors, "error", "errors"),
            (self.warnings, "warning", "warnings"),
            (self.unsupported, "unsupported feature", "unsupported features"),
        ];
        let parts: Vec<String> = parts
            .iter()
            .filter(|(count, ..)| *count > 0)
            .map(|&(count, one, more)| counted(count, one, more))
            .collect();
        if parts.is_empty() { "no errors".to_owned() } else { parts.join(", ") }
    }
}
