//! TOML that people write, read so that every value, good or bad, has its place.
//!
//! Problem: `serde` stops at the first mistake and drops the places of valid values, yet a scenario's PDDL
//! condition must be reported at its own line and column, and all mistakes at once. Idea: walk `toml`'s
//! spanned tree by hand. A [`Table`] hands out its entries by key and reports the entries that were not
//! requested as unknown keys. Invariant: after [`Table::finish`], each entry was either read or reported.
//! Entries keep the order of the file. Codes: E0701 to E0705, a page each.

mod explain;
mod file;
mod reader;
mod table;
mod text;

pub use explain::explanations;
pub use reader::Reader;
pub use table::Table;
pub use text::Text;
