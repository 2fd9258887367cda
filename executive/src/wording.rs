//! Outcomes and reasons as sentences, for terminals and records. Nothing imports this file: the core of the crate is data.

use std::fmt::{Display, Formatter, Result};

use planner::Wording;
use serde::{Serialize, Serializer};

use crate::Step;
use crate::compression::Meanwhile;
use crate::goals::{GoalChange, Life, Reason};
use crate::monitoring::{BrokenLiteral, Deviation};
use crate::outcome::{Ending, NoPlan, StepFailure, Stuck, Trouble, Unsolvable};

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
            Self::Concurrency(lost) => {
                f.write_str("no plan without actions that depend on each other while they run")?;
                let texts = lost.iter().map(|Meanwhile { action, predicate, giver }| {
                    format!("`{giver}` gives `{predicate}` to `{action}` only while it runs")
                });
                write!(f, ": {}", texts.collect::<Vec<_>>().join("; "))
            }
            Self::LimitReached(most) => write!(f, "no plan within {most} expansions"),
            Self::Unsupported(feature) => write!(f, "the planner does not support {feature}"),
            Self::TooLarge(why) => write!(f, "with the objects that have appeared: {why}"),
            Self::Invalid(finding) => write!(f, "the plan found does not validate: {}", finding.sentence),
            Self::Stopped => f.write_str("the planner stopped"),
            Self::Late(seconds) => write!(f, "no plan within {seconds} s"),
            Self::Stuck(stuck) => stuck.fmt(f),
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
            write!(f, " (without what just failed: {})", list(&self.barred))?;
        }
        Ok(())
    }
}

impl Display for StepFailure {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Self::Refinement(failure) => failure.fmt(f),
            Self::Late(seconds) => write!(f, "it was not done after {seconds} s"),
            Self::NotSensed => f.write_str("carried out, but what it was to achieve was not sensed"),
            Self::Refused(error) => error.fmt(f),
        }
    }
}

impl Display for Stuck {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Self::Replans(times) => write!(f, "{times} replans without progress"),
            Self::Restarts { step, times } => {
                write!(f, "{step} was started again {times} times without progress")
            }
            Self::Asks(times) => write!(f, "{times} plans in a row came for a world that had moved on"),
            Self::Attempts(steps) => {
                write!(f, "no plan without what failed again and again: {}", list(steps))
            }
        }
    }
}

impl Display for Trouble {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Self::NoPlan(why) => why.fmt(f),
            Self::Stuck(why) => why.fmt(f),
        }
    }
}

impl Display for Ending {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Self::Accomplished => f.write_str("mission accomplished"),
            Self::GivenUp { goals } => {
                let names: Vec<_> = goals.iter().map(ToString::to_string).collect();
                write!(f, "mission ended without {}", names.join(", "))
            }
            Self::WithHuman { why } => write!(f, "mission ended with a human: {why}"),
            Self::StillCalling { why } => write!(f, "mission ended still calling: {why}"),
            Self::StillGoing => f.write_str("mission still going on at the horizon of the run"),
            Self::Interrupted => f.write_str("mission interrupted"),
        }
    }
}

fn list(steps: &[Step]) -> String {
    steps.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
}

/// An ending in a record: its name, and why.
impl Serialize for Ending {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Record {
            ending: &'static str,
            #[serde(skip_serializing_if = "Option::is_none")]
            why: Option<String>,
        }
        let why = match self {
            Self::Accomplished | Self::StillGoing | Self::Interrupted => None,
            Self::GivenUp { goals } => {
                Some(goals.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "))
            }
            Self::WithHuman { why } => Some(why.to_string()),
            Self::StillCalling { why } => Some(why.to_string()),
        };
        Record { ending: self.name(), why }.serialize(serializer)
    }
}

impl Display for Life {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.write_str(self.name())
    }
}

impl Display for Reason {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match self {
            Self::Mission => f.write_str("the mission wants it from the start"),
            Self::Seen(tokens) => f.write_str(&tokens.join(", ")),
            Self::Lost => f.write_str("it does not hold any more"),
            Self::Released => f.write_str("nobody holds it any more"),
            Self::Turn => f.write_str("its turn has come"),
            Self::After(goal) => write!(f, "{goal} goes first"),
            Self::NoPlan(why) => why.fmt(f),
            Self::Late(seconds) => write!(f, "{seconds} s have passed"),
            Self::Penalty(penalty) => write!(f, "a plan without it is cheaper, by more than {penalty}"),
        }
    }
}

/// A change of a goal in a record: the goal, its stage, and why.
impl Serialize for GoalChange {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Record<'a> {
            goal: &'a str,
            life: &'static str,
            #[serde(skip_serializing_if = "String::is_empty")]
            why: String,
        }
        Record { goal: &self.goal, life: self.life.name(), why: self.why.to_string() }.serialize(serializer)
    }
}

impl Display for BrokenLiteral {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        match (&self.fact, &self.comparison) {
            (Some(fact), _) => write!(f, "{fact}")?,
            (None, Some(comparison)) => f.write_str(comparison)?,
            (None, None) => f.write_str("a condition")?,
        }
        f.write_str(if self.expected { " no longer holds" } else { " holds" })?;
        if !self.seen.is_empty() {
            write!(f, " ({})", self.seen.join(", "))?;
        }
        f.write_str(if self.expected { "; needed by " } else { "; it must not hold for " })?;
        match &self.needed_by {
            Some(step) => write!(f, "{step}")?,
            None => f.write_str("the goal")?,
        }
        match (&self.given_by, self.expected) {
            (Some(step), true) => write!(f, ", given by {step}"),
            (Some(step), false) => write!(f, ", ended by {step}"),
            (None, true) => f.write_str(", true when the plan was made"),
            (None, false) => f.write_str(", and did not when the plan was made"),
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
