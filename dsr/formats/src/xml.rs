//! Text in XML.

use std::fmt::Write as _;

/// The text with every character that XML reserves, or cannot hold, replaced.
pub(crate) fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            // Readers take these for blanks, or for ends of lines of their own.
            '\t' | '\n' | '\r' => _ = write!(escaped, "&#{};", u32::from(c)),
            // XML 1.0 has no way to write these. Source: "Extensible Markup Language (XML) 1.0", W3C, 2008, §2.2.
            '\u{fffe}' | '\u{ffff}' => escaped.push('\u{fffd}'),
            c if c < ' ' => escaped.push('\u{fffd}'),
            c => escaped.push(c),
        }
    }
    escaped
}
