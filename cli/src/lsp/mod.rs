//! `pelea lsp`: a language server on standard input and output, for editors to start.
//!
//! Exit codes are the protocol's: 0 after `shutdown` and `exit`, 1 if the client left in any other way.

mod disk;
mod tools;

use crate::exit::Exit;
use ::lsp::{Ended, Host, serve};
use clap::Args;
use std::sync::Arc;

/// How to talk.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Talk over standard input and output; that is what happens anyhow, but many clients say it.
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
