//! The objects that a variable ranges over.

use crate::ids::id32;
use pddl::model::{Domain, Problem, TypeSet, Variables};
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// The members of a union of types.
#[derive(Clone, Debug)]
pub(crate) struct Range {
    pub(crate) objects: Vec<u32>,
    member: Vec<bool>,
}

impl Range {
    pub(crate) fn contains(&self, object: u32) -> bool {
        self.member[object as usize]
    }
}

/// Ranges by type, each computed once.
pub(crate) struct Universe<'a> {
    domain: &'a Domain,
    problem: &'a Problem,
    ranges: FxHashMap<Vec<u32>, Arc<Range>>,
}

impl<'a> Universe<'a> {
    pub(crate) fn new(domain: &'a Domain, problem: &'a Problem) -> Self {
        Self { domain, problem, ranges: FxHashMap::default() }
    }

    pub(crate) fn range(&mut self, types: &TypeSet) -> Arc<Range> {
        let (domain, problem) = (self.domain, self.problem);
        let key = types.0.iter().map(|t| t.0).collect();
        let range = self.ranges.entry(key).or_insert_with(|| {
            let member: Vec<bool> = problem
                .objects
                .iter()
                .map(|o| o.types.0.iter().any(|&t| domain.types.is_in(t, types)))
                .collect();
            let objects = (0..member.len()).filter(|&i| member[i]).map(id32).collect();
            Arc::new(Range { objects, member })
        });
        range.clone()
    }

    /// The range of every slot.
    pub(crate) fn slots(&mut self, variables: &Variables) -> Vec<Arc<Range>> {
        variables.slots.iter().map(|v| self.range(&v.types)).collect()
    }
}
