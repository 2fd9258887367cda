//! How bad a diagnostic is.

use serde::Serialize;

/// How bad a diagnostic is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// The model is still meaningful.
    Warning,
    /// The file uses a language feature that is parsed but that no model represents yet.
    Unsupported,
    /// There is no model.
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
