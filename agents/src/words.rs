//! What an agent says and shows, and what it reports: handed in, so that no sentence stands in Rust.

use dsr::Snapshot;

/// The words of a mission in one language. Names are those of nodes of the graph.
pub trait Words: Send + Sync {
    /// The language, as in `en`.
    fn language(&self) -> &str;

    /// What is said or shown for an utterance within a part; `None` if there are no words for it.
    fn sentence(&self, part: &str, utterance: &str) -> Option<String>;

    /// The heading of a part's pages; may be empty.
    fn title(&self, _part: &str) -> String {
        String::new()
    }

    /// The options of a part, in the order in which they are offered: the option's node, its text.
    fn options(&self, part: &str) -> Vec<(String, String)>;

    /// How a person may say that they want something.
    fn request_words(&self, request: &str) -> Vec<String>;
}

/// Writes a document from what the graph holds.
pub trait Reporter: Send + Sync {
    /// The document of that name; `None` if there is none such.
    fn report(&self, document: &str, snapshot: &Snapshot) -> Option<serde_json::Value>;
}
