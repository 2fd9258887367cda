//! The declarations of a file so far, by name: everything that bodies (conditions, effects …) refer to.
//!
//! Names are looked up as written: a lookup allocates only if the name has capitals. Invariant: each map's
//! ids are positions in the vector beside it.

use std::borrow::Cow;
use std::hash::BuildHasher;

use hashbrown::HashTable;
use rustc_hash::{FxBuildHasher, FxHashMap};

use super::sink::Sink;
use crate::diagnostic::{DiagnosticKind, SymbolKind};
use crate::model::{
    Domain, Function, FunctionId, IndexVec, Name, Object, ObjectId, Predicate, PredicateId, Requirement,
    Requirements, SubtaskHead, TypeId, TypeSet, TypeTable, Variable,
};
use crate::syntax::Node;

/// A task or action that a subtask can name, with its parameters.
pub(crate) struct Signature {
    pub(crate) name: Name,
    pub(crate) head: SubtaskHead,
    pub(crate) parameters: Vec<Variable>,
}

/// All declarations.
pub(crate) struct World {
    pub(crate) requirements: Requirements,
    pub(crate) types: TypeTable,
    pub(crate) type_ids: FxHashMap<Name, TypeId>,
    pub(crate) objects: IndexVec<ObjectId, Object>,
    /// Ids by the names in `objects`, which the table does not repeat: a problem can have so many objects
    /// that cache misses dominate a lookup.
    object_ids: HashTable<ObjectId>,
    pub(crate) predicates: IndexVec<PredicateId, Predicate>,
    pub(crate) predicate_ids: FxHashMap<Name, PredicateId>,
    pub(crate) functions: IndexVec<FunctionId, Function>,
    pub(crate) function_ids: FxHashMap<Name, FunctionId>,
    pub(crate) signatures: Vec<Signature>,
    pub(crate) signature_ids: FxHashMap<Name, usize>,
}

/// The text in lower case, borrowed if it is already.
pub(crate) fn fold(text: &str) -> Cow<'_, str> {
    if text.bytes().any(|b| b.is_ascii_uppercase()) {
        Cow::Owned(text.to_ascii_lowercase())
    } else {
        Cow::Borrowed(text)
    }
}

fn hash(name: &str) -> u64 {
    FxBuildHasher.hash_one(name)
}

impl World {
    pub(crate) fn new(requirements: Requirements, types: TypeTable) -> Self {
        let type_ids = types.enumerate().map(|(id, t)| (t.name.clone(), id)).collect();
        Self {
            requirements,
            types,
            type_ids,
            objects: IndexVec::new(),
            object_ids: HashTable::new(),
            predicates: IndexVec::new(),
            predicate_ids: FxHashMap::default(),
            functions: IndexVec::new(),
            function_ids: FxHashMap::default(),
            signatures: Vec::new(),
            signature_ids: FxHashMap::default(),
        }
    }

    /// The declarations of a domain that is already a model.
    pub(crate) fn of(domain: &Domain) -> Self {
        Self::with_objects(domain, &domain.constants)
    }

    /// The declarations of a domain with the objects of a problem, which include the domain's constants.
    pub(crate) fn with_objects(domain: &Domain, objects: &IndexVec<ObjectId, Object>) -> Self {
        let mut world = Self::new(domain.requirements.clone(), domain.types.clone());
        for object in objects {
            world.add_object(object.clone());
        }
        for predicate in &domain.predicates {
            world.add_predicate(predicate.clone());
        }
        for function in &domain.functions {
            world.add_function(function.clone());
        }
        for (id, action) in domain.actions.enumerate() {
            world.add_signature(&action.name, SubtaskHead::Action(id), action.variables.parameters());
        }
        for (id, action) in domain.durative_actions.enumerate() {
            world.add_signature(&action.name, SubtaskHead::DurativeAction(id), action.variables.parameters());
        }
        for (id, task) in domain.tasks.enumerate() {
            world.add_signature(&task.name, SubtaskHead::Task(id), task.variables.parameters());
        }
        world
    }

    pub(crate) fn has(&self, requirement: Requirement) -> bool {
        self.requirements.contains(requirement)
    }

    pub(crate) fn add_object(&mut self, object: Object) {
        let hash = hash(&object.name);
        let id = self.objects.push(object);
        let objects = &self.objects;
        self.object_ids.insert_unique(hash, id, |&id| self::hash(&objects[id].name));
    }

    pub(crate) fn add_predicate(&mut self, predicate: Predicate) {
        let name = predicate.name.clone();
        let id = self.predicates.push(predicate);
        self.predicate_ids.insert(name, id);
    }

    pub(crate) fn add_function(&mut self, function: Function) {
        let name = function.name.clone();
        let id = self.functions.push(function);
        self.function_ids.insert(name, id);
    }

    pub(crate) fn add_signature(&mut self, name: &Name, head: SubtaskHead, parameters: &[Variable]) {
        let signature = Signature { name: name.clone(), head, parameters: parameters.to_vec() };
        self.signature_ids.entry(name.clone()).or_insert(self.signatures.len());
        self.signatures.push(signature);
    }

    pub(crate) fn type_id(&self, name: &str) -> Option<TypeId> {
        self.type_ids.get(&*fold(name)).copied()
    }

    pub(crate) fn object(&self, name: &str) -> Option<ObjectId> {
        let name = fold(name);
        self.object_ids.find(hash(&name), |&id| *self.objects[id].name == *name).copied()
    }

    pub(crate) fn predicate(&self, name: &str) -> Option<PredicateId> {
        self.predicate_ids.get(&*fold(name)).copied()
    }

    pub(crate) fn function(&self, name: &str) -> Option<FunctionId> {
        self.function_ids.get(&*fold(name)).copied()
    }

    pub(crate) fn task_or_action(&self, name: &str) -> Option<&Signature> {
        self.signature_ids.get(&*fold(name)).map(|&i| &self.signatures[i])
    }

    /// `truck`, or `(either truck plane)`.
    pub(crate) fn type_text(&self, types: &TypeSet) -> String {
        match types.0.as_slice() {
            [] => "`object`".to_owned(),
            [one] => format!("`{}`", self.types[*one].name),
            many => {
                let names: Vec<&str> = many.iter().map(|&t| self.types[t].name.as_str()).collect();
                format!("`(either {})`", names.join(" "))
            }
        }
    }

    /// `(at ?x - truck ?y - place)`
    pub(crate) fn signature(&self, name: &str, parameters: &[Variable]) -> String {
        let mut text = format!("({name}");
        for p in parameters {
            let types = self.type_text(&p.types);
            text += &format!(" ?{} - {}", p.name, types.trim_matches('`'));
        }
        text + ")"
    }

    /// Reports an undeclared name.
    pub(crate) fn unknown(&self, sink: &mut Sink, node: Node<'_>, symbol: SymbolKind) {
        if let Some(kind) = symbol.name_kind() {
            sink.mention(kind, node, None);
        }
        let name = node.text();
        let types = || self.types.enumerate().map(|(_, t)| t.name.as_str());
        let predicates = || self.predicates.iter().map(|p| p.name.as_str());
        let functions = || self.functions.iter().map(|f| f.name.as_str());
        let heads = || self.signatures.iter();
        let suggestion = match symbol {
            SymbolKind::Type => sink.suggest(name, types()),
            SymbolKind::Predicate => sink.suggest(name, predicates()),
            SymbolKind::Function => sink.suggest(name, functions()),
            SymbolKind::Object => sink.suggest(name, self.objects.iter().map(|o| o.name.as_str())),
            SymbolKind::Token => sink.suggest(name, predicates().chain(functions()).chain(types())),
            SymbolKind::TaskOrAction => sink.suggest(name, heads().map(|s| s.name.as_str())),
            SymbolKind::Task => {
                let tasks = heads().filter(|s| matches!(s.head, SubtaskHead::Task(_)));
                sink.suggest(name, tasks.map(|s| s.name.as_str()))
            }
            SymbolKind::Action => {
                let actions = heads().filter(|s| !matches!(s.head, SubtaskHead::Task(_)));
                sink.suggest(name, actions.map(|s| s.name.as_str()))
            }
            _ => None,
        };
        let name = name.to_owned();
        sink.report(node.span(), DiagnosticKind::Unknown { symbol, name, suggestion });
    }
}
