//! Which parts of the language a model uses beyond what every planner knows.
//!
//! Problem: who reads a model must not pass over a part that it does not look at, such as a hard
//! constraint. Idea: each such part is a [`Feature`] that a domain or problem can be asked for, so
//! that a consumer names what it refuses, and a part that comes to the language is refused
//! everywhere until somebody takes it. Cost: one walk over the schemas; facts are not looked at.

use super::{Domain, ExpressionKind, Problem};
use crate::Span;

/// A part of the language that a consumer may have to refuse by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Feature {
    /// `(preference …)`, wherever it stands.
    Preferences,
    /// `(:constraints …)` of a domain or problem, preferences aside.
    TrajectoryConstraints,
    /// `(at 5 (p))` in `:init`.
    TimedInitials,
}

impl std::fmt::Display for Feature {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Preferences => "preferences",
            Self::TrajectoryConstraints => "trajectory constraints",
            Self::TimedInitials => "timed initial literals and fluents",
        })
    }
}

impl Domain {
    /// Each feature that the domain uses, once, with the first place.
    pub fn features(&self) -> Vec<(Feature, Span)> {
        let mut uses = Uses::default();
        for action in &self.actions {
            uses.first(Feature::Preferences, action.preferences.iter().map(|p| p.span));
        }
        for action in &self.durative_actions {
            uses.first(Feature::Preferences, action.preferences.iter().map(|p| p.span));
        }
        uses.constraints(&self.constraints);
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

    fn constraints(&mut self, constraints: &super::Constraints) {
        self.first(Feature::TrajectoryConstraints, constraints.hard.iter().map(|c| c.span));
        self.first(Feature::Preferences, constraints.preferences.iter().map(|p| p.span));
    }
}
