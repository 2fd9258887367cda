//! Variables bound to objects.
//!
//! A binding is a slice with one object number per slot of a schema.

use pddl::model::{Extent, ObjectId, Term, VariableId};
use std::sync::Arc;

/// Returns the object of a term under a binding.
pub(crate) fn object(term: Term, binding: &[u32]) -> ObjectId {
    ObjectId(resolve(term, binding))
}

/// Returns the number of the object of a term under a binding.
pub(crate) fn resolve(term: Term, binding: &[u32]) -> u32 {
    match term {
        Term::Variable(v) => binding[v.0 as usize],
        Term::Object(o) => o.0,
    }
}

/// Calls `f` with each binding of these variables to objects of their extents.
pub(crate) fn each_binding(
    vs: &[VariableId],
    slots: &[Arc<Extent>],
    binding: &mut [u32],
    f: &mut dyn FnMut(&mut [u32]),
) {
    match vs.split_first() {
        None => f(binding),
        Some((first, rest)) => {
            for object in slots[first.0 as usize].objects() {
                binding[first.0 as usize] = object.0;
                each_binding(rest, slots, binding, f);
            }
        }
    }
}
