//! Mission folders, contents and scenarios as typed models, checked as a whole.
//!
//! A mission is text: PDDL in layers, sentences in each language, scenarios. [`Mission::load`] reads all of it through
//! [`Files`], so that this crate touches no disk, and reports every mistake with its file, line and column.
//! [`Mission::check`] then checks the layers against each other. [`Words`] has the sentences of one language. A
//! [`Scenario`](scenario::Scenario) is a simulated patient with expectations. A [`Report`](report::Report) is the result
//! of a test, read from a snapshot of the graph. No line of this crate knows a particular test.
//!
//! ```
//! use mission::{MemoryFiles, Mission};
//!
//! let mut files = MemoryFiles::default();
//! files.texts.insert("tea/mission.toml".into(), "name = 3".into());
//! let errors = Mission::load(&files, "tea").expect_err("a name is a string");
//! let lines = errors.to_string();
//! assert!(lines.starts_with("tea/mission.toml:1:1: error[E0704]: the key `robot` is missing"), "{lines}");
//! assert!(lines.contains("tea/mission.toml:1:8: error[E0703]: `name` is an integer"));
//! ```
//!
//! Map, from the ground up: `files` (paths), `errors` (findings are [`diagnostics::Finding`]) → `manifest`
//! (`mission.toml`, with `goal_entry`), `layers` (the PDDL), `goals` → `content` (words) → `mission` → `load`, `check`
//! (between the layers),
//! [`report`] → [`scenario`]; `explain` has a page for each code.

mod check;
mod content;
mod errors;
mod explain;
mod files;
mod fragment;
mod goal_entry;
mod goals;
mod layers;
mod load;
mod manifest;
mod mission;
pub mod report;
pub mod scenario;

pub use check::SkillOutcomes;
pub use content::{OptionWords, ReportLabels, Words};
pub use errors::MissionErrors;
pub use explain::explanations;
pub use files::{FileError, Files, MemoryFiles};
pub use goal_entry::Worth;
pub use goals::{MissionGoal, Perceived};
pub use layers::{Layer, Layers, NamedTokens};
pub use manifest::{Budget, Manifest, Mention, Patience, ReportTokens};
pub use mission::{Mission, MissionTask};
