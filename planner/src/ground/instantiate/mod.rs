//! Builds every instance of every schema, before pruning.
//!
//! Idea: each binding that reachability found becomes an operator (or a rule) over atoms of the
//! table. Conditional and universal effects are expanded. Literals that the precondition implies
//! are dropped from the conditions of effects.
//!
//! In: the normalised model, the reached atoms and bindings, and the exclusions. Out: a
//! [`RawTask`].

mod changes;
mod effects;
mod fold;
mod folded;
mod numbers;
mod operators;
mod raw;

pub(crate) use folded::Comparison;
pub(crate) use raw::{RawChange, RawEffects, RawOperator, RawOperators, RawTask};

use super::binding::resolve;
use super::error::{Failure, GroundError};
use super::exclusion::Exclusions;
use super::literal::{Lit, consistent};
use super::memory;
use super::normalise::{Measure, NoCost, Normalised, Product, Schema};
use super::relax::{Bindings, Reached};
use budget::{Interrupted, Meter};
use changes::changes;
use effects::{clashes, expand};
use fold::Instantiator;
use pddl::model::Name;
use rustc_hash::{FxHashMap, FxHashSet};

/// The most copies of an operator, one for each way to satisfy its precondition; beyond that an
/// axiom is used.
const COPIES: usize = 4;

/// Builds all instances.
pub(crate) fn instantiate(
    model: &Normalised<'_>,
    reached: &Reached,
    exclusions: &Exclusions,
    meter: &Meter<'_>,
) -> Result<RawTask, Failure> {
    let Normalised { schemas, costs, fluents, values, .. } = model;
    let goal = (&model.goal, &model.goal_slots);
    let mut work = Instantiator::new(&reached.table, &model.is_static, exclusions, fluents, meter);
    let mut operators = RawOperators::default();
    let mut bytes = 0;
    let mut rules = Vec::new();
    for (schema, bindings) in schemas.iter().zip(&reached.bindings) {
        let mut binding = vec![0; schema.slots.len()];
        let mut seen = FxHashSet::default();
        for row in 0..bindings.rows {
            if let Err(why) = meter.hold(bytes) {
                return Err(stopped(why, schema, bindings.rows).into());
            }
            work.guard.begin();
            bind(schema, bindings, row, &mut binding);
            let condition = work.fold(&schema.condition, &schema.slots, &mut binding);
            if let Some(why) = work.guard.interruption() {
                return Err(stopped(why, schema, bindings.rows).into());
            }
            match &schema.product {
                Product::Axiom { predicate, arguments } => {
                    let head = arguments.iter().map(|&t| resolve(t, &binding));
                    let Some(head) = work.table.find(*predicate, head) else { continue };
                    if let Some(body) = work.conjunction(condition) {
                        rules.push((head, body));
                    }
                }
                Product::Action { id, effects, costs: terms, numbers } => {
                    let alternatives = work.alternatives(condition, COPIES);
                    if alternatives.is_empty() {
                        continue;
                    }
                    let cost = match costs.cost(fluents, terms, &binding) {
                        Ok(cost) => cost,
                        Err(NoCost::Inapplicable) => continue,
                        Err(NoCost::Negative) => return Err(Failure::NegativeCost),
                    };
                    let all = expand(&mut work, schema, effects, &mut binding);
                    if let Some(why) = work.guard.interruption() {
                        return Err(stopped(why, schema, bindings.rows).into());
                    }
                    let mut clashes = clashes(&work, values, &all);
                    let Some(changes) = changes(&mut work, schema, numbers, &mut binding, &mut clashes)
                    else {
                        continue;
                    };
                    if let Some(why) = work.guard.interruption() {
                        return Err(stopped(why, schema, bindings.rows).into());
                    }
                    let arguments = &binding[..schema.parameters];
                    for precondition in alternatives {
                        let Some(precondition) = work.without(precondition, &clashes) else { continue };
                        // Bindings may differ only in hoisted variables; one of several equal
                        // operators is enough.
                        if !schema.hoisted.is_empty()
                            && !seen.insert((Box::<[u32]>::from(arguments), precondition.clone()))
                        {
                            continue;
                        }
                        let size =
                            operators.add(&mut work, *id, arguments, precondition, (&all, &changes), cost);
                        bytes += memory::instance(arguments.len(), size);
                    }
                }
            }
        }
    }
    let mut literals = Vec::new();
    let mut refuted = Vec::new();
    let mut binding = vec![0; goal.1.len()];
    work.guard.begin();
    for conjunct in goal.0.conjuncts() {
        let ground = work.fold(conjunct, goal.1, &mut binding);
        match work.conjunction(ground) {
            Some(more) => literals.extend(more),
            None => refuted.push(conjunct.clone()),
        }
    }
    if let Some(why) = work.guard.interruption() {
        return Err(stopped_at(why, Name::new("goal"), 1).into());
    }
    let mut exclusive = None;
    match consistent(literals) {
        Some(sorted) => {
            exclusive = rivals(exclusions, &sorted);
            literals = sorted;
        }
        None => {
            literals = Vec::new();
            refuted.push(goal.0.clone());
        }
    }
    rules.append(&mut work.rules);
    let metric = match &costs.measure {
        Measure::Value(metric) => fluents.fold(&metric.expression, &[]).ok().map(|e| (metric.objective, e)),
        Measure::Length | Measure::Sum { .. } => None,
    };
    let metric = metric.map(|(objective, metric)| (objective, work.numbers.expression(&metric)));
    let (atoms, numbers) = (work.atoms(), work.numbers);
    Ok(RawTask { operators, rules, goal: literals, refuted, exclusive, atoms, numbers, metric })
}

fn stopped(why: Interrupted, schema: &Schema, instances: usize) -> GroundError {
    stopped_at(why, schema.name.clone(), instances)
}

fn stopped_at(why: Interrupted, schema: Name, instances: usize) -> GroundError {
    match why {
        Interrupted::Cancelled | Interrupted::Work => GroundError::Interrupted { schema },
        Interrupted::Memory => GroundError::Limit { schema, instances },
    }
}

/// Finds two literals that exclude each other.
fn rivals(exclusions: &Exclusions, literals: &[Lit]) -> Option<(u32, u32)> {
    let mut by_group = FxHashMap::default();
    for atom in literals.iter().filter(|&&l| l & 1 == 0).map(|l| l >> 1) {
        for &group in exclusions.of(atom) {
            if let Some(other) = by_group.insert(group, atom) {
                return Some((other, atom));
            }
        }
    }
    None
}

fn bind(schema: &Schema, bindings: &Bindings, row: usize, binding: &mut [u32]) {
    let values = &bindings.values[row * bindings.width..(row + 1) * bindings.width];
    let hoisted = schema.hoisted.iter().map(|v| v.0 as usize);
    for (slot, &value) in (0..schema.parameters).chain(hoisted).zip(values) {
        binding[slot] = value;
    }
}
