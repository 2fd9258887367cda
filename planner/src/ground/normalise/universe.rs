//! The domains of all variables, by the definition that `pddl` gives of them.

use pddl::model::{Domain, Extent, Problem, TypeSet, Variables};
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// Extents by type, each computed once.
pub(crate) struct Universe<'a> {
    domain: &'a Domain,
    problem: &'a Problem,
    extents: FxHashMap<TypeSet, Arc<Extent>>,
}

impl<'a> Universe<'a> {
    pub(crate) fn new(domain: &'a Domain, problem: &'a Problem) -> Self {
        Self { domain, problem, extents: FxHashMap::default() }
    }

    pub(crate) fn extent(&mut self, types: &TypeSet) -> Arc<Extent> {
        let (domain, problem) = (self.domain, self.problem);
        let new = || Arc::new(Extent::new(types, &domain.types, &problem.objects));
        self.extents.entry(types.clone()).or_insert_with(new).clone()
    }

    /// The extent of every slot.
    pub(crate) fn slots(&mut self, variables: &Variables) -> Vec<Arc<Extent>> {
        variables.slots.iter().map(|v| self.extent(&v.types)).collect()
    }
}
