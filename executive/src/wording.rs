//! Outcomes and reasons as sentences, for terminals and records. Nothing imports this file: the core of the crate is data.

use std::fmt::{Display, Formatter, Result};

use planner::Wording;
use serde::{Serialize, Serializer};

use crate::Step;
use crate::monitoring::{BrokenLiteral, Deviation};
use crate::outcome::{Ending, Fallback, NoPlan, StepFailure, Unsolvable};

/// How many reasons follow the first sentence.
const REASONS: usize = 4;

impl Display for Step {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        write!(f, "({}", self.action)?;
        for argument in &self.arguments {
            write!(f, " {argument}")?;
        }
        f.write_str(")")
    }
}

impl Display for NoPlan {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Self::Unsolvable(proof) => proof.fmt(f),
            Self::LimitReached(most) => write!(f, "no plan within {most} expansions"),
            Self::Unsupported(feature) => write!(f, "the planner does not support {feature}"),
            Self::Invalid(finding) => write!(f, "the plan found does not validate: {}", finding.sentence),
            Self::Stopped => f.write_str("the planner stopped"),
        }
    }
}

/// What can never hold, why it cannot, and which steps were left out.
impl Display for Unsolvable {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let words = Wording::new(self.model.task(), &self.explanation);
        f.write_str(&words.sentence())?;
        let (chain, lines) = (words.chain(), words.lines());
        let reasons = match chain.as_slice() {
            [] => lines.iter().map(|line| line.trim_start()).take(REASONS).collect::<Vec<_>>().join("; "),
            [first, .., before, last] if chain.len() > REASONS => format!("{first}; …; {before}; {last}"),
            all => all.join("; "),
        };
        if !reasons.is_empty() {
            write!(f, ": {reasons}")?;
        }
        if !self.barred.is_empty() {
            let steps: Vec<_> = self.barred.iter().map(ToString::to_string).collect();
            write!(f, " (without what just failed: {})", steps.join(", "))?;
        }
        Ok(())
    }
}

impl Display for StepFailure {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Self::Refinement(failure) => failure.fmt(f),
            Self::NotSensed => f.write_str("carried out, but what it was to achieve was not sensed"),
            Self::Refused(error) => error.fmt(f),
        }
    }
}

impl Display for Ending {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Self::Accomplished => f.write_str("mission accomplished"),
            Self::NotAccomplished { why, fallback } => {
                write!(f, "mission not accomplished: {}", reason(why, fallback))
            }
        }
    }
}

fn reason(why: &NoPlan, fallback: &Fallback) -> String {
    match fallback {
        Fallback::Done => why.to_string(),
        Fallback::NotStarted(error) => format!("{why}; {error}"),
        Fallback::Failed(failure) => format!("{why}; {failure}"),
    }
}

/// An ending in a record.
#[derive(Serialize)]
#[serde(tag = "ending", rename_all = "snake_case")]
enum Record {
    Accomplished,
    NotAccomplished {
        why: String,
        /// Whether the fallback was carried out.
        fallback: bool,
    },
}

impl Serialize for Ending {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        let record = match self {
            Self::Accomplished => Record::Accomplished,
            Self::NotAccomplished { why, fallback } => {
                Record::NotAccomplished { why: reason(why, fallback), fallback: *fallback == Fallback::Done }
            }
        };
        record.serialize(serializer)
    }
}

impl Display for BrokenLiteral {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match &self.fact {
            Some(fact) => write!(f, "{fact}")?,
            None => f.write_str("a condition")?,
        }
        f.write_str(if self.expected { " no longer holds" } else { " holds" })?;
        if !self.seen.is_empty() {
            write!(f, " ({})", self.seen.join(", "))?;
        }
        f.write_str(if self.expected { "; needed by " } else { "; it must not for " })?;
        match &self.needed_by {
            Some(step) => write!(f, "{step}")?,
            None => f.write_str("the goal")?,
        }
        match &self.given_by {
            Some(step) => write!(f, ", given by {step}"),
            None => f.write_str(", true when the plan was made"),
        }
    }
}

impl Display for Deviation {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        for (i, literal) in self.broken.iter().enumerate() {
            if i > 0 {
                f.write_str("; ")?;
            }
            write!(f, "{literal}")?;
        }
        Ok(())
    }
}
