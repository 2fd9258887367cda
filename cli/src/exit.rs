//! Exit codes.

use std::process::ExitCode;

/// The outcome of a command, as scripts see it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Exit {
    /// 0: solved, valid, accomplished, no errors.
    Yes,
    /// 1: proven unsolvable, plan invalid, not accomplished, errors found.
    No,
    /// 3: a limit (time, memory) was reached without an answer.
    Limit,
    /// 4: the task uses a PDDL feature that this command does not support; it is named.
    Unsupported,
    /// 130: a person ended the command with Ctrl-C; what there was by then is reported.
    Interrupted,
    /// 2: input that cannot be read: syntax, types, a missing file, wrong arguments.
    Unreadable,
    /// 74: a result could not be written.
    Unwritable,
    /// 70: a bug of ours, for instance a plan that does not validate. Nothing was written.
    Bug,
}

impl Exit {
    /// The number.
    pub const fn code(self) -> u8 {
        match self {
            Self::Yes => 0,
            Self::No => 1,
            Self::Unreadable => 2,
            Self::Limit => 3,
            Self::Unsupported => 4,
            Self::Interrupted => 130,
            Self::Bug => 70,
            Self::Unwritable => 74,
        }
    }

    /// The worse of two outcomes.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        self.max(other)
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit.code())
    }
}
