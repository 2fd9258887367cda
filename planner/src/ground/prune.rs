//! From the raw instances to the task: constants folded, the irrelevant dropped.
//!
//! Idea: (1) a relaxed reachability over literals of both signs on the ground level: an atom whose
//! negation is never reached always holds, one that is never reached never does; (2) relevance
//! backwards from the goal: an atom that no relevant condition reads is no fact. Invariant: atoms of
//! exogenous predicates are neither folded nor dropped. Cost: linear in the raw task.
//!
//! Source: Helmert, "The Fast Downward planning system", JAIR 2006, §5.1 (relevance); Helmert 2009.

use super::instantiate::Lit;
use super::raw::{RawEffects, RawTask};
use crate::ids::id32;

/// What is known of each atom.
pub(crate) struct Pruned {
    /// Holds always.
    pub(crate) always: Vec<bool>,
    /// Never holds.
    pub(crate) never: Vec<bool>,
    /// Read by the goal, a condition of a useful operator, or the outside.
    pub(crate) needed: Vec<bool>,
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
    for op in &raw.operators {
        nodes.push([&op.precondition, &[]], &op.effects);
        for (condition, effects) in &op.conditional {
            nodes.push([&op.precondition, condition], effects);
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
    let changed_by = grouped(&changed_by);
    let mut queue: Vec<u32> = Vec::new();
    let need = |l: Lit, pruned: &mut Pruned, queue: &mut Vec<u32>| {
        let atom = (l >> 1) as usize;
        if pruned.constant(l).is_none() && !std::mem::replace(&mut pruned.needed[atom], true) {
            queue.push(l >> 1);
        }
    };
    for &l in &raw.goal {
        need(l, pruned, &mut queue);
    }
    for a in (0..n).filter(|&a| exogenous[a]) {
        need(id32(a) << 1, pruned, &mut queue);
    }
    let mut seen = vec![false; operators + raw.rules.len()];
    while let Some(atom) = queue.pop() {
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
            for (condition, effects) in &op.conditional {
                let touches = effects.adds.contains(&atom) || effects.deletes.contains(&atom);
                if touches && !pruned.is_refuted(condition) {
                    condition.iter().for_each(|&l| need(l, pruned, &mut queue));
                }
            }
        }
    }
}
