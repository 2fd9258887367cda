//! The simulated room: a person, a clinician and devices on tokio's clock.
//!
//! Problem: a mission must be played, thousands of times and in every disruption, without a patient. Idea: one
//! state behind a shared handle; each device operation is a small step function over that state which is done,
//! or waits for an instant, or for the room to change. Nothing is spawned: what happens in the room happens
//! when a device operation is polled, and what nobody can perceive does not happen.
//!
//! The person knows only what a person would: they answer what they have been asked (a sentence heard to its
//! end, or a page seen, since the last question), while they are in view, by voice, or by touch if the screen
//! offers the option.
//!
//! Invariant: the same scripts and the same calls at the same times give the same [`Moment`]s; wakers are
//! kept in the order of registration, and nothing is random.

mod clinic;
mod ear;
mod event;
mod loudspeaker;
mod presence;
mod rig;
mod room;
mod script;
mod state;
mod touchscreen;
mod waiting;

pub use event::{Moment, RoomEvent};
pub use loudspeaker::SECONDS_PER_WORD;
pub use presence::{SECONDS_TO_LOSE, SECONDS_TO_SEE};
pub use room::SimRoom;
pub use script::{By, ClinicianScript, PatientScript, Reply, ReplyRule};
