//! `await-loss`: the person leaves view.

use crate::skill::{Call, Ended, Equipment, Outcome, Signature, Skill, Work};

pub(super) struct AwaitLoss;

impl Skill for AwaitLoss {
    fn signature(&self) -> Signature {
        Signature {
            name: "await-loss",
            arguments: &["person?"],
            results: &[],
            outcomes: Outcome::ONLY_FAILURE,
        }
    }

    fn launch(&self, call: Call, equipment: &Equipment) -> Work {
        let device = equipment.devices.skeleton.clone();
        Box::pin(async move { Ended::of(device.await_loss(call.argument(0)).await, |()| Vec::new()) })
    }
}
