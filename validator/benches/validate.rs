//! Time per step of a long plan, per language feature. Figures: `BENCHMARKS.md`.

#![allow(missing_docs, clippy::unwrap_used, reason = "a benchmark may panic")]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use pddl::{Source, parse_domain, parse_plan, parse_problem};
use std::fmt::Write;
use std::hint::black_box;
use validator::Validator;

const STEPS: usize = 10_000;

/// A walk over a ring of rooms; `extra` goes into the action's effect and `guard` into its precondition.
fn walk(criterion: &mut Criterion, name: &str, guard: &str, extra: &str, axiom: &str) {
    let rooms = 50;
    let domain = format!(
        "(define (domain ring) (:requirements :adl :numeric-fluents :derived-predicates)
           (:predicates (at ?r) (next ?a ?b) (seen ?r) (lit ?r) (near ?r)) (:functions (total-cost) (way ?a ?b))
           {axiom}
           (:action go :parameters (?a ?b) :precondition (and (at ?a) (next ?a ?b) {guard})
             :effect (and (at ?b) (not (at ?a)) (seen ?b) {extra})))"
    );
    let domain = parse_domain(&Source::new("domain", domain), &[]).model.unwrap();
    let (mut objects, mut init, mut plan) = (String::new(), String::new(), String::new());
    for room in 0..rooms {
        let next = (room + 1) % rooms;
        write!(objects, " r{room}").unwrap();
        write!(init, " (next r{room} r{next}) (= (way r{room} r{next}) 1.5)").unwrap();
    }
    for step in 0..STEPS {
        writeln!(plan, "(go r{} r{})", step % rooms, (step + 1) % rooms).unwrap();
    }
    let problem = format!(
        "(define (problem p) (:domain ring) (:objects{objects})
           (:init (at r0) (= (total-cost) 0){init}) (:goal (at r0)) (:metric minimize (total-cost)))"
    );
    let problem = parse_problem(&Source::new("problem", problem), &domain).model.unwrap();
    let plan = parse_plan(&Source::new("plan", plan), &domain, &problem).model.unwrap();
    let plan = plan.into_sequential().unwrap();
    let validator = Validator::new(&domain, &problem).unwrap();
    assert!(validator.validate(&plan).is_valid(), "{name}: {:?}", validator.validate(&plan));
    let mut group = criterion.benchmark_group("validate");
    group.throughput(Throughput::Elements(STEPS as u64));
    group.sample_size(20);
    group.bench_function(name, |bencher| bencher.iter(|| validator.validate(black_box(&plan))));
    group.finish();
}

fn features(criterion: &mut Criterion) {
    walk(criterion, "strips", "", "", "");
    walk(criterion, "costs", "", "(increase (total-cost) (way ?a ?b))", "");
    walk(criterion, "exists", "(exists (?c) (and (next ?b ?c) (not (at ?c))))", "", "");
    walk(criterion, "forall", "(forall (?c) (imply (at ?c) (= ?c ?a)))", "", "");
    walk(criterion, "universal-effect", "", "(forall (?c) (when (seen ?c) (lit ?c)))", "");
    walk(
        criterion,
        "axiom",
        "(near ?b)",
        "",
        "(:derived (near ?r) (exists (?c) (and (at ?c) (next ?c ?r))))",
    );
}

criterion_group!(benches, features);
criterion_main!(benches);
