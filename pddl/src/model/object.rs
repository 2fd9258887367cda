//! Objects: the types that each belongs to, and the objects that a variable ranges over.
//!
//! Problem: `(either a b)` has two meanings. Behind a variable it is a union: the variable stands for an object
//! of any of the types. Behind an object it is a conjunction: the object belongs to each of them, as if it was
//! declared once with each. Read with one and the same set, every crate that asked whether an object fits chose
//! one of the meanings, and two of them could differ. Idea: two Rust types, [`TypeSet`] behind variables and
//! [`ObjectTypes`] behind objects, and the question between them is answered here only, by [`Object::is_of`];
//! [`Extent`] is the answer for all objects. Invariant: no other crate decides from
//! [`ObjectTypes::declared`] whether an object fits somewhere.
//!
//! The objects of a task are [`Problem::objects`](super::Problem::objects). A constant may have more types there
//! than in [`Domain::constants`](super::Domain::constants), because a problem may declare it again.
//!
//! Source: McDermott et al., "PDDL: the planning domain definition language", 1998 (`either` is a union); Howey,
//! Long & Fox, "VAL", ICTAI 2004, whose type checker reads an object's types as a conjunction and those of a
//! variable as a disjunction. Fast Downward reads `either` in predicates only, and no object twice.

use super::{Idx, IndexVec, Name, ObjectId, TypeId, TypeSet, TypeTable};
use crate::Span;
use smallvec::SmallVec;

/// The types that an object was declared with; it belongs to each of them. Up to four are stored inline, since
/// every object of a problem has them.
#[derive(Clone, Debug)]
pub struct ObjectTypes(SmallVec<[TypeId; 4]>);

impl ObjectTypes {
    /// One type.
    pub fn one(of: TypeId) -> Self {
        Self(SmallVec::from_slice(&[of]))
    }

    /// Those behind an object's hyphen.
    pub(crate) fn each_of(declared: TypeSet) -> Self {
        Self(declared.0)
    }

    /// The object is declared once more, with these types.
    pub(crate) fn extend(&mut self, more: Self) {
        for of in more.0 {
            if !self.0.contains(&of) {
                self.0.push(of);
            }
        }
    }

    /// As the types of a variable that stands for this object or one of another of these types.
    pub(crate) fn union(&self) -> TypeSet {
        TypeSet(self.0.clone())
    }

    /// The types in the order of the text, without their supertypes: for texts. [`Object::is_of`] says what they
    /// mean.
    pub fn declared(&self) -> &[TypeId] {
        &self.0
    }

    /// Whether there are several, so that the object may belong to two types that have no subtype in common.
    pub fn are_several(&self) -> bool {
        self.0.len() > 1
    }

    /// Whether one of them is unknown, so that no type error can be derived from them. Only drafts have it.
    pub(crate) fn is_unknown(&self) -> bool {
        self.0.is_empty()
    }
}

/// Whether they name the same types, in any order.
impl PartialEq for ObjectTypes {
    fn eq(&self, other: &Self) -> bool {
        self.0.len() == other.0.len() && self.0.iter().all(|of| other.0.contains(of))
    }
}

impl Eq for ObjectTypes {}

/// A constant or object.
#[derive(Clone, Debug)]
pub struct Object {
    /// Its name.
    pub name: Name,
    /// The types that it belongs to.
    pub types: ObjectTypes,
    /// Where it was declared.
    pub span: Span,
}

impl Object {
    /// Whether a variable of these types can stand for it: one of its types is one of them, or below one.
    pub fn is_of(&self, union: &TypeSet, table: &TypeTable) -> bool {
        self.types.is_unknown() || union.is_unknown() || self.types.0.iter().any(|&of| table.is_in(of, union))
    }
}

/// The domain of a variable: the objects of a union of types, in the order of their declaration. Asking for one
/// object is a look-up.
#[derive(Clone, Debug, Default)]
pub struct Extent {
    objects: Vec<ObjectId>,
    is_member: Vec<bool>,
}

impl Extent {
    /// Those of the objects that belong to the union.
    pub fn new(union: &TypeSet, table: &TypeTable, objects: &IndexVec<ObjectId, Object>) -> Self {
        let is_member: Vec<bool> = objects.iter().map(|object| object.is_of(union, table)).collect();
        let members = is_member.iter().enumerate().filter(|(_, is_member)| **is_member);
        Self { objects: members.map(|(at, _)| ObjectId::from_index(at)).collect(), is_member }
    }

    /// Its objects.
    pub fn objects(&self) -> &[ObjectId] {
        &self.objects
    }

    /// Whether the object is one of them.
    pub fn contains(&self, object: ObjectId) -> bool {
        self.is_member.get(object.index()).copied().unwrap_or(false)
    }
}
