//! `plan DOMAIN PROBLEM [SEARCH] [-o PLAN] [--timeout S] [--memory MIB]`: grounds and solves, for measuring;
//! with `--improve` goes on to better plans until the time is over. The command that users
//! call is `pelea plan`.
#![allow(clippy::print_stdout, clippy::print_stderr, missing_docs)]

mod files;

use planner::{Budget, GroundOptions, Outcome, Query, SearchConfiguration, ground, solve};
use std::time::{Duration, Instant};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let start = Instant::now();
    let mut arguments: Vec<String> = std::env::args().skip(1).collect();
    let output = arguments.iter().position(|a| a == "-o").map(|i| arguments.drain(i..i + 2).nth(1));
    let timeout = arguments.iter().position(|a| a == "--timeout").map(|i| arguments.drain(i..i + 2).nth(1));
    let timeout = timeout.flatten().map_or(Ok(300.0), |text| text.parse())?;
    let memory = arguments.iter().position(|a| a == "--memory").map(|i| arguments.drain(i..i + 2).nth(1));
    let memory: usize = memory.flatten().map_or(Ok(4096), |text| text.parse())?;
    let improving = arguments.iter().position(|a| a == "--improve").map(|i| arguments.remove(i)).is_some();
    let [domain, problem, rest @ ..] = arguments.as_slice() else {
        return Err("DOMAIN PROBLEM [SEARCH]".into());
    };
    let configuration = match rest {
        [name, ..] => SearchConfiguration::named(name).ok_or("no such search")?,
        [] => SearchConfiguration::portfolio(),
    };
    let (domain, problem) = files::read(domain, problem)?;
    eprintln!("parsed     {:9.3} s", start.elapsed().as_secs_f64());
    let late = move || start.elapsed() > Duration::from_secs_f64(timeout);
    let budget = Budget { interrupted: &late, ..Budget::default() };
    let task = ground(&domain, &problem, &GroundOptions { budget, ..GroundOptions::default() })?;
    eprintln!(
        "grounded   {:9.3} s, {} facts, {} operators, {} axioms, {} goals",
        start.elapsed().as_secs_f64(),
        task.facts().len(),
        task.operators().len(),
        task.axioms().len(),
        task.goal().literals.len()
    );
    let memory = (memory << 20).saturating_sub(task.memory_bytes());
    let budget = Budget { memory_bytes: Some(memory), ..budget };
    let report = if improving {
        let mut tell = |plan: &planner::Plan| {
            eprintln!(
                "{:9.3} s, cost {}",
                start.elapsed().as_secs_f64(),
                plan.cost / u64::from(task.cost_scale())
            );
        };
        let improved = planner::improve(&task, &Query::of(&task), &configuration, &budget, &mut tell);
        eprintln!("{:9.3} s, {:?}", start.elapsed().as_secs_f64(), improved.quality);
        improved.report
    } else {
        solve(&task, &Query::of(&task), &configuration, &budget)
    };
    let Outcome::Solved(plan) = &report.outcome else {
        eprintln!("{:9.3} s {report:?}", start.elapsed().as_secs_f64());
        return Ok(());
    };
    let lines: String = plan.operators.iter().map(|&o| task.operator_name(o) + "\n").collect();
    let text = format!("{lines}; cost = {}\n", plan.cost / u64::from(task.cost_scale()));
    let steps = plan.operators.iter().map(|&o| {
        let o = task.operator(o);
        pddl::PlanStep { action: o.action, arguments: o.arguments.to_vec(), span: pddl::Span::default() }
    });
    eprintln!("solved     {:9.3} s {:?}", start.elapsed().as_secs_f64(), report.statistics);
    let verdict = validator::validate(&domain, &problem, &pddl::SequentialPlan::new(steps.collect()));
    if !verdict.is_valid() {
        return Err(format!("INVALID {verdict:?}").into());
    }
    match output.flatten() {
        Some(path) => std::fs::write(path, text)?,
        None => print!("{text}"),
    }
    eprintln!("valid      {:9.3} s", start.elapsed().as_secs_f64());
    Ok(())
}
