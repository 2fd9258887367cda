//! The command line of pelea: arguments, files, the terminal. The only composition root.
//!
//! Each command is a module with its clap arguments and one function from arguments to [`Exit`]. It
//! writes to a [`Console`]: results to standard output and everything else to standard error. The
//! other crates never print, read files or read the clock; that happens here.
//!
//! ```
//! use pelea::{Console, Exit};
//!
//! let (mut out, mut err) = (Vec::new(), Vec::new());
//! let mut console = Console::new(&mut out, &mut err);
//! let exit = pelea::run(["pelea", "check", "no/such/file.pddl"], &mut console);
//! drop(console);
//! assert_eq!(exit, Exit::Unreadable);
//! assert!(String::from_utf8(err).unwrap().contains("no/such/file.pddl"));
//! ```
//!
//! Members: `arguments` (the tree of commands); `run`, `campaign`, `plan`, `validate`, `check`, `test`, `fmt`,
//! `dsr`, `lsp`, `explain` (one command each); `task` (a domain with its problem, read from files);
//! `assemble` (builds a mission from its folder); `scenario`; `pool` (work on all cores); `files`;
//! `nearby` (the contents of folders); `disk` (mission folders); `memory`; `clock`; `render`
//! (diagnostics as text with excerpts, or as JSON); `panics` (of runs); `console` and `exit`.

mod arguments;
mod assemble;
mod campaign;
mod check;
mod clock;
mod console;
mod disk;
mod dsr;
mod exit;
mod explain;
mod files;
mod fmt;
mod goals;
mod interrupt;
mod lsp;
mod memory;
mod nearby;
mod outlet;
mod panics;
mod plan;
mod pool;
mod render;
mod replay;
mod run;
mod scenario;
mod task;
mod test;
mod turns;
mod validate;
mod what_if;

pub use arguments::run;
pub use console::Console;
pub use exit::Exit;

use std::process::ExitCode;

/// The whole program. `PELEA_LOG=debug` logs the work of its parts to standard error.
pub fn main() -> ExitCode {
    if let Ok(filter) = tracing_subscriber::EnvFilter::try_from_env("PELEA_LOG") {
        tracing_subscriber::fmt().with_env_filter(filter).with_writer(std::io::stderr).init();
    }
    let mut console = Console::of_process();
    ExitCode::from(run(std::env::args_os(), &mut console))
}
