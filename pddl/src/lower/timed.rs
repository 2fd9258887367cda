//! Conditions and effects at times: `(at start …)`, `(over all …)`, `(at end …)`, `(at OUTCOME …)`.
//!
//! Traps: a predicate may be called `at` (`(at start (at ?x ?y))`), and a `forall` may stand around
//! several times. A time is recognised by its form, `at` and a name and a list, for no atom has a
//! list as argument. A `forall` around several times is read once for each, so that every timed part
//! has quantified slots of its own.

use super::body::Body;
use crate::diagnostic::{DiagnosticKind, UnsupportedFeature};
use crate::model::{
    Condition, ConditionKind, Effect, EffectKind, Name, Preference, Requirement, TimeSpecifier,
    TimedCondition, TimedEffect,
};
use crate::syntax::Node;

/// What a list says about time.
pub(super) enum Timed<'t> {
    /// A time and what happens then.
    At(TimeSpecifier, Node<'t>),
    /// Like a time, but an unknown one.
    Unknown(Node<'t>),
    /// No time.
    Untimed,
}

pub(super) fn timed<'t>(node: Node<'t>, outcomes: bool) -> Timed<'t> {
    let mut parts = node.children();
    let (Some(head), Some(when), Some(what), None) = (parts.next(), parts.next(), parts.next(), parts.next())
    else {
        return Timed::Untimed;
    };
    if !what.is_list() || !when.is_name() {
        Timed::Untimed
    } else if head.is("over") && when.is("all") {
        Timed::At(TimeSpecifier::OverAll, what)
    } else if !head.is("at") {
        Timed::Untimed
    } else if when.is("start") {
        Timed::At(TimeSpecifier::Start, what)
    } else if when.is("end") {
        Timed::At(TimeSpecifier::End, what)
    } else if outcomes {
        Timed::At(TimeSpecifier::Outcome(Name::new(when.text())), what)
    } else {
        Timed::Unknown(when)
    }
}

/// Whether a part at `time` is to be read now.
fn wanted(time: &TimeSpecifier, only: Option<&TimeSpecifier>) -> bool {
    only.is_none_or(|o| o == time)
}

impl Body<'_> {
    fn outcomes(&self) -> bool {
        self.world.has(Requirement::AgentRules)
    }

    /// Appends the times that stand in `node` outside of preferences, each once, in order.
    fn times_in(&self, node: Node<'_>, times: &mut Vec<TimeSpecifier>) {
        if let Timed::At(time, what) = timed(node, self.outcomes()) {
            if !times.contains(&time) && !self.is_soft(what) {
                times.push(time);
            }
        } else if node.is_headed("when") {
            if let Some(effect) = node.children().nth(2) {
                self.times_in(effect, times);
            }
        } else if !self.is_preference(node) {
            for part in node.children().skip(1) {
                self.times_in(part, times);
            }
        }
    }

    fn times_of(&self, node: Node<'_>) -> Vec<TimeSpecifier> {
        let mut times = Vec::new();
        self.times_in(node, &mut times);
        times
    }

    /// Reads the preferences among the conditions at times in `node`.
    pub(super) fn timed_preferences(&mut self, node: Node<'_>) -> Vec<Preference<TimedCondition>> {
        let mut preferences = Vec::new();
        for found in self.preferences_in(node) {
            let time = found.time.clone();
            let read = |body: &mut Self, node| body.preferred(node, time);
            preferences.extend(self.preference(&found, read));
        }
        preferences
    }

    /// What a preference holds; its time stands in it or around it.
    fn preferred(&mut self, node: Node<'_>, time: Option<TimeSpecifier>) -> Option<TimedCondition> {
        if let Some(when) = time {
            return Some(TimedCondition { when, condition: self.condition(node) });
        }
        for inner in self.preferences_in(node) {
            self.misplaced_preference(inner.node);
        }
        let times = self.times_of(node);
        if times.len() > 1 {
            self.sink.unexpected(node, "a condition at one time");
        }
        let mut parts = Vec::new();
        self.timed_conditions(node, None, &mut parts);
        let when = parts.first()?.when.clone();
        Some(TimedCondition { when, condition: all_conditions(parts, node) })
    }

    /// Reads the conditions at times in `node`, all or those of `only`, without the preferences.
    pub(super) fn timed_conditions(
        &mut self,
        node: Node<'_>,
        only: Option<&TimeSpecifier>,
        into: &mut Vec<TimedCondition>,
    ) {
        let Some(head) = node.head() else {
            if !node.is_list() {
                self.sink.unexpected(node, "a condition such as `(at start (p ?x))`");
            }
            return;
        };
        if head.is("and") {
            for part in node.children().skip(1) {
                self.timed_conditions(part, only, into);
            }
        } else if head.is("forall") {
            self.forall_conditions(node, only, into);
        } else if !self.is_preference(node) {
            match timed(node, self.outcomes()) {
                Timed::At(TimeSpecifier::Outcome(name), _) => {
                    let kind = DiagnosticKind::OutcomeInCondition { name: name.as_str().to_owned() };
                    self.sink.report(node.span(), kind);
                }
                Timed::At(when, what) => {
                    if wanted(&when, only) && !self.is_soft(what) {
                        let condition = self.hard_condition(what);
                        into.push(TimedCondition { when, condition });
                    }
                }
                Timed::Unknown(when) => self.unknown_time(when),
                Timed::Untimed => {
                    self.sink.unexpected(node, "`(at start …)`, `(over all …)` or `(at end …)`");
                }
            }
        }
    }

    fn forall_conditions(
        &mut self,
        node: Node<'_>,
        only: Option<&TimeSpecifier>,
        into: &mut Vec<TimedCondition>,
    ) {
        let times = self.times_of(node);
        if times.is_empty() && !self.is_soft(node) {
            self.sink.unexpected(node, "`(at start …)`, `(over all …)` or `(at end …)`");
        }
        for when in times.into_iter().filter(|t| wanted(t, only)) {
            let Some((bound, inner)) = self.quantifier(node) else { return };
            let mut parts = Vec::new();
            self.timed_conditions(inner, Some(&when), &mut parts);
            self.schema.unbind(bound.len());
            let inner = all_conditions(parts, inner);
            let kind = ConditionKind::Forall(bound, Box::new(inner));
            into.push(TimedCondition { when, condition: Condition { kind, span: node.span() } });
        }
    }

    /// Reads the effects at times in `node`, all or those of `only`.
    pub(super) fn timed_effects(
        &mut self,
        node: Node<'_>,
        only: Option<&TimeSpecifier>,
        into: &mut Vec<TimedEffect>,
    ) {
        let Some(head) = node.head() else {
            if !node.is_list() {
                self.sink.unexpected(node, "an effect such as `(at end (p ?x))`");
            }
            return;
        };
        if head.is("and") {
            for part in node.children().skip(1) {
                self.timed_effects(part, only, into);
            }
        } else if head.is("forall") {
            self.forall_effects(node, only, into);
        } else if head.is("when") {
            self.conditional_effects(node, only, into);
        } else {
            match timed(node, self.outcomes()) {
                Timed::At(TimeSpecifier::OverAll, _) | Timed::Untimed => self.untimed_effect(node),
                Timed::At(when, what) => {
                    if wanted(&when, only) {
                        let effect = self.effect(what);
                        into.push(TimedEffect { when, effect });
                    }
                }
                Timed::Unknown(when) => self.unknown_time(when),
            }
        }
    }

    fn forall_effects(&mut self, node: Node<'_>, only: Option<&TimeSpecifier>, into: &mut Vec<TimedEffect>) {
        let times = self.times_of(node);
        if times.is_empty() {
            self.untimed_effect(node);
        }
        for when in times.into_iter().filter(|t| wanted(t, only)) {
            let Some((bound, inner)) = self.quantifier(node) else { return };
            let mut parts = Vec::new();
            self.timed_effects(inner, Some(&when), &mut parts);
            self.schema.unbind(bound.len());
            let inner = all_effects(parts, inner);
            let kind = EffectKind::Forall(bound, Box::new(inner));
            into.push(TimedEffect { when, effect: Effect { kind, span: node.span() } });
        }
    }

    /// `(when (at start c) (at start e))` is `(at start (when c e))`; other times have no model.
    fn conditional_effects(
        &mut self,
        node: Node<'_>,
        only: Option<&TimeSpecifier>,
        into: &mut Vec<TimedEffect>,
    ) {
        let Some([condition, effect]) = self.parts(node, "`(when CONDITION EFFECT)`") else { return };
        for found in self.preferences_in(condition) {
            self.misplaced_preference(found.node);
        }
        let condition_times = self.times_of(condition);
        let times = self.times_of(effect);
        if times.is_empty() {
            self.untimed_effect(effect);
        }
        for when in times.into_iter().filter(|t| wanted(t, only)) {
            if condition_times.iter().any(|t| *t != when) {
                self.sink.unsupported(node.span(), UnsupportedFeature::ConditionsAcrossTimes);
                continue;
            }
            let mut parts = Vec::new();
            self.timed_conditions(condition, Some(&when), &mut parts);
            let guard = all_conditions(parts, condition);
            let mut effects = Vec::new();
            self.timed_effects(effect, Some(&when), &mut effects);
            let kind = EffectKind::When(guard, Box::new(all_effects(effects, effect)));
            into.push(TimedEffect { when, effect: Effect { kind, span: node.span() } });
        }
    }

    /// Without a time there are only continuous effects.
    fn untimed_effect(&mut self, node: Node<'_>) {
        if super::effect::assign_operator(node.head().unwrap_or(node)).is_some() && holds(node, "#t") {
            self.sink.unsupported(node.span(), UnsupportedFeature::ContinuousEffects);
        } else {
            self.sink.unexpected(node, "`(at start …)` or `(at end …)`");
        }
    }

    fn unknown_time(&mut self, when: Node<'_>) {
        self.sink.report(when.span(), DiagnosticKind::UnknownTime { name: when.text().to_owned() });
    }
}

fn holds(node: Node<'_>, word: &str) -> bool {
    node.is(word) || node.children().any(|n| holds(n, word))
}

fn all_conditions(mut parts: Vec<TimedCondition>, node: Node<'_>) -> Condition {
    match parts.pop() {
        Some(only) if parts.is_empty() => only.condition,
        last => {
            let all = parts.into_iter().chain(last).map(|p| p.condition).collect();
            Condition { kind: ConditionKind::And(all), span: node.span() }
        }
    }
}

fn all_effects(mut parts: Vec<TimedEffect>, node: Node<'_>) -> Effect {
    match parts.pop() {
        Some(only) if parts.is_empty() => only.effect,
        last => {
            let all = parts.into_iter().chain(last).map(|p| p.effect).collect();
            Effect { kind: EffectKind::And(all), span: node.span() }
        }
    }
}
