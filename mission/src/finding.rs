//! Findings across files: what is wrong with a mission, and where.
//!
//! Problem: `pddl::Diagnostic` speaks of one source; what is wrong with a mission often lies between
//! two (a node declared in `graph.pddl` has no sentence in `fr.toml`). Idea: number the sources of a
//! mission; a [`Place`] is a source and a span, and a [`Finding`] may have several. Rendering with colours and excerpts is the
//! edge's work; [`Sources::place`] gives the plain line that tests and logs use.
//!
//! Codes: E07xx shape of a TOML file, E08xx words, E09xx scenarios, C01xx between the layers.

use std::fmt::Write as _;
use std::sync::Arc;

use pddl::model::{Idx, IndexVec};
use pddl::{Severity, Source, Span};
use serde::Serialize;

/// A source of a mission.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub struct SourceId(pub u32);

impl Idx for SourceId {
    fn from_index(index: usize) -> Self {
        Self(u32::try_from(index).expect("a mission has fewer than 2^32 files"))
    }
    fn index(self) -> usize {
        self.0 as usize
    }
}

/// A place in some source.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Place {
    /// Which source.
    pub source: SourceId,
    /// Where in it.
    pub span: Span,
}

/// Something to tell the author of a mission. The code is for programs, the rest for people.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// Stable code, `E0801`.
    pub code: &'static str,
    /// How bad.
    pub severity: Severity,
    /// One sentence without a full stop.
    pub message: String,
    /// Where.
    pub place: Place,
    /// Other places, in any source, each with what it has to do with it.
    pub related: Vec<(Place, String)>,
    /// What would be right.
    pub help: Option<String>,
}

impl Finding {
    /// An error.
    pub fn error(code: &'static str, place: Place, message: impl Into<String>) -> Self {
        let message = message.into();
        Self { code, severity: Severity::Error, message, place, related: Vec::new(), help: None }
    }

    /// A warning.
    pub(crate) fn warning(code: &'static str, place: Place, message: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, ..Self::error(code, place, message) }
    }

    /// What `pddl` says of a source of ours.
    pub(crate) fn of_pddl(source: SourceId, diagnostic: &pddl::Diagnostic) -> Self {
        let place = |span| Place { source, span };
        Self {
            code: diagnostic.code(),
            severity: diagnostic.severity,
            message: diagnostic.message(),
            place: place(diagnostic.span),
            related: diagnostic
                .labels
                .iter()
                .map(|(span, label)| (place(*span), label.to_string()))
                .collect(),
            help: diagnostic.help(),
        }
    }

    /// With advice.
    pub(crate) fn help(self, help: impl Into<String>) -> Self {
        self.help_if(Some(help.into()))
    }

    /// With advice, if there is any.
    pub(crate) fn help_if(mut self, help: Option<String>) -> Self {
        self.help = help;
        self
    }

    /// With another place.
    pub(crate) fn related(mut self, place: Place, message: impl Into<String>) -> Self {
        self.related.push((place, message.into()));
        self
    }

    /// Whether it is an error.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}

/// The texts of a mission.
#[derive(Clone, Debug, Default)]
pub struct Sources(IndexVec<SourceId, Arc<Source>>);

impl Sources {
    /// None yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds one.
    pub fn push(&mut self, source: Source) -> SourceId {
        self.0.push(Arc::new(source))
    }

    /// A place in the source of that id.
    pub(crate) fn start_of(source: SourceId) -> Place {
        Place { source, span: Span::default() }
    }

    /// All, with their ids.
    pub fn iter(&self) -> impl Iterator<Item = (SourceId, &Source)> {
        self.0.enumerate().map(|(id, s)| (id, &**s))
    }

    /// The source of that id, to keep.
    pub fn shared(&self, id: SourceId) -> Arc<Source> {
        Arc::clone(&self.0[id])
    }

    /// `path:line:column`.
    pub fn place(&self, place: Place) -> String {
        let source = &self.0[place.source];
        let at = source.line_column(place.span.start);
        format!("{}:{}:{}", source.name(), at.line, at.column)
    }

    /// A finding in plain lines: place, severity, code, message, then other places and the advice.
    pub fn describe(&self, finding: &Finding) -> String {
        let severity = match finding.severity {
            Severity::Warning => "warning",
            Severity::Unsupported => "unsupported",
            Severity::Error => "error",
        };
        let place = self.place(finding.place);
        let mut text = format!("{place}: {severity}[{}]: {}\n", finding.code, finding.message);
        for (place, message) in &finding.related {
            let _ = writeln!(text, "  {}: {message}", self.place(*place));
        }
        if let Some(help) = &finding.help {
            let _ = writeln!(text, "  help: {help}");
        }
        text
    }
}

impl std::ops::Index<SourceId> for Sources {
    type Output = Source;
    fn index(&self, id: SourceId) -> &Source {
        &self.0[id]
    }
}

/// Why there is no mission (or scenario): at least one finding is an error.
#[derive(Clone, Debug, thiserror::Error)]
#[error("{}", self.findings.iter().map(|f| self.sources.describe(f)).collect::<String>())]
pub struct MissionErrors {
    /// The texts that the findings speak of.
    pub sources: Sources,
    /// All that was found, by file and place.
    pub findings: Vec<Finding>,
}

/// The known name nearest to a mistyped one, as advice; `None` if none is near.
pub(crate) fn did_you_mean<'a>(wrong: &str, known: impl IntoIterator<Item = &'a str>) -> Option<String> {
    known
        .into_iter()
        .map(|name| (edit_distance(wrong, name), name))
        .filter(|&(distance, name)| distance <= 1 + name.chars().count() / 4)
        .min()
        .map(|(_, name)| format!("did you mean `{name}`?"))
}

/// How many letters to insert, delete, replace or swap with a neighbour; O(|a||b|) time, O(|b|) space.
fn edit_distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut before = Vec::new();
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for i in 0..a.len() {
        let mut row = vec![i + 1];
        for j in 0..b.len() {
            let replaced = above[j] + usize::from(a[i] != b[j]);
            let mut least = replaced.min(above[j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j] {
                let swapped: usize = before[j - 1];
                least = least.min(swapped + 1);
            }
            row.push(least);
        }
        before = std::mem::replace(&mut above, row);
    }
    above[b.len()]
}

#[cfg(test)]
mod tests {
    use super::{did_you_mean, edit_distance};

    #[test]
    fn near_names_are_found() {
        assert_eq!(edit_distance("aks", "ask"), 1);
        assert_eq!(edit_distance("", "abc"), 3);
        assert_eq!(edit_distance("kitten", "sitting"), 3);
        assert_eq!(did_you_mean("aks", ["ask", "axe"]), Some("did you mean `ask`?".to_owned()));
        assert_eq!(did_you_mean("kitchen", ["lift", "ramp"]), None);
    }
}
