//! `(exists (?x) …)` where nothing says `?x`.

use diagnostics::Place;
use pddl::model::{Idx, Term, VariableId, Variables};

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::{DomainView, ProblemView};
use crate::{Level, Lint, place};
use analysis::walk::{self, Part, Polarity};

pub(crate) static LINT: Lint = Lint {
    name: "unused-variable",
    level: Level::Default,
    explanation: explanation!("W0710"),
    checks: &[Check::Domain(in_domain), Check::Problem(in_goal)],
};

fn in_domain(view: &DomainView<'_>, found: &mut Findings) {
    for schema in view.schemas() {
        unused(schema.variables(), place::domain, found, |f| schema.parts(f));
    }
    let constraints = &view.domain.constraints;
    unused(&constraints.variables, place::domain, found, |f| walk::constraints(constraints, f));
    for invariant in &view.domain.invariants {
        unused(&invariant.variables, place::domain, found, |f| walk::invariant(invariant, f));
    }
}

fn in_goal(view: &ProblemView<'_, '_>, found: &mut Findings) {
    let problem = view.problem;
    unused(&problem.goal_variables, place::problem, found, |f| {
        walk::condition(&problem.goal, Polarity::Positive, f);
        problem.preferences.iter().for_each(|p| walk::preference(p, &p.body, f));
    });
    let constraints = &problem.constraints;
    unused(&constraints.variables, place::problem, found, |f| walk::constraints(constraints, f));
}

fn unused<'a>(
    variables: &Variables,
    place: fn(pddl::Span) -> Place,
    found: &mut Findings,
    parts: impl FnOnce(&mut dyn FnMut(Part<'a>)),
) {
    let (mut bound, mut used): (Vec<VariableId>, _) = (Vec::new(), vec![false; variables.slots.len()]);
    parts(&mut |part| {
        if let Part::Binds(variables) = part {
            bound.extend(variables);
        }
        for term in part.terms() {
            if let Term::Variable(variable) = term {
                used[variable.index()] = true;
            }
        }
    });
    for id in bound.into_iter().filter(|id| !used[id.index()]) {
        let message = format!("nothing names the variable `?{}` where it is bound", variables[id].name);
        found.report(LINT.finding(place(variables[id].span), message));
    }
}
