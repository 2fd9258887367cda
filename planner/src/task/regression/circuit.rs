//! Conditions on a state as one circuit.
//!
//! Problem: a conditional effect turns a literal into a formula, and the formulas of consecutive
//! suffixes have most parts in common. Idea: equal conditions are one gate. Invariant: a gate comes
//! after the gates that it reads, so the order of gates is an order of evaluation. A negation is
//! pushed down to the literals. Cost: a hash look-up per gate.

use super::super::LiteralsRef;
use crate::ids::{FactId, FluentId, id32};
use crate::number::{Expression, Relation};
use rustc_hash::FxHashMap;

/// A condition of a [`Circuit`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Node(pub(super) u32);

pub(super) const NEVER: Node = Node(0);
pub(super) const ALWAYS: Node = Node(1);

/// How a condition follows from others, or from a state.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Gate {
    Constant(bool),
    /// The fact has this truth value.
    Literal(FactId, bool),
    /// Whether the numbers are in this relation has this truth value.
    Comparison(Relation, Box<Expression<FluentId>>, bool),
    All(Box<[Node]>),
    Any(Box<[Node]>),
    /// The least fixpoint of a recursive component of axioms. The nodes stand for the literals of
    /// its rules that are not its own facts, in order of the rules.
    Fixpoint(u32, Box<[Node]>),
    /// A fact of a fixpoint has this truth value.
    Head(Node, FactId, bool),
}

impl Gate {
    /// The conditions that it reads.
    pub(super) fn inputs(&self) -> &[Node] {
        match self {
            Self::Constant(_) | Self::Literal(..) | Self::Comparison(..) => &[],
            Self::All(inputs) | Self::Any(inputs) | Self::Fixpoint(_, inputs) => inputs,
            Self::Head(fixpoint, ..) => std::slice::from_ref(fixpoint),
        }
    }
}

/// Conditions that share their parts.
#[derive(Clone, Debug)]
pub(super) struct Circuit {
    gates: Vec<Gate>,
    known: FxHashMap<Gate, Node>,
    /// Gates and their inputs.
    size: usize,
}

impl Circuit {
    pub(super) fn new() -> Self {
        let mut circuit = Self { gates: Vec::new(), known: FxHashMap::default(), size: 0 };
        circuit.gate(Gate::Constant(false));
        circuit.gate(Gate::Constant(true));
        circuit
    }

    pub(super) fn get(&self, node: Node) -> &Gate {
        &self.gates[node.0 as usize]
    }

    /// The gates, in order of evaluation.
    pub(super) fn gates(&self) -> &[Gate] {
        &self.gates
    }

    /// How much it holds: gates and their inputs.
    pub(super) fn size(&self) -> usize {
        self.size
    }

    pub(super) fn gate(&mut self, gate: Gate) -> Node {
        if let Some(&node) = self.known.get(&gate) {
            return node;
        }
        let node = Node(id32(self.gates.len()));
        self.size += 1 + gate.inputs().len();
        self.gates.push(gate.clone());
        self.known.insert(gate, node);
        node
    }

    pub(super) fn literal(&mut self, fact: FactId, wanted: bool) -> Node {
        self.gate(Gate::Literal(fact, wanted))
    }

    /// The conjunction of literals, or the disjunction of their opposites.
    pub(super) fn literals(&mut self, literals: LiteralsRef<'_>, wanted: bool) -> Node {
        let nodes = literals.iter().map(|(fact, sign)| self.literal(fact, sign == wanted)).collect();
        if wanted { self.all(nodes) } else { self.any(nodes) }
    }

    pub(super) fn all(&mut self, nodes: Vec<Node>) -> Node {
        self.joined(nodes, ALWAYS, NEVER, Gate::All)
    }

    pub(super) fn any(&mut self, nodes: Vec<Node>) -> Node {
        self.joined(nodes, NEVER, ALWAYS, Gate::Any)
    }

    fn joined(
        &mut self,
        mut nodes: Vec<Node>,
        neutral: Node,
        deciding: Node,
        gate: impl FnOnce(Box<[Node]>) -> Gate,
    ) -> Node {
        if nodes.contains(&deciding) {
            return deciding;
        }
        nodes.retain(|&node| node != neutral);
        nodes.sort_unstable();
        nodes.dedup();
        match nodes.as_slice() {
            [] => neutral,
            &[one] => one,
            _ => self.gate(gate(nodes.into())),
        }
    }

    /// All gates that these read, and these, in order of evaluation.
    pub(super) fn below(&self, roots: impl IntoIterator<Item = Node>) -> Vec<Node> {
        let mut open: Vec<Node> = roots.into_iter().collect();
        let mut found = Vec::new();
        let mut seen = vec![false; self.gates.len()];
        while let Some(node) = open.pop() {
            if !std::mem::replace(&mut seen[node.0 as usize], true) {
                found.push(node);
                open.extend_from_slice(self.get(node).inputs());
            }
        }
        found.sort_unstable();
        found
    }
}
