//! Look-ahead: bounds on what each symbol can and must yield.
//!
//! All bounds are fixed points over the rules. All but [`Outlook::vanish`] ignore moments and are optimistic.
//! [`Outlook::vanish`] is exact: the earliest moment at which a symbol can end that yields no step and begins at a
//! given moment. An earlier beginning never ends later, so the earliest end suffices.
//!
//! Source: Knuth, "A generalization of Dijkstra's algorithm", IPL 1977 (least ends and lengths over a grammar).

use super::grammar::{Grammar, Rule, RuleId, Slot, Symbol, SymbolId};
use budget::{Interrupted, Meter};
use pddl::model::{Idx, IndexVec};
use std::collections::VecDeque;

/// The end of a symbol that yields no step, and the rule for it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vanishing {
    pub(super) end: Slot,
    pub(super) by: Option<RuleId>,
}

/// A set of actions for each symbol.
#[derive(Clone, Debug)]
pub(super) struct Sets {
    words: usize,
    bits: Vec<u64>,
}

impl Sets {
    fn new(sets: usize, actions: usize, full: bool) -> Self {
        let words = actions.div_ceil(64);
        Self { words, bits: vec![if full { u64::MAX } else { 0 }; words * sets] }
    }

    pub(super) fn get(&self, symbol: SymbolId) -> &[u64] {
        &self.bits[symbol.index() * self.words..][..self.words]
    }

    fn get_mut(&mut self, symbol: SymbolId) -> &mut [u64] {
        &mut self.bits[symbol.index() * self.words..][..self.words]
    }

    pub(super) fn has(&self, symbol: SymbolId, action: u32) -> bool {
        self.get(symbol)[action as usize / 64] >> (action % 64) & 1 == 1
    }

    fn insert(&mut self, symbol: SymbolId, action: u32) {
        self.get_mut(symbol)[action as usize / 64] |= 1 << (action % 64);
    }
}

#[derive(Debug)]
pub(super) struct Outlook {
    /// The fewest steps; `u32::MAX` for a symbol that cannot end.
    pub(super) least: IndexVec<SymbolId, u32>,
    /// The actions that can come first.
    pub(super) first: Sets,
    /// The actions that can occur.
    pub(super) may: Sets,
    /// The actions that must occur.
    pub(super) must: Sets,
    /// Whether its expansions can contain a guard.
    pub(super) guarded: IndexVec<SymbolId, bool>,
    /// By moment; empty for a symbol that always yields a step.
    vanishing: IndexVec<SymbolId, Vec<Vanishing>>,
    /// Whether a rule can be used at all.
    pub(super) alive: IndexVec<RuleId, bool>,
}

impl Outlook {
    pub(super) fn new(grammar: &Grammar, meter: &Meter<'_>) -> Result<Self, Interrupted> {
        let symbols = grammar.symbols.len();
        meter.spend(3 * symbols * (1 + grammar.actions / 64))?;
        let mut outlook = Self {
            least: grammar.symbols.iter().map(|_| u32::MAX).collect(),
            first: Sets::new(symbols, grammar.actions, false),
            may: Sets::new(symbols, grammar.actions, false),
            must: Sets::new(symbols, grammar.actions, true),
            guarded: grammar.symbols.iter().map(|_| false).collect(),
            vanishing: grammar.symbols.iter().map(|_| Vec::new()).collect(),
            alive: grammar.rules.iter().map(|_| false).collect(),
        };
        for (id, symbol) in grammar.symbols.enumerate() {
            match symbol {
                Symbol::Action(action) => {
                    outlook.least[id] = 1;
                    outlook.must.get_mut(id).fill(0);
                    for sets in [&mut outlook.first, &mut outlook.may, &mut outlook.must] {
                        sets.insert(id, *action);
                    }
                }
                Symbol::Guard(holds) => {
                    outlook.guarded[id] = true;
                    outlook.must.get_mut(id).fill(0);
                    if holds.iter().any(|&holds| holds) {
                        outlook.least[id] = 0;
                        outlook.vanishing[id] = next_moments(holds);
                    }
                }
                Symbol::Root | Symbol::Task { .. } => {}
            }
        }
        let users = users(grammar);
        outlook.fixed_point(grammar, &users, meter, Self::shorten)?;
        for (id, rule) in grammar.rules.enumerate() {
            outlook.alive[id] = rule.nodes.iter().all(|&node| outlook.least[node] < u32::MAX);
        }
        outlook.fixed_point(grammar, &users, meter, Self::vanish_earlier)?;
        outlook.fixed_point(grammar, &users, meter, Self::widen)?;
        outlook.fixed_point(grammar, &users, meter, |outlook, grammar, id, _| {
            Ok(outlook.demand_less(grammar, grammar.rules[id].head))
        })?;
        Ok(outlook)
    }

    /// The earliest end of a symbol that yields no step and begins at `start` or later.
    pub(super) fn vanish(&self, symbol: SymbolId, start: Slot) -> Option<Vanishing> {
        self.vanishing[symbol].get(start as usize).copied().filter(|vanishing| vanishing.end < Slot::MAX)
    }

    /// Applies `improve` to each rule until no head changes any more.
    fn fixed_point(
        &mut self,
        grammar: &Grammar,
        users: &IndexVec<SymbolId, Vec<RuleId>>,
        meter: &Meter<'_>,
        mut improve: impl FnMut(&mut Self, &Grammar, RuleId, &Meter<'_>) -> Result<bool, Interrupted>,
    ) -> Result<(), Interrupted> {
        let mut queue: VecDeque<RuleId> = grammar.rules.ids().collect();
        let mut queued: IndexVec<RuleId, bool> = grammar.rules.iter().map(|_| true).collect();
        while let Some(id) = queue.pop_front() {
            queued[id] = false;
            let rule = &grammar.rules[id];
            meter.spend((1 + rule.nodes.len()) * (1 + grammar.actions / 64))?;
            if improve(self, grammar, id, meter)? {
                for &user in &users[rule.head] {
                    if !std::mem::replace(&mut queued[user], true) {
                        queue.push_back(user);
                    }
                }
            }
        }
        Ok(())
    }

    fn shorten(&mut self, grammar: &Grammar, id: RuleId, _: &Meter<'_>) -> Result<bool, Interrupted> {
        let rule = &grammar.rules[id];
        let sum = rule.nodes.iter().fold(0u32, |sum, &node| sum.saturating_add(self.least[node]));
        let shorter = sum < self.least[rule.head];
        if shorter {
            self.least[rule.head] = sum;
        }
        Ok(shorter)
    }

    fn vanish_earlier(
        &mut self,
        grammar: &Grammar,
        id: RuleId,
        meter: &Meter<'_>,
    ) -> Result<bool, Interrupted> {
        let rule = &grammar.rules[id];
        if rule.nodes.iter().any(|&node| self.vanishing[node].is_empty()) {
            return Ok(false);
        }
        let moments = grammar.steps.len() + 1;
        meter.spend(moments * (1 + rule.nodes.len()))?;
        let mut changed = false;
        let mut ends = Vec::with_capacity(rule.nodes.len());
        for start in 0..=grammar.end() {
            let Some(end) = self.end_of(rule, start, &mut ends) else { break };
            let own = &mut self.vanishing[rule.head];
            if own.is_empty() {
                own.resize(moments, Vanishing { end: Slot::MAX, by: None });
            }
            let known = &mut own[start as usize];
            if end < known.end {
                *known = Vanishing { end, by: Some(id) };
                changed = true;
            }
        }
        Ok(changed)
    }

    /// The end of a rule whose nodes all yield no step. Writes the end of each node to `ends`.
    fn end_of(&self, rule: &Rule, start: Slot, ends: &mut Vec<Slot>) -> Option<Slot> {
        ends.clear();
        let mut last = start;
        for (node, before) in rule.nodes.iter().zip(&rule.before) {
            let begin = before.iter().map(|&b| ends[b as usize]).max().unwrap_or(start);
            let end = self.vanish(*node, begin)?.end;
            ends.push(end);
            last = last.max(end);
        }
        Some(last)
    }

    /// The start of each node of a rule that yields no step.
    pub(super) fn starts(&self, rule: &Rule, start: Slot) -> Vec<Slot> {
        let mut ends = Vec::with_capacity(rule.nodes.len());
        let _ = self.end_of(rule, start, &mut ends);
        let begin = |before: &Vec<u32>| before.iter().filter_map(|&b| ends.get(b as usize)).copied().max();
        rule.before.iter().map(|before| begin(before).unwrap_or(start)).collect()
    }

    fn widen(&mut self, grammar: &Grammar, id: RuleId, _: &Meter<'_>) -> Result<bool, Interrupted> {
        let rule = &grammar.rules[id];
        if !self.alive[id] {
            return Ok(false);
        }
        let mut passable = vec![true; rule.nodes.len()];
        let mut changed = false;
        for (place, (&node, before)) in rule.nodes.iter().zip(&rule.before).enumerate() {
            let reached = before.iter().all(|&b| passable[b as usize]);
            passable[place] = reached && !self.vanishing[node].is_empty();
            changed |= unite(&mut self.may, rule.head, node);
            if reached {
                changed |= unite(&mut self.first, rule.head, node);
            }
            changed |= self.guarded[node] && !std::mem::replace(&mut self.guarded[rule.head], true);
        }
        Ok(changed)
    }

    /// Keeps only the actions that every rule for the head must yield.
    fn demand_less(&mut self, grammar: &Grammar, head: SymbolId) -> bool {
        let mut common = vec![u64::MAX; self.must.words];
        for &way in grammar.ways[head].iter().filter(|way| self.alive[**way]) {
            let mut all = vec![0; self.must.words];
            for &node in &grammar.rules[way].nodes {
                all.iter_mut().zip(self.must.get(node)).for_each(|(all, one)| *all |= one);
            }
            common.iter_mut().zip(all).for_each(|(common, all)| *common &= all);
        }
        let own = self.must.get_mut(head);
        let mut changed = false;
        for (own, common) in own.iter_mut().zip(common) {
            changed |= *own & common != *own;
            *own &= common;
        }
        changed
    }
}

fn unite(sets: &mut Sets, into: SymbolId, from: SymbolId) -> bool {
    let mut changed = false;
    for word in 0..sets.words {
        let more = sets.get(from)[word];
        let own = &mut sets.get_mut(into)[word];
        changed |= more & !*own != 0;
        *own |= more;
    }
    changed
}

/// By symbol: the rules that contain it.
fn users(grammar: &Grammar) -> IndexVec<SymbolId, Vec<RuleId>> {
    let mut users: IndexVec<SymbolId, Vec<RuleId>> = grammar.symbols.iter().map(|_| Vec::new()).collect();
    for (id, rule) in grammar.rules.enumerate() {
        for &node in &rule.nodes {
            if users[node].last() != Some(&id) {
                users[node].push(id);
            }
        }
    }
    users
}

/// By moment: the first moment from then on at which a guard holds.
fn next_moments(holds: &[bool]) -> Vec<Vanishing> {
    let mut next = Slot::MAX;
    let mut moments: Vec<Vanishing> = (0..holds.len())
        .rev()
        .map(|slot| {
            if holds[slot] {
                next = Slot::try_from(slot).unwrap_or(Slot::MAX);
            }
            Vanishing { end: next, by: None }
        })
        .collect();
    moments.reverse();
    moments
}
