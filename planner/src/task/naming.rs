//! Names of a task's parts in PDDL syntax, for plans and reports.

use super::fact::{GroundAtom, ObjectValue};
use super::grounded::Task;
use super::operator::Operator;
use crate::ids::{FactId, OperatorId};
use analysis::Pattern;
use pddl::model::{ActionId, GroundApplication, Name, ObjectId};

impl Task {
    /// The operator as a line of a plan file, `(move a b)`.
    pub fn operator_name(&self, operator: OperatorId) -> String {
        let Operator { action, arguments, .. } = self.operator(operator);
        self.names.list(&self.names.actions[action.0 as usize], arguments)
    }

    /// A fluent in PDDL syntax, `(fuel a)`.
    pub fn fluent_name(&self, fluent: &GroundApplication) -> String {
        self.names.fluent(fluent)
    }

    /// A pattern in PDDL syntax, `(road ?from b)`.
    pub fn pattern_name(&self, pattern: &Pattern) -> String {
        self.names.open(&self.names.predicates[pattern.predicate], &pattern.arguments)
    }

    /// An action with open arguments, `(go ?from b)`.
    pub fn schema_name(&self, action: ActionId, arguments: &[Result<ObjectId, Name>]) -> String {
        self.names.open(&self.names.actions[action.0 as usize], arguments)
    }

    /// A ground atom in PDDL syntax.
    pub fn atom_name(&self, atom: &GroundAtom) -> String {
        self.names.list(&self.names.predicates[atom.predicate], &atom.arguments)
    }

    /// A fact in PDDL syntax; an auxiliary fact of grounding is `(auxiliary-N)`.
    pub fn fact_name(&self, fact: FactId) -> String {
        match (&self.facts[fact].atom, &self.facts[fact].value) {
            (Some(atom), _) => self.atom_name(atom),
            (None, Some(ObjectValue { fluent, object })) => {
                format!("(= {} {})", self.names.fluent(fluent), self.names.objects[*object])
            }
            (None, None) if self.facts[fact].compares => {
                let own = self.numeric.comparisons.iter().find(|c| c.fact == fact);
                own.map_or_else(String::new, |c| self.comparison_name(c.relation, &c.expression))
            }
            (None, None) => format!("(auxiliary-{})", fact.0),
        }
    }
}
