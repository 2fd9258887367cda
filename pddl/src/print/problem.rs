//! The sections of a problem in the usual order.

use std::fmt::Write as _;

use super::Printer;
use crate::model::{FluentFact, FluentValue, ObjectId, Objective, Problem, TimedChange, Variables};

impl Printer<'_> {
    pub(super) fn problem(&mut self, problem: &Problem) {
        let domain = self.domain;
        let _ = write!(self.out, "(define (problem {})\n  (:domain {})", problem.name, domain.name);
        self.requirements(&problem.requirements);
        // A constant is repeated if the problem gives it further types.
        let own = problem
            .objects
            .enumerate()
            .filter(|(id, object)| domain.constants.get(*id).is_none_or(|c| c.types != object.types));
        self.object_section("\n  (:objects\n    ", own.map(|(_, object)| object));
        if let Some((v, network)) = &problem.htn {
            self.push("\n  (:htn");
            self.parameters(v);
            self.network(v, network);
            self.push(")");
        }
        self.init(problem);
        self.push("\n  (:goal ");
        self.soft(&problem.goal_variables, &problem.goal, &problem.preferences);
        self.push(")");
        self.constraint_section(&problem.constraints);
        if let Some(metric) = &problem.metric {
            self.push(match metric.objective {
                Objective::Minimize => "\n  (:metric minimize ",
                Objective::Maximize => "\n  (:metric maximize ",
            });
            self.expression(&Variables::default(), &metric.expression);
            self.push(")");
        }
        self.push(")\n");
    }

    fn init(&mut self, problem: &Problem) {
        let domain = self.domain;
        self.push("\n  (:init");
        for fact in &problem.init {
            self.push("\n    ");
            self.ground(&domain.predicates[fact.predicate].name, &fact.arguments);
        }
        for fluent in &problem.fluents {
            self.push("\n    ");
            self.fluent(fluent);
        }
        for timed in &problem.timed {
            let _ = write!(self.out, "\n    (at {} ", timed.time);
            match &timed.change {
                TimedChange::Add(fact) => {
                    self.ground(&domain.predicates[fact.predicate].name, &fact.arguments);
                }
                TimedChange::Delete(fact) => {
                    self.push("(not ");
                    self.ground(&domain.predicates[fact.predicate].name, &fact.arguments);
                    self.push(")");
                }
                TimedChange::Assign(fluent) => self.fluent(fluent),
                TimedChange::Undefine(application) => {
                    self.push("(= ");
                    self.ground(&domain.functions[application.function].name, &application.arguments);
                    self.push(" undefined)");
                }
            }
            self.push(")");
        }
        self.push(")");
    }

    fn fluent(&mut self, fluent: &FluentFact) {
        let (domain, objects) = (self.domain, self.objects);
        self.push("(= ");
        self.ground(&domain.functions[fluent.application.function].name, &fluent.application.arguments);
        match fluent.value {
            FluentValue::Number(number) => {
                let _ = write!(self.out, " {number})");
            }
            FluentValue::Object(object) => {
                let _ = write!(self.out, " {})", objects[object].name);
            }
        }
    }

    pub(super) fn ground(&mut self, name: &str, arguments: &[ObjectId]) {
        self.push("(");
        self.push(name);
        for &argument in arguments {
            self.push(" ");
            self.push(&self.objects[argument].name);
        }
        self.push(")");
    }
}
