//! A cancellation is seen at each look, at once, and looks are never far apart.
#![allow(clippy::unwrap_used, reason = "a test")]

use planner::{
    Budget, GroundError, GroundOptions, Limit, Outcome, Query, SearchConfiguration, ground, improve, solve,
};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// Vans that are tracked everywhere: conditional effects, axioms, mutexes, and more instances than one
/// thread builds alone.
fn model(places: usize) -> (pddl::model::Domain, pddl::model::Problem) {
    let domain = "(define (domain d)
       (:requirements :strips :negative-preconditions :conditional-effects :derived-predicates)
       (:predicates (at ?v ?p) (van ?v) (place ?p) (clean ?p) (box ?p) (busy ?p) (quiet ?p))
       (:derived (quiet ?p) (and (place ?p) (not (busy ?p))))
       (:action go :parameters (?v ?a ?b)
        :precondition (and (van ?v) (at ?v ?a) (place ?b) (quiet ?b) (not (at ?v ?b)))
        :effect (and (not (at ?v ?a)) (at ?v ?b) (busy ?b) (when (clean ?b) (not (clean ?b)))))
       (:action wipe :parameters (?v ?a) :precondition (and (van ?v) (at ?v ?a))
        :effect (and (clean ?a) (not (busy ?a)))))";
    let names: String = (0..places).map(|i| format!(" p{i}")).collect();
    let facts: String = (0..places).map(|i| format!("(place p{i}) (clean p{i})")).collect();
    let problem = format!(
        "(define (problem p) (:domain d) (:objects v w{names})
         (:init (van v) (van w) (at v p0) (at w p1) {facts})
         (:goal (and (at v p3) (at w p4) (clean p0) (clean p3) (not (clean p5)))))"
    );
    let domain = pddl::parse_domain(&pddl::Source::new("d", domain), &[]).model.unwrap();
    let problem = pddl::parse_problem(&pddl::Source::new("p", problem), &domain).model.unwrap();
    (domain, problem)
}

/// Runs `work` with a closure that says yes from the look `from` on; gives how often it looked.
fn looks<T>(from: usize, work: impl FnOnce(&(dyn Fn() -> bool + Sync)) -> T) -> (T, usize) {
    let count = AtomicUsize::new(0);
    let result = work(&|| count.fetch_add(1, Relaxed) >= from);
    (result, count.into_inner())
}

#[test]
fn grounding_ends_at_whichever_look_says_so() {
    let (domain, problem) = model(60);
    let run = |from| {
        looks(from, |interrupted| {
            ground(
                &domain,
                &problem,
                &GroundOptions {
                    budget: Budget { interrupted, ..Budget::default() },
                    ..GroundOptions::default()
                },
            )
        })
    };
    let (task, all) = run(usize::MAX);
    assert!(task.unwrap().operators().len() > 5_000, "two threads finish it");
    assert!(all > 50, "{all} looks");
    for from in (0..all - 2).step_by(all / 24) {
        let (result, looked) = run(from);
        assert!(matches!(result, Err(GroundError::Interrupted { .. })), "look {from} of {all}");
        assert!(looked <= from + 2, "one more look at most, of the other thread: {looked} after {from}");
    }
}

#[test]
fn searching_ends_at_whichever_look_says_so() {
    let (domain, problem) = model(24);
    let task = ground(&domain, &problem, &GroundOptions::default()).unwrap();
    for name in ["lama", "dual", "bfws", "ehc", "lmcut", "portfolio"] {
        let Some(configuration) = SearchConfiguration::named(name) else { continue };
        let run = |from| {
            looks(from, |interrupted| {
                let budget = Budget { interrupted, work: Some(200), ..Budget::default() };
                solve(&task, &Query::of(&task), &configuration, &budget)
            })
        };
        let (_, all) = run(usize::MAX);
        for from in (0..all).step_by(all.div_ceil(8)) {
            let (report, looked) = run(from);
            let ended = match report.outcome {
                Outcome::LimitReached(limit) => limit == Limit::Interrupted,
                // It was there before the other thread looked.
                Outcome::Solved(_) => true,
                _ => false,
            };
            assert!(ended, "{name}: {:?} at look {from} of {all}", report.outcome);
            assert!(looked <= from + 8, "{name}: {looked} looks after {from}");
        }
    }
}

#[test]
fn improving_ends_at_whichever_look_says_so_and_keeps_its_plan() {
    let (domain, problem) = model(24);
    let task = ground(&domain, &problem, &GroundOptions::default()).unwrap();
    for from in [0, 1, 5, 20, 50] {
        let mut plans = 0;
        let (improved, looked) = looks(from, |interrupted| {
            let budget = Budget { interrupted, work: Some(2_000), ..Budget::default() };
            let configuration = SearchConfiguration::default();
            improve(&task, &Query::of(&task), &configuration, &budget, &mut |_| plans += 1)
        });
        assert_eq!(plans > 0, matches!(improved.report.outcome, Outcome::Solved(_)));
        assert!(looked <= from + 8, "{looked} looks after {from}");
    }
}
