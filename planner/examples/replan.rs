//! `replan DOMAIN PROBLEM [SEARCH] [ROUNDS]`: grounds once, then plans from every state along a plan,
//! again and again, and shows the distribution of the times: what a robot feels that replans.
#![allow(clippy::print_stdout, clippy::print_stderr, missing_docs)]

mod files;
mod states;

use planner::{Budget, GroundOptions, Outcome, Query, SearchConfiguration, ground, solve};
use std::time::{Duration, Instant};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [domain, problem, rest @ ..] = arguments.as_slice() else {
        return Err("DOMAIN PROBLEM [SEARCH] [ROUNDS]".into());
    };
    let configuration = match rest {
        [name, ..] => SearchConfiguration::named(name).ok_or("no such search")?,
        [] => SearchConfiguration::default(),
    };
    let rounds: usize = rest.get(1).map_or(Ok(100), |text| text.parse())?;
    let (domain, problem) = files::read(domain, problem)?;
    let start = Instant::now();
    let task = ground(&domain, &problem, &GroundOptions::default())?;
    println!(
        "grounded in {:?}: {} facts, {} operators",
        start.elapsed(),
        task.facts().len(),
        task.operators().len()
    );
    let report = solve(&task, &Query::of(&task), &configuration, &Budget::default());
    let Outcome::Solved(plan) = report.outcome else { return Err(format!("{report:?}").into()) };
    let states = states::along(&task, &plan)?;
    let mut times: Vec<Duration> = Vec::new();
    for _ in 0..rounds {
        for state in &states {
            let start = Instant::now();
            let query = Query { state, ..Query::of(&task) };
            let report = solve(&task, &query, &configuration, &Budget::default());
            times.push(start.elapsed());
            if !matches!(report.outcome, Outcome::Solved(_)) {
                return Err(format!("{report:?}").into());
            }
        }
    }
    times.sort_unstable();
    let at = |percent: usize| times[(times.len() - 1) * percent / 100];
    println!(
        "{}: {} replans on a plan of {} steps: p50 {:?}, p90 {:?}, p95 {:?}, p99 {:?}, worst {:?}",
        configuration.name,
        times.len(),
        plan.operators.len(),
        at(50),
        at(90),
        at(95),
        at(99),
        at(100)
    );
    Ok(())
}
