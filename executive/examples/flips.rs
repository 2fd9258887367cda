//! Compares Monitoring with the validator on tasks from a folder of benchmarks.
//!
//!     cargo run --release -p pelea-executive --example flips -- FOLDER JUDGED [DOMAIN PROBLEM]...
//!
//! JUDGED: about how many suffixes the validator may judge in each task.

#![allow(clippy::print_stdout, reason = "the table is what it is for")]

#[path = "../tests/flips/mod.rs"]
mod flips;

use flips::{COLUMNS, Limits, sweep};
use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [folder, judged, tasks @ ..] = arguments.as_slice() else { return ExitCode::from(2) };
    let Ok(judged) = judged.parse() else { return ExitCode::from(2) };
    let limits = Limits { expansions: 50_000, judged };
    println!("| task | {COLUMNS} |\n|---|---|---|---|---|---|---|---|---|---|---|");
    let mut agrees = true;
    for task in tasks.chunks_exact(2) {
        let path = |name: &str| Path::new(folder).join(name);
        match sweep(&path(&task[0]), &path(&task[1]), limits) {
            Ok(sweep) => {
                agrees &= sweep.wrong.is_empty();
                println!("| {} | {sweep} |", task[1]);
                sweep.wrong.iter().take(3).for_each(|wrong| println!("  {wrong}"));
            }
            Err(why) => println!("| {} | left out: {why} |", task[1]),
        }
    }
    if agrees { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
