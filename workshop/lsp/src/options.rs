//! The user's settings: the `initializationOptions`, or the section `pelea` of the configuration.
//!
//! Problem: a setting with a misspelt key or a wrong type must neither be ignored silently nor keep the
//! server from starting. Idea: read each key on its own; report an invalid one to the client and keep its
//! default. docs/editors.md lists the keys.

use serde_json::{Map, Value};
use std::time::Duration;

/// The side that starts the transfer of diagnostics.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum DiagnosticsMode {
    /// The server publishes changes, in closed files too.
    Push,
    /// The client requests diagnostics of open documents.
    Pull,
}

/// The settings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Options {
    pub(crate) diagnostics: DiagnosticsMode,
    /// Whether lints run.
    pub(crate) lints: bool,
    /// The length of the quiet period before the slow lints run.
    pub(crate) lint_delay: Duration,
    pub(crate) code_lens: bool,
    /// For `pelea.plan`.
    pub(crate) plan_timeout: Duration,
    /// The search of `pelea.plan`; `None` selects the default search.
    pub(crate) plan_search: Option<String>,
    /// Most files that are read from the folders.
    pub(crate) max_files: usize,
    /// Largest closed file that is read, in bytes.
    pub(crate) max_file_bytes: u64,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            diagnostics: DiagnosticsMode::Push,
            lints: true,
            lint_delay: Duration::from_millis(300),
            code_lens: true,
            plan_timeout: Duration::from_secs(60),
            plan_search: None,
            max_files: 5_000,
            max_file_bytes: 8 << 20,
        }
    }
}

impl Options {
    /// The settings with the changes in `given`, and a sentence for each invalid key.
    pub(crate) fn with(mut self, given: &Value) -> (Self, Vec<String>) {
        let mut complaints = Vec::new();
        match given {
            Value::Null => {}
            Value::Object(keys) => self.read(keys, &mut complaints),
            _ => complaints.push("the options are not an object".to_owned()),
        }
        (self, complaints)
    }

    fn read(&mut self, keys: &Map<String, Value>, complaints: &mut Vec<String>) {
        for (key, value) in keys {
            let usable = match key.as_str() {
                "diagnostics" => self.set_diagnostics(value),
                "lints" => set(&mut self.lints, value.as_bool()),
                "lintDelay" => set(&mut self.lint_delay, value.as_u64().map(Duration::from_millis)),
                "codeLens" => set(&mut self.code_lens, value.as_bool()),
                "planTimeout" => set(&mut self.plan_timeout, seconds(value)),
                "planSearch" => set(
                    &mut self.plan_search,
                    value.as_str().map(|name| (!name.is_empty()).then(|| name.into())),
                ),
                "maxFiles" => set(&mut self.max_files, value.as_u64().and_then(|n| n.try_into().ok())),
                "maxFileBytes" => set(&mut self.max_file_bytes, value.as_u64()),
                _ => {
                    complaints.push(format!("there is no option `{key}`"));
                    continue;
                }
            };
            if !usable {
                complaints.push(format!("the option `{key}` cannot be {value}"));
            }
        }
    }

    fn set_diagnostics(&mut self, value: &Value) -> bool {
        let mode = match value.as_str() {
            Some("push") => Some(DiagnosticsMode::Push),
            Some("pull") => Some(DiagnosticsMode::Pull),
            _ => None,
        };
        set(&mut self.diagnostics, mode)
    }
}

fn set<T>(place: &mut T, value: Option<T>) -> bool {
    value.map(|value| *place = value).is_some()
}

fn seconds(value: &Value) -> Option<Duration> {
    Duration::try_from_secs_f64(value.as_f64()?).ok().filter(|time| !time.is_zero())
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn each_key_stands_for_itself() {
        let given = json!({"lints": "no", "planTimeout": 2.5, "maxFiles": -1, "planSearch": "dual", "x": 1});
        let (options, complaints) = Options::default().with(&given);
        let expected = Options {
            plan_timeout: Duration::from_millis(2500),
            plan_search: Some("dual".into()),
            ..Options::default()
        };
        assert_eq!(options, expected);
        let said = complaints.join("; ");
        for word in ["`lints` cannot be \"no\"", "`maxFiles` cannot be -1", "no option `x`"] {
            assert!(said.contains(word), "{said}");
        }
    }

    #[test]
    fn nothing_given_is_the_default() {
        assert_eq!(Options::default().with(&Value::Null), (Options::default(), vec![]));
        assert_eq!(Options::default().with(&json!([])).1.len(), 1);
    }
}
