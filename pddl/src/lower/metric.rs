//! `(:metric minimize EXPRESSION)`.

use super::body::Body;
use super::schema::Owner;
use crate::diagnostic::{DiagnosticKind, SymbolKind};
use crate::model::{Constraints, Domain, ExpressionKind, Metric, Name, Objective, Preference};
use crate::syntax::Node;

/// The names of the domain's preferences.
pub(super) fn preference_names(domain: &Domain) -> Vec<Name> {
    let mut all = Vec::new();
    domain.actions.iter().for_each(|action| names(&action.preferences, &mut all));
    domain.durative_actions.iter().for_each(|action| names(&action.preferences, &mut all));
    constraint_names(&domain.constraints, &mut all);
    all
}

pub(super) fn names<T>(preferences: &[Preference<T>], into: &mut Vec<Name>) {
    into.extend(preferences.iter().filter_map(|preference| preference.name.clone()));
}

pub(super) fn constraint_names(constraints: &Constraints, into: &mut Vec<Name>) {
    names(&constraints.preferences, into);
}

impl Body<'_> {
    /// Reads a metric; `preferences` are the names that `is-violated` may use.
    pub(crate) fn metric(&mut self, section: Node<'_>, preferences: &[Name]) -> Option<Metric> {
        let [objective, expression] = self.parts(section, "`(:metric minimize EXPRESSION)`")?;
        let objective = if objective.is("minimize") {
            Some(Objective::Minimize)
        } else if objective.is("maximize") {
            Some(Objective::Maximize)
        } else {
            self.sink.unexpected(objective, "`minimize` or `maximize`");
            None
        };
        self.schema.owner = Owner::Metric;
        let expression = self.expression(expression)?;
        expression.each(&mut |part| {
            if let ExpressionKind::IsViolated(name) = &part.kind
                && !preferences.contains(name)
            {
                let suggestion = self.sink.suggest(name, preferences.iter().map(Name::as_str));
                let (symbol, name) = (SymbolKind::Preference, name.as_str().to_owned());
                self.sink.report(part.span, DiagnosticKind::Unknown { symbol, name, suggestion });
            }
        });
        Some(Metric { objective: objective?, expression })
    }
}
