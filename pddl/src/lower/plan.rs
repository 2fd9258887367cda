//! Plan files: `(action object …)`, one after the other.
//!
//! A number and a colon before a step (`3: (a b)`) is passed over, as some planners write it. Steps
//! with durations and hierarchical plans are named as unsupported.

use super::body::{Applied, Body};
use super::sink::{Lowered, Sink};
use super::world::World;
use crate::analysis::NameKind;
use crate::diagnostic::{SymbolKind, UnsupportedFeature};
use crate::model::{ActionId, Domain, Problem, SubtaskHead};
use crate::syntax::{Node, Tree};
use crate::{Plan, PlanStep};

pub(crate) fn plan(mut sink: Sink, tree: &Tree<'_>, domain: &Domain, problem: &Problem) -> Lowered<Plan> {
    let mut world = World::of(domain);
    for object in problem.objects.iter().skip(domain.constants.len()) {
        world.add_object(object.clone());
    }
    let mut body = Body::new(&world, &mut sink);
    let mut plan = Plan::default();
    let mut temporal = None;
    let mut hierarchical = None;
    for root in tree.roots() {
        if root.is_list() {
            plan.steps.extend(body.step(domain, root));
        } else if root.is("==>") || root.is("==") {
            hierarchical.get_or_insert(root.span());
            // Behind the primitive steps comes the decomposition, in words of its own.
            break;
        } else if root.text().starts_with('[') {
            temporal.get_or_insert(root.span());
        } else if !is_step_number(root) {
            body.sink.unexpected(root, "a step such as `(action object)`");
        }
    }
    if let Some(span) = hierarchical {
        sink.unsupported(span, UnsupportedFeature::HierarchicalPlans);
    }
    if let Some(span) = temporal {
        sink.unsupported(span, UnsupportedFeature::TemporalPlans);
    }
    let mut finished = sink.finish();
    // A plan has nowhere to keep what it does not hold: without its times it is not this plan.
    finished.sound &= finished.unsupported.is_empty();
    Lowered::new(Some(plan), finished)
}

fn is_step_number(node: Node<'_>) -> bool {
    node.is(":") || node.text().trim_end_matches(':').parse::<f64>().is_ok()
}

impl Body<'_> {
    fn step(&mut self, domain: &Domain, node: Node<'_>) -> Option<PlanStep> {
        let Some(head) = node.head().filter(|h| h.is_name()) else {
            self.sink.unexpected(node, "a step such as `(action object)`");
            return None;
        };
        let world = self.world;
        let action: ActionId = match world.task_or_action(head.text()).map(|s| s.head) {
            Some(SubtaskHead::Action(id)) => id,
            Some(SubtaskHead::DurativeAction(_)) => {
                self.sink.unsupported(node.span(), UnsupportedFeature::TemporalPlans);
                return None;
            }
            Some(SubtaskHead::Task(_)) | None => {
                world.unknown(self.sink, head, SymbolKind::Action);
                return None;
            }
        };
        self.sink.mention(NameKind::Action, head, None);
        let schema = &domain.actions[action];
        let of = Applied {
            symbol: SymbolKind::Action,
            name: &schema.name,
            parameters: schema.variables.parameters(),
        };
        let faults = self.sink.count();
        let arguments = self.ground_arguments(node, node.children().skip(1), &of);
        debug_assert!(arguments.is_some() || self.sink.count() > faults, "what is wrong is reported");
        Some(PlanStep { action, arguments: arguments?, span: node.span() })
    }
}
