//! The effects of one instance, with quantifiers expanded and conflicting effects found.

use super::fold::Instantiator;
use super::folded::Ground;
use crate::ground::binding::{each_binding, resolve};
use crate::ground::literal::{Lit, consistent};
use crate::ground::normalise::{Schema, SchemaEffect};
use crate::task::{AtomTable, ValuePredicates};
use pddl::model::VariableId;

/// Condition, whether it adds, atom.
pub(super) type GroundEffect = (Vec<Lit>, bool, u32);

/// All ground effects: condition, whether it adds, atom.
pub(super) fn expand(
    work: &mut Instantiator<'_>,
    schema: &Schema,
    effects: &[SchemaEffect],
    binding: &mut [u32],
) -> Vec<GroundEffect> {
    let mut found = Vec::with_capacity(effects.len());
    for effect in effects {
        if effect.is_simple() {
            let row = effect.arguments.iter().map(|&t| resolve(t, binding));
            let atom = work.table.find(effect.predicate, row);
            found.extend(atom.map(|atom| (Vec::new(), effect.positive, atom)));
            continue;
        }
        let count =
            |total: usize, v: &VariableId| total.saturating_mul(schema.slots[v.0 as usize].objects().len());
        if !work.guard.allows(effect.quantified.iter().fold(1, count)) {
            break;
        }
        each_binding(&effect.quantified, &schema.slots, binding, &mut |binding| {
            let row = effect.arguments.iter().map(|&t| resolve(t, binding));
            let Some(atom) = work.table.find(effect.predicate, row) else { return };
            work.guard.keep();
            if !effect.quantified.is_empty() && !work.guard.look() {
                return;
            }
            let ground = work.fold(&effect.condition, &schema.slots, binding);
            // A disjunctive condition becomes several conditional effects, so no axiom is needed at
            // the top level.
            let options = match ground {
                Ground::False => return,
                Ground::Or(options) => options,
                other => vec![other],
            };
            for option in options {
                if let Some(condition) = work.conjunction(option) {
                    found.push((condition, effect.positive, atom));
                }
            }
        });
    }
    found
}

/// The conditions under which an object fluent would get two values at once; empty if the guard
/// stops.
pub(super) fn clashes(
    work: &Instantiator<'_>,
    values: &ValuePredicates,
    effects: &[GroundEffect],
) -> Vec<Vec<Lit>> {
    let table = work.table;
    let given = |(condition, positive, atom): &GroundEffect| {
        let is_value = *positive && values.function(table.predicate(*atom)).is_some();
        is_value.then(|| (condition.clone(), *atom))
    };
    let given: Vec<(Vec<Lit>, u32)> = effects.iter().filter_map(given).collect();
    let mut found = Vec::new();
    for (i, (first, a)) in given.iter().enumerate() {
        for (second, b) in &given[i + 1..] {
            if !work.guard.look() {
                return Vec::new();
            }
            if are_rivals(table, values, *a, *b) {
                found.extend(consistent(first.iter().chain(second).copied().collect()));
            }
        }
    }
    found.retain(|both| {
        let positive: Vec<u32> = both.iter().filter(|&l| l & 1 == 0).map(|l| l >> 1).collect();
        !positive.iter().any(|&a| positive.iter().any(|&b| are_rivals(table, values, a, b)))
    });
    found
}

/// Whether both atoms are values of the same fluent, and different.
fn are_rivals(table: &AtomTable, values: &ValuePredicates, a: u32, b: u32) -> bool {
    let is_atom = |x: u32| (x as usize) < table.len();
    let same = is_atom(a) && is_atom(b) && a != b && table.predicate(a) == table.predicate(b);
    same && values.function(table.predicate(a)).is_some()
        && table.row(a).split_last().map(|(_, fluent)| fluent) == table.row(b).split_last().map(|(_, f)| f)
}
