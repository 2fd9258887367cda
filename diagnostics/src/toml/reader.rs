//! The findings of reading one TOML file.

use ::toml::Spanned;
use ::toml::de::DeValue;

use crate::{Finding, Place, SourceId, Span};

/// The state of reading one TOML file.
pub struct Reader<'a> {
    /// The id of the source.
    pub source: SourceId,
    /// The source's text.
    pub text: &'a str,
    /// The findings so far.
    pub findings: Vec<Finding>,
}

impl Reader<'_> {
    /// The place of a span of this file.
    pub fn place(&self, span: Span) -> Place {
        Place { source: self.source, span }
    }

    /// Reports an error.
    pub fn error(&mut self, code: &'static str, span: Span, message: impl Into<String>) {
        self.findings.push(Finding::error(code, self.place(span), message));
    }

    /// Reports that a value has the wrong kind.
    pub(crate) fn wrong_kind(&mut self, value: &Spanned<DeValue<'_>>, path: &str, expected: &str) {
        let found = match value.get_ref() {
            DeValue::String(_) => "a string",
            DeValue::Integer(_) => "an integer",
            DeValue::Float(_) => "a decimal number",
            DeValue::Boolean(_) => "a boolean",
            DeValue::Datetime(_) => "a date",
            DeValue::Array(_) => "a list",
            DeValue::Table(_) => "a table",
        };
        self.error("E0703", span(value.span()), format!("`{path}` is {found}, and should be {expected}"));
    }
}

/// Converts a byte range of `toml` into a [`Span`].
pub(crate) fn span(range: std::ops::Range<usize>) -> Span {
    // A `Source` is shorter than 4 GiB, so the ranges of its tree fit.
    let at = |i: usize| u32::try_from(i).unwrap_or(u32::MAX);
    Span::new(at(range.start), at(range.end))
}
