//! The simulated room as a rig for the conformance suite.

use std::time::Duration;

use super::{By, Reply, SimRoom};
use crate::Devices;
use crate::conformance::{Rig, Stimulus};

impl Rig for SimRoom {
    fn devices(&self) -> Devices {
        SimRoom::devices(self)
    }

    fn patience(&self) -> Duration {
        Duration::from_secs(600)
    }

    fn stimulate(&self, stimulus: Stimulus<'_>) {
        let answer = |option, by| Reply::Answer { option, delay: 1.0, by };
        match stimulus {
            Stimulus::PersonWillSay { topic, option } => {
                self.will_reply(topic, answer(option, By::Voice));
            }
            Stimulus::PersonWillMumble { topic } => {
                self.will_reply(topic, Reply::Misheard { words: "well, you know".into(), delay: 1.0 });
            }
            Stimulus::PersonWillTouch { topic, option } => {
                self.will_reply(topic, answer(option, By::Touch));
            }
            Stimulus::PersonAsks(request) => self.ask_by(request, "", Some(By::Voice)),
            Stimulus::PersonTouchesRequest(request) => self.ask_by(request, "", Some(By::Touch)),
            Stimulus::PersonLeaves => self.lose_person(),
            Stimulus::PersonReturns => self.return_person(),
            Stimulus::ClinicianCommands(command) => self.command(command),
            Stimulus::ClinicianComes => self.clinician_comes(),
            Stimulus::Unplug(device) => self.fail(device),
            Stimulus::PlugIn(device) => self.recover(device),
        }
    }
}
