//! The hierarchy of types.
//!
//! PDDL allows several parents (`either` on the right of a type), and PDDL 3.1 allows types as unary
//! predicates; a closure, computed once, serves both. Invariant: acyclic, `object` on top.

use super::{IndexVec, Name, TypeId};
use crate::Span;
use smallvec::SmallVec;

/// A declared type.
#[derive(Clone, Debug)]
pub struct Type {
    /// Its name.
    pub name: Name,
    /// Its direct supertypes; empty for `object` alone.
    pub parents: Vec<TypeId>,
    /// Where it was declared.
    pub span: Span,
}

/// A union of types behind a variable: `(either a b)`, or one type. What an object is declared with is no union
/// but [`ObjectTypes`](super::ObjectTypes).
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct TypeSet(pub SmallVec<[TypeId; 4]>);

impl TypeSet {
    /// `object`: anything.
    pub fn any() -> Self {
        Self::one(TypeTable::OBJECT)
    }

    /// That type alone.
    pub fn one(of: TypeId) -> Self {
        Self(SmallVec::from_slice(&[of]))
    }

    /// The type of a name whose type is unknown. Only drafts have it (see `analyze_domain`).
    pub(crate) fn unknown() -> Self {
        Self(SmallVec::new())
    }

    /// Whether it contains an unknown type, so that no type error can be derived from it.
    pub fn is_unknown(&self) -> bool {
        self.0.is_empty()
    }
}

/// All types of a domain with the closure of "is a".
#[derive(Clone, Debug)]
pub struct TypeTable {
    types: IndexVec<TypeId, Type>,
    /// `ancestors[t]` holds `t` and everything above it, sorted.
    ancestors: IndexVec<TypeId, Vec<TypeId>>,
}

impl TypeTable {
    /// The root type.
    pub const OBJECT: TypeId = TypeId(0);

    /// Closes the hierarchy. `types[0]` must be `object`, and the hierarchy acyclic (lowering reports cycles
    /// first); a cycle would be cut, not looped over.
    pub fn new(types: IndexVec<TypeId, Type>) -> Self {
        let ancestors = types
            .ids()
            .map(|t| {
                let mut seen = vec![t];
                let mut next = 0;
                while let Some(&u) = seen.get(next) {
                    next += 1;
                    for &p in &types[u].parents {
                        if !seen.contains(&p) {
                            seen.push(p);
                        }
                    }
                }
                if !seen.contains(&Self::OBJECT) {
                    seen.push(Self::OBJECT);
                }
                seen.sort_unstable();
                seen
            })
            .collect();
        Self { types, ancestors }
    }

    /// The type of that name.
    pub fn find(&self, name: &str) -> Option<TypeId> {
        self.types.enumerate().find(|(_, t)| &*t.name == name).map(|(id, _)| id)
    }

    /// Whether every `sub` is a `super_`.
    pub fn is_subtype(&self, sub: TypeId, super_: TypeId) -> bool {
        self.ancestors[sub].binary_search(&super_).is_ok()
    }

    /// Whether every `sub` belongs to the union.
    pub fn is_in(&self, sub: TypeId, union: &TypeSet) -> bool {
        union.0.iter().any(|&t| self.is_subtype(sub, t))
    }

    /// Whether each member of `sub` belongs to `super_`.
    pub fn is_subset(&self, sub: &TypeSet, super_: &TypeSet) -> bool {
        sub.0.iter().all(|&t| self.is_in(t, super_))
    }

    /// Whether a declared type is below both unions, so that an object of one type can belong to both. An object
    /// of several types can belong to any two.
    pub fn overlap(&self, a: &TypeSet, b: &TypeSet) -> bool {
        let inside = |a: &TypeSet, b: &TypeSet| a.0.iter().any(|&of| self.is_in(of, b));
        let is_below_both = |of: TypeId| self.is_in(of, a) && self.is_in(of, b);
        let is_unknown = a.is_unknown() || b.is_unknown();
        // Most are nested, which is seen without a look at all types.
        is_unknown || inside(a, b) || inside(b, a) || self.types.ids().any(is_below_both)
    }

    /// The type and all its supertypes, sorted by id.
    pub fn ancestors(&self, of: TypeId) -> &[TypeId] {
        &self.ancestors[of]
    }

    /// All types with their ids.
    pub fn enumerate(&self) -> impl DoubleEndedIterator<Item = (TypeId, &Type)> + ExactSizeIterator {
        self.types.enumerate()
    }

    /// How many, `object` included.
    pub fn len(&self) -> usize {
        self.types.len()
    }

    /// Always false: `object` is always there.
    pub fn is_empty(&self) -> bool {
        self.types.is_empty()
    }
}

impl std::ops::Index<TypeId> for TypeTable {
    type Output = Type;
    fn index(&self, id: TypeId) -> &Type {
        &self.types[id]
    }
}
