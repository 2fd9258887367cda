//! What variables range over: the objects of a problem, or abstract ones when there is no problem.
//!
//! Problem: a domain alone has no objects. Idea: beside its constants, one abstract object per type
//! stands for all that a problem may declare of exactly that type. Mapping every object to its
//! abstract one keeps all positive facts, so whatever the abstract world cannot reach, no problem
//! can, unless it has objects of several types: they have no abstract one, because one of all types would reach
//! whatever types keep apart. A caller that knows the problems must not rely on it where they have such objects. Invariant: objects are numbered as in the problem, abstract ones come after them; a type
//! whose objects the analysis does not know better is over-approximated, never left out.

use std::cell::RefCell;
use std::rc::Rc;

use pddl::model::{Domain, Idx, IndexVec, Object, ObjectId, Problem, Term, TypeId, TypeSet};
use rustc_hash::FxHashMap;

/// A slot without a value.
pub(crate) const UNBOUND: u32 = u32::MAX;

/// The objects of some types.
#[derive(Debug, Default)]
pub(crate) struct Range {
    /// In order.
    pub(crate) objects: Vec<u32>,
    member: Vec<bool>,
}

impl Range {
    /// Whether the object is in it.
    pub(crate) fn contains(&self, object: u32) -> bool {
        self.member.get(object as usize).copied().unwrap_or(false)
    }

    /// The objects that are in both.
    pub(crate) fn and(&self, other: &Range) -> Range {
        let objects: Vec<u32> = self.objects.iter().copied().filter(|&o| other.contains(o)).collect();
        let mut member = vec![false; self.member.len()];
        objects.iter().for_each(|&o| member[o as usize] = true);
        Range { objects, member }
    }
}

/// A domain with or without a problem.
pub(crate) struct World<'a> {
    /// The domain.
    pub(crate) domain: &'a Domain,
    /// The problem, if there is one.
    pub(crate) problem: Option<&'a Problem>,
    ranges: RefCell<FxHashMap<TypeSet, Rc<Range>>>,
}

impl<'a> World<'a> {
    /// The world of a domain and perhaps a problem.
    pub(crate) fn new(domain: &'a Domain, problem: Option<&'a Problem>) -> Self {
        Self { domain, problem, ranges: RefCell::default() }
    }

    /// The named objects.
    pub(crate) fn objects(&self) -> &'a IndexVec<ObjectId, Object> {
        self.problem.map_or(&self.domain.constants, |p| &p.objects)
    }

    fn named(&self) -> usize {
        self.objects().len()
    }

    /// Whether it stands for objects that are not known.
    pub(crate) fn is_abstract(&self, object: u32) -> bool {
        object as usize >= self.named()
    }

    /// Whether the object belongs to the union.
    pub(crate) fn is_in(&self, object: u32, types: &TypeSet) -> bool {
        let table = &self.domain.types;
        match (object as usize).checked_sub(self.named()) {
            Some(of) => types.is_unknown() || table.is_in(TypeId::from_index(of), types),
            None => self.objects()[ObjectId(object)].is_of(types, table),
        }
    }

    /// The objects of the union.
    pub(crate) fn range(&self, types: &TypeSet) -> Rc<Range> {
        if let Some(range) = self.ranges.borrow().get(types) {
            return Rc::clone(range);
        }
        let all = self.named() + if self.problem.is_some() { 0 } else { self.domain.types.len() };
        let mut range = Range { objects: Vec::new(), member: vec![false; all] };
        for object in 0..u32::try_from(all).expect("objects and types have ids of 32 bits") {
            if self.is_in(object, types) {
                range.objects.push(object);
                range.member[object as usize] = true;
            }
        }
        let range = Rc::new(range);
        self.ranges.borrow_mut().insert(types.clone(), Rc::clone(&range));
        range
    }
}

/// Hands over the row that terms are under a binding. Joins do this all the time: short rows need no memory of
/// their own.
pub(crate) fn with_row<R>(terms: &[Term], binding: &[u32], then: impl FnOnce(&[u32]) -> R) -> R {
    let mut short = [UNBOUND; 8];
    match short.get_mut(..terms.len()) {
        Some(row) => {
            row.iter_mut().zip(terms).for_each(|(value, &term)| *value = resolve(term, binding));
            then(row)
        }
        None => then(&terms.iter().map(|&term| resolve(term, binding)).collect::<Vec<u32>>()),
    }
}

/// The object that a term is, [`UNBOUND`] for a variable without a value.
pub(crate) fn resolve(term: Term, binding: &[u32]) -> u32 {
    match term {
        Term::Object(object) => object.0,
        Term::Variable(variable) => binding[variable.index()],
    }
}
