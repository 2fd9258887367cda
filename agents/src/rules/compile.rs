//! From an agent's file to rules: names resolved against the vocabulary and the skills, every mistake reported.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use dsr::{Mentions, Priority, ResourceId};
use pddl::Span;
use pddl::model::{
    Comparison, Condition, Domain, DurativeAction, Effect, EffectKind, ExpressionKind, Name, SkillCall, Term,
    TimeSpecifier, TypeSet, VariableId,
};
use vocabulary::{Link, LinkError, Sort, Tokens, ValueSort};

use super::agent::Agent;
use super::error::{RuleError, RuleErrorKind};
use super::regress::{Beginning, conjuncts};
use super::rule::{Argument, Rule};
use crate::skill::{DatumKind, Outcome, Signature, Skill, Skills};

/// Compiles an agent's file. The agent is the vocabulary's writer of the domain's name.
///
/// # Errors
/// Every mistake in the file, in the order of the file.
pub fn compile(domain: &Domain, tokens: &Tokens, skills: &Skills) -> Result<Agent, Vec<RuleError>> {
    let mut errors = Vec::new();
    let id = tokens.vocabulary().agent(&domain.name);
    if id.is_none() {
        let span = domain.durative_actions.iter().next().map_or(Span::default(), |action| action.span);
        let kind = RuleErrorKind::UnknownAgent { agent: domain.name.clone() };
        errors.push(RuleError { rule: None, span, kind });
    }
    let mut rules = Vec::new();
    for action in &domain.durative_actions {
        let mut compiler = Compiler {
            domain,
            tokens,
            skills,
            link: tokens.link(domain),
            action,
            beginning: Beginning::of(action),
            errors: &mut errors,
        };
        rules.extend(compiler.rule());
    }
    match id {
        Some(id) if errors.is_empty() => Ok(Agent::new(domain.name.clone(), id, rules, tokens.vocabulary())),
        _ => Err(errors),
    }
}

struct Compiler<'a> {
    domain: &'a Domain,
    tokens: &'a Tokens,
    skills: &'a Skills,
    link: Link<'a>,
    action: &'a DurativeAction,
    beginning: Beginning<'a>,
    errors: &'a mut Vec<RuleError>,
}

/// The conditions of a rule; those that cannot be read as graph are `None`.
struct Conditions<'a> {
    trigger: Option<vocabulary::Condition>,
    keep: Option<vocabulary::Condition>,
    /// The conjuncts of the condition over all that the effects at start do not establish.
    left: Vec<&'a Condition>,
}

impl<'a> Compiler<'a> {
    /// Reports each mistake once: an unknown type is found in the condition and in every effect.
    fn report(&mut self, span: Span, kind: RuleErrorKind) {
        let text = kind.to_string();
        if self.errors.iter().any(|error| error.span == span && error.kind.to_string() == text) {
            return;
        }
        self.errors.push(RuleError { rule: Some(self.action.name.clone()), span, kind });
    }

    /// The rule; `None` if it has a mistake.
    fn rule(&mut self) -> Option<Rule> {
        let before = self.errors.len();
        let call = self.action.rule.as_ref().and_then(|rule| rule.skill.as_ref());
        let skill = call.and_then(|call| self.skill(call));
        let limit = self.limit();
        let claims = self.claims();
        let Conditions { trigger, keep, left } = self.conditions();
        self.outcomes(call, skill.as_ref().map(|(skill, _)| skill.signature()).as_ref());
        if call.is_none() {
            self.without_skill();
        }
        let start = self.effect(&TimeSpecifier::Start);
        let mut outcomes = BTreeMap::new();
        for timed in &self.action.effects {
            let name = match &timed.when {
                TimeSpecifier::End => Outcome::new(Outcome::END),
                TimeSpecifier::Outcome(name) => Outcome::new(name),
                TimeSpecifier::Start | TimeSpecifier::OverAll => continue,
            };
            if !outcomes.contains_key(&name)
                && let Some(effect) = self.effect(&timed.when)
            {
                outcomes.insert(name, effect);
            }
        }
        let (trigger, keep, start) = (trigger?, keep?, start?);
        if self.errors.len() > before {
            return None;
        }
        let unsure = self.unsure(&left, &start);
        Some(Rule {
            name: self.action.name.clone(),
            variables: self.action.variables.clone(),
            trigger,
            keep,
            start,
            unsure,
            outcomes,
            results: self.action.rule.as_ref().map_or_else(Vec::new, |rule| rule.results.clone()),
            skill,
            claims,
            priority: Priority(self.action.rule.as_ref().map_or(0, |rule| rule.priority)),
            limit,
        })
    }

    fn skill(&mut self, call: &SkillCall) -> Option<(Arc<dyn Skill>, Vec<Argument>)> {
        let Some(skill) = self.skills.get(&call.name) else {
            let known = self.skills.signatures().map(|signature| signature.name).collect();
            self.report(call.span, RuleErrorKind::UnknownSkill { skill: call.name.clone(), known });
            return None;
        };
        let signature = skill.signature();
        let (arity, yields) = (signature.arity(), signature.results);
        if !arity.contains(&call.arguments.len()) {
            let (skill, found) = (call.name.clone(), call.arguments.len());
            self.report(call.span, RuleErrorKind::SkillArity { skill, expected: arity, found });
        }
        self.results(call, yields);
        let mut arguments = Vec::new();
        for argument in &call.arguments {
            match *argument {
                Term::Object(object) => {
                    arguments.push(Argument::Constant(self.domain.constants[object].name.as_str().into()));
                }
                Term::Variable(variable) if self.is_parameter(variable) => {
                    arguments.push(Argument::Parameter(variable));
                }
                Term::Variable(variable) => {
                    let variable = self.action.variables[variable].name.clone();
                    self.report(call.span, RuleErrorKind::ArgumentUnbound { variable });
                }
            }
        }
        Some((Arc::clone(skill), arguments))
    }

    fn is_parameter(&self, variable: VariableId) -> bool {
        self.action.variables.parameter_ids().any(|parameter| parameter == variable)
    }

    fn results(&mut self, call: &SkillCall, yields: &[DatumKind]) {
        let results: &[VariableId] = self.action.rule.as_ref().map_or(&[], |rule| &rule.results);
        if results.len() != yields.len() {
            let (expected, found) = (yields.len(), results.len());
            self.report(call.span, RuleErrorKind::ResultCount { skill: call.name.clone(), expected, found });
        }
        for (&result, &expected) in results.iter().zip(yields) {
            let declared = &self.action.variables[result];
            let variable = declared.name.clone();
            if declared.types == TypeSet::any() {
                self.report(declared.span, RuleErrorKind::UntypedResult { variable });
            } else if declared
                .types
                .0
                .iter()
                .any(|&id| self.kind(&self.domain.types[id].name) != Some(expected))
            {
                self.report(declared.span, RuleErrorKind::ResultKind { variable, expected });
            }
        }
    }

    fn kind(&self, node_type: &Name) -> Option<DatumKind> {
        match self.tokens.sort(node_type)? {
            Sort::Node(_) => Some(DatumKind::Node),
            Sort::Value(ValueSort::Pose) => Some(DatumKind::Pose),
            Sort::Value(_) => None,
        }
    }

    fn limit(&mut self) -> Option<Duration> {
        let mut limit = None;
        for constraint in &self.action.duration {
            let seconds = match (&constraint.comparison, &constraint.bound.kind) {
                (Comparison::LessEqual | Comparison::Equal, ExpressionKind::Number(seconds)) => {
                    Duration::try_from_secs_f64(*seconds).ok().filter(|seconds| !seconds.is_zero())
                }
                _ => None,
            };
            match seconds {
                Some(seconds) => limit = Some(limit.map_or(seconds, |other: Duration| other.min(seconds))),
                None => self.report(constraint.span, RuleErrorKind::Duration),
            }
        }
        limit
    }

    fn claims(&mut self) -> Vec<ResourceId> {
        let mut claims = Vec::new();
        for claim in self.action.rule.iter().flat_map(|rule| &rule.claims) {
            let term = match *claim {
                Term::Object(object) => self.domain.constants[object].name.clone(),
                Term::Variable(variable) => Name::new(&format!("?{}", self.action.variables[variable].name)),
            };
            match self.tokens.vocabulary().resource(&term) {
                Some(resource) if !claims.contains(&resource) => claims.push(resource),
                Some(_) => {}
                None => self.report(self.action.name_span, RuleErrorKind::NotAResource { term }),
            }
        }
        claims
    }

    /// The condition before the start, and the condition over all.
    fn conditions(&mut self) -> Conditions<'a> {
        let action = self.action;
        let (mut trigger, mut keep) = (Vec::new(), Vec::new());
        for timed in &action.conditions {
            match timed.when {
                TimeSpecifier::Start => trigger.push(&timed.condition),
                TimeSpecifier::OverAll => conjuncts(&timed.condition, &mut keep),
                TimeSpecifier::End | TimeSpecifier::Outcome(_) => {
                    self.report(timed.condition.span, RuleErrorKind::ConditionTime);
                }
            }
        }
        let left: Vec<_> =
            keep.iter().copied().filter(|condition| !self.beginning.establishes(condition)).collect();
        trigger.extend(&left);
        Conditions { trigger: self.condition(trigger), keep: self.condition(keep), left }
    }

    /// The tokens to watch because the effects at start may falsify what is left of the condition over all. A part that
    /// they cannot change holds after the start if it held before, and the matches of the trigger report that.
    fn unsure(&self, left: &[&Condition], start: &vocabulary::Effect) -> Mentions {
        let written = start.mentions();
        let mut watched = Mentions::default();
        for condition in left {
            let read = self.link.condition(&self.action.variables, [*condition]);
            let read = read.map_or_else(|_| Mentions::default(), |condition| condition.mentions().clone());
            let shared = read.attributes().any(|read| written.attributes().any(|written| written == read))
                || (read.transforms() && written.transforms())
                || self.beginning.may_change(condition);
            if shared {
                watched.extend(&read);
                watched.extend(&written);
            }
        }
        watched
    }

    fn condition(&mut self, parts: Vec<&Condition>) -> Option<vocabulary::Condition> {
        let linked = self.link.condition(&self.action.variables, parts);
        self.linked(linked)
    }

    fn effect(&mut self, when: &TimeSpecifier) -> Option<vocabulary::Effect> {
        let effects =
            self.action.effects.iter().filter(|timed| timed.when == *when).map(|timed| &timed.effect);
        let linked = self.link.effect(&self.action.variables, effects);
        self.linked(linked)
    }

    /// What was linked to the vocabulary; otherwise its mistakes are reported.
    fn linked<T>(&mut self, linked: Result<T, Vec<LinkError>>) -> Option<T> {
        let mistakes = match linked {
            Ok(linked) => return Some(linked),
            Err(mistakes) => mistakes,
        };
        for mistake in mistakes {
            self.report(mistake.span, RuleErrorKind::Graph(mistake.kind));
        }
        None
    }

    /// Checks that every outcome can happen, and that only effects at the end use results.
    fn outcomes(&mut self, call: Option<&SkillCall>, signature: Option<&Signature>) {
        let action = self.action;
        let results: &[VariableId] = action.rule.as_ref().map_or(&[], |rule| &rule.results);
        let guarded = action.conditions.iter().any(|timed| timed.when == TimeSpecifier::OverAll)
            || action.rule.as_ref().is_some_and(|rule| !rule.claims.is_empty());
        for timed in &action.effects {
            let span = timed.when_span;
            let name = match &timed.when {
                TimeSpecifier::End => continue,
                TimeSpecifier::Start | TimeSpecifier::OverAll => Name::new("start"),
                TimeSpecifier::Outcome(name) => name.clone(),
            };
            if let Some(&result) = results.iter().find(|&&result| mentions(&timed.effect, result)) {
                let variable = action.variables[result].name.clone();
                self.report(
                    timed.effect.span,
                    RuleErrorKind::ResultUnbound { variable, outcome: name.clone() },
                );
            }
            if !matches!(timed.when, TimeSpecifier::Outcome(_)) {
                continue;
            }
            match &*name {
                Outcome::ABORT if !guarded => self.report(span, RuleErrorKind::NeverAborted),
                Outcome::TIMEOUT if action.duration.is_empty() => {
                    self.report(span, RuleErrorKind::NeverTimesOut);
                }
                Outcome::ABORT | Outcome::TIMEOUT => {}
                other => {
                    if let (Some(call), Some(signature)) = (call, signature)
                        && !signature.outcomes.contains(&other)
                    {
                        let (skill, outcome) = (call.name.clone(), name.clone());
                        let always = [Outcome::END, Outcome::ABORT, Outcome::TIMEOUT];
                        let known = always.into_iter().chain(signature.outcomes.iter().copied()).collect();
                        self.report(span, RuleErrorKind::UnknownOutcome { skill, outcome, known });
                    }
                }
            }
        }
    }

    /// A rule without a skill ends when it begins.
    fn without_skill(&mut self) {
        let action = self.action;
        let lasts = action.conditions.iter().any(|timed| timed.when == TimeSpecifier::OverAll)
            || action.effects.iter().any(|timed| timed.when != TimeSpecifier::Start)
            || !action.duration.is_empty()
            || action.rule.as_ref().is_some_and(|rule| !rule.results.is_empty() || !rule.claims.is_empty());
        let at_start = || action.conditions.iter().filter(|timed| timed.when == TimeSpecifier::Start);
        if lasts {
            self.report(action.name_span, RuleErrorKind::NothingRuns);
        } else if !at_start().any(|timed| self.beginning.falsifies(&timed.condition)) {
            self.report(action.name_span, RuleErrorKind::Loops);
        }
    }
}

/// Whether an effect mentions a variable.
fn mentions(effect: &Effect, variable: VariableId) -> bool {
    use pddl::model::AssignedValue;
    let is = |term: &Term| *term == Term::Variable(variable);
    match &effect.kind {
        EffectKind::And(parts) => parts.iter().any(|part| mentions(part, variable)),
        EffectKind::Add(atom) | EffectKind::Delete(atom) => atom.arguments.iter().any(is),
        EffectKind::Assign(_, application, value) => {
            application.arguments.iter().any(is) || matches!(value, AssignedValue::Object(term) if is(term))
        }
        EffectKind::Forall(_, inner) | EffectKind::When(_, inner) => mentions(inner, variable),
    }
}
