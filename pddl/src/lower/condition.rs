//! Conditions: preconditions, goals, bodies of axioms, guards.
//!
//! `and`, `or`, `not`, `imply`, `forall`, `exists` and the comparisons are reserved; every other word of
//! PDDL may name a predicate. `=` compares terms, numbers or a fluent with its value, depending on its
//! sides.

use super::body::{Applied, Body};
use super::constraint::is_modal;
use super::sink::first_word;
use crate::Span;
use crate::diagnostic::{DiagnosticKind, SymbolKind};
use crate::model::{
    Atom, Comparison, Condition, ConditionKind, FunctionValue, Name, ObjectId, PredicateId, Term, TypeId,
    TypeSet, Variable,
};
use crate::occurrence::NameKind;
use crate::syntax::{Node, NodeKind};

impl Body<'_> {
    /// Reads a condition; `()` always holds.
    pub(crate) fn condition(&mut self, node: Node<'_>) -> Condition {
        let (kind, functions) = self.binding(|body| body.condition_kind(node));
        let condition = Condition { kind: kind.unwrap_or_else(always), span: node.span() };
        Self::some_value(functions, condition)
    }

    fn condition_kind(&mut self, node: Node<'_>) -> Option<ConditionKind> {
        let Some(head) = node.head() else {
            if !node.is_list() {
                self.sink.unexpected(node, "a condition such as `(p ?x)`");
            }
            return None;
        };
        match () {
            () if head.is("and") => Some(ConditionKind::And(self.junction(node))),
            () if head.is("or") => Some(ConditionKind::Or(self.junction(node))),
            () if head.is("not") => self.negation(node),
            () if head.is("imply") => self.implication(node),
            () if head.is("forall") => self.quantified(node, ConditionKind::Forall),
            () if head.is("exists") => self.quantified(node, ConditionKind::Exists),
            () if head.is("=") => self.equality(node),
            () if head.is("<") => self.comparison(node, Comparison::Less),
            () if head.is("<=") => self.comparison(node, Comparison::LessEqual),
            () if head.is(">=") => self.comparison(node, Comparison::GreaterEqual),
            () if head.is(">") => self.comparison(node, Comparison::Greater),
            () => self.literal(node, head),
        }
    }

    fn junction(&mut self, node: Node<'_>) -> Vec<Condition> {
        let mut parts = Vec::new();
        for part in node.children().skip(1) {
            parts.push(self.condition(part));
        }
        parts
    }

    fn negation(&mut self, node: Node<'_>) -> Option<ConditionKind> {
        let [inner] = self.parts(node, "`(not CONDITION)`")?;
        Some(ConditionKind::Not(Box::new(self.condition(inner))))
    }

    fn implication(&mut self, node: Node<'_>) -> Option<ConditionKind> {
        let [if_, then] = self.parts(node, "`(imply CONDITION CONDITION)`")?;
        let if_ = Box::new(self.condition(if_));
        Some(ConditionKind::Imply(if_, Box::new(self.condition(then))))
    }

    fn quantified(
        &mut self,
        node: Node<'_>,
        make: fn(Vec<crate::model::VariableId>, Box<Condition>) -> ConditionKind,
    ) -> Option<ConditionKind> {
        let (bound, inner) = self.quantifier(node)?;
        let inner = self.condition(inner);
        self.schema.unbind(bound.len());
        Some(make(bound, Box::new(inner)))
    }

    /// A predicate, or a form that only some requirements or places allow.
    fn literal(&mut self, node: Node<'_>, head: Node<'_>) -> Option<ConditionKind> {
        if !head.is_name() {
            self.sink
                .unexpected(head, "a predicate or one of `and`, `or`, `not`, `imply`, `forall`, `exists`");
            return None;
        }
        if let Some(sort) = sort(node) {
            return self.sort(sort);
        }
        if let Some(predicate) = self.world.predicate(head.text()) {
            return self.atom(node, predicate).map(ConditionKind::Atom);
        }
        if let Some(id) = self.world.type_id(head.text()) {
            return self.type_predicate(node, head, id);
        }
        self.unknown_predicate(node, head);
        None
    }

    /// `(truck ?x)`, where `truck` is a type and no predicate has that name.
    fn type_predicate(&mut self, node: Node<'_>, head: Node<'_>, id: TypeId) -> Option<ConditionKind> {
        self.sink.mention(NameKind::Type, head, None);
        let types = TypeSet::any();
        let variable = Variable { name: Name::new("x"), types, span: head.span() };
        let world = self.world;
        let of = Applied { symbol: SymbolKind::Type, name: &world.types[id].name, parameters: &[variable] };
        let term = *self.arguments(node, node.children().skip(1), &of)?.first()?;
        Some(ConditionKind::HasType(term, TypeSet::one(id)))
    }

    fn sort(&mut self, (term, types): (Node<'_>, Node<'_>)) -> Option<ConditionKind> {
        let (term, types) = (self.term(term), self.world.type_set(self.sink, Some(types)));
        Some(ConditionKind::HasType(term?, types))
    }

    /// Reports a head that is not a predicate; some words have a meaning in other places.
    pub(super) fn unknown_predicate(&mut self, node: Node<'_>, head: Node<'_>) {
        if head.is("preference") {
            self.misplaced_preference(node);
        } else if is_modal(head) {
            let operator = head.text().to_ascii_lowercase();
            self.sink.report(first_word(node), DiagnosticKind::MisplacedOperator { operator });
        } else {
            self.world.unknown(self.sink, head, SymbolKind::Predicate);
            self.stray_terms(node);
        }
    }

    /// `(p t …)` with a known predicate.
    pub(super) fn atom(&mut self, node: Node<'_>, id: PredicateId) -> Option<Atom> {
        if let Some(head) = node.head() {
            self.sink.mention(NameKind::Predicate, head, None);
        }
        let predicate = &self.world.predicates[id];
        let of = Applied {
            symbol: SymbolKind::Predicate,
            name: &predicate.name,
            parameters: predicate.variables.parameters(),
        };
        let arguments = self.arguments(node, node.children().skip(1), &of)?;
        Some(Atom { predicate: id, arguments, span: node.span() })
    }

    fn equality(&mut self, node: Node<'_>) -> Option<ConditionKind> {
        let [left, right] = self.parts(node, "`(= LEFT RIGHT)`")?;
        let (l, r) = (self.fluent_value(left), self.fluent_value(right));
        match (l, r) {
            (Some(FunctionValue::Object(_)), Some(FunctionValue::Object(_))) => {
                self.fluents_equal(left, right, node.span())
            }
            (Some(FunctionValue::Object(types)), _) => self.fluent_is(left, &types, right),
            (_, Some(FunctionValue::Object(types))) => self.fluent_is(right, &types, left),
            (Some(FunctionValue::Number), _) if self.is_undefined(right) => self.no_number(left),
            (_, Some(FunctionValue::Number)) if self.is_undefined(left) => self.no_number(right),
            _ if self.is_numeric(left) || self.is_numeric(right) => self.comparison(node, Comparison::Equal),
            _ => self.same(left, right),
        }
    }

    /// `(= (f) undefined)` of a numeric fluent. A fluent without a value makes every comparison false, even
    /// one with itself.
    fn no_number(&mut self, node: Node<'_>) -> Option<ConditionKind> {
        let value = Box::new(self.expression(node)?);
        let kind = ConditionKind::Compare(Comparison::Equal, value.clone(), value);
        Some(ConditionKind::Not(Box::new(Condition { kind, span: node.span() })))
    }

    fn fluent_is(&mut self, fluent: Node<'_>, types: &TypeSet, value: Node<'_>) -> Option<ConditionKind> {
        let application = self.application(fluent);
        if self.is_undefined(value) {
            return Some(self.has_no_value(application?, types.clone()));
        }
        let term = self.term(value)?;
        self.check_value((fluent, types), (value, term));
        Some(ConditionKind::FluentIs(application?, term))
    }

    fn fluents_equal(&mut self, left: Node<'_>, right: Node<'_>, span: Span) -> Option<ConditionKind> {
        let (l, r) = (self.object_fluent(left), self.object_fluent(right));
        let (l, r) = (l?, r?);
        self.check_common((left, &l.1), (right, &r.1));
        Some(self.same_value(l, r, span))
    }

    fn same(&mut self, left: Node<'_>, right: Node<'_>) -> Option<ConditionKind> {
        let (l, r) = (self.term(left), self.term(right));
        Some(ConditionKind::Same(l?, r?))
    }

    fn comparison(&mut self, node: Node<'_>, comparison: Comparison) -> Option<ConditionKind> {
        let [left, right] = self.parts(node, "two numbers to compare")?;
        let left = self.expression(left);
        let right = self.expression(right);
        Some(ConditionKind::Compare(comparison, Box::new(left?), Box::new(right?)))
    }

    /// The kind of value of the function that `node` applies, if it applies one. A bare name is an object
    /// first.
    pub(super) fn fluent_value(&self, node: Node<'_>) -> Option<FunctionValue> {
        let head = if node.is_list() { node.head()? } else { node };
        if !node.is_list() && self.world.object(node.text()).is_some() {
            return None;
        }
        self.world.function(head.text()).map(|f| self.world.functions[f].value.clone())
    }

    fn is_numeric(&self, node: Node<'_>) -> bool {
        match node.kind() {
            NodeKind::List => true,
            NodeKind::Number => self.world.object(node.text()).is_none(),
            NodeKind::Variable => self.schema.is_durative() && node.is("?duration"),
            NodeKind::Name => self.fluent_value(node) == Some(FunctionValue::Number),
            NodeKind::Keyword => false,
        }
    }

    /// Reads `(p a …)` of objects without a schema: the fast path for initial states.
    pub(super) fn ground_arguments<'t>(
        &mut self,
        whole: Node<'t>,
        nodes: impl Iterator<Item = Node<'t>>,
        of: &Applied<'_>,
    ) -> Option<Vec<ObjectId>> {
        let mut objects = Vec::with_capacity(of.parameters.len());
        let mut sound = true;
        let mut count = 0;
        for node in nodes {
            let object = match self.ground_term(node) {
                Some(object) => {
                    if let Some(parameter) = of.parameters.get(count) {
                        sound &=
                            self.argument_fits(node, Term::Object(object), of.name, count, &parameter.types);
                    }
                    object
                }
                None => {
                    sound = false;
                    ObjectId(0)
                }
            };
            objects.push(object);
            count += 1;
        }
        (self.count_fits(whole, of, count) && sound).then_some(objects)
    }

    fn ground_term(&mut self, node: Node<'_>) -> Option<ObjectId> {
        if node.is_name() {
            return self.object(node);
        }
        match node.head().and_then(|head| self.world.function(head.text())) {
            Some(function) => {
                let name = self.world.functions[function].name.clone();
                self.sink.report(node.span(), DiagnosticKind::MisplacedFunction { name });
            }
            None => self.sink.unexpected(node, "an object"),
        }
        None
    }
}

/// The term and the type of HDDL's `(sort ?x - t)` or `(sortof ?x - t)`.
fn sort<'t>(node: Node<'t>) -> Option<(Node<'t>, Node<'t>)> {
    let mut parts = node.children();
    let (head, term, hyphen, types) = (parts.next()?, parts.next()?, parts.next()?, parts.next()?);
    let is_sort = (head.is("sort") || head.is("sortof")) && hyphen.is("-") && parts.next().is_none();
    is_sort.then_some((term, types))
}

fn always() -> ConditionKind {
    ConditionKind::And(Vec::new())
}
