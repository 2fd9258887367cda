//! `(exists (?x) …)` where nothing says `?x`.

use pddl::Explanation;
use pddl::model::{Idx, Term, VariableId, Variables};

use crate::finding::Findings;
use crate::lint::Check;
use crate::view::{DomainView, ProblemView};
use crate::walk::{self, Part, Polarity};
use crate::{Finding, Level, Lint, Place};

pub(crate) static LINT: Lint = Lint {
    name: "unused-variable",
    level: Level::Default,
    explanation: Explanation {
        code: "W0710",
        title: "unused variable",
        meaning: "A quantifier binds a variable that its body does not name.",
        why: "`forall` and `exists` then only ask whether there is any object of that type. Often the body \
         names the wrong variable.",
        wrong: &["\
(define (domain hall)
  (:requirements :typing :existential-preconditions)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :precondition (exists (?y - lamp) (lit ?x))
    :effect (lit ?x)))"],
        right: &["\
(define (domain hall)
  (:requirements :typing :existential-preconditions)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :precondition (exists (?y - lamp) (lit ?y))
    :effect (lit ?x)))"],
    },
    checks: &[Check::Domain(in_domain), Check::Problem(in_goal)],
};

fn in_domain(view: &DomainView<'_>, found: &mut Findings) {
    for schema in view.schemas() {
        unused(schema.variables(), Place::domain, found, |f| schema.parts(f));
    }
    let constraints = &view.domain.constraints;
    unused(&constraints.variables, Place::domain, found, |f| walk::constraints(constraints, f));
}

fn in_goal(view: &ProblemView<'_, '_>, found: &mut Findings) {
    let problem = view.problem;
    unused(&problem.goal_variables, Place::problem, found, |f| {
        walk::condition(&problem.goal, Polarity::Positive, f);
        problem.preferences.iter().for_each(|p| walk::preference(p, &p.body, f));
    });
    let constraints = &problem.constraints;
    unused(&constraints.variables, Place::problem, found, |f| walk::constraints(constraints, f));
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
        found.report(Finding::new(&LINT, place(variables[id].span), message));
    }
}
