//! Words: what the robot says and shows, and what it understands, per language.
//!
//! Problem: three languages times many sentences drift apart silently, and a sentence that is missing
//! is noticed when a patient is waiting for it. Idea: a language is read ([`file`]), held against the
//! graph and the methods, which say what can be said where ([`said`], [`mod@required`], [`names`]), and only then
//! becomes [`Words`], in which every sentence is already filled in. Invariant: in a loaded mission every
//! (part, utterance) that a method can say has a sentence in every language.

pub(crate) mod file;
mod grammar;
mod labels;
pub(crate) mod names;
pub(crate) mod required;
pub(crate) mod said;
mod words;

pub use labels::ReportLabels;
pub use words::{OptionWords, Words};
