//! The formatter: the same tokens and comments, other white space.
//!
//! Problem: files should look as if one careful person had written them all. That includes PDDL, HDDL,
//! agents' rules, vocabularies and plans, and files whose model still has errors. Idea: work on the tokens
//! of the lossless tree, never on the model. Only white space changes, so the tree is the same before and
//! after, upper and lower case included.
//!
//! The rules:
//! - A list that fits on its line (100 columns) stands on one. Sections (lists with a keyword in front) and
//!   conditions (`and`, `or`, `imply`, `forall`, `exists`, `when`, `preference`) that the author had broken
//!   stay broken; `(define …)` is always broken.
//! - A broken section of keys has each key on its own line, indented by two columns. The value stands beside
//!   its key, or below it where that makes it fit.
//! - The author chooses between two forms of a broken `and`, `or` or section. A line end directly after the
//!   head indents the rest by two columns, and in a condition gives each part its own line. A later line end
//!   aligns the rest below the first argument. There and in sections the author's lines stay lines, and a
//!   line that is too long continues in the next.
//! - `- type` stays with the names that it types. Closing parentheses stand behind the last part that they
//!   enclose.
//! - A comment on its own line is indented as the next part would be. A comment behind code stays behind it,
//!   at the same distance; comments below each other in one column stay in one column, up to an empty line.
//! - At most one empty line between two parts, none directly after a head or before a closing parenthesis.
//! - Outside of all lists lines stay lines, and a step of a plan is never broken.
//! - Line ends are `\n`, the last line has one, no line ends in blanks, and there is no byte order mark.
//!
//! Invariants: formatting is idempotent; tokens and comments are the same in the same order (of comments,
//! without trailing blanks). Cost: one pass over the tokens to measure every list, one to write; open lists
//! are on an explicit stack, not on the thread's.
//!
//! Source: the measuring pass is that of Oppen, "Prettyprinting", TOPLAS 1980, §3; deviation: the author's
//! line ends decide which lists are broken.

mod comments;
mod layout;
mod measure;
mod rules;

use crate::{Diagnostic, Source, syntax};

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
