//! Medians of the planner's hot paths on tasks of `test_data`: grounding, expansion of nodes, hFF,
//! a whole replan.
#![allow(missing_docs)]

use criterion::{Criterion, criterion_group, criterion_main};
use planner::{Budget, GroundOptions, Query, SearchConfiguration, Task, ground, solve};
use std::hint::black_box;
use std::path::Path;

struct Input {
    domain: pddl::model::Domain,
    problem: pddl::model::Problem,
}

fn input(name: &str, problem: &str) -> Input {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("test_data").join(name);
    let read = |file: &str| {
        let text = std::fs::read_to_string(folder.join(file)).expect("test data is in the repository");
        pddl::Source::new(file, text)
    };
    let domain = pddl::parse_domain(&read("domain.pddl"), &[]).model.expect("test data is correct");
    let problem = pddl::parse_problem(&read(problem), &domain).model.expect("test data is correct");
    Input { domain, problem }
}

fn task(input: &Input) -> Task {
    ground(&input.domain, &input.problem, &GroundOptions::default()).expect("test data can be grounded")
}

/// A search of `expansions` nodes; the time of one is the median divided by them.
fn expand(task: &Task, name: &str, expansions: u64) {
    let configuration = SearchConfiguration::named(name).expect("a configuration of the registry");
    let budget = Budget { work: Some(expansions), ..Budget::default() };
    black_box(solve(task, &Query::of(task), &configuration, &budget));
}

fn benches(c: &mut Criterion) {
    let depots = input("yard", "twelve-crates.pddl");
    c.bench_function("ground/yard", |b| b.iter(|| task(black_box(&depots))));
    let yard = task(&depots);
    c.bench_function("expand-1000/blind/yard", |b| b.iter(|| expand(&yard, "astar-blind", 1000)));
    c.bench_function("expand-100/ff/yard", |b| b.iter(|| expand(&yard, "lazy-ff", 100)));
    c.bench_function("replan/lama/yard", |b| b.iter(|| expand(&yard, "lama", u64::MAX)));
    let small = task(&input("gripper", "four-balls.pddl"));
    c.bench_function("replan/lama/gripper", |b| b.iter(|| expand(&small, "lama", u64::MAX)));
}

criterion_group!(planner, benches);
criterion_main!(planner);
