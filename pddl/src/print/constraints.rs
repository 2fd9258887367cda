//! Preferences and constraints.
//!
//! A condition is printed before its preferences, in one conjunction, so that reading it gives the slots the
//! same numbers.

use std::fmt::Write as _;

use super::Printer;
use crate::Decimal;
use crate::model::{Condition, Constraint, ConstraintKind, Constraints, Preference, VariableId, Variables};

impl Printer<'_> {
    /// A condition, with its preferences if there are any.
    pub(super) fn soft(
        &mut self,
        v: &Variables,
        condition: &Condition,
        preferences: &[Preference<Condition>],
    ) {
        if preferences.is_empty() {
            return self.condition(v, condition);
        }
        self.push("(and ");
        self.condition(v, condition);
        for preference in preferences {
            self.push("\n      ");
            self.preference(v, preference, |p, c| p.condition(v, c));
        }
        self.push(")");
    }

    /// `(forall (?x …) (preference name body))`
    pub(super) fn preference<T>(
        &mut self,
        v: &Variables,
        preference: &Preference<T>,
        body: impl FnOnce(&mut Self, &T),
    ) {
        if !preference.forall.is_empty() {
            self.push("(forall ");
            self.bound(v, preference.forall.iter().copied());
            self.push(" ");
        }
        self.push("(preference ");
        if let Some(name) = &preference.name {
            self.push(name);
            self.push(" ");
        }
        body(self, &preference.body);
        self.push(if preference.forall.is_empty() { ")" } else { "))" });
    }

    pub(super) fn constraint_section(&mut self, constraints: &Constraints) {
        if constraints.is_empty() {
            return;
        }
        let v = &constraints.variables;
        self.push("\n  (:constraints (and");
        for constraint in &constraints.hard {
            self.push("\n    ");
            self.constraint(v, constraint);
        }
        for preference in &constraints.preferences {
            self.push("\n    ");
            self.preference(v, preference, |p, c| p.constraint(v, c));
        }
        self.push("))");
    }

    pub(super) fn constraint(&mut self, v: &Variables, constraint: &Constraint) {
        use ConstraintKind as Kind;
        match &constraint.kind {
            Kind::Holds(condition) => self.condition(v, condition),
            Kind::And(parts) => self.list("(and", parts, |p, c| p.constraint(v, c)),
            Kind::Or(parts) => self.list("(or", parts, |p, c| p.constraint(v, c)),
            Kind::Not(inner) => self.modal("not", &[], v, &[inner]),
            Kind::Imply(a, b) => self.modal("imply", &[], v, &[a, b]),
            Kind::Exists(slots, inner) => self.quantified_constraint("(exists ", v, slots, inner),
            Kind::Forall(slots, inner) => self.quantified_constraint("(forall ", v, slots, inner),
            Kind::AtEnd(c) => self.modal("at end", &[], v, &[c]),
            Kind::Always(c) => self.modal("always", &[], v, &[c]),
            Kind::Sometime(c) => self.modal("sometime", &[], v, &[c]),
            Kind::Within(time, c) => self.modal("within", &[*time], v, &[c]),
            Kind::AtMostOnce(c) => self.modal("at-most-once", &[], v, &[c]),
            Kind::SometimeAfter(a, b) => self.modal("sometime-after", &[], v, &[a, b]),
            Kind::SometimeBefore(a, b) => self.modal("sometime-before", &[], v, &[a, b]),
            Kind::AlwaysWithin(time, a, b) => self.modal("always-within", &[*time], v, &[a, b]),
            Kind::HoldDuring(from, to, c) => self.modal("hold-during", &[*from, *to], v, &[c]),
            Kind::HoldAfter(time, c) => self.modal("hold-after", &[*time], v, &[c]),
        }
    }

    fn modal(&mut self, operator: &str, times: &[Decimal], v: &Variables, operands: &[&Constraint]) {
        let _ = write!(self.out, "({operator}");
        for time in times {
            let _ = write!(self.out, " {time}");
        }
        for operand in operands {
            self.push(" ");
            self.constraint(v, operand);
        }
        self.push(")");
    }

    fn quantified_constraint(&mut self, open: &str, v: &Variables, slots: &[VariableId], inner: &Constraint) {
        self.push(open);
        self.bound(v, slots.iter().copied());
        self.push(" ");
        self.constraint(v, inner);
        self.push(")");
    }
}
