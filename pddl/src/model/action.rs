//! Instantaneous actions, durative actions, and the agents' rules that durative actions express.

use super::{
    Comparison, Condition, ContinuousEffect, Effect, Expression, FunctionTerm, Name, Preference, Term,
    Variables,
};
use crate::Span;

/// An instantaneous action schema.
#[derive(Clone, Debug)]
pub struct Action {
    /// Its name.
    pub name: Name,
    /// Parameters and quantified variables.
    pub variables: Variables,
    /// When it may be applied.
    pub precondition: Condition,
    /// What should hold as well.
    pub preferences: Vec<Preference<Condition>>,
    /// What it does.
    pub effect: Effect,
    /// The whole definition.
    pub span: Span,
    /// The name in the definition.
    pub name_span: Span,
}

/// A point or interval of a durative action.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum TimeSpecifier {
    /// `at start`
    Start,
    /// `over all`
    OverAll,
    /// `at end`
    End,
    /// `at NAME` with a name of the skill's other outcomes (`abort`, `silence`, `failure` …).
    /// Only in domains that require `:agent-rules`.
    Outcome(Name),
}

/// A condition at a time.
#[derive(Clone, Debug)]
pub struct TimedCondition {
    /// When.
    pub when: TimeSpecifier,
    /// What must hold.
    pub condition: Condition,
}

/// Something around an effect that looks at another time than the effect's.
#[derive(Clone, Debug)]
pub enum Given {
    /// For every binding of these slots.
    Forall(Vec<super::VariableId>),
    /// If each of these holds at its time.
    When(Vec<TimedCondition>),
}

/// An effect at a time.
#[derive(Clone, Debug)]
pub struct TimedEffect {
    /// When.
    pub when: TimeSpecifier,
    /// What stands around it, outermost first, if a condition in it is at another time than the effect;
    /// conditions at the effect's own time alone are in the effect.
    pub given: Vec<Given>,
    /// What changes.
    pub effect: Effect,
}

/// `(op ?duration expression)`.
#[derive(Clone, Debug)]
pub struct DurationConstraint {
    /// At which of the two ends the bound is read: `at start`, also where none is written, or `at end`.
    pub when: TimeSpecifier,
    /// `<=`, `=` or `>=`.
    pub comparison: Comparison,
    /// The bound, in seconds.
    pub bound: Expression,
    /// Functions that stand as arguments in it, innermost first.
    pub functions: Vec<FunctionTerm>,
    /// Where it stands.
    pub span: Span,
}

/// A durative action schema. Conjunctions over time specifiers are flattened.
#[derive(Clone, Debug)]
pub struct DurativeAction {
    /// Its name.
    pub name: Name,
    /// Parameters, then the results of the rule's skill, then quantified variables.
    pub variables: Variables,
    /// All must hold; none means any duration.
    pub duration: Vec<DurationConstraint>,
    /// Conditions by time.
    pub conditions: Vec<TimedCondition>,
    /// What should hold as well, at its time.
    pub preferences: Vec<Preference<TimedCondition>>,
    /// Effects by time; those with something [`Given`] come last.
    pub effects: Vec<TimedEffect>,
    /// What changes from start to end.
    pub continuous: Vec<ContinuousEffect>,
    /// What makes it an agent's rule.
    pub rule: Option<Rule>,
    /// The whole definition.
    pub span: Span,
    /// The name in the definition.
    pub name_span: Span,
}

/// The part of a durative action that only agents' rules have (requirement `:agent-rules`).
#[derive(Clone, Debug)]
pub struct Rule {
    /// `:skill (say ?part ?utterance)`: the HAL call that runs between start and end.
    pub skill: Option<SkillCall>,
    /// `:results (?o - option)`: slots that the skill binds when it ends.
    pub results: Vec<super::VariableId>,
    /// `:claims (speaker)`: resources held from start to end.
    pub claims: Vec<Term>,
    /// `:priority 50`: who wins a resource; higher preempts lower.
    pub priority: i32,
}

/// A skill's name and arguments.
#[derive(Clone, Debug)]
pub struct SkillCall {
    /// The skill.
    pub name: Name,
    /// What it is given.
    pub arguments: Vec<Term>,
    /// Where it stands.
    pub span: Span,
}
