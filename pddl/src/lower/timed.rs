//! Conditions and effects at times: `(at start …)`, `(over all …)`, `(at end …)`, `(at OUTCOME …)`.
//!
//! Traps: a predicate may be called `at` (`(at start (at ?x ?y))`), and a `forall` may stand around several
//! times. A time is recognised by its form, `at` with a name and a list, since no argument of an atom is a
//! list. A `forall` around several times is read once for each time, so that every timed part has its own
//! quantified slots.

use super::body::Body;
use crate::diagnostic::DiagnosticKind;
use crate::model::{
    Condition, ConditionKind, Effect, EffectKind, Given, Name, Preference, Requirement, TimeSpecifier,
    TimedCondition, TimedEffect,
};
use crate::syntax::Node;

/// What the form of a list says about time.
pub(super) enum Timed<'t> {
    /// A time and the part at that time.
    At(TimeSpecifier, Node<'t>),
    /// The form of a time with an unknown name.
    Unknown(Node<'t>),
    /// Not the form of a time.
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

/// Whether a part at `time` belongs to this reading.
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

    /// The times of the effects in `node` whose conditions are all at the same time, each once, in order.
    fn effect_times(&self, node: Node<'_>) -> Vec<TimeSpecifier> {
        if let Timed::At(time, _) = timed(node, self.outcomes()) {
            return vec![time];
        }
        if node.is_headed("when") {
            let Some(effect) = node.children().nth(2) else { return Vec::new() };
            let conditions = node.children().nth(1).map(|c| self.times_of(c)).unwrap_or_default();
            let mut times = self.effect_times(effect);
            times.retain(|time| conditions.iter().all(|condition| condition == time));
            return times;
        }
        let mut times: Vec<TimeSpecifier> = Vec::new();
        for part in node.children().skip(1) {
            for time in self.effect_times(part) {
                if !times.contains(&time) {
                    times.push(time);
                }
            }
        }
        times
    }

    /// Reads the effects in `node` that have a condition at another time.
    pub(super) fn effects_across_times(&mut self, node: Node<'_>, into: &mut Vec<TimedEffect>) {
        let mut found = Vec::new();
        self.find_across_times(node, &mut Vec::new(), &mut found);
        for (around, when, what) in found {
            let (mut given, mut bound) = (Vec::new(), 0);
            for node in around {
                if node.is_headed("forall") {
                    let Some((slots, _)) = self.quantifier(node) else { continue };
                    bound += slots.len();
                    given.push(Given::Forall(slots));
                } else if let Some(condition) = node.children().nth(1) {
                    let mut parts = Vec::new();
                    self.timed_conditions(condition, None, &mut parts);
                    given.push(Given::When(parts));
                }
            }
            let effect = self.effect(what);
            self.schema.unbind(bound);
            into.push(TimedEffect { when, when_span: node.span(), given, effect });
        }
    }

    /// Effects with the `forall` and `when` lists around them, if a condition is at another time.
    fn find_across_times<'t>(
        &self,
        node: Node<'t>,
        around: &mut Vec<Node<'t>>,
        into: &mut Vec<(Vec<Node<'t>>, TimeSpecifier, Node<'t>)>,
    ) {
        if let Timed::At(time, what) = timed(node, self.outcomes()) {
            let conditions =
                around.iter().filter(|n| n.is_headed("when")).filter_map(|n| n.children().nth(1));
            if conditions.flat_map(|c| self.times_of(c)).any(|other| other != time) {
                into.push((around.clone(), time, what));
            }
        } else if node.is_headed("and") {
            for part in node.children().skip(1) {
                self.find_across_times(part, around, into);
            }
        } else if (node.is_headed("forall") || node.is_headed("when"))
            && let Some(inner) = node.children().nth(2)
        {
            around.push(node);
            self.find_across_times(inner, around, into);
            around.pop();
        }
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

    /// The body of a preference; its time stands in it or around it.
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
                        let when_span = node.children().nth(1).unwrap_or(node).span();
                        into.push(TimedEffect { when, when_span, given: Vec::new(), effect });
                    }
                }
                Timed::Unknown(when) => self.unknown_time(when),
            }
        }
    }

    fn forall_effects(&mut self, node: Node<'_>, only: Option<&TimeSpecifier>, into: &mut Vec<TimedEffect>) {
        if let (true, Some(body)) = (self.times_of(node).is_empty(), node.children().nth(2)) {
            self.timed_effects(body, only, into);
        }
        for when in self.effect_times(node).into_iter().filter(|t| wanted(t, only)) {
            let Some((bound, inner)) = self.quantifier(node) else { return };
            let mut parts = Vec::new();
            self.timed_effects(inner, Some(&when), &mut parts);
            self.schema.unbind(bound.len());
            let inner = all_effects(parts, inner);
            let kind = EffectKind::Forall(bound, Box::new(inner));
            let effect = Effect { kind, span: node.span() };
            into.push(TimedEffect { when, when_span: node.span(), given: Vec::new(), effect });
        }
    }

    /// `(when (at start c) (at start e))` is `(at start (when c e))`; `when` with several times is read by
    /// `effects_across_times`.
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
        if self.times_of(effect).is_empty() {
            self.sink.unexpected(effect, "`(at start …)` or `(at end …)`");
        }
        for when in self.effect_times(node).into_iter().filter(|t| wanted(t, only)) {
            let mut parts = Vec::new();
            self.timed_conditions(condition, Some(&when), &mut parts);
            let guard = all_conditions(parts, condition);
            let mut effects = Vec::new();
            self.timed_effects(effect, Some(&when), &mut effects);
            let kind = EffectKind::When(guard, Box::new(all_effects(effects, effect)));
            let effect = Effect { kind, span: node.span() };
            into.push(TimedEffect { when, when_span: node.span(), given: Vec::new(), effect });
        }
    }

    /// An effect without a time must be continuous; those are read elsewhere.
    fn untimed_effect(&mut self, node: Node<'_>) {
        if !self.is_continuous(node) {
            self.sink.unexpected(node, "`(at start …)` or `(at end …)`");
        }
    }

    fn unknown_time(&mut self, when: Node<'_>) {
        self.sink.report(when.span(), DiagnosticKind::UnknownTime { name: when.text().to_owned() });
    }
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
