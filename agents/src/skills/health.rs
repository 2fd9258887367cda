//! `await-fault`, `await-recovery`, `test-device`: what the robot finds out about one of its devices, by the name of its
//! node.

use std::sync::Arc;

use hal::{Device, Health, Operation};

use crate::skill::{Call, Ended, Equipment, Outcome, Signature, Skill, Work};

/// One question about the health of a device.
pub(super) struct OfDevice {
    name: &'static str,
    ask: for<'a> fn(&'a dyn Health, Device) -> Operation<'a, ()>,
}

/// The three questions.
pub(super) const ALL: [OfDevice; 3] = [
    OfDevice { name: "await-fault", ask: |health, device| health.await_fault(device) },
    OfDevice { name: "await-recovery", ask: |health, device| health.await_recovery(device) },
    OfDevice { name: "test-device", ask: |health, device| health.test(device) },
];

impl Skill for OfDevice {
    fn signature(&self) -> Signature {
        Signature { name: self.name, arguments: &["device"], results: &[], outcomes: Outcome::ONLY_FAILURE }
    }

    fn launch(&self, call: Call, equipment: &Equipment) -> Work {
        let (health, ask) = (Arc::clone(&equipment.devices.health), self.ask);
        Box::pin(async move {
            let Some(device) = Device::named(call.argument(0)) else {
                tracing::warn!(?call.arguments, "no such device");
                return Ended::otherwise(Outcome::FAILURE);
            };
            Ended::of(ask(&*health, device).await, |()| Vec::new())
        })
    }
}
