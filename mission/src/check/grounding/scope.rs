//! A schema under a binding: which of its conditions may hold, and what its effects may write.
//!
//! Invariant: every answer is optimistic. A condition that may hold in some state of some run may hold here; facts are only
//! ever added, and a negation holds unless the fact holds for ever.

use pddl::model::{
    Application, AssignedValue, Atom, Condition, ConditionKind, Domain, Effect, EffectKind, Idx, Name, Term,
    VariableId, Variables,
};

use super::classes::{ClassId, Classes};
use super::facts::{Fact, Facts};
use super::known::Known;
use crate::layers::Layers;

/// A schema, its binding, and what may hold.
pub(in crate::check) struct Scope<'a> {
    pub(in crate::check) layers: &'a Layers,
    pub(in crate::check) classes: &'a Classes,
    pub(in crate::check) domain: &'a Domain,
    pub(in crate::check) variables: &'a Variables,
    /// By variable; those of quantifiers and results are bound where they are visited.
    pub(in crate::check) binding: Vec<Option<ClassId>>,
}

impl<'a> Scope<'a> {
    pub(super) fn new(
        layers: &'a Layers,
        classes: &'a Classes,
        domain: &'a Domain,
        variables: &'a Variables,
    ) -> Self {
        Self { layers, classes, domain, variables, binding: vec![None; variables.slots.len()] }
    }

    /// The classes over which a variable ranges.
    pub(in crate::check) fn range(&self, variable: VariableId) -> Vec<ClassId> {
        self.classes.of_types(self.layers, self.domain, &self.variables[variable].types)
    }

    /// The class of a term; `None` if it is not bound, or no node.
    pub(in crate::check) fn term(&self, term: Term) -> Option<ClassId> {
        match term {
            Term::Variable(variable) => self.binding[variable.index()],
            Term::Object(object) => self.classes.of(&self.domain.constants[object].name),
        }
    }

    fn fact(&self, symbol: &Name, terms: &[Term], value: Option<Term>) -> Option<Fact> {
        let arguments = terms.iter().copied().chain(value).map(|t| self.term(t)).collect::<Option<_>>()?;
        Some(Fact { symbol: symbol.clone(), arguments, valued: value.is_some() })
    }

    pub(in crate::check) fn atom(&self, atom: &Atom) -> Option<Fact> {
        self.fact(&self.domain.predicates[atom.predicate].name, &atom.arguments, None)
    }

    pub(in crate::check) fn value(&self, application: &Application, value: Option<Term>) -> Option<Fact> {
        self.fact(&self.domain.functions[application.function].name, &application.arguments, value)
    }

    /// Whether the condition may have the truth value `wanted`.
    pub(in crate::check) fn may(&mut self, condition: &Condition, wanted: bool, known: &Known<'_>) -> bool {
        match &condition.kind {
            ConditionKind::And(parts) if wanted => parts.iter().all(|p| self.may(p, true, known)),
            ConditionKind::And(parts) => parts.iter().any(|p| self.may(p, false, known)),
            ConditionKind::Or(parts) if wanted => parts.iter().any(|p| self.may(p, true, known)),
            ConditionKind::Or(parts) => parts.iter().all(|p| self.may(p, false, known)),
            ConditionKind::Not(part) => self.may(part, !wanted, known),
            ConditionKind::Imply(if_, then) if wanted => {
                self.may(if_, false, known) || self.may(then, true, known)
            }
            ConditionKind::Imply(if_, then) => self.may(if_, true, known) && self.may(then, false, known),
            ConditionKind::Exists(slots, part) => self.quantified(slots, part, wanted, wanted, known),
            ConditionKind::Forall(slots, part) => self.quantified(slots, part, wanted, !wanted, known),
            ConditionKind::Atom(atom) => self.atom(atom).is_none_or(|fact| known.may(&fact, wanted)),
            ConditionKind::FluentIs(application, value) => {
                self.value(application, Some(*value)).is_none_or(|fact| known.may(&fact, wanted))
            }
            ConditionKind::Same(left, right) => match (self.term(*left), self.term(*right)) {
                (Some(left), Some(right)) if wanted => left == right,
                (Some(left), Some(right)) => left != right || !self.classes.is_single(left),
                _ => true,
            },
            ConditionKind::HasType(term, types) => self
                .term(*term)
                .is_none_or(|class| self.classes.is_a(class, self.layers, self.domain, types) == wanted),
            ConditionKind::Compare(..) => true,
        }
    }

    /// Whether some (`any`) or every binding of the slots may give the condition the truth value.
    fn quantified(
        &mut self,
        slots: &[VariableId],
        part: &Condition,
        wanted: bool,
        any: bool,
        known: &Known<'_>,
    ) -> bool {
        let Some((first, rest)) = slots.split_first() else { return self.may(part, wanted, known) };
        let before = self.binding[first.index()];
        let mut result = !any;
        for class in self.range(*first) {
            self.binding[first.index()] = Some(class);
            if self.quantified(rest, part, wanted, any, known) == any {
                result = any;
                break;
            }
        }
        self.binding[first.index()] = before;
        result
    }

    /// Visits the ground atoms and values of a condition that have to be true for it (`positive`) or false, wherever in it
    /// they stand.
    pub(in crate::check) fn literals(
        &mut self,
        condition: &Condition,
        positive: bool,
        visit: &mut impl FnMut(Fact, bool),
    ) {
        match &condition.kind {
            ConditionKind::And(parts) | ConditionKind::Or(parts) => {
                parts.iter().for_each(|part| self.literals(part, positive, visit));
            }
            ConditionKind::Not(part) => self.literals(part, !positive, visit),
            ConditionKind::Imply(if_, then) => {
                self.literals(if_, !positive, visit);
                self.literals(then, positive, visit);
            }
            ConditionKind::Exists(slots, part) | ConditionKind::Forall(slots, part) => {
                self.each(slots, &mut |scope| scope.literals(part, positive, visit));
            }
            ConditionKind::Atom(atom) => self.atom(atom).into_iter().for_each(|f| visit(f, positive)),
            ConditionKind::FluentIs(application, value) => {
                self.value(application, Some(*value)).into_iter().for_each(|f| visit(f, positive));
            }
            ConditionKind::Same(..) | ConditionKind::HasType(..) | ConditionKind::Compare(..) => {}
        }
    }

    /// Visits every binding of the slots, with those of a rule's results among them.
    fn each(&mut self, slots: &[VariableId], visit: &mut dyn FnMut(&mut Self)) {
        let Some((first, rest)) = slots.split_first() else { return visit(self) };
        let before = self.binding[first.index()];
        for class in self.range(*first) {
            self.binding[first.index()] = Some(class);
            self.each(rest, visit);
        }
        self.binding[first.index()] = before;
    }

    /// Adds what the effect may write; `results` are the unbound variables that the rule's skill binds.
    pub(in crate::check) fn write(
        &mut self,
        effect: &Effect,
        results: &[VariableId],
        known: &Known<'_>,
        into: &mut Facts,
    ) {
        // A result that is a value, such as a pose, has no classes.
        let nodes: Vec<_> = results.iter().copied().filter(|&r| !self.range(r).is_empty()).collect();
        self.each(&nodes, &mut |scope| scope.write_bound(effect, known, into));
    }

    fn write_bound(&mut self, effect: &Effect, known: &Known<'_>, into: &mut Facts) {
        match &effect.kind {
            EffectKind::And(parts) => parts.iter().for_each(|part| self.write_bound(part, known, into)),
            EffectKind::Forall(slots, part) => {
                self.each(slots, &mut |scope| scope.write_bound(part, known, into));
            }
            EffectKind::When(condition, part) => {
                if self.may(condition, true, known) {
                    self.write_bound(part, known, into);
                }
            }
            EffectKind::Add(atom) => into.true_.extend(self.atom(atom)),
            EffectKind::Delete(atom) => into.false_.extend(self.atom(atom)),
            EffectKind::Assign(_, application, value) => {
                into.false_.extend(self.value(application, None));
                if let AssignedValue::Object(value) = value {
                    into.true_.extend(self.value(application, Some(*value)));
                }
            }
        }
    }
}
