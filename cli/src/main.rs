//! The binary `pelea`.

use std::process::ExitCode;

fn main() -> ExitCode {
    pelea::main()
}
