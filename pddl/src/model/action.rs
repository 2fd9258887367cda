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
    /// The precondition.
    pub precondition: Condition,
    /// The precondition's preferences.
    pub preferences: Vec<Preference<Condition>>,
    /// The effect.
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
    /// The time.
    pub when: TimeSpecifier,
    /// The condition.
    pub condition: Condition,
}

/// A form around an effect that has a condition at another time than the effect.
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
    /// The time.
    pub when: TimeSpecifier,
    /// The word for the time: `end` in `(at end …)`. All of a `forall` or `when` that has the time inside.
    pub when_span: Span,
    /// The forms around it, outermost first, if one has a condition at another time than the effect.
    /// Conditions at the effect's own time are part of the effect.
    pub given: Vec<Given>,
    /// The change.
    pub effect: Effect,
}

/// `(op ?duration expression)`.
#[derive(Clone, Debug)]
pub struct DurationConstraint {
    /// The end at which the bound is evaluated: `at end`, or `at start`, which is the default.
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
    /// Bounds that must all hold; without bounds any duration is allowed.
    pub duration: Vec<DurationConstraint>,
    /// Conditions by time.
    pub conditions: Vec<TimedCondition>,
    /// The conditions' preferences, with their times.
    pub preferences: Vec<Preference<TimedCondition>>,
    /// Effects by time; those with [`Given`] forms come last.
    pub effects: Vec<TimedEffect>,
    /// Continuous effects from start to end.
    pub continuous: Vec<ContinuousEffect>,
    /// The parts that make it an agent's rule.
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
    /// `:priority 50`: the rule with the highest number gets a resource and preempts the others.
    pub priority: i32,
}

/// A skill's name and arguments.
#[derive(Clone, Debug)]
pub struct SkillCall {
    /// The skill.
    pub name: Name,
    /// Its arguments.
    pub arguments: Vec<Term>,
    /// Where it stands.
    pub span: Span,
}
