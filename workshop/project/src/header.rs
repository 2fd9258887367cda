//! The names that a file defines and needs, found before it is read.
//!
//! Files come in any order, but reading a problem requires its domain, and reading a domain its imports.
//! This module looks at names alone, accepts any text and reports nothing: the parser reports errors later,
//! with their places.

use pddl::Span;

use crate::FileKind;

/// The names in a file's header.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Header {
    /// The kind of the file.
    pub kind: FileKind,
    /// Its own name, in lower case; empty if it has none.
    pub name: String,
    /// The names that must be read first: the problem's domain, or the domain's imports.
    pub needs: Vec<Need>,
}

/// A name that another file defines.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Need {
    /// In lower case.
    pub name: String,
    /// Where it stands.
    pub span: Span,
}

impl Header {
    /// The header of the file at `path` with that text.
    pub fn of(path: &str, text: &str) -> Self {
        if FileKind::is_plan(path) {
            return Self { kind: FileKind::Plan, name: String::new(), needs: Vec::new() };
        }
        let mut words = words(text).peekable();
        let mut header = Self { kind: FileKind::Domain, name: String::new(), needs: Vec::new() };
        let mut named = false;
        while let Some((_, word)) = words.next() {
            if word != "(" {
                continue;
            }
            let Some(key) = words.peek().map(|(_, key)| key.to_ascii_lowercase()) else { break };
            match key.as_str() {
                "domain" | "problem" if !named => {
                    named = true;
                    header.kind = if key == "problem" { FileKind::Problem } else { FileKind::Domain };
                    words.next();
                    header.name =
                        words.next_if(is_name).map_or_else(String::new, |(_, n)| n.to_ascii_lowercase());
                }
                ":domain" | ":import" | ":extends" => {
                    words.next();
                    while let Some((at, needed)) = words.next_if(is_name) {
                        header.needs.push(Need { name: needed.to_ascii_lowercase(), span: span(at, needed) });
                    }
                }
                _ => {}
            }
        }
        header
    }

    /// Whether both have the same names; places are ignored.
    pub(crate) fn same_names(&self, other: &Self) -> bool {
        let names = |header: &Self| header.needs.iter().map(|need| need.name.clone()).collect::<Vec<_>>();
        (self.kind, &self.name, names(self)) == (other.kind, &other.name, names(other))
    }

    /// Whether the file defines that domain (in lower case).
    pub fn defines(&self, domain: &str) -> bool {
        self.kind == FileKind::Domain && self.name == domain
    }
}

fn is_name((_, word): &(usize, &str)) -> bool {
    !word.starts_with(['(', ')'])
}

fn span(at: usize, word: &str) -> Span {
    let offset = |bytes: usize| u32::try_from(bytes).unwrap_or(u32::MAX);
    Span::new(offset(at), offset(at + word.len()))
}

/// Parentheses and words, without comments, each with its offset.
fn words(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut at = 0;
    std::iter::from_fn(move || {
        loop {
            let rest = text.get(at..)?;
            let first = rest.chars().next()?;
            let until = |stop: fn(char) -> bool| rest.find(stop).unwrap_or(rest.len());
            let start = at;
            match first {
                ';' => at += until(|c| c == '\n'),
                '(' | ')' => {
                    at += 1;
                    return Some((start, &rest[..1]));
                }
                c if c.is_whitespace() => at += c.len_utf8(),
                _ => {
                    let length = until(|c| c.is_whitespace() || matches!(c, '(' | ')' | ';'));
                    at += length;
                    return Some((start, &rest[..length]));
                }
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::{FileKind, Header};

    fn check(text: &str, kind: FileKind, name: &str, needs: &[&str]) {
        let header = Header::of("x.pddl", text);
        let found: Vec<&str> = header.needs.iter().map(|need| need.name.as_str()).collect();
        assert_eq!((header.kind, header.name.as_str(), found.as_slice()), (kind, name, needs));
        for need in &header.needs {
            assert_eq!(text[need.span.range()].to_ascii_lowercase(), need.name);
        }
    }

    #[test]
    fn names_are_found() {
        let text =
            "; (define (problem no))\n(define (Domain D)\n (:import a B)\n (:extends c)\n (:action x))";
        check(text, FileKind::Domain, "d", &["a", "b", "c"]);
        check("(define(problem p)(:domain D;é\n)(:init (domain q)))", FileKind::Problem, "p", &["d"]);
    }

    #[test]
    fn anything_has_a_header() {
        for text in ["", "(", "(define", "(define (domain", "(define (problem)) (:domain", "hello world ;"] {
            Header::of("x.pddl", text);
        }
    }
}
