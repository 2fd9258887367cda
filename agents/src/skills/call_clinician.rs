//! `call-clinician`: calls the clinician, and ends when the clinician has come and seen to the need.

use crate::skill::{Call, Ended, Equipment, Outcome, Signature, Skill, Work};

pub(super) struct CallClinician;

impl Skill for CallClinician {
    fn signature(&self) -> Signature {
        Signature { name: "call-clinician", arity: 1..=1, results: &[], outcomes: Outcome::ONLY_FAILURE }
    }

    fn launch(&self, call: Call, equipment: &Equipment) -> Work {
        let device = equipment.devices.clinic.clone();
        Box::pin(async move { Ended::of(device.call(call.argument(0)).await, |()| Vec::new()) })
    }
}
