//! From the typed model's effects to changes of the graph.
//!
//! Idea: nested `forall` and `when` become one guard per change. The visible variables of the guard are the variables
//! quantified around the change and the variables that the guard mentions.

use pddl::Span;
use pddl::model::{self, Application, AssignOperator, AssignedValue, EffectKind, VariableId};

use crate::condition::Condition;
use crate::effect::{Change, Effect, Given, Update};
use crate::formula::{Formula, Literal, Term};
use crate::link_error::{LinkError, LinkErrorKind};
use crate::number::Number;
use crate::scope::Scope;
use crate::tokens::{FunctionToken, Tokens, ValueSort};
use crate::translate::{Derived, TermOrValue, Translator};

pub(crate) fn lower<'c>(
    tokens: &Tokens,
    domain: &model::Domain,
    scope: Scope,
    effects: impl IntoIterator<Item = &'c model::Effect>,
) -> Result<Effect, Vec<LinkError>> {
    let mut lowering = Lowering {
        translator: Translator::new(tokens, domain, &scope, Derived::Refused),
        quantified: Vec::new(),
        guards: Vec::new(),
        updates: Vec::new(),
        errors: Vec::new(),
    };
    for effect in effects {
        lowering.effect(effect);
    }
    let Lowering { translator, updates, mut errors, .. } = lowering;
    match translator.finish(updates) {
        Ok(updates) if errors.is_empty() => Ok(Effect { scope, updates }),
        Ok(_) => Err(errors),
        Err(more) => {
            errors.extend(more);
            Err(errors)
        }
    }
}

struct Lowering<'a> {
    translator: Translator<'a>,
    /// The variables quantified around the present place.
    quantified: Vec<VariableId>,
    /// The conditions of `when` around the present place.
    guards: Vec<Formula>,
    updates: Vec<Update>,
    errors: Vec<LinkError>,
}

impl Lowering<'_> {
    fn effect(&mut self, effect: &model::Effect) {
        let span = effect.span;
        match &effect.kind {
            EffectKind::And(parts) => parts.iter().for_each(|part| self.effect(part)),
            EffectKind::Forall(variables, part) => {
                let variables = self.translator.quantified(variables, span);
                let before = self.quantified.len();
                self.quantified.extend(variables);
                self.effect(part);
                self.quantified.truncate(before);
            }
            EffectKind::When(condition, part) => {
                let guard = self.translator.condition(condition);
                self.guards.push(guard);
                self.effect(part);
                self.guards.pop();
            }
            EffectKind::Add(atom) => {
                if let Some((from, label, to)) = edge(&mut self.translator, atom) {
                    self.push(Change::AddEdge { from, label, to }, span);
                }
            }
            EffectKind::Delete(atom) => {
                if let Some((from, label, to)) = edge(&mut self.translator, atom) {
                    self.push(Change::RemoveEdge { from, label, to }, span);
                }
            }
            EffectKind::Assign(operator, application, value) => {
                if let Some(change) = assignment(&mut self.translator, *operator, application, value, span) {
                    self.push(change, span);
                }
            }
        }
    }

    fn push(&mut self, change: Change, span: Span) {
        let guard = if self.quantified.is_empty() && self.guards.is_empty() {
            None
        } else {
            let formula = Formula::All(self.guards.clone());
            let mut visible = formula.free();
            visible.extend(&self.quantified);
            visible.sort_unstable();
            visible.dedup();
            let vocabulary = &self.translator.tokens.vocabulary;
            // A quantified variable of a value was reported already.
            if visible.iter().any(|&variable| !self.translator.scope.is_node(variable)) {
                return;
            }
            match Condition::compile(vocabulary, self.translator.scope, &formula, &visible) {
                Ok(guard) => Some(guard),
                Err(error) => return self.errors.push(error),
            }
        };
        self.updates.push(Update { guard, change, span });
    }
}

/// The edge of an atom. An atom that is not an edge is reported.
pub(crate) fn edge(
    translator: &mut Translator<'_>,
    atom: &model::Atom,
) -> Option<(Term, dsr::LabelId, Term)> {
    let name = &translator.domain.predicates[atom.predicate].name;
    if translator.tokens.label(name).is_none() {
        let (name, vocabulary) = (name.clone(), translator.tokens.name.clone());
        translator.error(atom.span, LinkErrorKind::NotAToken { name, vocabulary });
        return None;
    }
    match translator.edge(atom)? {
        Literal::Edge { from, label, to } => Some((from, label, to)),
        _ => None,
    }
}

/// The change of an assignment. An assignment that the graph cannot make is reported.
pub(crate) fn assignment(
    translator: &mut Translator<'_>,
    operator: AssignOperator,
    application: &Application,
    value: &AssignedValue,
    span: Span,
) -> Option<Change> {
    let name = translator.domain.functions[application.function].name.clone();
    match translator.tokens.function(&name) {
        Some(FunctionToken::Transform) => return transform(translator, application, value, span),
        Some(FunctionToken::Distance) => {
            translator.error(span, LinkErrorKind::Computed { name });
            return None;
        }
        _ => {}
    }
    let (holder, attribute) = translator.attribute(application)?;
    let given = match (operator, value) {
        (AssignOperator::Assign, AssignedValue::Undefined) => {
            return Some(Change::Clear { holder, attribute });
        }
        (AssignOperator::Assign, AssignedValue::Number(expression)) => {
            Given::Number(translator.number(expression)?)
        }
        (AssignOperator::Assign, AssignedValue::Object(term)) => {
            let given = given(translator, *term);
            let fits = match (&given, translator.tokens.vocabulary.kind(attribute)) {
                (Given::Node(_), Some(dsr::Kind::Node(_)))
                | (Given::Value(dsr::Value::Bool(_)), Some(dsr::Kind::Bool)) => true,
                (Given::Result(variable), Some(kind)) => {
                    let value = translator.scope.slot(*variable).value;
                    matches!(
                        (value, kind),
                        (Some(ValueSort::Text), dsr::Kind::Text) | (Some(ValueSort::Flag), dsr::Kind::Bool)
                    )
                }
                _ => false,
            };
            if !fits {
                translator.error(span, LinkErrorKind::WrongValue { name });
                return None;
            }
            given
        }
        (operator, AssignedValue::Number(expression)) => {
            let by = translator.number(expression)?;
            return Some(Change::Adjust { holder, attribute, operator, by });
        }
        _ => {
            translator.error(span, LinkErrorKind::WrongValue { name });
            return None;
        }
    };
    Some(Change::Set { holder, attribute, given })
}

fn given(translator: &Translator<'_>, term: model::Term) -> Given {
    match translator.term(term) {
        TermOrValue::Value(value) => Given::Value(value),
        TermOrValue::Term(Term::Variable(variable)) if !translator.scope.is_node(variable) => {
            Given::Result(variable)
        }
        TermOrValue::Term(term) => Given::Node(term),
    }
}

fn transform(
    translator: &mut Translator<'_>,
    application: &Application,
    value: &AssignedValue,
    span: Span,
) -> Option<Change> {
    let &[parent, child] = application.arguments.as_slice() else { return None };
    let (parent, child) =
        (translator.node(parent, application.span)?, translator.node(child, application.span)?);
    match value {
        AssignedValue::Undefined => Some(Change::RemoveTransform { parent, child }),
        AssignedValue::Object(model::Term::Variable(pose))
            if translator.scope.slot(*pose).value == Some(ValueSort::Pose) =>
        {
            Some(Change::SetTransform { parent, child, pose: *pose })
        }
        _ => {
            let name = translator.domain.functions[application.function].name.clone();
            translator.error(span, LinkErrorKind::WrongValue { name });
            None
        }
    }
}

/// The value of a constant number, for expectations.
pub(crate) fn constant(number: &Number) -> Option<dsr::Value> {
    number.constant().map(dsr::Value::Number)
}
