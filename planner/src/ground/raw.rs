//! Every instance of every schema, before pruning.
//!
//! Idea: each binding that reachability found becomes an operator (or a rule) over atoms of the
//! table; conditional and universal effects are expanded, and literals that the precondition already
//! decides are dropped from effects' conditions.

use super::cost::{CostModel, Measure, NoCost, resolve};
use super::error::GroundError;
use super::exclusion::Exclusions;
use super::fluents::Fluents;
use super::formula::Formula;
use super::instantiate::{Ground, Instantiator, Lit, consistent};
use super::join::{Bindings, Reached};
use super::memory;
use super::numbers::{Numbers, RawChange, changes};
use super::schema::{Product, Schema, SchemaEffect};
use crate::ids::id32;
use crate::number::Expression;
use crate::task::AtomTable;
use crate::task::Rows;
use crate::task::ValuePredicates;
use budget::{Interrupted, Meter};
use pddl::model::{ActionId, Name, Objective, VariableId};
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeMap;

/// Copies of an operator, one for each way to satisfy its precondition, before an axiom is used.
const COPIES: usize = 4;

/// Atoms that become true and false.
#[derive(Clone, Debug, Default)]
pub(crate) struct RawEffects {
    pub(crate) adds: Vec<u32>,
    pub(crate) deletes: Vec<u32>,
}

/// Condition, whether it adds, atom.
type GroundEffect = (Vec<Lit>, bool, u32);

/// An operator over atoms of the table.
#[derive(Clone, Copy)]
pub(crate) struct RawOperator<'r> {
    pub(crate) action: ActionId,
    pub(crate) arguments: &'r [u32],
    pub(crate) precondition: &'r [Lit],
    pub(crate) adds: &'r [u32],
    pub(crate) deletes: &'r [u32],
    /// Which of all conditional effects are its own.
    pub(crate) conditional: (u32, u32),
    pub(crate) cost: f64,
    pub(crate) numbers: &'r [RawChange],
}

/// All operators, their parts behind each other: see `Operators`, which they become.
#[derive(Default)]
pub(crate) struct RawOperators {
    actions: Vec<ActionId>,
    arguments: Rows,
    pub(crate) preconditions: Rows,
    adds: Rows,
    deletes: Rows,
    conditional_ends: Vec<u32>,
    conditions: Rows,
    conditional_adds: Rows,
    conditional_deletes: Rows,
    costs: Vec<f64>,
    number_ends: Vec<u32>,
    numbers: Vec<RawChange>,
}

/// An effect under a condition: that, what it adds and what it deletes.
type RawConditional<'r> = (&'r [Lit], &'r [u32], &'r [u32]);

impl RawOperators {
    pub(crate) fn len(&self) -> usize {
        self.actions.len()
    }

    pub(crate) fn get(&self, operator: u32) -> RawOperator<'_> {
        let i = operator as usize;
        let range = |ends: &[u32]| (if i == 0 { 0 } else { ends[i - 1] }, ends[i]);
        let numbers = range(&self.number_ends);
        RawOperator {
            action: self.actions[i],
            arguments: self.arguments.row(operator),
            precondition: self.preconditions.row(operator),
            adds: self.adds.row(operator),
            deletes: self.deletes.row(operator),
            conditional: range(&self.conditional_ends),
            cost: self.costs[i],
            numbers: &self.numbers[numbers.0 as usize..numbers.1 as usize],
        }
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = RawOperator<'_>> {
        (0..id32(self.len())).map(|i| self.get(i))
    }

    pub(crate) fn conditional<'r>(
        &'r self,
        of: &RawOperator<'_>,
    ) -> impl ExactSizeIterator<Item = RawConditional<'r>> + Clone {
        let (first, end) = of.conditional;
        (first as usize..end as usize)
            .map(id32)
            .map(|i| (self.conditions.row(i), self.conditional_adds.row(i), self.conditional_deletes.row(i)))
    }

    /// Literals and changes of an operator, those under conditions with them.
    pub(crate) fn size(&self, of: &RawOperator<'_>) -> usize {
        let conditional: usize = self.conditional(of).map(|(c, a, d)| 4 + c.len() + a.len() + d.len()).sum();
        of.precondition.len() + of.adds.len() + of.deletes.len() + conditional
    }

    /// Units of work to look at all of an operator once.
    pub(crate) fn work(&self, of: &RawOperator<'_>) -> usize {
        128 + 8 * self.size(of) + 256 * of.numbers.len()
    }
}

/// The task before pruning.
pub(crate) struct RawTask {
    pub(crate) operators: RawOperators,
    pub(crate) rules: Vec<(u32, Vec<Lit>)>,
    pub(crate) goal: Vec<Lit>,
    /// Whether some part of the goal folded to false.
    pub(crate) refuted: Vec<Formula>,
    /// Two atoms of the goal that never hold together.
    pub(crate) exclusive: Option<(u32, u32)>,
    /// Atoms of the table, then auxiliary ones.
    pub(crate) atoms: u32,
    /// Numeric fluents, and comparisons of them among the auxiliary atoms.
    pub(crate) numbers: Numbers,
    /// What plans are measured by, if that is no sum of costs.
    pub(crate) metric: Option<(Objective, Expression<u32>)>,
}

/// Why there are no instances.
pub(crate) enum Failure {
    Ground(GroundError),
    /// Costs are no sum: an operator improves the metric.
    NegativeCost,
    /// The caller's interruption came first.
    Interrupted,
}

impl From<Interrupted> for Failure {
    fn from(_: Interrupted) -> Self {
        Self::Interrupted
    }
}

impl From<GroundError> for Failure {
    fn from(error: GroundError) -> Self {
        Self::Ground(error)
    }
}

/// Instantiates everything.
#[expect(clippy::too_many_arguments, reason = "a stage takes what the stages before it made")]
pub(crate) fn instantiate(
    schemas: &[Schema],
    reached: &Reached,
    is_static: &[bool],
    exclusions: &Exclusions,
    (costs, fluents): (&CostModel, &Fluents),
    values: &ValuePredicates,
    goal: (&Formula, &[std::sync::Arc<super::universe::Range>]),
    meter: &Meter<'_>,
) -> Result<RawTask, Failure> {
    let mut work = Instantiator::new(&reached.table, is_static, exclusions, fluents, meter);
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
                        // Hoisted variables may leave no trace: one operator of equals is enough.
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

/// Two of the literals that exclude each other.
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

/// All ground effects: condition, whether it adds, atom.
fn expand(
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
            |total: usize, v: &VariableId| total.saturating_mul(schema.slots[v.0 as usize].objects.len());
        if !work.guard.allows(effect.quantified.iter().fold(1, count)) {
            break;
        }
        each_binding(&effect.quantified, schema, binding, &mut |binding| {
            let row = effect.arguments.iter().map(|&t| resolve(t, binding));
            let Some(atom) = work.table.find(effect.predicate, row) else { return };
            work.guard.keep();
            if !effect.quantified.is_empty() && !work.guard.look() {
                return;
            }
            let ground = work.fold(&effect.condition, &schema.slots, binding);
            // The union of conditional effects is a disjunction: no axiom needed at the top.
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

/// Conditions under which an object fluent would get two values at once; none where the guard stops.
fn clashes(work: &Instantiator<'_>, values: &ValuePredicates, effects: &[GroundEffect]) -> Vec<Vec<Lit>> {
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

/// Whether both are values of one fluent, and different.
fn are_rivals(table: &AtomTable, values: &ValuePredicates, a: u32, b: u32) -> bool {
    let is_atom = |x: u32| (x as usize) < table.len();
    let same = is_atom(a) && is_atom(b) && a != b && table.predicate(a) == table.predicate(b);
    same && values.function(table.predicate(a)).is_some()
        && table.row(a).split_last().map(|(_, fluent)| fluent) == table.row(b).split_last().map(|(_, f)| f)
}

pub(super) fn each_binding(
    vs: &[VariableId],
    schema: &Schema,
    binding: &mut [u32],
    f: &mut dyn FnMut(&mut [u32]),
) {
    match vs.split_first() {
        None => f(binding),
        Some((first, rest)) => {
            for &object in &schema.slots[first.0 as usize].objects {
                binding[first.0 as usize] = object;
                each_binding(rest, schema, binding, f);
            }
        }
    }
}

impl RawOperators {
    /// Adds an operator; gives its size.
    fn add(
        &mut self,
        work: &mut Instantiator<'_>,
        action: ActionId,
        arguments: &[u32],
        mut precondition: Vec<Lit>,
        (effects, changes): (&[GroundEffect], &[RawChange]),
        cost: f64,
    ) -> usize {
        let mut always = RawEffects::default();
        let mut by_condition: BTreeMap<Vec<Lit>, RawEffects> = BTreeMap::new();
        // Leaves the groups of the precondition marked.
        work.without_implied(&mut precondition);
        let marks = &work.marks;
        // What the precondition excludes does not hold, and need not be deleted.
        let is_absent = |atom: u32| {
            precondition.binary_search(&(atom << 1)).is_err() && marks.exclude(work.exclusions, atom)
        };
        let contradicts = |condition: &[Lit]| {
            let absent = condition.iter().any(|&l| l & 1 == 0 && is_absent(l >> 1));
            absent || condition.iter().any(|l| precondition.binary_search(&(l ^ 1)).is_ok())
        };
        let given = |l: Lit| precondition.binary_search(&l).is_ok() || (l & 1 == 1 && is_absent(l >> 1));
        for (condition, positive, atom) in effects {
            if (!positive && is_absent(*atom)) || contradicts(condition) {
                continue;
            }
            let open: Vec<Lit> = condition.iter().copied().filter(|&l| !given(l)).collect();
            let into = if open.is_empty() { &mut always } else { by_condition.entry(open).or_default() };
            (if *positive { &mut into.adds } else { &mut into.deletes }).push(*atom);
        }
        for change in changes.iter().filter(|change| !contradicts(&change.condition)) {
            let mut change = change.clone();
            change.condition.retain(|&l| !given(l));
            self.numbers.push(change);
        }
        let always = tidy(always);
        self.actions.push(action);
        self.arguments.push(arguments.iter().copied());
        self.preconditions.push(precondition);
        self.adds.push(always.adds);
        self.deletes.push(always.deletes);
        for (condition, effects) in by_condition {
            let effects = tidy(effects);
            self.conditions.push(condition);
            self.conditional_adds.push(effects.adds);
            self.conditional_deletes.push(effects.deletes);
        }
        self.conditional_ends.push(id32(self.conditions.len()));
        self.costs.push(cost);
        self.number_ends.push(id32(self.numbers.len()));
        self.size(&self.get(id32(self.len() - 1)))
    }
}

/// Sorted, without duplicates; an add wins over a delete of the same atom.
fn tidy(mut effects: RawEffects) -> RawEffects {
    effects.adds.sort_unstable();
    effects.adds.dedup();
    effects.deletes.sort_unstable();
    effects.deletes.dedup();
    effects.deletes.retain(|d| effects.adds.binary_search(d).is_err());
    effects
}

/// The ids of all atoms that hold initially or may be set from outside.
pub(crate) fn marked(atoms: u32, which: impl Iterator<Item = u32>) -> Vec<bool> {
    let mut marks = vec![false; atoms as usize];
    for atom in which {
        marks[atom as usize] = true;
    }
    debug_assert!(id32(marks.len()) == atoms);
    marks
}
