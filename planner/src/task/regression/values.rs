//! The truth of every gate of a circuit, kept up to date with a state.
//!
//! Invariant: for a conjunction, `wrong` is the number of its inputs that are false; for a
//! disjunction, the number of those that are true. Cost: a change visits the gates whose truth
//! changes, and those that read them.

use super::super::{Rows, State, Task, for_each_set};
use super::circuit::{ALWAYS, Circuit, Gate, Node};
use crate::ids::{FactId, id32};
use budget::Meter;
use rustc_hash::FxHashMap;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A circuit with its values in a state.
#[derive(Clone, Debug)]
pub(super) struct Values {
    circuit: Circuit,
    readers: Rows,
    truth: Vec<bool>,
    count: Vec<u32>,
    /// By fixpoint: the truth of its facts.
    fixpoints: FxHashMap<Node, Box<[bool]>>,
    /// By fact: the literals that it is false, and that it is true.
    literals: FxHashMap<FactId, [Option<Node>; 2]>,
    comparisons: Vec<Node>,
    state: State,
    open: BinaryHeap<Reverse<Node>>,
    is_open: Vec<bool>,
}

impl Values {
    pub(super) fn new(task: &Task, circuit: Circuit, state: &State) -> Self {
        let mut inputs = Rows::default();
        circuit.gates().iter().for_each(|gate| inputs.push(gate.inputs().iter().map(|node| node.0)));
        let gates = circuit.gates().len();
        let readers = inputs.transposed(gates, &Meter::default()).expect("the budget has no limit");
        let mut values = Self {
            readers,
            truth: Vec::with_capacity(gates),
            count: Vec::with_capacity(gates),
            fixpoints: FxHashMap::default(),
            literals: FxHashMap::default(),
            comparisons: Vec::new(),
            state: state.clone(),
            open: BinaryHeap::new(),
            is_open: vec![false; gates],
            circuit,
        };
        for node in (0..id32(gates)).map(Node) {
            values.evaluate(task, node);
        }
        values
    }

    /// The first value of a gate; those before it have theirs.
    fn evaluate(&mut self, task: &Task, node: Node) {
        let of = |wanted: bool, nodes: &[Node]| {
            id32(nodes.iter().filter(|&&input| self.truth[input.0 as usize] == wanted).count())
        };
        let (truth, count) = match self.circuit.get(node) {
            Gate::All(nodes) => (of(false, nodes) == 0, of(false, nodes)),
            Gate::Any(nodes) => (of(true, nodes) > 0, of(true, nodes)),
            &Gate::Literal(fact, wanted) => {
                self.literals.entry(fact).or_default()[usize::from(wanted)] = Some(node);
                (self.state.contains(fact) == wanted, 0)
            }
            Gate::Comparison(..) => {
                self.comparisons.push(node);
                (self.compares(task, node), 0)
            }
            Gate::Fixpoint(..) => {
                let heads = self.fixpoint(task, node);
                self.fixpoints.insert(node, heads);
                (false, 0)
            }
            Gate::Constant(_) | Gate::Head(..) => (self.decided(task, node), 0),
        };
        self.truth.push(truth);
        self.count.push(count);
    }

    pub(super) fn holds(&self, node: Node) -> bool {
        self.truth[node.0 as usize]
    }

    pub(super) fn gate(&self, node: Node) -> &Gate {
        self.circuit.get(node)
    }

    pub(super) fn state(&self) -> &State {
        &self.state
    }

    /// Takes in a state; calls `changed` with each gate whose truth changed.
    pub(super) fn observe(&mut self, task: &Task, state: &State, mut changed: impl FnMut(Node, bool)) {
        let facts = task.facts().len().div_ceil(64);
        let mut numbers = false;
        for (i, &new) in state.words().iter().enumerate() {
            let old = std::mem::replace(&mut self.state.words_mut()[i], new);
            if i >= facts {
                numbers |= old != new;
                continue;
            }
            for_each_set(&[old ^ new], |bit| {
                let fact = FactId(id32(i) * 64 + bit);
                let Some(&literals) = self.literals.get(&fact) else { return };
                for (wanted, node) in [false, true].into_iter().zip(literals) {
                    if let Some(node) = node {
                        self.set(node, state.contains(fact) == wanted, &mut changed);
                    }
                }
            });
        }
        for i in 0..self.comparisons.len() * usize::from(numbers) {
            let node = self.comparisons[i];
            self.set(node, self.compares(task, node), &mut changed);
        }
        while let Some(Reverse(node)) = self.open.pop() {
            self.is_open[node.0 as usize] = false;
            match self.circuit.get(node) {
                Gate::Fixpoint(..) => {
                    let heads = self.fixpoint(task, node);
                    if self.fixpoints.get(&node) != Some(&heads) {
                        self.fixpoints.insert(node, heads);
                        self.wake_readers(node);
                    }
                }
                _ => self.set(node, self.decided(task, node), &mut changed),
            }
        }
    }

    fn set(&mut self, node: Node, now: bool, changed: &mut impl FnMut(Node, bool)) {
        if std::mem::replace(&mut self.truth[node.0 as usize], now) == now {
            return;
        }
        changed(node, now);
        for i in self.readers.range(node.0) {
            let reader = self.readers.item(i) as usize;
            match self.circuit.gates()[reader] {
                Gate::All(_) if now => self.count[reader] -= 1,
                Gate::All(_) => self.count[reader] += 1,
                Gate::Any(_) if now => self.count[reader] += 1,
                Gate::Any(_) => self.count[reader] -= 1,
                _ => {}
            }
        }
        self.wake_readers(node);
    }

    fn wake_readers(&mut self, node: Node) {
        for i in self.readers.range(node.0) {
            let reader = self.readers.item(i);
            if !std::mem::replace(&mut self.is_open[reader as usize], true) {
                self.open.push(Reverse(Node(reader)));
            }
        }
    }

    /// The truth of a gate by its inputs' truth.
    fn decided(&self, task: &Task, node: Node) -> bool {
        let count = || self.count[node.0 as usize];
        match self.circuit.get(node) {
            Gate::Constant(_) => node == ALWAYS,
            Gate::All(_) => count() == 0,
            Gate::Any(_) => count() > 0,
            &Gate::Head(fixpoint, fact, wanted) => {
                let Gate::Fixpoint(component, _) = self.circuit.get(fixpoint) else { return false };
                self.fixpoints[&fixpoint][task.axioms.place(*component, fact)] == wanted
            }
            Gate::Literal(..) | Gate::Comparison(..) | Gate::Fixpoint(..) => self.holds(node),
        }
    }

    fn fixpoint(&self, task: &Task, node: Node) -> Box<[bool]> {
        let Gate::Fixpoint(component, inputs) = self.circuit.get(node) else { return Box::default() };
        task.axioms.fixpoint(*component, |place| self.holds(inputs[place]))
    }

    fn compares(&self, task: &Task, node: Node) -> bool {
        let Gate::Comparison(relation, expression, wanted) = self.circuit.get(node) else { return false };
        let words = self.state.words();
        match expression.evaluate(&|&fluent| task.numeric.value(words, fluent)) {
            Ok(value) => relation.holds(value.sign()) == *wanted,
            Err(crate::number::NoValue::Undefined) => !wanted,
            // A step whose numbers do not fit cannot be carried out.
            Err(crate::number::NoValue::Overflow) => false,
        }
    }
}
