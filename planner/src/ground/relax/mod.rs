//! Reachability of atoms and instances in the delete relaxation.
//!
//! Conditions become rules (`rule`), rules become ordered joins (`plan`), and joins run to a
//! fixpoint (`join`). In: the normalised model. Out: [`Reached`].

mod filter;
mod indices;
mod join;
mod plan;
mod rule;

pub(crate) use join::Bindings;

use super::error::{Failure, GroundError};
use super::memory;
use super::normalise::{Normalised, Universe};
use crate::ids::id32;
use crate::task::AtomTable;
use budget::{Interrupted, Meter};
use pddl::model::{Domain, Fact, Idx, ObjectId, PredicateId};

/// The reachable atoms and instances.
pub(crate) struct Reached {
    pub(crate) table: AtomTable,
    /// The number of atoms that come first in the table and never change.
    pub(crate) statics: u32,
    /// Atoms that change and hold initially.
    pub(crate) initial: Vec<u32>,
    /// By schema.
    pub(crate) bindings: Vec<Bindings>,
}

/// Computes all reachable atoms and instances.
pub(crate) fn relax(model: &Normalised<'_>, meter: &Meter<'_>) -> Result<Reached, Failure> {
    let (domain, problem, is_static) = (model.domain, model.problem, &model.is_static);
    let mut table = AtomTable::new(domain.predicates.len(), problem.objects.len());
    let insert = |table: &mut AtomTable, fact: &Fact| {
        meter.spend(128).map(|()| table.insert(fact.predicate, fact.arguments.iter().map(|o| o.0)))
    };
    for fact in problem.init.iter().filter(|f| is_static[f.predicate.index()]) {
        insert(&mut table, fact)?;
    }
    let statics = id32(table.len());
    let mut initial = Vec::new();
    for fact in problem.init.iter().filter(|f| !is_static[f.predicate.index()]) {
        initial.push(insert(&mut table, fact)?);
    }
    let mut universe = Universe::new(domain, problem);
    for &predicate in model.exogenous {
        add_all_instances(domain, predicate, &mut universe, &mut table, meter)?;
    }
    let (table, bindings) = join::join(model, table, statics, meter)?;
    Ok(Reached { table, statics, initial, bindings })
}

/// Adds every type-correct instance of a predicate.
fn add_all_instances(
    domain: &Domain,
    predicate: PredicateId,
    universe: &mut Universe<'_>,
    table: &mut AtomTable,
    meter: &Meter<'_>,
) -> Result<(), Failure> {
    let declared = &domain.predicates[predicate];
    let extents = universe.slots(&declared.variables);
    let ranges: Vec<&[ObjectId]> =
        extents[..declared.variables.parameters].iter().map(|extent| extent.objects()).collect();
    if ranges.iter().any(|r| r.is_empty()) {
        return Ok(());
    }
    let before = table.len();
    let mut odometer = vec![0_usize; ranges.len()];
    loop {
        meter.spend(128)?;
        table.insert(predicate, odometer.iter().zip(&ranges).map(|(&i, r)| r[i].0));
        let instances = table.len() - before;
        if meter.hold(instances * memory::atom(ranges.len())) == Err(Interrupted::Memory) {
            return Err(GroundError::Limit { schema: declared.name.clone(), instances }.into());
        }
        let Some(digit) = (0..ranges.len()).rev().find(|&d| odometer[d] + 1 < ranges[d].len()) else {
            return Ok(());
        };
        odometer[digit] += 1;
        odometer[digit + 1..].fill(0);
    }
}
