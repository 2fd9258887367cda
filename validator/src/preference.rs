//! How often preferences are violated.
//!
//! Every preference of a goal or of the constraints has one instance for each binding of the `forall`s
//! around it, judged at the end; one of a precondition is judged each time its action is taken. The
//! metric counts the violated instances by name.
//!
//! Source: Gerevini & Long, "Plan constraints and preferences in PDDL3", 2005, §4.

use crate::number::Number;
use crate::scene::{Binding, Scene};
use crate::trajectory::each_instance;
use indexmap::IndexMap;
use pddl::Span;
use pddl::model::{Name, ObjectId, Preference, VariableId, Variables};

/// A preference that a plan does not satisfy, for one binding of the `forall`s around it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ViolatedPreference {
    /// Its name, if it has one.
    pub name: Option<Name>,
    /// The values of the variables of the `forall`s around it.
    pub binding: Vec<(Name, ObjectId)>,
    /// Where it stands.
    pub span: Span,
}

/// How many instances of preferences are violated, by name.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Violations {
    counts: IndexMap<Name, u64>,
    instances: Vec<ViolatedPreference>,
}

impl Violations {
    /// How many of this name.
    pub fn count(&self, name: &Name) -> Number {
        let count = self.counts.get(name).copied().unwrap_or(0);
        Number::integer(i64::try_from(count).unwrap_or(i64::MAX))
    }

    /// Every violated instance, in the order in which they were judged.
    pub fn instances(&self) -> &[ViolatedPreference] {
        &self.instances
    }

    /// Counts an instance.
    pub(crate) fn add<T>(&mut self, preference: &Preference<T>, variables: &Variables, binding: &Binding) {
        let value = |&variable: &VariableId| Some((variables[variable].name.clone(), binding.get(variable)?));
        self.instances.push(ViolatedPreference {
            name: preference.name.clone(),
            binding: preference.forall.iter().filter_map(value).collect(),
            span: preference.span,
        });
        if let Some(name) = &preference.name {
            *self.counts.entry(name.clone()).or_insert(0) += 1;
        }
    }

    /// Counts every instance that is not `satisfied`.
    pub(crate) fn judge<T>(
        &mut self,
        scene: Scene<'_>,
        preference: &Preference<T>,
        binding: &mut Binding,
        mut satisfied: impl FnMut(&T, &mut Binding) -> bool,
    ) {
        each_instance(scene, &preference.forall, binding, &mut |binding| {
            if !satisfied(&preference.body, binding) {
                self.add(preference, scene.variables, binding);
            }
        });
    }
}
