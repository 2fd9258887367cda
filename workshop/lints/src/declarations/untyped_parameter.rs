//! `?x` without `- type` where the others have types.

use pddl::model::{TypeSet, Variables};
use pddl::syntax::{Node, NodeKind};
use pddl::{FileKind, Span};
use rustc_hash::FxHashSet;

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::text;
use crate::view::DomainView;
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "untyped-parameter",
    level: Level::Default,
    explanation: explanation!("W0712"),
    checks: &[Check::Domain(check)],
};

fn check(view: &DomainView<'_>, found: &mut Findings) {
    let domain = view.domain;
    if domain.types.len() == 1 {
        return;
    }
    let mut anything: FxHashSet<Span> = FxHashSet::default();
    let mut declared = |variables: &Variables| {
        let any = variables.slots.iter().filter(|v| v.types == TypeSet::any());
        anything.extend(any.map(|v| v.span));
    };
    view.schemas().for_each(|schema| declared(schema.variables()));
    domain.predicates.iter().for_each(|p| declared(&p.variables));
    domain.functions.iter().for_each(|f| declared(&f.variables));
    domain.tasks.iter().for_each(|t| declared(&t.variables));
    if anything.is_empty() {
        return;
    }
    for section in text::sections(view.tree(), FileKind::Domain) {
        untyped(section, &mut |variable| {
            if anything.contains(&variable.span()) {
                let message = format!("`{}` has no type in a domain that has types", variable.text());
                let help = "give it one, or write `- object` if it may be anything";
                found.report(LINT.finding(place::domain(variable.span()), message).help(help));
            }
        });
    }
}

/// Variables of lists that no `-` follows in their list.
fn untyped<'t>(list: Node<'t>, f: &mut impl FnMut(Node<'t>)) {
    let mut waiting: Vec<Node<'t>> = Vec::new();
    for child in list.children() {
        match child.kind() {
            NodeKind::Variable => waiting.push(child),
            NodeKind::List => untyped(child, f),
            _ if child.is("-") => waiting.clear(),
            _ => {}
        }
    }
    waiting.into_iter().for_each(f);
}
