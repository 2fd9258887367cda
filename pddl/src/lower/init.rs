//! `(:init …)`: ground facts and values.
//!
//! Initial states make files long, so a fact costs one lookup for each word and one vector, and no schema.

use super::body::{Applied, Body};
use super::sink::first_word;
use crate::diagnostic::{SymbolKind, UnsupportedFeature};
use crate::model::{
    Fact, FluentFact, FluentValue, FunctionValue, GroundApplication, ObjectId, PredicateId, Term,
    TimedChange, TimedInitial,
};
use crate::occurrence::NameKind;
use crate::syntax::{Node, NodeKind};

/// The initial state.
#[derive(Default)]
pub(crate) struct Init {
    pub(crate) facts: Vec<Fact>,
    pub(crate) fluents: Vec<FluentFact>,
    pub(crate) timed: Vec<TimedInitial>,
}

/// The two sides of an equation in `:init`.
enum Initial {
    Value(FluentFact),
    Undefined(GroundApplication),
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
                // Every fluent without a value is undefined, so the equation adds nothing.
                if let Some(Initial::Value(fluent)) = self.initial_value(node) {
                    into.fluents.push(fluent);
                }
            } else if head.is("not") {
                // A negative fact holds by default: it is checked and left out.
                self.negative_fact(node);
            } else if head.is("and") {
                self.init(node.children().skip(1), into);
            } else if ["oneof", "unknown", "or"].iter().any(|word| head.is(word)) {
                self.uncertain_facts(node);
            } else if self.is_timed(node) {
                self.timed_initial(node, into);
            } else if head.is_name() {
                self.world.unknown(self.sink, head, SymbolKind::Predicate);
            } else {
                self.sink.unexpected(head, "a predicate");
            }
        }
    }

    /// `(oneof (p) (q))`: the facts are checked, and not modelled.
    fn uncertain_facts(&mut self, node: Node<'_>) {
        self.sink.unsupported(first_word(node), UnsupportedFeature::UncertainInitialStates);
        self.init(node.children().skip(1), &mut Init::default());
    }

    /// `(at 5 (p))`; the arguments of a predicate called `at` are not lists.
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

    /// `(not (p a))`
    fn negative_fact(&mut self, node: Node<'_>) -> Option<Fact> {
        let [inner] = self.parts(node, "`(not (PREDICATE …))`")?;
        match inner.head().map(|h| (h, self.world.predicate(h.text()))) {
            Some((_, Some(predicate))) => {
                let arguments = self.fact(inner, predicate)?;
                return Some(Fact { predicate, arguments, span: inner.span() });
            }
            Some((head, None)) => self.world.unknown(self.sink, head, SymbolKind::Predicate),
            None => self.sink.unexpected(inner, "a fact such as `(p a)`"),
        }
        None
    }

    /// `(at 5 (p a))`
    fn timed_initial(&mut self, node: Node<'_>, into: &mut Init) {
        const EXPECTED: &str = "`(at TIME FACT)`";
        let Some([time, what]) = self.parts(node, EXPECTED) else { return };
        let time = self.seconds(time);
        let parts: Vec<Node<'_>> = match what.is_headed("and") && self.world.predicate("and").is_none() {
            true => what.children().skip(1).collect(),
            false => vec![what],
        };
        for part in parts {
            let change = self.timed_change(part);
            if let (Some(time), Some(change)) = (time, change) {
                into.timed.push(TimedInitial { time, change, span: node.span() });
            }
        }
    }

    fn timed_change(&mut self, node: Node<'_>) -> Option<TimedChange> {
        let Some(head) = node.head() else {
            self.sink.unexpected(node, "a fact such as `(p a)` or `(= (f a) 5)`");
            return None;
        };
        if let Some(predicate) = self.world.predicate(head.text()) {
            let arguments = self.fact(node, predicate)?;
            return Some(TimedChange::Add(Fact { predicate, arguments, span: node.span() }));
        }
        if head.is("=") {
            return Some(match self.initial_value(node)? {
                Initial::Value(fluent) => TimedChange::Assign(fluent),
                Initial::Undefined(application) => TimedChange::Undefine(application),
            });
        }
        if head.is("not") {
            return self.negative_fact(node).map(TimedChange::Delete);
        }
        self.world.unknown(self.sink, head, SymbolKind::Predicate);
        None
    }

    fn initial_value(&mut self, node: Node<'_>) -> Option<Initial> {
        let [target, value] = self.parts(node, "`(= (FUNCTION …) VALUE)`")?;
        let head = if target.is_list() { target.head() } else { Some(target) };
        let Some(head) = head.filter(|h| h.is_name()) else {
            self.sink.unexpected(target, "a function such as `(f a)`");
            return None;
        };
        let Some(id) = self.world.function(head.text()) else {
            self.world.unknown(self.sink, head, SymbolKind::Function);
            return None;
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
            let application = GroundApplication { function: id, arguments: arguments? };
            return Some(Initial::Undefined(application));
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
                self.check_value((target, types), (value, Term::Object(object)));
                FluentValue::Object(object)
            }),
            FunctionValue::Object(_) => {
                self.sink.unexpected(value, "an object");
                None
            }
        };
        let application = GroundApplication { function: id, arguments: arguments? };
        Some(Initial::Value(FluentFact { application, value: value?, span: node.span() }))
    }
}
