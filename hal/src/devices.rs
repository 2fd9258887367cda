//! The devices of a robot, as its agents see them.

use std::fmt;
use std::sync::Arc;

use crate::{Buttons, Clinic, Health, Screen, Skeleton, SpeechIn, SpeechOut};

/// The devices of a robot: one back end of each capability.
#[derive(Clone)]
#[expect(missing_docs, reason = "the types say what they are")]
pub struct Devices {
    pub speech_out: Arc<dyn SpeechOut>,
    pub speech_in: Arc<dyn SpeechIn>,
    pub screen: Arc<dyn Screen>,
    pub buttons: Arc<dyn Buttons>,
    pub skeleton: Arc<dyn Skeleton>,
    pub clinic: Arc<dyn Clinic>,
    pub health: Arc<dyn Health>,
}

impl fmt::Debug for Devices {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Devices").finish_non_exhaustive()
    }
}
