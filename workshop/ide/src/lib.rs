//! What an editor asks about PDDL, as pure functions over a [`Project`].
//!
//! Problem: editors speak protocols, and the answers to their questions do not depend on those. Idea: one
//! function for each question, in a file of its own. It takes the project and a [`Position`] or a file, and
//! returns plain data: places, Markdown, edits. All functions work on files with errors, since that is when
//! authors ask. Nothing here reads a disk, keeps state or knows a protocol.
//!
//! Source: the shape of rust-analyzer's `ide` crate (architecture.md, "IDE API").

mod actions;
mod applied;
mod completion;
mod context;
mod definition;
mod describe;
mod edit;
mod entity;
mod folding;
mod formatting;
mod highlights;
mod hover;
mod lenses;
mod path;
mod references;
mod rename;
mod selection;
mod semantic_tokens;
mod signature;
mod symbols;
mod usage;
mod words;

pub use actions::{ActionKind, CodeAction, code_actions};
pub use completion::{Completion, CompletionKind, completions};
pub use definition::{Definition, Target, definition};
pub use edit::{Edits, TextEdit};
pub use folding::{Fold, FoldKind, folding};
pub use formatting::{format, format_range};
pub use highlights::highlights;
pub use hover::{Hover, hover};
pub use lenses::{CodeLens, Lens, code_lenses};
pub use references::{Declarations, Reference, references};
pub use rename::{Renamable, RenameError, prepare_rename, rename};
pub use selection::selection;
pub use semantic_tokens::{SemanticToken, TokenRole, semantic_tokens};
pub use signature::{SignatureHelp, signature_help};
pub use symbols::{DocumentSymbol, SymbolShape, WorkspaceSymbol, document_symbols, workspace_symbols};

use diagnostics::SourceId;

#[cfg(doc)]
use project::Project;

/// A place between two characters of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Position {
    /// The file.
    pub source: SourceId,
    /// The offset in bytes.
    pub offset: u32,
}
