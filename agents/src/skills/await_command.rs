//! `await-command`: the clinician gives a command.

use crate::skill::{Call, Ended, Equipment, Outcome, Signature, Skill, Work};

pub(super) struct AwaitCommand;

impl Skill for AwaitCommand {
    fn signature(&self) -> Signature {
        Signature {
            name: "await-command",
            arguments: &["command"],
            results: &[],
            outcomes: Outcome::ONLY_FAILURE,
        }
    }

    fn launch(&self, call: Call, equipment: &Equipment) -> Work {
        let device = equipment.devices.clinic.clone();
        Box::pin(async move { Ended::of(device.next_command(call.argument(0)).await, |()| Vec::new()) })
    }
}
