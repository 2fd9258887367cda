//! How a list is laid out once it is broken, by its head.

use crate::syntax::TokenKind;

/// The kind of a list to the formatter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    /// `(define …)`
    Define,
    /// `(:action … :key value …)`: a section that holds keys.
    Keyed,
    /// Any other list with a keyword in front.
    Section,
    /// `and`, `or`: any number of conditions.
    Junction,
    /// `forall`, `when`: a short part and then a body.
    Body,
    /// `(at start …)`, `(not …)`: a form around a condition.
    Wrapper,
    /// A predicate, a function, arithmetic.
    Term,
    /// `(?x - type …)`, `()`: no head at all.
    Plain,
}

/// The layout of a list.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rules {
    pub(super) shape: Shape,
    /// How many of its parts, the head included, stay on the first line.
    pub(super) beside: u32,
    /// Whether it stays broken where the author broke it.
    pub(super) keeps: bool,
    /// Whether the keywords in it are words and not keys.
    pub(super) is_flags: bool,
}

impl Rules {
    /// Rules for a list that starts with this token.
    pub(super) fn of(kind: TokenKind, text: &str) -> Self {
        let rules = |shape, beside, keeps| Self { shape, beside, keeps, is_flags: false };
        let is = |words: &[&str]| words.iter().any(|w| w.eq_ignore_ascii_case(text));
        match kind {
            TokenKind::Keyword if is(&[":goal", ":constraints", ":domain", ":derived", ":writes"]) => {
                rules(Shape::Section, 2, true)
            }
            TokenKind::Keyword if is(&[":requirements"]) => {
                Self { is_flags: true, ..rules(Shape::Section, 1, true) }
            }
            TokenKind::Keyword if is(&[":metric"]) => rules(Shape::Section, 3, true),
            TokenKind::Keyword => rules(Shape::Section, 1, true),
            TokenKind::Name if is(&["define"]) => rules(Shape::Define, 2, true),
            TokenKind::Name if is(&["and", "or"]) => rules(Shape::Junction, 1, true),
            TokenKind::Name if is(&["forall", "exists", "when", "preference"]) => rules(Shape::Body, 2, true),
            TokenKind::Name if is(&["imply"]) => rules(Shape::Term, 2, true),
            TokenKind::Name if is(&["at", "over"]) => rules(Shape::Wrapper, 3, false),
            TokenKind::Name if is(&["not"]) => rules(Shape::Wrapper, 2, false),
            TokenKind::Name => rules(Shape::Term, 2, false),
            _ => rules(Shape::Plain, 1, false),
        }
    }

    /// The first part from which a hyphen separates a name from its type.
    pub(super) fn types_from(self) -> u32 {
        match self.shape {
            Shape::Plain => 1,
            Shape::Term | Shape::Wrapper => 2,
            _ => self.beside + 1,
        }
    }
}
