//! A decomposition as nested lists that can be opened and closed, without a script.
//!
//! A parsed plan may not be a tree: each task is expanded at its first occurrence only. Levels and
//! lines beyond the limits are replaced by an ellipsis.

use crate::report::subject::Subject;
use crate::verdict::{Failure, NetworkFault, Parent};
use maud::{Markup, html};
use pddl::model::Idx;
use pddl::{HierarchicalPlan, PlanNode, PlanReference};

/// The most lines that are shown.
const LINES: usize = 5_000;
/// The deepest nesting of lists.
const DEPTH: usize = 200;

/// A decomposition as HTML; the nodes of a failure are marked.
pub(super) fn tree(subject: &Subject<'_>, plan: &HierarchicalPlan, failure: Option<&Failure>) -> Markup {
    let marked = failure.map(|failure| marked(failure, plan)).unwrap_or_default();
    let seen = vec![false; plan.decompositions.len()];
    let list = Tree { subject, plan, marked, seen, lines: 0 }.list(&plan.roots, 1);
    html! {
        h2 { "Decomposition" }
        div class="tree" { (list) }
    }
}

struct Tree<'t> {
    subject: &'t Subject<'t>,
    plan: &'t HierarchicalPlan,
    marked: Vec<PlanNode>,
    /// By task: whether it was expanded.
    seen: Vec<bool>,
    lines: usize,
}

impl Tree<'_> {
    fn list(&mut self, references: &[PlanReference], depth: usize) -> Markup {
        let mut items = Vec::new();
        for reference in references {
            if self.lines > LINES {
                break;
            }
            self.lines += 1;
            items.push(if self.lines > LINES {
                html! { li { "…" } }
            } else {
                self.item(reference.node, depth)
            });
        }
        html! { ul { @for item in items { (item) } } }
    }

    fn item(&mut self, node: PlanNode, depth: usize) -> Markup {
        let class = self.marked.contains(&node).then_some("fails");
        let text = self.subject.node(self.plan, node);
        let id = match node {
            PlanNode::Step(step) => {
                return html! { li { span class=[class] { (text) } " " small { "step " (step.index() + 1) } } };
            }
            PlanNode::Decomposition(id) => id,
        };
        let task = self.plan.decompositions.get(id);
        let method = task.and_then(|task| self.subject.domain.methods.get(task.method));
        let method = method.map_or("?", |method| method.name.as_str());
        let line = html! { strong class=[class] { (text) } " " small { "by " (method) } };
        let again = self.seen.get_mut(id.index()).is_none_or(|seen| std::mem::replace(seen, true));
        match task.filter(|task| !task.subtasks.is_empty()) {
            _ if again => html! { li { (line) " … again" } },
            Some(task) if depth < DEPTH => {
                let below = self.list(&task.subtasks, depth + 1);
                html! { li { details open { summary { (line) } (below) } } }
            }
            Some(_) => html! { li { (line) " …" } },
            None => html! { li { (line) " " small { "becomes nothing" } } },
        }
    }
}

/// The nodes of a failure.
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
    use crate::report::subject::Subject;
    use crate::{Verdict, validate};
    use pddl::{Plan, Source, parse_domain, parse_plan, parse_problem};

    fn drawn(plan: &str) -> String {
        let domain = "(define (domain d) (:requirements :hierarchy) (:task t :parameters ())
            (:method go-on :parameters () :task (t) :ordered-subtasks (and (a) (t)))
            (:method end :parameters () :task (t) :ordered-subtasks ())
            (:action a :parameters () :precondition () :effect ()))";
        let domain_text = Source::new("d", domain);
        let domain = parse_domain(&domain_text, &[]).model.unwrap();
        let problem = "(define (problem p) (:domain d) (:htn :ordered-subtasks (and (t))) (:init))";
        let problem_text = Source::new("p", problem);
        let problem = parse_problem(&problem_text, &domain).model.unwrap();
        let plan_text = Source::new("plan", plan);
        let plan = parse_plan(&plan_text, &domain, &problem).model.unwrap();
        let verdict = validate(&domain, &problem, &plan);
        let failure = match &verdict {
            Verdict::Invalid(failure) => Some(failure),
            _ => None,
        };
        let Plan::Hierarchical(decomposed) = &plan else { panic!("it has a decomposition") };
        let (domain_text, problem_text, plan_text) = (&domain_text, &problem_text, &plan_text);
        let subject =
            Subject { domain: &domain, problem: &problem, plan: &plan, domain_text, problem_text, plan_text };
        tree(&subject, decomposed, failure).into_string()
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
