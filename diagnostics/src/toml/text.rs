//! A string of a TOML file with the places of its characters.

use crate::Span;

/// A string value and its place.
#[derive(Clone, Debug)]
pub struct Text {
    /// The value, escapes resolved.
    pub value: String,
    /// The literal in the file, quotes included.
    pub span: Span,
    /// The place of the value's first byte, if the literal has no escapes.
    inner: Option<u32>,
}

impl Text {
    /// The string `value`, written at `span` of `file`.
    pub fn new(value: &str, span: Span, file: &str) -> Self {
        let literal = file.get(span.range()).unwrap_or("");
        let quote = literal.chars().next().unwrap_or('"');
        let body = literal.trim_start_matches(quote);
        let opening = literal.len() - body.len();
        // A multi-line string drops the newline right after its quotes.
        let newline = match opening {
            3 if body.starts_with("\r\n") => 2,
            3 if body.starts_with('\n') => 1,
            _ => 0,
        };
        let start = opening + newline;
        let verbatim = !value.is_empty() && literal.get(start..start + value.len()) == Some(value);
        let inner = verbatim.then(|| span.start + u32::try_from(start).unwrap_or(0));
        Self { value: value.to_owned(), span, inner }
    }

    /// The place of a byte range of the value; the whole literal if escapes hide it.
    pub fn within(&self, range: Span) -> Span {
        let Some(inner) = self.inner else { return self.span };
        let length = u32::try_from(self.value.len()).unwrap_or(u32::MAX);
        let (start, end) = (range.start.min(length), range.end.min(length));
        Span::new(inner + start, inner + end.max(start))
    }
}

#[cfg(test)]
mod tests {
    use crate::Span;

    use super::Text;

    /// The text that a range of the value is moved to.
    fn moved(file: &str, literal: &str, value: &str, range: Span) -> String {
        let start = u32::try_from(file.find(literal).unwrap()).unwrap();
        let span = Span::new(start, start + u32::try_from(literal.len()).unwrap());
        file[Text::new(value, span, file).within(range).range()].to_owned()
    }

    #[test]
    fn places_inside_a_string_are_places_in_the_file() {
        let range = Span::new(1, 3);
        assert_eq!(moved("a = \"(is x)\"", "\"(is x)\"", "(is x)", range), "is");
        assert_eq!(moved("a = '(is x)'", "'(is x)'", "(is x)", range), "is");
        assert_eq!(moved("a = \"\"\"\n(is x)\"\"\"", "\"\"\"\n(is x)\"\"\"", "(is x)", range), "is");
        // Escapes hide the place, so it is the whole string.
        assert_eq!(moved(r#"a = "\t(is x)""#, r#""\t(is x)""#, "\t(is x)", range), r#""\t(is x)""#);
        assert_eq!(moved("a = \"\"", "\"\"", "", range), "\"\"");
    }
}
