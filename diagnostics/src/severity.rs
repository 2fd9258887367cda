//! The severity of a diagnostic.

use serde::Serialize;

/// The severity of a diagnostic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// The model is still meaningful.
    Warning,
    /// The file uses a language feature that is read but not modelled.
    Unsupported,
    /// No model can be made.
    Error,
}

impl Severity {
    /// The word for it, as in `error[E0101]`.
    pub fn word(self) -> &'static str {
        match self {
            Self::Warning => "warning",
            Self::Unsupported => "unsupported",
            Self::Error => "error",
        }
    }
}
