//! Effects: add, delete, assign, `forall`, `when`.

use super::body::Body;
use super::sink::first_word;
use crate::diagnostic::{DiagnosticKind, UnsupportedFeature};
use crate::model::{Application, AssignOperator, AssignedValue, Effect, EffectKind, FunctionValue, TypeSet};
use crate::syntax::Node;

/// The operator of that name.
pub(super) fn assign_operator(head: Node<'_>) -> Option<AssignOperator> {
    Some(match () {
        () if head.is("assign") => AssignOperator::Assign,
        () if head.is("increase") => AssignOperator::Increase,
        () if head.is("decrease") => AssignOperator::Decrease,
        () if head.is("scale-up") => AssignOperator::ScaleUp,
        () if head.is("scale-down") => AssignOperator::ScaleDown,
        () => return None,
    })
}

impl Body<'_> {
    /// Reads an effect; `()` does nothing.
    pub(crate) fn effect(&mut self, node: Node<'_>) -> Effect {
        let (kind, functions) = self.binding(|body| body.effect_kind(node));
        let effect = Effect { kind: kind.unwrap_or_else(|| EffectKind::And(Vec::new())), span: node.span() };
        Self::each_value(functions, effect)
    }

    fn effect_kind(&mut self, node: Node<'_>) -> Option<EffectKind> {
        let Some(head) = node.head() else {
            if !node.is_list() {
                self.sink.unexpected(node, "an effect such as `(p ?x)`");
            }
            return None;
        };
        match () {
            () if head.is("and") => Some(self.all_effects(node)),
            () if head.is("not") => self.delete(node),
            () if head.is("forall") => self.for_all(node),
            () if head.is("when") => self.conditional(node),
            () if (head.is("probabilistic") || head.is("oneof"))
                && self.world.predicate(head.text()).is_none() =>
            {
                self.uncertain(node)
            }
            () => self.add_or_assign(node, head),
        }
    }

    /// `(probabilistic 0.5 (p) …)`, `(oneof (p) …)`: the effects are checked, and not modelled.
    fn uncertain(&mut self, node: Node<'_>) -> Option<EffectKind> {
        self.sink.unsupported(first_word(node), UnsupportedFeature::UncertainEffects);
        for part in node.children().skip(1).filter(|part| part.is_list()) {
            self.effect(part);
        }
        None
    }

    fn all_effects(&mut self, node: Node<'_>) -> EffectKind {
        let mut parts = Vec::new();
        for part in node.children().skip(1) {
            parts.push(self.effect(part));
        }
        EffectKind::And(parts)
    }

    fn delete(&mut self, node: Node<'_>) -> Option<EffectKind> {
        let [inner] = self.parts(node, "`(not (PREDICATE …))`")?;
        let Some(head) = inner.head() else {
            self.sink.unexpected(inner, "a predicate such as `(p ?x)`");
            return None;
        };
        self.changed_atom(inner, head).map(EffectKind::Delete)
    }

    fn for_all(&mut self, node: Node<'_>) -> Option<EffectKind> {
        let (bound, inner) = self.quantifier(node)?;
        let inner = self.effect(inner);
        self.schema.unbind(bound.len());
        Some(EffectKind::Forall(bound, Box::new(inner)))
    }

    fn conditional(&mut self, node: Node<'_>) -> Option<EffectKind> {
        let [condition, effect] = self.parts(node, "`(when CONDITION EFFECT)`")?;
        let condition = self.condition(condition);
        Some(EffectKind::When(condition, Box::new(self.effect(effect))))
    }

    fn add_or_assign(&mut self, node: Node<'_>, head: Node<'_>) -> Option<EffectKind> {
        let operator = assign_operator(head).filter(|_| self.world.predicate(head.text()).is_none());
        match operator {
            Some(operator) => self.assignment(node, operator),
            None => self.changed_atom(node, head).map(EffectKind::Add),
        }
    }

    fn changed_atom(&mut self, node: Node<'_>, head: Node<'_>) -> Option<crate::model::Atom> {
        if !head.is_name() {
            self.sink.unexpected(head, "a predicate or one of `and`, `not`, `forall`, `when`, `assign`");
            return None;
        }
        let Some(id) = self.world.predicate(head.text()) else {
            self.unknown_predicate(node, head);
            return None;
        };
        let predicate = &self.world.predicates[id];
        if predicate.derived {
            self.sink.report(node.span(), DiagnosticKind::DerivedEffect { name: predicate.name.clone() });
        }
        self.atom(node, id)
    }

    /// `(operator (f t …) value)`
    pub(super) fn assignment(&mut self, node: Node<'_>, operator: AssignOperator) -> Option<EffectKind> {
        let [target, value] = self.parts(node, "`(OPERATOR (FUNCTION …) VALUE)`")?;
        let application = self.application(target);
        let Some(application) = application else {
            // The assigned value may have errors of its own, unless it is a term of unknown kind.
            if value.is_list() {
                self.expression(value);
            }
            return None;
        };
        let assigned = match &self.world.functions[application.function].value {
            _ if self.is_undefined(value) && operator == AssignOperator::Assign => AssignedValue::Undefined,
            FunctionValue::Number => AssignedValue::Number(self.expression(value)?),
            FunctionValue::Object(types) => {
                return self.object_assignment(application, (target, types), operator, (node, value));
            }
        };
        Some(EffectKind::Assign(operator, application, assigned))
    }

    fn object_assignment(
        &mut self,
        application: Application,
        (target, types): (Node<'_>, &TypeSet),
        operator: AssignOperator,
        (node, value): (Node<'_>, Node<'_>),
    ) -> Option<EffectKind> {
        if operator != AssignOperator::Assign {
            let name = self.world.functions[application.function].name.clone();
            let kind = DiagnosticKind::WrongValue { name, found: "an object", expected: "a number" };
            self.sink.report(target.span(), kind);
            return None;
        }
        if matches!(self.fluent_value(value), Some(FunctionValue::Object(_))) {
            let (from, from_types) = self.object_fluent(value)?;
            self.check_common((target, types), (value, &from_types));
            return Some(self.assign_value(application, from, from_types, node.span()));
        }
        let term = self.term(value)?;
        self.check_value((target, types), (value, term));
        Some(EffectKind::Assign(operator, application, AssignedValue::Object(term)))
    }
}
