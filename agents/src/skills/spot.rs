//! `spot`: the ear waits for a request of a person, wherever they are, and ignores all other words.

use hal::{Phrase, Question};

use crate::skill::{Call, Ended, Equipment, Outcome, Signature, Skill, Work};

pub(super) struct Spot;

impl Skill for Spot {
    fn signature(&self) -> Signature {
        Signature {
            name: "spot",
            arguments: &["request", "person?"],
            results: &[],
            outcomes: Outcome::ONLY_FAILURE,
        }
    }

    fn launch(&self, call: Call, equipment: &Equipment) -> Work {
        let words = &equipment.words;
        let request = call.argument(0);
        let options = words.request_words(request);
        let wanted = Question {
            topic: request.to_owned(),
            name: String::new(),
            language: words.language().to_owned(),
            options: options.into_iter().map(|words| Phrase { id: request.to_owned(), words }).collect(),
        };
        let device = equipment.devices.speech_in.clone();
        Box::pin(async move { Ended::of(device.spot(&wanted, call.argument(1)).await, |()| Vec::new()) })
    }
}
