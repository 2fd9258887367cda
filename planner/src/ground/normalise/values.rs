//! Compiles object fluents to predicates.
//!
//! Problem: joins, invariants and states support only atoms. Idea: a function `(f ?x) - t` becomes
//! a predicate `(f ?x ?value)`, of which at most one atom per `?x` holds. `(= (f ?x) ?v)` is the
//! atom. An assignment adds the new atom and deletes the others (only one, if the precondition
//! names the old value). `undefined` means that no atom holds. Two simultaneous assignments of one
//! fluent conflict, and the action has no result. Two different values are
//! detected for each instance (`instantiate::effects`). An assignment and an `undefined` of one
//! fluent are forbidden here, in the precondition. Invariant: the new predicates follow those of
//! the domain, in the order of their functions, so every id of the model keeps its meaning. Cost: a
//! copy of the model, but only if there are object fluents.
//!
//! Source: Helmert, "Changes in PDDL 3.1", 2008; Geffner, "Functional STRIPS", 2000.

use crate::task::ValuePredicates;
use pddl::Span;
use pddl::model::{
    Action, Application, AssignedValue, Atom, Condition, ConditionKind, Domain, Effect, EffectKind, Fact,
    FluentValue, FunctionId, FunctionValue, Idx, Predicate, PredicateId, Problem, Term, TypeSet, Variable,
    VariableId, Variables,
};
use rustc_hash::FxHashMap;

/// Returns the model without object fluents; `None` if it has none.
pub(crate) fn compile(domain: &Domain, problem: &Problem) -> Option<(Domain, Problem, ValuePredicates)> {
    let functions: Vec<FunctionId> = domain
        .functions
        .enumerate()
        .filter(|(_, f)| f.value != FunctionValue::Number)
        .map(|(id, _)| id)
        .collect();
    if functions.is_empty() {
        return None;
    }
    let (mut domain, mut problem) = (domain.clone(), problem.clone());
    let mut of: FxHashMap<FunctionId, (PredicateId, TypeSet)> = FxHashMap::default();
    let values = ValuePredicates::new(&domain, functions.clone());
    for id in functions {
        let function = &domain.functions[id];
        let FunctionValue::Object(types) = function.value.clone() else { continue };
        let mut slots = function.variables.parameters().to_vec();
        let variable = Variable { name: function.name.clone(), types: types.clone(), span: function.span };
        slots.push(variable);
        let variables = Variables { parameters: slots.len(), slots: slots.into() };
        let predicate =
            Predicate { name: function.name.clone(), variables, derived: false, span: function.span };
        of.insert(id, (domain.predicates.push(predicate), types));
    }
    let compiler = Compiler { of };
    domain.actions.iter_mut().for_each(|action| compiler.action(action));
    domain.axioms.iter_mut().for_each(|axiom| compiler.condition(&mut axiom.body));
    compiler.condition(&mut problem.goal);
    problem.fluents.retain(|fluent| match (compiler.of.get(&fluent.application.function), fluent.value) {
        (Some((predicate, _)), FluentValue::Object(value)) => {
            let mut arguments = fluent.application.arguments.clone();
            arguments.push(value);
            problem.init.push(Fact { predicate: *predicate, arguments, span: fluent.span });
            false
        }
        _ => true,
    });
    Some((domain, problem, values))
}

struct Compiler {
    of: FxHashMap<FunctionId, (PredicateId, TypeSet)>,
}

/// An assignment with its quantifiers and conditions.
#[derive(Clone)]
struct Assignment {
    quantified: Vec<VariableId>,
    conditions: Vec<Condition>,
    fluent: Application,
    /// Whether the fluent gets a value or becomes undefined.
    gives: bool,
}

impl Compiler {
    fn atom(&self, fluent: &Application, value: Term) -> Option<Atom> {
        let (predicate, _) = self.of.get(&fluent.function)?;
        let mut arguments = fluent.arguments.clone();
        arguments.push(value);
        Some(Atom { predicate: *predicate, arguments, span: fluent.span })
    }

    fn condition(&self, condition: &mut Condition) {
        match &mut condition.kind {
            ConditionKind::And(parts) | ConditionKind::Or(parts) => {
                parts.iter_mut().for_each(|part| self.condition(part));
            }
            ConditionKind::Not(inner) | ConditionKind::Exists(_, inner) | ConditionKind::Forall(_, inner) => {
                self.condition(inner);
            }
            ConditionKind::Imply(left, right) => {
                self.condition(left);
                self.condition(right);
            }
            ConditionKind::FluentIs(fluent, value) => {
                if let Some(atom) = self.atom(fluent, *value) {
                    condition.kind = ConditionKind::Atom(atom);
                }
            }
            ConditionKind::Atom(_)
            | ConditionKind::HasType(..)
            | ConditionKind::Same(..)
            | ConditionKind::Compare(..) => {}
        }
    }

    fn action(&self, action: &mut Action) {
        let mut assignments = Vec::new();
        self.assignments(&action.effect, &[], &[], &mut assignments);
        let mut needs = vec![action.precondition.clone()];
        for taken in assignments.iter().filter(|a| !a.gives) {
            for given in assignments.iter().filter(|a| a.gives && a.fluent.function == taken.fluent.function)
            {
                needs.extend(apart(taken, given));
            }
        }
        let known = known_values(&action.precondition);
        self.effect(&mut action.effect, &known, &mut action.variables);
        if needs.len() > 1 {
            action.precondition = all(needs, action.precondition.span);
        }
        self.condition(&mut action.precondition);
    }

    fn assignments(
        &self,
        effect: &Effect,
        quantified: &[VariableId],
        conditions: &[Condition],
        found: &mut Vec<Assignment>,
    ) {
        match &effect.kind {
            EffectKind::And(parts) => {
                parts.iter().for_each(|part| self.assignments(part, quantified, conditions, found));
            }
            EffectKind::Forall(vs, inner) => {
                self.assignments(inner, &[quantified, vs].concat(), conditions, found);
            }
            EffectKind::When(when, inner) => {
                let mut all = conditions.to_vec();
                all.push(when.clone());
                self.assignments(inner, quantified, &all, found);
            }
            EffectKind::Assign(_, fluent, value) if self.of.contains_key(&fluent.function) => {
                found.push(Assignment {
                    quantified: quantified.to_vec(),
                    conditions: conditions.to_vec(),
                    fluent: fluent.clone(),
                    gives: !matches!(value, AssignedValue::Undefined),
                });
            }
            EffectKind::Assign(..) | EffectKind::Add(_) | EffectKind::Delete(_) => {}
        }
    }

    fn effect(&self, effect: &mut Effect, known: &[(Application, Term)], variables: &mut Variables) {
        let span = effect.span;
        match &mut effect.kind {
            EffectKind::And(parts) => parts.iter_mut().for_each(|part| self.effect(part, known, variables)),
            EffectKind::Forall(_, inner) => self.effect(inner, known, variables),
            EffectKind::When(when, inner) => {
                self.condition(when);
                self.effect(inner, known, variables);
            }
            EffectKind::Assign(_, fluent, value) => {
                let Some((_, types)) = self.of.get(&fluent.function) else { return };
                let before = known.iter().find(|(other, _)| same_fluent(other, fluent)).map(|(_, v)| *v);
                let delete = |old: Term| {
                    self.atom(fluent, old).map(|atom| Effect { kind: EffectKind::Delete(atom), span })
                };
                let mut parts = Vec::new();
                match before {
                    Some(old) => parts.extend(delete(old)),
                    None => {
                        let slot = variables.slots.push(Variable {
                            name: variables_name(variables, fluent),
                            types: types.clone(),
                            span,
                        });
                        parts.extend(delete(Term::Variable(slot)).map(|inner| Effect {
                            kind: EffectKind::Forall(vec![slot], Box::new(inner)),
                            span,
                        }));
                    }
                }
                if let AssignedValue::Object(new) = value
                    && let Some(atom) = self.atom(fluent, *new)
                {
                    parts.push(Effect { kind: EffectKind::Add(atom), span });
                }
                effect.kind = EffectKind::And(parts);
            }
            EffectKind::Add(_) | EffectKind::Delete(_) => {}
        }
    }
}

/// Any name will do, because it is never looked up.
fn variables_name(variables: &Variables, fluent: &Application) -> pddl::model::Name {
    let named = variables.slots.iter().next().map(|v| v.name.clone());
    named.unwrap_or_else(|| pddl::model::Name::new(&format!("value-{}", fluent.function.index())))
}

fn same_fluent(a: &Application, b: &Application) -> bool {
    a.function == b.function && a.arguments == b.arguments
}

/// The values of fluents that a conjunction requires.
fn known_values(condition: &Condition) -> Vec<(Application, Term)> {
    match &condition.kind {
        ConditionKind::And(parts) => parts.iter().flat_map(known_values).collect(),
        ConditionKind::FluentIs(fluent, value) => vec![(fluent.clone(), *value)],
        _ => Vec::new(),
    }
}

/// The condition that the two assignments do not both happen to one fluent; `None` if they cannot.
fn apart(taken: &Assignment, given: &Assignment) -> Option<Condition> {
    let span = taken.fluent.span;
    let undefined: Vec<&Application> = taken.conditions.iter().flat_map(without_value).collect();
    let defined: Vec<(Application, Term)> = given.conditions.iter().flat_map(known_values).collect();
    if undefined.iter().any(|u| defined.iter().any(|(d, _)| same_fluent(u, d))) {
        return None;
    }
    let mut parts: Vec<Condition> = taken.conditions.iter().chain(&given.conditions).cloned().collect();
    for (&left, &right) in taken.fluent.arguments.iter().zip(&given.fluent.arguments) {
        parts.push(Condition { kind: ConditionKind::Same(left, right), span });
    }
    let mut both = all(parts, span);
    let quantified = [taken.quantified.as_slice(), &given.quantified].concat();
    if !quantified.is_empty() {
        both = Condition { kind: ConditionKind::Exists(quantified, Box::new(both)), span };
    }
    Some(Condition { kind: ConditionKind::Not(Box::new(both)), span })
}

/// The fluents that a conjunction requires to be undefined.
fn without_value(condition: &Condition) -> Vec<&Application> {
    match &condition.kind {
        ConditionKind::And(parts) => parts.iter().flat_map(without_value).collect(),
        ConditionKind::Not(inner) => match &inner.kind {
            ConditionKind::Exists(vs, body) => match &body.kind {
                ConditionKind::FluentIs(fluent, Term::Variable(v)) if vs.contains(v) => vec![fluent],
                _ => Vec::new(),
            },
            _ => Vec::new(),
        },
        _ => Vec::new(),
    }
}

fn all(parts: Vec<Condition>, span: Span) -> Condition {
    Condition { kind: ConditionKind::And(parts), span }
}
