//! Comments that silence lints: `; allow(unused-parameter, W0703)`.
//!
//! After something else on a line, such a comment concerns that line. On a line of its own it concerns the next line that
//! is not only a comment. The comment must begin with `allow(`, so that prose about lints has no effect.

use pddl::syntax::TokenKind;
use pddl::{Source, Span, syntax};
use rustc_hash::FxHashMap;

/// The code of the lint with that name or code.
pub(crate) type KnownLint = fn(&str) -> Option<&'static str>;

/// The lints that are silenced, by line.
#[derive(Debug, Default)]
pub(crate) struct Allows {
    by_line: FxHashMap<u32, Vec<&'static str>>,
    /// Words in `allow(…)` that name no lint.
    pub(crate) unknown: Vec<Span>,
}

impl Allows {
    pub(crate) fn of(source: &Source, known: KnownLint) -> Self {
        let mut allows = Self::default();
        // Almost no file has one, and lexing a large file takes time.
        if !source.text().contains("allow(") {
            return allows;
        }
        let (tree, _) = syntax::parse(source);
        // The lints of comments that wait for the next line with code, and the last line with code before them.
        let (mut waiting, mut line_with_code) = (Vec::new(), 0);
        for (kind, span) in tree.tokens() {
            let line = source.line_column(span.start).line;
            match kind {
                TokenKind::Whitespace => {}
                TokenKind::Comment => {
                    let lints = allows.read(source, span, known);
                    if line == line_with_code {
                        allows.by_line.entry(line).or_default().extend(lints);
                    } else {
                        waiting.extend(lints);
                    }
                }
                _ => {
                    line_with_code = line;
                    if !waiting.is_empty() {
                        allows.by_line.entry(line).or_default().append(&mut waiting);
                    }
                }
            }
        }
        allows
    }

    /// The codes that a comment names.
    fn read(&mut self, source: &Source, span: Span, known: KnownLint) -> Vec<&'static str> {
        let text = source.slice(span);
        let said = text.trim_start_matches([';', ' ', '\t']);
        let Some((names, _)) = said.strip_prefix("allow(").and_then(|rest| rest.split_once(')')) else {
            return Vec::new();
        };
        let mut at = text.len() - said.len() + "allow(".len();
        let mut codes = Vec::new();
        for name in names.split(',') {
            let word = name.trim();
            let start = span.start as usize + at + (name.len() - name.trim_start().len());
            at += name.len() + 1;
            match known(word) {
                Some(code) => codes.push(code),
                None => {
                    let place = |byte: usize| u32::try_from(byte).expect("sources are shorter than 4 GiB");
                    self.unknown.push(Span::new(place(start), place(start + word.len())));
                }
            }
        }
        codes
    }

    /// Whether a comment silences the lint at a place.
    pub(crate) fn silence(&self, code: &str, source: &Source, span: Span) -> bool {
        !self.by_line.is_empty()
            && self
                .by_line
                .get(&source.line_column(span.start).line)
                .is_some_and(|codes| codes.contains(&code))
    }
}
