//! `listen`: the ear waits for one of the options of a part. Other words are `misheard`.

use hal::Heard;

use super::question::question;
use crate::skill::{Call, Datum, DatumKind, Ended, Equipment, Outcome, Signature, Skill, Work};

pub(super) struct Listen;

impl Skill for Listen {
    fn signature(&self) -> Signature {
        Signature {
            name: "listen",
            arguments: &["part", "question?"],
            results: &[DatumKind::Node],
            outcomes: &["misheard", Outcome::FAILURE],
        }
    }

    fn launch(&self, call: Call, equipment: &Equipment) -> Work {
        let asked = question(&*equipment.words, call.argument(0), call.argument(1));
        let device = equipment.devices.speech_in.clone();
        Box::pin(async move {
            match device.listen(&asked).await {
                Ok(Heard::NotUnderstood(words)) => {
                    tracing::debug!(words, "not understood");
                    Ended::otherwise("misheard")
                }
                Ok(Heard::Phrase(option)) => Ended::well(vec![Datum::Node(option.into())]),
                Err(error) => Ended::of(Err::<(), _>(error), |()| Vec::new()),
            }
        })
    }
}
