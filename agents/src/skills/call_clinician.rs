//! `call-clinician`: calls the clinician, and ends when the clinician has come and seen to the need. With a second
//! argument the call is urgent.

use hal::Urgency;

use crate::skill::{Call, Ended, Equipment, Outcome, Signature, Skill, Work};

pub(super) struct CallClinician;

impl Skill for CallClinician {
    fn signature(&self) -> Signature {
        Signature {
            name: "call-clinician",
            arguments: &["need", "urgency?"],
            results: &[],
            outcomes: Outcome::ONLY_FAILURE,
        }
    }

    fn launch(&self, call: Call, equipment: &Equipment) -> Work {
        let device = equipment.devices.clinic.clone();
        let urgency = if call.arguments.len() > 1 { Urgency::Urgent } else { Urgency::Normal };
        let id = call.id(equipment);
        Box::pin(async move { Ended::of(device.call(&id, call.argument(0), urgency).await, |()| Vec::new()) })
    }
}
