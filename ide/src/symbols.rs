//! What a file declares, as an outline; what a project declares, by name.

use pddl::{NameKind, Span};
use project::{Place, Project, SourceId};

/// What an entry of an outline is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SymbolShape {
    /// A section of several declarations, such as `:predicates`.
    Section,
    /// A declaration.
    Name(NameKind),
}

/// An entry of a file's outline.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DocumentSymbol {
    /// Its name.
    pub name: String,
    /// What it is.
    pub shape: SymbolShape,
    /// Signature or type.
    pub detail: Option<String>,
    /// The whole declaration.
    pub full: Span,
    /// The name in it.
    pub name_span: Span,
    /// What is inside.
    pub children: Vec<DocumentSymbol>,
}

/// A declaration somewhere in the project.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WorkspaceSymbol {
    /// Its name.
    pub name: String,
    /// What it is.
    pub kind: NameKind,
    /// The domain or problem that declares it.
    pub container: String,
    /// The name where it is declared.
    pub place: Place,
}

/// The outline of a file.
pub fn document_symbols(_project: &Project, _source: SourceId) -> Vec<DocumentSymbol> {
    Vec::new()
}

/// Declarations whose names hold the letters of `query` in order, in any case; all for the empty query.
pub fn workspace_symbols(_project: &Project, _query: &str) -> Vec<WorkspaceSymbol> {
    Vec::new()
}
