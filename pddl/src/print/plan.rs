//! Plans: a step a line.

use std::fmt::Write as _;

use crate::model::{Domain, Name, ObjectId, Problem};
use crate::{
    ClaimedCost, HierarchicalPlan, Plan, PlanNode, PlanReference, SequentialPlan, StepHead, TemporalPlan,
};

/// The text of a plan: a step a line.
pub fn print_plan(plan: &Plan, domain: &Domain, problem: &Problem) -> String {
    let mut printer = PlanPrinter { text: String::new(), domain, problem };
    match plan {
        Plan::Sequential(plan) => printer.sequential(plan),
        Plan::Temporal(plan) => printer.temporal(plan),
        Plan::Hierarchical(plan) => printer.hierarchical(plan),
    }
    printer.text
}

struct PlanPrinter<'m> {
    text: String,
    domain: &'m Domain,
    problem: &'m Problem,
}

impl PlanPrinter<'_> {
    fn write(&mut self, text: std::fmt::Arguments<'_>) {
        self.text.write_fmt(text).expect("a string takes all");
    }

    fn words(&mut self, name: &Name, arguments: &[ObjectId]) {
        self.text.push_str(name);
        for &argument in arguments {
            self.write(format_args!(" {}", self.problem.objects[argument].name));
        }
    }

    fn step(&mut self, head: StepHead, arguments: &[ObjectId]) {
        let domain = self.domain;
        let name = match head {
            StepHead::Action(id) => &domain.actions[id].name,
            StepHead::DurativeAction(id) => &domain.durative_actions[id].name,
        };
        self.text.push('(');
        self.words(name, arguments);
        self.text.push(')');
    }

    fn cost(&mut self, cost: Option<ClaimedCost>) {
        if let Some(cost) = cost {
            self.write(format_args!("; cost = {}\n", cost.value));
        }
    }

    fn sequential(&mut self, plan: &SequentialPlan) {
        for step in &plan.steps {
            self.step(StepHead::Action(step.action), &step.arguments);
            self.text.push('\n');
        }
        self.cost(plan.cost);
    }

    fn temporal(&mut self, plan: &TemporalPlan) {
        // A point marks the number as a time, also in a domain without durations.
        let whole = plan.steps.iter().all(|s| s.start.scale() == 0 && s.duration.is_none());
        for step in &plan.steps {
            self.write(format_args!("{}{}: ", step.start, if whole { ".0" } else { "" }));
            self.step(step.head, &step.arguments);
            if let Some(duration) = step.duration {
                self.write(format_args!(" [{duration}]"));
            }
            self.text.push('\n');
        }
        self.cost(plan.cost);
    }

    fn hierarchical(&mut self, plan: &HierarchicalPlan) {
        let domain = self.domain;
        self.text.push_str("==>\n");
        for step in &plan.steps {
            self.write(format_args!("{} ", step.label));
            self.words(&domain.actions[step.step.action].name, &step.step.arguments);
            self.text.push('\n');
        }
        self.text.push_str("root");
        self.references(plan, &plan.roots);
        for task in &plan.decompositions {
            self.write(format_args!("\n{} ", task.label));
            self.words(&domain.tasks[task.task].name, &task.arguments);
            self.write(format_args!(" -> {}", domain.methods[task.method].name));
            self.references(plan, &task.subtasks);
        }
        self.text.push_str("\n<==\n");
    }

    fn references(&mut self, plan: &HierarchicalPlan, references: &[PlanReference]) {
        for reference in references {
            let label = match reference.node {
                PlanNode::Step(id) => plan.steps[id].label,
                PlanNode::Decomposition(id) => plan.decompositions[id].label,
            };
            self.write(format_args!(" {label}"));
        }
    }
}
