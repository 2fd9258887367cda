//! Tasks with numbers that a random one would hardly be.

#![allow(clippy::unwrap_used, reason = "a test")]

use planner::{
    Budget, GroundOptions, Limit, Outcome, Plan, Query, SearchConfiguration, Task, UnsolvableReason, ground,
    improve, solve,
};

fn task(domain: &str, problem: &str) -> Task {
    let domain = pddl::parse_domain(&pddl::Source::new("domain", domain), &[]).model.unwrap();
    let problem = pddl::parse_problem(&pddl::Source::new("problem", problem), &domain).model.unwrap();
    ground(&domain, &problem, &GroundOptions::default()).unwrap()
}

/// A number that does not fit in one query does not affect the next query.
#[test]
fn numbers_that_outgrow_a_word_leave_only_that_answer_open() {
    let task = task(
        "(define (domain growth) (:requirements :numeric-fluents)
           (:predicates (on)) (:functions (x))
           (:action double :parameters () :effect (scale-up (x) 2))
           (:action switch :parameters () :effect (on)))",
        "(define (problem three) (:domain growth) (:init (= (x) 1)) (:goal (= (x) 3)))",
    );
    let double: Vec<_> =
        task.operators().enumerate().filter(|(_, o)| o.changes_numbers()).map(|(id, _)| id).collect();
    for configuration in SearchConfiguration::ALL.iter().filter(|c| c.complete) {
        let ask = |query: &Query<'_>| solve(&task, query, configuration, &Budget::default()).outcome;
        let open = Outcome::LimitReached(Limit::Incomplete);
        assert_eq!(ask(&Query::of(&task)), open, "{}", configuration.name);
        let without = Query { excluded: &double, ..Query::of(&task) };
        assert!(matches!(ask(&without), Outcome::Unsolvable(_)), "{}", configuration.name);
        assert_eq!(ask(&Query::of(&task)), open, "{}", configuration.name);
    }
}

/// A state that was given a number too long to hold proves nothing; the next one does.
#[test]
fn a_number_that_does_not_fit_a_state_leaves_its_answer_open() {
    let task = task(
        "(define (domain tank) (:requirements :numeric-fluents) (:predicates (done)) (:functions (level))
           (:action fill :parameters () :precondition (< (level) 3) :effect (increase (level) 1))
           (:action stop :parameters () :precondition (>= (level) 5) :effect (done)))",
        "(define (problem stop) (:domain tank) (:init (= (level) 0)) (:goal (done)))",
    );
    let level = task.numbers(task.initial_state()).next().unwrap().0.clone();
    let state = |value: f64| {
        let value = planner::Number::from_f64(value);
        task.with_numbers(task.initial_state(), [(&level, value)])
    };
    let ask = |state| {
        let query = Query { state, ..Query::of(&task) };
        solve(&task, &query, &SearchConfiguration::default(), &Budget::default()).outcome
    };
    let (third, full, empty) = (state(1.0 / 3.0), state(7.0), state(0.0));
    assert_eq!(ask(&third), Outcome::LimitReached(Limit::Incomplete));
    assert!(matches!(ask(&full), Outcome::Solved(_)));
    assert_eq!(ask(&empty), Outcome::Unsolvable(UnsolvableReason::SpaceExhausted));
}

/// A relaxed plan that fills a tank litre by litre leads a search straight there.
#[test]
fn relaxed_plans_count_repetitions() {
    let task = task(
        "(define (domain tank) (:requirements :numeric-fluents :negative-preconditions)
           (:predicates (open) (done)) (:functions (level) (waste))
           (:action turn :parameters () :precondition (not (open)) :effect (open))
           (:action fill :parameters () :precondition (open) :effect (increase (level) 0.5))
           (:action spill :parameters () :effect (increase (waste) 1))
           (:action drain :parameters () :precondition (>= (level) 0.5) :effect (decrease (level) 0.5))
           (:action stop :parameters () :precondition (and (>= (level) 60) (< (waste) 1)) :effect (done)))",
        "(define (problem stop) (:domain tank) (:init (= (level) 0) (= (waste) 0)) (:goal (done)))",
    );
    for name in ["lama", "lazy-ff", "greedy-ff", "greedy-add", "hill", "astar-max"] {
        let configuration = SearchConfiguration::named(name).unwrap();
        let report = solve(&task, &Query::of(&task), &configuration, &Budget::default());
        let Outcome::Solved(plan) = report.outcome else { panic!("{name}: {:?}", report.outcome) };
        assert_eq!(plan.operators.len(), 122, "{name}");
        assert!(report.statistics.expanded < 400, "{name}: {}", report.statistics.expanded);
    }
}

/// What moves away from the goal alone never gets there.
#[test]
fn a_sum_that_only_grows_never_falls() {
    let task = task(
        "(define (domain sum) (:requirements :numeric-fluents) (:functions (x) (y))
           (:action both :parameters () :effect (and (increase (x) 1) (increase (y) 2)))
           (:action trade :parameters () :effect (and (increase (x) 2) (decrease (y) 2))))",
        "(define (problem less) (:domain sum) (:init (= (x) 4) (= (y) 1)) (:goal (< (+ (x) (y)) 5)))",
    );
    let outcome =
        solve(&task, &Query::of(&task), &SearchConfiguration::default(), &Budget::default()).outcome;
    assert!(matches!(outcome, Outcome::Unsolvable(UnsolvableReason::Impossible(_))), "{outcome:?}");
}

/// Each step raises one rung over the one below and brings the next one closer: only who counts what the
/// goal loses on the way sees how far it is.
#[test]
fn what_is_taken_from_the_goal_is_made_up_for() {
    let rungs: Vec<String> = (0..10).map(|i| format!("r{i}")).collect();
    let heights: String = rungs.iter().map(|r| format!("(= (height {r}) 0)")).collect();
    let above: String =
        rungs.windows(2).map(|w| format!("(> (height {}) (height {}))", w[1], w[0])).collect();
    let task = task(
        "(define (domain ladder) (:requirements :typing :numeric-fluents) (:types rung) (:functions (height ?r - rung))
           (:action up :parameters (?r - rung) :precondition (< (height ?r) 20) :effect (increase (height ?r) 1))
           (:action down :parameters (?r - rung) :precondition (> (height ?r) 0) :effect (decrease (height ?r) 1)))",
        &format!(
            "(define (problem ten) (:domain ladder) (:objects {} - rung) (:init {heights}) (:goal (and {above})))",
            rungs.join(" ")
        ),
    );
    let configuration = SearchConfiguration::named("lazy-ff").unwrap();
    let report = solve(&task, &Query::of(&task), &configuration, &Budget::default());
    let Outcome::Solved(plan) = report.outcome else { panic!("{:?}", report.outcome) };
    assert_eq!(plan.operators.len(), 45);
    assert!(report.statistics.expanded < 1000, "{}", report.statistics.expanded);
}

/// A condition on numbers that never change leaves out of a join what it excludes.
#[test]
fn static_comparisons_filter_instances_as_they_are_joined() {
    let items: Vec<String> = (0..60).map(|i| format!("i{i}")).collect();
    let ranks: String = items.iter().enumerate().map(|(i, item)| format!("(= (rank {item}) {i})")).collect();
    let domain = pddl::Source::new(
        "domain",
        "(define (domain rows) (:requirements :typing :numeric-fluents) (:types item)
           (:predicates (row ?a - item)) (:functions (rank ?i - item))
           (:action three :parameters (?a ?b ?c - item)
            :precondition (and (= (rank ?b) (+ (rank ?a) 1)) (= (rank ?c) (+ (rank ?b) 1)))
            :effect (row ?a)))",
    );
    let problem = pddl::Source::new(
        "problem",
        format!(
            "(define (problem sixty) (:domain rows) (:objects {} - item) (:init {ranks}) (:goal (forall (?a - item) (or (row ?a) (> (rank ?a) 57)))))",
            items.join(" ")
        ),
    );
    let domain = pddl::parse_domain(&domain, &[]).model.unwrap();
    let problem = pddl::parse_problem(&problem, &domain).model.unwrap();
    // The product of all parameters would take a hundred times as much.
    let options = GroundOptions {
        budget: Budget { memory_bytes: Some(1 << 20), ..Budget::default() },
        ..GroundOptions::default()
    };
    assert_eq!(ground(&domain, &problem, &options).unwrap().operators().len(), 58);
}

/// Actions that only improve the metric are kept (taking pictures), actions that only cost fuel are not.
#[test]
fn a_metric_makes_relevant_what_improves_it() {
    let task = task(
        "(define (domain camera) (:requirements :numeric-fluents :negative-preconditions)
           (:predicates (on) (taken ?v) (lit)) (:functions (pictures) (fuel))
           (:action switch-on :parameters () :effect (on))
           (:action take :parameters (?v) :precondition (and (on) (not (taken ?v)))
             :effect (and (taken ?v) (increase (pictures) 2) (increase (fuel) 1)))
           (:action roll :parameters () :effect (and (lit) (increase (fuel) 1))))",
        "(define (problem p) (:domain camera) (:objects a b) (:init (= (pictures) 0) (= (fuel) 0)) (:goal (and))
           (:metric maximize (- (pictures) (fuel))))",
    );
    assert_eq!(task.operators().len(), 3, "rolling the film only costs");
    let mut qualities = Vec::new();
    let mut note = |plan: &Plan| qualities.push(task.quality(task.initial_state(), &plan.operators).unwrap());
    let budget = Budget { work: Some(1_000), ..Budget::default() };
    let configuration = SearchConfiguration::default();
    improve(&task, &Query::of(&task), &configuration, &budget, &mut note);
    assert_eq!(qualities, [0.0, -1.0, -2.0].map(|value| planner::Number::from_f64(value).unwrap()));
}

/// An action that multiplies and adds to one number has no result, also where nothing reads the number.
#[test]
fn a_product_and_a_sum_conflict_in_a_number_that_nothing_reads() {
    let task = task(
        "(define (domain tank) (:requirements :numeric-fluents) (:predicates (done)) (:functions (level))
           (:action both :parameters () :effect (and (done) (scale-up (level) 1) (increase (level) 1))))",
        "(define (problem stop) (:domain tank) (:init (= (level) 0)) (:goal (done)))",
    );
    let outcome =
        solve(&task, &Query::of(&task), &SearchConfiguration::default(), &Budget::default()).outcome;
    assert!(matches!(outcome, Outcome::Unsolvable(_)), "{outcome:?}");
}

/// A number that is sensed is never a constant: no plan from the first state, one from another.
#[test]
fn a_sensed_number_may_have_any_value_or_none() {
    let domain = "(define (domain ask) (:requirements :numeric-fluents) (:predicates (done))
        (:functions (asked) (loudness))
        (:action ask :parameters () :precondition (and (< (asked) 2) (>= (loudness) 0.3)) :effect (done)))";
    let problem = "(define (problem p) (:domain ask) (:init (= (asked) 2)) (:goal (done)))";
    let domain = pddl::parse_domain(&pddl::Source::new("domain", domain), &[]).model.unwrap();
    let problem = pddl::parse_problem(&pddl::Source::new("problem", problem), &domain).model.unwrap();
    let functions: Vec<_> = domain.functions.ids().collect();
    let options = GroundOptions { exogenous_functions: &functions, ..GroundOptions::default() };
    let task = ground(&domain, &problem, &options).unwrap();
    let number = |of: &str| {
        task.numbers(task.initial_state()).find(|(a, _)| &*domain.functions[a.function].name == of)
    };
    let (asked, loudness) = (number("asked").unwrap().0.clone(), number("loudness").unwrap().0.clone());
    let solvable = |values: [Option<f64>; 2]| {
        let values = values.map(|value| value.and_then(planner::Number::from_f64));
        let state = task.with_numbers(task.initial_state(), [(&asked, values[0]), (&loudness, values[1])]);
        let query = Query { state: &state, ..Query::of(&task) };
        match solve(&task, &query, &SearchConfiguration::default(), &Budget::default()).outcome {
            Outcome::Solved(_) => true,
            Outcome::Unsolvable(_) => false,
            other => panic!("{other:?}"),
        }
    };
    assert!(!solvable([Some(2.0), Some(0.3)]));
    assert!(solvable([Some(0.0), Some(0.7)]));
    assert!(solvable([Some(1.0), Some(0.333_333)]));
    assert!(!solvable([Some(1.0), Some(0.2)]));
    assert!(!solvable([Some(1.0), None]));
    assert!(!solvable([None, Some(0.5)]));
}
