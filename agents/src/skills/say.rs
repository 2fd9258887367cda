//! `say`: the loudspeaker says an utterance of a part.

use crate::skill::{Call, Ended, Equipment, Outcome, Signature, Skill, Work};

pub(super) struct Say;

impl Skill for Say {
    fn signature(&self) -> Signature {
        Signature {
            name: "say",
            arguments: &["part", "utterance"],
            results: &[],
            outcomes: Outcome::OF_OUTPUT,
        }
    }

    fn launch(&self, call: Call, equipment: &Equipment) -> Work {
        let words = &equipment.words;
        let text = words.sentence(call.argument(0), call.argument(1));
        let (device, language) = (equipment.devices.speech_out.clone(), words.language().to_owned());
        Box::pin(async move {
            let Some(text) = text else {
                tracing::warn!(?call.arguments, "no words for what is to be said");
                return Ended::otherwise(Outcome::REFUSED);
            };
            Ended::of_output(device.say(&text, &language).await)
        })
    }
}
