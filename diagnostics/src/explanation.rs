//! What a code means, read from a Markdown file that is named after the code.
//!
//! Idea: an author of a diagnostic writes one page, `E0202.md`, and every edge shows it in its own layout. The first
//! line is `# ` and the title. The first paragraph says when the code is reported, the paragraphs that follow say why it
//! is wrong and what to do. Then come the examples, each a fenced block that opens with its language and `wrong` or
//! `right`:
//!
//! ````text
//! # unknown predicate
//!
//! A name stands where a predicate is needed, and no `:predicates` section declares it.
//!
//! Nothing could ever make it true.
//!
//! ```pddl wrong
//! (define (domain hall) …)
//! ```
//!
//! ```pddl right
//! (define (domain hall) …)
//! ```
//! ````
//!
//! The language is for the reader: `pddl` for domains and problems, `plan` for plans, `toml` for TOML. Several blocks of
//! the same kind are files that belong together, a domain before its problem and the problem before its plan. In a text,
//! `…` inside `(and …` and `…)` stands for a thousand repetitions.
//!
//! Where the name of a file matters, as in a mission folder, the first line of its block is a comment that is the file's
//! path. Such a block may be a part of the file: the wrong one stands where the right one stands in a mission that is
//! otherwise good.

use serde::Serialize;

/// What a code means.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Explanation {
    /// Such as `E0202`.
    pub code: &'static str,
    /// What is wrong, in a few words.
    pub title: &'static str,
    /// When it is reported, as one line.
    pub meaning: String,
    /// Why it is wrong and what to do; a line for each paragraph.
    pub why: String,
    /// Files that give the code, in the order in which they are read.
    pub wrong: Vec<&'static str>,
    /// The same files without the mistake.
    pub right: Vec<&'static str>,
}

/// The page of an explanation is malformed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
enum Malformed {
    /// The first line is not `# ` and a title.
    #[error("the first line is not `# TITLE`")]
    NoTitle,
    /// The text between the title and the examples has fewer than two paragraphs.
    #[error("a paragraph is missing: the first gives the meaning, the second the reason")]
    NoReason,
    /// A fenced block opens with something other than a language and `wrong` or `right`.
    #[error("a block opens with `{0}` instead of a language and `wrong` or `right`")]
    UnknownBlock(&'static str),
    /// A fenced block is still open at the end of the page.
    #[error("a block is not closed")]
    OpenBlock,
    /// Something other than a fenced block follows the first example.
    #[error("text follows the examples: `{0}`")]
    TextBehindExamples(&'static str),
}

const FENCE: &str = "```";

impl Explanation {
    /// Reads the page of a code; [`Malformed`] if it departs from the format above.
    fn parse(code: &'static str, page: &'static str) -> Result<Self, Malformed> {
        let (first, body) = page.split_once('\n').unwrap_or((page, ""));
        let title = first.strip_prefix("# ").ok_or(Malformed::NoTitle)?;
        let (prose, mut blocks) = body.split_at(body.find(FENCE).unwrap_or(body.len()));
        let mut paragraphs = prose.trim().split("\n\n").map(|paragraph| paragraph.replace('\n', " "));
        let meaning = paragraphs.next().unwrap_or_default();
        let why = paragraphs.collect::<Vec<_>>().join("\n");
        if why.is_empty() {
            return Err(Malformed::NoReason);
        }
        let (mut wrong, mut right) = (Vec::new(), Vec::new());
        while let Some(rest) = blocks.trim_start().strip_prefix(FENCE) {
            let (opening, rest) = rest.split_once('\n').ok_or(Malformed::OpenBlock)?;
            let (file, rest) = rest.split_once("\n```").ok_or(Malformed::OpenBlock)?;
            match opening.split_once(' ') {
                Some((_, "wrong")) => wrong.push(file),
                Some((_, "right")) => right.push(file),
                _ => return Err(Malformed::UnknownBlock(opening)),
            }
            blocks = rest;
        }
        if !blocks.trim().is_empty() {
            return Err(Malformed::TextBehindExamples(blocks.trim()));
        }
        Ok(Self { code, title, meaning, why, wrong, right })
    }

    /// Reads a page that is part of the program: `Explanation::included("W0701", include_str!("W0701.md"))`.
    /// [`explained!`](crate::explained) includes many.
    ///
    /// # Panics
    /// If the page is malformed. Each table of pages has a test that reads all of them.
    pub fn included(code: &'static str, page: &'static str) -> Self {
        Self::parse(code, page).unwrap_or_else(|malformed| panic!("{code}.md: {malformed}"))
    }
}

/// The explanations of codes, from the files that are named after them in folders beside the caller:
/// `explained!["check": "C0101" "C0102"; "load": "E0706";]`.
#[macro_export]
macro_rules! explained {
    ($($folder:literal: $($code:literal)+;)+) => {
        vec![$($(
            $crate::Explanation::included($code, include_str!(concat!($folder, "/", $code, ".md"))),
        )+)+]
    };
}

#[cfg(test)]
mod tests {
    use super::{Explanation, Malformed};

    #[test]
    fn paragraphs_are_joined_and_blocks_are_kept_as_they_stand() {
        let page = "# a title\n\nWhen\nit is.\n\nWhy.\n\nAnd what\nto do.\n\n```pddl wrong\n(a\n  b)\n```\n\n```plan right\n(c)\n```\n";
        let read = Explanation::parse("E0001", page).expect("the page is well formed");
        assert_eq!((read.code, read.title), ("E0001", "a title"));
        assert_eq!((read.meaning.as_str(), read.why.as_str()), ("When it is.", "Why.\nAnd what to do."));
        assert_eq!((read.wrong, read.right), (vec!["(a\n  b)"], vec!["(c)"]));
    }

    #[test]
    fn a_malformed_page_is_refused() {
        use Malformed::{NoReason, NoTitle, OpenBlock, TextBehindExamples, UnknownBlock};
        let refused = |page| Explanation::parse("E0001", page).expect_err("the page is malformed");
        assert_eq!(refused("a title\n\nWhen.\n\nWhy.\n"), NoTitle);
        assert_eq!(refused("# a title\n\nWhen.\n\n```pddl wrong\na\n```\n"), NoReason);
        assert_eq!(refused("# a title\n\nWhen.\n\nWhy.\n\n```pddl\na\n```\n"), UnknownBlock("pddl"));
        assert_eq!(refused("# a title\n\nWhen.\n\nWhy.\n\n```pddl wrong\na\n"), OpenBlock);
        assert_eq!(
            refused("# a title\n\nWhen.\n\nWhy.\n\n```pddl wrong\na\n```\nMore.\n"),
            TextBehindExamples("More.")
        );
    }
}
