//! One step of regression: what must hold before an operator so that a condition holds after it.
//!
//! Idea: a literal holds after the operator if an effect brings it about, or if it held before and
//! no effect ends it. A derived fact that the operator may change is replaced by the bodies of its
//! rules; a recursive component of axioms is copied as one gate over what its rules read. Gates are
//! rebuilt from the bottom, and only where something below them changed. Cost: linear in the gates
//! of the condition and in the components of axioms that the operator reaches.

use super::super::{LiteralsRef, Operator, Task, contains};
use super::circuit::{ALWAYS, Circuit, Gate, NEVER, Node};
use super::numbers;
use crate::ids::{FactId, OperatorId};
use rustc_hash::{FxHashMap, FxHashSet};

/// Regression through one operator.
pub(super) struct Step<'a> {
    task: &'a Task,
    operator: Operator<'a>,
    effects: FxHashMap<FactId, Effects<'a>>,
    /// A set bit for each component of axioms whose facts the operator may change.
    reached: Vec<u64>,
    literals: FxHashMap<(FactId, bool), Option<Node>>,
    nodes: FxHashMap<Node, Option<Node>>,
    /// Whether gates may be added to the circuit.
    grows: bool,
}

/// The conditions of the effects on one fact; an empty condition always holds.
#[derive(Default)]
struct Effects<'a> {
    adds: Vec<LiteralsRef<'a>>,
    deletes: Vec<LiteralsRef<'a>>,
}

impl<'a> Step<'a> {
    /// If the circuit may not grow, only literals are regressed, and only to literals.
    pub(super) fn new(task: &'a Task, operator: OperatorId, grows: bool) -> Self {
        let operator = task.operator(operator);
        let mut effects: FxHashMap<FactId, Effects<'a>> = FxHashMap::default();
        let always = LiteralsRef { positive: &[], negative: &[] };
        let own = [(always, operator.adds, operator.deletes)];
        let conditional = operator.conditional.iter().map(|e| (e.condition, e.adds, e.deletes));
        for (condition, adds, deletes) in own.into_iter().chain(conditional) {
            adds.iter().for_each(|&fact| effects.entry(fact).or_default().adds.push(condition));
            deletes.iter().for_each(|&fact| effects.entry(fact).or_default().deletes.push(condition));
        }
        let compared = operator.numeric.into_iter().flat_map(|numeric| &numeric.rechecked);
        let compared = compared.map(|&position| task.numeric.comparisons[position as usize].fact);
        let reached = task.axioms.reached(effects.keys().copied().chain(compared));
        let (literals, nodes) = (FxHashMap::default(), FxHashMap::default());
        Self { task, operator, effects, reached, literals, nodes, grows }
    }

    /// Regresses conditions; [`before`](Self::before) then has the results. Returns the number of
    /// gates that it visited.
    pub(super) fn regress(&mut self, circuit: &mut Circuit, conditions: &[Node]) -> usize {
        if !self.grows {
            return conditions.len();
        }
        let below = circuit.below(conditions.iter().copied());
        let literals = below.iter().filter_map(|&node| match circuit.get(node) {
            &Gate::Literal(fact, wanted) => Some((fact, wanted)),
            _ => None,
        });
        let literals: Vec<_> = literals.collect();
        self.define(circuit, literals);
        for &node in &below {
            let before = self.gate(circuit, node);
            self.nodes.insert(node, before);
        }
        below.len()
    }

    /// The condition before the operator; `None` if it is not regressed.
    pub(super) fn before(&mut self, circuit: &mut Circuit, condition: Node) -> Option<Node> {
        if let Some(&known) = self.nodes.get(&condition) {
            return known;
        }
        match *circuit.get(condition) {
            Gate::Constant(_) => Some(condition),
            Gate::Literal(fact, wanted) => self.literal(circuit, fact, wanted),
            _ => None,
        }
    }

    fn gate(&self, circuit: &mut Circuit, node: Node) -> Option<Node> {
        let mapped = |nodes: &[Node]| nodes.iter().map(|input| self.nodes[input]).collect::<Option<Vec<_>>>();
        let gate = circuit.get(node);
        match gate {
            Gate::Constant(_) => Some(node),
            &Gate::Literal(fact, wanted) => self.literal(circuit, fact, wanted),
            Gate::Comparison(relation, expression, wanted) => match self.operator.numeric {
                Some(effects) if numbers::changes(effects, expression) => {
                    let (relation, expression, wanted) = (*relation, expression.clone(), *wanted);
                    numbers::before(circuit, effects, (relation, &expression), wanted)
                }
                _ => Some(node),
            },
            Gate::All(nodes) => {
                let before = mapped(nodes)?;
                Some(if before[..] == nodes[..] { node } else { circuit.all(before) })
            }
            Gate::Any(nodes) => {
                let before = mapped(nodes)?;
                Some(if before[..] == nodes[..] { node } else { circuit.any(before) })
            }
            &Gate::Fixpoint(component, ref nodes) => {
                let before = mapped(nodes)?;
                Some(circuit.gate(Gate::Fixpoint(component, before.into())))
            }
            &Gate::Head(fixpoint, fact, wanted) => {
                let before = self.nodes[&fixpoint]?;
                Some(circuit.gate(Gate::Head(before, fact, wanted)))
            }
        }
    }

    fn literal(&self, circuit: &mut Circuit, fact: FactId, wanted: bool) -> Option<Node> {
        if let Some(&known) = self.literals.get(&(fact, wanted)) {
            return known;
        }
        let own = &self.task.facts()[fact];
        if own.compares {
            return self.compared(circuit, fact, wanted);
        }
        if own.derived {
            let stays = !self.is_reached(fact);
            return stays.then(|| circuit.literal(fact, wanted));
        }
        let Some(Effects { adds, deletes }) = self.effects.get(&fact) else {
            return Some(circuit.literal(fact, wanted));
        };
        let simple = |conditions: &[LiteralsRef<'_>]| conditions.iter().all(|c| c.is_empty());
        if !(self.grows || simple(adds) && simple(deletes)) {
            return None;
        }
        let fires = |circuit: &mut Circuit, conditions: &[LiteralsRef<'_>], wanted: bool| {
            let nodes = conditions.iter().map(|&c| circuit.literals(c, wanted)).collect();
            if wanted { circuit.any(nodes) } else { circuit.all(nodes) }
        };
        let held = circuit.literal(fact, wanted);
        Some(if wanted {
            let kept = [held, fires(circuit, deletes, false)];
            let kept = circuit.all(kept.into());
            let added = fires(circuit, adds, true);
            circuit.any(vec![added, kept])
        } else {
            let gone = [held, fires(circuit, deletes, true)];
            let gone = circuit.any(gone.into());
            let not_added = fires(circuit, adds, false);
            circuit.all(vec![not_added, gone])
        })
    }

    fn compared(&self, circuit: &mut Circuit, fact: FactId, wanted: bool) -> Option<Node> {
        let effects = self.operator.numeric.into_iter();
        let mut rechecked = effects.flat_map(|effects| effects.rechecked.iter().map(move |&c| (effects, c)));
        let own = rechecked.find_map(|(effects, position)| {
            let comparison = &self.task.numeric.comparisons[position as usize];
            (comparison.fact == fact).then_some((effects, comparison))
        });
        let Some((effects, comparison)) = own else { return Some(circuit.literal(fact, wanted)) };
        if !self.grows {
            return None;
        }
        numbers::before(circuit, effects, (comparison.relation, &comparison.expression), wanted)
    }

    fn is_reached(&self, fact: FactId) -> bool {
        self.task.axioms.component(fact).is_some_and(|c| contains(&self.reached, FactId(c)))
    }

    /// Regresses the derived facts among these literals, and those that they depend on.
    fn define(&mut self, circuit: &mut Circuit, mut open: Vec<(FactId, bool)>) {
        let axioms = &self.task.axioms;
        let mut found = FxHashSet::default();
        while let Some((fact, wanted)) = open.pop() {
            if !self.is_reached(fact) || !found.insert((fact, wanted)) {
                continue;
            }
            let component = axioms.component(fact).expect("it is reached");
            if axioms.is_recursive(component) {
                open.extend(axioms.outside(component));
            } else {
                let bodies = axioms.rules_of(component).iter().flat_map(|rule| rule.body.as_ref().iter());
                open.extend(bodies.map(|(fact, sign)| (fact, sign == wanted)));
            }
        }
        // A component comes after those that it reads.
        let mut found: Vec<_> = found.into_iter().collect();
        found.sort_unstable_by_key(|&(fact, wanted)| (axioms.component(fact), fact, wanted));
        for (fact, wanted) in found {
            let before = self.derived(circuit, fact, wanted);
            self.literals.insert((fact, wanted), before);
        }
    }

    fn derived(&self, circuit: &mut Circuit, fact: FactId, wanted: bool) -> Option<Node> {
        let axioms = &self.task.axioms;
        let component = axioms.component(fact).expect("it is reached");
        let mut same = true;
        let mut before = |circuit: &mut Circuit, (fact, sign): (FactId, bool)| {
            let before = self.literal(circuit, fact, sign)?;
            same &= before == circuit.literal(fact, sign);
            Some(before)
        };
        let node = if axioms.is_recursive(component) {
            let inputs = axioms.outside(component).map(|literal| before(circuit, literal));
            let inputs: Vec<Node> = inputs.collect::<Option<_>>()?;
            let fixpoint = circuit.gate(Gate::Fixpoint(component, inputs.into()));
            circuit.gate(Gate::Head(fixpoint, fact, wanted))
        } else {
            let mut rules = Vec::new();
            for rule in axioms.rules_of(component) {
                let body = rule.body.as_ref().iter().map(|(fact, sign)| (fact, sign == wanted));
                let body: Vec<Node> = body.map(|literal| before(circuit, literal)).collect::<Option<_>>()?;
                rules.push(if wanted { circuit.all(body) } else { circuit.any(body) });
            }
            if wanted { circuit.any(rules) } else { circuit.all(rules) }
        };
        // What the operator does cancels out.
        Some(if same { circuit.literal(fact, wanted) } else { node })
    }
}

/// The conditions of a conjunction.
pub(super) fn conjuncts(circuit: &Circuit, node: Node) -> Vec<Node> {
    match circuit.get(node) {
        Gate::All(nodes) => nodes.to_vec(),
        _ if node == ALWAYS => Vec::new(),
        _ => vec![node],
    }
}

/// Whether the conjunction holds nowhere.
pub(super) fn is_never(nodes: &[Node]) -> bool {
    nodes.contains(&NEVER)
}
