//! Axioms, evaluated per state to a fixpoint.
//!
//! Problem: derived facts are functions of the basic ones and must be right in every state. Idea:
//! facts that depend on each other form components; in topological order each is decided in one
//! pass, or, where it is recursive, by iterating its own rules. Invariant: no negative dependency
//! inside a component (that is stratification; grounding refuses anything else). Cost: linear in the
//! rules, times the passes in recursive components.
//!
//! Source: Thiébaux, Hoffmann & Nebel, "In defense of PDDL axioms", AIJ 2005, §2.

use super::{Fact, Literals, contains, set};
use crate::ids::FactId;
use pddl::model::{Idx, IndexVec};

/// `head` holds where `body` does.
#[derive(Clone, Debug)]
pub struct AxiomRule {
    /// The derived fact.
    pub head: FactId,
    /// When it holds.
    pub body: Literals,
}

#[derive(Clone, Debug)]
struct Component {
    rules: std::ops::Range<usize>,
    recursive: bool,
}

/// All rules in the order of evaluation.
#[derive(Clone, Debug, Default)]
pub(crate) struct AxiomProgram {
    rules: Vec<AxiomRule>,
    components: Vec<Component>,
    /// A set bit for each derived fact.
    derived: Vec<u64>,
}

/// A derived fact that depends on its own negation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NotStratified(pub(crate) FactId);

impl AxiomProgram {
    pub(crate) fn new(facts: &IndexVec<FactId, Fact>, rules: Vec<AxiomRule>) -> Result<Self, NotStratified> {
        let mut derived = vec![0; facts.len().div_ceil(64)];
        for (id, _) in facts.enumerate().filter(|(_, f)| f.derived) {
            set(&mut derived, id);
        }
        let order = components(facts, &rules);
        let mut component_of = vec![usize::MAX; facts.len()];
        for (i, members) in order.iter().enumerate() {
            for m in members {
                component_of[m.index()] = i;
            }
        }
        let mut sorted = rules;
        sorted.sort_by_key(|r| component_of[r.head.index()]);
        let mut built = Vec::new();
        let mut start = 0;
        while start < sorted.len() {
            let component = component_of[sorted[start].head.index()];
            let end = start + sorted[start..].partition_point(|r| component_of[r.head.index()] == component);
            let own = |f: &FactId| component_of[f.index()] == component;
            for rule in &sorted[start..end] {
                if let Some(&f) = rule.body.negative.iter().find(|f| own(f)) {
                    return Err(NotStratified(f));
                }
            }
            let recursive = sorted[start..end].iter().any(|r| r.body.positive.iter().any(own));
            built.push(Component { rules: start..end, recursive });
            start = end;
        }
        Ok(Self { rules: sorted, components: built, derived })
    }

    pub(crate) fn rules(&self) -> &[AxiomRule] {
        &self.rules
    }

    /// Recomputes every derived fact.
    pub(crate) fn close(&self, words: &mut [u64]) {
        if self.components.is_empty() {
            return;
        }
        for (word, derived) in words.iter_mut().zip(&self.derived) {
            *word &= !derived;
        }
        for component in &self.components {
            let rules = &self.rules[component.rules.clone()];
            loop {
                let mut changed = false;
                for rule in rules {
                    if !contains(words, rule.head) && rule.body.hold_in(words) {
                        set(words, rule.head);
                        changed = true;
                    }
                }
                if !(changed && component.recursive) {
                    break;
                }
            }
        }
    }
}

/// Strongly connected components of the derived facts, dependencies first (Tarjan, iterative).
fn components(facts: &IndexVec<FactId, Fact>, rules: &[AxiomRule]) -> Vec<Vec<FactId>> {
    let n = facts.len();
    let mut below: Vec<Vec<u32>> = vec![Vec::new(); n];
    for rule in rules {
        let body = rule.body.positive.iter().chain(rule.body.negative.iter());
        below[rule.head.index()].extend(body.filter(|&&f| facts[f].derived).map(|f| f.0));
    }
    let (mut index, mut low, mut on_stack) = (vec![0_u32; n], vec![0_u32; n], vec![false; n]);
    let (mut next, mut stack, mut found) = (1_u32, Vec::new(), Vec::new());
    for (root, _) in facts.enumerate().filter(|(_, f)| f.derived) {
        if index[root.index()] != 0 {
            continue;
        }
        let mut path: Vec<(usize, usize)> = vec![(root.index(), 0)];
        while let Some(&mut (v, ref mut edge)) = path.last_mut() {
            if *edge == 0 {
                index[v] = next;
                low[v] = next;
                next += 1;
                stack.push(v);
                on_stack[v] = true;
            }
            if let Some(&w) = below[v].get(*edge) {
                *edge += 1;
                let w = w as usize;
                if index[w] == 0 {
                    path.push((w, 0));
                } else if on_stack[w] {
                    low[v] = low[v].min(index[w]);
                }
                continue;
            }
            path.pop();
            if let Some(&(parent, _)) = path.last() {
                low[parent] = low[parent].min(low[v]);
            }
            if low[v] == index[v] {
                let mut members = Vec::new();
                while let Some(w) = stack.pop() {
                    on_stack[w] = false;
                    members.push(FactId::from_index(w));
                    if w == v {
                        break;
                    }
                }
                found.push(members);
            }
        }
    }
    found
}
