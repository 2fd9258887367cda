//! Checks between the layers. Each check is a file with its finding, its reason and an example.
//!
//! `pddl` has proved that every name of every layer is declared with the right types; loading has proved that every
//! sentence exists. The checks find the mistakes between the layers: a plan without methods, an effect that perception
//! cannot see, an intention to which no agent reacts. Adding a check is adding a file and a line here.

mod claims_are_ordered;
mod effects_are_permitted;
mod effects_are_sensed;
mod intentions_are_heard;
mod items_are_complete;
mod objects_are_nodes;
mod perception_is_written;
mod tasks_of_actions;
mod tokens;

use crate::mission::Mission;
use diagnostics::Finding;

/// A check of a mission: adds its findings to the list.
type Check = fn(&Mission, &mut Vec<Finding>);

/// All checks, by code.
const ALL: [Check; 8] = [
    tasks_of_actions::check,
    effects_are_sensed::check,
    intentions_are_heard::check,
    perception_is_written::check,
    objects_are_nodes::check,
    items_are_complete::check,
    effects_are_permitted::check,
    claims_are_ordered::check,
];

impl Mission {
    /// The findings of all checks between the layers.
    pub fn check(&self) -> Vec<Finding> {
        let mut findings = Vec::new();
        for check in ALL {
            check(self, &mut findings);
        }
        findings
    }
}
