//! `(exists (?x) …)` inside of something that has `?x` already.

use diagnostics::Place;
use pddl::FileKind;
use pddl::syntax::{Node, NodeKind};

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::{DomainView, ProblemView};
use crate::{Level, Lint, place, text};

pub(crate) static LINT: Lint = Lint {
    name: "shadowed-variable",
    level: Level::Default,
    explanation: explanation!("W0714"),
    checks: &[Check::Domain(in_domain), Check::Problem(in_problem)],
};

fn in_domain(view: &DomainView<'_>, found: &mut Findings) {
    for section in text::sections(view.tree(), FileKind::Domain) {
        visit(section, &mut parameters(section), place::domain, found);
    }
}

fn in_problem(view: &ProblemView<'_, '_>, found: &mut Findings) {
    // A large initial state is not walked for nothing: it binds no variables.
    let sections = text::sections(view.tree(), FileKind::Problem).filter(|s| !s.is_headed(":init"));
    for section in sections {
        visit(section, &mut parameters(section), place::problem, found);
    }
}

/// The parameters of an action, method or axiom, and the results of a rule.
fn parameters(section: Node<'_>) -> Vec<Node<'_>> {
    let head = if section.is_headed(":derived") { section.children().nth(1) } else { None };
    let lists = [text::value(section, ":parameters"), text::value(section, ":results"), head];
    lists.into_iter().flatten().flat_map(variables).collect()
}

fn variables(list: Node<'_>) -> impl Iterator<Item = Node<'_>> {
    list.children().filter(|child| child.kind() == NodeKind::Variable)
}

fn visit<'t>(
    node: Node<'t>,
    visible: &mut Vec<Node<'t>>,
    place: fn(pddl::Span) -> Place,
    found: &mut Findings,
) {
    let outside = visible.len();
    let binds = (node.is_headed("forall") || node.is_headed("exists"))
        && node.children().nth(1).is_some_and(Node::is_list);
    if binds {
        for variable in node.children().nth(1).into_iter().flat_map(variables) {
            if let Some(outer) = visible[..outside].iter().rev().find(|v| variable.is(v.text())) {
                let message = format!("`{}` hides the variable of that name around it", variable.text());
                let finding = LINT.finding(place(variable.span()), message);
                found.report(finding.label(place(outer.span()), "the one that it hides"));
            }
            visible.push(variable);
        }
    }
    for child in node.children().filter(|child| child.is_list()) {
        visit(child, visible, place, found);
    }
    visible.truncate(outside);
}
