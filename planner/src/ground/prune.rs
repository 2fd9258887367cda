//! From the raw instances to the task: constants folded, the irrelevant dropped.
//!
//! Idea: (1) a relaxed reachability over literals of both signs on the ground level: an atom whose
//! negation is never reached always holds, one that is never reached never does; (2) relevance
//! backwards from the goal: an atom that no relevant condition reads is no fact. Invariant: atoms of
//! exogenous predicates are neither folded nor dropped. Cost: linear in the raw task.
//!
//! Source: Helmert, "The Fast Downward planning system", JAIR 2006, §5.1 (relevance); Helmert 2009.

use super::instantiate::Lit;
use super::numbers::{Comparison, RawChange};
use super::raw::{RawEffects, RawTask};
use crate::ids::id32;
use crate::number::{Expression, Influence};

/// What is known of each atom.
pub(crate) struct Pruned {
    /// Holds always.
    pub(crate) always: Vec<bool>,
    /// Never holds.
    pub(crate) never: Vec<bool>,
    /// Read by the goal, a condition of a useful operator, or the outside.
    pub(crate) needed: Vec<bool>,
    /// Numeric fluents that something needed reads.
    pub(crate) read: Vec<bool>,
    /// Numeric fluents that only the metric reads.
    pub(crate) measured: Vec<bool>,
}

impl Pruned {
    /// Whether the literal is true (`Some(true)`), false or open.
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

/// A way to reach literals.
struct Nodes {
    missing: Vec<u32>,
    effects: Vec<Lit>,
    effect_ends: Vec<u32>,
    pairs: Vec<(Lit, u32)>,
}

impl Nodes {
    fn push(&mut self, conditions: [&[Lit]; 2], effects: &RawEffects) {
        let node = id32(self.missing.len());
        let before = self.pairs.len();
        self.pairs.extend(conditions.into_iter().flatten().map(|&l| (l, node)));
        self.missing.push(id32(self.pairs.len() - before));
        self.effects.extend(effects.adds.iter().map(|a| a << 1));
        self.effects.extend(effects.deletes.iter().map(|a| a << 1 | 1));
        self.effect_ends.push(id32(self.effects.len()));
    }
}

/// Analyses the raw task. `initial`, `derived`, `exogenous` mark atoms.
pub(crate) fn prune(raw: &RawTask, initial: &[bool], derived: &[bool], exogenous: &[bool]) -> Pruned {
    let reached = reachable(raw, initial, derived, exogenous);
    let n = raw.atoms as usize;
    let mut pruned = Pruned {
        always: (0..n).map(|a| !derived[a] && !reached[a << 1 | 1]).collect(),
        never: (0..n).map(|a| !reached[a << 1]).collect(),
        needed: vec![false; n],
        read: vec![false; raw.numbers.keys.len()],
        measured: vec![false; raw.numbers.keys.len()],
    };
    loop {
        let mut changed = false;
        for (head, body) in &raw.rules {
            let holds = body.iter().all(|&l| pruned.constant(l) == Some(true));
            if holds && !pruned.always[*head as usize] && !pruned.never[*head as usize] {
                pruned.always[*head as usize] = true;
                changed = true;
            }
        }
        if !changed {
            break;
        }
    }
    relevance(raw, exogenous, &mut pruned);
    pruned
}

fn reachable(raw: &RawTask, initial: &[bool], derived: &[bool], exogenous: &[bool]) -> Vec<bool> {
    let mut nodes =
        Nodes { missing: Vec::new(), effects: Vec::new(), effect_ends: vec![0], pairs: Vec::new() };
    let readers = readers(raw);
    for op in &raw.operators {
        nodes.push([&op.precondition, &[]], &op.effects);
        for (condition, effects) in &op.conditional {
            nodes.push([&op.precondition, condition], effects);
        }
        for change in &op.numbers {
            nodes.push([&op.precondition, &change.condition], &influenced(raw, &readers, change));
        }
    }
    for (head, body) in &raw.rules {
        nodes.push([body, &[]], &RawEffects { adds: vec![*head], deletes: Vec::new() });
    }
    let n = raw.atoms as usize;
    let mut starts = vec![0_u32; 2 * n + 1];
    for &(l, _) in &nodes.pairs {
        starts[l as usize + 1] += 1;
    }
    for i in 0..2 * n {
        starts[i + 1] += starts[i];
    }
    let mut fill = starts.clone();
    let mut needed_by = vec![0_u32; nodes.pairs.len()];
    for &(l, node) in &nodes.pairs {
        needed_by[fill[l as usize] as usize] = node;
        fill[l as usize] += 1;
    }
    let mut reached = vec![false; 2 * n];
    let mut queue: Vec<Lit> = Vec::new();
    let mut reach = |l: Lit, queue: &mut Vec<Lit>| {
        if !std::mem::replace(&mut reached[l as usize], true) {
            queue.push(l);
        }
    };
    for a in 0..n {
        let lit = id32(a) << 1;
        if initial[a] || exogenous[a] {
            reach(lit, &mut queue);
        }
        if !initial[a] || exogenous[a] || derived[a] {
            reach(lit | 1, &mut queue);
        }
    }
    let mut missing = nodes.missing;
    let effects_of =
        |node: usize| &nodes.effects[nodes.effect_ends[node] as usize..nodes.effect_ends[node + 1] as usize];
    for (node, _) in missing.iter().enumerate().filter(|&(_, &m)| m == 0) {
        effects_of(node).iter().for_each(|&l| reach(l, &mut queue));
    }
    while let Some(l) = queue.pop() {
        for &node in &needed_by[starts[l as usize] as usize..starts[l as usize + 1] as usize] {
            missing[node as usize] -= 1;
            if missing[node as usize] == 0 {
                effects_of(node as usize).iter().for_each(|&l| reach(l, &mut queue));
            }
        }
    }
    reached
}

/// The pairs in order of their first halves, otherwise as they were, without neighbours that are equal.
fn grouped(pairs: &[(u32, u32)]) -> Vec<(u32, u32)> {
    let most = pairs.iter().map(|p| p.0 as usize).max().unwrap_or(0);
    let mut at = vec![0_u32; most + 2];
    pairs.iter().for_each(|p| at[p.0 as usize + 1] += 1);
    for i in 0..=most {
        at[i + 1] += at[i];
    }
    let mut sorted = vec![(0, 0); pairs.len()];
    for &pair in pairs {
        sorted[at[pair.0 as usize] as usize] = pair;
        at[pair.0 as usize] += 1;
    }
    sorted.dedup();
    sorted
}

/// By numeric fluent: positions of the comparisons that read it.
fn readers(raw: &RawTask) -> Vec<Vec<u32>> {
    let mut readers = vec![Vec::new(); raw.numbers.keys.len()];
    for (position, (_, comparison)) in (0..).zip(&raw.numbers.atoms) {
        comparison.expression.each_fluent(&mut |&fluent| readers[fluent as usize].push(position));
    }
    readers
}

/// The comparisons that a change may make true and false.
fn influenced(raw: &RawTask, readers: &[Vec<u32>], change: &RawChange) -> RawEffects {
    let mut effects = RawEffects::default();
    for &position in &readers[change.fluent as usize] {
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
    effects
}

/// Marks what the metric reads, directly or through effects; gives the changes of that.
fn measured<'r>(raw: &'r RawTask, changed_by: &[(u32, u32)], pruned: &mut Pruned) -> Vec<&'r RawChange> {
    let mut queue = Vec::new();
    let mark = |expression: &Expression<u32>, pruned: &mut Pruned, queue: &mut Vec<u32>| {
        expression.each_fluent(&mut |&fluent| {
            if !std::mem::replace(&mut pruned.measured[fluent as usize], true) {
                queue.push(fluent);
            }
        });
    };
    let mut changes = Vec::new();
    raw.metric.iter().for_each(|metric| mark(metric, pruned, &mut queue));
    while let Some(fluent) = queue.pop() {
        let of = raw.atoms + fluent;
        let from = changed_by.partition_point(|&(a, _)| a < of);
        for &(_, i) in changed_by[from..].iter().take_while(|&&(a, _)| a == of) {
            for change in raw.operators[i as usize].numbers.iter().filter(|c| c.fluent == fluent) {
                change.value.iter().for_each(|value| mark(value, pruned, &mut queue));
                changes.push(change);
            }
        }
    }
    changes
}

fn relevance(raw: &RawTask, exogenous: &[bool], pruned: &mut Pruned) {
    // By atom: the operators that change it and the rules that derive it (numbered after them).
    let n = raw.atoms as usize;
    let operators = raw.operators.len();
    let mut changed_by: Vec<(u32, u32)> = Vec::new();
    for (i, op) in raw.operators.iter().enumerate() {
        for effects in std::iter::once(&op.effects).chain(op.conditional.iter().map(|(_, e)| e)) {
            changed_by.extend(effects.adds.iter().chain(&effects.deletes).map(|&a| (a, id32(i))));
        }
    }
    changed_by.extend(raw.rules.iter().enumerate().map(|(i, (head, _))| (*head, id32(operators + i))));
    // Numeric fluents come after the atoms.
    for (i, op) in raw.operators.iter().enumerate() {
        changed_by.extend(op.numbers.iter().map(|change| (raw.atoms + change.fluent, id32(i))));
    }
    let changed_by = grouped(&changed_by);
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
    for change in measured(raw, &changed_by, pruned) {
        change.condition.iter().for_each(|&l| need(l, pruned, &mut queue));
    }
    for a in (0..n).filter(|&a| exogenous[a]) {
        need(id32(a) << 1, pruned, &mut queue);
    }
    let mut seen = vec![false; operators + raw.rules.len()];
    while let Some(atom) = queue.pop() {
        if let Some(comparison) = compared.get(atom as usize).copied().flatten() {
            read(&comparison.expression, pruned, &mut queue);
        }
        let from = changed_by.partition_point(|&(a, _)| a < atom);
        for &(_, i) in changed_by[from..].iter().take_while(|&&(a, _)| a == atom) {
            let i = i as usize;
            let Some(op) = raw.operators.get(i) else {
                let (_, body) = &raw.rules[i - operators];
                if !pruned.is_refuted(body) {
                    body.iter().for_each(|&l| need(l, pruned, &mut queue));
                }
                continue;
            };
            if pruned.is_refuted(&op.precondition) {
                continue;
            }
            if !std::mem::replace(&mut seen[i], true) {
                op.precondition.iter().for_each(|&l| need(l, pruned, &mut queue));
            }
            for change in op.numbers.iter().filter(|c| raw.atoms + c.fluent == atom) {
                if !pruned.is_refuted(&change.condition) {
                    change.condition.iter().for_each(|&l| need(l, pruned, &mut queue));
                    change.value.iter().for_each(|value| read(value, pruned, &mut queue));
                }
            }
            for (condition, effects) in &op.conditional {
                let touches = effects.adds.contains(&atom) || effects.deletes.contains(&atom);
                if touches && !pruned.is_refuted(condition) {
                    condition.iter().for_each(|&l| need(l, pruned, &mut queue));
                }
            }
        }
    }
}
