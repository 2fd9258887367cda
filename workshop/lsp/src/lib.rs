//! A language server for PDDL, HDDL and plans.
//!
//! [`serve`] speaks the Language Server Protocol over any input and output until the client leaves. The
//! crate `ide` knows the meaning of names, and `project` knows which files belong together. This crate has
//! the protocol, the texts that an editor has open, and the order of events. A [`Host`] provides the disk,
//! the planner and the validator.
//!
//! ```
//! use lsp::{Disk, Ended, Entry, Host, Judged, PlanOptions, Planned, ReadError, Task, Tools, serve};
//! use std::sync::Arc;
//!
//! struct Nothing;
//! impl Disk for Nothing {
//!     fn list(&self, _: &str) -> Vec<Entry> { vec![] }
//!     fn read(&self, path: &str, _: u64) -> Result<String, ReadError> {
//!         Err(ReadError::Unreadable(format!("no {path}")))
//!     }
//! }
//! impl Tools for Nothing {
//!     fn plan(&self, _: &Task, _: &PlanOptions) -> Planned { Planned::Limit("no planner".into()) }
//!     fn validate(&self, _: &Task, _: &pddl::Source) -> Judged { Judged::Not(vec![]) }
//! }
//!
//! let input = r#"{"jsonrpc": "2.0", "method": "exit"}"#;
//! let input = format!("Content-Length: {}\r\n\r\n{input}", input.len());
//! let host = Host { disk: Arc::new(Nothing), tools: Arc::new(Nothing) };
//! let ended = serve(std::io::Cursor::new(input), std::io::sink(), host);
//! assert_eq!(ended, Ended::Abruptly, "without `shutdown` before it");
//! ```
//!
//! Map, from the ground up: `frame` and `message` (bytes in), `position` and `uri` (how clients name
//! places), `host` (the services from outside), `client` and `options` (the session's settings), `documents`
//! (the texts), `news` (what jobs send), `event` and `inbox` (what happens, and in which order), `job` (work
//! on other threads), `outbox` (bytes out), `server` (the state and its changes), `answers` (a file for each
//! question; none changes the state), `serve` (the threads).
//!
//! **Invariant: only `Server::handle` changes the state.** Jobs send news; answers read.
//!
//! **Invariant: no message but `exit` ends the session.** A malformed message is answered with an error; a
//! panic is caught, logged and answered.

mod answers;
mod client;
mod documents;
mod event;
mod frame;
mod host;
mod inbox;
mod job;
mod message;
mod news;
mod options;
mod outbox;
mod position;
mod serve;
mod server;
mod uri;

pub use host::{Disk, Entry, File, Host, Judged, PlanOptions, Planned, ReadError, Remark, Task, Tools};
pub use serve::serve;
pub use server::Ended;
