//! Time per step of a long plan, per language feature. Figures: `BENCHMARKS.md`.

#![allow(missing_docs, clippy::unwrap_used, reason = "a benchmark may panic")]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use pddl::{Plan, Source, parse_domain, parse_plan, parse_problem};
use std::fmt::Write;
use std::hint::black_box;
use validator::Validator;

const STEPS: usize = 10_000;
const ROOMS: usize = 50;

/// A task in text, and a plan for it.
struct Case {
    domain: String,
    problem: String,
    plan: String,
    steps: usize,
}

impl Case {
    fn run(&self, criterion: &mut Criterion, name: &str) {
        let domain = parse_domain(&Source::new("domain", &*self.domain), &[]);
        let domain = domain.model.unwrap_or_else(|| panic!("{name}: {:?}", domain.diagnostics));
        let problem = parse_problem(&Source::new("problem", &*self.problem), &domain);
        let problem = problem.model.unwrap_or_else(|| panic!("{name}: {:?}", problem.diagnostics));
        let plan = parse_plan(&Source::new("plan", &*self.plan), &domain, &problem);
        let plan: Plan = plan.model.unwrap_or_else(|| panic!("{name}: {:?}", plan.diagnostics));
        let validator = Validator::new(&domain, &problem).unwrap();
        assert!(validator.validate(&plan).is_valid(), "{name}: {:?}", validator.validate(&plan));
        let mut group = criterion.benchmark_group("validate");
        group.throughput(Throughput::Elements(self.steps as u64));
        group.sample_size(10);
        group.bench_function(name, |bencher| bencher.iter(|| validator.validate(black_box(&plan))));
        group.finish();
    }
}

/// The rooms of a ring, what leads where, and how long that is.
fn ring() -> (String, String) {
    let (mut objects, mut init) = (String::new(), String::new());
    for room in 0..ROOMS {
        let next = (room + 1) % ROOMS;
        write!(objects, " r{room}").unwrap();
        write!(init, " (next r{room} r{next}) (= (way r{room} r{next}) 1.5)").unwrap();
    }
    (objects, init)
}

/// A walk over the ring; `extra` goes into the action's effect and `guard` into its precondition, `axioms` into the
/// domain and `demands` into the problem.
fn walk(criterion: &mut Criterion, name: &str, guard: &str, extra: &str, axioms: &str, demands: &str) {
    let domain = format!(
        "(define (domain ring) (:requirements :adl :numeric-fluents :derived-predicates :constraints :preferences)
           (:predicates (at ?r) (next ?a ?b) (seen ?r) (lit ?r) (near ?r) (linked ?a ?b))
           (:functions (total-cost) (way ?a ?b))
           {axioms}
           (:action go :parameters (?a ?b) :precondition (and (at ?a) (next ?a ?b) {guard})
             :effect (and (at ?b) (not (at ?a)) (seen ?b) {extra})))"
    );
    let (objects, init) = ring();
    let mut plan = String::new();
    for step in 0..STEPS {
        writeln!(plan, "(go r{} r{})", step % ROOMS, (step + 1) % ROOMS).unwrap();
    }
    let problem = format!(
        "(define (problem p) (:domain ring) (:objects{objects})
           (:init (at r0) (= (total-cost) 0){init}) (:goal (at r0)) {demands} (:metric minimize (total-cost)))"
    );
    Case { domain, problem, plan, steps: STEPS }.run(criterion, name);
}

fn sequential(criterion: &mut Criterion) {
    walk(criterion, "classical", "", "", "", "");
    walk(criterion, "costs", "", "(increase (total-cost) (way ?a ?b))", "", "");
    walk(
        criterion,
        "numeric",
        "(>= (* 2 (+ (total-cost) (way ?a ?b))) 0.5)",
        "(increase (total-cost) (way ?a ?b)) (assign (way ?a ?b) (/ (+ (way ?a ?b) 1.5) 2))",
        "",
        "",
    );
    walk(criterion, "exists", "(exists (?c) (and (next ?b ?c) (not (at ?c))))", "", "", "");
    walk(criterion, "forall", "(forall (?c) (imply (at ?c) (= ?c ?a)))", "", "", "");
    walk(criterion, "universal-effect", "", "(forall (?c) (when (seen ?c) (lit ?c)))", "", "");
}

fn axioms(criterion: &mut Criterion) {
    let near = "(:derived (near ?r) (exists (?c) (and (at ?c) (next ?c ?r))))";
    walk(criterion, "axiom", "(near ?b)", "", near, "");
    // A door opens behind and closes in front: 50 rooms, of which the chain that leads on changes with each step.
    let linked = "(:derived (linked ?a ?b) (or (and (lit ?a) (next ?a ?b))
        (exists (?c) (and (lit ?a) (next ?a ?c) (linked ?c ?b)))))";
    let toggled = "(when (lit ?b) (not (lit ?b))) (when (not (lit ?b)) (lit ?b))";
    walk(criterion, "recursive-axiom", "(or (linked ?a ?b) (not (lit ?a)))", toggled, linked, "");
}

fn trajectories(criterion: &mut Criterion) {
    let hard = "(:constraints (and (always (exists (?r) (at ?r))) (forall (?r) (sometime (at ?r)))
        (sometime-after (at r3) (at r4)) (sometime-before (at r9) (at r8))))";
    walk(criterion, "constraints", "", "", "", hard);
}

/// Ten robots on the ring at once.
fn temporal(criterion: &mut Criterion) {
    const ROBOTS: usize = 10;
    let cases = [
        ("temporal", "(at end (decrease (fuel ?x) 0.1))", ":numeric-fluents"),
        ("continuous", "(decrease (fuel ?x) (* #t 0.1))", ":numeric-fluents :continuous-effects"),
    ];
    for (name, use_of_fuel, requirements) in cases {
        let domain = format!(
            "(define (domain ring) (:requirements :typing :durative-actions {requirements}) (:types robot room)
               (:predicates (at ?x - robot ?r - room) (next ?a ?b - room))
               (:functions (fuel ?x - robot) (way ?a ?b - room))
               (:durative-action go :parameters (?x - robot ?a ?b - room) :duration (= ?duration (way ?a ?b))
                 :condition (and (at start (at ?x ?a)) (over all (next ?a ?b)) (over all (>= (fuel ?x) 0)))
                 :effect (and (at start (not (at ?x ?a))) (at end (at ?x ?b)) {use_of_fuel})))"
        );
        let (rooms, mut init) = ring();
        let (mut robots, mut plan) = (String::new(), String::new());
        for robot in 0..ROBOTS {
            write!(robots, " x{robot}").unwrap();
            write!(init, " (at x{robot} r0) (= (fuel x{robot}) 100000)").unwrap();
        }
        for step in 0..STEPS {
            let (turn, robot) = (step / ROBOTS, step % ROBOTS);
            let (from, to) = (turn % ROOMS, (turn + 1) % ROOMS);
            writeln!(plan, "{}.{robot}: (go x{robot} r{from} r{to}) [1.5]", 3 * turn).unwrap();
        }
        let problem = format!(
            "(define (problem p) (:domain ring) (:objects{robots} - robot{rooms} - room)
               (:init {init}) (:goal (at x0 r0)) (:metric minimize (total-time)))"
        );
        Case { domain, problem, plan, steps: STEPS }.run(criterion, name);
    }
}

/// The walk as a task that is carried out by going one step and carrying out the same task again.
fn hierarchical(criterion: &mut Criterion) {
    const STEPS: usize = 1_000;
    let domain =
        "(define (domain ring) (:requirements :typing :hierarchy :negative-preconditions) (:types room)
           (:predicates (at ?r - room) (next ?a ?b - room))
           (:task walk :parameters (?b - room))
           (:method on :parameters (?a ?b ?to - room) :task (walk ?to) :precondition (next ?a ?b)
             :ordered-subtasks (and (go ?a ?b) (walk ?to)))
           (:method there :parameters (?to - room) :task (walk ?to) :precondition (at ?to) :subtasks ())
           (:action go :parameters (?a ?b - room) :precondition (and (at ?a) (next ?a ?b))
             :effect (and (at ?b) (not (at ?a)))))"
            .to_owned();
    let (mut objects, mut init) = (String::new(), String::new());
    for room in 0..ROOMS {
        write!(objects, " r{room}").unwrap();
        write!(init, " (next r{room} r{})", (room + 1) % ROOMS).unwrap();
    }
    let problem = format!(
        "(define (problem p) (:domain ring) (:objects{objects} - room)
           (:htn :subtasks (walk r0)) (:init (at r0) {init}))"
    );
    let mut plan = "==>\n".to_owned();
    for step in 0..STEPS {
        writeln!(plan, "{step} go r{} r{}", step % ROOMS, (step + 1) % ROOMS).unwrap();
    }
    writeln!(plan, "root {STEPS}").unwrap();
    for step in 0..STEPS {
        writeln!(plan, "{} walk r0 -> on {step} {}", STEPS + step, STEPS + step + 1).unwrap();
    }
    writeln!(plan, "{} walk r0 -> there\n<==", 2 * STEPS).unwrap();
    Case { domain, problem, plan, steps: STEPS }.run(criterion, "hierarchical");
}

criterion_group!(benches, sequential, axioms, trajectories, temporal, hierarchical);
criterion_main!(benches);
