//! `watch-page`: the screen reports what stands on it: the utterance and its part.

use crate::skill::{Call, Datum, DatumKind, Ended, Equipment, Outcome, Signature, Skill, Work};

pub(super) struct WatchPage;

impl Skill for WatchPage {
    fn signature(&self) -> Signature {
        Signature {
            name: "watch-page",
            arity: 0..=0,
            results: &[DatumKind::Node, DatumKind::Node],
            outcomes: Outcome::ONLY_FAILURE,
        }
    }

    fn launch(&self, call: Call, equipment: &Equipment) -> Work {
        let _ = call;
        let device = equipment.devices.screen.clone();
        Box::pin(async move {
            Ended::of(device.next_shown().await, |page| {
                vec![Datum::Node(page.name.into()), Datum::Node(page.topic.into())]
            })
        })
    }
}
