//! Checks between the layers. Each check is a file with its finding, its reason and an example.
//!
//! `pddl` has proved that every name of every layer is declared with the right types; loading has proved that every
//! sentence exists. The checks find the mistakes between the layers: a plan without methods, an effect that perception
//! cannot see, an intention that starts no rule. Some compare names; most look at what may happen at all, binding by
//! binding (`grounding`). Adding a check is adding a file and a line here.

mod claims_are_ordered;
mod conditions_can_hold;
mod context;
mod effects_are_permitted;
mod effects_are_sensed;
mod grounding;
mod intentions_are_heard;
mod items_are_complete;
mod nearest;
mod objects_are_nodes;
mod outcomes_are_handled;
mod perception_is_written;
mod preemptions_rest;
mod rules_can_start;
mod rules_come_to_rest;
mod rules_end_in_time;
mod tasks_of_actions;
mod tokens;

pub use self::context::SkillOutcomes;

use self::context::Context;
use self::grounding::Grounding;
use crate::mission::Mission;
use diagnostics::{Finding, Sources};

/// A check of a mission: adds its findings to the list.
type Check = fn(&Context<'_>, &mut Vec<Finding>);

/// All checks, by code.
const ALL: [Check; 14] = [
    tasks_of_actions::check,
    effects_are_sensed::check,
    intentions_are_heard::check,
    perception_is_written::check,
    rules_can_start::check,
    rules_end_in_time::check,
    conditions_can_hold::check,
    objects_are_nodes::check,
    items_are_complete::check,
    effects_are_permitted::check,
    claims_are_ordered::check,
    preemptions_rest::check,
    outcomes_are_handled::check,
    rules_come_to_rest::check,
];

impl Mission {
    /// The findings of all checks between the layers.
    pub fn check(&self, skills: &SkillOutcomes) -> Vec<Finding> {
        let grounding = Grounding::of(self);
        let mut findings = Vec::new();
        if !grounding.complete {
            let message = "the rules have too many bindings; what they can do was not checked to the end";
            let place = Sources::start_of(self.manifest_source);
            return vec![Finding::warning("C0001", place, message)];
        }
        let context = Context { mission: self, skills, grounding: &grounding };
        for check in ALL {
            check(&context, &mut findings);
        }
        findings
    }
}
