//! Matching: a depth-first join along the steps of a plan, with one array of slots and no allocation per step.
//!
//! Cost: the product of the fan-outs along the walks; a scan costs the number of nodes of the variable's type.

use std::cell::Cell;
use std::ops::ControlFlow;

use super::compiled::{Binding, Pattern, slot};
use super::fixed::Fixed;
use super::negated::{Case, Judge, Known, Witness};
use super::part::Part;
use super::plan::{Plans, Step, plan};
use super::slot::{Mask, SLOTS, Slot};
use super::source::{Atom, Carrier, Limit, Right};
use super::term::{Comparison, Metric, Variable};
use crate::chain;
use crate::id::{AttributeId, EdgeKey, Holder, NodeId};
use crate::snapshot::Snapshot;
use crate::state::State;
use crate::value::Value;

/// Which of the two thresholds of a metric counts: the one to appear or the one to disappear. A negation swaps them,
/// because a negated part that is harder to satisfy makes the pattern easier to satisfy.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Strictness {
    Appears,
    Stays,
}

impl Strictness {
    fn negated(self) -> Self {
        match self {
            Self::Appears => Self::Stays,
            Self::Stays => Self::Appears,
        }
    }
}

impl Pattern {
    /// All matches, in order.
    pub fn matches(&self, snapshot: &Snapshot) -> Vec<Binding> {
        self.matches_with(snapshot, &[])
    }

    /// All matches with these nodes for these variables, in order. A local variable, or one of a larger pattern, has no
    /// node in a match: to fix one is a bug of the caller, which a debug build catches.
    pub fn matches_with(&self, snapshot: &Snapshot, fixed: &[(Variable, NodeId)]) -> Vec<Binding> {
        let mut found = Vec::new();
        let count = self.variables.len();
        let _ = self.run_all(snapshot.state(), fixed, &mut |slots| {
            found.push(Binding(slots[..count].to_vec()));
            ControlFlow::Continue(())
        });
        found.sort_unstable();
        found
    }

    /// All matches, in order. Adds the number of nodes tried to `looked`.
    pub(crate) fn matches_known(
        &self,
        state: &State,
        known: Option<&Known<'_>>,
        looked: &Cell<usize>,
    ) -> Vec<Binding> {
        let mut slots = [NodeId::NOWHERE; SLOTS];
        self.bind_constants(state, &mut slots);
        let run = Run { pattern: self, state, strictness: Strictness::Appears, known, looked };
        let mut found = Vec::new();
        let _ = run.steps(&self.plan, &mut slots, &mut |slots| {
            found.push(Binding(slots[..self.variables.len()].to_vec()));
            ControlFlow::Continue(())
        });
        found.sort_unstable();
        found
    }

    /// The matches with these nodes for these variables, in order. The join order is kept in `plans`. Adds the number
    /// of nodes tried to `looked`.
    pub(crate) fn matches_of(
        &self,
        state: &State,
        fixed: &Fixed,
        plans: &mut Plans,
        known: Option<&Known<'_>>,
        looked: &Cell<usize>,
    ) -> Vec<Binding> {
        let mut slots = [NodeId::NOWHERE; SLOTS];
        let mut bound = self.bind_constants(state, &mut slots);
        let run = Run { pattern: self, state, strictness: Strictness::Appears, known, looked };
        for &(at, node) in fixed {
            if (bound.contains(slot(at)) && slots[at] != node) || !run.admits(slot(at), node) {
                return Vec::new();
            }
            slots[at] = node;
            bound.insert(slot(at));
        }
        let known = plans.0.iter().position(|(mask, _)| *mask == bound);
        let at = known.unwrap_or_else(|| {
            plans.0.push((bound, plan(&self.body, bound)));
            plans.0.len() - 1
        });
        let mut found = Vec::new();
        let _ = run.steps(&plans.0[at].1, &mut slots, &mut |slots| {
            found.push(Binding(slots[..self.variables.len()].to_vec()));
            ControlFlow::Continue(())
        });
        found.sort_unstable();
        found
    }

    /// Whether a held match stays by the threshold to disappear, although it would not appear.
    pub(crate) fn keeps(&self, state: &State, held: &Binding) -> bool {
        if !self.remembers {
            return false;
        }
        let mut slots = [NodeId::NOWHERE; SLOTS];
        self.bind_constants(state, &mut slots);
        let looked = Cell::new(0);
        let run = Run { pattern: self, state, strictness: Strictness::Stays, known: None, looked: &looked };
        for (at, &node) in held.iter().enumerate() {
            if !run.admits(slot(at), node) {
                return false;
            }
            slots[at] = node;
        }
        run.steps(&self.judgement, &mut slots, &mut |_| ControlFlow::Break(())).is_break()
    }

    fn bind_constants(&self, state: &State, slots: &mut Slots) -> Mask {
        let mut bound = Mask::default();
        let first = self.variables.len() + self.locals.len();
        for (at, node) in self.constants_in(state).enumerate() {
            slots[first + at] = node;
            bound.insert(slot(first + at));
        }
        bound
    }

    /// Whether the pattern has a match.
    pub fn holds(&self, snapshot: &Snapshot) -> bool {
        self.holds_in(snapshot.state(), &[])
    }

    /// Whether the pattern has a match with these nodes for these variables; see [`Pattern::matches_with`].
    pub fn holds_with(&self, snapshot: &Snapshot, fixed: &[(Variable, NodeId)]) -> bool {
        self.holds_in(snapshot.state(), fixed)
    }

    pub(crate) fn holds_in(&self, state: &State, fixed: &[(Variable, NodeId)]) -> bool {
        self.run_all(state, fixed, &mut |_| ControlFlow::Break(())).is_break()
    }

    fn run_all(&self, state: &State, fixed: &[(Variable, NodeId)], emit: Emit<'_>) -> ControlFlow<()> {
        let looked = &Cell::new(0);
        let mut slots = [NodeId::NOWHERE; SLOTS];
        let mut bound = self.bind_constants(state, &mut slots);
        let run = Run { pattern: self, state, strictness: Strictness::Appears, known: None, looked };
        let mut any = false;
        for &(variable, node) in fixed {
            let own = self.place_of(variable);
            debug_assert!(own.is_some(), "a local variable, or one of another pattern, cannot be fixed");
            let Some(at) = own else { return ControlFlow::Continue(()) };
            // A variable fixed to two nodes, or to a node of another type, has no match.
            if (bound.contains(slot(at)) && slots[at] != node) || !run.admits(slot(at), node) {
                return ControlFlow::Continue(());
            }
            slots[at] = node;
            bound.insert(slot(at));
            any = true;
        }
        if any {
            let plan = plan(&self.body, bound);
            run.steps(&plan, &mut slots, emit)
        } else {
            run.steps(&self.plan, &mut slots, emit)
        }
    }
}

type Slots = [NodeId; SLOTS];
type Emit<'a> = &'a mut dyn FnMut(&Slots) -> ControlFlow<()>;

struct Run<'a> {
    pattern: &'a Pattern,
    state: &'a State,
    strictness: Strictness,
    /// What is known about negated parts.
    known: Option<&'a Known<'a>>,
    /// The number of nodes that have been tried.
    looked: &'a Cell<usize>,
}

impl Run<'_> {
    fn steps(&self, steps: &[Step], slots: &mut Slots, emit: Emit<'_>) -> ControlFlow<()> {
        let Some((step, rest)) = steps.split_first() else { return emit(slots) };
        match step {
            Step::Check(atom) => {
                if self.check(atom, slots) {
                    self.steps(rest, slots, emit)?;
                }
            }
            Step::Without { at, steps: inner } => {
                let negated = Run { strictness: self.strictness.negated(), known: None, ..*self };
                let node = |slot| get(slots, slot);
                let judge = self.known.and_then(|known| Some((known, known.judge(self.pattern, *at, node)?)));
                // Local variables are not read outside of the part, so it can use the same array of slots.
                let blocked = match judge {
                    Some((_, Judge::Suspects(part, suspects))) => {
                        suspects.iter().try_for_each(|&(own, node)| {
                            let (end, inner) = &part.own[own];
                            negated.bind(end.slot, node, inner, slots, &mut |_| ControlFlow::Break(()))
                        })
                    }
                    Some((known, Judge::Search(part, case))) => {
                        negated.search(part, case, known, inner, slots)
                    }
                    None => negated.steps(inner, slots, &mut |_| ControlFlow::Break(())),
                };
                if blocked.is_continue() {
                    self.steps(rest, slots, emit)?;
                }
            }
            Step::Forward { from, label, to } => {
                let Some(node) = self.state.node(get(slots, *from)) else { return ControlFlow::Continue(()) };
                for edge in node.edges(*label) {
                    self.bind(*to, edge.to, rest, slots, emit)?;
                }
            }
            Step::Backward { from, label, to } => {
                let Some(node) = self.state.node(get(slots, *to)) else { return ControlFlow::Continue(()) };
                for &(_, source) in node.sources(*label) {
                    self.bind(*from, source, rest, slots, emit)?;
                }
            }
            Step::Follow { holder, attribute, to } => {
                if let Some(Value::Node(node)) = self.value(holder, *attribute, slots) {
                    self.bind(*to, *node, rest, slots, emit)?;
                }
            }
            Step::Scan(slot) => {
                let vocabulary = &self.state.vocabulary;
                let Some(wanted) = self.pattern.type_of(*slot) else { return ControlFlow::Continue(()) };
                for sub in vocabulary.types().filter(|&sub| vocabulary.is_a(sub, wanted)) {
                    for node in self.state.nodes_exactly(sub) {
                        self.looked.set(self.looked.get() + 1);
                        slots[usize::from(slot.0)] = node;
                        self.steps(rest, slots, emit)?;
                    }
                }
            }
        }
        ControlFlow::Continue(())
    }

    /// Searches a negated part for a match, beginning with the witness that the last search found.
    fn search(
        &self,
        part: &Part,
        case: Case,
        known: &Known<'_>,
        inner: &[Step],
        slots: &mut Slots,
    ) -> ControlFlow<()> {
        let witness = known.moves.witnesses.borrow().get(&case);
        if let Some(witness) = witness
            && part.locals.iter().zip(&witness).all(|(slot, node)| self.admits(*slot, *node))
        {
            self.looked.set(self.looked.get() + 1);
            part.locals.iter().zip(witness).for_each(|(slot, node)| slots[usize::from(slot.0)] = node);
            self.steps(&part.judgement, slots, &mut |_| ControlFlow::Break(()))?;
        }
        let mut found: Option<Witness> = None;
        let outcome = self.steps(inner, slots, &mut |slots| {
            found = Some(part.locals.iter().map(|slot| get(slots, *slot)).collect());
            ControlFlow::Break(())
        });
        known.moves.witnesses.borrow_mut().put(case, found);
        outcome
    }

    fn bind(
        &self,
        slot: Slot,
        node: NodeId,
        rest: &[Step],
        slots: &mut Slots,
        emit: Emit<'_>,
    ) -> ControlFlow<()> {
        self.looked.set(self.looked.get() + 1);
        if !self.admits(slot, node) {
            return ControlFlow::Continue(());
        }
        slots[usize::from(slot.0)] = node;
        self.steps(rest, slots, emit)
    }

    /// Whether the node exists and has the variable's type.
    fn admits(&self, slot: Slot, node: NodeId) -> bool {
        match (self.pattern.type_of(slot), self.state.node(node)) {
            (Some(wanted), Some(node)) => self.state.vocabulary.is_a(node.node_type(), wanted),
            _ => false,
        }
    }

    fn check(&self, atom: &Atom<Slot>, slots: &Slots) -> bool {
        match atom {
            Atom::Edge { from, label, to } => {
                let key = EdgeKey { from: get(slots, *from), label: *label, to: get(slots, *to) };
                self.state.edge(key).is_some()
            }
            Atom::Present { holder, attribute } => self.value(holder, *attribute, slots).is_some(),
            Atom::Guard { holder, attribute, comparison, operand } => {
                let Some(left) = self.value(holder, *attribute, slots) else { return false };
                match operand {
                    Right::Value(right) => compare(*comparison, left, right),
                    Right::Term(slot) => {
                        let node = get(slots, *slot);
                        node != NodeId::NOWHERE && compare(*comparison, left, &Value::Node(node))
                    }
                    Right::Attribute(holder, attribute) => self
                        .value(holder, *attribute, slots)
                        .is_some_and(|right| compare(*comparison, left, right)),
                }
            }
            Atom::Distinct(a, b) => {
                let there = |slot| self.state.node(get(slots, slot)).is_some();
                get(slots, *a) != get(slots, *b) && there(*a) && there(*b)
            }
            Atom::IsA(slot, wanted) => {
                let found = self.state.node(get(slots, *slot));
                found.is_some_and(|node| self.state.vocabulary.is_a(node.node_type(), *wanted))
            }
            Atom::Metric { metric, from, to, comparison, limit } => {
                let (from, to) = (get(slots, *from), get(slots, *to));
                let number = match limit {
                    Limit::Threshold(threshold) if self.strictness == Strictness::Stays => {
                        Some(threshold.disappears)
                    }
                    Limit::Threshold(threshold) => Some(threshold.appears),
                    Limit::Attribute(attribute) => self
                        .state
                        .cell(Holder::Node(from), *attribute)
                        .and_then(|cell| cell.value.as_number()),
                };
                let Some(number) = number else { return false };
                let found = match metric {
                    Metric::Distance => chain::distance(self.state, from, to),
                    Metric::Bearing => chain::bearing(self.state, from, to).map(f64::abs),
                };
                found.is_ok_and(|found| compare(*comparison, &Value::Number(found), &Value::Number(number)))
            }
            Atom::Without(_) => {
                debug_assert!(false, "the planner turns negated parts into steps of their own");
                false
            }
        }
    }

    fn value(&self, holder: &Carrier<Slot>, attribute: AttributeId, slots: &Slots) -> Option<&Value> {
        let holder = match *holder {
            Carrier::Node(node) => Holder::Node(get(slots, node)),
            Carrier::Edge { from, label, to } => {
                Holder::Edge(EdgeKey { from: get(slots, from), label, to: get(slots, to) })
            }
        };
        self.state.cell(holder, attribute).map(|cell| &cell.value)
    }
}

fn get(slots: &Slots, slot: Slot) -> NodeId {
    slots[usize::from(slot.0)]
}

fn compare(comparison: Comparison, left: &Value, right: &Value) -> bool {
    match comparison {
        Comparison::Equal => left == right,
        Comparison::NotEqual => left != right,
        order => match (left, right) {
            (Value::Number(left), Value::Number(right)) => match order {
                Comparison::Less => left < right,
                Comparison::LessOrEqual => left <= right,
                Comparison::Greater => left > right,
                _ => left >= right,
            },
            _ => false,
        },
    }
}
