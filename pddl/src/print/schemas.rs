//! Actions, durative actions, axioms.

use std::fmt::Write as _;

use super::Printer;
use crate::model::{
    Action, Axiom, ContinuousEffect, DerivedFunction, DerivedValue, Direction, DurativeAction, Event, Given,
    Process, Rule, TimeSpecifier, TimedCondition, TimedEffect, Variables,
};

impl<'m> Printer<'m> {
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

    pub(super) fn derived_function(&mut self, function: &DerivedFunction) {
        let v = &function.variables;
        self.push("\n  (:derived (");
        self.push(&self.domain.functions[function.function].name);
        for slot in v.parameter_ids() {
            self.push(" ");
            self.variable(v, slot);
        }
        self.push(")\n    ");
        match &function.value {
            DerivedValue::Expression(value) => self.expression(v, value),
            DerivedValue::Count(slots, condition) => {
                self.push("(count ");
                self.bound(v, slots.iter().copied());
                self.push(" ");
                self.condition(v, condition);
                self.push(")");
            }
        }
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

    pub(super) fn durative_action(&mut self, action: &'m DurativeAction) {
        let v = &action.variables;
        let _ = write!(self.out, "\n  (:durative-action {}", action.name);
        self.parameters(v);
        if let Some(rule) = &action.rule {
            self.rule(v, rule);
        }
        self.push("\n    :duration ");
        self.list("(and", &action.duration, |p, constraint| {
            let at_end = constraint.when == TimeSpecifier::End;
            p.push(if at_end { "(at end " } else { "" });
            let _ = write!(p.out, "({} ?duration ", constraint.comparison.symbol());
            p.functions = &constraint.functions;
            p.expression(v, &constraint.bound);
            p.functions = &[];
            p.push(if at_end { "))" } else { ")" });
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
        self.push("(and");
        for timed in &action.effects {
            self.push("\n      ");
            self.timed_effect(v, timed);
        }
        for effect in &action.continuous {
            self.push("\n      ");
            self.continuous(v, effect);
        }
        self.push(")");
        self.push(")");
    }

    fn timed_effect(&mut self, v: &Variables, timed: &TimedEffect) {
        for given in &timed.given {
            match given {
                Given::Forall(slots) => {
                    self.push("(forall ");
                    self.bound(v, slots.iter().copied());
                }
                Given::When(conditions) => {
                    self.push("(when ");
                    self.list("(and", conditions, |p, condition| p.timed(v, condition));
                }
            }
            self.push(" ");
        }
        self.time(&timed.when);
        self.effect(v, &timed.effect);
        self.push(")");
        timed.given.iter().for_each(|_| self.push(")"));
    }

    /// `(forall (?x …) (increase (f ?x) (* #t rate)))`
    fn continuous(&mut self, v: &Variables, effect: &'m ContinuousEffect) {
        if !effect.forall.is_empty() {
            self.push("(forall ");
            self.bound(v, effect.forall.iter().copied());
            self.push(" ");
        }
        self.push(match effect.direction {
            Direction::Increase => "(increase ",
            Direction::Decrease => "(decrease ",
        });
        self.functions = &effect.functions;
        self.application(v, &effect.fluent);
        self.push(" (* #t ");
        self.expression(v, &effect.rate);
        self.functions = &[];
        self.push(if effect.forall.is_empty() { "))" } else { ")))" });
    }

    pub(super) fn process(&mut self, process: &'m Process) {
        let v = &process.variables;
        let _ = write!(self.out, "\n  (:process {}", process.name);
        self.parameters(v);
        self.push("\n    :precondition ");
        self.condition(v, &process.precondition);
        self.push("\n    :effect (and");
        for effect in &process.effects {
            self.push("\n      ");
            self.continuous(v, effect);
        }
        self.push("))");
    }

    pub(super) fn event(&mut self, event: &Event) {
        let v = &event.variables;
        let _ = write!(self.out, "\n  (:event {}", event.name);
        self.parameters(v);
        self.push("\n    :precondition ");
        self.condition(v, &event.precondition);
        self.push("\n    :effect ");
        self.effect(v, &event.effect);
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
