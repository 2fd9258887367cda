//! Pruning of the raw task: folds constants and drops irrelevant parts.
//!
//! Idea: (1) a relaxed reachability analysis over ground literals of both signs: an atom whose
//! negation is unreachable always holds, and an unreachable atom never holds; (2) relevance,
//! backwards from the goal: an atom that no relevant condition reads does not become a fact.
//! Invariant: atoms of exogenous predicates are neither folded nor dropped. Cost: linear in the raw
//! task.
//!
//! Source: Helmert, "The Fast Downward planning system", JAIR 2006, §5.1 (relevance); Helmert 2009.
//!
//! In: the raw task and its reached atoms. Out: [`Pruned`].

use super::instantiate::{Comparison, RawChange, RawEffects, RawTask};
use super::literal::Lit;
use super::normalise::Normalised;
use super::relax::Reached;
use crate::ids::id32;
use crate::number::{Expression, Influence, Relation};
use crate::task::Rows;
use budget::{Interrupted, Meter};
use pddl::model::Objective;

/// The results of pruning for atoms, fluents and operators.
pub(crate) struct Pruned {
    /// By atom: it always holds.
    pub(crate) always: Vec<bool>,
    /// By atom: it never holds.
    pub(crate) never: Vec<bool>,
    /// By atom: the goal, a condition of a useful operator, or the caller reads it.
    pub(crate) needed: Vec<bool>,
    /// By numeric fluent: something needed reads it.
    pub(crate) read: Vec<bool>,
    /// By numeric fluent: only the metric reads it.
    pub(crate) measured: Vec<bool>,
    /// By operator: whether it may improve a metric that is not a sum of costs.
    pub(crate) improves: Vec<bool>,
    /// By atom: whether axioms define it.
    pub(crate) derived: Vec<bool>,
    /// By atom: whether it is a comparison of numbers.
    pub(crate) compared: Vec<bool>,
}

impl Pruned {
    /// `Some(true)` if the literal always holds, `Some(false)` if it never does, otherwise `None`.
    pub(crate) fn constant(&self, literal: Lit) -> Option<bool> {
        let atom = (literal >> 1) as usize;
        let positive = literal & 1 == 0;
        if self.always[atom] {
            Some(positive)
        } else if self.never[atom] {
            Some(!positive)
        } else {
            None
        }
    }

    /// Whether the conjunction never holds.
    pub(crate) fn is_refuted(&self, literals: &[Lit]) -> bool {
        literals.iter().any(|&l| self.constant(l) == Some(false))
    }
}

/// The literals that each way of reaching needs and gives. The first ways are the operators, which
/// need their preconditions. Conditional effects, changes of numbers and rules follow.
#[derive(Default)]
struct Ways {
    needs: Rows,
    gives: Rows,
}

impl Ways {
    fn push(
        &mut self,
        conditions: [&[Lit]; 2],
        (adds, deletes): (&[u32], &[u32]),
        meter: &Meter<'_>,
    ) -> Result<(), Interrupted> {
        self.needs.push(conditions.into_iter().flatten().copied());
        self.gives.push(adds.iter().map(|a| a << 1).chain(deletes.iter().map(|a| a << 1 | 1)));
        meter.spend(16 + conditions[0].len() + conditions[1].len() + adds.len() + deletes.len())
    }
}

/// Analyses the raw task.
pub(crate) fn prune(
    model: &Normalised<'_>,
    Reached { table, statics, initial, .. }: &Reached,
    raw: &RawTask,
    meter: &Meter<'_>,
) -> Result<Pruned, Interrupted> {
    let (known, statics) = (id32(table.len()), *statics);
    let value = |&fluent: &u32| model.fluents.initial(&raw.numbers.keys[fluent as usize]);
    let compared = marked(raw.atoms, raw.numbers.atoms.iter().map(|(atom, _)| *atom));
    let compare = |comparison: &Comparison<u32>| {
        comparison.expression.evaluate(&value).is_ok_and(|n| comparison.relation.holds(n.sign()))
    };
    let equal = raw.numbers.atoms.iter().filter(|(_, c)| compare(c)).map(|(atom, _)| *atom);
    let holds = marked(raw.atoms, (0..statics).chain(initial.iter().copied()).chain(equal));
    let is_derived = |a: u32| {
        if a < known { model.domain.predicates[table.predicate(a)].derived } else { !compared[a as usize] }
    };
    let derived = marked(raw.atoms, (statics..raw.atoms).filter(|&a| is_derived(a)));
    let is_exogenous = |a: u32| a < known && model.exogenous.contains(&table.predicate(a));
    // A comparison of a number that an outside event changes may hold, and not hold, in any state.
    let is_sensed = |comparison: &Comparison<u32>| {
        let mut sensed = false;
        comparison.expression.each_fluent(&mut |&fluent| {
            sensed |= model.fluents.is_sensed(raw.numbers.keys[fluent as usize].0);
        });
        sensed
    };
    let sensed = raw.numbers.atoms.iter().filter(|(_, c)| is_sensed(c)).map(|(atom, _)| *atom);
    let exogenous = &marked(raw.atoms, (statics..raw.atoms).filter(|&a| is_exogenous(a)).chain(sensed));
    let reached = reachable(raw, &holds, &derived, exogenous, meter)?;
    let n = raw.atoms as usize;
    let mut pruned = Pruned {
        always: (0..n).map(|a| !derived[a] && !reached[a << 1 | 1]).collect(),
        never: (0..n).map(|a| !reached[a << 1]).collect(),
        needed: vec![false; n],
        read: vec![false; raw.numbers.keys.len()],
        measured: vec![false; raw.numbers.keys.len()],
        improves: vec![false; raw.operators.len()],
        derived,
        compared,
    };
    always_derived(raw, &mut pruned, meter)?;
    let is_kept = |a: u32| a < known && model.kept.contains(&table.predicate(a));
    let kept: Vec<bool> = (0..raw.atoms).map(|a| exogenous[a as usize] || is_kept(a)).collect();
    relevance(raw, &kept, &mut pruned, meter)?;
    Ok(pruned)
}

/// Marks the atoms that rules derive from atoms that always hold.
fn always_derived(raw: &RawTask, pruned: &mut Pruned, meter: &Meter<'_>) -> Result<(), Interrupted> {
    let mut readers = Rows::default();
    let mut missing: Vec<usize> = Vec::with_capacity(raw.rules.len());
    let mut queue: Vec<u32> = Vec::new();
    for (rule, (_, body)) in (0..).zip(&raw.rules) {
        meter.spend(16 + 4 * body.len())?;
        let open = body.iter().filter(|&&l| pruned.constant(l) != Some(true));
        missing.push(open.clone().count());
        // An open negative literal stays open, because only atoms become known to hold.
        readers.push(open.filter(|&&l| l & 1 == 0).map(|l| l >> 1));
        if missing.last() == Some(&0) {
            queue.push(rule);
        }
    }
    let readers = readers.transposed(raw.atoms as usize, meter)?;
    while let Some(rule) = queue.pop() {
        let head = raw.rules[rule as usize].0;
        if pruned.never[head as usize] || std::mem::replace(&mut pruned.always[head as usize], true) {
            continue;
        }
        for &reader in readers.row(head) {
            meter.spend(8)?;
            missing[reader as usize] -= 1;
            if missing[reader as usize] == 0 {
                queue.push(reader);
            }
        }
    }
    Ok(())
}

fn reachable(
    raw: &RawTask,
    initial: &[bool],
    derived: &[bool],
    exogenous: &[bool],
    meter: &Meter<'_>,
) -> Result<Vec<bool>, Interrupted> {
    let mut more = Ways::default();
    let readers = readers(raw);
    for op in raw.operators.iter() {
        meter.spend(8)?;
        for (condition, adds, deletes) in raw.operators.conditional(&op) {
            more.push([op.precondition, condition], (adds, deletes), meter)?;
        }
        for change in op.numbers {
            let influenced = influenced(raw, &readers, change, meter)?;
            more.push([op.precondition, &change.condition], (&influenced.adds, &influenced.deletes), meter)?;
        }
    }
    for (head, body) in &raw.rules {
        more.push([body, &[]], (&[*head], &[]), meter)?;
    }
    let n = raw.atoms as usize;
    let operators = id32(raw.operators.len());
    let needed_by = raw.operators.preconditions.transposed(2 * n, meter)?;
    let more_needed_by = more.needs.transposed(2 * n, meter)?;
    let mut reached = vec![false; 2 * n];
    let mut queue: Vec<Lit> = Vec::new();
    let mut reach = |l: Lit, queue: &mut Vec<Lit>| {
        if !std::mem::replace(&mut reached[l as usize], true) {
            queue.push(l);
        }
    };
    for a in 0..n {
        meter.spend(4)?;
        let lit = id32(a) << 1;
        if initial[a] || exogenous[a] {
            reach(lit, &mut queue);
        }
        if !initial[a] || exogenous[a] || derived[a] {
            reach(lit | 1, &mut queue);
        }
    }
    let mut missing: Vec<u32> = Vec::with_capacity(raw.operators.len() + more.needs.len());
    let mut ready: Vec<u32> = Vec::new();
    for (rows, before) in [(&raw.operators.preconditions, 0), (&more.needs, operators)] {
        for way in 0..id32(rows.len()) {
            meter.spend(4)?;
            missing.push(id32(rows.row(way).len()));
            if missing.last() == Some(&0) {
                ready.push(before + way);
            }
        }
    }
    loop {
        while let Some(way) = ready.pop() {
            meter.spend(16)?;
            if way < operators {
                let op = raw.operators.get(way);
                op.adds.iter().for_each(|&a| reach(a << 1, &mut queue));
                op.deletes.iter().for_each(|&a| reach(a << 1 | 1, &mut queue));
            } else {
                more.gives.row(way - operators).iter().for_each(|&l| reach(l, &mut queue));
            }
        }
        let Some(l) = queue.pop() else { break };
        for (rows, before) in [(&needed_by, 0), (&more_needed_by, operators)] {
            for part in meter.chunks(rows.row(l), 8) {
                for &way in part? {
                    let missing = &mut missing[(before + way) as usize];
                    *missing -= 1;
                    if *missing == 0 {
                        ready.push(before + way);
                    }
                }
            }
        }
    }
    Ok(reached)
}

/// By numeric fluent: positions of the comparisons that read it.
fn readers(raw: &RawTask) -> Vec<Vec<u32>> {
    let mut readers = vec![Vec::new(); raw.numbers.keys.len()];
    for (position, (_, comparison)) in (0..).zip(&raw.numbers.atoms) {
        comparison.expression.each_fluent(&mut |&fluent| readers[fluent as usize].push(position));
    }
    readers
}

/// The comparisons that a change may make true, and those that it may make false.
fn influenced(
    raw: &RawTask,
    readers: &[Vec<u32>],
    change: &RawChange,
    meter: &Meter<'_>,
) -> Result<RawEffects, Interrupted> {
    let mut effects = RawEffects::default();
    for &position in &readers[change.fluent as usize] {
        meter.spend(64)?;
        let (atom, comparison) = &raw.numbers.atoms[position as usize];
        let compared = (comparison.relation, &comparison.expression);
        let influence = Influence::of(compared, &change.fluent, change.change, change.value.as_ref());
        if influence.may_hold {
            effects.adds.push(*atom);
        }
        if influence.may_fail {
            effects.deletes.push(*atom);
        }
    }
    Ok(effects)
}

/// Marks the fluents that the metric reads, directly or through effects, and the operators that may
/// improve it. Returns the changes of these fluents.
fn measured<'r>(
    raw: &'r RawTask,
    changed_by: &Rows,
    pruned: &mut Pruned,
    meter: &Meter<'_>,
) -> Result<Vec<&'r RawChange>, Interrupted> {
    let mut queue = Vec::new();
    let mark = |expression: &Expression<u32>, pruned: &mut Pruned, queue: &mut Vec<u32>| {
        expression.each_fluent(&mut |&fluent| {
            if !std::mem::replace(&mut pruned.measured[fluent as usize], true) {
                queue.push(fluent);
            }
        });
    };
    let mut changes = Vec::new();
    let Some((objective, metric)) = &raw.metric else { return Ok(changes) };
    mark(metric, pruned, &mut queue);
    while let Some(fluent) = queue.pop() {
        for &i in changed_by.row(raw.atoms + fluent) {
            meter.spend(64)?;
            for change in raw.operators.get(i).numbers.iter().filter(|c| c.fluent == fluent) {
                change.value.iter().for_each(|value| mark(value, pruned, &mut queue));
                changes.push(change);
                pruned.improves[i as usize] |= may_improve(*objective, metric, change);
            }
        }
    }
    Ok(changes)
}

/// Whether a change of a fluent that the metric reads, directly or through effects, may improve it.
/// If a sum changes by a constant, the sign decides.
fn may_improve(objective: Objective, metric: &Expression<u32>, change: &RawChange) -> bool {
    let above = (Relation::Positive, metric);
    let influence = Influence::of(above, &change.fluent, change.change, change.value.as_ref());
    match (influence.step, objective) {
        (Some(step), Objective::Maximize) => step.sign() > 0,
        (Some(step), Objective::Minimize) => step.sign() < 0,
        (None, _) => true,
    }
}

/// By atom, and after the atoms by numeric fluent: the operators that change it and the rules that
/// derive it. Rules are numbered after operators.
fn changed_by(raw: &RawTask, meter: &Meter<'_>) -> Result<Rows, Interrupted> {
    let mut changes = Rows::default();
    for op in raw.operators.iter() {
        meter.spend(16 + 8 * raw.operators.size(&op) + 8 * op.numbers.len())?;
        let own = op.adds.iter().chain(op.deletes);
        let conditional = raw.operators.conditional(&op);
        if conditional.len() == 0 && op.numbers.is_empty() {
            changes.push(own.copied());
        } else {
            let atoms = own.chain(conditional.flat_map(|(_, adds, deletes)| adds.iter().chain(deletes)));
            let fluents = op.numbers.iter().map(|change| raw.atoms + change.fluent);
            changes.push_sorted(atoms.copied().chain(fluents));
        }
    }
    raw.rules.iter().for_each(|(head, _)| changes.push([*head]));
    changes.transposed(raw.atoms as usize + raw.numbers.keys.len(), meter)
}

fn relevance(
    raw: &RawTask,
    kept: &[bool],
    pruned: &mut Pruned,
    meter: &Meter<'_>,
) -> Result<(), Interrupted> {
    let n = raw.atoms as usize;
    let operators = raw.operators.len();
    let changed_by = changed_by(raw, meter)?;
    let mut compared: Vec<Option<&Comparison<u32>>> = vec![None; n];
    raw.numbers.atoms.iter().for_each(|(atom, comparison)| compared[*atom as usize] = Some(comparison));
    let mut queue: Vec<u32> = Vec::new();
    let need = |l: Lit, pruned: &mut Pruned, queue: &mut Vec<u32>| {
        let atom = (l >> 1) as usize;
        if pruned.constant(l).is_none() && !std::mem::replace(&mut pruned.needed[atom], true) {
            queue.push(l >> 1);
        }
    };
    let read = |expression: &Expression<u32>, pruned: &mut Pruned, queue: &mut Vec<u32>| {
        expression.each_fluent(&mut |&fluent| {
            if !std::mem::replace(&mut pruned.read[fluent as usize], true) {
                queue.push(raw.atoms + fluent);
            }
        });
    };
    for &l in &raw.goal {
        need(l, pruned, &mut queue);
    }
    for change in measured(raw, &changed_by, pruned, meter)? {
        meter.spend(8 + change.condition.len())?;
        change.condition.iter().for_each(|&l| need(l, pruned, &mut queue));
    }
    for a in (0..n).filter(|&a| kept[a]) {
        meter.spend(8)?;
        need(id32(a) << 1, pruned, &mut queue);
    }
    let mut seen = pruned.improves.clone();
    for (op, improves) in raw.operators.iter().zip(&seen) {
        meter.spend(8 + op.precondition.len())?;
        if *improves && !pruned.is_refuted(op.precondition) {
            op.precondition.iter().for_each(|&l| need(l, pruned, &mut queue));
        }
    }
    seen.resize(operators + raw.rules.len(), false);
    while let Some(atom) = queue.pop() {
        if let Some(comparison) = compared.get(atom as usize).copied().flatten() {
            read(&comparison.expression, pruned, &mut queue);
        }
        for &i in changed_by.row(atom) {
            if i as usize >= operators {
                let (_, body) = &raw.rules[i as usize - operators];
                meter.spend(8 + 4 * body.len())?;
                if !pruned.is_refuted(body) {
                    body.iter().for_each(|&l| need(l, pruned, &mut queue));
                }
                continue;
            }
            let op = raw.operators.get(i);
            meter.spend(16 + 4 * op.precondition.len())?;
            if pruned.is_refuted(op.precondition) {
                continue;
            }
            if !std::mem::replace(&mut seen[i as usize], true) {
                op.precondition.iter().for_each(|&l| need(l, pruned, &mut queue));
            }
            for change in op.numbers.iter().filter(|c| raw.atoms + c.fluent == atom) {
                meter.spend(16 + 4 * change.condition.len())?;
                if !pruned.is_refuted(&change.condition) {
                    change.condition.iter().for_each(|&l| need(l, pruned, &mut queue));
                    change.value.iter().for_each(|value| read(value, pruned, &mut queue));
                }
            }
            for (condition, adds, deletes) in raw.operators.conditional(&op) {
                meter.spend(8 + 4 * condition.len() + adds.len() + deletes.len())?;
                let touches = adds.contains(&atom) || deletes.contains(&atom);
                if touches && !pruned.is_refuted(condition) {
                    condition.iter().for_each(|&l| need(l, pruned, &mut queue));
                }
            }
        }
    }
    Ok(())
}

/// By atom: whether it is among these.
fn marked(atoms: u32, which: impl Iterator<Item = u32>) -> Vec<bool> {
    let mut marks = vec![false; atoms as usize];
    for atom in which {
        marks[atom as usize] = true;
    }
    debug_assert!(id32(marks.len()) == atoms);
    marks
}
