//! The formatter: the same tokens and comments, other white space.
//!
//! Problem: files should look as if one careful person had written them all, whichever of PDDL, HDDL, agents'
//! rules, a vocabulary or a plan they hold, and also while their model is still wrong. Idea: work on the tokens
//! of the lossless tree, never on the model; what is not white space is never changed, so the tree is the same
//! before and after, upper and lower case included.
//!
//! The rules:
//! - A list that fits on its line (100 columns) stands on one. Sections (lists with a keyword in front) and
//!   conditions (`and`, `or`, `imply`, `forall`, `exists`, `when`, `preference`) that the author had broken stay
//!   broken; `(define …)` always is.
//! - A broken section of keys has each key on its own line, two columns in, its value beside it, or below it where
//!   that makes it fit.
//! - The author chooses between two forms of a broken `and`, `or` or section: a line end directly after the head puts
//!   what follows two columns in, in a condition a line for each; a later one puts it below the first argument.
//!   There and in sections the author's lines stay lines, and what is too long for one goes on in the next.
//! - `- type` stays with what it types. Closing parentheses stand behind the last thing that they enclose.
//! - A comment on its own line stands where the next thing would. One behind something stays behind it, as far
//!   away as it was; those below each other in one column stay in one column, up to an empty line.
//! - At most one empty line between two things, none directly after a head or before a closing parenthesis.
//! - Outside of all lists lines stay lines, and a step of a plan is never broken.
//! - Line ends are `\n`, the last line has one, no line ends in blanks, and there is no byte order mark.
//!
//! Invariants: formatting twice is formatting once; tokens and comments are the same in the same order (of
//! comments, without the blanks at their end). Cost: one pass over the tokens to measure every list, one to write;
//! open lists are on a stack of our own, not of the thread.
//!
//! Source: the measuring pass is that of Oppen, "Prettyprinting", TOPLAS 1980, §3; deviation: what is
//! broken depends on what the author had broken.

mod comments;
mod layout;
mod measure;
mod rules;

use crate::{Diagnostic, Source, syntax};

/// Longest line that lists are fitted to, in characters.
pub(crate) const WIDTH: usize = 100;

/// The text of `source` as it should be laid out.
///
/// # Errors
/// What is wrong with its parentheses; such a text has no layout.
///
/// ```
/// let source = pddl::Source::new("hall.pddl", "(define (domain hall) (:predicates(lit ?x -lamp)))");
/// assert_eq!(pddl::format(&source).unwrap(), "(define (domain hall)\n  (:predicates (lit ?x - lamp)))\n");
/// ```
pub fn format(source: &Source) -> Result<String, Vec<Diagnostic>> {
    let (tree, diagnostics) = syntax::parse(source);
    if !diagnostics.is_empty() {
        return Err(diagnostics);
    }
    let measured = measure::measure(source.text(), tree.tokens());
    Ok(layout::layout(&measured))
}
