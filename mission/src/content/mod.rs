//! Words: what the robot says, shows and understands, in each language.
//!
//! Problem: three languages with many sentences drift apart silently, and a missing sentence is noticed only when a
//! patient waits for it. Idea: read a language ([`file`]) and check it against the graph and the methods, which determine
//! what can be said where ([`said`], [`mod@required`], [`names`]). Only a checked language becomes [`Words`], in which all
//! templates are filled in. Invariant: in a loaded mission every (part, utterance) that a method can say has a sentence in
//! every language.

pub(crate) mod file;
mod grammar;
mod labels;
pub(crate) mod names;
pub(crate) mod required;
pub(crate) mod said;
mod words;

pub use labels::ReportLabels;
pub use words::{OptionWords, Words};
