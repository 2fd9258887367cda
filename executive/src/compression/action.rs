//! One durative action as two steps: the whole, and the rest once it has started.

use super::error::CompressionError;
use super::logic::{conjunction, disjunction, is_always, is_never, negation, quantified};
use pddl::Span;
use pddl::model::{
    Action, Application, AssignOperator, AssignedValue, Atom, Condition, ConditionKind, Domain,
    DurativeAction, Effect, EffectKind, Expression, ExpressionKind, Name, PredicateId, Term, TimeSpecifier,
};
use std::collections::BTreeSet;

/// A literal that holds only while an action runs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Passing {
    pub(super) giver: Name,
    pub(super) predicate: PredicateId,
    pub(super) positive: bool,
}

pub(super) struct Compressing<'d> {
    domain: &'d Domain,
    action: &'d DurativeAction,
    /// The effects at start on atoms, unconditional ones: whether it adds, and the atom.
    given: Vec<(bool, &'d Atom)>,
    /// The changes of numbers at start that are unconditional.
    numbers: Vec<(AssignOperator, &'d Application, &'d Expression)>,
    /// The predicates and functions that the start changes under a condition, or for each of some objects.
    opaque: BTreeSet<Name>,
    /// The predicates that axioms derive from what the start changes.
    derived: BTreeSet<PredicateId>,
}

impl<'d> Compressing<'d> {
    pub(super) fn new(domain: &'d Domain, action: &'d DurativeAction) -> Result<Self, CompressionError> {
        let (given, numbers, opaque) = (Vec::new(), Vec::new(), BTreeSet::new());
        let mut new = Self { domain, action, given, numbers, opaque, derived: BTreeSet::new() };
        for timed in action.effects.iter().filter(|timed| timed.when == TimeSpecifier::Start) {
            new.note(&timed.effect, true);
        }
        let mut changed: BTreeSet<PredicateId> = new.given.iter().map(|(_, atom)| atom.predicate).collect();
        let opaque = |name: &Name| domain.predicate(name);
        changed.extend(new.opaque.iter().filter_map(opaque));
        loop {
            let before = new.derived.len();
            for axiom in &domain.axioms {
                let mut reads = false;
                axiom.body.each(&mut |part| {
                    if let ConditionKind::Atom(atom) = &part.kind {
                        reads |= changed.contains(&atom.predicate) || new.derived.contains(&atom.predicate);
                    }
                });
                if reads {
                    new.derived.insert(axiom.predicate);
                }
            }
            if new.derived.len() == before {
                return Ok(new);
            }
        }
    }

    fn note(&mut self, effect: &'d Effect, plain: bool) {
        match &effect.kind {
            EffectKind::And(parts) => parts.iter().for_each(|part| self.note(part, plain)),
            EffectKind::Add(atom) if plain => self.given.push((true, atom)),
            EffectKind::Delete(atom) if plain => self.given.push((false, atom)),
            EffectKind::Assign(operator, application, AssignedValue::Number(value)) if plain => {
                self.numbers.push((*operator, application, value));
            }
            EffectKind::Add(atom) | EffectKind::Delete(atom) => {
                self.opaque.insert(self.domain.predicates[atom.predicate].name.clone());
            }
            EffectKind::Assign(_, application, _) => {
                self.opaque.insert(self.domain.functions[application.function].name.clone());
            }
            EffectKind::Forall(_, part) | EffectKind::When(_, part) => self.note(part, false),
        }
    }

    fn conditions(&self, wanted: impl Fn(&TimeSpecifier) -> bool) -> impl Iterator<Item = &'d Condition> {
        let timed = self.action.conditions.iter().filter(move |timed| wanted(&timed.when));
        timed.map(|timed| &timed.condition)
    }

    fn effects(&self, when: &TimeSpecifier) -> impl Iterator<Item = &'d Effect> {
        self.action.effects.iter().filter(move |timed| timed.when == *when).map(|timed| &timed.effect)
    }

    fn action(&self, precondition: Vec<Condition>, effect: Vec<Effect>) -> Action {
        let span = self.action.name_span;
        Action {
            name: self.action.name.clone(),
            variables: self.action.variables.clone(),
            precondition: Condition { kind: ConditionKind::And(precondition), span },
            preferences: Vec::new(),
            effect: Effect { kind: EffectKind::And(effect), span },
            span: self.action.span,
            name_span: self.action.name_span,
        }
    }

    fn marker(&self, under_way: PredicateId) -> Atom {
        let arguments = self.action.variables.parameter_ids().map(Term::Variable).collect();
        Atom { predicate: under_way, arguments, span: self.action.name_span }
    }

    pub(super) fn rest(&self, under_way: PredicateId) -> Action {
        let span = self.action.name_span;
        let marker = self.marker(under_way);
        let mut precondition = vec![Condition { kind: ConditionKind::Atom(marker.clone()), span }];
        precondition.extend(self.conditions(|when| *when != TimeSpecifier::Start).cloned());
        let mut effects: Vec<Effect> = self.effects(&TimeSpecifier::End).cloned().collect();
        effects.push(Effect { kind: EffectKind::Delete(marker), span });
        self.action(precondition, effects)
    }

    pub(super) fn whole(
        &self,
        under_way: PredicateId,
        passing: &mut Vec<Passing>,
    ) -> Result<Action, CompressionError> {
        let span = self.action.name_span;
        let idle = Condition { kind: ConditionKind::Atom(self.marker(under_way)), span };
        let mut precondition = vec![negation(idle, span)];
        precondition.extend(self.conditions(|when| *when == TimeSpecifier::Start).cloned());
        for condition in self.conditions(|when| *when != TimeSpecifier::Start) {
            let before = self.before(condition)?;
            if is_never(&before) {
                let action = self.action.name.clone();
                return Err(CompressionError::NeedsConcurrency { action, span: condition.span });
            }
            precondition.push(before);
        }
        let mut taken: Vec<(&Atom, bool)> = Vec::new();
        let (start, end) = (&TimeSpecifier::Start, &TimeSpecifier::End);
        self.effects(end).for_each(|effect| deletes(effect, true, &mut taken));
        let mut effects = Vec::new();
        for effect in self.effects(start) {
            effects.extend(self.lasting(effect, &taken, passing)?);
        }
        for effect in self.effects(end) {
            self.gives_back(effect, passing);
            effects.push(self.late(effect)?);
        }
        Ok(self.action(precondition, effects))
    }

    fn too_complex(&self, symbol: &Name, span: Span) -> CompressionError {
        let (action, symbol) = (self.action.name.clone(), symbol.clone());
        CompressionError::TooComplex { action, symbol, span }
    }

    /// What must hold before the start so that the condition holds right after it.
    fn before(&self, condition: &Condition) -> Result<Condition, CompressionError> {
        let span = condition.span;
        let all = |parts: &[Condition]| -> Result<Vec<_>, _> {
            parts.iter().map(|part| self.before(part)).collect()
        };
        Ok(match &condition.kind {
            ConditionKind::And(parts) => conjunction(all(parts)?, span),
            ConditionKind::Or(parts) => disjunction(all(parts)?, span),
            ConditionKind::Not(part) => negation(self.before(part)?, span),
            ConditionKind::Imply(if_, then) => {
                disjunction(vec![negation(self.before(if_)?, span), self.before(then)?], span)
            }
            ConditionKind::Exists(slots, part) => {
                quantified(ConditionKind::Exists, slots, self.before(part)?, span)
            }
            ConditionKind::Forall(slots, part) => {
                quantified(ConditionKind::Forall, slots, self.before(part)?, span)
            }
            ConditionKind::Atom(atom) => self.atom_before(atom, condition)?,
            ConditionKind::Compare(comparison, left, right) => {
                let (left, right) = (self.value_before(left)?, self.value_before(right)?);
                let kind = ConditionKind::Compare(*comparison, Box::new(left), Box::new(right));
                Condition { kind, span }
            }
            ConditionKind::FluentIs(application, _) => {
                let name = &self.domain.functions[application.function].name;
                if self.opaque.contains(name) {
                    return Err(self.too_complex(name, span));
                }
                condition.clone()
            }
            ConditionKind::HasType(..) | ConditionKind::Same(..) => condition.clone(),
        })
    }

    fn atom_before(&self, atom: &Atom, condition: &Condition) -> Result<Condition, CompressionError> {
        let name = &self.domain.predicates[atom.predicate].name;
        if self.opaque.contains(name) || self.derived.contains(&atom.predicate) {
            return Err(self.too_complex(name, atom.span));
        }
        let matches = |positive: bool| -> Vec<Condition> {
            let own = self
                .given
                .iter()
                .filter(|(adds, other)| *adds == positive && other.predicate == atom.predicate);
            own.map(|(_, other)| self.same(other, atom)).collect()
        };
        let (given, taken) = (matches(true), matches(false));
        let mut kept = vec![condition.clone()];
        kept.extend(taken.into_iter().map(|same| negation(same, atom.span)));
        let mut ways = given;
        ways.push(conjunction(kept, atom.span));
        Ok(disjunction(ways, atom.span))
    }

    /// That two atoms of one predicate are the same.
    fn same(&self, a: &Atom, b: &Atom) -> Condition {
        let pairs = a.arguments.iter().zip(&b.arguments).filter(|(x, y)| x != y);
        let parts = pairs.map(|(&x, &y)| {
            let types = |term: Term| match term {
                Term::Variable(variable) => Some(&self.action.variables[variable].types),
                Term::Object(_) => None,
            };
            let apart = match (types(x), types(y)) {
                (Some(x), Some(y)) => !self.domain.types.overlap(x, y),
                (None, None) => true,
                _ => false,
            };
            let kind = if apart { ConditionKind::Or(Vec::new()) } else { ConditionKind::Same(x, y) };
            Condition { kind, span: b.span }
        });
        conjunction(parts.collect(), b.span)
    }

    /// An expression after the start, over the values before it.
    fn value_before(&self, expression: &Expression) -> Result<Expression, CompressionError> {
        let span = expression.span;
        Ok(match &expression.kind {
            ExpressionKind::Fluent(application) => {
                let name = &self.domain.functions[application.function].name;
                if self.opaque.contains(name) {
                    return Err(self.too_complex(name, span));
                }
                let mut value = expression.clone();
                let own = self.numbers.iter().filter(|(_, other, _)| other.function == application.function);
                for (operator, other, by) in own {
                    if other.arguments != application.arguments {
                        return Err(self.too_complex(name, span));
                    }
                    value =
                        changed(*operator, value, by, span).ok_or_else(|| self.too_complex(name, span))?;
                }
                value
            }
            ExpressionKind::Arithmetic(operator, parts) => {
                let parts = parts.iter().map(|part| self.value_before(part)).collect::<Result<_, _>>()?;
                Expression { kind: ExpressionKind::Arithmetic(*operator, parts), span }
            }
            _ => expression.clone(),
        })
    }

    /// What lasts of an effect at start when the end has taken back what it takes back.
    fn lasting(
        &self,
        effect: &Effect,
        taken: &[(&Atom, bool)],
        passing: &mut Vec<Passing>,
    ) -> Result<Option<Effect>, CompressionError> {
        let span = effect.span;
        let kind = match &effect.kind {
            EffectKind::And(parts) => {
                let parts: Result<Vec<_>, _> =
                    parts.iter().map(|part| self.lasting(part, taken, passing)).collect();
                EffectKind::And(parts?.into_iter().flatten().collect())
            }
            EffectKind::Forall(slots, part) => match self.lasting(part, taken, passing)? {
                Some(part) => EffectKind::Forall(slots.clone(), Box::new(part)),
                None => return Ok(None),
            },
            EffectKind::When(condition, part) => match self.lasting(part, taken, passing)? {
                Some(part) => EffectKind::When(condition.clone(), Box::new(part)),
                None => return Ok(None),
            },
            EffectKind::Add(atom) => {
                let own = taken.iter().filter(|(other, _)| other.predicate == atom.predicate);
                let mut guards = Vec::new();
                for (other, plain) in own {
                    if !plain {
                        let name = &self.domain.predicates[atom.predicate].name;
                        return Err(self.too_complex(name, atom.span));
                    }
                    guards.push(negation(self.same(other, atom), atom.span));
                }
                let guard = conjunction(guards, atom.span);
                if !is_always(&guard) {
                    self.pass(atom, true, passing);
                }
                match guard {
                    guard if is_never(&guard) => return Ok(None),
                    guard if is_always(&guard) => return Ok(Some(effect.clone())),
                    guard => EffectKind::When(guard, Box::new(effect.clone())),
                }
            }
            EffectKind::Assign(operator, application, _) if !is_shift(*operator) => {
                // The end would have to come after it, and both are one step.
                let name = &self.domain.functions[application.function].name;
                let mut again = false;
                for end in self.effects(&TimeSpecifier::End) {
                    end.each(&mut |part| {
                        let EffectKind::Assign(_, other, _) = &part.kind else { return };
                        again |= other.function == application.function;
                    });
                }
                if again {
                    return Err(self.too_complex(name, span));
                }
                return Ok(Some(effect.clone()));
            }
            EffectKind::Delete(_) | EffectKind::Assign(..) => return Ok(Some(effect.clone())),
        };
        Ok(Some(Effect { kind, span }))
    }

    /// What the end gives back of what the start took.
    fn gives_back(&self, effect: &Effect, passing: &mut Vec<Passing>) {
        effect.each(&mut |part| {
            let EffectKind::Add(atom) = &part.kind else { return };
            let is_taken = |(adds, other): &(bool, &Atom)| {
                !adds && other.predicate == atom.predicate && !is_never(&self.same(other, atom))
            };
            if self.given.iter().any(is_taken) {
                self.pass(atom, false, passing);
            }
        });
    }

    fn pass(&self, atom: &Atom, positive: bool, passing: &mut Vec<Passing>) {
        let own = Passing { giver: self.action.name.clone(), predicate: atom.predicate, positive };
        if !passing.contains(&own) {
            passing.push(own);
        }
    }

    /// An effect at end, over the state before the start.
    fn late(&self, effect: &Effect) -> Result<Effect, CompressionError> {
        let kind = match &effect.kind {
            EffectKind::And(parts) => {
                EffectKind::And(parts.iter().map(|part| self.late(part)).collect::<Result<_, _>>()?)
            }
            EffectKind::Forall(slots, part) => EffectKind::Forall(slots.clone(), Box::new(self.late(part)?)),
            EffectKind::When(condition, part) => {
                EffectKind::When(self.before(condition)?, Box::new(self.late(part)?))
            }
            EffectKind::Assign(operator, application, value) => {
                let name = &self.domain.functions[application.function].name;
                let mut own =
                    self.numbers.iter().filter(|(_, other, _)| other.function == application.function);
                let mixed = own.any(|(first, ..)| !is_shift(*first) || !is_shift(*operator));
                if mixed || self.opaque.contains(name) {
                    return Err(self.too_complex(name, effect.span));
                }
                let value = match value {
                    AssignedValue::Number(value) => AssignedValue::Number(self.value_before(value)?),
                    other => other.clone(),
                };
                EffectKind::Assign(*operator, application.clone(), value)
            }
            EffectKind::Add(_) | EffectKind::Delete(_) => return Ok(effect.clone()),
        };
        Ok(Effect { kind, span: effect.span })
    }
}

fn is_shift(operator: AssignOperator) -> bool {
    matches!(operator, AssignOperator::Increase | AssignOperator::Decrease)
}

fn changed(operator: AssignOperator, value: Expression, by: &Expression, span: Span) -> Option<Expression> {
    use pddl::model::ArithmeticOperator::{Add, Subtract};
    let operator = match operator {
        AssignOperator::Increase => Add,
        AssignOperator::Decrease => Subtract,
        AssignOperator::Assign => return Some(by.clone()),
        AssignOperator::ScaleUp | AssignOperator::ScaleDown => return None,
    };
    Some(Expression { kind: ExpressionKind::Arithmetic(operator, vec![value, by.clone()]), span })
}

/// The atoms that an effect deletes, and whether it does so under no condition.
fn deletes<'e>(effect: &'e Effect, plain: bool, into: &mut Vec<(&'e Atom, bool)>) {
    match &effect.kind {
        EffectKind::And(parts) => parts.iter().for_each(|part| deletes(part, plain, into)),
        EffectKind::Forall(_, part) | EffectKind::When(_, part) => deletes(part, false, into),
        EffectKind::Delete(atom) => into.push((atom, plain)),
        EffectKind::Add(_) | EffectKind::Assign(..) => {}
    }
}
