//! Task networks as JSON: the fault of a decomposition, and a decomposition that was found.
//!
//! ```json
//! {"kind": "ordering", "of": {"what": "task", "id": 10, "text": "(lit-up l)", "place": {}}, "method": "light-there",
//!  "before": {"what": "task", "id": 11, "text": "(come b)", "place": {}},
//!  "after": {"what": "action", "id": 1, "text": "(light l b)", "place": {}}}
//! ```
//!
//! `kind` determines the other fields. A node has its number in the plan.

use super::cause::{CauseRecord, cause_record};
use super::place::{PlaceRecord, place_record};
use crate::cause::Cause;
use crate::report::finding::Place;
use crate::report::subject::Subject;
use crate::verdict::{File, NetworkFault, Parent, Shortfall};
use pddl::{DecompositionId, PlanNode, PlanReference, Span};
use serde::Serialize;

/// The fault of a decomposition.
#[derive(Default, Serialize)]
pub(super) struct NetworkRecord {
    kind: &'static str,
    /// The node with the faulty subtasks.
    #[serde(skip_serializing_if = "Option::is_none")]
    of: Option<NodeRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    node: Option<NodeRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    method: Option<String>,
    /// The place where the plan names the method.
    #[serde(skip_serializing_if = "Option::is_none")]
    method_place: Option<PlaceRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    object: Option<String>,
    /// The position of the argument, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    argument: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    before: Option<NodeRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    after: Option<NodeRecord>,
    /// The number of steps before the state in which a precondition was needed.
    #[serde(skip_serializing_if = "Option::is_none")]
    after_steps: Option<u32>,
    /// The number of leading steps that some decomposition explains.
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
    /// The places where the plan uses the node.
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

/// The complete record of a fault.
pub(super) fn network_record(subject: &Subject<'_>, fault: &NetworkFault) -> NetworkRecord {
    let mut record = NetworkRecord::default();
    let task_node = |id: DecompositionId| Some(node_record(subject, PlanNode::Decomposition(id)));
    match fault {
        NetworkFault::NoNetwork => {
            record.kind = "no_network";
            record.of = Some(parent_record(subject, Parent::Root));
        }
        NetworkFault::Unknown { task } => {
            record.kind = "unknown";
            record.node = task_node(*task);
        }
        NetworkFault::Arguments { task, .. } => {
            record.kind = "arguments";
            record.node = task_node(*task);
        }
        NetworkFault::Cycle { task, span } => {
            record.kind = "cycle";
            record.node = task_node(*task);
            record.used = vec![in_plan(subject, *span)];
        }
        NetworkFault::Shared { node, first, second } => {
            record.kind = "shared";
            record.node = Some(node_record(subject, *node));
            record.used = vec![in_plan(subject, *first), in_plan(subject, *second)];
        }
        NetworkFault::Orphan { node } => {
            record.kind = "orphan";
            record.node = Some(node_record(subject, *node));
        }
        NetworkFault::Method { task } => {
            record.kind = "method";
            record.node = task_node(*task);
            add_method(subject, *task, &mut record);
        }
        NetworkFault::MethodArguments { task, object, position } => {
            record.kind = "method_arguments";
            record.node = task_node(*task);
            record.object = Some(subject.object(*object));
            record.argument = Some(position + 1);
            add_method(subject, *task, &mut record);
        }
        NetworkFault::Subtasks { of, missing, surplus } => {
            record.kind = "subtasks";
            add_parent(subject, *of, &mut record);
            let place = |&span: &Span| place_record(subject, Place { file: network_file(*of), span });
            record.missing = missing.iter().map(place).collect();
            record.surplus = surplus.iter().map(|reference| reference_record(subject, *reference)).collect();
        }
        NetworkFault::Constraints { of, .. } => {
            record.kind = "constraints";
            add_parent(subject, *of, &mut record);
        }
        NetworkFault::Ordering { of, before, after } => {
            record.kind = "ordering";
            add_parent(subject, *of, &mut record);
            record.before = Some(node_record(subject, before.node));
            record.after = Some(node_record(subject, after.node));
        }
        NetworkFault::Precondition { task, after, .. } => {
            record.kind = "precondition";
            record.node = task_node(*task);
            record.after_steps = Some(*after);
            add_method(subject, *task, &mut record);
        }
        NetworkFault::NoDecomposition { shortfall } => {
            record.kind = "no_decomposition";
            match shortfall {
                Shortfall::Subtasks(spans) => {
                    let place = |&span: &Span| place_record(subject, Place { file: File::Problem, span });
                    record.missing = spans.iter().map(place).collect();
                }
                Shortfall::Step(step) => record.step = Some(cause_record(subject, Cause::Step(*step))),
                Shortfall::Explained(explained) => record.explained = Some(*explained),
            }
        }
    }
    record
}

fn in_plan(subject: &Subject<'_>, span: Span) -> PlaceRecord {
    place_record(subject, Place { file: File::Plan, span })
}

fn parent_record(subject: &Subject<'_>, of: Parent) -> NodeRecord {
    let span = subject.hierarchical().map_or_else(Span::default, |plan| plan.root_span);
    match of {
        Parent::Root => NodeRecord { what: "root", id: None, text: None, place: in_plan(subject, span) },
        Parent::Task(task) => node_record(subject, PlanNode::Decomposition(task)),
    }
}

fn add_parent(subject: &Subject<'_>, of: Parent, record: &mut NetworkRecord) {
    record.of = Some(parent_record(subject, of));
    if let Parent::Task(task) = of {
        add_method(subject, task, record);
    }
}

fn add_method(subject: &Subject<'_>, task: DecompositionId, record: &mut NetworkRecord) {
    let decomposition = subject.hierarchical().and_then(|plan| plan.decompositions.get(task));
    let method = decomposition.and_then(|task| subject.domain.methods.get(task.method));
    record.method = method.map(|method| method.name.to_string());
    record.method_place = decomposition.map(|task| in_plan(subject, task.method_span));
}

fn node_record(subject: &Subject<'_>, node: PlanNode) -> NodeRecord {
    let text = subject.hierarchical().map(|plan| subject.node(plan, node));
    let (what, id, span) = match (node, subject.hierarchical()) {
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
    NodeRecord { what, id, text, place: in_plan(subject, span.unwrap_or_default()) }
}

/// A node at the place where it is used.
fn reference_record(subject: &Subject<'_>, reference: PlanReference) -> NodeRecord {
    NodeRecord { place: in_plan(subject, reference.span), ..node_record(subject, reference.node) }
}

const fn network_file(of: Parent) -> File {
    match of {
        Parent::Root => File::Problem,
        Parent::Task(_) => File::Domain,
    }
}
