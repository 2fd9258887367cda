//! Axioms, evaluated in each state to a fixpoint.
//!
//! Problem: derived facts are functions of the basic facts and must be correct in every state.
//! Idea: facts that depend on each other form a strongly connected component. The components are
//! evaluated in topological order, each in one pass; a recursive one also follows the consequences
//! of each new fact. After a step, a component is evaluated again only if something that it reads
//! has changed. Invariant: there is no negative dependency inside a component (stratification;
//! grounding rejects anything else). Cost: each rule of the evaluated components, once, and once
//! more for each of its recursive conditions.
//!
//! The components come from our own version of Tarjan's algorithm, because it must neither recurse
//! nor run unmetered: a chain of derived facts can contain every fact of the task. petgraph's
//! `tarjan_scc` recurses once per fact of such a chain. Its `kosaraju_scc` is iterative, but the
//! caller's budget could not interrupt it.
//!
//! Source: Thiébaux, Hoffmann & Nebel, "In defense of PDDL axioms", AIJ 2005, §2.

use super::sort::sort_by_count;
use super::{Fact, Literals, Rows, contains, for_each_set, set, unset};
use crate::ids::{FactId, id32};
use budget::{Interrupted, Meter};
use pddl::model::{Idx, IndexVec};

/// `head` holds in every state in which `body` holds.
#[derive(Clone, Debug)]
pub struct AxiomRule {
    /// The derived fact.
    pub head: FactId,
    /// The condition under which it holds.
    pub body: Literals,
}

#[derive(Clone, Debug)]
struct Component {
    rules: std::ops::Range<usize>,
    heads: Box<[FactId]>,
    recursive: bool,
}

/// All rules in the order of evaluation.
#[derive(Clone, Debug, Default)]
pub(crate) struct AxiomProgram {
    rules: Vec<AxiomRule>,
    components: Vec<Component>,
    /// A set bit for each fact that a rule reads.
    read: Vec<u64>,
    /// By fact: the components that read it (other than its own).
    readers: Rows,
    /// By fact: the rules of its own component that need it.
    followers: Rows,
    /// By fact: its component; `NONE` if no rule derives it.
    component: Vec<u32>,
}

const NONE: u32 = u32::MAX;

/// The reason why there is no order of evaluation.
#[derive(Clone, Copy, Debug)]
pub(crate) enum NoProgram {
    /// A derived fact depends on its own negation.
    NotStratified(FactId),
    Interrupted,
}

impl From<Interrupted> for NoProgram {
    fn from(_: Interrupted) -> Self {
        Self::Interrupted
    }
}

impl AxiomProgram {
    pub(crate) fn new(
        facts: &IndexVec<FactId, Fact>,
        rules: Vec<AxiomRule>,
        meter: &Meter<'_>,
    ) -> Result<Self, NoProgram> {
        let order = components(facts, &rules, meter)?;
        let mut component_of = vec![usize::MAX; facts.len()];
        for (i, members) in order.iter().enumerate() {
            for m in members {
                component_of[m.index()] = i;
            }
        }
        let places: Vec<u32> = (0..id32(rules.len())).collect();
        let component = |rule: u32| component_of[rules[rule as usize].head.index()];
        let places = sort_by_count(&places, order.len(), meter, component)?;
        let mut rules: Vec<Option<AxiomRule>> = rules.into_iter().map(Some).collect();
        let take = |place: &u32| rules[*place as usize].take().expect("each has one place");
        let sorted: Vec<AxiomRule> = places.iter().map(take).collect();
        let mut built = Vec::new();
        let mut start = 0;
        while start < sorted.len() {
            let component = component_of[sorted[start].head.index()];
            let end = start + sorted[start..].partition_point(|r| component_of[r.head.index()] == component);
            let own = |f: &FactId| component_of[f.index()] == component;
            for rule in &sorted[start..end] {
                meter.spend(16 + 4 * rule.body.len())?;
                if let Some(&f) = rule.body.negative.iter().find(|f| own(f)) {
                    return Err(NoProgram::NotStratified(f));
                }
            }
            let recursive = sorted[start..end].iter().any(|r| r.body.positive.iter().any(own));
            let mut heads = order[component].clone().into_boxed_slice();
            heads.sort_unstable();
            built.push(Component { rules: start..end, heads, recursive });
            start = end;
        }
        let mut program = Self { rules: sorted, components: built, ..Self::default() };
        program.index(facts.len(), &component_of, meter)?;
        Ok(program)
    }

    /// Fills `read`, `readers`, `followers` and `component`.
    fn index(&mut self, facts: usize, component_of: &[usize], meter: &Meter<'_>) -> Result<(), Interrupted> {
        self.read = vec![0; facts.div_ceil(64)];
        self.component = vec![NONE; facts];
        for (i, component) in self.components.iter().enumerate() {
            component.heads.iter().for_each(|head| self.component[head.index()] = id32(i));
        }
        let (mut reads, mut needs) = (Rows::default(), Rows::default());
        for component in &self.components {
            let rules = &self.rules[component.rules.clone()];
            let own = component_of[component.heads[0].index()];
            let mut outside: Vec<u32> = Vec::new();
            for rule in rules {
                meter.spend(64 + 8 * rule.body.len())?;
                let (inside, others): (Vec<FactId>, Vec<FactId>) =
                    rule.body.positive.iter().partition(|f| component_of[f.index()] == own);
                needs.push(inside.into_iter().map(|f| f.0));
                outside.extend(others.iter().chain(&rule.body.negative).map(|f| f.0));
            }
            outside.sort_unstable();
            outside.dedup();
            outside.iter().for_each(|&f| set(&mut self.read, FactId(f)));
            reads.push(outside);
        }
        self.readers = reads.transposed(facts, meter)?;
        self.followers = needs.transposed(facts, meter)?;
        Ok(())
    }

    pub(crate) fn rules(&self) -> &[AxiomRule] {
        &self.rules
    }

    /// The component that derives the fact, if any does. A component has a greater number than
    /// those that it reads.
    pub(super) fn component(&self, fact: FactId) -> Option<u32> {
        Some(self.component[fact.index()]).filter(|&component| component != NONE)
    }

    /// The rules of a component.
    pub(super) fn rules_of(&self, component: u32) -> &[AxiomRule] {
        &self.rules[self.components[component as usize].rules.clone()]
    }

    /// Whether facts of the component may depend on themselves.
    pub(super) fn is_recursive(&self, component: u32) -> bool {
        self.components[component as usize].recursive
    }

    /// Whether the rules of the component derive the fact.
    pub(super) fn is_own(&self, component: u32, fact: FactId) -> bool {
        self.component[fact.index()] == component
    }

    /// The literals of a component's rules that are not its own facts, in order of the rules.
    pub(super) fn outside(&self, component: u32) -> impl Iterator<Item = (FactId, bool)> {
        let all = self.rules_of(component).iter().flat_map(|rule| rule.body.as_ref().iter());
        all.filter(move |&(fact, _)| !self.is_own(component, fact))
    }

    /// A set bit for each component whose facts may change with these facts.
    pub(super) fn reached(&self, facts: impl IntoIterator<Item = FactId>) -> Vec<u64> {
        let mut reached = vec![0_u64; self.components.len().div_ceil(64)];
        let wake = |reached: &mut [u64], fact: FactId| {
            self.readers.row(fact.0).iter().for_each(|&c| set(reached, FactId(c)));
        };
        if self.components.is_empty() {
            return reached;
        }
        facts.into_iter().for_each(|fact| wake(&mut reached, fact));
        for (i, component) in self.components.iter().enumerate() {
            if contains(&reached, FactId(id32(i))) {
                component.heads.iter().for_each(|&head| wake(&mut reached, head));
            }
        }
        reached
    }

    /// Evaluates a component whose [`outside`](Self::outside) literals hold or not as `holds` says.
    /// Returns the truth of its facts, in order of their ids.
    pub(super) fn fixpoint(&self, component: u32, holds: impl Fn(usize) -> bool) -> Box<[bool]> {
        let Component { rules, heads, .. } = &self.components[component as usize];
        let place = |fact: FactId| heads.binary_search(&fact).expect("it is its own");
        let mut place_outside = 0;
        let mut open = Vec::with_capacity(rules.len());
        for rule in &self.rules[rules.clone()] {
            let mut all = true;
            for (fact, _) in rule.body.as_ref().iter() {
                if !self.is_own(component, fact) {
                    all &= holds(place_outside);
                    place_outside += 1;
                }
            }
            open.push(all);
        }
        let mut derived = vec![false; heads.len()].into_boxed_slice();
        let fires = |derived: &[bool], rule: usize| {
            let body = &self.rules[rule].body.positive;
            open[rule - rules.start]
                && body.iter().all(|&fact| !self.is_own(component, fact) || derived[place(fact)])
        };
        let mut new = Vec::new();
        let derive = |rule: usize, derived: &mut [bool], new: &mut Vec<FactId>| {
            let head = self.rules[rule].head;
            if !derived[place(head)] && fires(derived, rule) {
                derived[place(head)] = true;
                new.push(head);
            }
        };
        rules.clone().for_each(|rule| derive(rule, &mut derived, &mut new));
        while let Some(fact) = new.pop() {
            let followers = self.followers.row(fact.0);
            followers.iter().for_each(|&rule| derive(rule as usize, &mut derived, &mut new));
        }
        derived
    }

    /// The place of a fact in what [`fixpoint`](Self::fixpoint) returns.
    pub(super) fn place(&self, component: u32, fact: FactId) -> usize {
        let heads = &self.components[component as usize].heads;
        heads.binary_search(&fact).expect("the component derives it")
    }

    /// Whether there are no rules.
    pub(super) fn is_empty(&self) -> bool {
        self.components.is_empty()
    }

    /// Evaluates every derived fact.
    pub(crate) fn close(&self, words: &mut [u64]) {
        for component in &self.components {
            self.decide(component, words);
        }
    }

    /// Evaluates the derived facts after a step from the closed state `before`. `words` has the
    /// basic facts of the new state and the derived facts of `before`.
    pub(crate) fn update(&self, before: &[u64], words: &mut [u64]) {
        if self.components.is_empty() {
            return;
        }
        let mut waiting = vec![0_u64; self.components.len().div_ceil(64)];
        let wake = |fact: u32, waiting: &mut [u64]| {
            for &c in self.readers.row(fact) {
                waiting[c as usize / 64] |= 1 << (c % 64);
            }
        };
        let mut any = false;
        for (i, ((&old, &new), &read)) in before.iter().zip(&*words).zip(&self.read).enumerate() {
            let changed = (old ^ new) & read;
            any |= changed != 0;
            for_each_set(&[changed], |bit| wake(id32(i) * 64 + bit, &mut waiting));
        }
        if !any {
            return;
        }
        // Readers of a component come after it, so one ascending pass reaches them all.
        for block in 0..waiting.len() {
            while waiting[block] != 0 {
                let bit = waiting[block].trailing_zeros() as usize;
                waiting[block] &= waiting[block] - 1;
                let component = &self.components[block * 64 + bit];
                self.decide(component, words);
                for &head in &component.heads {
                    if contains(words, head) != contains(before, head) {
                        wake(head.0, &mut waiting);
                    }
                }
            }
        }
    }

    /// Evaluates the facts of one component. The components below it must be up to date.
    fn decide(&self, component: &Component, words: &mut [u64]) {
        component.heads.iter().for_each(|&head| unset(words, head));
        let mut new = Vec::new();
        for rule in &self.rules[component.rules.clone()] {
            if !contains(words, rule.head) && rule.body.hold_in(words) {
                set(words, rule.head);
                if component.recursive {
                    new.push(rule.head);
                }
            }
        }
        while let Some(fact) = new.pop() {
            for &r in self.followers.row(fact.0) {
                let rule = &self.rules[r as usize];
                if !contains(words, rule.head) && rule.body.hold_in(words) {
                    set(words, rule.head);
                    new.push(rule.head);
                }
            }
        }
    }
}

/// Strongly connected components of the derived facts, dependencies first (Tarjan, iterative).
fn components(
    facts: &IndexVec<FactId, Fact>,
    rules: &[AxiomRule],
    meter: &Meter<'_>,
) -> Result<Vec<Vec<FactId>>, Interrupted> {
    let n = facts.len();
    let mut below: Vec<Vec<u32>> = vec![Vec::new(); n];
    for rule in rules {
        meter.spend(8 + 4 * rule.body.len())?;
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
            meter.spend(8)?;
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
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::{AxiomProgram, AxiomRule};
    use crate::ids::FactId;
    use crate::task::{Fact, Literals};
    use pddl::model::IndexVec;
    use proptest::prelude::*;

    const BASIC: u32 = 6;
    const EACH: u32 = 4;

    /// A head of a stratum, facts up to that stratum, negated facts below it.
    type RandomRule = (u32, u32, Vec<u32>, Vec<u32>);

    fn random_rule() -> impl Strategy<Value = RandomRule> {
        (0..3_u32).prop_flat_map(|stratum| {
            let below = BASIC + stratum * EACH;
            let positive = prop::collection::vec(0..below + EACH, 0..3);
            (Just(stratum), below..below + EACH, positive, prop::collection::vec(0..below, 0..2))
        })
    }

    /// Evaluates stratum by stratum, and repeats each rule until nothing changes.
    fn by_definition(rules: &[RandomRule], basic: u64) -> u64 {
        let mut state = basic;
        for stratum in 0..3 {
            loop {
                let before = state;
                for (_, head, positive, negative) in rules.iter().filter(|r| r.0 == stratum) {
                    let holds = |f: &u32| state >> f & 1 == 1;
                    if positive.iter().all(holds) && !negative.iter().any(holds) {
                        state |= 1 << head;
                    }
                }
                if state == before {
                    break;
                }
            }
        }
        state
    }

    proptest! {
        #[test]
        fn steps_and_fresh_states_are_closed_as_defined(
            rules in prop::collection::vec(random_rule(), 0..14),
            states in prop::collection::vec(0..1_u64 << BASIC, 1..8),
        ) {
            let mut facts: IndexVec<FactId, Fact> = IndexVec::new();
            (0..BASIC + 3 * EACH).for_each(|f| {
                facts.push(Fact { atom: None, value: None, derived: f >= BASIC, compares: false });
            });
            let literals = |facts: &[u32]| {
                let mut sorted: Vec<FactId> = facts.iter().map(|&f| FactId(f)).collect();
                sorted.sort_unstable();
                sorted.dedup();
                sorted.into_boxed_slice()
            };
            let built = rules.iter().map(|(_, head, positive, negative)| AxiomRule {
                head: FactId(*head),
                body: Literals { positive: literals(positive), negative: literals(negative) },
            });
            let program = AxiomProgram::new(&facts, built.collect(), &budget::Meter::default()).unwrap();
            let mut before = [0_u64];
            program.close(&mut before);
            prop_assert_eq!(before[0], by_definition(&rules, 0));
            for basic in states {
                let mut stepped = [before[0] & !((1 << BASIC) - 1) | basic];
                program.update(&before, &mut stepped);
                prop_assert_eq!(stepped[0], by_definition(&rules, basic));
                before = stepped;
            }
        }
    }
}
