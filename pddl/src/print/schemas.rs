//! Actions, durative actions, axioms.

use std::fmt::Write as _;

use super::Printer;
use super::body::comparison;
use crate::model::{Action, Axiom, DurativeAction, Rule, TimeSpecifier, TimedCondition, Variables};

impl Printer<'_> {
    pub(super) fn parameters(&mut self, v: &Variables) {
        self.push("\n    :parameters ");
        self.bound(v, v.parameter_ids());
    }

    pub(super) fn action(&mut self, action: &Action) {
        let v = &action.variables;
        let _ = write!(self.out, "\n  (:action {}", action.name);
        self.parameters(v);
        self.push("\n    :precondition ");
        self.soft(v, &action.precondition, &action.preferences);
        self.push("\n    :effect ");
        self.effect(v, &action.effect);
        self.push(")");
    }

    pub(super) fn axiom(&mut self, axiom: &Axiom) {
        let v = &axiom.variables;
        self.push("\n  (:derived (");
        self.push(&self.domain.predicates[axiom.predicate].name);
        for slot in v.parameter_ids() {
            self.push(" ");
            self.variable(v, slot);
        }
        self.push(")\n    ");
        self.condition(v, &axiom.body);
        self.push(")");
    }

    fn time(&mut self, when: &TimeSpecifier) {
        match when {
            TimeSpecifier::Start => self.push("(at start "),
            TimeSpecifier::OverAll => self.push("(over all "),
            TimeSpecifier::End => self.push("(at end "),
            TimeSpecifier::Outcome(name) => {
                let _ = write!(self.out, "(at {name} ");
            }
        }
    }

    fn timed(&mut self, v: &Variables, timed: &TimedCondition) {
        self.time(&timed.when);
        self.condition(v, &timed.condition);
        self.push(")");
    }

    pub(super) fn durative_action(&mut self, action: &DurativeAction) {
        let v = &action.variables;
        let _ = write!(self.out, "\n  (:durative-action {}", action.name);
        self.parameters(v);
        if let Some(rule) = &action.rule {
            self.rule(v, rule);
        }
        self.push("\n    :duration ");
        self.list("(and", &action.duration, |p, constraint| {
            let _ = write!(p.out, "({} ?duration ", comparison(constraint.comparison));
            p.expression(v, &constraint.bound);
            p.push(")");
        });
        self.push("\n    :condition ");
        self.push("(and");
        for timed in &action.conditions {
            self.push("\n      ");
            self.timed(v, timed);
        }
        for preference in &action.preferences {
            self.push("\n      ");
            self.preference(v, preference, |p, timed| p.timed(v, timed));
        }
        self.push(")");
        self.push("\n    :effect ");
        self.lines("(and", &action.effects, |p, timed| {
            p.time(&timed.when);
            p.effect(v, &timed.effect);
            p.push(")");
        });
        self.push(")");
    }

    fn rule(&mut self, v: &Variables, rule: &Rule) {
        if !rule.results.is_empty() {
            self.push("\n    :results ");
            self.bound(v, rule.results.iter().copied());
        }
        if let Some(skill) = &rule.skill {
            self.push("\n    :skill ");
            self.applied(v, &skill.name, &skill.arguments);
        }
        if !rule.claims.is_empty() {
            self.push("\n    :claims ");
            self.list("(", &rule.claims, |p, &claim| p.term(v, claim));
        }
        let _ = write!(self.out, "\n    :priority {}", rule.priority);
    }
}
