//! TOML that people write, read so that every value, good or bad, has its place.
//!
//! Problem: `serde` stops at the first mistake and forgets where the good values stood, yet a scenario's PDDL
//! condition must be reported at its own line and column, and all mistakes at once. Idea: `toml`'s spanned tree,
//! walked by hand. A [`Table`] hands out its entries by key and counts what was never asked for as an unknown key.
//! Invariant: after [`Table::finish`], each entry was either read or reported. Entries keep the order of the file.
//!
//! ```
//! use pddl::Source;
//! use project::Sources;
//! use tables::Reader;
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
//! `reader` (a file), `table`, `text` (strings), `suggest`. Codes are E0701 to E0705.

mod reader;
mod suggest;
mod table;
mod text;

pub use reader::Reader;
pub use suggest::did_you_mean;
pub use table::Table;
pub use text::Text;
