//! An effect that contradicts itself where two parameters are the same object.

use analysis::invariants::differ;
use pddl::model::{Atom, EffectKind, Term};

use super::changes::Changes;
use super::literals::{Fact, Literal, required};
use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::DomainView;
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "aliased-effect",
    level: Level::Pedantic,
    explanation: explanation!("W0818"),
    checks: &[Check::Domain(check)],
};

/// Whether the literals ask for a fact about both that nothing changes, a road from one to the other: whether an object
/// is related with itself is the problem's.
fn related(view: &DomainView<'_>, literals: &[Literal], a: Term, b: Term) -> bool {
    literals.iter().any(|literal| match &literal.fact {
        Fact::Atom(predicate, arguments) => {
            let fixed = !view.usage().predicates[*predicate].fluent();
            fixed && literal.positive && arguments.contains(&a) && arguments.contains(&b)
        }
        Fact::Same(..) => false,
    })
}

fn check(view: &DomainView<'_>, found: &mut Findings) {
    for schema in view.schemas() {
        let variables = schema.variables();
        let asked: Vec<_> = schema.conditions().into_iter().flatten().collect();
        let literals = required(asked);
        let different: Vec<(Term, Term)> = literals
            .iter()
            .filter_map(|literal| match literal.fact {
                Fact::Same(a, b) if !literal.positive => Some((a, b)),
                _ => None,
            })
            .collect();
        // A fact that is asked for and its negation for another object keep the objects apart as well.
        let apart = |a: &Atom, b: &Atom| {
            let holds = |atom: &Atom, positive| {
                literals.iter().any(|l| l.positive == positive && l.fact == Fact::of(atom))
            };
            let differ = |(&a, &b): (&Term, &Term)| differ(view.domain, variables, a, b, &different);
            let kept = |(&a, &b): (&Term, &Term)| a != b && related(view, &literals, a, b);
            (holds(a, false) && holds(b, true))
                || a.arguments.iter().zip(&b.arguments).any(kept)
                || a.arguments.iter().zip(&b.arguments).any(differ)
        };
        for effects in schema.effects() {
            let changes = Changes::of(effects);
            for deleted in changes.certain() {
                let EffectKind::Delete(deleted) = &deleted.kind else { continue };
                let added = changes.certain().find_map(|effect| match &effect.kind {
                    EffectKind::Add(added)
                        if added.predicate == deleted.predicate
                            && added.arguments != deleted.arguments
                            && !apart(added, deleted) =>
                    {
                        Some(added)
                    }
                    _ => None,
                });
                if let Some(added) = added {
                    let title = schema.title(view.domain);
                    let message = format!("{title} undoes this where its parameters are the same object");
                    let finding = LINT.finding(place::domain(deleted.span), message);
                    found.report(
                        finding
                            .label(place::domain(added.span), "adding wins")
                            .help("ask for `not =` in the precondition if they are meant to differ"),
                    );
                }
            }
        }
    }
}
