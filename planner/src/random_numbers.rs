//! Random small tasks with numbers, compared with an exhaustive search that shares no code with
//! ours.
//!
//! Values are multiples of powers of one half, which doubles represent exactly, so the brute force
//! is as exact as rationals. Fluents may be undefined, effects may disagree, and most state spaces
//! are infinite. The brute force reports whether it has seen every state; only then may its missing
//! plan contradict a plan of ours.

use crate::heuristics::{Estimate, HeuristicKind};
use crate::search::{Outcome, Query, SearchConfiguration, solve};
use crate::test_support::Grounded;
use budget::Budget;
use proptest::prelude::*;
use std::collections::{HashMap, VecDeque};
use std::fmt::Write;

const FACTS: usize = 3;
const NUMBERS: usize = 3;
/// The states that the brute force visits.
const STATES: usize = 500;
/// The number of states in which every heuristic is checked.
const FEW: usize = 60;

#[derive(Clone, Debug)]
enum Term {
    Constant(i32),
    Fluent(usize),
    Binary(char, Box<Term>, Box<Term>),
}

#[derive(Clone, Debug)]
enum Test {
    Fact(usize),
    Compare(&'static str, Term, Term),
    Not(Box<Test>),
    Or(Box<Test>, Box<Test>),
}

#[derive(Clone, Debug)]
enum Change {
    Fact(usize, bool),
    Number(&'static str, usize, Term),
    Undefine(usize),
}

#[derive(Clone, Debug)]
struct RandomAction {
    needs: Vec<Test>,
    effects: Vec<Change>,
    when: Option<(Test, Change)>,
}

#[derive(Clone, Debug)]
pub(crate) struct RandomTask {
    actions: Vec<RandomAction>,
    facts: [bool; FACTS],
    /// The initial numbers, in halves.
    numbers: [Option<i32>; NUMBERS],
    goal: Vec<Test>,
    metric: Option<(bool, Term)>,
}

type State = ([bool; FACTS], [Option<f64>; NUMBERS]);

fn term() -> impl Strategy<Value = Term> {
    let leaf = prop_oneof![(-4..8_i32).prop_map(Term::Constant), (0..NUMBERS).prop_map(Term::Fluent)];
    leaf.prop_recursive(2, 4, 2, |inner| {
        (prop::sample::select(vec!['+', '-', '*', '/']), inner.clone(), inner)
            .prop_map(|(op, a, b)| Term::Binary(op, Box::new(a), Box::new(b)))
    })
}

fn test() -> impl Strategy<Value = Test> {
    let relation = prop::sample::select(vec!["<", "<=", "=", ">=", ">"]);
    let leaf = prop_oneof![
        (0..FACTS).prop_map(Test::Fact),
        (relation, term(), term()).prop_map(|(r, a, b)| Test::Compare(r, a, b)),
    ];
    leaf.prop_recursive(2, 3, 2, |inner| {
        prop_oneof![
            inner.clone().prop_map(|t| Test::Not(Box::new(t))),
            (inner.clone(), inner).prop_map(|(a, b)| Test::Or(Box::new(a), Box::new(b))),
        ]
    })
}

fn change() -> impl Strategy<Value = Change> {
    let operator =
        prop::sample::select(vec!["assign", "increase", "increase", "decrease", "scale-up", "scale-down"]);
    prop_oneof![
        3 => (0..FACTS, any::<bool>()).prop_map(|(f, b)| Change::Fact(f, b)),
        6 => (operator, 0..NUMBERS, term()).prop_map(|(o, f, t)| Change::Number(o, f, t)),
        1 => (0..NUMBERS).prop_map(Change::Undefine),
    ]
}

pub(crate) fn random_task() -> impl Strategy<Value = RandomTask> {
    let action = (
        prop::collection::vec(test(), 0..3),
        prop::collection::vec(change(), 1..4),
        prop::option::of((test(), change())),
    )
        .prop_map(|(needs, effects, when)| RandomAction { needs, effects, when });
    (
        prop::collection::vec(action, 1..4),
        any::<[bool; FACTS]>(),
        prop::array::uniform3(prop::option::weighted(0.8, -4..8_i32)),
        prop::collection::vec(test(), 1..3),
        prop::option::of((any::<bool>(), term())),
    )
        .prop_map(|(actions, facts, numbers, goal, metric)| RandomTask {
            actions,
            facts,
            numbers,
            goal,
            metric,
        })
}

/// The brute force stops at a value that a double may not represent.
#[derive(Debug)]
struct Unclear;

impl Term {
    fn text(&self) -> String {
        match self {
            Self::Constant(halves) => (f64::from(*halves) / 2.0).to_string(),
            Self::Fluent(f) => format!("(x{f})"),
            Self::Binary(op, a, b) => format!("({op} {} {})", a.text(), b.text()),
        }
    }

    fn value(&self, state: &State) -> Result<Option<f64>, Unclear> {
        let value = match self {
            Self::Constant(halves) => Some(f64::from(*halves) / 2.0),
            Self::Fluent(f) => state.1[*f],
            Self::Binary(op, a, b) => match (a.value(state)?, b.value(state)?) {
                (Some(a), Some(b)) => match op {
                    '+' => Some(a + b),
                    '-' => Some(a - b),
                    '*' => Some(a * b),
                    _ if b == 0.0 => None,
                    _ => Some(a / b),
                },
                _ => None,
            },
        };
        clear(value)
    }
}

fn clear(value: Option<f64>) -> Result<Option<f64>, Unclear> {
    match value {
        Some(v) if v.abs() > 1000.0 || (v * 65536.0).fract() != 0.0 => Err(Unclear),
        value => Ok(value),
    }
}

impl Test {
    fn text(&self) -> String {
        match self {
            Self::Fact(f) => format!("(p{f})"),
            Self::Compare(r, a, b) => format!("({r} {} {})", a.text(), b.text()),
            Self::Not(t) => format!("(not {})", t.text()),
            Self::Or(a, b) => format!("(or {} {})", a.text(), b.text()),
        }
    }

    /// Whether the test certainly has the wanted result.
    fn is(&self, wanted: bool, state: &State) -> Result<bool, Unclear> {
        Ok(match self {
            Self::Fact(f) => state.0[*f] == wanted,
            Self::Compare(r, a, b) => match (a.value(state)?, b.value(state)?) {
                (Some(a), Some(b)) => {
                    let holds = match *r {
                        "<" => a < b,
                        "<=" => a <= b,
                        "=" => a == b,
                        ">=" => a >= b,
                        _ => a > b,
                    };
                    holds == wanted
                }
                _ => false,
            },
            Self::Not(t) => t.is(!wanted, state)?,
            Self::Or(a, b) if wanted => a.is(true, state)? || b.is(true, state)?,
            Self::Or(a, b) => a.is(false, state)? && b.is(false, state)?,
        })
    }
}

impl RandomTask {
    pub(crate) fn text(&self) -> (String, String) {
        let list = |tests: &[Test]| tests.iter().map(Test::text).collect::<Vec<_>>().join(" ");
        let change = |change: &Change| match change {
            Change::Fact(f, true) => format!("(p{f})"),
            Change::Fact(f, false) => format!("(not (p{f}))"),
            Change::Number(op, f, term) => format!("({op} (x{f}) {})", term.text()),
            Change::Undefine(f) => format!("(assign (x{f}) undefined)"),
        };
        let mut domain =
            String::from("(define (domain r) (:requirements :adl :numeric-fluents)\n(:predicates");
        (0..FACTS).for_each(|f| write!(domain, " (p{f})").unwrap());
        domain.push_str(")\n(:functions");
        (0..NUMBERS).for_each(|f| write!(domain, " (x{f}) - number").unwrap());
        domain.push_str(")\n");
        for (i, action) in self.actions.iter().enumerate() {
            let when = action.when.as_ref().map(|(t, c)| format!("(when {} {})", t.text(), change(c)));
            let effects: Vec<String> = action.effects.iter().map(change).collect();
            writeln!(
                domain,
                "(:action a{i} :parameters () :precondition (and {}) :effect (and {} {}))",
                list(&action.needs),
                effects.join(" "),
                when.unwrap_or_default()
            )
            .unwrap();
        }
        domain.push(')');
        let mut init: Vec<String> =
            (0..FACTS).filter(|&f| self.facts[f]).map(|f| format!("(p{f})")).collect();
        for (f, value) in self.numbers.iter().enumerate() {
            init.extend(value.map(|halves| format!("(= (x{f}) {})", f64::from(halves) / 2.0)));
        }
        let metric = self.metric.as_ref().map(|(least, term)| {
            format!("(:metric {} {})", if *least { "minimize" } else { "maximize" }, term.text())
        });
        let problem = format!(
            "(define (problem q) (:domain r) (:init {}) (:goal (and {})) {})",
            init.join(" "),
            list(&self.goal),
            metric.unwrap_or_default()
        );
        (domain, problem)
    }

    fn apply(&self, state: &State, action: &RandomAction) -> Result<Option<State>, Unclear> {
        for need in &action.needs {
            if !need.is(true, state)? {
                return Ok(None);
            }
        }
        let mut effects: Vec<&Change> = action.effects.iter().collect();
        if let Some((test, change)) = &action.when
            && test.is(true, state)?
        {
            effects.push(change);
        }
        let mut next = *state;
        let mut by_fluent: HashMap<usize, Vec<(&str, Option<f64>)>> = HashMap::new();
        for effect in &effects {
            match effect {
                Change::Fact(f, false) => next.0[*f] = false,
                Change::Fact(..) => {}
                Change::Undefine(f) => by_fluent.entry(*f).or_default().push(("=", None)),
                Change::Number(op, f, term) => {
                    let Some(value) = term.value(state)? else { return Ok(None) };
                    let (kind, value) = match *op {
                        "assign" => ("=", value),
                        "increase" => ("+", value),
                        "decrease" => ("+", -value),
                        "scale-up" => ("*", value),
                        _ if value == 0.0 => return Ok(None),
                        _ => ("*", 1.0 / value),
                    };
                    by_fluent.entry(*f).or_default().push((kind, Some(value)));
                }
            }
        }
        effects.iter().for_each(|effect| {
            if let Change::Fact(f, true) = effect {
                next.0[*f] = true;
            }
        });
        for (fluent, changes) in by_fluent {
            let (kind, first) = changes[0];
            if changes.iter().any(|&(k, v)| k != kind || (kind == "=" && v != first)) {
                return Ok(None);
            }
            let before = state.1[fluent];
            next.1[fluent] = match (kind, before) {
                ("=", _) => first,
                (_, None) => return Ok(None),
                ("+", Some(x)) => Some(changes.iter().filter_map(|c| c.1).fold(x, |a, b| a + b)),
                (_, Some(x)) => Some(changes.iter().filter_map(|c| c.1).fold(x, |a, b| a * b)),
            };
            for (_, value) in changes {
                clear(value)?;
            }
            clear(next.1[fluent])?;
        }
        Ok(Some(next))
    }

    /// The length of a shortest plan, if one was found, and whether every state was seen.
    pub(crate) fn shortest(&self) -> (Option<usize>, bool) {
        let start = (self.facts, self.numbers.map(|n| n.map(|halves| f64::from(halves) / 2.0)));
        let key = |s: &State| (s.0, s.1.map(|n| n.map(|v| (v + 0.0).to_bits())));
        let mut depth = HashMap::from([(key(&start), 0)]);
        let mut queue = VecDeque::from([start]);
        let mut all = true;
        while let Some(state) = queue.pop_front() {
            let here = depth[&key(&state)];
            match self.goal.iter().try_fold(true, |all, t| t.is(true, &state).map(|holds| all && holds)) {
                Ok(true) => return (Some(here), all),
                Ok(false) => {}
                Err(Unclear) => all = false,
            }
            for action in &self.actions {
                match self.apply(&state, action) {
                    Err(Unclear) => all = false,
                    Ok(None) => {}
                    Ok(Some(_)) if depth.len() >= STATES => all = false,
                    Ok(Some(next)) => {
                        depth.entry(key(&next)).or_insert_with(|| {
                            queue.push_back(next);
                            here + 1
                        });
                    }
                }
            }
        }
        (None, all)
    }
}

/// Checks one answer with the validator and the brute force.
fn check(
    configuration: &SearchConfiguration,
    grounded: &Grounded,
    (shortest, all): (Option<usize>, bool),
) -> Result<(), TestCaseError> {
    let (name, task) = (configuration.name, &grounded.task);
    let budget = Budget { work: Some(4 * STATES as u64), ..Budget::default() };
    match solve(task, &Query::of(task), configuration, &budget).outcome {
        Outcome::Solved(plan) => {
            match grounded.verdict(&plan.operators) {
                validator::Verdict::Valid(valid) => {
                    let quality =
                        task.quality(task.initial_state(), &plan.operators).map(crate::Number::to_f64);
                    if let (Some(quality), Some(metric)) = (quality, valid.metric) {
                        let sign = match metric.objective {
                            pddl::model::Objective::Minimize => 1.0,
                            pddl::model::Objective::Maximize => -1.0,
                        };
                        prop_assert_eq!(sign * quality, metric.value.to_f64(), "{}", name);
                    }
                }
                verdict => prop_assert!(false, "{name}: {verdict:?}"),
            }
            prop_assert!(shortest.is_some() || !all, "{name}: brute force finds what the search finds");
            if let (Some(best), true, true) = (shortest, all, task.operators().iter().all(|o| o.cost == 1)) {
                prop_assert!(plan.operators.len() >= best, "{name}: shorter than the shortest");
                prop_assert!(!configuration.optimal || plan.operators.len() == best, "{name}: too long");
            }
        }
        Outcome::Unsolvable(reason) => prop_assert_eq!(shortest, None, "{}: {:?}", name, reason),
        // The space may be infinite beyond the states that the brute force needed.
        Outcome::LimitReached(limit) => {
            let finite = all && shortest.is_none();
            prop_assert!(!finite || !configuration.complete, "{name}: {limit:?}");
        }
        Outcome::Unsupported(_) => prop_assert!(configuration.optimal && !task.has_additive_costs()),
    }
    Ok(())
}

proptest! {
    #[test]
    fn every_search_answers_as_brute_force_does(random in random_task()) {
        let grounded = Grounded::new(random.text());
        let known = random.shortest();
        for configuration in SearchConfiguration::ALL {
            check(configuration, &grounded, known)?;
        }
    }

    #[test]
    fn comparisons_follow_the_numbers(random in random_task(), choices in prop::collection::vec(any::<prop::sample::Index>(), 8)) {
        let Grounded { task, .. } = Grounded::new(random.text());
        let mut state = task.initial_state().clone();
        for choice in choices {
            let applicable = task.applicable(&state);
            if applicable.is_empty() {
                break;
            }
            let Some(next) = task.successor(&state, *choice.get(&applicable)) else { break };
            state = next;
            // Setting every number to its own value evaluates all comparisons again.
            let numbers: Vec<_> = task.numbers(&state).collect();
            prop_assert_eq!(&task.with_numbers(&state, numbers), &state);
        }
    }

    /// No heuristic reports a dead end in a state from which the goal is reachable, and no
    /// admissible one overestimates.
    #[test]
    fn estimates_are_safe_everywhere(random in random_task()) {
        let grounded = Grounded::new(random.text());
        let task = &grounded.task;
        prop_assume!(task.goal().impossible.is_none());
        let mut states = vec![(task.initial_state().clone(), Vec::new())];
        let mut known = HashMap::from([(task.initial_state().clone(), 0)]);
        let mut at = 0;
        while at < states.len() && states.len() < FEW {
            let state = states[at].0.clone();
            for operator in task.applicable(&state) {
                let Some(next) = task.successor(&state, operator) else { continue };
                let new = states.len();
                let child = *known.entry(next.clone()).or_insert(new);
                if child == new {
                    states.push((next, Vec::new()));
                }
                states[child].1.push((at, u64::from(task.operators().cost(operator))));
            }
            at += 1;
        }
        // The cheapest cost from each state to a goal, by relaxation until nothing changes.
        let goals = states.iter().map(|(s, _)| if task.satisfies(s, task.goal()) { 0 } else { u64::MAX });
        let mut costs: Vec<u64> = goals.collect();
        let mut changed = true;
        while std::mem::take(&mut changed) {
            for child in 0..states.len() {
                for &(parent, cost) in &states[child].1 {
                    let through = costs[child].saturating_add(cost);
                    changed |= through < costs[parent];
                    costs[parent] = costs[parent].min(through);
                }
            }
        }
        let seen_all = at == states.len();
        for ((state, _), cost) in states.iter().zip(costs).filter(|(_, cost)| *cost < u64::MAX) {
            for &kind in HeuristicKind::ALL {
                let (estimate, _) = grounded.estimate(kind, state);
                prop_assert!(estimate != Estimate::DEAD_END, "{kind:?} is not safe");
                let below = u64::from(estimate.0) <= cost;
                prop_assert!(below || !seen_all || !kind.properties().admissible, "{kind:?}: {estimate:?} of {cost}");
            }
        }
    }
}
