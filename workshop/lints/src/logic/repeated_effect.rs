//! `(and (p) (p))` in an effect.

use rustc_hash::FxHashMap;

use super::changes::Changes;
use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::shape::Shape;
use crate::view::DomainView;
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "repeated-effect",
    level: Level::Default,
    explanation: explanation!("W0805"),
    checks: &[Check::Domain(check)],
};

fn check(view: &DomainView<'_>, found: &mut Findings) {
    for effects in view.schemas().flat_map(|schema| schema.effects()) {
        let Changes { changes, .. } = Changes::of(effects);
        let mut first: FxHashMap<(usize, String), pddl::Span> = FxHashMap::default();
        for change in &changes {
            let span = change.effect.span;
            let key = (change.context, Shape::PLAIN.effect(change.effect));
            if let Some(&earlier) = first.get(&key) {
                let finding = LINT.finding(place::domain(span), "this effect stands here a second time");
                found.report(finding.label(place::domain(earlier), "first here"));
            } else {
                first.insert(key, span);
            }
        }
    }
}
