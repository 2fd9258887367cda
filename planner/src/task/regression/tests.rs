//! Regressed suffixes against their definition: a suffix holds exactly where simulating it reaches
//! the goal, in whatever state and whether or not the plan was ever valid.

use super::Suffixes;
use crate::ids::{FactId, OperatorId};
use crate::number::Number;
use crate::test_support::Grounded;
use crate::{State, Task, random_numbers, random_tests};
use pddl::model::Idx;
use proptest::prelude::*;
use proptest::sample::Index;

/// Doors between rooms that swing, and what can be reached through them: a recursive axiom, one
/// over its negation, and conditional effects that read both.
const DOORS: &str = "(define (domain doors) (:requirements :adl :derived-predicates)
  (:types room) (:constants r0 r1 r2 - room) (:predicates (open ?a ?b - room) (at ?r - room) (path ?a ?b - room) (cut ?r - room) (fresh))
  (:derived (path ?a ?b - room)
    (or (open ?a ?b) (exists (?c - room) (and (open ?a ?c) (path ?c ?b)))))
  (:derived (cut ?r - room) (not (exists (?s - room) (and (at ?s) (path ?s ?r)))))
  (:action go :parameters (?a ?b - room) :precondition (and (at ?a) (path ?a ?b))
    :effect (and (not (at ?a)) (at ?b) (when (cut ?a) (not (fresh)))))
  (:action swing :parameters (?a ?b ?c - room) :precondition (at ?a)
    :effect (and (when (open ?a ?b) (and (not (open ?a ?b)) (open ?a ?c)))
                 (when (not (path ?b ?a)) (open ?b ?a))))
  (:action air :parameters () :precondition (or (not (cut r0)) (at r2)) :effect (fresh)))";

fn doors() -> Grounded {
    let problem = "(define (problem p) (:domain doors)
        (:init (at r0) (open r0 r1) (open r1 r2)) (:goal (and (at r0) (fresh) (not (cut r1)))))";
    Grounded::new((DOORS.to_owned(), problem.to_owned()))
}

fn simulated(task: &Task, plan: &[OperatorId], state: &State) -> bool {
    let step = |state: State, &step: &OperatorId| task.ways(step).find_map(|way| task.successor(&state, way));
    plan.iter().try_fold(state.clone(), step).is_some_and(|end| task.satisfies(&end, task.goal()))
}

/// Facts to turn round, numbers to give, and whether to take a step first.
type Event = (Vec<Index>, Vec<(Index, Option<i8>)>, Option<Index>);

fn events() -> impl Strategy<Value = Vec<Event>> {
    let flips = prop::collection::vec(any::<Index>(), 0..3);
    let numbers = prop::collection::vec((any::<Index>(), prop::option::weighted(0.9, -6..9_i8)), 0..2);
    prop::collection::vec((flips, numbers, any::<Option<Index>>()), 1..6)
}

/// Follows the events, and compares each suffix after each of them.
fn check(task: &Task, plan: &[Index], events: &[Event]) -> Result<(), TestCaseError> {
    if task.operators().is_empty() || task.facts().is_empty() {
        return Ok(());
    }
    let all: Vec<OperatorId> = task.operators().ids().collect();
    let plan: Vec<OperatorId> = plan.iter().map(|i| *i.get(&all)).collect();
    let mut state = task.initial_state().clone();
    let mut suffixes = Suffixes::new(task, plan.clone(), task.goal().clone(), &state);
    for (flips, numbers, step) in events {
        let applicable = task.applicable(&state);
        let next = step.filter(|_| !applicable.is_empty()).map(|i| *i.get(&applicable));
        state = next.and_then(|step| task.successor(&state, step)).unwrap_or(state);
        let facts: Vec<FactId> =
            flips.iter().map(|i| FactId::from_index(i.index(task.facts().len()))).collect();
        let flipped: Vec<_> = facts.into_iter().map(|fact| (fact, !state.contains(fact))).collect();
        task.change(&mut state, flipped);
        let known: Vec<_> = task.numbers(&state).map(|(application, _)| application.clone()).collect();
        let given = numbers.iter().filter(|_| !known.is_empty());
        let given = given.map(|(i, value)| (i.get(&known), value.map(|v| Number::integer(v.into()))));
        state = task.with_numbers(&state, given);
        suffixes.observe(task, &state);
        for suffix in 0..=plan.len() {
            let expected = simulated(task, &plan[suffix..], &state);
            prop_assert_eq!(suffixes.reaches(task, suffix), expected, "suffix {} of {:?}", suffix, plan);
            let (broken, all) = suffixes.broken(suffix);
            prop_assert!(broken.iter().all(|&(fact, wanted)| state.contains(fact) != wanted));
            prop_assert!(expected || !broken.is_empty() || !all, "a reason is never empty");
        }
    }
    Ok(())
}

fn plan() -> impl Strategy<Value = Vec<Index>> {
    prop::collection::vec(any::<Index>(), 0..7)
}

proptest! {
    #[test]
    fn conditional_effects_axioms_and_disjunctions(
        random in random_tests::random_task(), plan in plan(), events in events(),
    ) {
        check(&Grounded::new(random.text()).task, &plan, &events)?;
    }

    #[test]
    fn numbers_that_effects_change(
        random in random_numbers::random_task(), plan in plan(), events in events(),
    ) {
        check(&Grounded::new(random.text()).task, &plan, &events)?;
    }

    #[test]
    fn recursive_axioms(plan in plan(), events in events()) {
        check(&doors().task, &plan, &events)?;
    }

    #[test]
    fn a_changed_state_is_the_state_of_its_facts(random in random_tests::random_task(), events in events()) {
        let task = Grounded::new(random.text()).task;
        let mut state = task.initial_state().clone();
        for (flips, ..) in events.iter().filter(|_| !task.facts().is_empty()) {
            let facts = flips.iter().map(|i| FactId::from_index(i.index(task.facts().len())));
            let flipped: Vec<_> = facts.map(|fact| (fact, !state.contains(fact))).collect();
            task.change(&mut state, flipped);
            prop_assert_eq!(&task.state(state.facts()), &state);
        }
    }
}
