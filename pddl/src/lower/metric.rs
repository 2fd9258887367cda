//! `(:metric minimize EXPRESSION)`.

use super::body::Body;
use crate::Severity;
use crate::model::{Metric, Objective};
use crate::syntax::Node;

impl Body<'_> {
    /// Reads a metric; one with parts that no model holds is left out.
    pub(crate) fn metric(&mut self, section: Node<'_>) -> Option<Metric> {
        let [objective, expression] = self.parts(section, "`(:metric minimize EXPRESSION)`")?;
        let objective = if objective.is("minimize") {
            Some(Objective::Minimize)
        } else if objective.is("maximize") {
            Some(Objective::Maximize)
        } else {
            self.sink.unexpected(objective, "`minimize` or `maximize`");
            None
        };
        let before = self.sink.count();
        let expression = self.expression(expression)?;
        if self.sink.since(before).iter().any(|d| d.severity == Severity::Unsupported) {
            return None;
        }
        Some(Metric { objective: objective?, expression })
    }
}
