//! `ground DOMAIN PROBLEM [MIB]`: grounds, within so much memory, and says in one line what that took, for
//! measuring.
#![allow(clippy::print_stdout, missing_docs)]

mod files;

use planner::{Budget, GroundOptions, ground};
use std::time::{Duration, Instant};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [domain, problem, rest @ ..] = arguments.as_slice() else {
        return Err("DOMAIN PROBLEM [MIB]".into());
    };
    let memory_bytes = match rest {
        [mebibytes, ..] => Some(mebibytes.parse::<usize>()? << 20),
        [] => None,
    };
    let start = Instant::now();
    let (domain, problem) = files::read(domain, problem)?;
    let parsed = start.elapsed();
    let late = move || start.elapsed() > Duration::from_secs(120);
    let start = Instant::now();
    let budget = Budget { memory_bytes, interrupted: &late, ..Budget::default() };
    let options = GroundOptions { budget, ..GroundOptions::default() };
    let task = match ground(&domain, &problem, &options) {
        Ok(task) => task,
        Err(error) => {
            println!("{error}\tafter {:.0} ms", start.elapsed().as_secs_f64() * 1e3);
            return Ok(());
        }
    };
    let grounded = start.elapsed();
    println!(
        "parse {:.2} ms\tground {:.2} ms\t{} facts\t{} operators\t{} rules\t{} groups\t{} variables, {} single\t{} MiB held",
        parsed.as_secs_f64() * 1e3,
        grounded.as_secs_f64() * 1e3,
        task.facts().len(),
        task.operators().len(),
        task.axioms().len(),
        task.mutexes().len(),
        task.variables().len(),
        task.variables().iter().filter(|v| v.facts.len() == 1).count(),
        task.memory_bytes() >> 20
    );
    Ok(())
}
