//! `repair DOMAIN PROBLEM [ROUNDS] [SEED] [PREDICATE,...]`: breaks a plan at random and repairs it, by
//! reuse and from scratch. Shows the time of both and the distances of their plans from the old one.
//!
//! A disruption is one to three steps of another agent, or spontaneous changes of facts of the named
//! predicates. Disruptions that do not break the plan are not counted.
#![allow(clippy::print_stdout, missing_docs)]

mod files;
mod states;

use planner::{
    Attempt, Budget, FactId, GroundOptions, Outcome, Query, Repair, SearchConfiguration, State, Task, ground,
    solve,
};
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use std::time::{Duration, Instant};

/// A new plan is given up after so long.
const PATIENCE: Duration = Duration::from_secs(10);

/// Random numbers; the seed alone decides them.
struct Dice(Pcg64Mcg);

impl Dice {
    fn below(&mut self, sides: usize) -> usize {
        usize::try_from(self.0.next_u64() % sides.max(1) as u64).unwrap_or(0)
    }
}

/// A mended plan's figures.
#[derive(Default)]
struct Column {
    micros: Vec<f64>,
    distances: Vec<usize>,
    costs: Vec<u64>,
    expanded: u64,
}

impl Column {
    fn add(&mut self, attempt: &Attempt, time: Duration) {
        self.micros.push(time.as_secs_f64() * 1e6);
        self.expanded += attempt.report.statistics.expanded;
        if let Some((plan, distance)) = attempt.plan() {
            self.distances.push(distance.steps());
            self.costs.push(plan.cost);
        }
    }

    #[expect(clippy::cast_precision_loss, reason = "averages of small numbers")]
    fn row(&mut self, name: &str) -> String {
        self.micros.sort_by(f64::total_cmp);
        let at = |percent: usize| self.micros[(self.micros.len() - 1) * percent / 100];
        let mean = |sum: f64, n: usize| sum / n.max(1) as f64;
        format!(
            "{name}: {} plans, p50 {:.0} µs, p90 {:.0} µs, worst {:.0} µs, {:.1} expanded, distance {:.2}, cost {:.1}",
            self.distances.len(),
            at(50),
            at(90),
            at(100),
            mean(self.expanded as f64, self.micros.len()),
            mean(self.distances.iter().sum::<usize>() as f64, self.distances.len()),
            mean(self.costs.iter().sum::<u64>() as f64, self.costs.len()),
        )
    }
}

fn disrupt(task: &Task, state: &State, flips: &[FactId], dice: &mut Dice) -> Option<State> {
    if !flips.is_empty() {
        let mut facts = state.facts();
        let fact = flips[dice.below(flips.len())];
        match facts.iter().position(|&f| f == fact) {
            Some(at) => drop(facts.remove(at)),
            None => facts.push(fact),
        }
        return Some(task.state(facts));
    }
    let mut state = state.clone();
    for _ in 0..=dice.below(3) {
        let applicable = task.applicable(&state);
        state = task.successor(&state, *applicable.get(dice.below(applicable.len()))?)?;
    }
    Some(state)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [domain, problem, rest @ ..] = arguments.as_slice() else {
        return Err("DOMAIN PROBLEM [ROUNDS] [SEED] [PREDICATE,...]".into());
    };
    let rounds: usize = rest.first().map_or(Ok(100), |text| text.parse())?;
    let seed = rest.get(1).map_or(Ok(1), |text| text.parse())?;
    let mut dice = Dice(Pcg64Mcg::seed_from_u64(seed));
    let (domain, problem) = files::read(domain, problem)?;
    let names =
        rest.get(2).map_or_else(Vec::new, |list| list.split(',').map(pddl::model::Name::new).collect());
    let exogenous: Vec<_> = names.iter().filter_map(|name| domain.predicate(name)).collect();
    let task =
        ground(&domain, &problem, &GroundOptions { exogenous: &exogenous, ..GroundOptions::default() })?;
    let outside = |fact: &planner::Fact| fact.atom.as_ref().is_some_and(|a| exogenous.contains(&a.predicate));
    let flips: Vec<FactId> = task.facts().enumerate().filter(|(_, f)| outside(f)).map(|(id, _)| id).collect();
    let configuration = SearchConfiguration::default();
    let report = solve(&task, &Query::of(&task), &configuration, &Budget::default());
    let Outcome::Solved(plan) = report.outcome else { return Err(format!("{report:?}").into()) };
    let states = states::along(&task, &plan)?;
    let (mut reuse, mut scratch) = (Column::default(), Column::default());
    let (mut whole, mut hopeless, mut nearer, mut farther) = (0, 0, 0, 0);
    let mut log_ratio = 0.0;
    for _ in 0..rounds {
        let at = dice.below(plan.operators.len());
        let broken = &plan.operators[at..];
        let Some(state) = disrupt(&task, &states[at], &flips, &mut dice) else { continue };
        if task.after(&state, broken).is_some_and(|end| task.satisfies(&end, task.goal())) {
            whole += 1;
            continue;
        }
        let repair = Repair { task: &task, query: Query { state: &state, ..Query::of(&task) }, broken };
        let start = Instant::now();
        let old = repair.reuse(&Budget::default());
        let reuse_time = start.elapsed();
        let start = Instant::now();
        let interrupted = || start.elapsed() > PATIENCE;
        let new = repair.afresh(&configuration, &Budget { interrupted: &interrupted, ..Budget::default() });
        let scratch_time = start.elapsed();
        if matches!(new.report.outcome, Outcome::Unsolvable(_)) {
            hopeless += 1;
            continue;
        }
        log_ratio += (scratch_time.as_secs_f64() / reuse_time.as_secs_f64()).ln();
        if let (Some((_, old)), Some((_, new))) = (old.plan(), new.plan()) {
            nearer += usize::from(old.steps() < new.steps());
            farther += usize::from(old.steps() > new.steps());
        }
        reuse.add(&old, reuse_time);
        scratch.add(&new, scratch_time);
    }
    let broken = reuse.micros.len();
    println!(
        "plan of {} steps; {rounds} disruptions: {whole} broke nothing, {hopeless} left no way, {broken} to mend",
        plan.operators.len()
    );
    if broken > 0 {
        println!("{}\n{}", reuse.row("reuse"), scratch.row("scratch"));
        #[expect(clippy::cast_precision_loss, reason = "an average of few")]
        let ratio = (log_ratio / broken as f64).exp();
        println!(
            "reuse is {ratio:.2} times as fast (geometric mean), nearer {nearer} times, farther {farther} times"
        );
    }
    Ok(())
}
