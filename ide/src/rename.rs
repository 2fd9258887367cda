//! Another name for a thing, wherever it stands.

use pddl::NameKind;
use project::{Place, Project};

use crate::{Edits, Position};

/// A name that can be changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Renamable {
    /// Where it stands, without a variable's question mark.
    pub place: Place,
    /// As it is now.
    pub name: String,
}

/// Why a name cannot be changed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RenameError {
    /// No name stands there.
    #[error("there is no name here")]
    NoName,
    /// It is part of the language or of something outside the project.
    #[error("the {kind} `{name}` is not the project's to rename")]
    Foreign {
        /// What it is.
        kind: NameKind,
        /// Which.
        name: String,
    },
    /// The new name is none.
    #[error("`{name}` is not a name")]
    Invalid {
        /// As asked for.
        name: String,
    },
    /// The language has other plans for the new name.
    #[error("`{name}` is a word of the language")]
    Reserved {
        /// As asked for.
        name: String,
    },
    /// There is one already.
    #[error("there is a {kind} `{name}` already")]
    Clash {
        /// What the other one is.
        kind: NameKind,
        /// The name.
        name: String,
        /// Where the other one stands.
        place: Place,
    },
    /// A file in which the name stands has parentheses that do not match: not every occurrence may be known.
    #[error("a file in which it stands is broken: its parentheses do not match")]
    Broken {
        /// Where.
        place: Place,
    },
}

/// Whether the name at a position can be changed.
pub fn prepare_rename(_project: &Project, _at: Position) -> Result<Renamable, RenameError> {
    Err(RenameError::NoName)
}

/// Gives the thing at a position another name in all files, closed ones and plans included.
pub fn rename(_project: &Project, _at: Position, _name: &str) -> Result<Edits, RenameError> {
    Err(RenameError::NoName)
}
