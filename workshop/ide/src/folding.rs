//! The ranges of a file that an editor can fold.

use diagnostics::SourceId;
use pddl::syntax::{self, Node, TokenKind, Tree};
use pddl::{Source, Span};
use project::Project;

/// The kind of a fold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FoldKind {
    /// A list over several lines.
    List,
    /// Consecutive lines of comment.
    Comment,
}

/// A range that can be folded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fold {
    /// The whole range.
    pub span: Span,
    /// Its kind.
    pub kind: FoldKind,
}

/// The folds of a file, in order of place.
pub fn folding(project: &Project, source: SourceId) -> Vec<Fold> {
    let text = project.source(source);
    let (tree, _) = syntax::parse(text);
    let line = |offset: u32| text.line_column(offset).line;
    let mut folds = comments(text, &tree);
    let mut open: Vec<Node<'_>> = tree.roots().filter(|n| n.is_list()).collect();
    while let Some(list) = open.pop() {
        let span = list.span();
        if line(span.start) == line(span.end) {
            continue;
        }
        folds.push(Fold { span, kind: FoldKind::List });
        open.extend(list.children().filter(|n| n.is_list()));
    }
    folds.sort_by_key(|fold| fold.span);
    folds
}

/// Two or more consecutive lines of comment.
fn comments(source: &Source, tree: &Tree<'_>) -> Vec<Fold> {
    let mut folds: Vec<Fold> = Vec::new();
    let mut last_line = 0;
    for (kind, span) in tree.tokens() {
        let at = source.line_column(span.start);
        if kind != TokenKind::Comment || !source.line(at.line).trim_start().starts_with(';') {
            continue;
        }
        match folds.last_mut() {
            Some(fold) if last_line + 1 == at.line => fold.span.end = span.end,
            _ => folds.push(Fold { span, kind: FoldKind::Comment }),
        }
        last_line = at.line;
    }
    folds.retain(|fold| source.slice(fold.span).contains('\n'));
    folds
}
