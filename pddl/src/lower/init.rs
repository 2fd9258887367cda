//! `(:init …)`: ground facts and values.
//!
//! This is where files are long, so a fact costs one lookup a word and one vector, and no schema.

use super::body::{Applied, Body};
use crate::analysis::NameKind;
use crate::diagnostic::{SymbolKind, UnsupportedFeature};
use crate::model::{
    Fact, FluentFact, FluentValue, FunctionValue, GroundApplication, ObjectId, PredicateId, Term,
};
use crate::syntax::{Node, NodeKind};

/// The initial state.
#[derive(Default)]
pub(crate) struct Init {
    pub(crate) facts: Vec<Fact>,
    pub(crate) fluents: Vec<FluentFact>,
}

impl Body<'_> {
    pub(crate) fn init<'t>(&mut self, nodes: impl Iterator<Item = Node<'t>>, into: &mut Init) {
        for node in nodes {
            let Some(head) = node.head() else {
                self.sink.unexpected(node, "a fact such as `(p a)` or `(= (f a) 5)`");
                continue;
            };
            if let Some(predicate) = self.world.predicate(head.text())
                && !self.is_timed(node)
            {
                if let Some(arguments) = self.fact(node, predicate) {
                    into.facts.push(Fact { predicate, arguments, span: node.span() });
                }
            } else if head.is("=") {
                self.initial_value(node, into);
            } else if head.is("not") {
                self.initially_false(node);
            } else if head.is("and") {
                self.init(node.children().skip(1), into);
            } else if self.is_timed(node) {
                self.sink.unsupported(node.span(), UnsupportedFeature::TimedInitialLiterals);
            } else if head.is_name() {
                self.world.unknown(self.sink, head, SymbolKind::Predicate);
            } else {
                self.sink.unexpected(head, "a predicate");
            }
        }
    }

    /// `(at 5 (p))`: a predicate called `at` has no list as argument.
    fn is_timed(&self, node: Node<'_>) -> bool {
        let mut parts = node.children();
        parts.next().is_some_and(|h| h.is("at"))
            && parts.next().is_some_and(|t| t.kind() == NodeKind::Number)
            && parts.next().is_some_and(Node::is_list)
    }

    fn fact(&mut self, node: Node<'_>, id: PredicateId) -> Option<Vec<ObjectId>> {
        if let Some(head) = node.head() {
            self.sink.mention(NameKind::Predicate, head, None);
        }
        let predicate = &self.world.predicates[id];
        let of = Applied {
            symbol: SymbolKind::Predicate,
            name: &predicate.name,
            parameters: predicate.variables.parameters(),
        };
        self.ground_arguments(node, node.children().skip(1), &of)
    }

    /// `(not (p a))` says what holds anyway; it is checked and left out.
    fn initially_false(&mut self, node: Node<'_>) {
        let Some([inner]) = self.parts(node, "`(not (PREDICATE …))`") else { return };
        match inner.head().map(|h| (h, self.world.predicate(h.text()))) {
            Some((_, Some(predicate))) => {
                self.fact(inner, predicate);
            }
            Some((head, None)) => self.world.unknown(self.sink, head, SymbolKind::Predicate),
            None => self.sink.unexpected(inner, "a fact such as `(p a)`"),
        }
    }

    fn initial_value(&mut self, node: Node<'_>, into: &mut Init) {
        let Some([target, value]) = self.parts(node, "`(= (FUNCTION …) VALUE)`") else { return };
        let head = if target.is_list() { target.head() } else { Some(target) };
        let Some(head) = head.filter(|h| h.is_name()) else {
            return self.sink.unexpected(target, "a function such as `(f a)`");
        };
        let Some(id) = self.world.function(head.text()) else {
            return self.world.unknown(self.sink, head, SymbolKind::Function);
        };
        self.sink.mention(NameKind::Function, head, None);
        let function = &self.world.functions[id];
        let of = Applied {
            symbol: SymbolKind::Function,
            name: &function.name,
            parameters: function.variables.parameters(),
        };
        let arguments = self.ground_arguments(target, target.children().skip(1), &of);
        if value.is("undefined") && self.world.object("undefined").is_none() {
            return;
        }
        let value = match &function.value {
            FunctionValue::Number if value.kind() == NodeKind::Number => {
                value.text().parse().ok().map(FluentValue::Number)
            }
            FunctionValue::Number => {
                self.sink.unexpected(value, "a number");
                None
            }
            FunctionValue::Object(types) if value.is_name() => self.object(value).map(|object| {
                let found = self.term_types(Term::Object(object));
                self.check_common((target, types), (value, &found));
                FluentValue::Object(object)
            }),
            FunctionValue::Object(_) => {
                self.sink.unexpected(value, "an object");
                None
            }
        };
        if let (Some(arguments), Some(value)) = (arguments, value) {
            let application = GroundApplication { function: id, arguments };
            into.fluents.push(FluentFact { application, value, span: node.span() });
        }
    }
}
