//! Functions as arguments, `(p (f ?x))`, and equations of object fluents.
//!
//! Idea: the function's value gets a slot of its own, and existing forms of the model bind it: in a
//! condition `(exists (?v) (and (= (f ?x) ?v) (p ?v)))`, in an effect `(forall (?v) (when (= (f ?x) ?v) (p
//! ?v)))`. A fluent without a value then makes every atom false, and `undefined` is the absence of a value.
//! A duration or a continuous effect has no place for a quantifier, so it keeps the slots together with
//! their functions.
//!
//! Source: Helmert, "Changes in PDDL 3.1", 2008: object fluents; Kovacs, "BNF definition of PDDL 3.1", 2011.

use super::body::Body;
use crate::Span;
use crate::diagnostic::{DiagnosticKind, SymbolKind};
use crate::model::{
    Application, AssignOperator, AssignedValue, Condition, ConditionKind, Effect, EffectKind, FunctionTerm,
    FunctionValue, Term, TypeSet, VariableId,
};
use crate::syntax::Node;

impl Body<'_> {
    /// Reads a form that can bind the values of functions; returns the functions in it, innermost first.
    pub(super) fn binding<T>(&mut self, read: impl FnOnce(&mut Self) -> T) -> (T, Vec<FunctionTerm>) {
        let before = self.functions.open.len();
        self.functions.binders += 1;
        let result = read(self);
        self.functions.binders -= 1;
        (result, self.functions.open.split_off(before))
    }

    /// `(f ?x)` in the place of a term.
    pub(super) fn function_term(&mut self, node: Node<'_>) -> Option<Term> {
        let application = self.application(node)?;
        let world = self.world;
        let function = &world.functions[application.function];
        let FunctionValue::Object(types) = &function.value else {
            let (name, found, expected) = (function.name.clone(), "a number", "an object");
            self.sink.report(node.span(), DiagnosticKind::WrongValue { name, found, expected });
            return None;
        };
        if self.functions.binders == 0 {
            self.sink.report(node.span(), DiagnosticKind::MisplacedFunction { name: function.name.clone() });
            return None;
        }
        let slot = self.value_slot(&application, types.clone());
        self.functions.open.push(FunctionTerm { slot, application });
        Some(Term::Variable(slot))
    }

    /// A new slot for a function's value. It is never visible, and its name differs from all visible names.
    fn value_slot(&mut self, of: &Application, types: TypeSet) -> VariableId {
        let world = self.world;
        let name = &world.functions[of.function].name;
        let open = self.functions.open.iter().map(|term| term.slot);
        self.schema.hidden(name, &open.collect::<Vec<_>>(), types, of.span)
    }

    /// A condition in which functions stand as arguments.
    pub(super) fn some_value(terms: Vec<FunctionTerm>, inner: Condition) -> Condition {
        if terms.is_empty() {
            return inner;
        }
        let span = inner.span;
        let slots = terms.iter().map(|term| term.slot).collect();
        let mut parts: Vec<Condition> = terms.into_iter().map(is_value).collect();
        parts.push(inner);
        let all = Condition { kind: ConditionKind::And(parts), span };
        Condition { kind: ConditionKind::Exists(slots, Box::new(all)), span }
    }

    /// An effect in which functions stand as arguments.
    pub(super) fn each_value(terms: Vec<FunctionTerm>, inner: Effect) -> Effect {
        if terms.is_empty() {
            return inner;
        }
        let span = inner.span;
        let slots = terms.iter().map(|term| term.slot).collect();
        let parts: Vec<Condition> = terms.into_iter().map(is_value).collect();
        let when = EffectKind::When(all_of(parts, span), Box::new(inner));
        Effect { kind: EffectKind::Forall(slots, Box::new(Effect { kind: when, span })), span }
    }

    /// Whether `node` is the word `undefined`.
    pub(super) fn is_undefined(&self, node: Node<'_>) -> bool {
        node.is("undefined") && self.world.object("undefined").is_none()
    }

    /// `(= (f ?x) undefined)`: the fluent has no value.
    pub(super) fn has_no_value(&mut self, application: Application, types: TypeSet) -> ConditionKind {
        let span = application.span;
        let slot = self.value_slot(&application, types);
        let body = Box::new(is_value(FunctionTerm { slot, application }));
        ConditionKind::Not(Box::new(Condition { kind: ConditionKind::Exists(vec![slot], body), span }))
    }

    /// `(= (f ?x) (g ?y))`: they have the same value, or neither has one.
    pub(super) fn same_value(
        &mut self,
        left: (Application, TypeSet),
        right: (Application, TypeSet),
        span: Span,
    ) -> ConditionKind {
        let slot = self.value_slot(&left.0, left.1.clone());
        let both = vec![
            is_value(FunctionTerm { slot, application: left.0.clone() }),
            is_value(FunctionTerm { slot, application: right.0.clone() }),
        ];
        let both = Box::new(Condition { kind: ConditionKind::And(both), span });
        let same = Condition { kind: ConditionKind::Exists(vec![slot], both), span };
        let neither =
            [left, right].map(|(of, types)| Condition { kind: self.has_no_value(of, types), span }).into();
        let neither = Condition { kind: ConditionKind::And(neither), span };
        ConditionKind::Or(vec![same, neither])
    }

    /// `(assign (f ?x) (g ?y))`: the value of `g`, or `undefined` if `g` has no value.
    pub(super) fn assign_value(
        &mut self,
        target: Application,
        from: Application,
        types: TypeSet,
        span: Span,
    ) -> EffectKind {
        let slot = self.value_slot(&from, types.clone());
        let assign = |to, value| {
            Box::new(Effect { kind: EffectKind::Assign(AssignOperator::Assign, to, value), span })
        };
        let value = AssignedValue::Object(Term::Variable(slot));
        let when = is_value(FunctionTerm { slot, application: from.clone() });
        let kind = EffectKind::When(when, assign(target.clone(), value));
        let some = EffectKind::Forall(vec![slot], Box::new(Effect { kind, span }));
        let none = Condition { kind: self.has_no_value(from, types), span };
        let none = EffectKind::When(none, assign(target, AssignedValue::Undefined));
        EffectKind::And(vec![Effect { kind: some, span }, Effect { kind: none, span }])
    }

    /// The object fluent that `node` applies, with its types; reports any other kind of function.
    pub(super) fn object_fluent(&mut self, node: Node<'_>) -> Option<(Application, TypeSet)> {
        let application = self.application(node)?;
        match &self.world.functions[application.function].value {
            FunctionValue::Object(types) => Some((application, types.clone())),
            FunctionValue::Number => {
                self.world.unknown(self.sink, node, SymbolKind::Object);
                None
            }
        }
    }
}

fn is_value(term: FunctionTerm) -> Condition {
    let span = term.application.span;
    Condition { kind: ConditionKind::FluentIs(term.application, Term::Variable(term.slot)), span }
}

fn all_of(mut parts: Vec<Condition>, span: Span) -> Condition {
    match parts.pop() {
        Some(only) if parts.is_empty() => only,
        last => {
            parts.extend(last);
            Condition { kind: ConditionKind::And(parts), span }
        }
    }
}
