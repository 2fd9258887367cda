//! Axioms as rules: conjunctions that can be joined.
//!
//! Problem: a disjunction binds no variable, so an axiom with a disjunctive body would try every tuple of objects.
//! Idea: it becomes one rule per disjunct. Disjunctions inside conjunctions and existential quantifiers are
//! multiplied out, up to a limit; past it they stay conditions to test. In a rule, positive atoms are *pivots*: when
//! one more atom holds, only the instances of the rule with that atom are new. Everything else that a rule reads is
//! *hidden*: when it changes, all instances of the rule are evaluated.
//!
//! Source: Ullman, "Principles of Database and Knowledge-Base Systems", 1988, ch. 3 (semi-naive evaluation).

use crate::condition::Strictness;
use crate::reads::{each_function, each_predicate};
use crate::scene::{Binding, Clock, Scene};
use crate::solve::Query;
use crate::state::State;
use crate::universe::Universe;
use pddl::model::{
    Atom, Axiom, Condition, ConditionKind, Domain, FunctionId, ObjectId, PredicateId, VariableId, Variables,
};
use std::ops::ControlFlow;

/// The most rules that an axiom may become.
const MOST_BRANCHES: usize = 64;

/// A disjunct of an axiom's body.
#[derive(Clone, Debug)]
pub(super) struct Rule {
    pub(super) head: PredicateId,
    axiom: usize,
    parts: Vec<(Condition, bool)>,
    /// Parameters, then existential variables.
    open: Vec<VariableId>,
    parameters: usize,
    /// The positions and predicates of the parts that are positive atoms.
    pub(super) pivots: Vec<(usize, PredicateId)>,
    /// The predicates that it reads in other ways.
    pub(super) hidden: Vec<PredicateId>,
    /// The functions that it reads.
    pub(super) functions: Vec<FunctionId>,
}

#[derive(Clone, Debug)]
struct Branch {
    parts: Vec<(Condition, bool)>,
    open: Vec<VariableId>,
}

fn multiply(branches: &mut Vec<Branch>, condition: &Condition, wanted: bool) {
    match (&condition.kind, wanted) {
        (ConditionKind::And(parts), true) | (ConditionKind::Or(parts), false) => {
            parts.iter().for_each(|part| multiply(branches, part, wanted));
        }
        (ConditionKind::Or(parts), true) | (ConditionKind::And(parts), false) => {
            let parts: Vec<_> = parts.iter().map(|part| (part, wanted)).collect();
            divide(branches, condition, wanted, &parts);
        }
        (ConditionKind::Imply(if_, then), true) => {
            divide(branches, condition, wanted, &[(if_, false), (then, true)]);
        }
        (ConditionKind::Imply(if_, then), false) => {
            multiply(branches, if_, true);
            multiply(branches, then, false);
        }
        (ConditionKind::Not(part), _) => multiply(branches, part, !wanted),
        (ConditionKind::Exists(variables, body), true) | (ConditionKind::Forall(variables, body), false) => {
            for branch in branches.iter_mut() {
                branch.open.extend(variables);
            }
            multiply(branches, body, wanted);
        }
        _ => branches.iter_mut().for_each(|branch| branch.parts.push((condition.clone(), wanted))),
    }
}

fn divide(branches: &mut Vec<Branch>, whole: &Condition, wanted: bool, parts: &[(&Condition, bool)]) {
    let mut divided = Vec::new();
    for &(part, as_wanted) in parts {
        let mut copies = branches.clone();
        multiply(&mut copies, part, as_wanted);
        divided.append(&mut copies);
        if divided.len() > MOST_BRANCHES {
            branches.iter_mut().for_each(|branch| branch.parts.push((whole.clone(), wanted)));
            return;
        }
    }
    *branches = divided;
}

impl Rule {
    /// The rules of one of the domain's axioms.
    pub(super) fn all(index: usize, axiom: &Axiom) -> Vec<Self> {
        let open: Vec<VariableId> = axiom.variables.parameter_ids().collect();
        let mut branches = vec![Branch { parts: Vec::new(), open }];
        multiply(&mut branches, &axiom.body, true);
        branches.into_iter().map(|branch| Self::new(index, axiom, branch)).collect()
    }

    fn new(index: usize, axiom: &Axiom, branch: Branch) -> Self {
        let mut rule = Self {
            head: axiom.predicate,
            axiom: index,
            parts: branch.parts,
            open: branch.open,
            parameters: axiom.variables.parameters,
            pivots: Vec::new(),
            hidden: Vec::new(),
            functions: Vec::new(),
        };
        for (position, (condition, wanted)) in rule.parts.iter().enumerate() {
            match &condition.kind {
                ConditionKind::Atom(atom) if *wanted => rule.pivots.push((position, atom.predicate)),
                _ => each_predicate(condition, true, &mut |predicate, _| rule.hidden.push(predicate)),
            }
            each_function(condition, &mut |function| rule.functions.push(function));
        }
        rule
    }

    /// The predicates that the rule reads.
    pub(super) fn reads(&self) -> impl Iterator<Item = PredicateId> {
        self.pivots.iter().map(|&(_, predicate)| predicate).chain(self.hidden.iter().copied())
    }

    fn query(&self) -> Query<'_> {
        let parts: Vec<_> = self.parts.iter().map(|(condition, wanted)| (condition, *wanted)).collect();
        Query::new(&self.open, &parts, Strictness::Certain)
    }

    fn scene<'s>(&self, world: World<'s>, state: &'s State) -> (Scene<'s>, &'s Variables) {
        let variables = &world.domain.axioms[self.axiom].variables;
        (Scene { universe: world.universe, state, variables, clock: Clock::steps(0) }, variables)
    }

    /// The heads of its instances: all, or only those in which a pivot is one of these tuples.
    pub(super) fn heads(
        &self,
        world: World<'_>,
        state: &State,
        given: Option<(usize, &mut dyn Iterator<Item = &[ObjectId]>)>,
    ) -> Heads {
        let (scene, variables) = self.scene(world, state);
        let query = self.query();
        let parameters = &self.open[..self.parameters];
        let mut binding = Binding::new(variables, &[]);
        let mut heads = Heads { arity: self.parameters, count: 0, arguments: Vec::new() };
        let mut visit = |binding: &mut Binding| {
            heads.count += 1;
            heads.arguments.extend(parameters.iter().filter_map(|&p| binding.get(p)));
            // One proof is enough for a head without arguments.
            if parameters.is_empty() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let flow = match given {
            None => scene.answer(&query, parameters, &mut binding, &mut visit),
            Some((part, tuples)) => match self.pivot(part) {
                Some(atom) => {
                    scene.answer_with(&query, parameters, (part, atom), tuples, &mut binding, &mut visit)
                }
                None => ControlFlow::Continue(()),
            },
        };
        debug_assert!(flow.is_continue() || parameters.is_empty());
        heads
    }

    fn pivot(&self, part: usize) -> Option<&Atom> {
        match self.parts.get(part) {
            Some((Condition { kind: ConditionKind::Atom(atom), .. }, true)) => Some(atom),
            _ => None,
        }
    }

    /// Whether a head follows by this rule.
    pub(super) fn proves(&self, world: World<'_>, state: &State, head: &[ObjectId]) -> bool {
        let (scene, variables) = self.scene(world, state);
        // Another axiom for the predicate may have wider types.
        let parameters = &self.open[..self.parameters];
        if !parameters.iter().zip(head).all(|(&parameter, &object)| scene.extent(parameter).contains(object))
        {
            return false;
        }
        let mut binding = Binding::new(variables, head);
        scene.answer(&self.query(), &[], &mut binding, &mut |_| ControlFlow::Break(())).is_break()
    }
}

/// The domain and the objects, which are constant while a task is judged.
#[derive(Clone, Copy)]
pub(super) struct World<'a> {
    pub(super) domain: &'a Domain,
    pub(super) universe: &'a Universe,
}

/// Tuples of one predicate in one vector.
#[derive(Debug)]
pub(super) struct Heads {
    arity: usize,
    count: usize,
    arguments: Vec<ObjectId>,
}

impl Heads {
    pub(super) fn each(&self) -> impl Iterator<Item = &[ObjectId]> {
        (0..self.count).map(|n| &self.arguments[n * self.arity..(n + 1) * self.arity])
    }
}
