//! The Deep State Representation: one typed, versioned graph that agents share.
//!
//! What the robot perceives and what it does are written with the same tokens, in one graph. No agent sends commands:
//! agents watch patterns and write what they do. This crate is that graph. It checks every transaction against a
//! [`Vocabulary`] and the invariants of both quivers, provides immutable [`Snapshot`]s, reports to subscribers which
//! matches of their [`Pattern`]s appeared and disappeared, leases exclusive resources, and lets the [`Reflex`]es of
//! broken activities write in the very commit that broke them.
//!
//! It reads no clock and no socket: times are arguments, and the same transactions in the same order give the same
//! bytes. A [`Journal`] writes them to a [`Store`] on a thread of its own, and a [`Recording`] returns every version.
//!
//! ```
//! use dsr::{AgentId, VocabularyBuilder, Graph, Nature, PatternBuilder, Time};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let mut builder = VocabularyBuilder::new();
//! let robot = builder.node_type("robot", None, Nature::Geometric)?;
//! let activity = builder.node_type("activity", None, Nature::Symbolic)?;
//! let is = builder.label("is", robot, activity)?;
//! let vocabulary = builder.build();
//!
//! let graph = Graph::new(vocabulary.clone());
//! graph.edit(AgentId::DSR, Time(0), |tx| {
//!     tx.add_node("clarc", robot).add_node("speaking", activity);
//! })?;
//!
//! let mut pattern = PatternBuilder::new(&vocabulary);
//! let who = pattern.variable("who", robot);
//! pattern.edge(who, is, "speaking");
//! let mut speakers = graph.subscribe(pattern.build()?);
//! assert!(speakers.try_recv().is_none());
//!
//! graph.edit(AgentId::DSR, Time(1), |tx| {
//!     tx.add_edge("clarc", is, "speaking");
//! })?;
//! let change = speakers.try_recv().expect("the robot speaks now");
//! assert_eq!(change.snapshot.name(change.appeared[0][0]), Some("clarc"));
//! assert_eq!(change.snapshot.sentences(), ["clarc is speaking"]);
//! # Ok(())
//! # }
//! ```
//!
//! Map, from the ground up: `id`, `unit`, `value`, `vocabulary` → `pages`, `names`, `members`, `pose`, `track`, `block`
//! → `mentions` → `state` (one version of the graph: read, written, logged, rolled back) → `lease`, `chain` (read from
//! a state) → `delta` → `snapshot` → `pattern` → `transaction` (edits, rules, leases, reflexes; `reflex` is their data)
//! → `replay_check`, `replay`, `export`, `diff`, `past`, `sentence` → `interest`, `subscription`, `routes` → `left_right` (readers
//! and writers apart), `graph`, `liveness` → `journal`.

mod block;
mod chain;
mod delta;
mod diff;
mod epochs;
mod export;
mod graph;
mod id;
mod interest;
mod journal;
mod lease;
mod left_right;
mod liveness;
mod members;
mod mentions;
mod names;
mod pages;
mod past;
mod pattern;
mod pose;
mod reflex;
mod replay;
mod replay_check;
mod routes;
mod sentence;
mod snapshot;
mod state;
mod subscription;
mod sync;
mod track;
mod transaction;
mod unit;
mod value;
mod vocabulary;

pub use chain::ChainError;
pub use delta::{Change, Delta};
pub use export::{
    Export, ExportedAttribute, ExportedEdge, ExportedNode, ExportedSample, ExportedTransform, ExportedValue,
    RestoreError,
};
pub use graph::{Commit, Graph};
pub use id::{
    AgentId, AttributeId, EdgeKey, Epoch, Holder, LabelId, NodeId, ReflexId, ResourceId, Time, TypeId,
    Version,
};
pub use interest::{Interest, PatternId};
pub use journal::{
    Damage, Durability, Folder, Journal, JournalError, Memory, Played, Progress, Recording, RecordingError,
    Replay, Settings, Store,
};
pub use lease::{Lease, Preemption, Priority, Waiting};
pub use liveness::Liveness;
pub use mentions::Mentions;
pub use nalgebra::{Isometry3, Matrix6};
pub use pattern::{
    Binding, Comparison, HolderTerm, Metric, Operand, Pattern, PatternBuilder, PatternError, PatternSource,
    PatternTextError, Term, Threshold, Variable,
};
pub use pose::{Covariance, CovarianceError, Pose};
pub use reflex::{Bound, Keep, Reflex};
pub use replay::ReplayError;
pub use snapshot::{AttributeView, EdgeView, NodeView, Snapshot};
pub use subscription::{
    Changed, Committed, Delivery, Deltas, Event, Mailbox, MatchChange, Matches, News, Subscription,
};
pub use track::HORIZON;
pub use transaction::{Edit, HolderRef, Transaction, TransactionError};
pub use unit::Unit;
pub use value::{Kind, NewValue, NodeRef, Value};
pub use vocabulary::{
    Degree, End, HolderType, Nature, Permission, Signature, Token, Vocabulary, VocabularyBuilder,
    VocabularyError,
};
