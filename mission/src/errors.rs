//! Why a mission or a scenario could not be read.
//!
//! Codes: E07xx shape of a TOML file, E08xx words, E09xx scenarios, C01xx between the layers.

use diagnostics::{Finding, Sources};

/// Why a mission or a scenario could not be read: at least one finding is an error.
#[derive(Clone, Debug, thiserror::Error)]
#[error("{}", self.findings.iter().map(|f| self.sources.describe(f)).collect::<String>())]
pub struct MissionErrors {
    /// The texts of the findings.
    pub sources: Sources,
    /// All findings, by file and place.
    pub findings: Vec<Finding>,
}

/// `1 argument`, `2 arguments`.
pub(crate) fn counted(count: usize, one: &str, more: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { more })
}
