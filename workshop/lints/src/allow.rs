//! Comments that silence lints: `; allow(unused-parameter, W0703)`.
//!
//! Behind something on its line, such a comment is about that line; on a line of its own, about the next line that
//! is not only a comment. It must be the first thing that the comment says, so that prose about lints is prose.

use pddl::syntax::TokenKind;
use pddl::{Source, Span, syntax};
use rustc_hash::FxHashMap;

use crate::{Lint, find};

/// What is silenced on which line.
#[derive(Debug, Default)]
pub(crate) struct Allows {
    by_line: FxHashMap<u32, Vec<&'static str>>,
    /// Words in `allow(…)` that no lint is called.
    pub(crate) unknown: Vec<Span>,
}

impl Allows {
    pub(crate) fn of(source: &Source) -> Self {
        let mut allows = Self::default();
        // Almost no file has one, and large ones are not lexed for nothing.
        if !source.text().contains("allow(") {
            return allows;
        }
        let (tree, _) = syntax::parse(source);
        // The lints of comments that wait for the next line with code, and the line of the code before them.
        let (mut waiting, mut line_with_code) = (Vec::new(), 0);
        for (kind, span) in tree.tokens() {
            let line = source.line_column(span.start).line;
            match kind {
                TokenKind::Whitespace => {}
                TokenKind::Comment => {
                    let lints = allows.read(source, span);
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
    fn read(&mut self, source: &Source, span: Span) -> Vec<&'static str> {
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
            match find(word) {
                Some(lint) => codes.push(lint.code()),
                None => {
                    let place = |byte: usize| u32::try_from(byte).expect("sources are shorter than 4 GiB");
                    self.unknown.push(Span::new(place(start), place(start + word.len())));
                }
            }
        }
        codes
    }

    /// Whether the lint is silent at a place.
    pub(crate) fn silence(&self, lint: &Lint, source: &Source, span: Span) -> bool {
        !self.by_line.is_empty()
            && self
                .by_line
                .get(&source.line_column(span.start).line)
                .is_some_and(|codes| codes.contains(&lint.code()))
    }
}
