//! The tokens in conditions and effects. Ids differ from file to file, so tokens are names.

use std::collections::BTreeSet;

use pddl::model::{
    Application, AssignedValue, Atom, Condition, ConditionKind, DerivedFunction, DerivedValue, Domain,
    DurativeAction, Effect, EffectKind, Expression, ExpressionKind, Name, TimeSpecifier,
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

    pub(super) fn application(&mut self, application: &Application) {
        self.names.insert(self.domain.functions[application.function].name.clone());
    }

    fn expression(&mut self, expression: &Expression) {
        expression.each(&mut |part| {
            if let ExpressionKind::Fluent(application) = &part.kind {
                self.application(application);
            }
        });
    }

    /// Adds the tokens that a new value is computed from.
    pub(super) fn value(&mut self, value: &AssignedValue) {
        if let AssignedValue::Number(expression) = value {
            self.expression(expression);
        }
    }

    /// Adds the tokens that the condition reads.
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

    /// Adds the tokens that a derived function is computed from.
    pub(super) fn derived(&mut self, function: &DerivedFunction) {
        match &function.value {
            DerivedValue::Expression(expression) => self.expression(expression),
            DerivedValue::Count(_, condition) => self.condition(condition),
        }
    }

    /// Adds the tokens that the effect writes, but not those that its guards read.
    pub(super) fn effect(&mut self, effect: &Effect) {
        effect.each(&mut |part| match &part.kind {
            EffectKind::Add(atom) | EffectKind::Delete(atom) => self.atom(atom),
            EffectKind::Assign(_, application, _) => self.application(application),
            EffectKind::And(_) | EffectKind::Forall(..) | EffectKind::When(..) => {}
        });
    }

    /// The tokens that a rule writes in the effects that `when` selects.
    pub(super) fn effects(
        mut self,
        action: &DurativeAction,
        when: fn(&TimeSpecifier) -> bool,
    ) -> BTreeSet<Name> {
        action.effects.iter().filter(|e| when(&e.when)).for_each(|e| self.effect(&e.effect));
        self.names
    }
}

/// The tokens that rules of agents write, at any time.
pub(super) fn written_by_rules(mission: &Mission) -> BTreeSet<Name> {
    let mut all = BTreeSet::new();
    for agent in &mission.layers.agents {
        for (_, rule) in agent.model.durative_actions.enumerate() {
            all.extend(Tokens::of(&agent.model).effects(rule, |_| true));
        }
    }
    all
}

/// The tokens that intentions write when they start or fail.
pub(super) fn written_by_intentions(mission: &Mission) -> BTreeSet<Name> {
    let methods = &mission.layers.methods.model;
    let mut all = BTreeSet::new();
    for (_, intention) in methods.durative_actions.enumerate() {
        all.extend(Tokens::of(methods).effects(intention, |when| *when != TimeSpecifier::End));
    }
    all
}

/// The tokens that methods and perception read.
pub(super) fn read_by_pelea(mission: &Mission) -> BTreeSet<Name> {
    let layers = &mission.layers;
    let mut methods = Tokens::of(&layers.methods.model);
    layers.methods.model.methods.enumerate().for_each(|(_, m)| methods.condition(&m.precondition));
    let mut perception = Tokens::of(&layers.perception.model);
    layers.perception.model.axioms.iter().for_each(|a| perception.condition(&a.body));
    layers.perception.model.derived_functions.iter().for_each(|f| perception.derived(f));
    methods.names.append(&mut perception.names);
    methods.names
}
