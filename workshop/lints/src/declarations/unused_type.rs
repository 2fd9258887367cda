//! A type that nothing is of.

use pddl::model::{Feature, TypeTable};

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::{DomainView, is_here};
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "unused-type",
    level: Level::Default,
    explanation: explanation!("W0707"),
    checks: &[Check::Domain(check)],
};

fn check(view: &DomainView<'_>, found: &mut Findings) {
    // What is an `object` somewhere may be of any type.
    // Conditions name types as well where they are predicates.
    let named = view.domain.features().iter().any(|(f, _)| *f == Feature::TypePredicates);
    if named || !view.is_complete() || view.is_vocabulary() || view.usage().types[TypeTable::OBJECT] {
        return;
    }
    let (types, used) = (&view.domain.types, &view.usage().types);
    for (id, declared) in types.enumerate().filter(|(_, t)| is_here(t.span)) {
        let relative = |&(other, _): &(_, _)| types.is_subtype(other, id) || types.is_subtype(id, other);
        if !types.enumerate().filter(relative).any(|(other, _)| used[other]) {
            let message = format!("nothing in this domain is about the type `{}`", declared.name);
            found.report(LINT.finding(place::domain(declared.span), message));
        }
    }
}
