//! A decomposition as nested lists that open and close, without a script.
//!
//! A plan that was read may be no tree: each task is opened where it is met first. Nothing recurses, and what is too
//! deep or too much to be looked at is left out, and said to be.

use super::network::show_node;
use super::page::escaped;
use pddl::model::{Domain, Idx, Problem};
use pddl::{HierarchicalPlan, PlanNode, PlanReference};
use validator::{Failure, NetworkFault, Parent};

/// How many lines are drawn.
const LINES: usize = 5_000;
/// How deep lists are nested.
const DEPTH: usize = 200;

/// What a decomposition looks like; the nodes that a failure is about are marked.
pub(super) fn tree(
    domain: &Domain,
    problem: &Problem,
    plan: &HierarchicalPlan,
    failure: Option<&Failure>,
) -> String {
    let marked = failure.map(|failure| marked(failure, plan)).unwrap_or_default();
    let mut html = "<h2>Decomposition</h2><div class=\"tree\"><ul>".to_owned();
    let mut seen = vec![false; plan.decompositions.len()];
    let mut way: Vec<std::slice::Iter<'_, PlanReference>> = vec![plan.roots.iter()];
    let mut lines = 0;
    while let Some(top) = way.last_mut() {
        let Some(reference) = top.next() else {
            way.pop();
            html += if way.is_empty() { "</ul>" } else { "</ul></details></li>" };
            continue;
        };
        lines += 1;
        if lines > LINES {
            html += "<li>…</li>";
            way.iter_mut().for_each(|rest| *rest = [].iter());
            continue;
        }
        let class = if marked.contains(&reference.node) { " class=\"fails\"" } else { "" };
        let text = escaped(&show_node(domain, problem, plan, reference.node));
        match reference.node {
            PlanNode::Step(step) => {
                let number = step.index() + 1;
                html += &format!("<li><span{class}>{text}</span> <small>step {number}</small></li>");
            }
            PlanNode::Decomposition(id) => {
                let task = plan.decompositions.get(id);
                let method = task.and_then(|task| domain.methods.get(task.method));
                let method = escaped(method.map_or("?", |method| method.name.as_str()));
                let line = format!("<strong{class}>{text}</strong> <small>by {method}</small>");
                let again = seen.get_mut(id.index()).is_none_or(|seen| std::mem::replace(seen, true));
                match task.filter(|task| !again && !task.subtasks.is_empty() && way.len() < DEPTH) {
                    Some(task) => {
                        html += &format!("<li><details open><summary>{line}</summary><ul>");
                        way.push(task.subtasks.iter());
                    }
                    None if again => html += &format!("<li>{line} … again</li>"),
                    None if task.is_some_and(|task| !task.subtasks.is_empty()) => {
                        html += &format!("<li>{line} …</li>");
                    }
                    None => html += &format!("<li>{line} <small>becomes nothing</small></li>"),
                }
            }
        }
    }
    html += "</div>";
    html
}

/// What a failure is about.
fn marked(failure: &Failure, plan: &HierarchicalPlan) -> Vec<PlanNode> {
    let of = |parent: &Parent| match parent {
        Parent::Root => Vec::new(),
        Parent::Task(task) => vec![PlanNode::Decomposition(*task)],
    };
    match failure {
        Failure::Network { fault } => match fault {
            NetworkFault::NoNetwork | NetworkFault::NoDecomposition { .. } => Vec::new(),
            NetworkFault::Unknown { task }
            | NetworkFault::Arguments { task, .. }
            | NetworkFault::Cycle { task, .. }
            | NetworkFault::Method { task }
            | NetworkFault::MethodArguments { task, .. }
            | NetworkFault::Precondition { task, .. } => vec![PlanNode::Decomposition(*task)],
            NetworkFault::Shared { node, .. } | NetworkFault::Orphan { node } => vec![*node],
            NetworkFault::Subtasks { of: parent, surplus, .. } => {
                of(parent).into_iter().chain(surplus.iter().map(|reference| reference.node)).collect()
            }
            NetworkFault::Constraints { of: parent, .. } => of(parent),
            NetworkFault::Ordering { before, after, .. } => vec![before.node, after.node],
        },
        Failure::Precondition { at, .. } | Failure::Effect { at, .. } => {
            let step = at.step().and_then(|step| plan.steps.ids().nth(step.0 as usize));
            step.map(PlanNode::Step).into_iter().collect()
        }
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may panic")]

    use super::tree;
    use pddl::{Plan, Source, parse_domain, parse_plan, parse_problem};
    use validator::{Verdict, validate};

    fn drawn(plan: &str) -> String {
        let domain = "(define (domain d) (:requirements :hierarchy) (:task t :parameters ())
            (:method go-on :parameters () :task (t) :ordered-subtasks (and (a) (t)))
            (:method end :parameters () :task (t) :ordered-subtasks ())
            (:action a :parameters () :precondition () :effect ()))";
        let domain = parse_domain(&Source::new("d", domain), &[]).model.unwrap();
        let problem = "(define (problem p) (:domain d) (:htn :ordered-subtasks (and (t))) (:init))";
        let problem = parse_problem(&Source::new("p", problem), &domain).model.unwrap();
        let plan = parse_plan(&Source::new("plan", plan), &domain, &problem).model.unwrap();
        let verdict = validate(&domain, &problem, &plan);
        let failure = match &verdict {
            Verdict::Invalid(failure) => Some(failure),
            _ => None,
        };
        let Plan::Hierarchical(plan) = &plan else { panic!("it has a decomposition") };
        tree(&domain, &problem, plan, failure)
    }

    #[test]
    fn every_list_is_closed() {
        let html = drawn("==>\n0 a\nroot 1\n1 t -> go-on 0 2\n2 t -> end\n<==\n");
        for tag in ["ul", "li", "details", "summary", "div"] {
            let count = |text: &str| html.matches(text).count();
            let opened = count(&format!("<{tag}>")) + count(&format!("<{tag} "));
            assert_eq!(opened, count(&format!("</{tag}>")), "{tag}: {html}");
        }
        assert!(html.contains("becomes nothing") && !html.contains("fails"), "{html}");
    }

    #[test]
    fn a_circle_is_drawn_once_and_marked() {
        let html = drawn("==>\n0 a\nroot 1\n1 t -> go-on 0 1\n<==\n");
        assert!(html.contains("… again") && html.contains("class=\"fails\""), "{html}");
    }
}
