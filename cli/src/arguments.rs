//! The tree of commands.

use crate::console::{Console, Form};
use crate::exit::Exit;
use crate::{
    campaign, check, dsr as graphs, explain, fmt, lsp, plan, replay, run as mission, test, validate,
};
use clap::{Parser, Subcommand};
use std::ffi::OsString;

/// A planner-centric executive for robots: PDDL in, safe behaviour out.
#[derive(Debug, Parser)]
#[command(
    name = "pelea",
    version,
    after_help = "Exit codes: 0 success · 1 negative result · 2 invalid input · 3 limit reached · \
                  4 unsupported PDDL feature · 70 internal error · 74 output cannot be written · 130 interrupted"
)]
struct Arguments {
    /// Write the output as JSON, one object per line
    #[arg(long, global = true)]
    json: bool,
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Run a mission on simulated devices
    Run(mission::Arguments),
    /// Repeat the decisions of a recorded run, and show why each was made
    Replay(replay::Arguments),
    /// Disturb a mission in every known way at every instant, and check its invariants
    Campaign(campaign::Arguments),
    /// Find a plan
    Plan(plan::Arguments),
    /// Validate plans
    Validate(validate::Arguments),
    /// Check missions, domains, problems and methods for errors
    Check(check::Arguments),
    /// Run the tests of domains (`expected.toml`)
    Test(test::Arguments),
    /// Format files; changes only white space
    Fmt(fmt::Arguments),
    /// Inspect the graph of a run at any version, or import a world
    #[command(subcommand)]
    Dsr(graphs::Command),
    /// Start the language server for PDDL, HDDL and plans on standard input and output
    Lsp(lsp::Arguments),
    /// Explain a diagnostic code, with examples
    Explain(explain::Arguments),
}

/// Parses the arguments (the first is the name of the program) and runs the command.
pub fn run<I>(arguments: I, console: &mut Console<'_>) -> Exit
where
    I: IntoIterator,
    I::Item: Into<OsString> + Clone,
{
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(error) => {
            let text =
                if console.colour() { error.render().ansi().to_string() } else { error.render().to_string() };
            if error.use_stderr() {
                console.complain(&text);
                return Exit::Unreadable;
            }
            console.print(&text);
            return Exit::Yes;
        }
    };
    if arguments.json {
        console.set_form(Form::Json);
    }
    match arguments.command {
        Command::Run(arguments) => mission::run(&arguments, console),
        Command::Campaign(arguments) => campaign::run(&arguments, console),
        Command::Replay(arguments) => replay::run(&arguments, console),
        Command::Plan(arguments) => plan::run(&arguments, console),
        Command::Validate(arguments) => validate::run(&arguments, console),
        Command::Check(arguments) => check::run(&arguments, console),
        Command::Test(arguments) => test::run(&arguments, console),
        Command::Fmt(arguments) => fmt::run(&arguments, console),
        Command::Dsr(command) => graphs::run(&command, console),
        Command::Lsp(arguments) => lsp::run(&arguments),
        Command::Explain(arguments) => explain::run(&arguments, console),
    }
}
