//! The simulated room: a person, a clinician and devices on tokio's clock.
//!
//! Problem: a mission must be run thousands of times, with every disruption, without a patient. Idea: one state behind a
//! shared handle. Each device operation is a small step function over that state; it is done, or waits for an instant, or
//! waits for the room to change. The room spawns no task: it advances only when a device operation is polled, so that an
//! event happens only if an operation can perceive it.
//!
//! The person knows only what a real person would know. They answer a question after they have heard a sentence to its
//! end or seen a page since the previous question, and only while they are in view. They answer by voice, or by touch if
//! the screen offers the option.
//!
//! Invariant: the same scripts and the same calls at the same times give the same [`Moment`]s. Wakers are kept in the
//! order of registration, and nothing is random.

mod behaviour;
mod clinic;
mod ear;
mod event;
mod gate;
mod health;
mod loudspeaker;
mod presence;
mod rig;
mod room;
mod script;
mod state;
mod touchscreen;
mod waiting;

pub use behaviour::Behaviour;
pub use event::{Moment, RoomEvent};
pub use room::SimRoom;
pub use script::{By, ClinicianScript, PatientScript, Reply, ReplyRule};
