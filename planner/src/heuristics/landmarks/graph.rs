//! The landmark graph: fact and disjunctive landmarks, and orders between them.
//!
//! Orders between two landmarks: *natural*, the earlier is in the label of the later;
//! *greedy-necessary*, every first achiever of the later needs the earlier, so it must hold right
//! before; *reasonable*, if the later were achieved first, it would have to be undone for the
//! earlier. Reasonable orders only guide the search and need not be sound; edges that close a cycle
//! are dropped. Interference is derived from mutexes and from the effects that all achievers share.
//!
//! Source: Hoffmann, Porteous & Sebastia, "Ordered landmarks in planning", JAIR 2004; Richter &
//! Westphal, "The LAMA planner", JAIR 2010, §4. We find fact landmarks by label propagation.

use super::labels::Labels;
use crate::ids::{FactId, id32};
use crate::query::{Barred, SearchMeter};
use crate::task::{Goal, Relaxation, Rows, State, Task};
use pddl::model::PredicateId;
use rustc_hash::FxHashMap;
use std::collections::hash_map::Entry;

/// The most facts of a disjunctive landmark.
const DISJUNCTS: usize = 4;
/// Above this many landmarks, reasonable orders are not computed (quadratic work).
const REASONABLE: usize = 1500;

/// A landmark: one of its propositions must hold at some time in every plan.
#[derive(Clone, Debug)]
pub(crate) struct Landmark {
    pub(crate) propositions: Vec<u32>,
    pub(crate) is_goal: bool,
    /// Whether no operator achieves it: once lost, it never holds again.
    pub(crate) is_final: bool,
    /// Landmarks that must be accepted before it.
    pub(crate) before: Vec<u32>,
    /// Landmarks right before which this one must hold.
    pub(crate) needed_for: Vec<u32>,
}

pub(crate) struct LandmarkGraph {
    pub(crate) landmarks: Vec<Landmark>,
    /// By proposition: the landmarks that contain it.
    pub(crate) of: FxHashMap<u32, Vec<u32>>,
}

struct Builder<'a> {
    task: &'a Task,
    graph: &'a Relaxation,
    labels: &'a Labels,
    meter: &'a SearchMeter<'a>,
    achieved_by: Rows,
    found: LandmarkGraph,
    facts: FxHashMap<u32, u32>,
    disjunctive: FxHashMap<Vec<u32>, u32>,
}

impl LandmarkGraph {
    /// Builds the graph for a query.
    pub(crate) fn of(
        task: &Task,
        graph: &Relaxation,
        (state, goal): (&State, &Goal),
        barred: &Barred,
        meter: &SearchMeter<'_>,
    ) -> Self {
        let mut initial = vec![false; graph.propositions()];
        graph.for_each_true(state.words(), |p| initial[p as usize] = true);
        let labels = Labels::new(graph, initial, barred, meter);
        Self::new(task, graph, labels.as_ref(), &graph.literals(&goal.literals), meter)
    }

    /// Builds the graph for a goal; without labels it has only the goals. It is incomplete if the
    /// meter is stopped.
    fn new(
        task: &Task,
        graph: &Relaxation,
        labels: Option<&Labels>,
        goal: &[u32],
        meter: &SearchMeter<'_>,
    ) -> Self {
        let empty = Self { landmarks: Vec::new(), of: FxHashMap::default() };
        let Some(labels) = labels else {
            let mut only_goals = empty;
            for &p in goal {
                only_goals.push(vec![p], true);
            }
            return only_goals;
        };
        let mut builder = Builder {
            task,
            graph,
            labels,
            meter,
            achieved_by: graph
                .effects
                .transposed(graph.propositions(), meter.meter())
                .unwrap_or_else(|_| Rows::empty(graph.propositions())),
            found: empty,
            facts: FxHashMap::default(),
            disjunctive: FxHashMap::default(),
        };
        for &p in goal {
            let id = builder.fact(p);
            builder.found.landmarks[id as usize].is_goal = true;
        }
        for &p in goal {
            for &l in labels.of(p) {
                builder.fact(l);
            }
        }
        let mut next = 0;
        while next < builder.found.landmarks.len() && !meter.is_stopped() {
            builder.chain_back(id32(next));
            next += 1;
        }
        builder.natural_orders();
        if builder.found.landmarks.len() <= REASONABLE {
            builder.reasonable_orders();
        }
        builder.found.without_cycles();
        for landmark in &mut builder.found.landmarks {
            // The negation of a derived fact can become true without an achiever.
            let lost = |&p: &u32| {
                let (fact, positive) = graph.literal(p);
                builder.achieved_by.row(p).is_empty() && (positive || !task.facts[fact].derived)
            };
            landmark.is_final = landmark.propositions.iter().all(lost);
        }
        builder.found
    }

    fn push(&mut self, propositions: Vec<u32>, is_goal: bool) -> u32 {
        let id = id32(self.landmarks.len());
        for &p in &propositions {
            self.of.entry(p).or_default().push(id);
        }
        self.landmarks.push(Landmark {
            propositions,
            is_goal,
            is_final: false,
            before: Vec::new(),
            needed_for: Vec::new(),
        });
        id
    }

    /// Drops orders that close a cycle: edges back to the current path of a depth-first search.
    fn without_cycles(&mut self) {
        let n = self.landmarks.len();
        let mut state = vec![0_u8; n];
        for root in 0..n {
            if state[root] != 0 {
                continue;
            }
            let mut path = vec![(root, 0_usize)];
            state[root] = 1;
            while let Some(&mut (v, ref mut edge)) = path.last_mut() {
                let Some(&w) = self.landmarks[v].before.get(*edge) else {
                    state[v] = 2;
                    path.pop();
                    continue;
                };
                match state[w as usize] {
                    1 => {
                        self.landmarks[v].before.remove(*edge);
                    }
                    0 => {
                        *edge += 1;
                        state[w as usize] = 1;
                        path.push((w as usize, 0));
                    }
                    _ => *edge += 1,
                }
            }
        }
    }
}

impl Builder<'_> {
    fn fact(&mut self, proposition: u32) -> u32 {
        if let Some(&id) = self.facts.get(&proposition) {
            return id;
        }
        let id = self.found.push(vec![proposition], false);
        self.facts.insert(proposition, id);
        id
    }

    fn order(&mut self, before: u32, after: u32, greedy: bool) {
        if before == after {
            return;
        }
        let list = &mut self.found.landmarks[after as usize].before;
        if !list.contains(&before) {
            list.push(before);
        }
        if greedy {
            let list = &mut self.found.landmarks[before as usize].needed_for;
            if !list.contains(&after) {
                list.push(after);
            }
        }
    }

    /// The nodes that may achieve the landmark for the first time.
    fn first_achievers(&self, propositions: &[u32]) -> Vec<u32> {
        let mut nodes = Vec::new();
        let mut union = Vec::new();
        for &p in propositions {
            for &node in self.achieved_by.row(p) {
                if self.meter.spend(64 + 8 * (self.graph.preconditions.row(node).len() + 4 * union.len())) {
                    return nodes;
                }
                if !self.labels.reaches(self.graph, node) {
                    continue;
                }
                self.labels.union(self.graph, node, &mut union);
                if propositions.iter().all(|q| union.binary_search(q).is_err()) {
                    nodes.push(node);
                }
            }
        }
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }

    /// Adds landmarks for the preconditions that all first achievers of a landmark share.
    fn chain_back(&mut self, id: u32) {
        let propositions = self.found.landmarks[id as usize].propositions.clone();
        if propositions.iter().any(|&p| self.labels.is_initial(p)) {
            return;
        }
        let achievers = self.first_achievers(&propositions);
        let Some((&first, rest)) = achievers.split_first() else { return };
        let row = |n: u32| self.graph.preconditions.row(n);
        let mut shared: Vec<u32> = row(first).to_vec();
        for &n in rest {
            if shared.is_empty() || self.meter.spend(row(n).len() * shared.len()) {
                break;
            }
            shared.retain(|p| row(n).contains(p));
        }
        let groups = self.disjunctions(&achievers, &shared);
        for p in shared {
            let before = self.fact(p);
            self.order(before, id, true);
        }
        for group in groups {
            let before = match self.disjunctive.get(&group) {
                Some(&known) => known,
                None => {
                    let new = self.found.push(group.clone(), false);
                    self.disjunctive.insert(group, new);
                    new
                }
            };
            self.order(before, id, true);
        }
    }

    /// Small sets of facts of one predicate, such that every achiever needs one fact of each set.
    fn disjunctions(&self, achievers: &[u32], shared: &[u32]) -> Vec<Vec<u32>> {
        let predicate = |p: u32| -> Option<PredicateId> {
            let (fact, positive) = self.graph.literal(p);
            positive.then_some(())?;
            self.task.facts()[fact].atom.as_ref().map(|a| a.predicate)
        };
        let mut candidates: Vec<(PredicateId, Vec<u32>)> = Vec::new();
        for (i, &node) in achievers.iter().enumerate() {
            if self.meter.spend(64 + 32 * self.graph.preconditions.row(node).len()) {
                return Vec::new();
            }
            let mut here: Vec<(PredicateId, u32)> = self
                .graph
                .preconditions
                .row(node)
                .iter()
                .filter(|p| !shared.contains(p))
                .filter_map(|&p| predicate(p).map(|q| (q, p)))
                .collect();
            here.sort_unstable();
            if i == 0 {
                for &(q, _) in &here {
                    if candidates.last().is_none_or(|(last, _)| *last != q) {
                        candidates.push((q, Vec::new()));
                    }
                }
            }
            candidates.retain_mut(|(q, facts)| {
                let own = here.iter().filter(|(r, _)| r == q).map(|&(_, p)| p);
                let before = facts.len();
                let mut any = false;
                for p in own {
                    any = true;
                    if !facts.contains(&p) {
                        facts.push(p);
                    }
                }
                debug_assert!(facts.len() >= before);
                any && facts.len() <= DISJUNCTS
            });
            if candidates.is_empty() {
                break;
            }
        }
        candidates
            .into_iter()
            .map(|(_, mut facts)| {
                facts.sort_unstable();
                facts
            })
            .filter(|f| {
                f.len() > 1 && f.iter().all(|&p| !self.labels.is_initial(p) && !self.facts.contains_key(&p))
            })
            .collect()
    }

    fn natural_orders(&mut self) {
        let facts: Vec<(u32, u32)> = self.facts.iter().map(|(&p, &id)| (p, id)).collect();
        let mut facts = facts;
        facts.sort_unstable();
        for (p, id) in facts {
            if self.meter.spend(8 * self.labels.of(p).len()) {
                return;
            }
            for &l in self.labels.of(p) {
                if let Some(&before) = self.facts.get(&l) {
                    self.order(before, id, false);
                }
            }
        }
    }

    /// Orders `b` before `a` if `a`, achieved first, would have to be undone for `b`.
    fn reasonable_orders(&mut self) {
        let n = id32(self.found.landmarks.len());
        let shared = self.shared_effects();
        let mut right_before: Vec<Vec<u32>> = vec![Vec::new(); n as usize];
        for x in 0..n {
            for &b in &self.found.landmarks[x as usize].needed_for {
                right_before[b as usize].push(x);
            }
        }
        let mut orders = Vec::new();
        for a in 0..n {
            let Some(undone) = self.fact_of(a) else { continue };
            for b in self.companions(a) {
                if self.meter.spend(64) {
                    return;
                }
                let excludes = |f: FactId| f != undone && self.task.mutexes.are_mutex(f, undone);
                let before = right_before[b as usize].iter().filter(|&&x| x != a);
                let effects = shared.get(&b);
                if self.fact_of(b).is_some_and(excludes)
                    || before.clone().filter_map(|&x| self.fact_of(x)).any(excludes)
                    || effects.is_some_and(|e| e.deletes.contains(&undone))
                    || effects.is_some_and(|e| e.adds.iter().copied().any(excludes))
                    // Even without a mutex: every achiever of `a` deletes a fact that `b` needs.
                    || shared.get(&a).is_some_and(|e| {
                        before.filter_map(|&x| self.fact_of(x)).any(|f| e.deletes.contains(&f))
                    })
                {
                    orders.push((b, a));
                }
            }
        }
        for (b, a) in orders {
            self.order(b, a, false);
        }
    }

    /// The fact of a landmark that is a single positive literal.
    fn fact_of(&self, landmark: u32) -> Option<FactId> {
        let [proposition] = self.found.landmarks[landmark as usize].propositions[..] else { return None };
        let (fact, positive) = self.graph.literal(proposition);
        positive.then_some(fact)
    }

    /// Landmarks that must hold together with `a` or after it: the other goals if `a` is a goal,
    /// and the landmarks ordered, also transitively, before one that needs `a` right before it.
    fn companions(&self, a: u32) -> Vec<u32> {
        let landmarks = &self.found.landmarks;
        let mut others = Vec::new();
        if landmarks[a as usize].is_goal {
            others.extend((0..id32(landmarks.len())).filter(|&b| landmarks[b as usize].is_goal));
        }
        let mut stack: Vec<u32> = landmarks[a as usize]
            .needed_for
            .iter()
            .flat_map(|&c| landmarks[c as usize].before.iter().copied())
            .collect();
        let mut seen = vec![false; landmarks.len()];
        while let Some(b) = stack.pop() {
            if b != a && !std::mem::replace(&mut seen[b as usize], true) {
                others.push(b);
                stack.extend(&landmarks[b as usize].before);
            }
        }
        others.sort_unstable();
        others.dedup();
        others.retain(|&b| b != a && !landmarks[b as usize].before.contains(&a));
        others
    }

    /// By landmark that is a single fact: the effects that all its achievers share.
    fn shared_effects(&self) -> FxHashMap<u32, Shared> {
        let landmark_of: FxHashMap<u32, u32> =
            (0..id32(self.found.landmarks.len())).filter_map(|l| self.fact_of(l).map(|f| (f.0, l))).collect();
        let mut shared: FxHashMap<u32, Shared> = FxHashMap::default();
        for operator in self.task.operators.iter() {
            if self.meter.spend(32 + 16 * (operator.adds.len() + operator.deletes.len())) {
                return FxHashMap::default();
            }
            let conditional =
                operator.conditional.iter().flat_map(|e| e.adds.iter().map(move |f| (f, Some(e))));
            for (fact, when) in operator.adds.iter().map(|f| (f, None)).chain(conditional) {
                let Some(&landmark) = landmark_of.get(&fact.0) else { continue };
                let with = when.map_or(&[][..], |e| e.deletes);
                let deletes = || operator.deletes.iter().chain(with).copied();
                let more = when.map_or(&[][..], |e| e.adds);
                let adds = || operator.adds.iter().chain(more).copied();
                match shared.entry(landmark) {
                    Entry::Vacant(entry) => {
                        entry.insert(Shared { adds: adds().collect(), deletes: deletes().collect() });
                    }
                    Entry::Occupied(mut entry) => {
                        let known = entry.get_mut();
                        known.adds.retain(|f| adds().any(|g| g == *f));
                        known.deletes.retain(|f| deletes().any(|g| g == *f));
                    }
                }
            }
        }
        shared
    }
}

/// The effects that all achievers of a landmark share.
struct Shared {
    adds: Vec<FactId>,
    deletes: Vec<FactId>,
}
