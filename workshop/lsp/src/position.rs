//! Positions: an editor counts lines and, in them, code units; the server counts bytes.
//!
//! Problem: a client and a server negotiate UTF-8, UTF-16 or UTF-32 units, lines end at `\n`, `\r\n` or
//! `\r`, and a client may name positions outside the text. Idea: a [`LineIndex`] for each text has the
//! starts of its lines; within a line, units are counted. Invariant: every resulting offset is at a
//! character boundary inside the text, and not between `\r` and `\n`; a position behind a line's end is the
//! line's end. Cost: a binary search and one line. Source: Language Server Protocol 3.17, "Position".

use lsp_types::{Position, PositionEncodingKind, Range};
use pddl::Span;

/// The unit of a position within a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Encoding {
    /// Bytes.
    Utf8,
    /// The unit that every client supports.
    #[default]
    Utf16,
    /// Characters.
    Utf32,
}

impl Encoding {
    /// The best of the client's encodings; UTF-8 costs least.
    pub(crate) fn negotiate<'a>(offered: impl Iterator<Item = &'a str>) -> Self {
        let known = offered.filter_map(|name| match name {
            "utf-8" => Some(Self::Utf8),
            "utf-16" => Some(Self::Utf16),
            "utf-32" => Some(Self::Utf32),
            _ => None,
        });
        let known: Vec<Self> = known.collect();
        if known.contains(&Self::Utf8) { Self::Utf8 } else { known.first().copied().unwrap_or_default() }
    }

    /// Its name in the protocol.
    pub(crate) fn kind(self) -> PositionEncodingKind {
        match self {
            Self::Utf8 => PositionEncodingKind::UTF8,
            Self::Utf16 => PositionEncodingKind::UTF16,
            Self::Utf32 => PositionEncodingKind::UTF32,
        }
    }

    fn width(self, character: char) -> usize {
        match self {
            Self::Utf8 => character.len_utf8(),
            Self::Utf16 => character.len_utf16(),
            Self::Utf32 => 1,
        }
    }

    /// The length of a text in units.
    pub(crate) fn length(self, text: &str) -> u32 {
        let units = match self {
            Self::Utf8 => text.len(),
            _ if text.is_ascii() => text.len(),
            _ => text.chars().map(|c| self.width(c)).sum(),
        };
        u32::try_from(units).unwrap_or(u32::MAX)
    }
}

/// The starts of a text's lines.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct LineIndex {
    /// Those of the second line and the following ones.
    starts: Vec<u32>,
}

impl LineIndex {
    /// The index of the empty text.
    pub(crate) const EMPTY: Self = Self { starts: Vec::new() };

    /// Finds the lines of `text`, which is shorter than 4 GiB.
    pub(crate) fn new(text: &str) -> Self {
        let bytes = text.as_bytes();
        let ends = (1u32..).zip(bytes).filter(|&(next, &byte)| {
            byte == b'\n' || byte == b'\r' && bytes.get(next as usize) != Some(&b'\n')
        });
        Self { starts: ends.map(|(next, _)| next).collect() }
    }

    /// The line that contains an offset.
    pub(crate) fn line_of(&self, offset: u32) -> u32 {
        u32::try_from(self.starts.partition_point(|&start| start <= offset)).unwrap_or(u32::MAX)
    }

    /// The start of a line, and the end of its text before the line end.
    fn bounds(&self, text: &str, line: u32) -> Option<(usize, usize)> {
        let start = match (line as usize).checked_sub(1) {
            None => 0,
            Some(before) => *self.starts.get(before)? as usize,
        };
        let end = self.starts.get(line as usize).map_or(text.len(), |&next| next as usize);
        let content = text.get(start..end).unwrap_or("").trim_end_matches(['\r', '\n']);
        Some((start, start + content.len()))
    }

    /// Converts an offset to the client's position.
    pub(crate) fn position(&self, text: &str, offset: u32, encoding: Encoding) -> Position {
        let line = self.line_of(offset);
        let Some((start, end)) = self.bounds(text, line) else { return Position::default() };
        let mut at = (offset as usize).clamp(start, end);
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        Position { line, character: encoding.length(&text[start..at]) }
    }

    /// Converts the client's position to an offset.
    pub(crate) fn offset(&self, text: &str, position: Position, encoding: Encoding) -> u32 {
        let offset = match self.bounds(text, position.line) {
            None => text.len(),
            Some((start, end)) => {
                let wanted = position.character as usize;
                let line = &text[start..end];
                let mut units = 0;
                let inside = line.char_indices().find(|&(_, c)| {
                    units += encoding.width(c);
                    // A position inside a character moves to the character's start.
                    units > wanted
                });
                start + inside.map_or(line.len(), |(at, _)| at)
            }
        };
        u32::try_from(offset).unwrap_or(u32::MAX)
    }

    /// A span as a range.
    pub(crate) fn range(&self, text: &str, span: Span, encoding: Encoding) -> Range {
        let start = self.position(text, span.start, encoding);
        Range { start, end: self.position(text, span.end.max(span.start), encoding) }
    }

    /// A range as a span; one that ends before it starts is empty.
    pub(crate) fn span(&self, text: &str, range: Range, encoding: Encoding) -> Span {
        let start = self.offset(text, range.start, encoding);
        Span::new(start, self.offset(text, range.end, encoding).max(start))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const ALL: [Encoding; 3] = [Encoding::Utf8, Encoding::Utf16, Encoding::Utf32];

    fn position(line: u32, character: u32) -> Position {
        Position { line, character }
    }

    #[test]
    fn units_are_counted() {
        let text = "a\r\n😀é b\rc\n";
        let index = LineIndex::new(text);
        assert_eq!(index.starts.len(), 3, "four lines start, the first at 0");
        let b = u32::try_from(text.find('b').expect("it is there")).expect("short");
        let columns = ALL.map(|encoding| index.position(text, b, encoding));
        assert_eq!(columns, [position(1, 7), position(1, 4), position(1, 3)]);
        for (encoding, at) in ALL.into_iter().zip(columns) {
            assert_eq!(index.offset(text, at, encoding), b);
        }
    }

    #[test]
    fn places_outside_are_brought_inside() {
        let text = "ab\r\ncd";
        let index = LineIndex::new(text);
        for encoding in ALL {
            assert_eq!(index.offset(text, position(0, 99), encoding), 2);
            assert_eq!(index.offset(text, position(9, 0), encoding), 6);
            assert_eq!(index.position(text, 3, encoding), position(0, 2), "between CR and LF");
            assert_eq!(index.position(text, 99, encoding), position(1, 2));
        }
        // Inside a surrogate pair.
        assert_eq!(LineIndex::new("😀").offset("😀", position(0, 1), Encoding::Utf16), 0);
    }

    #[test]
    fn utf_8_is_chosen_where_offered() {
        assert_eq!(Encoding::negotiate(["utf-16", "utf-8"].into_iter()), Encoding::Utf8);
        assert_eq!(Encoding::negotiate(["x", "utf-32"].into_iter()), Encoding::Utf32);
        assert_eq!(Encoding::negotiate([].into_iter()), Encoding::Utf16);
    }

    /// Line and column by walking over the text: slow, plain and independent.
    fn naive(text: &str, offset: usize, encoding: Encoding) -> Position {
        let before = &text[..offset];
        let plain = before.replace("\r\n", "\n").replace('\r', "\n");
        let last = plain.rsplit('\n').next().unwrap_or("");
        let line = plain.matches('\n').count();
        let column = match encoding {
            Encoding::Utf8 => last.len(),
            Encoding::Utf16 => last.encode_utf16().count(),
            Encoding::Utf32 => last.chars().count(),
        };
        position(u32::try_from(line).expect("short"), u32::try_from(column).expect("short"))
    }

    proptest! {
        #[test]
        fn there_and_back(text in "[a😀é\r\n ]{0,30}") {
            let index = LineIndex::new(&text);
            for encoding in ALL {
                for (offset, _) in text.char_indices().chain([(text.len(), ' ')]) {
                    if offset > 0 && text[..offset].ends_with('\r') && text[offset..].starts_with('\n') {
                        continue;
                    }
                    let bytes = u32::try_from(offset).expect("short");
                    let at = index.position(&text, bytes, encoding);
                    prop_assert_eq!(at, naive(&text, offset, encoding));
                    prop_assert_eq!(index.offset(&text, at, encoding), bytes);
                }
            }
        }

        #[test]
        fn any_place_is_inside(text in ".{0,20}", line: u32, character in 0u32..40, offset: u32) {
            let index = LineIndex::new(&text);
            for encoding in ALL {
                for line in [line, line % 4] {
                    let at = index.offset(&text, position(line, character), encoding);
                    prop_assert!(text.is_char_boundary(at as usize));
                }
                let at = index.position(&text, offset % 40, encoding);
                prop_assert!(at.line as usize <= index.starts.len());
            }
        }
    }
}
