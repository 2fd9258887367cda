//! Walks `test_data` and the registry of searches: every configuration on every task.
//!
//! A task is a problem file beside a `domain.pddl`; its first line has the expected result:
//! `; expect: cost N` (the optimum), `solvable` (too large for optimal searches),
//! `impossible ATOM...`, `exhausted` or `unsupported FEATURE`.

#![allow(clippy::unwrap_used, reason = "a test")]

use pddl::model::Objective;
use planner::{
    Budget, Feature, GroundError, GroundOptions, Impossible, Limit, Outcome, Plan, Quality, Query,
    SearchConfiguration, Task, UnsolvableReason, ground, improve, solve,
};
use std::fs;
use std::path::{Path, PathBuf};

struct Case {
    path: PathBuf,
    domain: pddl::model::Domain,
    problem: pddl::model::Problem,
    expected: String,
}

fn cases() -> Vec<Case> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("test_data");
    let sorted = |folder: &Path| {
        let mut paths: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
        paths.sort();
        paths
    };
    let read = |path: &Path| pddl::Source::new(path.display().to_string(), fs::read_to_string(path).unwrap());
    let mut cases = Vec::new();
    for folder in sorted(&root) {
        let parsed = pddl::parse_domain(&read(&folder.join("domain.pddl")), &[]);
        let domain = parsed.model.unwrap_or_else(|| panic!("{folder:?}: {:?}", parsed.diagnostics));
        for path in sorted(&folder).into_iter().filter(|p| p.file_name().unwrap() != "domain.pddl") {
            let source = read(&path);
            let first = source.text().lines().next().unwrap();
            let expected = first.strip_prefix("; expect: ").unwrap_or_else(|| panic!("{path:?}: {first}"));
            let parsed = pddl::parse_problem(&source, &domain);
            let problem = parsed.model.unwrap_or_else(|| panic!("{path:?}: {:?}", parsed.diagnostics));
            cases.push(Case { expected: expected.to_owned(), path, domain: domain.clone(), problem });
        }
    }
    assert!(cases.len() > 10, "the runner found the tasks");
    cases
}

fn grounded(case: &Case) -> Result<Task, GroundError> {
    ground(&case.domain, &case.problem, &GroundOptions::default())
}

#[test]
fn every_configuration_agrees_with_every_expectation() {
    for case in cases() {
        let task = match grounded(&case) {
            Ok(task) => task,
            Err(GroundError::Unsupported { feature, .. }) => {
                assert_eq!(format!("unsupported {feature}"), case.expected, "{:?}", case.path);
                continue;
            }
            Err(other) => panic!("{:?}: {other}", case.path),
        };
        for configuration in SearchConfiguration::ALL {
            if configuration.optimal && !task.has_additive_costs() {
                let refused = solve(&task, &Query::of(&task), configuration, &Budget::default()).outcome;
                assert_eq!(refused, Outcome::Unsupported(Feature::OptimalMetric));
                continue;
            }
            if configuration.optimal && case.expected == "solvable" {
                continue;
            }
            let report = solve(&task, &Query::of(&task), configuration, &budget_for(&case, configuration));
            check(&case, &task, configuration, &report.outcome);
        }
    }
}

/// Large tasks are not for every search: uninformed ones end at this limit.
fn budget_for(case: &Case, configuration: &SearchConfiguration) -> Budget<'static> {
    let most = if ROBUST.contains(&configuration.name) { 20_000 } else { 100 };
    Budget { work: (case.expected == "solvable").then_some(most), ..Budget::default() }
}

/// Searches that solve the large tasks of `test_data`, too.
const ROBUST: [&str; 5] = ["lama", "lama-novelty", "lama-types", "dual-bfws", "dual"];

fn check(case: &Case, task: &Task, configuration: &SearchConfiguration, outcome: &Outcome) {
    let place = format!("{:?} by {}", case.path, configuration.name);
    let got = match outcome {
        Outcome::LimitReached(Limit::Incomplete) if !configuration.complete => return,
        Outcome::LimitReached(Limit::Expansions)
            if case.expected == "solvable" && !ROBUST.contains(&configuration.name) =>
        {
            return;
        }
        Outcome::Unsupported(feature) => panic!("{place}: {feature}"),
        Outcome::LimitReached(limit) => panic!("{place}: {limit:?}"),
        Outcome::Unsolvable(UnsolvableReason::SpaceExhausted) => "exhausted".to_owned(),
        Outcome::Unsolvable(UnsolvableReason::Impossible(Impossible::Atoms(atoms))) => {
            let names: Vec<String> = atoms.iter().map(|a| task.atom_name(a)).collect();
            format!("impossible {}", names.join(" "))
        }
        Outcome::Unsolvable(UnsolvableReason::Impossible(Impossible::Exclusive(atoms))) => {
            let names: Vec<String> = atoms.iter().map(|a| task.atom_name(a)).collect();
            format!("exclusive {}", names.join(" "))
        }
        Outcome::Unsolvable(UnsolvableReason::Impossible(other)) => format!("impossible {other:?}"),
        Outcome::Solved(plan) => {
            let verdict = validator::validate(&case.domain, &case.problem, &steps(task, plan));
            assert!(verdict.is_valid(), "{place}: {verdict:?}");
            let replayed = plan
                .operators
                .iter()
                .fold(task.initial_state().clone(), |s, &o| task.successor(&s, o).expect("applicable"));
            assert!(task.satisfies(&replayed, task.goal()), "{place}");
            #[expect(clippy::cast_precision_loss, reason = "small costs")]
            let cost = plan.cost as f64 / f64::from(task.cost_scale());
            if case.expected == "solvable" {
                return;
            }
            if !configuration.optimal {
                let optimum: f64 = case.expected.strip_prefix("cost ").expect(&place).parse().unwrap();
                assert!(cost >= optimum, "{place}: {cost} is below the optimum");
                return;
            }
            format!("cost {cost}")
        }
    };
    assert_eq!(got, case.expected, "{place}");
}

fn named(name: &str) -> Case {
    cases().into_iter().find(|c| c.path.ends_with(name)).unwrap()
}

#[test]
fn the_same_call_gives_the_same_plan() {
    for case in cases() {
        let Ok(task) = grounded(&case) else { continue };
        for configuration in SearchConfiguration::ALL.iter().filter(|c| c.deterministic) {
            if configuration.optimal && case.expected == "solvable" {
                continue;
            }
            let run = || {
                solve(
                    &grounded(&case).unwrap(),
                    &Query::of(&task),
                    configuration,
                    &budget_for(&case, configuration),
                )
            };
            assert_eq!(run(), run(), "{:?} by {}", case.path, configuration.name);
        }
    }
}

#[test]
fn plans_get_cheaper_until_the_best_is_known() {
    for case in cases().into_iter().filter(|c| c.expected.starts_with("cost ")) {
        let Ok(task) = grounded(&case) else { continue };
        for name in ROBUST {
            let configuration = SearchConfiguration::named(name).unwrap();
            let mut costs = Vec::new();
            let mut note = |plan: &Plan| costs.push(plan.cost);
            let improved = improve(&task, &Query::of(&task), &configuration, &Budget::default(), &mut note);
            assert!(costs.is_sorted_by(|a, b| a > b), "{:?}: {costs:?}", case.path);
            assert_eq!(improved.quality, Quality::Optimal, "{:?}", case.path);
            let Outcome::Solved(best) = &improved.report.outcome else { panic!("{:?}", case.path) };
            assert_eq!(costs.last(), Some(&best.cost));
            check(&case, &task, &SearchConfiguration::best_optimal(), &improved.report.outcome);
        }
    }
}

/// By the validator's own count, sums of costs and metrics alike.
#[test]
fn every_better_plan_is_valid_and_better() {
    let mut several = [0; 3];
    for case in cases() {
        let Ok(task) = grounded(&case) else { continue };
        if case.expected == "solvable" && task.has_additive_costs() {
            continue;
        }
        // The second one's first plan has the fewest steps.
        for name in ["lama", "greedy-blind"] {
            let (kind, plans) = improvements(&case, &task, &SearchConfiguration::named(name).unwrap());
            several[kind] += usize::from(plans > 1);
        }
    }
    assert!(several.iter().all(|&n| n > 0), "costs, what is maximised and what is minimised: {several:?}");
}

/// Of which kind the metric is, and how many plans were found, each better than the one before.
fn improvements(case: &Case, task: &Task, configuration: &SearchConfiguration) -> (usize, usize) {
    let mut plans = Vec::new();
    let mut note = |plan: &Plan| plans.push(plan.clone());
    let budget = Budget { work: Some(2_000), ..Budget::default() };
    let improved = improve(task, &Query::of(task), configuration, &budget, &mut note);
    let measured = plans.iter().map(|plan| validated(case, task, plan)).collect::<Vec<_>>();
    let objective = case.problem.metric.as_ref().map(|m| m.objective);
    let better = |old: &validator::Number, new: &validator::Number| match objective {
        Some(Objective::Maximize) => new > old,
        _ => new < old,
    };
    assert!(measured.is_sorted_by(better), "{:?}: {measured:?}", case.path);
    match improved.report.outcome {
        Outcome::Solved(best) => assert_eq!(plans.last(), Some(&best), "{:?}", case.path),
        _ => assert!(plans.is_empty(), "{:?}", case.path),
    }
    if case.path.ends_with("thrifty.pddl") {
        assert_eq!(measured.last().map(validator::Number::to_string).as_deref(), Some("9"));
    }
    let kind = match objective {
        _ if task.has_additive_costs() => 0,
        Some(Objective::Maximize) => 1,
        _ => 2,
    };
    (kind, plans.len())
}

/// The cost of the plan by the validator.
fn validated(case: &Case, task: &Task, plan: &Plan) -> validator::Number {
    match validator::validate(&case.domain, &case.problem, &steps(task, plan)) {
        validator::Verdict::Valid(valid) => valid.cost(),
        other => panic!("{:?}: {other:?}", case.path),
    }
}

fn steps(task: &Task, plan: &Plan) -> pddl::SequentialPlan {
    let steps = plan.operators.iter().map(|&o| {
        let o = task.operator(o);
        pddl::PlanStep { action: o.action, arguments: o.arguments.to_vec(), span: pddl::Span::default() }
    });
    pddl::SequentialPlan::new(steps.collect())
}

#[test]
fn excluded_operators_are_not_used() {
    let case = named("gripper/four-balls.pddl");
    let task = grounded(&case).unwrap();
    let left = case.problem.object("left").unwrap();
    let excluded: Vec<_> =
        task.operators().enumerate().filter(|(_, o)| o.arguments.contains(&left)).map(|(id, _)| id).collect();
    for configuration in SearchConfiguration::ALL {
        let query = Query { excluded: &excluded, ..Query::of(&task) };
        match solve(&task, &query, configuration, &Budget::default()).outcome {
            Outcome::Solved(plan) => {
                assert!(plan.operators.iter().all(|o| !excluded.contains(o)), "{}", configuration.name);
                assert!(!configuration.optimal || plan.cost == 15);
            }
            other => assert!(!configuration.complete, "{other:?}"),
        }
    }
}

#[test]
fn limits_end_a_search_and_grounding() {
    let case = named("gripper/four-balls.pddl");
    let task = grounded(&case).unwrap();
    let configuration = SearchConfiguration::named("astar-blind").unwrap();
    let outcome = |budget: &Budget<'_>| solve(&task, &Query::of(&task), &configuration, budget).outcome;
    let few = Budget { work: Some(3), ..Budget::default() };
    assert_eq!(outcome(&few), Outcome::LimitReached(Limit::Expansions));
    let small = Budget { memory_bytes: Some(1), ..Budget::default() };
    assert_eq!(outcome(&small), Outcome::LimitReached(Limit::Memory));
    let stop = Budget { interrupted: &|| true, ..Budget::default() };
    assert_eq!(outcome(&stop), Outcome::LimitReached(Limit::Interrupted));
    let options = GroundOptions {
        budget: Budget { memory_bytes: Some(8_000), ..Budget::default() },
        ..GroundOptions::default()
    };
    match ground(&case.domain, &case.problem, &options) {
        Err(GroundError::Limit { schema, .. }) => {
            assert!(["move", "pick", "drop"].contains(&schema.as_str()));
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn exogenous_facts_can_be_planned_from_in_any_state() {
    let case = named("maze/two-doors.pddl");
    let predicate = |name| case.domain.predicate(name).unwrap();
    let object = |name: &str| case.problem.object(name).unwrap();
    let exogenous = [predicate("has"), predicate("lies"), predicate("locked")];
    let options = GroundOptions { exogenous: &exogenous, ..GroundOptions::default() };
    let task = ground(&case.domain, &case.problem, &options).unwrap();
    let fact = |name, of: &[&str]| {
        let objects: Vec<_> = of.iter().map(|o| object(o)).collect();
        task.fact(predicate(name), &objects).unwrap_or_else(|| panic!("({name} {of:?}) is a fact"))
    };
    // Someone handed both keys over and locked a door that was never there before.
    let mut facts = task.initial_state().facts();
    facts.extend([fact("has", &["k1"]), fact("has", &["k2"]), fact("locked", &["a", "e"])]);
    let state = task.state(facts);
    let query = Query { state: &state, ..Query::of(&task) };
    match solve(&task, &query, &SearchConfiguration::default(), &Budget::default()).outcome {
        Outcome::Solved(plan) => assert!(!plan.operators.is_empty()),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_task_that_does_not_fit_names_its_largest_schema() {
    let read =
        |path: &Path| pddl::Source::new(path.display().to_string(), std::fs::read_to_string(path).unwrap());
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../cli/tests/cases/plan-too-large");
    let domain = pddl::parse_domain(&read(&folder.join("domain.pddl")), &[]).model.unwrap();
    let problem = pddl::parse_problem(&read(&folder.join("problem.pddl")), &domain).model.unwrap();
    let options = GroundOptions {
        budget: Budget { memory_bytes: Some(16 << 20), ..Budget::default() },
        ..GroundOptions::default()
    };
    match ground(&domain, &problem, &options) {
        Err(GroundError::Limit { schema, instances }) => {
            assert_eq!(schema.as_str(), "weave");
            assert!((1_000..1_000_000).contains(&instances), "{instances}");
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn an_instance_that_does_not_fit_names_its_schema() {
    let text = |action: &str| {
        format!(
            "(define (domain d) (:requirements :adl) (:predicates (p ?x) (r ?x ?y) (q))
               (:action small :parameters (?x ?y) :effect (and (p ?x) (r ?x ?y) (q)))
               (:action deep :parameters () {action}))"
        )
    };
    let all = "?a ?b ?c ?d ?e ?f ?g ?h";
    let condition = text(&format!(
        ":precondition (exists (?z) (forall ({all}) (or (r ?z ?a) (r ?a ?b) (r ?b ?c) (r ?c ?d) (r ?d ?e) (r ?e ?f) (r ?f ?g) (r ?g ?h)))) :effect (not (q))"
    ));
    let effect = text(&format!(":effect (forall ({all}) (when (and (p ?a) (p ?h)) (not (q))))"));
    let objects: String = (0..50).map(|i| format!(" o{i}")).collect();
    let problem =
        format!("(define (problem p) (:domain d) (:objects{objects}) (:init (q)) (:goal (not (q))))");
    for domain in [condition, effect] {
        let domain = pddl::parse_domain(&pddl::Source::new("d", domain), &[]).model.unwrap();
        let problem = pddl::parse_problem(&pddl::Source::new("p", problem.clone()), &domain).model.unwrap();
        let options = GroundOptions {
            budget: Budget { memory_bytes: Some(4 << 20), ..Budget::default() },
            ..GroundOptions::default()
        };
        match ground(&domain, &problem, &options) {
            Err(GroundError::Limit { schema, .. }) => assert_eq!(schema.as_str(), "deep"),
            other => panic!("{other:?}"),
        }
    }
}

/// Conditions whose disjunctive normal form has more than 10^20 disjuncts, and a join of 16^4 rows that
/// is four joins of 16.
#[test]
fn deep_conditions_do_not_blow_up() {
    let deep = "(forall (?x) (exists (?y) (or (and (a ?x) (b ?y)) (and (c ?x) (or (d ?y) (not (b ?x)))))))";
    let wide = "(exists (?p ?q ?r ?s) (and (a ?p) (b ?q) (c ?r) (d ?s)))";
    let make = |p: &str| format!("(:action make-{p} :parameters (?x) :effect ({p} ?x))");
    let made: String = ["a", "b", "c", "d"].map(make).concat();
    let domain = format!(
        "(define (domain d) (:requirements :adl) (:predicates (a ?x) (b ?x) (c ?x) (d ?x) (done) (said))
           {made}
           (:action finish :parameters () :precondition (and {deep} {wide})
            :effect (and (done) (when (or (not {deep}) (and {deep} (imply {deep} {wide}))) (said)))))"
    );
    let objects: String = (0..16).map(|i| format!(" o{i}")).collect();
    let problem = format!(
        "(define (problem p) (:domain d) (:objects{objects}) (:init (d o1) (c o2)) (:goal (and (done) (said))))"
    );
    let domain = pddl::parse_domain(&pddl::Source::new("d", domain), &[]).model.unwrap();
    let problem = pddl::parse_problem(&pddl::Source::new("p", problem), &domain).model.unwrap();
    let options = GroundOptions {
        budget: Budget { memory_bytes: Some(64 << 20), ..Budget::default() },
        ..GroundOptions::default()
    };
    let task = ground(&domain, &problem, &options).unwrap();
    let size = (task.operators().len(), task.axioms().len());
    assert!(size.0 <= 4 * 16 + 16 && size.1 <= 8_000, "{size:?}");
    let case = Case { expected: "solvable".into(), path: "deep".into(), domain, problem };
    let configuration = SearchConfiguration::default();
    let report = solve(&task, &Query::of(&task), &configuration, &Budget::default());
    check(&case, &task, &configuration, &report.outcome);
}
