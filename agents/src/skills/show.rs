//! `show`: the screen shows the page of an utterance of a part, with the options of the part, until it can have been read.

use hal::{Page, PageId};

use super::question::options;
use crate::skill::{Call, Ended, Equipment, Outcome, Signature, Skill, Work};

pub(super) struct Show;

impl Skill for Show {
    fn signature(&self) -> Signature {
        Signature {
            name: "show",
            arguments: &["part", "utterance"],
            results: &[],
            outcomes: Outcome::OF_OUTPUT,
        }
    }

    fn launch(&self, call: Call, equipment: &Equipment) -> Work {
        let words = &equipment.words;
        let (part, utterance) = (call.argument(0), call.argument(1));
        let page = words.sentence(part, utterance).map(|text| Page {
            id: PageId { topic: part.to_owned(), name: utterance.to_owned() },
            title: words.title(part),
            options: options(&**words, part),
            dwell: Page::reading_time(&text),
            text,
        });
        let device = equipment.devices.screen.clone();
        Box::pin(async move {
            let Some(page) = page else {
                tracing::warn!(?call.arguments, "no words for what is to be shown");
                return Ended::otherwise(Outcome::REFUSED);
            };
            Ended::of_output(device.show(&page).await)
        })
    }
}
