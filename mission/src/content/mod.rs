//! Words: what the robot says and shows, and what it understands, per language.
//!
//! Problem: three languages times many sentences drift apart silently, and a sentence that is missing
//! is noticed when a patient is waiting for it. Idea: a language is read ([`file`]), held against the
//! graph and the methods, which say what can be said where ([`mod@required`], [`names`]), and only then
//! becomes [`Words`], in which every sentence is already filled in. Invariant: in a loaded mission every
//! (part, utterance) that a method can say has a sentence in every language.

pub(crate) mod file;
mod grammar;
pub(crate) mod names;
pub(crate) mod required;
mod words;

pub use words::{OptionWords, ReportLabels, Words};
