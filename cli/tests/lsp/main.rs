//! `pelea lsp`, spoken to over pipes: the real binary, a small client, no sleeping.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod broken;
mod client;
mod commands;
mod editing;
mod files;
mod questions;
mod session;

/// Places as the protocol writes them.
fn position(line: u32, character: u32) -> serde_json::Value {
    serde_json::json!({"line": line, "character": character})
}

/// A range on one line.
fn range(line: u32, start: u32, end: u32) -> serde_json::Value {
    serde_json::json!({"start": position(line, start), "end": position(line, end)})
}
