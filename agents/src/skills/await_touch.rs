//! `await-touch`: the touchscreen waits for one of the options of a part.

use super::question::question;
use crate::skill::{Call, Datum, DatumKind, Ended, Equipment, Outcome, Signature, Skill, Work};

pub(super) struct AwaitTouch;

impl Skill for AwaitTouch {
    fn signature(&self) -> Signature {
        Signature {
            name: "await-touch",
            arguments: &["part", "question?"],
            results: &[DatumKind::Node],
            outcomes: Outcome::ONLY_FAILURE,
        }
    }

    fn launch(&self, call: Call, equipment: &Equipment) -> Work {
        let asked = question(&*equipment.words, call.argument(0), call.argument(1));
        let device = equipment.devices.buttons.clone();
        Box::pin(async move {
            Ended::of(device.next_touch(&asked).await, |option| vec![Datum::Node(option.into())])
        })
    }
}
