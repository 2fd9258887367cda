//! `await-request`: the touchscreen waits for the button of a request.

use crate::skill::{Call, Ended, Equipment, Outcome, Signature, Skill, Work};

pub(super) struct AwaitRequest;

impl Skill for AwaitRequest {
    fn signature(&self) -> Signature {
        Signature {
            name: "await-request",
            arguments: &["request", "person?"],
            results: &[],
            outcomes: Outcome::ONLY_FAILURE,
        }
    }

    fn launch(&self, call: Call, equipment: &Equipment) -> Work {
        let device = equipment.devices.buttons.clone();
        Box::pin(async move {
            Ended::of(device.next_request(call.argument(0), call.argument(1)).await, |()| Vec::new())
        })
    }
}
