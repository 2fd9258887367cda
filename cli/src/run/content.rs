//! The mission's texts and its report, for the agents.

use crate::clock::seconds;
use agents::{Reporter, Words};
use dsr::Snapshot;
use mission::Mission;
use mission::report::{Report, Times};
use std::sync::Arc;
use std::time::Duration;

/// A mission in one of its languages.
#[derive(Clone)]
pub(crate) struct Content {
    pub(crate) mission: Arc<Mission>,
    pub(crate) language: String,
}

impl Content {
    pub(super) fn words(&self) -> &mission::Words {
        self.mission.words(&self.language).unwrap_or_else(|| self.mission.default_words())
    }

    /// The report over a graph, for a test that began with the run.
    pub(super) fn report(&self, snapshot: &Snapshot) -> Report {
        let finished = Duration::from_nanos(snapshot.time().0);
        let finished = Duration::from_secs_f64(seconds(finished));
        let times = Times { started: Duration::ZERO, finished };
        Report::new(&self.mission, self.words(), snapshot, times)
    }
}

impl Words for Content {
    fn language(&self) -> &str {
        &self.language
    }

    fn sentence(&self, part: &str, utterance: &str) -> Option<String> {
        Content::words(self).sentence(part, utterance).map(str::to_owned)
    }

    fn title(&self, part: &str) -> String {
        Content::words(self).name(part).unwrap_or_default().to_owned()
    }

    fn options(&self, part: &str) -> Vec<(String, String)> {
        let options = Content::words(self).options(part).iter();
        options.map(|o| (o.option.to_string(), o.text.clone())).collect()
    }

    fn request_words(&self, request: &str) -> Vec<String> {
        Content::words(self).request(request).to_vec()
    }
}

impl Reporter for Content {
    fn report(&self, document: &str, snapshot: &Snapshot) -> Option<serde_json::Value> {
        if document != &*self.mission.manifest.report.document.name {
            return None;
        }
        serde_json::to_value(Content::report(self, snapshot)).ok()
    }
}
