//! What task networks have to say as JSON: what is wrong with a decomposition, and one that was found.
//!
//! ```json
//! {"kind": "ordering", "of": {"what": "task", "id": 10, "text": "(lit-up l)", "place": {}}, "method": "light-there",
//!  "before": {"what": "task", "id": 11, "text": "(come b)", "place": {}},
//!  "after": {"what": "action", "id": 1, "text": "(light l b)", "place": {}}}
//! ```
//!
//! `kind` says which of the other fields there are. A node has the number that the plan gives it.

use super::failure::{CauseRecord, Places};
use crate::render::PlaceRecord;
use pddl::model::{Domain, Name, ObjectId, Problem};
use pddl::{DecompositionId, HierarchicalPlan, Plan, PlanNode, PlanReference, Span};
use serde::Serialize;
use validator::{Cause, File, NetworkFault, Parent, Place, Shortfall, show_object, show_step};

/// What is wrong with a decomposition.
#[derive(Default, Serialize)]
pub(super) struct NetworkRecord {
    kind: &'static str,
    /// Whose subtasks it is about.
    #[serde(skip_serializing_if = "Option::is_none")]
    of: Option<NodeRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    node: Option<NodeRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    method: Option<String>,
    /// Where the plan names the method.
    #[serde(skip_serializing_if = "Option::is_none")]
    method_place: Option<PlaceRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    object: Option<String>,
    /// Which argument, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    argument: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    before: Option<NodeRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    after: Option<NodeRecord>,
    /// How many steps were taken where a precondition was needed.
    #[serde(skip_serializing_if = "Option::is_none")]
    after_steps: Option<u32>,
    /// How many steps some decomposition begins with.
    #[serde(skip_serializing_if = "Option::is_none")]
    explained: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    step: Option<CauseRecord>,
    /// Subtasks of the network that the plan lacks.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    missing: Vec<PlaceRecord>,
    /// Subtasks of the plan that the network lacks.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    surplus: Vec<NodeRecord>,
    /// Where the plan uses the node.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    used: Vec<PlaceRecord>,
}

/// An action or task of a plan, or its root.
#[derive(Serialize)]
struct NodeRecord {
    what: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    id: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    text: Option<String>,
    place: PlaceRecord,
}

impl Places<'_> {
    /// What is wrong with a decomposition, with all that belongs to it.
    pub(super) fn network(&self, fault: &NetworkFault) -> NetworkRecord {
        let mut record = NetworkRecord::default();
        let node = |id: DecompositionId| Some(self.node(PlanNode::Decomposition(id)));
        match fault {
            NetworkFault::NoNetwork => {
                record.kind = "no network";
                record.of = Some(self.parent(Parent::Root));
            }
            NetworkFault::Unknown { task } => {
                record.kind = "unknown";
                record.node = node(*task);
            }
            NetworkFault::Arguments { task, .. } => {
                record.kind = "arguments";
                record.node = node(*task);
            }
            NetworkFault::Cycle { task, span } => {
                record.kind = "cycle";
                record.node = node(*task);
                record.used = vec![self.in_plan(*span)];
            }
            NetworkFault::Shared { node, first, second } => {
                record.kind = "shared";
                record.node = Some(self.node(*node));
                record.used = vec![self.in_plan(*first), self.in_plan(*second)];
            }
            NetworkFault::Orphan { node } => {
                record.kind = "orphan";
                record.node = Some(self.node(*node));
            }
            NetworkFault::Method { task } => {
                record.kind = "method";
                record.node = node(*task);
                self.add_method(*task, &mut record);
            }
            NetworkFault::MethodArguments { task, object, position } => {
                record.kind = "method arguments";
                record.node = node(*task);
                record.object = Some(self.object(*object));
                record.argument = Some(position + 1);
                self.add_method(*task, &mut record);
            }
            NetworkFault::Subtasks { of, missing, surplus } => {
                record.kind = "subtasks";
                self.add_parent(*of, &mut record);
                let place = |&span: &Span| self.place(Place { file: network_file(*of), span });
                record.missing = missing.iter().map(place).collect();
                record.surplus = surplus.iter().map(|reference| self.reference(*reference)).collect();
            }
            NetworkFault::Constraints { of, .. } => {
                record.kind = "constraints";
                self.add_parent(*of, &mut record);
            }
            NetworkFault::Ordering { of, before, after } => {
                record.kind = "ordering";
                self.add_parent(*of, &mut record);
                record.before = Some(self.node(before.node));
                record.after = Some(self.node(after.node));
            }
            NetworkFault::Precondition { task, after, .. } => {
                record.kind = "precondition";
                record.node = node(*task);
                record.after_steps = Some(*after);
                self.add_method(*task, &mut record);
            }
            NetworkFault::NoDecomposition { shortfall } => {
                record.kind = "no decomposition";
                match shortfall {
                    Shortfall::Subtasks(spans) => {
                        let place = |&span: &Span| self.place(Place { file: File::Problem, span });
                        record.missing = spans.iter().map(place).collect();
                    }
                    Shortfall::Step(step) => record.step = Some(self.cause(Cause::Step(*step))),
                    Shortfall::Explained(explained) => record.explained = Some(*explained),
                }
            }
        }
        record
    }

    fn in_plan(&self, span: Span) -> PlaceRecord {
        self.place(Place { file: File::Plan, span })
    }

    fn hierarchical(&self) -> Option<&HierarchicalPlan> {
        match self.plan {
            Plan::Hierarchical(plan) => Some(plan),
            Plan::Sequential(_) | Plan::Temporal(_) => None,
        }
    }

    fn parent(&self, of: Parent) -> NodeRecord {
        let span = self.hierarchical().map_or_else(Span::default, |plan| plan.root_span);
        match of {
            Parent::Root => NodeRecord { what: "root", id: None, text: None, place: self.in_plan(span) },
            Parent::Task(task) => self.node(PlanNode::Decomposition(task)),
        }
    }

    fn add_parent(&self, of: Parent, record: &mut NetworkRecord) {
        record.of = Some(self.parent(of));
        if let Parent::Task(task) = of {
            self.add_method(task, record);
        }
    }

    fn add_method(&self, task: DecompositionId, record: &mut NetworkRecord) {
        let decomposition = self.hierarchical().and_then(|plan| plan.decompositions.get(task));
        let method = decomposition.and_then(|task| self.task.domain.methods.get(task.method));
        record.method = method.map(|method| method.name.to_string());
        record.method_place = decomposition.map(|task| self.in_plan(task.method_span));
    }

    fn node(&self, node: PlanNode) -> NodeRecord {
        let text =
            self.hierarchical().map(|plan| show_node(&self.task.domain, &self.task.problem, plan, node));
        let (what, id, span) = match (node, self.hierarchical()) {
            (PlanNode::Step(step), Some(plan)) => {
                let step = plan.steps.get(step);
                ("action", step.map(|step| step.label.0), step.map(|step| step.step.span))
            }
            (PlanNode::Decomposition(task), Some(plan)) => {
                let task = plan.decompositions.get(task);
                ("task", task.map(|task| task.label.0), task.map(|task| task.span))
            }
            (PlanNode::Step(_), None) => ("action", None, None),
            (PlanNode::Decomposition(_), None) => ("task", None, None),
        };
        NodeRecord { what, id, text, place: self.in_plan(span.unwrap_or_default()) }
    }

    /// A node where it is used.
    fn reference(&self, reference: PlanReference) -> NodeRecord {
        NodeRecord { place: self.in_plan(reference.span), ..self.node(reference.node) }
    }
}

const fn network_file(of: Parent) -> File {
    match of {
        Parent::Root => File::Problem,
        Parent::Task(_) => File::Domain,
    }
}

/// `(go a b)`, of an action or a task.
pub(super) fn show_node(
    domain: &Domain,
    problem: &Problem,
    plan: &HierarchicalPlan,
    node: PlanNode,
) -> String {
    match node {
        PlanNode::Step(step) => {
            plan.steps.get(step).map_or_else(String::new, |step| show_step(domain, problem, &step.step))
        }
        PlanNode::Decomposition(task) => plan.decompositions.get(task).map_or_else(String::new, |task| {
            show_list(problem, domain.tasks.get(task.task).map(|task| &task.name), &task.arguments)
        }),
    }
}

fn show_list(problem: &Problem, name: Option<&Name>, arguments: &[ObjectId]) -> String {
    let mut text = format!("({}", name.map_or("?", |name| name.as_str()));
    for &argument in arguments {
        text.push(' ');
        text += &show_object(problem, argument);
    }
    text + ")"
}

/// A decomposition: which numbers the root became, and each task. Actions have the numbers from 0, in their order.
#[derive(Serialize)]
pub(super) struct DecompositionRecord {
    root: Vec<u64>,
    tasks: Vec<TaskRecord>,
}

#[derive(Serialize)]
struct TaskRecord {
    id: u64,
    task: String,
    method: Option<String>,
    subtasks: Vec<u64>,
}

impl DecompositionRecord {
    pub(super) fn of(domain: &Domain, problem: &Problem, plan: &HierarchicalPlan) -> Self {
        let label = |reference: &PlanReference| match reference.node {
            PlanNode::Step(step) => plan.steps.get(step).map(|step| step.label.0),
            PlanNode::Decomposition(task) => plan.decompositions.get(task).map(|task| task.label.0),
        };
        let labels = |references: &[PlanReference]| references.iter().filter_map(label).collect();
        let tasks = plan.decompositions.enumerate().map(|(id, task)| TaskRecord {
            id: task.label.0,
            task: show_node(domain, problem, plan, PlanNode::Decomposition(id)),
            method: domain.methods.get(task.method).map(|method| method.name.to_string()),
            subtasks: labels(&task.subtasks),
        });
        Self { root: labels(&plan.roots), tasks: tasks.collect() }
    }
}
