//! Counts the violations of preferences.
//!
//! A preference of a goal or of the constraints has one instance for each binding of its enclosing
//! `forall`s, judged at the end. A preference of a precondition is judged each time its action is
//! applied. The metric counts the violated instances by name.
//!
//! Source: Gerevini & Long, "Plan constraints and preferences in PDDL3", 2005, §4.

use crate::scene::{Binding, Scene, each_instance};
use crate::verdict::{ViolatedPreference, Violations};
use pddl::model::{Preference, VariableId, Variables};

/// A violated preference with its binding.
pub(crate) fn violated<T>(
    preference: &Preference<T>,
    variables: &Variables,
    binding: &Binding,
) -> ViolatedPreference {
    let value = |&variable: &VariableId| Some((variables[variable].name.clone(), binding.get(variable)?));
    ViolatedPreference {
        name: preference.name.clone(),
        binding: preference.forall.iter().filter_map(value).collect(),
        span: preference.span,
    }
}

/// Counts every instance that is not `satisfied`.
pub(crate) fn judge<T>(
    violations: &mut Violations,
    scene: Scene<'_>,
    preference: &Preference<T>,
    binding: &mut Binding,
    mut satisfied: impl FnMut(&T, &mut Binding) -> bool,
) {
    each_instance(scene, &preference.forall, binding, &mut |binding| {
        if !satisfied(&preference.body, binding) {
            violations.add(violated(preference, scene.variables, binding));
        }
    });
}
