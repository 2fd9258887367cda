//! Events and failures as sentences. No file imports this one: the core of the crate is data.

use std::fmt::{Display, Formatter, Result};

use crate::event::RefinementEvent;
use crate::failure::{Failure, Reason};
use crate::ground::GroundTask;

impl Display for GroundTask {
    /// `(say barthel feeding introduction)`.
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        write!(f, "({}", self.name)?;
        for argument in &self.arguments {
            write!(f, " {argument}")?;
        }
        f.write_str(")")
    }
}

impl Display for RefinementEvent {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Self::MethodChosen { task, method } => write!(f, "{task} by {method}"),
            Self::Written { intention } => write!(f, "intends {intention}"),
            Self::Seen { intention } => write!(f, "sees {intention}"),
            Self::Failed { intention, why } => write!(f, "{intention} failed: {why}"),
            Self::MethodFailed { task, method } => write!(f, "{method} does not work for {task}"),
        }
    }
}

impl Display for Failure {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Self::NotStarted(error) => error.fmt(f),
            Self::NoMethodLeft { task, methods } => {
                write!(f, "no method works for {task}")?;
                for (i, (method, reason)) in methods.iter().enumerate() {
                    let separator = if i == 0 { ": " } else { "; " };
                    write!(f, "{separator}{method}: {reason}")?;
                }
                Ok(())
            }
        }
    }
}

impl Display for Reason {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Self::OtherArguments => f.write_str("does not apply, it is for other arguments"),
            Self::NotApplicable(unmet) => write!(f, "does not apply, {unmet}"),
            Self::NotTried => f.write_str("was not tried"),
            Self::NotBegun { intention, unmet: Some(unmet) } => {
                write!(f, "{intention} could not start, {unmet}")
            }
            Self::NotBegun { intention, unmet: None } => write!(f, "{intention} could not start in time"),
            Self::Missed { intention, seconds, unmet: Some(unmet) } => {
                write!(f, "{seconds} s after {intention}, {unmet}")
            }
            Self::Missed { intention, seconds, unmet: None } => {
                write!(f, "{seconds} s after {intention}, the graph has not changed")
            }
            Self::Broken { intention, unmet } => write!(f, "{intention} was broken off, {unmet}"),
            Self::Subtask(failure) => failure.fmt(f),
            Self::TooDeep => f.write_str("tasks are nested too deep; is there a recursion without an end?"),
            Self::NoArgument { subtask } => {
                write!(f, "an argument of `{subtask}` is unbound, or its node has left the graph")
            }
            Self::NoEdits { intention, error } => write!(f, "{intention} cannot be written: {error}"),
        }
    }
}
