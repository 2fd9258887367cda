//! Which tokens conditions and effects mention. Ids differ from file to file, so tokens are names.

use std::collections::BTreeSet;

use pddl::model::{
    Application, Atom, Condition, ConditionKind, Domain, DurativeAction, Effect, EffectKind, Expression,
    ExpressionKind, Name, TimeSpecifier,
};

use crate::mission::Mission;

/// Collects tokens of one domain.
pub(super) struct Tokens<'d> {
    domain: &'d Domain,
    pub(super) names: BTreeSet<Name>,
}

impl<'d> Tokens<'d> {
    pub(super) fn of(domain: &'d Domain) -> Self {
        Self { domain, names: BTreeSet::new() }
    }

    fn atom(&mut self, atom: &Atom) {
        self.names.insert(self.domain.predicates[atom.predicate].name.clone());
    }

    fn application(&mut self, application: &Application) {
        self.names.insert(self.domain.functions[application.function].name.clone());
    }

    fn expression(&mut self, expression: &Expression) {
        expression.each(&mut |part| {
            if let ExpressionKind::Fluent(application) = &part.kind {
                self.application(application);
            }
        });
    }

    /// Everything that the condition looks at.
    pub(super) fn condition(&mut self, condition: &Condition) {
        condition.each(&mut |part| match &part.kind {
            ConditionKind::Atom(atom) => self.atom(atom),
            ConditionKind::Compare(_, left, right) => {
                self.expression(left);
                self.expression(right);
            }
            ConditionKind::FluentIs(application, _) => self.application(application),
            _ => {}
        });
    }

    /// Everything that the effect writes (not what its guards look at).
    pub(super) fn effect(&mut self, effect: &Effect) {
        effect.each(&mut |part| match &part.kind {
            EffectKind::Add(atom) | EffectKind::Delete(atom) => self.atom(atom),
            EffectKind::Assign(_, application, _) => self.application(application),
            EffectKind::And(_) | EffectKind::Forall(..) | EffectKind::When(..) => {}
        });
    }

    /// What a rule's conditions at the times that `when` accepts look at.
    pub(super) fn conditions(
        mut self,
        action: &DurativeAction,
        when: fn(&TimeSpecifier) -> bool,
    ) -> BTreeSet<Name> {
        action.conditions.iter().filter(|c| when(&c.when)).for_each(|c| self.condition(&c.condition));
        self.names
    }

    /// What its effects at those times write.
    pub(super) fn effects(
        mut self,
        action: &DurativeAction,
        when: fn(&TimeSpecifier) -> bool,
    ) -> BTreeSet<Name> {
        action.effects.iter().filter(|e| when(&e.when)).for_each(|e| self.effect(&e.effect));
        self.names
    }
}

/// Everything that a rule of some agent writes, at any time.
pub(super) fn written_by_rules(mission: &Mission) -> BTreeSet<Name> {
    let mut all = BTreeSet::new();
    for agent in &mission.layers.agents {
        for (_, rule) in agent.model.durative_actions.enumerate() {
            all.extend(Tokens::of(&agent.model).effects(rule, |_| true));
        }
    }
    all
}

/// Everything that an intention writes when it starts or is given up.
pub(super) fn written_by_intentions(mission: &Mission) -> BTreeSet<Name> {
    let methods = &mission.layers.methods.model;
    let mut all = BTreeSet::new();
    for (_, intention) in methods.durative_actions.enumerate() {
        all.extend(Tokens::of(methods).effects(intention, |when| *when != TimeSpecifier::End));
    }
    all
}
