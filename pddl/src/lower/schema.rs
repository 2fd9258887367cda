//! The variables of the schema that is being read: slots, and which of them are visible.

use super::sink::Sink;
use super::typed_list::{Typed, typed_list};
use super::world::{World, fold};
use crate::Span;
use crate::diagnostic::{DiagnosticKind, Label, SymbolKind};
use crate::model::{Idx, Name, TypeSet, Variable, VariableId, Variables};
use crate::occurrence::NameKind;
use crate::syntax::{Node, NodeKind};

/// Variables with their scopes.
#[derive(Default)]
pub(crate) struct Schema {
    pub(crate) variables: Variables,
    /// Visible ones, outermost first; the last of a name hides the others.
    visible: Vec<VariableId>,
    /// The list that is the scope of the next variables.
    pub(crate) scope: Span,
    /// The scope of each slot that has a declaration in the text.
    scopes: Vec<Span>,
    /// The kind of schema.
    pub(crate) owner: Owner,
}

/// What a schema is read for: it decides which words are values in expressions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Owner {
    /// None of the words below.
    #[default]
    Other,
    /// `?duration` is one.
    Durative,
    /// `total-time` and `is-violated` are.
    Metric,
}

impl Schema {
    pub(crate) fn is_durative(&self) -> bool {
        self.owner == Owner::Durative
    }

    /// The visible slot of that name (without the question mark).
    pub(crate) fn find(&self, name: &str) -> Option<VariableId> {
        let name = fold(name);
        self.visible.iter().rev().copied().find(|&v| *self.variables[v].name == *name)
    }

    /// The list that is the scope of a slot.
    pub(crate) fn scope_of(&self, variable: VariableId) -> Option<Span> {
        self.scopes.get(variable.index()).copied()
    }

    /// The visible names.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.visible.iter().map(|&v| self.variables[v].name.as_str())
    }

    /// Reads parameters: they stay visible.
    pub(crate) fn parameters<'t>(
        &mut self,
        world: &World,
        sink: &mut Sink,
        nodes: impl Iterator<Item = Node<'t>>,
    ) {
        self.bind(world, sink, nodes);
        self.variables.parameters = self.variables.slots.len();
    }

    /// Reads a typed list of variables into new slots and makes them visible.
    pub(crate) fn bind<'t>(
        &mut self,
        world: &World,
        sink: &mut Sink,
        nodes: impl Iterator<Item = Node<'t>>,
    ) -> Vec<VariableId> {
        let items = typed_list(sink, nodes);
        self.bind_typed(world, sink, items)
    }

    /// The same with a list that is split already.
    pub(crate) fn bind_typed(
        &mut self,
        world: &World,
        sink: &mut Sink,
        items: Vec<Typed<'_>>,
    ) -> Vec<VariableId> {
        let mut bound: Vec<VariableId> = Vec::new();
        for (item, types) in items {
            if item.kind() != NodeKind::Variable || item.text().len() < 2 {
                sink.unexpected(item, "a variable such as `?x`");
                continue;
            }
            sink.declare(NameKind::Variable, item, Some(self.scope));
            let name = Name::new(&item.text()[1..]);
            if let Some(&first) = bound.iter().find(|&&v| self.variables[v].name == name) {
                let kind = DiagnosticKind::Duplicate { symbol: SymbolKind::Variable, name };
                sink.report_with(item.span(), kind, self.variables[first].span, Label::First);
                continue;
            }
            let types = world.type_set(sink, types);
            self.scopes.resize(self.variables.slots.len(), self.scope);
            self.scopes.push(self.scope);
            bound.push(self.variables.slots.push(Variable { name, types, span: item.span() }));
        }
        self.visible.extend(&bound);
        bound
    }

    /// A new slot that never becomes visible. Its name is `name`, with a number if a visible slot or one of
    /// `others` has that name.
    pub(crate) fn hidden(
        &mut self,
        name: &Name,
        others: &[VariableId],
        types: TypeSet,
        span: Span,
    ) -> VariableId {
        let is_taken = |wanted: &Name| {
            let mut slots = self.visible.iter().chain(others);
            slots.any(|&v| self.variables[v].name == *wanted)
        };
        let mut free = name.clone();
        let mut number = 2;
        while is_taken(&free) {
            free = Name::new(&format!("{name}-{number}"));
            number += 1;
        }
        self.variables.slots.push(Variable { name: free, types, span })
    }

    /// Hides the last `count` variables.
    pub(crate) fn unbind(&mut self, count: usize) {
        self.visible.truncate(self.visible.len().saturating_sub(count));
    }
}
