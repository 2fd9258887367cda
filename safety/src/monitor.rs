//! The monitor: the invariants against one run, version after version.
//!
//! Idea: an instance is an invariant for one binding of its parameters, with what is left of its formula. A report of the
//! subscription says which conditions became true or false for which nodes; only the instances with these nodes progress.
//! Time breaks an instance when its next deadline is over before anything happened.
//!
//! Invariant: the same reports give the same findings; an instance is reported once. Cost: nothing for commits that
//! touch no condition. Most invariants say nothing about a binding until some condition holds for it ("a person who asks
//! for help …"): such an invariant has instances only for those bindings.

use crate::broken::{Broken, Cause};
use crate::compile::slot;
use crate::facts::{Facts, Key};
use crate::formula::{ConditionId, Formula};
use crate::invariants::Invariants;
use crate::residue::{At, Environment, Moment, Residue, Waiting, deadline};
use dsr::{Interest, News, Snapshot, Time, Version};
use pddl::model::{Idx, VariableId};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// For each invariant, what is left of it for each binding of its parameters.
type Instances = Vec<BTreeMap<Environment, Residue>>;

/// The invariants against one run.
pub struct Monitor {
    invariants: Arc<Invariants>,
    facts: Facts,
    instances: Instances,
    /// The deadlines of instances, each with its invariant and binding.
    deadlines: BTreeSet<(Moment, usize, Environment)>,
    /// For each condition, the invariants that it occurs in, each with its variables for the condition's.
    uses: Vec<Vec<(usize, Vec<VariableId>)>>,
    version: Version,
    now: Moment,
}

impl Monitor {
    /// A monitor that has seen nothing yet.
    pub fn new(invariants: Arc<Invariants>) -> Self {
        let mut uses = vec![Vec::new(); invariants.conditions.len()];
        for (at, formula) in invariants.formulas.iter().enumerate() {
            for (condition, arguments) in &formula.uses {
                uses[condition.0 as usize].push((at, arguments.to_vec()));
            }
        }
        Self {
            facts: Facts::new(&invariants.conditions, &invariants.formulas),
            instances: invariants.formulas.iter().map(|_| BTreeMap::new()).collect(),
            deadlines: BTreeSet::new(),
            uses,
            invariants,
            version: Version(0),
            now: 0,
        }
    }

    /// What a subscription to the graph of this snapshot must report to [`Monitor::changed`].
    pub fn interest(&self, snapshot: &Snapshot) -> Interest {
        Facts::interest(&self.invariants.conditions, &self.invariants.formulas, snapshot)
    }

    /// A report of the subscription; all of them must be given, in their order. Returns what it broke.
    pub fn changed(&mut self, news: &News) -> Vec<Broken> {
        let time = news.snapshot.time().0.max(self.now);
        let mut broken = self.elapse(time);
        (self.now, self.version) = (time, news.snapshot.version());
        let (nodes, changed) = self.facts.update(news);
        self.trigger(&changed);
        for (index, environment) in self.touched(&changed) {
            let formula = &self.invariants.formulas[index];
            let at = At { formula, facts: &self.facts, now: self.now };
            let residue = at.progress(&self.instances[index][&environment]);
            broken.extend(self.settle(index, &environment, residue, (self.now, Cause::Change)));
        }
        if nodes {
            broken.extend(self.begin());
        }
        broken
    }

    /// It is now this late, and all reports until now have been given. Returns what the time broke.
    pub fn passed(&mut self, now: Time) -> Vec<Broken> {
        self.elapse(now.0)
    }

    /// The time after which [`Monitor::passed`] may find something, unless the graph changes before.
    pub fn deadline(&self) -> Option<Time> {
        self.deadlines.first().map(|(moment, ..)| Time(*moment))
    }

    /// The run is over. Returns what its end broke.
    pub fn ended(self, now: Time) -> Vec<Broken> {
        self.close(now, None)
    }

    /// The run was cut short. Returns what that broke; what had time left to come is not broken.
    pub fn cut(self, now: Time) -> Vec<Broken> {
        self.close(now, Some(true))
    }

    fn close(mut self, now: Time, in_time: Option<bool>) -> Vec<Broken> {
        let mut broken = self.elapse(now.0);
        let now = self.now.max(now.0);
        for (formula, instances) in self.invariants.formulas.iter().zip(&self.instances) {
            let at = At { formula, facts: &self.facts, now };
            let how = (self.version, Time(now), Cause::End);
            // What was broken before has been reported.
            let open = instances.iter().filter(|(_, residue)| **residue != Residue::False);
            let badly = open.filter(|(_, residue)| !at.ends_well(residue, in_time));
            broken.extend(badly.map(|(environment, _)| Broken::new(formula, &self.facts, environment, how)));
        }
        broken
    }

    /// Instances for the bindings whose trigger holds now.
    fn trigger(&mut self, changed: &[(ConditionId, Key)]) {
        for (condition, key) in changed.iter().filter(|(condition, key)| self.facts.holds(*condition, key)) {
            let of = |&(index, _): &&(usize, Vec<VariableId>)| {
                self.invariants.formulas[*index].trigger == Some(*condition)
            };
            // A trigger belongs to one invariant.
            let Some((index, _)) = self.uses[condition.0 as usize].iter().find(of) else { continue };
            let formula = &self.invariants.formulas[*index];
            let mut environment = Environment::from_elem(None, formula.variables.len());
            environment.iter_mut().zip(key).for_each(|(slot, node)| *slot = Some(*node));
            let quiet = quiet(formula, &environment);
            self.instances[*index].entry(environment).or_insert(quiet);
        }
    }

    /// The undecided instances with these nodes.
    fn touched(&self, changed: &[(ConditionId, Key)]) -> BTreeSet<(usize, Environment)> {
        let mut touched = BTreeSet::new();
        for (condition, key) in changed {
            for (index, arguments) in &self.uses[condition.0 as usize] {
                let parameters = self.invariants.formulas[*index].parameters;
                // Quantified variables are open in the environment of an instance.
                let fits = |environment: &Environment| {
                    let mut fixed = arguments.iter().zip(key).filter(|(v, _)| slot(**v) < parameters);
                    fixed.all(|(variable, node)| environment[slot(*variable)] == Some(*node))
                };
                let undecided = |residue: &Residue| !matches!(residue, Residue::True | Residue::False);
                let instances = self.instances[*index].iter();
                let found =
                    instances.filter(|(environment, residue)| undecided(residue) && fits(environment));
                touched.extend(found.map(|(environment, _)| (*index, environment.clone())));
            }
        }
        touched
    }

    /// Instances for the nodes that are there now and have not been there.
    fn begin(&mut self) -> Vec<Broken> {
        let invariants = Arc::clone(&self.invariants);
        let mut broken = Vec::new();
        for (index, formula) in invariants.formulas.iter().enumerate().filter(|(_, f)| f.trigger.is_none()) {
            for environment in self.bindings(formula) {
                if !self.instances[index].contains_key(&environment) {
                    let at = At { formula, facts: &self.facts, now: self.now };
                    let residue = at.begin(formula.root, &environment);
                    broken.extend(self.settle(index, &environment, residue, (self.now, Cause::Change)));
                }
            }
        }
        broken
    }

    fn bindings(&self, formula: &Formula) -> Vec<Environment> {
        let parameters: Vec<VariableId> = (0..formula.parameters).map(VariableId::from_index).collect();
        let free = Environment::from_elem(None, formula.variables.len());
        At { formula, facts: &self.facts, now: self.now }.environments(&parameters, &free)
    }

    /// This state lasts until just before a moment.
    fn elapse(&mut self, until: Moment) -> Vec<Broken> {
        let mut broken = Vec::new();
        while let Some((moment, index, environment)) = self.deadlines.first().cloned()
            && moment < until
        {
            let formula = &self.invariants.formulas[index];
            let at = At { formula, facts: &self.facts, now: self.now };
            let residue = at.elapse(&self.instances[index][&environment], moment.saturating_add(1));
            broken.extend(self.settle(index, &environment, residue, (moment, Cause::Time)));
        }
        broken
    }

    /// Keeps what is left of an instance, and reports it if that is nothing that could still hold.
    fn settle(
        &mut self,
        index: usize,
        environment: &Environment,
        residue: Residue,
        (moment, by): (Moment, Cause),
    ) -> Option<Broken> {
        let entry = self.instances[index].entry(environment.clone()).or_insert(Residue::True);
        let before = deadline(entry);
        let after = deadline(&residue);
        let is_broken = residue == Residue::False;
        let formula = &self.invariants.formulas[index];
        let is_quiet = formula.trigger.is_some_and(|trigger| {
            let key: Key = environment.iter().take(formula.parameters).flatten().copied().collect();
            residue == quiet(formula, environment) && !self.facts.holds(trigger, &key)
        });
        if is_quiet {
            self.instances[index].remove(environment);
        } else {
            *entry = residue;
        }
        if before != after {
            if let Some(before) = before {
                self.deadlines.remove(&(before, index, environment.clone()));
            }
            if let Some(after) = after {
                self.deadlines.insert((after, index, environment.clone()));
            }
        }
        let how = (self.version, Time(moment), by);
        is_broken.then(|| Broken::new(&self.invariants.formulas[index], &self.facts, environment, how))
    }
}

/// What is left of a formula with a trigger for a binding for which nothing is open.
fn quiet(formula: &Formula, environment: &Environment) -> Residue {
    Residue::Open(formula.root, environment.clone(), Waiting::Every { last: None })
}
