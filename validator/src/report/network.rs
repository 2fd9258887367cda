//! Faults of decompositions, in words.

use super::finding::{Finding, Place};
use super::names::{show_list, show_step};
use super::words::Words;
use crate::plan::{PlanRef, StepIndex};
use crate::verdict::{File, NetworkFault, Parent, Shortfall};
use pddl::model::Name;
use pddl::{DecompositionId, HierarchicalPlan, PlanNode, Span};

/// The fault of a decomposition, or the reason why none exists.
pub(super) fn network_fault(words: &Words<'_>, fault: &NetworkFault) -> Finding {
    match words.plan {
        PlanRef::Hierarchical(plan) => Decomposed { words, plan }.fault(fault),
        PlanRef::Sequential(_) | PlanRef::Temporal(_) => no_decomposition(words, fault),
    }
}

fn no_decomposition(words: &Words<'_>, fault: &NetworkFault) -> Finding {
    let network = Place { file: File::Problem, span: network_span(words) };
    let NetworkFault::NoDecomposition { shortfall } = fault else {
        let sentence = "the task network cannot become these steps".to_owned();
        return Finding { sentence, place: network, notes: Vec::new() };
    };
    let steps = words.plan.steps();
    match shortfall {
        Shortfall::Subtasks(spans) => {
            let sentence = match steps {
                0 => "no decomposition of the task network is empty, and the plan is",
                _ => "no decomposition of the task network yields these steps, in whatever order",
            };
            let note = |&span: &Span| {
                let what = "no way to carry this out with these steps alone".to_owned();
                (Place { file: File::Problem, span }, what)
            };
            // If several fail only together, no single one has a note.
            let notes = if spans.len() == 1 { spans.iter().map(note).collect() } else { Vec::new() };
            let place = spans.first().map_or(network, |&span| Place { file: File::Problem, span });
            Finding { sentence: sentence.to_owned(), place, notes }
        }
        Shortfall::Step(step) => {
            let sentence = format!(
                "nothing that the task network can become has step {}, beside the others",
                step.number()
            );
            Finding { sentence, place: words.step_place(*step), notes: Vec::new() }
        }
        Shortfall::Explained(explained) => {
            let sentence = "no decomposition of the task network yields these steps".to_owned();
            if *explained as usize >= steps {
                let notes = vec![(network, "it needs more steps than these".to_owned())];
                return Finding { sentence, place: network, notes };
            }
            let place = words.step_place(StepIndex(*explained));
            let what = match explained {
                0 => "no way was found to begin with this and come to the rest".to_owned(),
                _ => "it can begin with the steps before this one, but no way was found from this one to the rest"
                    .to_owned(),
            };
            Finding { sentence, place, notes: vec![(place, what)] }
        }
    }
}

fn network_span(words: &Words<'_>) -> Span {
    let subtask = words.problem.htn.as_ref().and_then(|(_, network)| network.subtasks.first());
    subtask.map_or(words.problem.goal_span, |subtask| subtask.span)
}

struct Decomposed<'w, 'a> {
    words: &'w Words<'a>,
    plan: &'w HierarchicalPlan,
}

const fn in_plan(span: Span) -> Place {
    Place { file: File::Plan, span }
}

impl Decomposed<'_, '_> {
    /// `task 5 (tidy hall)`
    fn task(&self, task: DecompositionId) -> String {
        let Some(decomposition) = self.plan.decompositions.get(task) else { return "a task".to_owned() };
        let unknown = Name::new("?");
        let name = self.words.domain.tasks.get(decomposition.task).map_or(&unknown, |task| &task.name);
        let text = show_list(name, &decomposition.arguments, self.words.problem);
        format!("task {} {text}", decomposition.label)
    }

    /// `task 5 (tidy hall)`, `action 3 (sweep hall)`
    fn node(&self, node: PlanNode) -> String {
        match node {
            PlanNode::Decomposition(task) => self.task(task),
            PlanNode::Step(step) => self.plan.steps.get(step).map_or_else(
                || "an action".to_owned(),
                |step| {
                    let text = show_step(self.words.domain, self.words.problem, &step.step);
                    format!("action {} {text}", step.label)
                },
            ),
        }
    }

    fn method(&self, task: DecompositionId) -> (String, Span) {
        let method = self.plan.decompositions.get(task).map(|d| d.method);
        let method = method.and_then(|method| self.words.domain.methods.get(method));
        method.map_or_else(|| ("?".to_owned(), Span::default()), |m| (m.name.to_string(), m.span))
    }

    fn method_place(&self, task: DecompositionId) -> Place {
        in_plan(self.plan.decompositions.get(task).map_or_else(Span::default, |d| d.method_span))
    }

    fn task_place(&self, task: DecompositionId) -> Place {
        in_plan(node_span(self.plan, PlanNode::Decomposition(task)))
    }

    /// The place of the parent in the plan, and the file of its network.
    fn parent(&self, of: Parent) -> (Place, File) {
        match of {
            Parent::Root => (in_plan(self.plan.root_span), File::Problem),
            Parent::Task(task) => (self.task_place(task), File::Domain),
        }
    }

    fn plain(sentence: String, place: Place) -> Finding {
        Finding { sentence, place, notes: Vec::new() }
    }

    fn fault(&self, fault: &NetworkFault) -> Finding {
        match fault {
            NetworkFault::NoNetwork => {
                let sentence = "the problem has no task network that a decomposition could belong to";
                Self::plain(sentence.to_owned(), in_plan(self.plan.root_span))
            }
            NetworkFault::Unknown { task } => {
                let sentence = format!("the domain does not have {}, or not its method", self.task(*task));
                Self::plain(sentence, self.task_place(*task))
            }
            NetworkFault::Arguments { task, .. } => {
                let sentence = format!("{} has arguments that do not fit", self.task(*task));
                Self::plain(sentence, self.task_place(*task))
            }
            NetworkFault::Cycle { task, span } => {
                let sentence = format!("{} is a subtask of itself", self.task(*task));
                let notes = vec![(self.task_place(*task), "this task".to_owned())];
                Finding { sentence, place: in_plan(*span), notes }
            }
            NetworkFault::Shared { node, first, second } => {
                let sentence = format!("{} is used twice", self.node(*node));
                let notes = vec![(in_plan(*first), "used here first".to_owned())];
                Finding { sentence, place: in_plan(*second), notes }
            }
            NetworkFault::Orphan { node } => {
                let sentence = format!("{} comes out of no task", self.node(*node));
                Self::plain(sentence, in_plan(node_span(self.plan, *node)))
            }
            NetworkFault::Method { task } => {
                let (method, span) = self.method(*task);
                let sentence = format!("`{method}` is no method for {}", self.task(*task));
                let note = (Place { file: File::Domain, span }, "a method for another task".to_owned());
                Finding { sentence, place: self.method_place(*task), notes: vec![note] }
            }
            NetworkFault::MethodArguments { task, object, position } => {
                let (method, span) = self.method(*task);
                let sentence = format!(
                    "method `{method}` is not for {}: argument {}, {}, does not fit",
                    self.task(*task),
                    position + 1,
                    self.words.object(*object)
                );
                let note = (Place { file: File::Domain, span }, "this method".to_owned());
                Finding { sentence, place: self.method_place(*task), notes: vec![note] }
            }
            NetworkFault::Subtasks { of, missing, surplus } => {
                let (place, file) = self.parent(*of);
                let sentence = match of {
                    Parent::Root => "the root is not what the problem's task network asks for".to_owned(),
                    Parent::Task(task) => format!(
                        "{} has not the subtasks of method `{}`",
                        self.task(*task),
                        self.method(*task).0
                    ),
                };
                let surplus = surplus.iter().map(|reference| {
                    (in_plan(reference.span), format!("{} fits nothing", self.node(reference.node)))
                });
                let missing = missing
                    .iter()
                    .map(|&span| (Place { file, span }, "nothing in the plan fits this".to_owned()));
                Finding { sentence, place, notes: surplus.chain(missing).collect() }
            }
            NetworkFault::Constraints { of, parts } => {
                let (place, file) = self.parent(*of);
                let sentence = match of {
                    Parent::Root => {
                        "the root breaks the constraints of the problem's task network".to_owned()
                    }
                    Parent::Task(task) => {
                        format!(
                            "{} breaks the constraints of method `{}`",
                            self.task(*task),
                            self.method(*task).0
                        )
                    }
                };
                Finding { sentence, place, notes: self.words.notes(parts, file) }
            }
            NetworkFault::Ordering { of, before, after } => {
                let whose = match of {
                    Parent::Root => "the problem's task network".to_owned(),
                    Parent::Task(task) => {
                        format!("method `{}` of {}", self.method(*task).0, self.task(*task))
                    }
                };
                let (before_text, after_text) = (self.node(before.node), self.node(after.node));
                let sentence =
                    format!("{after_text} begins before {before_text} ends, against the order of {whose}");
                let notes = vec![
                    (in_plan(node_span(self.plan, before.node)), "this must end first".to_owned()),
                    (self.parent(*of).0, "ordered by this".to_owned()),
                ];
                Finding { sentence, place: in_plan(node_span(self.plan, after.node)), notes }
            }
            NetworkFault::Precondition { task, after, parts } => {
                let when = match after {
                    0 => "in the initial state".to_owned(),
                    n => format!("after step {n}"),
                };
                let sentence = format!(
                    "{} cannot be carried out by method `{}` {when}: its precondition does not hold",
                    self.task(*task),
                    self.method(*task).0
                );
                Finding {
                    sentence,
                    place: self.method_place(*task),
                    notes: self.words.notes(parts, File::Domain),
                }
            }
            NetworkFault::NoDecomposition { .. } => Self::plain(
                "the task network cannot become these steps".to_owned(),
                in_plan(self.plan.root_span),
            ),
        }
    }
}

/// The place of a task in the plan.
fn node_span(plan: &HierarchicalPlan, node: PlanNode) -> Span {
    match node {
        PlanNode::Step(step) => plan.steps.get(step).map_or_else(Span::default, |step| step.step.span),
        PlanNode::Decomposition(task) => {
            plan.decompositions.get(task).map_or_else(Span::default, |task| task.span)
        }
    }
}
