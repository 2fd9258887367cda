//! Why a file of cortex cannot become a graph.

use dsr::{TransactionError, VocabularyError};

/// Why a file of cortex cannot become a graph.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the fields are what the variant is about")]
pub enum CortexError {
    /// Two symbols with one id.
    #[error("two symbols have the id {id}")]
    SameId { id: String },
    /// An RT link without three numbers each.
    #[error("link `RT` from `{parent}` to `{child}` has no translation and rotation of three numbers")]
    NoPose { parent: String, child: String },
    /// Tokens that a vocabulary rejects.
    #[error(transparent)]
    Vocabulary(#[from] VocabularyError),
    /// Links that break an invariant of the graph: a second root, a cycle, a second parent.
    #[error(transparent)]
    Transaction(#[from] TransactionError),
}
