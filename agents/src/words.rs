//! The sentences and documents of a mission. The caller hands them in, so that no sentence stands in Rust.

use dsr::Snapshot;

/// The words of a mission in one language. Names are those of nodes of the graph.
pub trait Words: Send + Sync {
    /// The language, as in `en`.
    fn language(&self) -> &str;

    /// The text of an utterance within a part; `None` if the mission has none.
    fn sentence(&self, part: &str, utterance: &str) -> Option<String>;

    /// The heading of a part's pages; may be empty.
    fn title(&self, _part: &str) -> String {
        String::new()
    }

    /// The options of a part, in the order in which they are offered: the option's node, its text.
    fn options(&self, part: &str) -> Vec<(String, String)>;

    /// The words with which a person may make a request.
    fn request_words(&self, request: &str) -> Vec<String>;
}

/// Writes a document from what the graph holds.
pub trait Reporter: Send + Sync {
    /// The document of that name; `None` if the name is unknown.
    fn report(&self, document: &str, snapshot: &Snapshot) -> Option<serde_json::Value>;
}
