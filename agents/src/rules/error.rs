//! What is wrong with a rule, with the place in the agent's file.

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
    /// The domain's name is none of the vocabulary's writers.
    #[error("'{agent}' writes nothing in the vocabulary, so it is no agent")]
    UnknownAgent { agent: Name },
    /// There is no such skill.
    #[error("there is no skill '{skill}'; there are: {}", known.join(", "))]
    UnknownSkill { skill: Name, known: Vec<&'static str> },
    /// The skill takes another number of arguments.
    #[error("skill '{skill}' takes {} arguments, not {found}", range(expected))]
    SkillArity { skill: Name, expected: RangeInclusive<usize>, found: usize },
    /// An argument of a skill is a result of the same skill.
    #[error("'?{variable}' is known only after the skill that it is given to")]
    ArgumentUnbound { variable: Name },
    /// The skill yields another number of results.
    #[error("skill '{skill}' yields {expected} results, not {found}")]
    ResultCount { skill: Name, expected: usize, found: usize },
    /// A result without a type.
    #[error("the result '?{variable}' needs a type")]
    UntypedResult { variable: Name },
    /// A result of the wrong kind.
    #[error("the result '?{variable}' is a {expected}")]
    ResultKind { variable: Name, expected: DatumKind },
    /// A result where no skill has yielded it.
    #[error("'?{variable}' is yielded at end only, not at {outcome}")]
    ResultUnbound { variable: Name, outcome: Name },
    /// The skill never ends so.
    #[error("skill '{skill}' never ends with '{outcome}'")]
    UnknownOutcome { skill: Name, outcome: Name },
    /// Effects of an abort that no reflex can cause.
    #[error("nothing can abort this rule: it has no condition over all and claims nothing")]
    NeverAborted,
    /// Effects of a timeout without a duration.
    #[error("this rule has no duration, so no timeout")]
    NeverTimesOut,
    /// What is claimed is no resource.
    #[error("'{term}' is no resource of the vocabulary")]
    NotAResource { term: Name },
    /// A duration that is no upper bound by a positive number.
    #[error("the duration of a rule is '(<= ?duration SECONDS)'")]
    Duration,
    /// A condition at the end.
    #[error("a rule has conditions at start and over all only")]
    ConditionTime,
    /// A rule without a skill that has more than a beginning.
    #[error("without a skill there is nothing between start and end")]
    NothingRuns,
    /// A rule without a skill that leaves its own condition as it was.
    #[error("this rule would start again and again: its effects leave its own condition true")]
    Loops,
    /// A condition or an effect that cannot be read as graph.
    #[error(transparent)]
    Graph(#[from] vocabulary::LinkErrorKind),
}

fn range(range: &RangeInclusive<usize>) -> String {
    if range.start() == range.end() {
        range.start().to_string()
    } else {
        format!("{} to {}", range.start(), range.end())
    }
}
