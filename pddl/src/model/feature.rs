//! Which parts of the language a model uses beyond what every planner knows.
//!
//! Problem: code that reads a model must not ignore a part that it does not implement, such as a hard
//! constraint. Idea: each such part is a [`Feature`], and a domain or problem lists those that it uses. A
//! consumer names the features that it refuses, and a new feature is refused everywhere until a consumer
//! accepts it. Cost: one walk over the schemas; facts are not visited.

use super::{
    Condition, ConditionKind, Domain, DurativeAction, Effect, EffectKind, ExpressionKind, Problem,
    TaskNetwork, TimeSpecifier,
};
use crate::Span;

/// A part of the language that a consumer may have to refuse by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Feature {
    /// `(preference …)`, wherever it stands.
    Preferences,
    /// `(:constraints …)` of a domain or problem, preferences aside.
    TrajectoryConstraints,
    /// `(:invariant …)`
    Invariants,
    /// `(at 5 (p))` in `:init`.
    TimedInitials,
    /// `(:process …)`
    Processes,
    /// `(:event …)`
    Events,
    /// `#t` in a durative action.
    ContinuousEffects,
    /// `(when (at start c) (at end e))`
    ConditionsAcrossTimes,
    /// `(at end (<= ?duration …))`
    DurationAtEnd,
    /// `(:derived (f ?x) (g ?x))` of a function.
    DerivedFunctions,
    /// `(truck ?x)`, `(sortof ?x - truck)`
    TypePredicates,
    /// `:constraints` of a method or of a problem's task network.
    NetworkConstraints,
}

impl std::fmt::Display for Feature {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Preferences => "preferences",
            Self::TrajectoryConstraints => "trajectory constraints",
            Self::Invariants => "invariants",
            Self::TimedInitials => "timed initial literals and fluents",
            Self::Processes => "processes",
            Self::Events => "events",
            Self::ContinuousEffects => "continuous effects (`#t`)",
            Self::ConditionsAcrossTimes => "conditional effects across times",
            Self::DurationAtEnd => "duration constraints at the end",
            Self::DerivedFunctions => "derived functions",
            Self::TypePredicates => "types as predicates",
            Self::NetworkConstraints => "constraints of task networks",
        })
    }
}

impl Domain {
    /// Each feature that the domain uses, once, with the first place.
    pub fn features(&self) -> Vec<(Feature, Span)> {
        let mut uses = Uses::default();
        for action in &self.actions {
            uses.first(Feature::Preferences, action.preferences.iter().map(|p| p.span));
            uses.condition(&action.precondition);
            action.preferences.iter().for_each(|p| uses.condition(&p.body));
            uses.effect(&action.effect);
        }
        for action in &self.durative_actions {
            uses.durative(action);
        }
        uses.first(Feature::Processes, self.processes.iter().map(|p| p.name_span));
        self.processes.iter().for_each(|p| uses.condition(&p.precondition));
        uses.first(Feature::Events, self.events.iter().map(|e| e.name_span));
        for event in &self.events {
            uses.condition(&event.precondition);
            uses.effect(&event.effect);
        }
        self.axioms.iter().for_each(|axiom| uses.condition(&axiom.body));
        uses.first(Feature::DerivedFunctions, self.derived_functions.iter().map(|f| f.span));
        for method in &self.methods {
            uses.condition(&method.precondition);
            uses.network(&method.network);
        }
        uses.constraints(&self.constraints);
        uses.first(Feature::Invariants, self.invariants.iter().map(|i| i.name_span));
        uses.0
    }
}

impl Problem {
    /// Each feature that the problem itself uses, once, with the first place.
    pub fn features(&self) -> Vec<(Feature, Span)> {
        let mut uses = Uses::default();
        uses.first(Feature::TimedInitials, self.timed.iter().map(|t| t.span));
        uses.first(Feature::Preferences, self.preferences.iter().map(|p| p.span));
        uses.constraints(&self.constraints);
        uses.condition(&self.goal);
        self.preferences.iter().for_each(|p| uses.condition(&p.body));
        if let Some((_, network)) = &self.htn {
            uses.network(network);
        }
        if let Some(metric) = &self.metric {
            metric.expression.each(&mut |e| {
                if matches!(e.kind, ExpressionKind::IsViolated(_)) {
                    uses.first(Feature::Preferences, [e.span]);
                }
            });
        }
        uses.0
    }
}

#[derive(Default)]
struct Uses(Vec<(Feature, Span)>);

impl Uses {
    fn first(&mut self, feature: Feature, places: impl IntoIterator<Item = Span>) {
        if let Some(place) = places.into_iter().next()
            && !self.0.iter().any(|(f, _)| *f == feature)
        {
            self.0.push((feature, place));
        }
    }

    fn durative(&mut self, action: &DurativeAction) {
        self.first(Feature::Preferences, action.preferences.iter().map(|p| p.span));
        action.conditions.iter().for_each(|c| self.condition(&c.condition));
        action.preferences.iter().for_each(|p| self.condition(&p.body.condition));
        for effect in &action.effects {
            if !effect.given.is_empty() {
                self.first(Feature::ConditionsAcrossTimes, [effect.effect.span]);
            }
            self.effect(&effect.effect);
        }
        let at_end = action.duration.iter().filter(|d| d.when == TimeSpecifier::End);
        self.first(Feature::DurationAtEnd, at_end.map(|d| d.span));
        self.first(Feature::ContinuousEffects, action.continuous.iter().map(|c| c.span));
    }

    fn constraints(&mut self, constraints: &super::Constraints) {
        self.first(Feature::TrajectoryConstraints, constraints.hard.iter().map(|c| c.span));
        self.first(Feature::Preferences, constraints.preferences.iter().map(|p| p.span));
    }

    fn network(&mut self, network: &TaskNetwork) {
        self.first(Feature::NetworkConstraints, network.constraints.iter().map(|c| c.span));
    }

    fn condition(&mut self, condition: &Condition) {
        condition.each(&mut |part| {
            if matches!(part.kind, ConditionKind::HasType(..)) {
                self.first(Feature::TypePredicates, [part.span]);
            }
        });
    }

    fn effect(&mut self, effect: &Effect) {
        effect.each(&mut |part| {
            if let EffectKind::When(condition, _) = &part.kind {
                self.condition(condition);
            }
        });
    }
}
