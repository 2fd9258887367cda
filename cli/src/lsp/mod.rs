//! `pelea lsp`: a language server on standard input and output, for editors to start.
//!
//! The exit codes are those of the protocol: 0 after `shutdown` and `exit`, 1 if the client leaves
//! in any other way.

mod disk;
mod tools;

use crate::exit::Exit;
use ::lsp::{Ended, Host, serve};
use clap::Args;
use std::sync::Arc;

/// The arguments of `pelea lsp`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Use standard input and output; the default, accepted because many clients pass it
    #[arg(long)]
    stdio: bool,
}

pub(crate) fn run(_: &Arguments) -> Exit {
    let host = Host { disk: Arc::new(disk::Disk), tools: Arc::new(tools::Tools) };
    match serve(std::io::stdin(), std::io::stdout(), host) {
        Ended::Properly => Exit::Yes,
        Ended::Abruptly => Exit::No,
    }
}
