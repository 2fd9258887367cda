//! What conditions, effects and expressions have in common: terms, arguments, quantifiers.
//!
//! The files beside this one add the forms. All of them recurse at most as deep as the tree has nodes
//! (`MAX_DEPTH` in `syntax::build`). Each form has its own function, so that a level needs little stack. An
//! error leaves a placeholder in the model, which `parse_*` then does not hand out.

use super::schema::Schema;
use super::sink::Sink;
use super::world::World;
use crate::diagnostic::{DiagnosticKind, SymbolKind};
use crate::model::{FunctionTerm, Name, ObjectId, Term, TypeSet, Variable, VariableId};
use crate::occurrence::NameKind;
use crate::syntax::{Node, NodeKind};

/// The functions that stand as arguments in the form that is being read.
#[derive(Default)]
pub(crate) struct FunctionTerms {
    /// Innermost first; no quantifier binds them yet.
    pub(super) open: Vec<FunctionTerm>,
    /// How many of the enclosing forms can bind them.
    pub(super) binders: usize,
}

/// One schema that is being read.
pub(crate) struct Body<'a> {
    pub(crate) world: &'a World,
    pub(crate) sink: &'a mut Sink,
    pub(crate) schema: Schema,
    pub(super) functions: FunctionTerms,
}

/// A declared symbol that is applied to arguments.
pub(super) struct Applied<'a> {
    pub(super) symbol: SymbolKind,
    pub(super) name: &'a Name,
    pub(super) parameters: &'a [Variable],
}

impl<'a> Body<'a> {
    pub(crate) fn new(world: &'a World, sink: &'a mut Sink) -> Self {
        Self { world, sink, schema: Schema::default(), functions: FunctionTerms::default() }
    }

    /// A visible variable or an object; reports anything else.
    pub(super) fn term(&mut self, node: Node<'_>) -> Option<Term> {
        match node.kind() {
            NodeKind::Variable => self.variable(node).map(Term::Variable),
            NodeKind::Name | NodeKind::Number => self.object(node).map(Term::Object),
            NodeKind::List if node.head().is_some_and(|h| self.world.function(h.text()).is_some()) => {
                self.function_term(node)
            }
            NodeKind::List | NodeKind::Keyword => {
                self.sink.unexpected(node, "a variable or an object");
                None
            }
        }
    }

    pub(super) fn variable(&mut self, node: Node<'_>) -> Option<VariableId> {
        let name = &node.text()[1..];
        let found = self.schema.find(name);
        self.sink.mention(NameKind::Variable, node, found.and_then(|v| self.schema.scope_of(v)));
        if found.is_none() {
            let near = self.sink.suggest(name, self.schema.names()).map(|n| format!("?{n}"));
            let kind = DiagnosticKind::Unknown {
                symbol: SymbolKind::Variable,
                name: node.text().to_owned(),
                suggestion: near,
            };
            self.sink.report(node.span(), kind);
        }
        found
    }

    pub(super) fn object(&mut self, node: Node<'_>) -> Option<ObjectId> {
        let found = self.world.object(node.text());
        if found.is_some() {
            self.sink.mention(NameKind::Object, node, None);
        }
        if found.is_none() {
            self.world.unknown(self.sink, node, SymbolKind::Object);
        }
        found
    }

    /// The arguments of an applied symbol, with number and types checked; `None` if any is wrong.
    pub(super) fn arguments<'t>(
        &mut self,
        whole: Node<'t>,
        nodes: impl Iterator<Item = Node<'t>>,
        of: &Applied<'_>,
    ) -> Option<Vec<Term>> {
        let mut terms = Vec::with_capacity(of.parameters.len());
        let mut sound = true;
        let mut count = 0;
        for node in nodes {
            let term = self.term(node);
            sound &= term.is_some();
            if let (Some(term), Some(parameter)) = (term, of.parameters.get(count)) {
                sound &= self.argument_fits(node, term, of.name, count, &parameter.types);
            }
            terms.extend(term);
            count += 1;
        }
        (self.count_fits(whole, of, count) && sound).then_some(terms)
    }

    /// Whether the number of arguments is that of the declaration.
    pub(super) fn count_fits(&mut self, whole: Node<'_>, of: &Applied<'_>, found: usize) -> bool {
        let expected = of.parameters.len();
        if found != expected {
            let signature = self.world.signature(of.name, of.parameters);
            let (symbol, name) = (of.symbol, of.name.clone());
            let kind = DiagnosticKind::WrongArity { symbol, name, expected, found, signature };
            self.sink.report(whole.span(), kind);
        }
        found == expected
    }

    /// Reports a term that cannot stand for a parameter of those types. A variable of a supertype can: the
    /// parameter's type narrows the objects that it may be bound to.
    pub(super) fn argument_fits(
        &mut self,
        node: Node<'_>,
        term: Term,
        of: &Name,
        index: usize,
        types: &TypeSet,
    ) -> bool {
        let fits = self.term_fits(term, types);
        if !fits {
            let kind = DiagnosticKind::WrongType {
                name: of.clone(),
                position: index + 1,
                argument: node.text().to_owned(),
                expected: self.world.type_text(types),
                found: self.world.type_text(&self.term_types(term)),
            };
            self.sink.report(node.span(), kind);
        }
        fits
    }

    /// Whether a term can stand where an object of these types is wanted.
    fn term_fits(&self, term: Term, types: &TypeSet) -> bool {
        let (objects, table) = (&self.world.objects, &self.world.types);
        match term {
            Term::Object(object) => objects[object].is_of(types, table),
            Term::Variable(variable) => table.overlap(&self.schema.variables[variable].types, types),
        }
    }

    fn term_types(&self, term: Term) -> TypeSet {
        match term {
            Term::Object(object) => self.world.objects[object].types.union(),
            Term::Variable(variable) => self.schema.variables[variable].types.clone(),
        }
    }

    /// Reports two fluents that can never have the same value.
    pub(super) fn check_common(&mut self, left: (Node<'_>, &TypeSet), right: (Node<'_>, &TypeSet)) {
        if !self.world.types.overlap(left.1, right.1) {
            self.nothing_in_common(left, right);
        }
    }

    /// Reports a fluent and a term that can never be its value.
    pub(super) fn check_value(&mut self, fluent: (Node<'_>, &TypeSet), (node, term): (Node<'_>, Term)) {
        if !self.term_fits(term, fluent.1) {
            let found = self.term_types(term);
            self.nothing_in_common(fluent, (node, &found));
        }
    }

    fn nothing_in_common(&mut self, left: (Node<'_>, &TypeSet), right: (Node<'_>, &TypeSet)) {
        let kind = DiagnosticKind::NothingInCommon {
            left: left.0.text().to_owned(),
            left_type: self.world.type_text(left.1),
            right: right.0.text().to_owned(),
            right_type: self.world.type_text(right.1),
        };
        self.sink.report(left.0.span().to(right.0.span()), kind);
    }

    /// `((?x - t …) rest)` of a quantifier: binds the variables and gives them with the rest.
    pub(super) fn quantifier<'t>(&mut self, node: Node<'t>) -> Option<(Vec<VariableId>, Node<'t>)> {
        let parts: Vec<Node<'t>> = node.children().skip(1).collect();
        match parts.as_slice() {
            [variables, rest] if variables.is_list() => {
                let before = self.schema.variables.slots.len();
                let bound = self.bind(node, *variables);
                debug_assert_eq!(bound.len(), self.schema.variables.slots.len() - before);
                Some((bound, *rest))
            }
            [variables, rest, more, ..] if variables.is_list() => {
                self.sink.unexpected(*more, "the end of the quantifier");
                Some((self.bind(node, *variables), *rest))
            }
            [variables, ..] if !variables.is_list() => {
                self.sink.unexpected(*variables, "a list of variables such as `(?x - type)`");
                None
            }
            _ => {
                self.sink.missing(node, "the quantifier", "body");
                None
            }
        }
    }

    /// Binds the variables of a list; their scope is `quantifier`.
    fn bind(&mut self, quantifier: Node<'_>, variables: Node<'_>) -> Vec<VariableId> {
        let around = std::mem::replace(&mut self.schema.scope, quantifier.span());
        let bound = self.schema.bind(self.world, self.sink, variables.children());
        self.schema.scope = around;
        bound
    }

    /// Reads the arguments of an unknown symbol only for their own errors.
    pub(super) fn stray_terms(&mut self, node: Node<'_>) {
        for part in node.children().skip(1).filter(|part| part.kind() == NodeKind::Variable) {
            self.variable(part);
        }
    }

    /// The parts of `node` behind its head if there are exactly `N`; reports it if not.
    pub(super) fn parts<'t, const N: usize>(
        &mut self,
        node: Node<'t>,
        expected: &'static str,
    ) -> Option<[Node<'t>; N]> {
        let parts: Vec<Node<'t>> = node.children().skip(1).collect();
        let found = parts.try_into().ok();
        if found.is_none() {
            self.sink.unexpected(node, expected);
        }
        found
    }
}
