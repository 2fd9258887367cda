//! What the analyses call impossible happens in no reachable state of random tiny tasks.
//!
//! The tasks are searched exhaustively, by an interpreter that shares nothing with the analyses.

use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::rc::Rc;

use analysis::happening::{Phase, Schema, happenings};
use analysis::intervals::Hulls;
use analysis::invariants::{Counts, Invariant, invariants};
use analysis::reachability::{Origin, Summary, Wording};
use pddl::Source;
use pddl::model::{
    Action, AssignOperator, AssignedValue, Comparison, Condition, ConditionKind, Domain, Effect, EffectKind,
    Expression, ExpressionKind, Idx, ObjectId, PredicateId, Problem, Term, VariableId, Variables,
};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

#[path = "../src/test_support.rs"]
mod test_support;

use test_support::both;

/// States of one task that are explored.
const STATES: usize = 400;

/// Decisions out of random bytes.
struct Dice<'a>(std::slice::Iter<'a, u8>);

impl Dice<'_> {
    fn below(&mut self, n: usize) -> usize {
        usize::from(*self.0.next().unwrap_or(&0)) % n
    }
}

/// Predicates with the types of their arguments.
const PREDICATES: [(&str, &[&str]); 5] =
    [("a", &[]), ("p", &["t"]), ("q", &["u"]), ("r", &["t", "t"]), ("s", &["t", "u"])];

fn atom(dice: &mut Dice<'_>, scope: &[(String, &str)]) -> String {
    let (name, types) = PREDICATES[dice.below(PREDICATES.len())];
    let mut text = format!("({name}");
    for wanted in types {
        let fits: Vec<&String> =
            scope.iter().filter(|(_, t)| t == wanted || *wanted == "t").map(|(n, _)| n).collect();
        if fits.is_empty() {
            return "(a)".to_owned();
        }
        text += &format!(" {}", fits[dice.below(fits.len())]);
    }
    text + ")"
}

fn condition(dice: &mut Dice<'_>, scope: &[(String, &'static str)], depth: usize) -> String {
    match dice.below(if depth == 0 { 6 } else { 11 }) {
        0..=3 => atom(dice, scope),
        4 => format!("(not {})", atom(dice, scope)),
        5 => {
            let operator = ["<", "<=", "=", ">=", ">"][dice.below(5)];
            format!("({operator} (n) {})", dice.below(6))
        }
        6 | 7 => {
            let head = ["and", "or"][dice.below(2)];
            format!("({head} {} {})", condition(dice, scope, depth - 1), condition(dice, scope, depth - 1))
        }
        8 | 9 => {
            let head = ["forall", "exists"][dice.below(2)];
            let type_ = ["t", "u"][dice.below(2)];
            let name = format!("?z{}", scope.len());
            let mut inner = scope.to_vec();
            inner.push((name.clone(), type_));
            format!("({head} ({name} - {type_}) {})", condition(dice, &inner, depth - 1))
        }
        _ => {
            let mut term =
                || scope.get(dice.below(scope.len().max(1))).map_or("x".to_owned(), |(n, _)| n.clone());
            format!("(not (= {} {}))", term(), term())
        }
    }
}

fn effect(dice: &mut Dice<'_>, scope: &[(String, &'static str)]) -> String {
    match dice.below(8) {
        0..=3 => atom(dice, scope),
        4 => format!("(not {})", atom(dice, scope)),
        5 => format!("({} (n) {})", ["assign", "increase", "decrease"][dice.below(3)], dice.below(3)),
        6 => format!("(when {} {})", condition(dice, scope, 1), atom(dice, scope)),
        _ => {
            let mut inner = scope.to_vec();
            inner.push(("?e".to_owned(), "u"));
            format!("(forall (?e - u) {})", atom(dice, &inner))
        }
    }
}

fn task(dice: &mut Dice<'_>) -> (String, String) {
    let constants: Vec<(String, &'static str)> = vec![("x".into(), "t"), ("y".into(), "u")];
    let mut domain = "(define (domain d) (:requirements :adl :numeric-fluents :typing)
        (:types u - t t - object) (:constants x - t y - u) (:functions (n))
        (:predicates (a) (p ?1 - t) (q ?1 - u) (r ?1 ?2 - t) (s ?1 - t ?2 - u))\n"
        .to_owned();
    for i in 0..3 {
        let mut scope = constants.clone();
        scope.push(("?v".into(), ["t", "u"][dice.below(2)]));
        scope.push(("?w".into(), ["t", "u"][dice.below(2)]));
        let mut conditions: Vec<String> =
            (0..1 + dice.below(3)).map(|_| condition(dice, &scope, 2)).collect();
        let mut effects: Vec<String> = (0..1 + dice.below(3)).map(|_| effect(dice, &scope)).collect();
        // Something that moves, so that there are invariants.
        if dice.below(2) == 0 {
            let from = atom(dice, &scope);
            let to = atom(dice, &scope);
            effects = vec![format!("(not {from})"), to];
            conditions.push(from);
        }
        domain += &format!(
            "(:action a{i} :parameters (?v - {} ?w - {}) :precondition (and {}) :effect (and {}))\n",
            scope[2].1,
            scope[3].1,
            conditions.join(" "),
            effects.join(" ")
        );
    }
    let mut objects = constants;
    objects.push(("z".into(), "u"));
    let init: Vec<String> = (0..dice.below(5)).map(|_| atom(dice, &objects)).collect();
    let goal: Vec<String> = (0..2).map(|_| condition(dice, &objects, 1)).collect();
    let number = dice.below(4);
    let problem = format!(
        "(define (problem p) (:domain d) (:objects z - u) (:init (= (n) {number}) {}) (:goal (and {})))",
        init.join(" "),
        goal.join(" ")
    );
    (domain + ")", problem)
}

type State = (BTreeSet<(u32, Vec<u32>)>, i64);

struct Interpreter<'a> {
    domain: &'a Domain,
    problem: &'a Problem,
}

impl Interpreter<'_> {
    fn objects(&self, variables: &Variables, slot: VariableId) -> Vec<u32> {
        let types = &self.domain.types;
        let fits = |o: &ObjectId| self.problem.objects[*o].is_of(&variables[slot].types, types);
        self.problem.objects.ids().filter(fits).map(|o| o.0).collect()
    }

    fn each(
        &self,
        variables: &Variables,
        slots: &[VariableId],
        binding: &[u32],
        visit: &mut dyn FnMut(&[u32]),
    ) {
        let Some((first, rest)) = slots.split_first() else { return visit(binding) };
        for object in self.objects(variables, *first) {
            let mut binding = binding.to_vec();
            binding[first.index()] = object;
            self.each(variables, rest, &binding, visit);
        }
    }

    fn holds(&self, of: &Condition, variables: &Variables, binding: &[u32], state: &State) -> bool {
        let again = |c: &Condition| self.holds(c, variables, binding, state);
        match &of.kind {
            ConditionKind::And(parts) => parts.iter().all(again),
            ConditionKind::Or(parts) => parts.iter().any(again),
            ConditionKind::Not(inner) => !again(inner),
            ConditionKind::Exists(slots, inner) | ConditionKind::Forall(slots, inner) => {
                let (mut all, mut any) = (true, false);
                self.each(variables, slots, binding, &mut |b| {
                    let holds = self.holds(inner, variables, b, state);
                    all &= holds;
                    any |= holds;
                });
                if matches!(of.kind, ConditionKind::Forall(..)) { all } else { any }
            }
            ConditionKind::Atom(a) => state.0.contains(&(a.predicate.0, ground(&a.arguments, binding))),
            ConditionKind::Same(a, b) => value(*a, binding) == value(*b, binding),
            ConditionKind::Compare(comparison, a, b) => {
                let (a, b) = (number(a, state), number(b, state));
                match comparison {
                    Comparison::Less => a < b,
                    Comparison::LessEqual => a <= b,
                    Comparison::Equal => a == b,
                    Comparison::GreaterEqual => a >= b,
                    Comparison::Greater => a > b,
                }
            }
            _ => unreachable!("no task has it"),
        }
    }

    /// Adds, deletes, the new number, and the conditional effects that happened.
    fn apply(
        &self,
        action: &Action,
        binding: &[u32],
        state: &State,
        happened: &mut Vec<pddl::Span>,
    ) -> State {
        let (mut adds, mut deletes, mut n) = (BTreeSet::new(), BTreeSet::new(), state.1);
        let mut open: Vec<(&Effect, Vec<u32>)> = vec![(&action.effect, binding.to_vec())];
        while let Some((effect, binding)) = open.pop() {
            match &effect.kind {
                EffectKind::And(parts) => open.extend(parts.iter().map(|p| (p, binding.clone()))),
                EffectKind::Add(a) => {
                    adds.insert((a.predicate.0, ground(&a.arguments, &binding)));
                }
                EffectKind::Delete(a) => {
                    deletes.insert((a.predicate.0, ground(&a.arguments, &binding)));
                }
                EffectKind::Forall(slots, inner) => {
                    self.each(&action.variables, slots, &binding, &mut |b| open.push((inner, b.to_vec())));
                }
                EffectKind::When(when, inner) => {
                    if self.holds(when, &action.variables, &binding, state) {
                        happened.push(when.span);
                        open.push((inner, binding));
                    }
                }
                EffectKind::Assign(operator, _, AssignedValue::Number(by)) => {
                    let by = number(by, state);
                    n = match operator {
                        AssignOperator::Assign => by,
                        AssignOperator::Increase => n + by,
                        _ => n - by,
                    };
                }
                EffectKind::Assign(..) => unreachable!("no task has it"),
            }
        }
        let mut atoms: BTreeSet<_> = state.0.difference(&deletes).cloned().collect();
        atoms.extend(adds);
        (atoms, n)
    }
}

fn value(term: Term, binding: &[u32]) -> u32 {
    match term {
        Term::Object(o) => o.0,
        Term::Variable(v) => binding[v.index()],
    }
}

fn ground(terms: &[Term], binding: &[u32]) -> Vec<u32> {
    terms.iter().map(|&t| value(t, binding)).collect()
}

#[allow(clippy::cast_possible_truncation, reason = "the tasks' numbers are small and whole")]
fn number(of: &Expression, state: &State) -> i64 {
    match of.kind {
        ExpressionKind::Number(n) => n as i64,
        _ => state.1,
    }
}

/// All reachable states, up to a number, with what happened on the way.
fn explore(domain: &Domain, problem: &Problem) -> (Vec<State>, BTreeSet<Origin>) {
    let run = Interpreter { domain, problem };
    let atoms = problem.init.iter().map(|f| (f.predicate.0, f.arguments.iter().map(|o| o.0).collect()));
    let value = problem.fluents.first().map_or(0, |f| match f.value {
        #[allow(clippy::cast_possible_truncation, reason = "the tasks' numbers are small and whole")]
        pddl::model::FluentValue::Number(n) => n as i64,
        pddl::model::FluentValue::Object(_) => 0,
    });
    let start: State = (atoms.collect(), value);
    let mut seen = BTreeSet::from([start.clone()]);
    let mut queue = VecDeque::from([start]);
    let (mut states, mut happened) = (Vec::new(), BTreeSet::new());
    while let Some(state) = queue.pop_front() {
        for (id, action) in domain.actions.enumerate() {
            let slots: Vec<VariableId> = action.variables.parameter_ids().collect();
            let none = vec![u32::MAX; action.variables.slots.len()];
            run.each(&action.variables, &slots, &none, &mut |binding| {
                if !run.holds(&action.precondition, &action.variables, binding, &state) {
                    return;
                }
                let mut whens = Vec::new();
                let next = run.apply(action, binding, &state, &mut whens);
                let whole = Origin { schema: Schema::Action(id), phase: Phase::Whole, when: None };
                happened.extend(whens.into_iter().map(|w| Origin { when: Some(w), ..whole.clone() }));
                happened.insert(whole);
                if seen.len() < STATES && seen.insert(next.clone()) {
                    queue.push_back(next);
                }
            });
        }
        states.push(state);
    }
    (states, happened)
}

#[test]
fn what_is_called_impossible_never_happens() {
    let mut runner = TestRunner::new_with_rng(
        Config { cases: 300, ..Config::default() },
        proptest::test_runner::TestRng::deterministic_rng(proptest::test_runner::RngAlgorithm::ChaCha),
    );
    let (silent, goals, exclusions) = (Cell::new(0), Cell::new(0), Cell::new(0));
    runner
        .run(&proptest::collection::vec(any::<u8>(), 160), |bytes| {
            let (domain_text, problem_text) = task(&mut Dice(bytes.iter()));
            let (domain, problem) = both(&domain_text, &problem_text);
            let (domain_source, problem_source) =
                (Source::new("domain", &*domain_text), Source::new("problem", &*problem_text));
            let wording = Wording {
                domain: &domain,
                problem: Some(&problem),
                domain_source: &domain_source,
                problem_source: Some(&problem_source),
            };
            let hulls = Rc::new(Hulls::new(&domain, Some(&problem)));
            let summary = Summary::new(&wording, &hulls).expect("the task is small");
            let found = invariants(&domain, &happenings(&domain)).into_iter();
            let found: Vec<(Invariant, Counts)> =
                found.filter_map(|i| Counts::new(&i, &problem).map(|counts| (i, counts))).collect();
            let (states, happened) = explore(&domain, &problem);
            for origin in &summary.silent {
                prop_assert!(
                    !happened.contains(origin),
                    "{} happens\n{domain_text}\n{problem_text}",
                    wording.title(origin)
                );
            }
            let run = Interpreter { domain: &domain, problem: &problem };
            for goal in &summary.goals {
                let mut binding = vec![u32::MAX; problem.goal_variables.slots.len()];
                goal.values.iter().for_each(|&(v, o)| binding[v.index()] = o.0);
                let holds = |s: &State| run.holds(goal.condition, &problem.goal_variables, &binding, s);
                prop_assert!(!states.iter().any(holds), "{}\n{domain_text}\n{problem_text}", goal.reason);
            }
            for (invariant, counts) in &found {
                for state in &states {
                    let mut held = BTreeMap::new();
                    for (predicate, arguments) in &state.0 {
                        let Some(member) = invariant.member(PredicateId(*predicate)) else {
                            continue;
                        };
                        let arguments: Vec<ObjectId> = arguments.iter().map(|&o| ObjectId(o)).collect();
                        *held.entry(member.instance(&arguments)).or_insert(0) += 1;
                    }
                    for (instance, count) in held {
                        let kept = count <= 1 || !counts.is_exclusive(&instance);
                        prop_assert!(kept, "{invariant:?}\n{domain_text}\n{problem_text}");
                    }
                }
            }
            exclusions.set(exclusions.get() + found.len());
            silent.set(silent.get() + summary.silent.len());
            goals.set(goals.get() + summary.goals.len());
            Ok(())
        })
        .unwrap_or_else(|e| panic!("{e}"));
    let found = [silent.get(), goals.get(), exclusions.get()];
    assert!(found.iter().all(|&n| n > 20), "{found:?}");
}
