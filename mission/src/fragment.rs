//! A PDDL condition inside a TOML string.
//!
//! Problem: `pddl` reads files, not fragments. Idea: the fragment becomes the goal of a small problem over a domain; the
//! spans of the findings are then moved back from the surrounding text to the TOML literal. Invariant: a condition that
//! was read names only what the domain declares.

use pddl::model::{Condition, Domain, Variables};
use pddl::{Source, Span};

use diagnostics::toml::{Reader, Text};

const FLAGS: &str = ":adl :fluents";

/// Reads the condition in `text`. The inner spans of the result belong to no file.
pub(crate) fn read(reader: &mut Reader<'_>, domain: &Domain, text: &Text) -> Option<(Condition, Variables)> {
    let prefix = format!(
        "(define (problem condition) (:domain {}) (:requirements {FLAGS}) (:init) (:goal ",
        domain.name
    );
    let offset = u32::try_from(prefix.len()).expect("the text around a condition is short");
    if let Some(span) = unbalanced(&text.value) {
        reader.error("E0902", text.within(span), "the parentheses of this condition do not match");
        return None;
    }
    let source = Source::new("condition", format!("{prefix}{}))", text.value));
    let parsed = pddl::parse_problem(&source, domain);
    let moved = |span: Span| {
        text.within(Span::new(span.start.saturating_sub(offset), span.end.saturating_sub(offset)))
    };
    for diagnostic in parsed.diagnostics {
        let mut finding = diagnostic.finding(reader.source);
        finding.place.span = moved(finding.place.span);
        // Related places are in the domain or in the text around the condition.
        finding.related.clear();
        reader.findings.push(finding);
    }
    let problem = parsed.model?;
    Some((problem.goal, problem.goal_variables))
}

/// The first place where the fragment is not one list, so that it would escape from the goal around it.
fn unbalanced(text: &str) -> Option<Span> {
    let mut depth = 0_u32;
    let mut closed = false;
    for (at, c) in (0_u32..).zip(text.bytes()) {
        match c {
            b'(' if !closed => depth += 1,
            b')' if depth > 0 => {
                depth -= 1;
                closed = depth == 0;
            }
            // A comment would swallow the text behind the fragment.
            b';' => return Some(Span::new(at, at + 1)),
            c if c.is_ascii_whitespace() || depth > 0 => {}
            _ => return Some(Span::new(at, at + 1)),
        }
    }
    let end = u32::try_from(text.len()).unwrap_or(u32::MAX);
    (!closed).then(|| Span::new(end.saturating_sub(1), end))
}

#[cfg(test)]
mod tests {
    use super::unbalanced;

    #[test]
    fn a_fragment_is_one_list() {
        assert_eq!(unbalanced(" (a (b) c) "), None);
        for wrong in ["", "a", "(a", "(a))", "(a) (b)", "(a ; )", "(a) b"] {
            assert!(unbalanced(wrong).is_some(), "{wrong}");
        }
    }
}
