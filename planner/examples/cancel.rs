//! `cancel DOMAIN PROBLEM [ROUNDS] [SECONDS] [wall]`: cancels grounding, and then searching, improving and
//! repairing, at random instants, and shows how long each took to return from then on. Instants and delays
//! are processor time of the whole process, so that other programs do not matter; where two threads run,
//! both are counted. With `wall` they are wall time, for a machine where nothing else runs.
#![allow(clippy::print_stdout, clippy::print_stderr, missing_docs)]

mod files;

use planner::{
    Budget, GroundOptions, Outcome, Preference, Query, SearchConfiguration, ground, improve, repair, solve,
};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use rustix::time::{ClockId, clock_gettime};
use std::time::Duration;

/// What the clock shows.
fn now(clock: ClockId) -> Duration {
    let time = clock_gettime(clock);
    Duration::new(u64::try_from(time.tv_sec).unwrap_or(0), u32::try_from(time.tv_nsec).unwrap_or(0))
}

fn budget(interrupted: &(dyn Fn() -> bool + Sync)) -> Budget<'_> {
    Budget { interrupted, memory_bytes: Some(4 << 30), ..Budget::default() }
}

/// Random instants.
struct Instants {
    random: Pcg64Mcg,
    clock: ClockId,
}

impl Instants {
    fn below(&mut self, most: Duration) -> Duration {
        most.mul_f64(f64::from(self.random.next_u32()) / f64::from(u32::MAX))
    }
}

/// Cancels `work` again and again; it says whether it was cancelled.
fn measure(
    name: &str,
    rounds: usize,
    most: Duration,
    instants: &mut Instants,
    mut work: impl FnMut(&(dyn Fn() -> bool + Sync)) -> bool,
) {
    let clock = instants.clock;
    let used = || now(clock);
    let mut delays = Vec::new();
    for _ in 0..rounds {
        let end = used() + instants.below(most);
        if work(&move || used() >= end) {
            delays.push(used().saturating_sub(end).as_secs_f64() * 1e3);
        }
    }
    delays.sort_unstable_by(f64::total_cmp);
    let Some(last) = delays.len().checked_sub(1) else {
        println!("{name:8}  done before each of {rounds} instants");
        return;
    };
    println!(
        "{name:8}  cancelled {:3} times up to {:6.0} ms: p50 {:6.2} ms, p99 {:6.2} ms, longest {:6.2} ms",
        delays.len(),
        most.as_secs_f64() * 1e3,
        delays[last / 2],
        delays[last * 99 / 100],
        delays[last]
    );
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [domain, problem, rest @ ..] = arguments.as_slice() else {
        return Err("DOMAIN PROBLEM [ROUNDS] [SECONDS] [wall]".into());
    };
    let rounds: usize = rest.first().map_or(Ok(50), |text| text.parse())?;
    let seconds = Duration::from_secs_f64(rest.get(1).map_or(Ok(2.0), |text| text.parse())?);
    let (domain, problem) = files::read(domain, problem)?;

    let clock = match rest.get(2).map(String::as_str) {
        Some("wall") => ClockId::Monotonic,
        _ => ClockId::ProcessCPUTime,
    };
    let start = now(clock);
    let task = ground(&domain, &problem, &GroundOptions::default())?;
    let whole = now(clock) - start;
    println!("{} facts, {} operators", task.facts().len(), task.operators().len());
    let mut instants = Instants { random: Pcg64Mcg::seed_from_u64(2009), clock };
    measure("ground", rounds, whole, &mut instants, |interrupted| {
        ground(
            &domain,
            &problem,
            &GroundOptions {
                budget: Budget { interrupted, ..Budget::default() },
                ..GroundOptions::default()
            },
        )
        .is_err()
    });

    let query = Query::of(&task);
    let searches = [SearchConfiguration::portfolio(), SearchConfiguration::default()];
    for configuration in &searches {
        measure(configuration.name, rounds, seconds, &mut instants, |interrupted| {
            let report = solve(&task, &query, configuration, &budget(interrupted));
            !matches!(report.outcome, Outcome::Solved(_) | Outcome::Unsolvable(_))
        });
    }
    measure("improve", rounds, seconds, &mut instants, |interrupted| {
        let mut none = |_: &planner::Plan| {};
        let improved = improve(&task, &query, &searches[0], &budget(interrupted), &mut none);
        improved.quality != planner::Quality::Optimal
    });
    let end = now(clock) + 10 * seconds;
    let found = solve(&task, &query, &searches[0], &budget(&move || now(clock) >= end));
    if let Outcome::Solved(plan) = found.outcome {
        let excluded = &plan.operators[plan.operators.len() / 2..][..1];
        let query = Query { excluded, ..query };
        measure("repair", rounds, seconds, &mut instants, |interrupted| {
            let (broken, budget) = (&plan.operators, budget(interrupted));
            let repaired = repair(&task, &query, broken, &searches[1], Preference::Stability, &budget);
            repaired.fresh.is_none()
        });
    }
    Ok(())
}
