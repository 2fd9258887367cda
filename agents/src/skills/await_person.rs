//! `await-person`: a person comes into view; the result is where.

use crate::skill::{Call, Datum, DatumKind, Ended, Equipment, Outcome, Signature, Skill, Work};

pub(super) struct AwaitPerson;

impl Skill for AwaitPerson {
    fn signature(&self) -> Signature {
        Signature {
            name: "await-person",
            arguments: &["person?"],
            results: &[DatumKind::Pose],
            outcomes: Outcome::ONLY_FAILURE,
        }
    }

    fn launch(&self, call: Call, equipment: &Equipment) -> Work {
        let device = equipment.devices.skeleton.clone();
        Box::pin(async move {
            Ended::of(device.await_person(call.argument(0)).await, |pose| vec![Datum::Pose(pose)])
        })
    }
}
