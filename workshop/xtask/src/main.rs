//! The project's own commands, `cargo xtask NAME`.
//!
//! `ci` is what `.ci/run` runs: `test`, `lint`, `tidy`. One build profile (release) serves them all,
//! because the planner's tests want its speed and two profiles would build everything twice.

mod arrows;
mod cargo;
mod circles;
mod dependencies;
mod failure;
mod fuzz;
mod modules;
mod packages;
mod record;
mod sources;
mod surface;
mod wings;

use std::process::ExitCode;

use failure::Failure;

const HELP: &str = "cargo xtask COMMAND

  test   every test of the workspace, by nextest where it is installed, and the documentation's examples
  lint   rustfmt --check, clippy and rustdoc, without a warning
  tidy   the arrows of ARCHITECTURE.md equal those of cargo, no dependency is idle, every source keeps the house
         rules, the robot does not depend on the workshop, no files of a crate import each other in a circle,
         and every public item has a user outside its crate
  ci     test, lint, tidy
  fuzz [TARGET] [SECONDS]
         fuzzes what is read from files: PDDL, plans, journals, worlds; 600 s a target; needs `cargo install cargo-fuzz`
  loom   how the graph's readers and writers meet, in every interleaving of a few threads
  soak [SECONDS]
         8 writers, 8 readers and what stalls on one graph, 10 s; ends with an error if an update was lost
  mutants MISSION [--sample N] [--seed S] [--fresh] [--list]
         changes a token of a mission's texts at a time, and lists what no check, test or scenario notices
  crashes [MISSION] [--scenarios A,B] [--every N] [--kills N] [--seed S]
         cuts recorded runs after and within every commit, kills real processes, and goes on with all of them
  record draws docs/figure-8.svg, the README's picture, from a run
";

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let command = arguments.next().unwrap_or_default();
    let done = match command.as_str() {
        "test" => test(),
        "lint" => lint(),
        "tidy" => tidy(),
        "fuzz" => fuzz::fuzz(&arguments.collect::<Vec<_>>()),
        "loom" => loom(),
        "soak" => soak(&arguments.collect::<Vec<_>>()),
        "mutants" => mutants(&arguments.collect::<Vec<_>>()),
        "crashes" => crashes(&arguments.collect::<Vec<_>>()),
        "record" => record::record(),
        "ci" => test().and_then(|()| lint()).and_then(|()| tidy()),
        _ => {
            eprint!("{HELP}");
            return ExitCode::from(2);
        }
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("xtask: {failure}");
            ExitCode::FAILURE
        }
    }
}

fn test() -> Result<(), Failure> {
    if cargo::has_nextest() {
        cargo::run(&["nextest", "run", "--release", "--workspace", "--no-tests=pass"])?;
        cargo::run(&["test", "--release", "--workspace", "--doc"])
    } else {
        cargo::run(&["test", "--release", "--workspace"])
    }
}

/// With a folder of its own: the flag is one of all crates, and would build everything anew twice.
fn loom() -> Result<(), Failure> {
    let test = ["test", "--release", "-p", "pelea-dsr", "--test", "loom", "--target-dir", "target/loom"];
    cargo::run_with(&test, "RUSTFLAGS", "--cfg loom")
}

fn soak(arguments: &[String]) -> Result<(), Failure> {
    let mut command = vec!["run", "--release", "-p", "pelea-dsr", "--example", "soak", "--"];
    command.extend(arguments.iter().map(String::as_str));
    cargo::run(&command)
}

fn mutants(arguments: &[String]) -> Result<(), Failure> {
    let mut command = vec!["run", "--release", "-p", "pelea-tests", "--bin", "mutants", "--"];
    command.extend(arguments.iter().map(String::as_str));
    cargo::run(&command)
}

fn crashes(arguments: &[String]) -> Result<(), Failure> {
    cargo::run(&["build", "--release", "-p", "pelea"])?;
    let mut command = vec!["run", "--release", "-p", "pelea-tests", "--bin", "crashes", "--"];
    command.extend(arguments.iter().map(String::as_str));
    cargo::run(&command)
}

fn lint() -> Result<(), Failure> {
    cargo::run(&["fmt", "--all", "--check"])?;
    cargo::run(&["clippy", "--release", "--workspace", "--all-targets", "--", "-D", "warnings"])?;
    cargo::run_with(&["doc", "--release", "--workspace", "--no-deps"], "RUSTDOCFLAGS", "-D warnings")
}

fn tidy() -> Result<(), Failure> {
    let root = cargo::root();
    let mut findings = arrows::check(&root)?;
    findings.extend(dependencies::check(&root)?);
    findings.extend(sources::check(&root)?);
    let packages = packages::packages(&root)?;
    findings.extend(wings::check(&packages));
    findings.extend(circles::check(&root, &packages)?);
    findings.extend(surface::check(&root, &packages)?);
    for finding in &findings {
        eprintln!("tidy: {finding}");
    }
    if findings.is_empty() { Ok(()) } else { Err(Failure::Findings(findings.len())) }
}
