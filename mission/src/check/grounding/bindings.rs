//! Enumerating the bindings of a schema under which its conditions may hold.
//!
//! Cost: a conjunct is evaluated as soon as its variables are bound, so a constant or a fact that never holds cuts off all
//! bindings behind it. A [`Meter`] ends an enumeration that is too large; the caller reports that.

use std::cell::Cell;

use pddl::model::{Condition, ConditionKind, Idx, Term, VariableId};

use super::classes::ClassId;
use super::known::Known;
use super::mentions;
use super::scope::Scope;

/// How many partial bindings may be visited in all. Barthel needs some ten thousand.
const LIMIT: u32 = 2_000_000;

/// Counts partial bindings.
#[derive(Debug, Default)]
pub(super) struct Meter(Cell<u32>);

impl Meter {
    pub(super) fn is_exhausted(&self) -> bool {
        self.0.get() >= LIMIT
    }

    fn step(&self) -> bool {
        self.0.set(self.0.get().saturating_add(1));
        !self.is_exhausted()
    }
}

/// The conjuncts of a condition.
pub(in crate::check) fn conjuncts<'c>(condition: &'c Condition, into: &mut Vec<&'c Condition>) {
    match &condition.kind {
        ConditionKind::And(parts) => parts.iter().for_each(|part| conjuncts(part, into)),
        _ => into.push(condition),
    }
}

/// Visits each binding of `variables` under which every condition may hold.
pub(super) fn each(
    scope: &mut Scope<'_>,
    variables: &[VariableId],
    conditions: &[&Condition],
    known: &Known<'_>,
    meter: &Meter,
    visit: &mut dyn FnMut(&mut Scope<'_>),
) {
    let mut at_depth: Vec<Vec<&Condition>> = vec![Vec::new(); variables.len() + 1];
    for &condition in conditions {
        let mut depth = 0;
        mentions::of_condition(condition, &mut |terms| {
            for term in terms {
                if let Term::Variable(variable) = term
                    && let Some(at) = variables.iter().position(|v| v == variable)
                {
                    depth = depth.max(at + 1);
                }
            }
        });
        at_depth[depth].push(condition);
    }
    let ranges: Vec<_> = variables.iter().map(|&v| scope.range(v)).collect();
    let holds = at_depth[0].iter().all(|c| scope.may(c, true, known));
    if holds {
        let search = Search { variables, ranges: &ranges, conditions: &at_depth, known, meter };
        search.bind(0, scope, visit);
    }
}

struct Search<'s> {
    variables: &'s [VariableId],
    ranges: &'s [Vec<ClassId>],
    conditions: &'s [Vec<&'s Condition>],
    known: &'s Known<'s>,
    meter: &'s Meter,
}

impl Search<'_> {
    fn bind(&self, depth: usize, scope: &mut Scope<'_>, visit: &mut dyn FnMut(&mut Scope<'_>)) {
        let Some(&variable) = self.variables.get(depth) else { return visit(scope) };
        for &class in &self.ranges[depth] {
            if !self.meter.step() {
                break;
            }
            scope.binding[variable.index()] = Some(class);
            if self.conditions[depth + 1].iter().all(|c| scope.may(c, true, self.known)) {
                self.bind(depth + 1, scope, visit);
            }
        }
        scope.binding[variable.index()] = None;
    }
}
