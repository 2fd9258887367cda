//! The runtime of one agent: a pure state machine from news of the graph to actions.
//!
//! Problem: an agent must start each rule as soon as its condition holds, never twice, stop it when its reflex
//! fires, and write the effects of its outcome, while the graph moves on under it. Idea: no I/O here. The shell
//! reports news of the graph, endings and the time, and asks for the next [`Action`] until there is none; every commit
//! is on the very version that the decision was made on.
//!
//! Invariants:
//! - Rules are level-triggered: a rule starts for a binding whenever its conditions hold and it does not already run
//!   for it. Nothing is lost by being busy, restarted, or late.
//! - One instance is one guard in the graph. The instance ends exactly once: by its own commit, which dismisses
//!   the guard, or by the guard, which has then written the effects of `abort` already.
//! - A resource that is held at a lower priority is taken in a commit of its own. The reflexes of its holder
//!   write in that commit, so the rule starts on a graph that they have left in order.
//! - What was taken is used by that start or given back: also when the start is refused, or when the commit that gives
//!   it back comes too late.
//! - No loop without time passing: a rule begins at most twice for a binding within an instant, whatever ends it, and
//!   rests after attempts that led to nothing (`patience`).
//!
//! Cost: nothing for commits outside the agent's [interest](Agent::interest). For the others, what it takes to find the
//! matches that changed; no rule is matched as a whole again.

mod access;
mod instance;
mod matching;
mod patience;

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::Arc;
use std::time::Duration;

use dsr::{
    Commit, Epoch, Mentions, News, NodeId, Preemption, ReflexId, ResourceId, Snapshot, Time, Transaction,
    TransactionError,
};
use pddl::model::Name;
use tracing::{debug, error};

use self::access::{Access, Grant, access};
pub use self::instance::InstanceId;
use self::instance::{Instance, Key, Phase};
use self::matching::Matching;
use self::patience::{Patience, after};
use crate::rules::{Agent, Concern, RuleId};
use crate::skill::{Call, Ended, Outcome, Skill};

/// What the shell must do.
pub enum Action {
    /// Commit this, and hand the result to [`Runtime::committed`] before any news.
    Commit(Transaction),
    /// Run this skill, and hand its ending to [`Runtime::ended`].
    Launch {
        /// The instance that it is for.
        instance: InstanceId,
        /// The skill.
        skill: Arc<dyn Skill>,
        /// Its arguments.
        call: Call,
    },
    /// Drop the skill of this instance, if it still runs.
    Stop(InstanceId),
}

/// A rule that rests for a binding of its parameters.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rest {
    /// The rule.
    pub rule: Name,
    /// The nodes that stand for its parameters.
    pub parameters: Vec<NodeId>,
    /// After how many attempts in a row that led to nothing.
    pub in_a_row: u32,
    /// Until when.
    pub until: Time,
}

/// The purpose of the commit that the shell was asked for.
enum Pending {
    /// To take resources from lower priorities, for this rule.
    Take(Key, Vec<ResourceId>),
    /// To start this rule, for which these resources were taken before.
    Start(Key, Vec<Grant>),
    /// To release resources that were taken and are no longer needed.
    GiveBack(Vec<Grant>),
    /// To end this instance.
    End(Key),
}

/// The state of one agent.
pub struct Runtime {
    agent: Arc<Agent>,
    instances: BTreeMap<Key, Instance>,
    next: u64,
    matching: Matching,
    /// Rules that may start now and could not before.
    dirty: BTreeSet<RuleId>,
    /// Bindings to look at, before the next dirty rule is.
    candidates: VecDeque<Key>,
    /// Resources taken for a rule that is about to start.
    taken: Option<(Key, Vec<Grant>)>,
    /// Resources that were taken in vain.
    give_back: Vec<Grant>,
    patience: Patience,
    actions: VecDeque<Action>,
    pending: Option<Pending>,
    /// The life of the agent for which this runtime writes.
    epoch: Option<Epoch>,
    /// Whether that life is over.
    fenced: bool,
}

impl Runtime {
    /// An agent that has not seen the graph yet.
    pub fn new(agent: Arc<Agent>) -> Self {
        Self {
            agent,
            instances: BTreeMap::new(),
            next: 0,
            matching: Matching::default(),
            dirty: BTreeSet::new(),
            candidates: VecDeque::new(),
            taken: None,
            give_back: Vec::new(),
            patience: Patience::default(),
            actions: VecDeque::new(),
            pending: None,
            epoch: None,
            fenced: false,
        }
    }

    /// Writes for this life of the agent alone: after it, every commit is refused, and the runtime stops.
    #[must_use]
    pub fn in_epoch(mut self, epoch: Epoch) -> Self {
        self.epoch = Some(epoch);
        self
    }

    /// Whether the agent was declared dead or replaced: all that is left to do is to stop its skills.
    pub fn is_fenced(&self) -> bool {
        self.fenced
    }

    /// The agent.
    pub fn agent(&self) -> &Arc<Agent> {
        &self.agent
    }

    /// How many rules run.
    pub fn running(&self) -> usize {
        self.instances.len()
    }

    /// The rules that rest, with the bindings for which they do.
    pub fn resting(&self) -> impl Iterator<Item = Rest> + '_ {
        self.patience.resting().map(|((rule, parameters), in_a_row, until)| Rest {
            rule: self.agent.rule(*rule).name.clone(),
            parameters: parameters.nodes().to_vec(),
            in_a_row,
            until,
        })
    }

    /// News of a subscription to the agent's [interest](Agent::interest), in their order. May come late. The first news
    /// of another subscription starts over: nothing but the guards in the graph is needed to go on.
    pub fn changed(&mut self, news: &News) {
        for delta in &news.deltas {
            delta.reflexes.iter().for_each(|&reflex| self.fired(reflex, delta.time));
            self.may_now_keep(&Mentions::of(delta));
        }
        if news.deltas.is_empty() {
            self.look_around(&news.snapshot);
            if news.missed == 0 {
                self.matching = Matching::default();
            }
        }
        for changed in &news.matches {
            match self.agent.concern(changed.pattern) {
                Concern::Start { rule, .. } => {
                    self.matching.update(&self.agent, changed);
                    self.dirty.insert(rule);
                }
                Concern::Lease(resource) => {
                    let claim = self.agent.enumerate().filter(|(_, rule)| rule.claims.contains(&resource));
                    self.dirty.extend(claim.map(|(id, _)| id));
                }
            }
        }
    }

    /// Rules that were refused because their own effects at start would have broken their condition over all.
    fn may_now_keep(&mut self, touched: &Mentions) {
        let unsure = self.agent.enumerate().filter(|(_, rule)| rule.unsure().intersects(touched));
        self.dirty.extend(unsure.map(|(id, _)| id));
    }

    /// A state without the commits that led to it. Instances whose condition over all does not hold there have been
    /// stopped by their guards; others that were stopped find their guard gone when they end.
    fn look_around(&mut self, snapshot: &Snapshot) {
        let broken: Vec<Key> = self
            .instances
            .iter()
            .filter(|((rule, parameters), _)| !self.agent.rule(*rule).keeps(snapshot, parameters))
            .map(|(key, _)| key.clone())
            .collect();
        for key in broken {
            self.stopped(&key, snapshot.time());
        }
        self.dirty.extend(self.agent.rule_ids());
    }

    /// A skill ended. The ending is ignored if the reflex of the instance was faster.
    pub fn ended(&mut self, id: InstanceId, ended: Ended) {
        if let Some(instance) = self.instances.values_mut().find(|instance| instance.id == id)
            && matches!(instance.phase, Phase::Running)
        {
            instance.phase = Phase::Ending(ended);
        }
    }

    /// The next instant at which [`Runtime::next_action`] must be called even without any event.
    pub fn deadline(&self) -> Option<Time> {
        let limits = self.instances.values().filter_map(|instance| instance.deadline);
        limits.chain(self.patience.next()).min()
    }

    /// The next action for the present graph and time; `None` when there is none until the next event. All news of the
    /// present graph must have been reported.
    pub fn next_action(&mut self, snapshot: &Snapshot, now: Time) -> Option<Action> {
        self.time_out(now);
        if let Some(action) = self.actions.pop_front() {
            return Some(action);
        }
        if self.fenced {
            return None;
        }
        self.end_one(snapshot)
            .or_else(|| self.use_what_was_taken(snapshot, now))
            .or_else(|| self.give_back(snapshot))
            .or_else(|| self.start_one(snapshot, now))
            .map(Action::Commit)
    }

    /// The result of the commit that was asked for.
    pub fn committed(&mut self, result: Result<&Commit, &TransactionError>, now: Time) {
        let Some(pending) = self.pending.take() else { return };
        match (pending, result) {
            (Pending::Take(key, resources), Ok(commit)) => {
                let grant = |resource| Grant { resource, version: commit.version };
                self.taken = Some((key, resources.into_iter().map(grant).collect()));
            }
            (Pending::Start(key, _), Ok(commit)) => self.started(key, commit, now),
            (Pending::End(key), Ok(_)) => self.finished(&key, now),
            (Pending::GiveBack(_), Ok(_)) => {}
            (pending, Err(error)) => self.refused(pending, error, now),
        }
    }

    /// Ends skills whose duration is over, and the rest of bindings.
    fn time_out(&mut self, now: Time) {
        for ((rule, _), instance) in &mut self.instances {
            if instance.deadline.is_some_and(|deadline| deadline <= now) {
                instance.deadline = None;
                if matches!(instance.phase, Phase::Running) {
                    debug!(rule = %self.agent.rule(*rule).name, "timeout");
                    instance.phase = Phase::Ending(Ended::otherwise(Outcome::TIMEOUT));
                    self.actions.push_back(Action::Stop(instance.id));
                }
            }
        }
        let instances = &self.instances;
        self.dirty.extend(self.patience.awake(now, |key| instances.contains_key(key)));
    }

    /// The commit that ends an instance whose skill has ended.
    fn end_one(&mut self, snapshot: &Snapshot) -> Option<Transaction> {
        loop {
            let (key, instance) =
                self.instances.iter_mut().find(|(_, instance)| matches!(instance.phase, Phase::Ending(_)))?;
            let Phase::Ending(ended) = &instance.phase else { return None };
            let rule = self.agent.rule(key.0);
            match rule.after(snapshot, &key.1, ended) {
                Ok(edits) => {
                    let (key, guard) = (key.clone(), instance.guard);
                    let mut transaction = self.transaction(snapshot);
                    transaction.dismiss(guard).extend(edits);
                    self.pending = Some(Pending::End(key));
                    return Some(transaction);
                }
                Err(refusal) => {
                    error!(rule = %rule.name, outcome = %ended.outcome, %refusal, "a rule cannot end so");
                    instance.retreat();
                }
            }
        }
    }

    /// Starts the rule for which resources were taken, if it may start and all of them are still there.
    fn use_what_was_taken(&mut self, snapshot: &Snapshot, now: Time) -> Option<Transaction> {
        let (key, taken) = self.taken.take()?;
        if !taken.iter().all(|grant| grant.holds(snapshot, self.agent.id)) {
            // Another agent took one of them meanwhile: the rule asks again like any other.
            self.give_back.extend(taken);
            self.candidates.push_front(key);
            return None;
        }
        if self.agent.rule(key.0).may_start(snapshot, &key.1) {
            return self.start(snapshot, key, taken, now);
        }
        self.give_back.extend(taken);
        self.fruitless(&key, now);
        None
    }

    /// The commit that releases what was taken in vain, as far as it still belongs to this agent.
    fn give_back(&mut self, snapshot: &Snapshot) -> Option<Transaction> {
        let mut grants = std::mem::take(&mut self.give_back);
        grants.retain(|grant| grant.holds(snapshot, self.agent.id));
        if grants.is_empty() {
            return None;
        }
        let mut transaction = self.transaction(snapshot);
        for grant in &grants {
            transaction.release(grant.resource);
        }
        self.pending = Some(Pending::GiveBack(grants));
        Some(transaction)
    }

    /// The commit that starts the next rule that may start, or takes resources for it.
    fn start_one(&mut self, snapshot: &Snapshot, now: Time) -> Option<Transaction> {
        loop {
            let Some(key) = self.candidates.pop_front() else {
                let rule = self.most_urgent_dirty()?;
                self.dirty.remove(&rule);
                let bindings = self.matching.bindings(rule);
                self.candidates = bindings.map(|parameters| (rule, parameters.clone())).collect();
                continue;
            };
            if self.instances.contains_key(&key) || self.patience.rests(&key) {
                continue;
            }
            let rule = self.agent.rule(key.0);
            if !rule.may_start(snapshot, &key.1) {
                continue;
            }
            match access(snapshot, rule) {
                Access::Free => {
                    if let Some(start) = self.start(snapshot, key, Vec::new(), now) {
                        return Some(start);
                    }
                }
                Access::Refused => {}
                Access::Takeable(resources) => {
                    let mut transaction = self.transaction(snapshot);
                    for &resource in &resources {
                        transaction.claim(resource, rule.priority, Preemption::Yields);
                    }
                    self.pending = Some(Pending::Take(key, resources));
                    return Some(transaction);
                }
            }
        }
    }

    fn most_urgent_dirty(&self) -> Option<RuleId> {
        self.dirty.iter().copied().min_by_key(|&id| (std::cmp::Reverse(self.agent.rule(id).priority), id))
    }

    /// The commit that starts a rule; `held` has been taken for it before.
    fn start(&mut self, snapshot: &Snapshot, key: Key, held: Vec<Grant>, now: Time) -> Option<Transaction> {
        let rule = self.agent.rule(key.0);
        let mut transaction = self.transaction(snapshot);
        let is_held = |resource| held.iter().any(|grant| grant.resource == resource);
        for &resource in rule.claims.iter().filter(|&&resource| !is_held(resource)) {
            transaction.claim(resource, rule.priority, Preemption::Yields);
        }
        let prepared = rule.meanwhile(snapshot, &key.1).and_then(|edits| {
            transaction.extend(edits);
            if rule.skill.is_some() {
                transaction.guard(rule.reflex(self.agent.id, snapshot, &key.1)?);
            }
            Ok(())
        });
        if let Err(refusal) = prepared {
            error!(rule = %rule.name, %refusal, "a rule cannot start");
            self.give_back.extend(held);
            self.fruitless(&key, now);
            return None;
        }
        self.pending = Some(Pending::Start(key, held));
        Some(transaction)
    }

    fn started(&mut self, key: Key, commit: &Commit, now: Time) {
        let again = self.patience.begins(&key, now);
        let rule = self.agent.rule(key.0);
        let Some((skill, arguments)) = &rule.skill else {
            if again {
                self.fruitless(&key, now);
            }
            return;
        };
        let Some(&guard) = commit.guards.first() else { return };
        debug!(agent = %self.agent.name, rule = %rule.name, version = commit.version.0, "starts");
        let instance = InstanceId(self.next);
        self.next += 1;
        let deadline = rule.limit.map(|limit| after(now, limit));
        let call = Call {
            arguments: arguments
                .iter()
                .map(|argument| rule.argument(argument, &commit.snapshot, &key.1))
                .collect(),
            snapshot: commit.snapshot.clone(),
            since: rule.since(&commit.snapshot, &key.1).unwrap_or(commit.version),
        };
        self.actions.push_back(Action::Launch { instance, skill: Arc::clone(skill), call });
        self.instances.insert(key, Instance::begin(instance, guard, now, deadline));
    }

    /// An instance has committed its end.
    fn finished(&mut self, key: &Key, now: Time) {
        let Some(instance) = self.instances.remove(key) else { return };
        self.dirty.insert(key.0);
        if let Phase::Ending(ended) = &instance.phase {
            debug!(
                agent = %self.agent.name, rule = %self.agent.rule(key.0).name, outcome = %ended.outcome, "ends"
            );
            let failed = instance.refused || ended.outcome.name() == Outcome::FAILURE;
            let rest = self.patience.ended(key, instance.since, now, failed);
            self.say_that_it_rests(key, rest);
        }
    }

    fn refused(&mut self, pending: Pending, refusal: &TransactionError, now: Time) {
        match (pending, refusal) {
            (_, TransactionError::Fenced { .. }) => self.fence(),
            // The graph moved on; the same question gets a new answer.
            (Pending::Take(key, _), TransactionError::Stale { .. }) => self.candidates.push_front(key),
            (Pending::Start(key, held), TransactionError::Stale { .. }) if held.is_empty() => {
                self.candidates.push_front(key);
            }
            (Pending::Start(key, held), TransactionError::Stale { .. }) => self.taken = Some((key, held)),
            (Pending::GiveBack(grants), TransactionError::Stale { .. }) => self.give_back = grants,
            (Pending::End(_), TransactionError::Stale { .. }) => {}
            // Another agent was faster, or what the start would leave does not keep: later news ask again.
            (
                Pending::Take(..),
                TransactionError::ResourceHeld { .. } | TransactionError::KeepBroken { .. },
            ) => {}
            (
                Pending::Start(key, held),
                TransactionError::ResourceHeld { .. } | TransactionError::KeepBroken { .. },
            ) => {
                if !held.is_empty() {
                    self.give_back.extend(held);
                    self.fruitless(&key, now);
                }
            }
            // The guard was faster than the end; `abort` is written.
            (Pending::End(key), TransactionError::ReflexGone { .. }) => self.stopped(&key, now),
            (Pending::GiveBack(_), refusal) => error!(%refusal, "resources cannot be given back"),
            (Pending::Take(key, _), refusal) => self.cannot_start(&key, refusal, now),
            (Pending::Start(key, held), refusal) => {
                self.give_back.extend(held);
                self.cannot_start(&key, refusal, now);
            }
            (Pending::End(key), refusal) => {
                error!(rule = %self.agent.rule(key.0).name, %refusal, "a rule cannot end so");
                if let Some(instance) = self.instances.get_mut(&key) {
                    instance.retreat();
                }
            }
        }
    }

    /// This life is over; the graph has returned the leases and fired the guards.
    fn fence(&mut self) {
        self.fenced = true;
        self.actions.clear();
        let running = std::mem::take(&mut self.instances);
        self.actions.extend(running.into_values().map(|instance| Action::Stop(instance.id)));
    }

    fn cannot_start(&mut self, key: &Key, refusal: &TransactionError, now: Time) {
        error!(rule = %self.agent.rule(key.0).name, %refusal, "a rule cannot start");
        self.fruitless(key, now);
    }

    /// A reflex fired: if it was the guard of an instance, its skill is dropped.
    fn fired(&mut self, reflex: ReflexId, now: Time) {
        let key =
            self.instances.iter().find(|(_, instance)| instance.guard == reflex).map(|(key, _)| key.clone());
        if let Some(key) = key {
            debug!(agent = %self.agent.name, rule = %self.agent.rule(key.0).name, "reflex");
            self.stopped(&key, now);
        }
    }

    fn stopped(&mut self, key: &Key, now: Time) {
        if let Some(instance) = self.instances.remove(key) {
            self.dirty.insert(key.0);
            let rest = self.patience.stopped(key, instance.since, now);
            self.say_that_it_rests(key, rest);
            // Before anything that is still to be launched.
            self.actions.retain(
                |action| !matches!(action, Action::Launch { instance: id, .. } if *id == instance.id),
            );
            self.actions.push_front(Action::Stop(instance.id));
        }
    }

    /// A transaction on exactly this version, the one that the decision was made on.
    fn transaction(&self, snapshot: &Snapshot) -> Transaction {
        let mut transaction = Transaction::new(self.agent.id);
        transaction.expect_version(snapshot.version());
        if let Some(epoch) = self.epoch {
            transaction.in_epoch(self.agent.id, epoch);
        }
        transaction
    }

    /// An attempt of this instant led to nothing.
    fn fruitless(&mut self, key: &Key, now: Time) {
        let rest = self.patience.fruitless(key, now, now);
        self.say_that_it_rests(key, Some(rest));
    }

    fn say_that_it_rests(&self, key: &Key, rest: Option<Duration>) {
        if let Some(rest) = rest {
            let (agent, rule) = (&self.agent.name, &self.agent.rule(key.0).name);
            debug!(%agent, %rule, parameters = ?key.1, seconds = rest.as_secs(), "rests");
        }
    }
}

impl std::fmt::Debug for Runtime {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Runtime")
            .field("agent", &self.agent.name)
            .field("instances", &self.instances)
            .field("patience", &self.patience)
            .finish_non_exhaustive()
    }
}
