//! The mission grounded: every fact that may hold at some time, and how.
//!
//! Problem: checks that compare the names of tokens pass missions that cannot run. Idea: relaxed reachability through all
//! layers. From the initial graph, rules, intentions, perception and the plan's actions add what they may write, for
//! every binding that their callers can give them, until nothing is new. What is missing then never happens in any run.
//!
//! Invariant: optimistic. No fact that some run reaches is missing, so a check may report an absence as a mistake. An
//! action's effects are added as if they were perceived, so that one mistake hides no other.
//!
//! Cost: classes of nodes instead of nodes ([`classes`]), and a limit of bindings ([`bindings`]).
//!
//! Source: Bonet & Geffner, "Planning as heuristic search", AIJ 2001, §3 (the relaxation that ignores deletes).

mod bindings;
mod calls;
mod classes;
mod facts;
mod known;
mod mentions;
mod rules;
mod scope;

pub(super) use bindings::conjuncts;
pub(super) use classes::{ClassId, Classes};
pub(super) use facts::{Fact, Facts, list};
pub(super) use known::Known;
pub(super) use mentions::variables_of;
pub(super) use rules::Instance;
pub(super) use scope::Scope;

use std::collections::BTreeSet;

use pddl::model::{
    ActionId, Condition, Domain, DurativeAction, DurativeActionId, FluentValue, Idx, Problem, Term,
    TimeSpecifier, VariableId, Variables,
};

use self::bindings::Meter;
use self::calls::Calls;
use crate::layers::Layers;
use crate::mission::Mission;

/// Everything that may happen.
pub(super) struct Grounding<'m> {
    pub(super) layers: &'m Layers,
    pub(super) classes: Classes,
    initial: Facts,
    /// What may hold and cease to hold, by anything.
    facts: Facts,
    /// What rules may write.
    pub(super) written: Facts,
    /// What perception may derive.
    pub(super) derived: BTreeSet<Fact>,
    /// The rules that may start.
    pub(super) rules: Vec<Instance>,
    pub(super) calls: Calls,
    /// The actions that may be in a plan.
    pub(super) actions: BTreeSet<(ActionId, Vec<ClassId>)>,
    /// Whether all bindings were visited.
    pub(super) complete: bool,
}

impl<'m> Grounding<'m> {
    pub(super) fn of(mission: &'m Mission) -> Self {
        let layers = &mission.layers;
        let mut grounding = Self {
            layers,
            classes: Classes::new(layers),
            initial: Facts::default(),
            facts: Facts::default(),
            written: Facts::default(),
            derived: BTreeSet::new(),
            rules: Vec::new(),
            calls: Calls::default(),
            actions: BTreeSet::new(),
            complete: true,
        };
        grounding.initial = grounding.at_start();
        grounding.facts = grounding.initial.clone();
        let meter = Meter::default();
        loop {
            let before = grounding.facts.len();
            grounding.plan(&meter);
            grounding.call(mission, &meter);
            grounding.react(&meter);
            grounding.perceive(&meter);
            if grounding.facts.len() == before || meter.is_exhausted() {
                break;
            }
        }
        grounding.complete = !meter.is_exhausted();
        grounding
    }

    /// What may hold at some time.
    pub(super) fn known(&self) -> Known<'_> {
        Known { classes: &self.classes, facts: &self.facts, own: None, initial: &self.initial }
    }

    /// A schema without a binding.
    pub(super) fn scope<'s>(&'s self, domain: &'s Domain, variables: &'s Variables) -> Scope<'s> {
        Scope::new(self.layers, &self.classes, domain, variables)
    }

    /// A schema with its parameters bound.
    pub(super) fn bound<'s>(
        &'s self,
        domain: &'s Domain,
        variables: &'s Variables,
        arguments: &[ClassId],
    ) -> Scope<'s> {
        let mut scope = self.scope(domain, variables);
        for (parameter, &class) in variables.parameter_ids().zip(arguments) {
            scope.binding[parameter.index()] = Some(class);
        }
        scope
    }

    /// What an intention writes at the times that `when` selects.
    pub(super) fn effects(
        &self,
        intention: &DurativeAction,
        arguments: &[ClassId],
        when: impl Fn(&TimeSpecifier) -> bool,
    ) -> Facts {
        let mut scope = self.bound(&self.layers.methods.model, &intention.variables, arguments);
        let mut written = Facts::default();
        for effect in intention.effects.iter().filter(|e| when(&e.when)) {
            scope.write(&effect.effect, &[], &self.known(), &mut written);
        }
        written
    }

    /// Visits the bindings of these variables under which every condition may hold.
    pub(super) fn visit(
        &self,
        scope: &mut Scope<'_>,
        variables: &[VariableId],
        conditions: &[&Condition],
        visit: &mut dyn FnMut(&mut Scope<'_>),
    ) {
        bindings::each(scope, variables, conditions, &self.known(), &Meter::default(), visit);
    }

    /// The facts of the world, the graph and the problem.
    fn at_start(&self) -> Facts {
        let mut facts = Facts::default();
        let layers = self.layers;
        let problems = [
            (&layers.nodes, &layers.world.model),
            (&layers.nodes, &layers.graph.model),
            (&layers.domain.model, &layers.problem.model),
        ];
        for (domain, problem) in problems {
            facts.true_.extend(initial(domain, problem, &self.classes));
        }
        facts
    }

    /// The actions of the plan, and their effects as if they were perceived.
    fn plan(&mut self, meter: &Meter) {
        let domain = &self.layers.steps;
        let (mut actions, mut written) = (BTreeSet::new(), Facts::default());
        for (id, action) in domain.actions.enumerate() {
            let mut conditions = Vec::new();
            conjuncts(&action.precondition, &mut conditions);
            let parameters: Vec<_> = action.variables.parameter_ids().collect();
            let mut scope = self.scope(domain, &action.variables);
            let known = self.known();
            bindings::each(&mut scope, &parameters, &conditions, &known, meter, &mut |scope| {
                scope.write(&action.effect, &[], &known, &mut written);
                actions.insert((id, arguments(scope, &parameters)));
            });
        }
        self.actions = actions;
        self.facts.extend(&written);
    }

    /// The intentions that the actions and the manifest's tasks may call, and what they write.
    fn call(&mut self, mission: &Mission, meter: &Meter) {
        let methods = &self.layers.methods.model;
        let mut callers = Vec::new();
        for named in [&mission.fallback].into_iter().chain(&mission.escalation).chain(&mission.meanwhile) {
            let arguments = named.arguments.iter().map(|name| self.classes.of(name));
            callers.extend(arguments.collect::<Option<Vec<_>>>().map(|arguments| (named.task, arguments)));
        }
        for (action, arguments) in &self.actions {
            let name = &self.layers.steps.actions[*action].name;
            callers.extend(methods.task(name).map(|task| (task, arguments.clone())));
        }
        let mut calls = Calls::default();
        for call in callers {
            calls.add(self.layers, &self.classes, call, &self.known(), meter);
        }
        let mut written = Facts::default();
        for (&id, bindings) in &calls.intentions {
            for binding in bindings {
                let intention = &methods.durative_actions[id];
                written.extend(&self.effects(intention, binding, |when| *when != TimeSpecifier::End));
            }
        }
        // What a cancelled intention added is taken back.
        let taken_back = written.true_.iter().map(Fact::holder).collect::<Vec<_>>();
        written.false_.extend(taken_back);
        self.calls = calls;
        self.facts.extend(&written);
    }

    /// The rules that may start, and what they write.
    fn react(&mut self, meter: &Meter) {
        let mut instances = Vec::new();
        for (position, agent) in self.layers.agents.iter().enumerate() {
            for (id, rule) in agent.model.durative_actions.enumerate() {
                let mut scope = self.scope(&agent.model, &rule.variables);
                rules::each(&mut scope, (position, id), &self.known(), meter, &mut |i| instances.push(i));
            }
        }
        for instance in &instances {
            self.written.extend(&instance.writes);
            self.facts.extend(&instance.writes);
        }
        self.rules = instances;
    }

    /// What perception may derive.
    fn perceive(&mut self, meter: &Meter) {
        let domain = &self.layers.perception.model;
        let mut derived = BTreeSet::new();
        for axiom in &domain.axioms {
            let mut conditions = Vec::new();
            conjuncts(&axiom.body, &mut conditions);
            let parameters: Vec<_> = axiom.variables.parameter_ids().collect();
            let mut scope = self.scope(domain, &axiom.variables);
            bindings::each(&mut scope, &parameters, &conditions, &self.known(), meter, &mut |scope| {
                let symbol = domain.predicates[axiom.predicate].name.clone();
                derived.insert(Fact { symbol, arguments: arguments(scope, &parameters), valued: false });
            });
        }
        self.derived = derived;
        self.facts.true_.extend(self.derived.iter().cloned());
        // A derived fact ceases with what it is derived from.
        self.facts.false_.extend(self.derived.iter().cloned());
    }

    /// The intentions with their bindings.
    pub(super) fn intentions(&self) -> impl Iterator<Item = (DurativeActionId, &BTreeSet<Vec<ClassId>>)> {
        self.calls.intentions.iter().map(|(&id, bindings)| (id, bindings))
    }

    /// What the rules that may start wait for.
    pub(super) fn waited_for(&self) -> BTreeSet<&Fact> {
        self.rules.iter().flat_map(|instance| &instance.waits_for).collect()
    }
}

/// The bound classes of these variables.
fn arguments(scope: &Scope<'_>, variables: &[VariableId]) -> Vec<ClassId> {
    variables.iter().filter_map(|&v| scope.term(Term::Variable(v))).collect()
}

fn initial(domain: &Domain, problem: &Problem, classes: &Classes) -> Vec<Fact> {
    let of = |ids: &[pddl::model::ObjectId]| -> Option<Vec<ClassId>> {
        ids.iter().map(|&id| classes.of(&problem.objects[id].name)).collect()
    };
    let atoms = problem.init.iter().filter_map(|fact| {
        let symbol = domain.predicates[fact.predicate].name.clone();
        Some(Fact { symbol, arguments: of(&fact.arguments)?, valued: false })
    });
    let values = problem.fluents.iter().filter_map(|fluent| {
        let FluentValue::Object(value) = fluent.value else { return None };
        let symbol = domain.functions[fluent.application.function].name.clone();
        let mut arguments = of(&fluent.application.arguments)?;
        arguments.extend(of(&[value])?);
        Some(Fact { symbol, arguments, valued: true })
    });
    atoms.chain(values).collect()
}
