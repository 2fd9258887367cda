//! Verdicts as a page: charts, states and explanations.

mod page;
mod tree;

pub use page::{page, section, section_unread};
