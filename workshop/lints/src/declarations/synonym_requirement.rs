//! `:htn` for `:hierarchy`.

use pddl::FileKind;
use pddl::model::Requirement;

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::{DomainView, ProblemView};
use crate::{Level, Lint, place, text};

pub(crate) static LINT: Lint = Lint {
    name: "synonym-requirement",
    level: Level::Default,
    explanation: explanation!("W0717"),
    checks: &[Check::Domain(in_domain), Check::Problem(in_problem)],
};

fn in_domain(view: &DomainView<'_>, found: &mut Findings) {
    check(view.tree(), FileKind::Domain, found);
}

fn in_problem(view: &ProblemView<'_, '_>, found: &mut Findings) {
    check(view.tree(), FileKind::Problem, found);
}

fn check(tree: &pddl::syntax::Tree<'_>, file: FileKind, found: &mut Findings) {
    let sections = text::sections(tree, file).filter(|section| section.is_headed(":requirements"));
    for node in sections.flat_map(|section| section.children().skip(1)) {
        let Some((_, standard)) = Requirement::SYNONYMS.iter().find(|(text, _)| node.is(text)) else {
            continue;
        };
        let place = place::of_file(file, node.span());
        let standard = standard.as_str();
        let message = format!("`{}` is no requirement of any standard", node.text());
        let edit = (place, standard.to_owned());
        found.report(LINT.finding(place, message).fix(format!("write `{standard}`"), vec![edit]));
    }
}
