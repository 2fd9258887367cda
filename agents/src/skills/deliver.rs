//! `deliver`: writes a document from the graph and hands it to the clinician.

use crate::skill::{Call, Ended, Equipment, Outcome, Signature, Skill, Work};

pub(super) struct Deliver;

impl Skill for Deliver {
    fn signature(&self) -> Signature {
        Signature { name: "deliver", arguments: &["document"], results: &[], outcomes: Outcome::ONLY_FAILURE }
    }

    fn launch(&self, call: Call, equipment: &Equipment) -> Work {
        let report = equipment.reporter.report(call.argument(0), &call.snapshot);
        let (device, id) = (equipment.devices.clinic.clone(), call.id(equipment));
        Box::pin(async move {
            let Some(report) = report else {
                tracing::warn!(?call.arguments, "no such document");
                return Ended::otherwise(Outcome::FAILURE);
            };
            Ended::of(device.deliver(&id, &report).await, |()| Vec::new())
        })
    }
}
