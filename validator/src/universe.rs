//! The domains of all variables, by the definition that `pddl` gives of them.
//!
//! There is one extent per type, and one per union of types that some schema uses, computed once
//! per problem. Invariant: the type set of every evaluated variable has an extent. Membership is
//! O(1).

use pddl::model::{Domain, Extent, IndexVec, ObjectId, Problem, TypeId, TypeSet, Variables};
use rustc_hash::FxHashMap;

/// All extents of a problem.
#[derive(Clone, Debug)]
pub(crate) struct Universe {
    types: IndexVec<TypeId, Extent>,
    unions: FxHashMap<TypeSet, Extent>,
}

impl Universe {
    pub(crate) fn new(domain: &Domain, problem: &Problem) -> Self {
        let extent = |id| Extent::new(&TypeSet::one(id), &domain.types, &problem.objects);
        let types = domain.types.enumerate().map(|(id, _)| extent(id)).collect();
        let mut universe = Self { types, unions: FxHashMap::default() };
        for action in &domain.actions {
            universe.index(domain, problem, &action.variables);
        }
        for action in &domain.durative_actions {
            universe.index(domain, problem, &action.variables);
        }
        for process in &domain.processes {
            universe.index(domain, problem, &process.variables);
        }
        for event in &domain.events {
            universe.index(domain, problem, &event.variables);
        }
        for axiom in &domain.axioms {
            universe.index(domain, problem, &axiom.variables);
        }
        for method in &domain.methods {
            universe.index(domain, problem, &method.variables);
        }
        for task in &domain.tasks {
            universe.index(domain, problem, &task.variables);
        }
        if let Some((variables, _)) = &problem.htn {
            universe.index(domain, problem, variables);
        }
        universe.index(domain, problem, &domain.constraints.variables);
        universe.index(domain, problem, &problem.constraints.variables);
        universe.index(domain, problem, &problem.goal_variables);
        universe
    }

    fn index(&mut self, domain: &Domain, problem: &Problem, variables: &Variables) {
        for variable in &variables.slots {
            if variable.types.0.len() != 1 {
                self.unions
                    .entry(variable.types.clone())
                    .or_insert_with(|| Extent::new(&variable.types, &domain.types, &problem.objects));
            }
        }
    }

    /// Whether the object has one of the types.
    pub(crate) fn is_of(&self, object: ObjectId, types: &TypeSet) -> bool {
        types.0.iter().any(|&t| self.types[t].contains(object))
    }

    pub(crate) fn extent(&self, types: &TypeSet) -> &Extent {
        match types.0.as_slice() {
            [one] => &self.types[*one],
            _ => self.unions.get(types).expect("every variable's types were indexed"),
        }
    }
}
