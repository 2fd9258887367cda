//! Why a plan no longer fits: the fact, the step that needed it, the step that was to give it.

use crate::Step;
use low_to_high::Fact;
use std::fmt;

/// One literal of a kernel that does not hold.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct BrokenLiteral {
    /// The fact; `None` for one that grounding made up.
    #[serde(serialize_with = "as_text")]
    pub fact: Option<Fact>,
    /// The truth that the plan counted on.
    pub expected: bool,
    /// The first step that needed it; `None`: the goal did.
    pub needed_by: Option<Step>,
    /// The last step that was to give it; `None`: it held when the plan was made.
    pub given_by: Option<Step>,
    /// The tokens of the graph that say so, as sentences.
    pub seen: Vec<String>,
}

fn as_text<S: serde::Serializer>(fact: &Option<Fact>, to: S) -> Result<S::Ok, S::Error> {
    match fact {
        Some(fact) => to.serialize_some(&fact.to_string()),
        None => to.serialize_none(),
    }
}

impl fmt::Display for BrokenLiteral {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
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

/// Everything about a plan that no longer holds.
#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Deviation {
    /// The literals, in order of the planner's facts.
    pub broken: Vec<BrokenLiteral>,
}

impl fmt::Display for Deviation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, literal) in self.broken.iter().enumerate() {
            if i > 0 {
                f.write_str("; ")?;
            }
            write!(f, "{literal}")?;
        }
        Ok(())
    }
}
