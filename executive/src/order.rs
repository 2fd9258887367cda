//! Deordering: which steps of a plan must come after which others.
//!
//! Problem: a planner gives a sequence, although most pairs of its steps have nothing to do with each other. Idea: two
//! durative actions stay in their order if one of them changes what the other one reads or changes, at any time of either.
//! Two others have no effect on each other, in whatever state and however they overlap. Steps without a duration stay in
//! their place among all others: the author of an `:action` relies on the order.
//!
//! Invariant: every linearisation, and every overlap of steps that are not ordered, leads from a state to where the
//! sequence leads from it, and can be carried out exactly if the sequence can. One linearisation therefore speaks for
//! all. Cost: quadratic in the steps, times their accesses. What is missed: steps that could run together because a
//! third one would give what they need too, or because a number has room for both; they stay ordered.
//!
//! Source: Mazurkiewicz, "Trace theory", 1987; deordering of plans: Bäckström, "Computational aspects of reordering
//! plans", JAIR 1998, §4.

use pddl::model::{
    Application, AssignOperator, AssignedValue, Atom, Condition, ConditionKind, Domain, DurativeAction,
    Effect, EffectKind, Expression, ExpressionKind, FunctionId, ObjectId, PredicateId, Term,
};
use std::collections::BTreeSet;

/// What is done with an atom or a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Use {
    Reads,
    Adds,
    Deletes,
    /// Adds to a number.
    Shifts,
    Sets,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Symbol {
    Predicate(PredicateId),
    Function(FunctionId),
}

/// A use of some atoms or fluents; an open argument stands for any object.
#[derive(Clone, Debug)]
struct Access {
    symbol: Symbol,
    arguments: Vec<Option<ObjectId>>,
    use_: Use,
}

/// Everything that a durative action reads and changes between its start and its end.
#[derive(Clone, Debug, Default)]
pub(crate) struct Accesses(Vec<Access>);

impl Accesses {
    pub(crate) fn of(domain: &Domain, action: &DurativeAction, arguments: &[ObjectId]) -> Self {
        let mut found =
            Finding { domain, arguments, parameters: action.variables.parameters, accesses: Vec::new() };
        action.conditions.iter().for_each(|timed| found.condition(&timed.condition));
        action.effects.iter().for_each(|timed| found.effect(&timed.effect));
        action.duration.iter().for_each(|bound| found.expression(&bound.bound));
        Self(found.accesses)
    }

    /// Whether one changes what the other reads or changes.
    pub(crate) fn conflict(&self, other: &Self) -> bool {
        self.0.iter().any(|a| other.0.iter().any(|b| a.conflicts(b)))
    }
}

impl Access {
    fn conflicts(&self, other: &Self) -> bool {
        self.symbol == other.symbol
            && !self.use_.commutes(other.use_)
            && self.arguments.iter().zip(&other.arguments).all(|(a, b)| a.is_none() || b.is_none() || a == b)
    }
}

impl Use {
    /// Whether both have the same result in either order, and neither changes what the other sees.
    fn commutes(self, other: Self) -> bool {
        self == other && self != Self::Sets
    }
}

struct Finding<'a> {
    domain: &'a Domain,
    arguments: &'a [ObjectId],
    parameters: usize,
    accesses: Vec<Access>,
}

impl Finding<'_> {
    fn terms(&self, terms: &[Term]) -> Vec<Option<ObjectId>> {
        let object = |term: &Term| match *term {
            Term::Object(object) => Some(object),
            Term::Variable(slot) => {
                let at = pddl::model::Idx::index(slot);
                (at < self.parameters).then(|| self.arguments.get(at).copied()).flatten()
            }
        };
        terms.iter().map(object).collect()
    }

    fn atom(&mut self, atom: &Atom, use_: Use) {
        let (symbol, arguments) = (Symbol::Predicate(atom.predicate), self.terms(&atom.arguments));
        self.accesses.push(Access { symbol, arguments, use_ });
        // What is derived is read from everything below it.
        let mut below = BTreeSet::from([atom.predicate]);
        let mut open = vec![atom.predicate];
        while let Some(next) = open.pop() {
            for axiom in self.domain.axioms.iter().filter(|axiom| axiom.predicate == next) {
                let mut found = Vec::new();
                axiom.body.each(&mut |part| match &part.kind {
                    ConditionKind::Atom(atom) => found.push(Symbol::Predicate(atom.predicate)),
                    ConditionKind::FluentIs(application, _) => {
                        found.push(Symbol::Function(application.function));
                    }
                    ConditionKind::Compare(_, left, right) => [left, right].into_iter().for_each(|side| {
                        side.each(&mut |part| {
                            if let ExpressionKind::Fluent(application) = &part.kind {
                                found.push(Symbol::Function(application.function));
                            }
                        });
                    }),
                    _ => {}
                });
                for symbol in found {
                    let arity = match symbol {
                        Symbol::Predicate(id) => self.domain.predicates[id].variables.parameters,
                        Symbol::Function(id) => self.domain.functions[id].variables.parameters,
                    };
                    self.accesses.push(Access { symbol, arguments: vec![None; arity], use_: Use::Reads });
                    if let Symbol::Predicate(id) = symbol
                        && below.insert(id)
                    {
                        open.push(id);
                    }
                }
            }
        }
    }

    fn application(&mut self, application: &Application, use_: Use) {
        let arguments = self.terms(&application.arguments);
        self.accesses.push(Access { symbol: Symbol::Function(application.function), arguments, use_ });
    }

    fn expression(&mut self, expression: &Expression) {
        expression.each(&mut |part| {
            if let ExpressionKind::Fluent(application) = &part.kind {
                self.application(application, Use::Reads);
            }
        });
    }

    fn condition(&mut self, condition: &Condition) {
        condition.each(&mut |part| match &part.kind {
            ConditionKind::Atom(atom) => self.atom(atom, Use::Reads),
            ConditionKind::Compare(_, left, right) => {
                self.expression(left);
                self.expression(right);
            }
            ConditionKind::FluentIs(application, _) => self.application(application, Use::Reads),
            _ => {}
        });
    }

    fn effect(&mut self, effect: &Effect) {
        effect.each(&mut |part| match &part.kind {
            EffectKind::Add(atom) => self.atom(atom, Use::Adds),
            EffectKind::Delete(atom) => self.atom(atom, Use::Deletes),
            EffectKind::Assign(operator, application, value) => {
                let is_shift = matches!(operator, AssignOperator::Increase | AssignOperator::Decrease);
                self.application(application, if is_shift { Use::Shifts } else { Use::Sets });
                if let AssignedValue::Number(value) = value {
                    self.expression(value);
                }
            }
            EffectKind::When(condition, _) => self.condition(condition),
            EffectKind::And(_) | EffectKind::Forall(..) => {}
        });
    }
}
