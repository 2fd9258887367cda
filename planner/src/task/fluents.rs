//! The public view of fluents: values in a state, names of comparisons.

use super::{ObjectValue, State, Task};
use crate::ids::FluentId;
use crate::number::{Expression, Number, Operator, Relation};
use pddl::model::{GroundApplication, Idx};

impl Task {
    /// The numeric fluents of states, with their values in this state.
    pub fn numbers<'t>(
        &'t self,
        state: &'t State,
    ) -> impl Iterator<Item = (&'t GroundApplication, Option<Number>)> {
        let fluents = self.numeric.fluents[..self.numeric.stored].iter().enumerate();
        fluents.map(|(i, fluent)| {
            (&fluent.application, self.numeric.value(state.words(), FluentId::from_index(i)))
        })
    }

    /// The object fluents that change and have a value in a state.
    pub fn object_values<'t>(&'t self, state: &'t State) -> impl Iterator<Item = &'t ObjectValue> {
        let values = self.facts.enumerate().filter(|(id, _)| state.contains(*id));
        values.filter_map(|(_, fact)| fact.value.as_ref())
    }

    /// Whether states represent the value of this object fluent.
    pub fn is_object_fluent(&self, fluent: &GroundApplication) -> bool {
        let mut values = self.facts.iter().filter_map(|fact| fact.value.as_ref());
        values.any(|value| value.fluent == *fluent)
    }

    /// The state with other values of numeric fluents. Ignores fluents that are not in
    /// [`numbers`](Self::numbers). A value that does not fit is recorded as missing. Comparisons
    /// and derived facts are evaluated again.
    pub fn with_numbers<'v>(
        &self,
        state: &State,
        values: impl IntoIterator<Item = (&'v GroundApplication, Option<Number>)>,
    ) -> State {
        let mut next = state.clone();
        for (application, value) in values {
            let stored = &self.numeric.fluents[..self.numeric.stored];
            if let Some(i) = stored.iter().position(|f| f.application == *application) {
                let fit = self.numeric.set(next.words_mut(), FluentId::from_index(i), value);
                next.note_fit(fit);
            }
        }
        let fit = self.numeric.compare_all(next.words_mut());
        next.note_fit(fit);
        self.axioms.close(next.words_mut());
        next
    }

    /// `(>= (fuel a) 3)`.
    pub(super) fn comparison_name(&self, relation: Relation, expression: &Expression<FluentId>) -> String {
        let Expression::Linear(linear) = expression else {
            return compared(relation, &self.expression_name(expression), "0", false);
        };
        // The terms are on the left and the constant is on the right; if all coefficients are
        // negative, the signs are reversed.
        let turned = linear.terms.iter().all(|(_, c)| c.sign() <= 0);
        let sign = |number: Number| if turned { number.negated().unwrap_or(number) } else { number };
        let terms: Vec<String> = linear.terms.iter().map(|(f, c)| self.term_name(*f, sign(*c))).collect();
        let left = match terms.as_slice() {
            [one] => one.clone(),
            all => format!("(+ {})", all.join(" ")),
        };
        let right = if turned { Some(linear.constant) } else { linear.constant.negated() };
        compared(relation, &left, &right.unwrap_or(linear.constant).to_string(), turned)
    }

    fn term_name(&self, fluent: FluentId, coefficient: Number) -> String {
        let name = self.fluent_name(&self.numeric.fluents[fluent.index()].application);
        if coefficient == Number::ONE { name } else { format!("(* {coefficient} {name})") }
    }

    fn expression_name(&self, expression: &Expression<FluentId>) -> String {
        let (head, parts): (&str, Vec<String>) = match expression {
            Expression::Linear(linear) => {
                let terms = linear.terms.iter().map(|(f, c)| self.term_name(*f, *c));
                let constant = Some(linear.constant).filter(|c| !c.is_zero() || linear.terms.is_empty());
                ("+", terms.chain(constant.map(|c| c.to_string())).collect())
            }
            Expression::Tree(operator, parts) => {
                let head = match operator {
                    Operator::Add => "+",
                    Operator::Multiply => "*",
                    Operator::Divide => "/",
                };
                (head, parts.iter().map(|part| self.expression_name(part)).collect())
            }
        };
        match parts.as_slice() {
            [one] => one.clone(),
            all => format!("({head} {})", all.join(" ")),
        }
    }
}

fn compared(relation: Relation, left: &str, right: &str, turned: bool) -> String {
    match (relation, turned) {
        (Relation::Positive, false) => format!("(> {left} {right})"),
        (Relation::Positive, true) => format!("(< {left} {right})"),
        (Relation::NonNegative, false) => format!("(>= {left} {right})"),
        (Relation::NonNegative, true) => format!("(<= {left} {right})"),
        (Relation::Zero, _) => format!("(= {left} {right})"),
        (Relation::NonZero, _) => format!("(not (= {left} {right}))"),
        (Relation::Defined, _) => format!("(= {left} {left})"),
    }
}
