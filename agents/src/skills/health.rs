//! `await-fault`, `await-recovery`, `test-device`: what the robot finds out about one of its devices, by the name of its
//! node. A second argument of `await-recovery` names a device that breaks again and again: it must be in order for longer.

use std::sync::Arc;
use std::time::Duration;

use hal::{Device, Health, Operation};

use crate::skill::{Call, Ended, Equipment, Outcome, Signature, Skill, Work};

/// One question about the health of a device.
pub(super) struct OfDevice {
    name: &'static str,
    arguments: &'static [&'static str],
    ask: for<'a> fn(&'a dyn Health, Device, &Call) -> Operation<'a, ()>,
}

/// How long a device is in order before it is used again.
const STEADY: Duration = Duration::from_secs(2);
/// The same for a device that breaks again and again.
const STEADIER: Duration = Duration::from_secs(30);

/// The three questions.
pub(super) const ALL: [OfDevice; 3] = [
    OfDevice {
        name: "await-fault",
        arguments: &["device"],
        ask: |health, device, _| health.await_fault(device),
    },
    OfDevice {
        name: "await-recovery",
        arguments: &["device", "unsteady?"],
        ask: |health, device, call| {
            health.await_recovery(device, if call.arguments.len() > 1 { STEADIER } else { STEADY })
        },
    },
    OfDevice { name: "test-device", arguments: &["device"], ask: |health, device, _| health.test(device) },
];

impl Skill for OfDevice {
    fn signature(&self) -> Signature {
        Signature {
            name: self.name,
            arguments: self.arguments,
            results: &[],
            outcomes: Outcome::ONLY_FAILURE,
        }
    }

    fn launch(&self, call: Call, equipment: &Equipment) -> Work {
        let (health, ask) = (Arc::clone(&equipment.devices.health), self.ask);
        Box::pin(async move {
            let Some(device) = Device::named(call.argument(0)) else {
                tracing::warn!(?call.arguments, "no such device");
                return Ended::otherwise(Outcome::FAILURE);
            };
            Ended::of(ask(&*health, device, &call).await, |()| Vec::new())
        })
    }
}
