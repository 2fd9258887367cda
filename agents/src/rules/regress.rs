//! The condition of a rule before its start, by regression.
//!
//! Problem: the rule's own effects at start may establish a part of its condition over all (`waiting` while it
//! waits), so the graph before need not satisfy all of it. Idea: regress the condition through the effects at start, as a
//! planner regresses a goal through an action. A conjunct that an effect establishes literally is dropped;
//! the others must hold already. The comparison is syntactic; the guard, which the graph checks after the effects, is
//! exact.
//!
//! The same comparison shows whether a rule without a skill falsifies its own condition.

use pddl::model::{
    Application, AssignOperator, AssignedValue, Atom, Condition, ConditionKind, DurativeAction, Effect,
    EffectKind, Term, TimeSpecifier,
};

/// The effects at start: the unconditional ones by what they do, and all atoms that they may add or delete.
pub(super) struct Beginning<'a> {
    touched: Vec<&'a Atom>,
    adds: Vec<&'a Atom>,
    deletes: Vec<&'a Atom>,
    assigns: Vec<(&'a Application, &'a AssignedValue)>,
}

impl<'a> Beginning<'a> {
    pub(super) fn of(action: &'a DurativeAction) -> Self {
        let mut beginning =
            Self { touched: Vec::new(), adds: Vec::new(), deletes: Vec::new(), assigns: Vec::new() };
        for timed in action.effects.iter().filter(|timed| timed.when == TimeSpecifier::Start) {
            beginning.collect(&timed.effect);
            atoms(&timed.effect, &mut beginning.touched);
        }
        beginning
    }

    fn collect(&mut self, effect: &'a Effect) {
        match &effect.kind {
            EffectKind::And(parts) => parts.iter().for_each(|part| self.collect(part)),
            EffectKind::Add(atom) => self.adds.push(atom),
            EffectKind::Delete(atom) => self.deletes.push(atom),
            EffectKind::Assign(AssignOperator::Assign, application, value) => {
                self.assigns.push((application, value));
            }
            EffectKind::Assign(..) | EffectKind::Forall(..) | EffectKind::When(..) => {}
        }
    }

    fn adds(&self, atom: &Atom) -> bool {
        self.adds.iter().any(|added| same_atom(added, atom))
    }

    /// An add of the same atom at the same time wins.
    fn deletes(&self, atom: &Atom) -> bool {
        self.deletes.iter().any(|deleted| same_atom(deleted, atom)) && !self.adds(atom)
    }

    fn assigned(&self, application: &Application) -> Option<&AssignedValue> {
        let same = |other: &Application| {
            other.function == application.function && other.arguments == application.arguments
        };
        self.assigns.iter().find(|(other, _)| same(other)).map(|(_, value)| *value)
    }

    /// Whether the condition holds after these effects in every state.
    pub(super) fn establishes(&self, condition: &Condition) -> bool {
        match &condition.kind {
            ConditionKind::Atom(atom) => self.adds(atom),
            ConditionKind::Not(inner) => match &inner.kind {
                ConditionKind::Atom(atom) => self.deletes(atom),
                _ => false,
            },
            ConditionKind::FluentIs(application, term) => {
                matches!(self.assigned(application), Some(AssignedValue::Object(value)) if value == term)
            }
            _ => false,
        }
    }

    /// Whether these effects may add or delete an atom of the condition.
    pub(super) fn may_change(&self, condition: &Condition) -> bool {
        let mut found = false;
        condition.each(&mut |part| {
            if let ConditionKind::Atom(atom) = &part.kind {
                found |= self.touched.iter().any(|touched| may_be_same(touched, atom));
            }
        });
        found
    }

    /// Whether the condition is false after these effects in every state.
    pub(super) fn falsifies(&self, condition: &Condition) -> bool {
        match &condition.kind {
            ConditionKind::And(parts) => parts.iter().any(|part| self.falsifies(part)),
            ConditionKind::Atom(atom) => self.deletes(atom),
            ConditionKind::Not(inner) => match &inner.kind {
                ConditionKind::Atom(atom) => self.adds(atom),
                _ => false,
            },
            ConditionKind::FluentIs(application, term) => match self.assigned(application) {
                Some(AssignedValue::Undefined) => true,
                Some(AssignedValue::Object(Term::Object(value))) => {
                    matches!(term, Term::Object(wanted) if wanted != value)
                }
                _ => false,
            },
            _ => false,
        }
    }
}

/// The conjuncts of a condition, flattened.
pub(super) fn conjuncts<'a>(condition: &'a Condition, into: &mut Vec<&'a Condition>) {
    match &condition.kind {
        ConditionKind::And(parts) => parts.iter().for_each(|part| conjuncts(part, into)),
        _ => into.push(condition),
    }
}

fn same_atom(a: &Atom, b: &Atom) -> bool {
    a.predicate == b.predicate && a.arguments == b.arguments
}

/// Every atom that an effect adds or deletes, under whatever condition.
fn atoms<'a>(effect: &'a Effect, into: &mut Vec<&'a Atom>) {
    match &effect.kind {
        EffectKind::And(parts) => parts.iter().for_each(|part| atoms(part, into)),
        EffectKind::Add(atom) | EffectKind::Delete(atom) => into.push(atom),
        EffectKind::Forall(_, inner) | EffectKind::When(_, inner) => atoms(inner, into),
        EffectKind::Assign(..) => {}
    }
}

/// Whether two atoms are the same for some binding of their variables.
fn may_be_same(a: &Atom, b: &Atom) -> bool {
    let differ = |(a, b): (&Term, &Term)| matches!((a, b), (Term::Object(a), Term::Object(b)) if a != b);
    a.predicate == b.predicate && !a.arguments.iter().zip(&b.arguments).any(differ)
}
