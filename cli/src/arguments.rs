//! The tree of commands.

use crate::console::{Console, Form};
use crate::exit::Exit;
use crate::{check, dsr as graphs, explain, fmt, lsp, plan, run as mission, test, validate};
use clap::{Parser, Subcommand};
use std::ffi::OsString;

/// A planner-centric executive for robots: PDDL in, safe behaviour out.
#[derive(Debug, Parser)]
#[command(
    name = "pelea",
    version,
    after_help = "Exit codes: 0 yes · 1 no · 2 input that cannot be read · 3 a limit was reached · \
                  4 a PDDL feature that the command does not support · 70 a bug of ours · 74 cannot write"
)]
struct Arguments {
    /// Write one JSON object a line on standard output.
    #[arg(long, global = true)]
    json: bool,
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Carry a mission out, on simulated devices.
    Run(mission::Arguments),
    /// Find a plan.
    Plan(plan::Arguments),
    /// Check plans.
    Validate(validate::Arguments),
    /// Report every error of missions, domains, problems and methods.
    Check(check::Arguments),
    /// Run the tests of domains: `expected.toml` beside them.
    Test(test::Arguments),
    /// Lay files out, changing white space only.
    Fmt(fmt::Arguments),
    /// Look at the graph of a run, at any version: states, differences, history, questions; worlds of others.
    #[command(subcommand)]
    Dsr(graphs::Command),
    /// Serve an editor: the language server for PDDL, HDDL and plans, on standard input and output.
    Lsp(lsp::Arguments),
    /// Say what a diagnostic's code means, with examples.
    Explain(explain::Arguments),
}

/// Parses the arguments (the first is the program's name) and runs the command.
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
