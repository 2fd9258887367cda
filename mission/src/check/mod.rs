//! What the layers do to each other: each check is a file with what it finds, why, and an example.
//!
//! `pddl` has already proved that every name of every layer is declared with fitting types, and loading
//! that everything can be said. What remains lies between the layers: a plan that nobody can carry out,
//! an effect that nobody can see, an intention that no agent hears. Adding a check is adding a file and
//! a line here.

mod claims_are_ordered;
mod effects_are_permitted;
mod effects_are_sensed;
mod intentions_are_heard;
mod objects_are_nodes;
mod perception_is_written;
mod tasks_of_actions;
mod tokens;

use crate::mission::Mission;
use diagnostics::Finding;

/// A check: looks at a mission and adds what it finds.
type Check = fn(&Mission, &mut Vec<Finding>);

/// All checks, by code.
const ALL: [Check; 7] = [
    tasks_of_actions::check,
    effects_are_sensed::check,
    intentions_are_heard::check,
    perception_is_written::check,
    objects_are_nodes::check,
    effects_are_permitted::check,
    claims_are_ordered::check,
];

impl Mission {
    /// What the layers do to each other: everything that the checks find.
    pub fn check(&self) -> Vec<Finding> {
        let mut findings = Vec::new();
        for check in ALL {
            check(self, &mut findings);
        }
        findings
    }
}
