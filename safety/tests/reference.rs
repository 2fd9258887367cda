//! The monitor against a second evaluator, which looks at whole runs: on random formulas and random runs both find the
//! same bindings broken.
//!
//! The evaluator is the definition of PDDL3 on finite traces, read off the paper: quantify over positions, compare times.
//! Time is dense for the monitor, so the evaluator looks at each state again at each half second that it lasts. It shares
//! no code with the monitor.

#![allow(clippy::unwrap_used, clippy::cast_possible_truncation, reason = "a test fails by panicking")]

use dsr::{AgentId, Time, Transaction};
use pddl::model::{Condition, ConditionKind, Constraint, ConstraintKind, Domain, Idx, Term, VariableId};
use pddl::{Source, parse_domain, parse_problem};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use safety::{Invariants, Monitor};
use std::collections::BTreeSet;
use std::sync::Arc;
use vocabulary::Tokens;

const WARD: &str = "(define (domain ward) (:requirements :typing :vocabulary)
    (:types person state - object) (:constants red green - state)
    (:predicates (is ?p - person ?s - state)))";
const PEOPLE: [&str; 2] = ["ann", "bob"];
const STATES: [&str; 2] = ["red", "green"];

/// What is true in a version: person and state.
type State = BTreeSet<(usize, usize)>;

struct Run {
    /// Each version with its time in half seconds.
    states: Vec<(u64, State)>,
    end: u64,
}

struct Dice(Pcg64Mcg);

impl Dice {
    fn roll(&mut self, sides: u64) -> u64 {
        self.0.next_u64() % sides
    }

    fn condition(&mut self, depth: u64) -> String {
        match self.roll(if depth == 0 { 3 } else { 8 }) {
            0 | 1 => format!("(is ?p {})", STATES[self.roll(2) as usize]),
            2 => format!("(is {} {})", PEOPLE[self.roll(2) as usize], STATES[self.roll(2) as usize]),
            3 => format!("(not {})", self.condition(depth - 1)),
            4 => format!("(and {} {})", self.condition(depth - 1), self.condition(depth - 1)),
            5 => format!("(or {} {})", self.condition(depth - 1), self.condition(depth - 1)),
            6 => format!("(exists (?q - person) (and (is ?q red) {}))", self.condition(depth - 1)),
            _ => format!("(forall (?q - person) (or (is ?q green) {}))", self.condition(depth - 1)),
        }
    }

    /// A constraint below an operator, or at the top, where it needs an operator.
    fn constraint(&mut self, depth: u64, top: bool) -> String {
        if !top && (depth == 0 || self.roll(3) > 0) {
            return self.condition(1);
        }
        if top && self.roll(8) == 0 {
            return format!("(not {})", self.constraint(depth, true));
        }
        let depth = depth.saturating_sub(1);
        let time = self.roll(6);
        match self.roll(13) {
            0 | 1 => format!("(always {})", self.constraint(depth, false)),
            2 => format!("(sometime {})", self.constraint(depth, false)),
            3 => format!("(within {time} {})", self.constraint(depth, false)),
            4 | 5 => {
                let (if_, then) = (self.condition(1), self.constraint(depth, false));
                format!("(always-within {time} {if_} {then})")
            }
            6 => format!("(sometime-after {} {})", self.condition(1), self.constraint(depth, false)),
            7 => format!("(sometime-before {} {})", self.condition(1), self.condition(1)),
            8 => format!("(at-most-once {})", self.condition(1)),
            9 => format!("(at end {})", self.constraint(depth, false)),
            10 if top => format!("(hold-after {time} {})", self.condition(1)),
            11 if top => format!("(hold-during {time} {} {})", time + 1 + self.roll(5), self.condition(1)),
            _ => format!("(always (imply {} {}))", self.condition(1), self.constraint(depth, false)),
        }
    }

    fn run(&mut self) -> Run {
        let mut states = vec![(0, State::new())];
        let mut time = 0;
        for _ in 0..self.roll(9) {
            time += 2 * self.roll(4);
            let mut state = states.last().unwrap().1.clone();
            for _ in 0..=self.roll(2) {
                let token = (self.roll(2) as usize, self.roll(2) as usize);
                if !state.remove(&token) {
                    state.insert(token);
                }
            }
            if state != states.last().unwrap().1 {
                states.push((time, state));
            }
        }
        Run { states, end: time + 2 * self.roll(4) }
    }
}

/// The run with each state at each half second that it lasts.
fn dense(run: &Run) -> Run {
    let mut states = Vec::new();
    for (at, (begins, state)) in run.states.iter().enumerate() {
        let ends = run.states.get(at + 1).map_or(run.end + 1, |next| next.0);
        states.push((*begins, state.clone()));
        states.extend((begins + 1..ends).map(|moment| (moment, state.clone())));
    }
    Run { states, end: run.end }
}

/// The definition: whether a constraint holds from a position on.
struct Definition<'a> {
    domain: &'a Domain,
    run: &'a Run,
}

impl Definition<'_> {
    fn holds(&self, constraint: &Constraint, at: usize, who: &mut Vec<Option<usize>>) -> bool {
        use ConstraintKind as K;
        let states = &self.run.states;
        let time = |i: usize| states[i].0;
        let seconds = |d: pddl::Decimal| 2 * d.to_f64() as u64;
        let later = at..states.len();
        match &constraint.kind {
            K::Holds(condition) => self.state(condition, at, who),
            K::And(parts) => parts.iter().all(|part| self.holds(part, at, who)),
            K::Or(parts) => parts.iter().any(|part| self.holds(part, at, who)),
            K::Not(part) => !self.holds(part, at, who),
            K::Imply(if_, then) => !self.holds(if_, at, who) || self.holds(then, at, who),
            K::Forall(..) | K::Exists(..) => unreachable!("the dice make none outside conditions"),
            K::AtEnd(part) => self.holds(part, states.len() - 1, who),
            K::Always(part) => later.clone().all(|i| self.holds(part, i, who)),
            K::Sometime(part) => later.clone().any(|i| self.holds(part, i, who)),
            K::Within(t, part) => {
                later.clone().any(|i| time(i) <= time(at) + seconds(*t) && self.holds(part, i, who))
            }
            K::AtMostOnce(part) => {
                let truths: Vec<bool> = later.clone().map(|i| self.holds(part, i, who)).collect();
                let rises = truths.windows(2).filter(|pair| !pair[0] && pair[1]).count();
                rises + usize::from(truths[0]) <= 1
            }
            K::SometimeAfter(if_, then) => later
                .clone()
                .all(|i| !self.holds(if_, i, who) || (i..states.len()).any(|j| self.holds(then, j, who))),
            K::SometimeBefore(if_, then) => {
                later.clone().all(|i| !self.holds(if_, i, who) || (at..i).any(|j| self.holds(then, j, who)))
            }
            K::AlwaysWithin(t, if_, then) => later.clone().all(|i| {
                !self.holds(if_, i, who)
                    || (i..states.len()).any(|j| time(j) <= time(i) + seconds(*t) && self.holds(then, j, who))
            }),
            K::HoldDuring(from, to, part) => {
                self.window(part, at, (time(at) + seconds(*from), Some(time(at) + seconds(*to))), who)
            }
            K::HoldAfter(from, part) => self.window(part, at, (time(at) + seconds(*from), None), who),
        }
    }

    /// At each moment of the window; in the last state if the run ends before it opens.
    fn window(
        &self,
        part: &Constraint,
        at: usize,
        (from, to): (u64, Option<u64>),
        who: &mut Vec<Option<usize>>,
    ) -> bool {
        let states = &self.run.states;
        if to.is_some_and(|to| to <= from) {
            return true;
        }
        if self.run.end < from {
            return self.holds(part, states.len() - 1, who);
        }
        let within = |time: u64| time >= from && to.is_none_or(|to| time < to);
        // Of several versions at its first moment, the window opens on the last one.
        let passing = |i: usize| states[i].0 == from && states.get(i + 1).is_some_and(|next| next.0 == from);
        (at..states.len()).all(|i| !within(states[i].0) || passing(i) || self.holds(part, i, who))
    }

    fn state(&self, condition: &Condition, at: usize, who: &mut Vec<Option<usize>>) -> bool {
        use ConditionKind as K;
        match &condition.kind {
            K::And(parts) => parts.iter().all(|part| self.state(part, at, who)),
            K::Or(parts) => parts.iter().any(|part| self.state(part, at, who)),
            K::Not(part) => !self.state(part, at, who),
            K::Imply(if_, then) => !self.state(if_, at, who) || self.state(then, at, who),
            K::Exists(variables, part) => self.people(variables[0], who, |who| self.state(part, at, who)),
            K::Forall(variables, part) => !self.people(variables[0], who, |who| !self.state(part, at, who)),
            K::Atom(atom) => {
                let [subject, state] = atom.arguments[..] else { unreachable!("`is` is binary") };
                let person = match subject {
                    Term::Variable(variable) => who[variable.index()].unwrap(),
                    Term::Object(object) => self.position(&PEOPLE, object),
                };
                let Term::Object(state) = state else { unreachable!("states are named") };
                self.run.states[at].1.contains(&(person, self.position(&STATES, state)))
            }
            _ => unreachable!("the dice make no other condition"),
        }
    }

    fn people(
        &self,
        variable: VariableId,
        who: &mut Vec<Option<usize>>,
        mut holds: impl FnMut(&mut Vec<Option<usize>>) -> bool,
    ) -> bool {
        let around = who[variable.index()];
        let found = (0..PEOPLE.len()).any(|person| {
            who[variable.index()] = Some(person);
            holds(who)
        });
        who[variable.index()] = around;
        found
    }

    fn position(&self, names: &[&str], object: pddl::model::ObjectId) -> usize {
        names.iter().position(|name| **name == *self.domain.constants[object].name).unwrap()
    }
}

fn monitored(tokens: &Tokens, world: &pddl::model::Problem, domain: &Domain, run: &Run) -> BTreeSet<String> {
    let second = |half: u64| Time(half * 500_000_000);
    let graph = tokens.populate(&[world], Time(0)).unwrap();
    let invariants = Invariants::new([domain], tokens).unwrap_or_else(|errors| panic!("{errors:?}"));
    let mut monitor = Monitor::new(Arc::new(invariants));
    let mut subscription = graph.subscribe_to(monitor.interest(&graph.snapshot()));
    let mut broken = Vec::new();
    let is = tokens.label("is").unwrap();
    let snapshot = graph.snapshot();
    let ends = |&(person, state): &(usize, usize)| {
        (snapshot.node(PEOPLE[person]).unwrap(), snapshot.node(STATES[state]).unwrap())
    };
    for pair in run.states.windows(2) {
        let mut transaction = Transaction::new(AgentId::DSR);
        for (from, to) in pair[1].1.difference(&pair[0].1).map(ends) {
            transaction.add_edge(from, is, to);
        }
        for (from, to) in pair[0].1.difference(&pair[1].1).map(ends) {
            transaction.remove_edge(from, is, to);
        }
        graph.commit(&transaction, second(pair[1].0)).unwrap();
        while let Some(news) = subscription.try_recv() {
            broken.extend(monitor.changed(&news));
        }
    }
    while let Some(news) = subscription.try_recv() {
        broken.extend(monitor.changed(&news));
    }
    broken.extend(monitor.ended(second(run.end)));
    let names: Vec<String> = broken.iter().map(|broken| broken.binding[0].1.clone()).collect();
    let set: BTreeSet<String> = names.iter().cloned().collect();
    assert_eq!(names.len(), set.len(), "each binding is reported once");
    set
}

#[test]
fn the_monitor_agrees_with_the_definition() {
    let ward = parse_domain(&Source::new("ward.pddl", WARD), &[]).model.unwrap();
    let tokens = Tokens::new(&ward).unwrap();
    let world = "(define (problem world) (:domain ward) (:objects ann bob - person) (:init) (:goal (and)))";
    let world = parse_problem(&Source::new("world.pddl", world), &ward).model.unwrap();
    let nodes = Domain { constants: world.objects.clone(), ..ward };
    let (mut holding, mut breaking) = (0, 0);
    for seed in 0..3_000 {
        let mut dice = Dice(Pcg64Mcg::seed_from_u64(seed));
        let constraint = dice.constraint(2, true);
        let text = format!(
            "(define (domain case) (:requirements :adl :constraints :invariants) (:import ward)
            (:constants ann bob - person)
            (:invariant it :parameters (?p - person) :constraint {constraint}))"
        );
        let source = Source::new("case.pddl", text);
        let domain = parse_domain(&source, &[&nodes]).model.unwrap_or_else(|| panic!("{constraint}"));
        for _ in 0..4 {
            let run = dice.run();
            let dense = dense(&run);
            let definition = Definition { domain: &domain, run: &dense };
            let invariant = &domain.invariants[0];
            let mut expected = BTreeSet::new();
            for (person, name) in PEOPLE.iter().enumerate() {
                let mut who = vec![None; invariant.variables.slots.len()];
                who[0] = Some(person);
                if !definition.holds(&invariant.constraint, 0, &mut who) {
                    expected.insert((*name).to_owned());
                }
            }
            let found = monitored(&tokens, &world, &domain, &run);
            let states = &run.states;
            assert_eq!(found, expected, "seed {seed}: {constraint}\non {states:?}, end {}", run.end);
            holding += 2 - expected.len();
            breaking += expected.len();
        }
    }
    assert!(holding > 1_000 && breaking > 1_000, "{holding} hold, {breaking} break");
}
