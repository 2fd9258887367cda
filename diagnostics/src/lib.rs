//! What every reader of text shares: sources, places in them, findings, and TOML with places.
//!
//! A [`Source`] is a named text, a [`Span`] a byte range of it. A [`Finding`] reports a mistake at a
//! [`Place`]: a span of one of several [`Sources`]. [`nearest`] finds the known name that is most similar to
//! an unknown one. [`toml`] reads TOML files so that each value, valid or not, keeps its place. An [`Explanation`] is the
//! page about a finding's code.
//!
//! ```
//! use diagnostics::toml::Reader;
//! use diagnostics::{Source, Sources};
//!
//! let mut sources = Sources::new();
//! let id = sources.push(Source::new("tea.toml", "name = 'tea'\ncpus = 2"));
//! let (name, findings) = Reader::read(id, &sources[id], |reader, mut table| {
//!     let (name, _) = (table.text(reader, "name"), table.count(reader, "cups", 1));
//!     table.finish(reader);
//!     name
//! });
//! assert_eq!(name.expect("it is there").value, "tea");
//! let said = sources.describe(&findings[0]);
//! assert_eq!(said, "tea.toml:2:1: error[E0702]: unknown key `cpus`\n  help: did you mean `cups`?\n");
//! ```
//!
//! Map, from the ground up: `severity`, `source` (a text, its lines), `finding` with `sources` (texts by number),
//! `suggest` (did you mean), `explanation` (what a code means), `toml`.

mod explanation;
mod finding;
mod severity;
mod source;
mod sources;
mod suggest;
pub mod toml;

pub use explanation::Explanation;
pub use finding::{Finding, Place};
pub use severity::Severity;
pub use source::{LineColumn, Source, SourceId, Span};
pub use sources::Sources;
pub use suggest::{did_you_mean, nearest};
