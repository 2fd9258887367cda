//! The sections of a domain in the usual order.

use std::fmt::Write as _;

use super::Printer;

impl<'m> Printer<'m> {
    pub(super) fn domain(&mut self) {
        let domain = self.domain;
        let _ = write!(self.out, "(define (domain {})", domain.name);
        self.requirements(&domain.requirements);
        if !domain.imports.is_empty() {
            self.names("\n  (:import", &domain.imports);
        }
        self.type_section();
        self.object_section("\n  (:constants\n    ", domain.constants.iter());
        self.predicate_section();
        self.function_sections();
        self.permission_sections();
        if !domain.timeless.is_empty() {
            self.push("\n  (:timeless");
            for fact in &domain.timeless {
                self.push("\n    ");
                self.ground(&domain.predicates[fact.predicate].name, &fact.arguments);
            }
            self.push(")");
        }
        self.constraint_section(&domain.constraints);
        for invariant in &domain.invariants {
            self.invariant(invariant);
        }
        for axiom in &domain.axioms {
            self.axiom(axiom);
        }
        for function in &domain.derived_functions {
            self.derived_function(function);
        }
        for action in &domain.actions {
            self.action(action);
        }
        for action in &domain.durative_actions {
            self.durative_action(action);
        }
        for process in &domain.processes {
            self.process(process);
        }
        for event in &domain.events {
            self.event(event);
        }
        for task in &domain.tasks {
            self.task(task);
        }
        for method in &domain.methods {
            self.method(method);
        }
        self.push(")\n");
    }

    pub(super) fn requirements(&mut self, requirements: &crate::model::Requirements) {
        if !requirements.0.is_empty() {
            self.list("\n  (:requirements", &requirements.0, |p, r| p.push(r.as_str()));
        }
    }
}
