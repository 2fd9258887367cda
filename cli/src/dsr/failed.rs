//! The failures of the commands on journals.

use crate::console::Console;
use crate::exit::Exit;
use crate::render;
use dsr::RecordingError;
use std::fmt::Display;
use std::path::Path;

/// Why a command has no result: the exit code and the message.
#[derive(Debug)]
pub(crate) struct Failed(pub(super) Exit, pub(super) String);

impl Failed {
    pub(crate) fn new(exit: Exit, message: String) -> Self {
        Self(exit, message)
    }

    pub(crate) fn show(self, console: &mut Console<'_>) -> Exit {
        render::error(self.1, console);
        self.0
    }
}

impl From<RecordingError> for Failed {
    fn from(error: RecordingError) -> Self {
        Self(Exit::Unreadable, error.to_string())
    }
}

/// A file cannot be written.
pub(super) fn unwritable_file(path: &Path, why: &dyn Display) -> Failed {
    Failed(Exit::Unwritable, format!("cannot write `{}`: {why}", path.display()))
}

/// A journal cannot be written to a folder.
pub(super) fn unwritable(folder: &Path, why: &dyn Display) -> Failed {
    Failed(Exit::Unwritable, format!("cannot write a journal to `{}`: {why}", folder.display()))
}
