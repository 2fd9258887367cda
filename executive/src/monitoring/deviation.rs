//! Why a plan no longer fits: the fact, the step that needs it, the step that was to give it. `wording` makes sentences
//! of it.

use crate::Step;
use low_to_high::Fact;

/// One literal of a kernel that does not hold.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct BrokenLiteral {
    /// The fact; `None` for a comparison of numbers and for an auxiliary fact of grounding.
    #[serde(serialize_with = "as_text")]
    pub fact: Option<Fact>,
    /// The comparison of numbers as PDDL writes it, if it is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub comparison: Option<String>,
    /// The truth value that the plan needs.
    pub expected: bool,
    /// The first step that needs it; `None` if the goal does.
    pub needed_by: Option<Step>,
    /// The last step that was to give it; `None` if it held when the plan was made.
    pub given_by: Option<Step>,
    /// The tokens of the graph that show its present truth value, as sentences.
    pub seen: Vec<String>,
}

fn as_text<S: serde::Serializer>(fact: &Option<Fact>, to: S) -> Result<S::Ok, S::Error> {
    match fact {
        Some(fact) => to.serialize_some(&fact.to_string()),
        None => to.serialize_none(),
    }
}

/// Everything that a plan needs and that does not hold.
#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Deviation {
    /// The literals, in order of the planner's facts.
    pub broken: Vec<BrokenLiteral>,
}
