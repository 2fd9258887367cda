//! Mistakes in a rule, with their places in the agent's file.

use std::ops::RangeInclusive;

use pddl::Span;
use pddl::model::Name;

use crate::skill::DatumKind;

/// A mistake in an agent's file.
#[derive(Debug, Clone, thiserror::Error)]
#[error("{kind}")]
pub struct RuleError {
    /// The rule; `None` if it is about the agent.
    pub rule: Option<Name>,
    /// Where.
    pub span: Span,
    /// What.
    pub kind: RuleErrorKind,
}

/// The mistakes that a rule can have beyond those of PDDL.
#[derive(Debug, Clone, thiserror::Error)]
#[expect(missing_docs, reason = "the fields are the terms of the variant")]
pub enum RuleErrorKind {
    /// The vocabulary has no writer of the domain's name.
    #[error("'{agent}' writes nothing in the vocabulary, so it is no agent")]
    UnknownAgent { agent: Name },
    /// The skill is unknown.
    #[error("there is no skill '{skill}'; there are: {}", known.join(", "))]
    UnknownSkill { skill: Name, known: Vec<&'static str> },
    /// The skill takes another number of arguments.
    #[error("skill '{skill}' takes {}, not {found}", range(expected))]
    SkillArity { skill: Name, expected: RangeInclusive<usize>, found: usize },
    /// An argument of a skill is a result of the same skill.
    #[error("'?{variable}' is known only after the skill that it is given to")]
    ArgumentUnbound { variable: Name },
    /// The skill yields another number of results.
    #[error("skill '{skill}' yields {expected} result{}, not {found}", if *expected == 1 { "" } else { "s" })]
    ResultCount { skill: Name, expected: usize, found: usize },
    /// A result without a type.
    #[error("the result '?{variable}' needs a type")]
    UntypedResult { variable: Name },
    /// A result of the wrong kind.
    #[error("the result '?{variable}' is a {expected}")]
    ResultKind { variable: Name, expected: DatumKind },
    /// A result in effects at another time than the end.
    #[error("'?{variable}' is yielded at end only, not at {outcome}")]
    ResultUnbound { variable: Name, outcome: Name },
    /// The skill does not have this outcome.
    #[error("skill '{skill}' never ends with '{outcome}'; it ends with: {}", known.join(", "))]
    UnknownOutcome { skill: Name, outcome: Name, known: Vec<&'static str> },
    /// Effects of an abort that no reflex can cause.
    #[error("nothing can abort this rule: it has no condition over all and claims nothing")]
    NeverAborted,
    /// Effects of a timeout without a duration.
    #[error("this rule has no duration, so no timeout")]
    NeverTimesOut,
    /// The claim is not a resource.
    #[error("'{term}' is no resource of the vocabulary")]
    NotAResource { term: Name },
    /// A duration other than an upper bound by a positive number.
    #[error("the duration of a rule is '(<= ?duration SECONDS)'")]
    Duration,
    /// A condition at the end.
    #[error("a rule has conditions at start and over all only")]
    ConditionTime,
    /// A rule without a skill that has more than a beginning.
    #[error("without a skill there is nothing between start and end")]
    NothingRuns,
    /// A rule without a skill that leaves its own condition true.
    #[error("this rule would start again and again: its effects leave its own condition true")]
    Loops,
    /// A condition or an effect that cannot be read as patterns or edits of the graph.
    #[error(transparent)]
    Graph(#[from] vocabulary::LinkErrorKind),
}

fn range(range: &RangeInclusive<usize>) -> String {
    match (range.start(), range.end()) {
        (1, 1) => "1 argument".to_owned(),
        (least, most) if least == most => format!("{least} arguments"),
        (least, most) => format!("{least} to {most} arguments"),
    }
}
