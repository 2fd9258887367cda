//! Hardware abstraction: one trait per capability, and simulated devices.
//!
//! Problem: what a robot does must not depend on the make of its loudspeaker, microphone or screen. Idea: a capability is
//! a trait of asynchronous [`Operation`]s, and a back end implements it. Every back end must pass one suite,
//! [`conformance`]. The first back end is [`sim`]: a room with a simulated person, clinician and devices.
//!
//! ```
//! use hal::sim::{ClinicianScript, PatientScript, SimRoom};
//!
//! let runtime = tokio::runtime::Builder::new_current_thread().enable_time().build().unwrap();
//! runtime.block_on(async {
//!     let room = SimRoom::new(PatientScript::default(), ClinicianScript::default());
//!     let devices = room.devices();
//!     devices.speech_out.say("Hello", "en").await.unwrap();
//!     room.fail(hal::Device::SpeechOut);
//!     assert!(devices.speech_out.say("Hello again", "en").await.is_err());
//! });
//! ```
//!
//! **Invariant:** this crate creates no runtime, spawns no task and reads no clock but tokio's. While that clock is
//! paused, simulated time runs as fast as the machine, and the same script gives the same events.
//!
//! | module | holds |
//! |---|---|
//! | `device`, `operation` | which devices there are, their errors, the stop protocol |
//! | `speech`, `screen`, `skeleton`, `clinic`, `health` | the capabilities |
//! | `evidence` | what is known about the robot's own output |
//! | `devices` | one back end of each |
//! | [`sim`] | the simulated room |
//! | [`conformance`] | the suite for back ends |

pub mod conformance;
pub mod sim;

mod clinic;
mod device;
mod devices;
mod evidence;
mod health;
mod operation;
mod question;
mod screen;
mod skeleton;
mod speech;

pub use clinic::{Clinic, Urgency};
pub use device::{Device, DeviceError};
pub use devices::Devices;
pub use evidence::Evidence;
pub use health::Health;
pub use operation::Operation;
pub use question::{Phrase, Question};
pub use screen::{Buttons, Page, PageId, Screen};
pub use skeleton::{Pose, Skeleton};
pub use speech::{Heard, SpeechIn, SpeechOut};
