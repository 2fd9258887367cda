//! Reading a domain as a vocabulary.
//!
//! Idea: read types first, parents before children, then constants, predicates and functions; `permission` reads
//! `:writes` after them. Each declaration that does not fit the graph is a [`TokenError`] with its place, and all errors
//! are reported together. Invariant: a domain with an error gives no vocabulary.

use std::sync::Arc;

use dsr::{AgentId, Kind, LabelId, Nature, TypeId, Value, VocabularyBuilder, VocabularyError};
use indexmap::IndexMap;
use pddl::Span;
use pddl::model::{Domain, Function, FunctionValue, Idx, Name, Predicate, TypeSet, Variables};
use rustc_hash::FxHashMap;

use crate::located::Located;
use crate::pose::PoseComponent;
use crate::token_error::{TokenError, TokenErrorKind};
use crate::tokens::{Constant, FunctionToken, Sort, Tokens, ValueSort};

/// A vocabulary while it is being read.
pub(crate) struct Reader<'d> {
    pub(crate) domain: &'d Domain,
    pub(crate) builder: VocabularyBuilder,
    errors: Vec<TokenError>,
    types: FxHashMap<Name, Sort>,
    pub(crate) labels: FxHashMap<Name, LabelId>,
    pub(crate) functions: FxHashMap<Name, FunctionToken>,
    pub(crate) constants: IndexMap<Name, Constant>,
    pub(crate) agents: FxHashMap<Name, AgentId>,
}

impl<'d> Reader<'d> {
    /// Reads all declarations; `:writes` is not one of them.
    pub(crate) fn new(domain: &'d Domain) -> Self {
        let mut reader = Self {
            domain,
            builder: VocabularyBuilder::new(),
            errors: Vec::new(),
            types: FxHashMap::default(),
            labels: FxHashMap::default(),
            functions: FxHashMap::default(),
            constants: IndexMap::new(),
            agents: FxHashMap::default(),
        };
        reader.types();
        reader.constants();
        domain.predicates.iter().for_each(|predicate| reader.predicate(predicate));
        domain.functions.iter().for_each(|function| reader.function(function));
        reader
    }

    /// The vocabulary, or every error, in the order of the source.
    pub(crate) fn finish(self) -> Result<Tokens, Vec<TokenError>> {
        let Self { domain, builder, mut errors, types, labels, functions, constants, .. } = self;
        if !errors.is_empty() {
            errors.sort_by_key(|error| error.span);
            errors.dedup();
            return Err(errors);
        }
        Ok(Tokens {
            name: domain.name.clone(),
            vocabulary: builder.build(),
            types,
            labels,
            functions,
            constants,
            domain: Arc::new(domain.clone()),
        })
    }

    pub(crate) fn error(&mut self, span: Span, kind: impl Into<TokenErrorKind>) {
        self.errors.push(Located::new(span, kind.into()));
    }

    /// Takes the builder's result, or reports its error.
    pub(crate) fn take<T>(&mut self, span: Span, result: Result<T, VocabularyError>) -> Option<T> {
        result.map_err(|error| self.error(span, error)).ok()
    }

    pub(crate) fn type_name(&self, id: pddl::model::TypeId) -> Name {
        self.domain.types[id].name.clone()
    }

    /// Declares parents before children: a type waits until its parent is known. The hierarchy is acyclic.
    fn types(&mut self) {
        let mut waiting: Vec<_> = self.domain.types.enumerate().map(|(id, _)| id).collect();
        while !waiting.is_empty() {
            let before = waiting.len();
            waiting.retain(|&id| !self.type_declared(id));
            if waiting.len() == before {
                break;
            }
        }
    }

    /// Declares a type if its parent is declared. Returns whether the type is settled.
    fn type_declared(&mut self, id: pddl::model::TypeId) -> bool {
        let declared = &self.domain.types[id];
        let (name, span) = (declared.name.clone(), declared.span);
        let parent = match *declared.parents.as_slice() {
            [] if name.as_str() == "object" => {
                self.types.insert(name, Sort::Node(TypeId::OBJECT));
                return true;
            }
            [] => Name::new("object"),
            [parent] => self.type_name(parent),
            _ => {
                self.error(span, TokenErrorKind::SeveralParents { name: name.clone() });
                self.type_name(declared.parents[0])
            }
        };
        let own = match name.as_str() {
            "agent" => Some(TypeId::AGENT),
            "resource" => Some(TypeId::RESOURCE),
            _ => None,
        };
        let under_built_in = matches!(parent.as_str(), "agent" | "resource");
        if under_built_in || (own.is_some() && parent.as_str() != "object") {
            self.error(span, TokenErrorKind::BuiltInType { name: name.clone(), below: parent.clone() });
        }
        if let Some(id) = own {
            self.types.insert(name, Sort::Node(id));
            return true;
        }
        let sort = match (name.as_str(), parent.as_str()) {
            // `value`, the root of the values, is never the type of a stored value, so its sort does not matter.
            ("value", "object") => Some(Sort::Value(ValueSort::Text)),
            ("text", "value") => Some(Sort::Value(ValueSort::Text)),
            ("flag", "value") => Some(Sort::Value(ValueSort::Flag)),
            ("pose", "value") => Some(Sort::Value(ValueSort::Pose)),
            _ => None,
        };
        let sort = match (sort, self.types.get(&parent).copied()) {
            (Some(sort), _) => sort,
            (None, None) => return false,
            (None, Some(Sort::Value(sort))) => {
                self.error(span, TokenErrorKind::UnknownValueType { name: name.clone() });
                Sort::Value(sort)
            }
            (None, Some(Sort::Node(parent))) => {
                let nature = if name.as_str() == "frame" { Nature::Geometric } else { Nature::Symbolic };
                let declared = self.builder.node_type(&name, Some(parent), nature);
                Sort::Node(self.take(span, declared).unwrap_or(TypeId::OBJECT))
            }
        };
        self.types.insert(name, sort);
        true
    }

    fn constants(&mut self) {
        for constant in &self.domain.constants {
            let (name, span) = (constant.name.clone(), constant.span);
            let &[of] = constant.types.declared() else {
                self.error(span, TokenErrorKind::SeveralTypes { name });
                continue;
            };
            let entry = match self.types.get(&self.domain.types[of].name).copied() {
                None => continue,
                Some(Sort::Value(sort)) => match (sort, name.as_str()) {
                    (ValueSort::Flag, "true") => Constant::Value(Value::Bool(true)),
                    (ValueSort::Flag, "false") => Constant::Value(Value::Bool(false)),
                    _ => {
                        self.error(span, TokenErrorKind::ValueConstant { name });
                        continue;
                    }
                },
                Some(Sort::Node(TypeId::AGENT)) => {
                    // `dsr` is the graph itself, an agent of every vocabulary.
                    let made =
                        if name.as_str() == "dsr" { Ok(AgentId::DSR) } else { self.builder.agent(&name) };
                    if let Some(agent) = self.take(span, made) {
                        self.agents.insert(name.clone(), agent);
                    }
                    Constant::BuiltIn(TypeId::AGENT)
                }
                Some(Sort::Node(TypeId::RESOURCE)) => {
                    let made = self.builder.resource(&name);
                    self.take(span, made);
                    Constant::BuiltIn(TypeId::RESOURCE)
                }
                Some(Sort::Node(id)) => Constant::Node(id),
            };
            self.constants.insert(name, entry);
        }
    }

    fn predicate(&mut self, predicate: &Predicate) {
        let (name, span) = (predicate.name.clone(), predicate.span);
        if predicate.derived {
            return self.error(span, TokenErrorKind::Derived { name });
        }
        let [from, to] = predicate.variables.parameters() else {
            let arity = predicate.variables.parameters;
            return self.error(span, TokenErrorKind::NotBinary { name, arity });
        };
        let (Some(starts), Some(ends)) = (
            self.node_types(&name, &from.name, &from.types, span),
            self.node_types(&name, &to.name, &to.types, span),
        ) else {
            return;
        };
        for &start in &starts {
            for &end in &ends {
                let label = self.builder.label(&name, start, end);
                if let Some(label) = self.take(span, label) {
                    self.labels.insert(name.clone(), label);
                }
            }
        }
    }

    /// The node types of an argument. An argument that is a value is reported.
    fn node_types(
        &mut self,
        name: &Name,
        variable: &Name,
        types: &TypeSet,
        span: Span,
    ) -> Option<Vec<TypeId>> {
        let mut found = Vec::new();
        for &id in &types.0 {
            match self.types.get(&self.domain.types[id].name) {
                Some(Sort::Node(id)) => found.push(*id),
                Some(Sort::Value(_)) => {
                    let (name, variable) = (name.clone(), variable.clone());
                    self.error(span, TokenErrorKind::ValueArgument { name, variable });
                    return None;
                }
                None => return None,
            }
        }
        Some(found)
    }

    fn function(&mut self, function: &Function) {
        let (name, span) = (function.name.clone(), function.span);
        if self.domain.predicate(&name).is_some() {
            return self.error(span, TokenErrorKind::TwoMeanings { name });
        }
        if let Some(token) = self.computed(function) {
            self.functions.insert(name, token);
            return;
        }
        let Some(kind) = self.kind(function) else { return };
        let Some(arguments) = self.arguments(function) else { return };
        let token = match *arguments.as_slice() {
            [of] => {
                let attribute = self.builder.attribute_on_node(&name, of, kind);
                self.take(span, attribute).map(|attribute| FunctionToken::Node { attribute })
            }
            [from, to] => {
                let label = self.builder.label(&name, from, to);
                let label = self.take(span, label);
                label.and_then(|label| {
                    let attribute = self.builder.attribute_on_edge(&name, label, (from, to), kind);
                    self.take(span, attribute).map(|attribute| FunctionToken::Edge { label, attribute })
                })
            }
            _ => {
                let arity = function.variables.parameters;
                return self.error(span, TokenErrorKind::FunctionArity { name, arity });
            }
        };
        if let Some(token) = token {
            self.functions.insert(name, token);
        }
    }

    /// The token of a function that the graph computes or keeps as a transform.
    fn computed(&mut self, function: &Function) -> Option<FunctionToken> {
        let name = &function.name;
        let is_pose = matches!(&function.value, FunctionValue::Object(types)
            if self.values(types) == Some(ValueSort::Pose));
        let (token, fits, expected) = match (name.as_str(), PoseComponent::named(name)) {
            ("rt", _) => (FunctionToken::Transform, is_pose, "pose"),
            ("distance", _) => (FunctionToken::Distance, function.value == FunctionValue::Number, "number"),
            (_, Some(component)) => {
                (FunctionToken::Pose(component), function.value == FunctionValue::Number, "number")
            }
            _ => return None,
        };
        if !fits || !self.between_frames(&function.variables) {
            let name = name.clone();
            self.error(function.span, TokenErrorKind::ReservedFunction { name, expected });
        }
        Some(token)
    }

    fn between_frames(&self, variables: &Variables) -> bool {
        let frame = self.domain.types.find("frame");
        variables.parameters == 2
            && variables.parameters().iter().all(|variable| {
                frame.is_some_and(|frame| {
                    variable.types.0.iter().all(|&t| self.domain.types.is_subtype(t, frame))
                })
            })
    }

    /// The kind of value of a union, if the union is one of values.
    fn values(&self, types: &TypeSet) -> Option<ValueSort> {
        match self.types.get(&self.domain.types[*types.0.first()?].name)? {
            Sort::Value(sort) => Some(*sort),
            Sort::Node(_) => None,
        }
    }

    fn kind(&mut self, function: &Function) -> Option<Kind> {
        let (name, span) = (function.name.clone(), function.span);
        let types = match &function.value {
            FunctionValue::Number => return Some(Kind::Number),
            FunctionValue::Object(types) => types,
        };
        let &[of] = types.0.as_slice() else {
            self.error(span, TokenErrorKind::FunctionKind { name });
            return None;
        };
        match self.types.get(&self.domain.types[of].name)? {
            Sort::Node(id) => Some(Kind::Node(*id)),
            Sort::Value(ValueSort::Text) => Some(Kind::Text),
            Sort::Value(ValueSort::Flag) => Some(Kind::Bool),
            Sort::Value(ValueSort::Pose) => {
                self.error(span, TokenErrorKind::PoseFunction { name });
                None
            }
        }
    }

    fn arguments(&mut self, function: &Function) -> Option<Vec<TypeId>> {
        let mut found = Vec::new();
        for variable in function.variables.parameters() {
            let types = self.node_types(&function.name, &variable.name, &variable.types, function.span)?;
            let [of] = *types.as_slice() else {
                let (name, variable) = (function.name.clone(), variable.name.clone());
                self.error(function.span, TokenErrorKind::FunctionArgument { name, variable });
                return None;
            };
            found.push(of);
        }
        Some(found)
    }

    /// The node type of that id; `None` for values.
    pub(crate) fn node_type(&self, id: pddl::model::TypeId) -> Option<TypeId> {
        match self.types.get(&self.domain.types[id].name)? {
            Sort::Node(id) => Some(*id),
            Sort::Value(_) => None,
        }
    }

    /// The name of a constant of this domain.
    pub(crate) fn constant_name(&self, id: pddl::model::ObjectId) -> Option<Name> {
        (id.index() < self.domain.constants.len()).then(|| self.domain.constants[id].name.clone())
    }
}
