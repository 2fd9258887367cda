//! `(:writes agent token …)`: who may write what (requirement `:vocabulary`).
//!
//! A token is a bare symbol (any arguments) or `(symbol argument …)`, where arguments are constants, or `_`
//! or variables for any object. A symbol is a predicate, a function or a type, looked up in this order.

use super::body::{Applied, Body};
use super::sink::{Sink, first_word};
use super::world::World;
use crate::diagnostic::{DiagnosticKind, SymbolKind};
use crate::model::{
    Name, ObjectId, Permission, Requirement, Term, TokenPattern, TokenSymbol, TypeSet, Variable,
};
use crate::occurrence::NameKind;
use crate::syntax::{Node, NodeKind};

pub(crate) fn permission(world: &World, sink: &mut Sink, section: Node<'_>) -> Option<Permission> {
    if !world.has(Requirement::Vocabulary) {
        let requirement = Requirement::Vocabulary.as_str();
        sink.report(
            first_word(section),
            DiagnosticKind::NeedsRequirement { name: ":writes".into(), requirement },
        );
    }
    let mut parts = section.children().skip(1);
    let agent = match parts.next() {
        Some(agent) if agent.is_name() => {
            sink.mention(NameKind::Agent, agent, None);
            Name::new(agent.text())
        }
        Some(other) => {
            sink.unexpected(other, "the name of an agent");
            return None;
        }
        None => {
            sink.missing(section, "`:writes`", "agent");
            return None;
        }
    };
    let mut body = Body::new(world, sink);
    let mut tokens = Vec::new();
    for part in parts {
        tokens.extend(body.token(part));
    }
    Some(Permission { agent, tokens, span: section.span() })
}

impl Body<'_> {
    fn token(&mut self, node: Node<'_>) -> Option<TokenPattern> {
        let head = if node.is_list() { node.head() } else { Some(node) };
        let Some(head) = head.filter(|h| h.is_name()) else {
            self.sink.unexpected(node, "a token such as `speaking` or `(is ?r speaking)`");
            return None;
        };
        let text = head.text();
        let world = self.world;
        let itself;
        let (symbol, kind, name, parameters): (_, _, _, &[Variable]) = if let Some(id) = world.predicate(text)
        {
            let p = &world.predicates[id];
            (TokenSymbol::Predicate(id), SymbolKind::Predicate, &p.name, p.variables.parameters())
        } else if let Some(id) = world.function(text) {
            let f = &world.functions[id];
            (TokenSymbol::Function(id), SymbolKind::Function, &f.name, f.variables.parameters())
        } else if let Some(id) = world.type_id(text) {
            let name = &world.types[id].name;
            let variable = Variable { name: Name::new("node"), types: TypeSet::one(id), span: node.span() };
            itself = [variable];
            (TokenSymbol::Type(id), SymbolKind::Type, name, &itself)
        } else {
            world.unknown(self.sink, head, SymbolKind::Token);
            return None;
        };
        let named = match symbol {
            TokenSymbol::Predicate(_) => NameKind::Predicate,
            TokenSymbol::Function(_) => NameKind::Function,
            TokenSymbol::Type(_) => NameKind::Type,
        };
        self.sink.mention(named, head, None);
        let mut arguments = Vec::new();
        if node.is_list() {
            arguments = self.token_arguments(node, &Applied { symbol: kind, name, parameters })?;
        }
        Some(TokenPattern { symbol, arguments, span: node.span() })
    }

    fn token_arguments(&mut self, node: Node<'_>, of: &Applied<'_>) -> Option<Vec<Option<ObjectId>>> {
        let mut arguments = Vec::new();
        let mut sound = true;
        for (i, argument) in node.children().skip(1).enumerate() {
            if argument.kind() == NodeKind::Variable || argument.is("_") {
                arguments.push(None);
            } else if !argument.is_name() {
                self.sink.unexpected(argument, "a constant, a variable or `_`");
                sound = false;
            } else if let Some(object) = self.object(argument) {
                if let Some(parameter) = of.parameters.get(i) {
                    sound &= self.argument_fits(argument, Term::Object(object), of.name, i, &parameter.types);
                }
                arguments.push(Some(object));
            } else {
                sound = false;
                arguments.push(None);
            }
        }
        if sound && arguments.len() != of.parameters.len() {
            let kind = DiagnosticKind::WrongArity {
                symbol: of.symbol,
                name: of.name.clone(),
                expected: of.parameters.len(),
                found: arguments.len(),
                signature: self.world.signature(of.name, of.parameters),
            };
            self.sink.report(node.span(), kind);
        }
        sound.then_some(arguments)
    }
}
