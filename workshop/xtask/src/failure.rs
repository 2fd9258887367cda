//! Why a command of `cargo xtask` did not succeed.

/// Why a command did not succeed.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    #[error("`{0}` failed")]
    Command(String),
    #[error("`{0}` could not be started: {1}")]
    NotStarted(String, std::io::Error),
    #[error("cargo metadata: {0}")]
    Metadata(#[from] cargo_metadata::Error),
    #[error("{0}: {1}")]
    File(String, std::io::Error),
    #[error("there is no file tests/fuzz/targets/{0}.rs")]
    NoTarget(String),
    #[error("{0}: {1}")]
    Syntax(String, syn::Error),
    #[error("{0} finding(s), listed above")]
    Findings(usize),
}
