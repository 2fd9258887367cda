//! Why a mission or a scenario could not be read.
//!
//! Codes: E07xx shape of a TOML file, E08xx words, E09xx scenarios, C01xx between the layers.

use diagnostics::{Finding, Sources};

/// Why there is no mission (or scenario): at least one finding is an error.
#[derive(Clone, Debug, thiserror::Error)]
#[error("{}", self.findings.iter().map(|f| self.sources.describe(f)).collect::<String>())]
pub struct MissionErrors {
    /// The texts that the findings speak of.
    pub sources: Sources,
    /// All that was found, by file and place.
    pub findings: Vec<Finding>,
}
