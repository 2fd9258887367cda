//! Conditions, effects, expressions.

use std::fmt::Write as _;

use super::Printer;
use crate::model::{
    Application, AssignOperator, AssignedValue, Atom, Comparison, Condition, ConditionKind, Effect,
    EffectKind, Expression, ExpressionKind, Term, TypeId, TypeSet, VariableId, Variables,
};

/// Words that have another meaning in front of a list than a type of that name.
const RESERVED: &[&str] = &[
    "and",
    "or",
    "not",
    "imply",
    "forall",
    "exists",
    "preference",
    "always",
    "sometime",
    "within",
    "at-most-once",
    "sometime-after",
    "sometime-before",
    "always-within",
    "hold-during",
    "hold-after",
];

impl<'m> Printer<'m> {
    pub(super) fn term(&mut self, v: &Variables, term: Term) {
        match term {
            Term::Variable(id) if self.functions.iter().any(|f| f.slot == id) => {
                let functions = self.functions;
                functions.iter().filter(|f| f.slot == id).for_each(|f| self.application(v, &f.application));
            }
            Term::Variable(id) => {
                self.push("?");
                self.push(&v[id].name);
            }
            Term::Object(id) => {
                let objects = self.objects;
                self.push(&objects[id].name);
            }
        }
    }

    pub(super) fn applied(&mut self, v: &Variables, name: &str, arguments: &[Term]) {
        self.push("(");
        self.push(name);
        for &argument in arguments {
            self.push(" ");
            self.term(v, argument);
        }
        self.push(")");
    }

    fn atom(&mut self, v: &Variables, atom: &Atom) {
        let domain = self.domain;
        self.applied(v, &domain.predicates[atom.predicate].name, &atom.arguments);
    }

    pub(super) fn application(&mut self, v: &Variables, of: &Application) {
        let domain = self.domain;
        self.applied(v, &domain.functions[of.function].name, &of.arguments);
    }

    pub(super) fn types(&mut self, types: &[TypeId]) {
        let table = &self.domain.types;
        match types {
            [one] => self.push(&table[*one].name),
            many => self.list("(either", many, |p, &t| p.push(&table[t].name)),
        }
    }

    /// `(?x - t …)`
    pub(super) fn bound(&mut self, v: &Variables, slots: impl IntoIterator<Item = VariableId>) {
        self.list("(", slots, |p, slot| p.variable(v, slot));
    }

    /// `?x - t`
    pub(super) fn variable(&mut self, v: &Variables, slot: VariableId) {
        let _ = write!(self.out, "?{} - ", v[slot].name);
        self.types(&v[slot].types.0);
    }

    pub(super) fn condition(&mut self, v: &Variables, condition: &Condition) {
        match &condition.kind {
            ConditionKind::And(parts) => self.list("(and", parts, |p, c| p.condition(v, c)),
            ConditionKind::Or(parts) => self.list("(or", parts, |p, c| p.condition(v, c)),
            ConditionKind::Not(inner) => self.list("(not", [inner], |p, c| p.condition(v, c)),
            ConditionKind::Imply(a, b) => self.list("(imply", [a, b], |p, c| p.condition(v, c)),
            ConditionKind::Exists(slots, inner) => self.quantified("(exists ", v, slots, inner),
            ConditionKind::Forall(slots, inner) => self.quantified("(forall ", v, slots, inner),
            ConditionKind::Atom(atom) => self.atom(v, atom),
            ConditionKind::HasType(term, types) => self.has_type(v, *term, types),
            ConditionKind::Same(a, b) => self.applied(v, "=", &[*a, *b]),
            ConditionKind::Compare(c, a, b) => self.compare(v, *c, a, b),
            ConditionKind::FluentIs(fluent, value) => {
                self.push("(= ");
                self.application(v, fluent);
                self.push(" ");
                self.term(v, *value);
                self.push(")");
            }
        }
    }

    /// As a predicate, where that is read as a test of the type.
    fn has_type(&mut self, v: &Variables, term: Term, types: &TypeSet) {
        let domain = self.domain;
        if let [one] = types.0.as_slice()
            && let name = &domain.types[*one].name
            && domain.predicate(name).is_none()
            && !RESERVED.contains(&name.as_str())
        {
            return self.applied(v, name, &[term]);
        }
        self.push("(sortof ");
        self.term(v, term);
        self.push(" - ");
        self.types(&types.0);
        self.push(")");
    }

    fn quantified(&mut self, open: &str, v: &Variables, slots: &[VariableId], inner: &Condition) {
        self.push(open);
        self.bound(v, slots.iter().copied());
        self.push(" ");
        self.condition(v, inner);
        self.push(")");
    }

    fn compare(&mut self, v: &Variables, operator: Comparison, a: &Expression, b: &Expression) {
        self.push("(");
        self.list(operator.symbol(), [a, b], |p, e| p.expression(v, e));
    }

    pub(super) fn expression(&mut self, v: &Variables, expression: &Expression) {
        match &expression.kind {
            ExpressionKind::Number(number) => {
                let _ = write!(self.out, "{number}");
            }
            ExpressionKind::Fluent(fluent) => self.application(v, fluent),
            ExpressionKind::Arithmetic(operator, operands) => {
                let open = format!("({}", operator.symbol());
                self.list(&open, operands, |p, e| p.expression(v, e));
            }
            ExpressionKind::Duration => self.push("?duration"),
            ExpressionKind::TotalTime => self.push("(total-time)"),
            ExpressionKind::IsViolated(name) => {
                let _ = write!(self.out, "(is-violated {name})");
            }
        }
    }

    pub(super) fn effect(&mut self, v: &Variables, effect: &Effect) {
        match &effect.kind {
            EffectKind::And(parts) => self.list("(and", parts, |p, e| p.effect(v, e)),
            EffectKind::Add(atom) => self.atom(v, atom),
            EffectKind::Delete(atom) => self.list("(not", [atom], |p, a| p.atom(v, a)),
            EffectKind::Assign(operator, fluent, value) => self.assignment(v, *operator, fluent, value),
            EffectKind::Forall(slots, inner) => {
                self.push("(forall ");
                self.bound(v, slots.iter().copied());
                self.push(" ");
                self.effect(v, inner);
                self.push(")");
            }
            EffectKind::When(condition, inner) => {
                self.push("(when ");
                self.condition(v, condition);
                self.push(" ");
                self.effect(v, inner);
                self.push(")");
            }
        }
    }

    fn assignment(
        &mut self,
        v: &Variables,
        operator: AssignOperator,
        fluent: &Application,
        value: &AssignedValue,
    ) {
        self.push(match operator {
            AssignOperator::Assign => "(assign ",
            AssignOperator::Increase => "(increase ",
            AssignOperator::Decrease => "(decrease ",
            AssignOperator::ScaleUp => "(scale-up ",
            AssignOperator::ScaleDown => "(scale-down ",
        });
        self.application(v, fluent);
        self.push(" ");
        match value {
            AssignedValue::Number(number) => self.expression(v, number),
            AssignedValue::Object(term) => self.term(v, *term),
            AssignedValue::Undefined => self.push("undefined"),
        }
        self.push(")");
    }
}
