//! The client's capabilities, as far as the server uses them.
//!
//! Problem: `initialize` has hundreds of fields; a new or malformed field that does not matter must not keep
//! an editor from starting. Idea: read the few fields that matter, each on its own; a missing or malformed
//! one is a capability that the client lacks.

use crate::position::Encoding;
use serde_json::Value;

/// The client's capabilities.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Client {
    pub(crate) encoding: Encoding,
    /// It can watch files for the server.
    pub(crate) watches: bool,
    pub(crate) applies_edits: bool,
    /// Edits may name the version of a document that they belong to.
    pub(crate) versioned_edits: bool,
    pub(crate) creates_files: bool,
    pub(crate) shows_progress: bool,
    pub(crate) shows_documents: bool,
    pub(crate) snippets: bool,
    pub(crate) symbol_trees: bool,
    pub(crate) action_literals: bool,
    pub(crate) related_places: bool,
    pub(crate) markdown: bool,
    pub(crate) folds_lines_only: bool,
    pub(crate) refreshes: Refreshes,
}

/// The results that the client can be asked to request again.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Refreshes {
    pub(crate) diagnostics: bool,
    pub(crate) lenses: bool,
    pub(crate) tokens: bool,
}

impl Client {
    /// From the parameters of `initialize`.
    pub(crate) fn of(params: &Value) -> Self {
        let at = |pointer: &str| params.pointer(&format!("/capabilities/{pointer}"));
        let can = |pointer: &str| at(pointer).is_some_and(|v| v == &Value::Bool(true));
        let lists = |pointer: &str, word: &str| {
            at(pointer).and_then(Value::as_array).is_some_and(|list| list.iter().any(|v| v == word))
        };
        let encodings = at("general/positionEncodings").and_then(Value::as_array);
        Self {
            encoding: Encoding::negotiate(encodings.into_iter().flatten().filter_map(Value::as_str)),
            watches: can("workspace/didChangeWatchedFiles/dynamicRegistration"),
            applies_edits: can("workspace/applyEdit"),
            versioned_edits: can("workspace/workspaceEdit/documentChanges"),
            creates_files: can("workspace/workspaceEdit/documentChanges")
                && lists("workspace/workspaceEdit/resourceOperations", "create"),
            shows_progress: can("window/workDoneProgress"),
            shows_documents: can("window/showDocument/support"),
            snippets: can("textDocument/completion/completionItem/snippetSupport"),
            symbol_trees: can("textDocument/documentSymbol/hierarchicalDocumentSymbolSupport"),
            action_literals: at("textDocument/codeAction/codeActionLiteralSupport")
                .is_some_and(Value::is_object),
            related_places: can("textDocument/publishDiagnostics/relatedInformation"),
            markdown: lists("textDocument/hover/contentFormat", "markdown"),
            folds_lines_only: can("textDocument/foldingRange/lineFoldingOnly"),
            refreshes: Refreshes {
                diagnostics: can("workspace/diagnostics/refreshSupport"),
                lenses: can("workspace/codeLens/refreshSupport"),
                tokens: can("workspace/semanticTokens/refreshSupport"),
            },
        }
    }

    /// The folders that are open, as URIs.
    pub(crate) fn folders(params: &Value) -> Vec<String> {
        let folders = params.get("workspaceFolders").and_then(Value::as_array);
        let uris: Vec<String> = folders
            .into_iter()
            .flatten()
            .filter_map(|folder| folder.get("uri")?.as_str().map(str::to_owned))
            .collect();
        let root = || params.get("rootUri").and_then(Value::as_str).map(str::to_owned);
        if uris.is_empty() { root().into_iter().collect() } else { uris }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn what_is_odd_is_not_there() {
        let client = Client::of(&json!({"capabilities": {"workspace": 5, "window": {"workDoneProgress": 1},
            "general": {"positionEncodings": [null, "utf-32"]}, "textDocument": {"hover": {"contentFormat": {}}}}}));
        assert_eq!(client, Client { encoding: Encoding::Utf32, ..Client::default() });
        assert_eq!(Client::of(&Value::Null), Client::default());
    }

    #[test]
    fn folders_come_before_the_root() {
        let both = json!({"rootUri": "file:///a", "workspaceFolders": [{"uri": "file:///b", "name": "b"}]});
        assert_eq!(Client::folders(&both), ["file:///b"]);
        assert_eq!(
            Client::folders(&json!({"rootUri": "file:///a", "workspaceFolders": null})),
            ["file:///a"]
        );
        assert_eq!(Client::folders(&json!({"rootUri": null})), [""; 0]);
    }
}
