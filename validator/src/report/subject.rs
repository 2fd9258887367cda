//! A plan and its task with their texts, for names and places in reports.

use super::finding::Place;
use super::names::{show_application, show_atom, show_list, show_object, show_step};
use crate::value::GroundAtom;
use crate::verdict::File;
use pddl::model::{Domain, GroundApplication, Name, ObjectId, Problem};
use pddl::{HierarchicalPlan, Plan, PlanNode, Source};

/// A plan and its task, with their texts.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'a> {
    /// The domain.
    pub domain: &'a Domain,
    /// The problem.
    pub problem: &'a Problem,
    /// The plan.
    pub plan: &'a Plan,
    /// The text of the domain.
    pub domain_text: &'a Source,
    /// The text of the problem.
    pub problem_text: &'a Source,
    /// The text of the plan.
    pub plan_text: &'a Source,
}

impl<'a> Subject<'a> {
    /// The text of a file.
    pub fn text(&self, file: File) -> &'a Source {
        match file {
            File::Domain => self.domain_text,
            File::Problem => self.problem_text,
            File::Plan => self.plan_text,
        }
    }

    pub(super) fn slice(&self, place: Place) -> &'a str {
        self.text(place.file).text().get(place.span.range()).unwrap_or_default()
    }

    pub(super) fn atom(&self, atom: &GroundAtom) -> String {
        show_atom(self.domain, self.problem, atom)
    }

    pub(super) fn fluent(&self, fluent: &GroundApplication) -> String {
        show_application(self.domain, self.problem, fluent)
    }

    pub(super) fn object(&self, object: ObjectId) -> String {
        show_object(self.problem, object)
    }

    /// The plan, if it has a decomposition.
    pub(super) fn hierarchical(&self) -> Option<&'a HierarchicalPlan> {
        match self.plan {
            Plan::Hierarchical(plan) => Some(plan),
            Plan::Sequential(_) | Plan::Temporal(_) => None,
        }
    }

    /// An action or task of a decomposition: `(go a b)`.
    pub(super) fn node(&self, plan: &HierarchicalPlan, node: PlanNode) -> String {
        match node {
            PlanNode::Step(step) => plan
                .steps
                .get(step)
                .map_or_else(String::new, |step| show_step(self.domain, self.problem, &step.step)),
            PlanNode::Decomposition(task) => plan.decompositions.get(task).map_or_else(String::new, |task| {
                let unknown = Name::new("?");
                let name = self.domain.tasks.get(task.task).map_or(&unknown, |task| &task.name);
                show_list(name, &task.arguments, self.problem)
            }),
        }
    }
}
