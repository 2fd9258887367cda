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
//! - No loop without time passing: a rule whose skill failed, or that ended in the instant in which it began,
//!   rests for a second (`REST`) for that binding.
//!
//! Cost: nothing for commits outside the agent's [interest](Agent::interest). For the others, what it takes to find the
//! matches that changed; no rule is matched as a whole again.

mod access;
mod instance;
mod matching;

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::Arc;

use dsr::{
    Commit, Mentions, News, Preemption, ReflexId, ResourceId, Snapshot, Time, Transaction, TransactionError,
};
use tracing::{debug, error};

use self::access::{Access, access};
pub use self::instance::InstanceId;
use self::instance::{Instance, Phase};
use self::matching::Matching;
use crate::rules::{Agent, Concern, Parameters, RuleId};
use crate::skill::{Call, Ended, Outcome, Skill};

/// How long a rule rests for a binding after a failure, or after it began and ended in one instant.
const REST: std::time::Duration = std::time::Duration::from_secs(1);

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

/// A rule for a binding of its parameters.
type Key = (RuleId, Parameters);

/// The purpose of the commit that the shell was asked for.
enum Pending {
    /// To take resources from lower priorities, for this rule.
    Take(Key, Vec<ResourceId>),
    /// To start this rule.
    Start(Key),
    /// To release resources that were taken and are no longer needed.
    GiveBack,
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
    taken: Option<(Key, Vec<ResourceId>)>,
    resting: BTreeMap<Key, Time>,
    /// The last time at which rules without a skill were carried out.
    carried_out: BTreeMap<Key, Time>,
    actions: VecDeque<Action>,
    pending: Option<Pending>,
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
            resting: BTreeMap::new(),
            carried_out: BTreeMap::new(),
            actions: VecDeque::new(),
            pending: None,
        }
    }

    /// The agent.
    pub fn agent(&self) -> &Arc<Agent> {
        &self.agent
    }

    /// How many rules run.
    pub fn running(&self) -> usize {
        self.instances.len()
    }

    /// News of a subscription to the agent's [interest](Agent::interest), in their order. May come late. The first news
    /// of another subscription starts over: nothing but the guards in the graph is needed to go on.
    pub fn changed(&mut self, news: &News) {
        for delta in &news.deltas {
            delta.reflexes.iter().for_each(|&reflex| self.fired(reflex));
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
            self.stopped(&key);
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
        limits.chain(self.resting.values().copied()).min()
    }

    /// The next action for the present graph and time; `None` when there is none until the next event. All news of the
    /// present graph must have been reported.
    pub fn next_action(&mut self, snapshot: &Snapshot, now: Time) -> Option<Action> {
        self.time_out(now);
        if let Some(action) = self.actions.pop_front() {
            return Some(action);
        }
        self.end_one(snapshot)
            .or_else(|| self.use_what_was_taken(snapshot, now))
            .or_else(|| self.start_one(snapshot, now))
            .map(Action::Commit)
    }

    /// The result of the commit that was asked for.
    pub fn committed(&mut self, result: Result<&Commit, &TransactionError>, now: Time) {
        let Some(pending) = self.pending.take() else { return };
        match (pending, result) {
            (Pending::Take(key, resources), Ok(_)) => self.taken = Some((key, resources)),
            (Pending::Start(key), Ok(commit)) => self.started(key, commit, now),
            (Pending::End(key), Ok(_)) => self.finished(&key, now),
            (Pending::GiveBack, Ok(_)) => {}
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
        let dirty = &mut self.dirty;
        self.resting.retain(|(rule, _), until| {
            let rests = *until > now;
            if !rests {
                dirty.insert(*rule);
            }
            rests
        });
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
                    let mut transaction = transaction(&self.agent, snapshot);
                    transaction.dismiss(instance.guard).extend(edits);
                    self.pending = Some(Pending::End(key.clone()));
                    return Some(transaction);
                }
                Err(refusal) => {
                    error!(rule = %rule.name, outcome = %ended.outcome, %refusal, "a rule cannot end so");
                    instance.phase = instance.phase.retreat();
                }
            }
        }
    }

    /// Starts the rule for which resources were taken, or gives them back.
    fn use_what_was_taken(&mut self, snapshot: &Snapshot, now: Time) -> Option<Transaction> {
        let (key, resources) = self.taken.take()?;
        if self.agent.rule(key.0).may_start(snapshot, &key.1)
            && let Some(start) = self.start(snapshot, key, &resources, now)
        {
            return Some(start);
        }
        let mut transaction = transaction(&self.agent, snapshot);
        for resource in resources {
            transaction.release(resource);
        }
        self.pending = Some(Pending::GiveBack);
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
            if self.instances.contains_key(&key) || self.resting.contains_key(&key) {
                continue;
            }
            let rule = self.agent.rule(key.0);
            if !rule.may_start(snapshot, &key.1) {
                continue;
            }
            match access(snapshot, rule) {
                Access::Free => {
                    if let Some(start) = self.start(snapshot, key, &[], now) {
                        return Some(start);
                    }
                }
                Access::Refused => {}
                Access::Takeable(resources) => {
                    let mut transaction = transaction(&self.agent, snapshot);
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

    /// The commit that starts a rule; `held` has been claimed for it before.
    fn start(
        &mut self,
        snapshot: &Snapshot,
        key: Key,
        held: &[ResourceId],
        now: Time,
    ) -> Option<Transaction> {
        let rule = self.agent.rule(key.0);
        let mut transaction = transaction(&self.agent, snapshot);
        for &resource in rule.claims.iter().filter(|resource| !held.contains(resource)) {
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
            self.rest(&key, now);
            return None;
        }
        self.pending = Some(Pending::Start(key));
        Some(transaction)
    }

    fn started(&mut self, key: Key, commit: &Commit, now: Time) {
        let rule = self.agent.rule(key.0);
        let Some((skill, arguments)) = &rule.skill else {
            if self.carried_out.insert(key.clone(), now) == Some(now) {
                self.rest(&key, now);
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
        };
        self.actions.push_back(Action::Launch { instance, skill: Arc::clone(skill), call });
        self.instances
            .insert(key, Instance { id: instance, guard, since: now, deadline, phase: Phase::Running });
    }

    /// An instance has committed its end.
    fn finished(&mut self, key: &Key, now: Time) {
        let Some(instance) = self.instances.remove(key) else { return };
        self.dirty.insert(key.0);
        if let Phase::Ending(ended) = &instance.phase {
            debug!(
                agent = %self.agent.name, rule = %self.agent.rule(key.0).name, outcome = %ended.outcome, "ends"
            );
            if instance.since == now || ended.outcome.name() == Outcome::FAILURE {
                self.rest(key, now);
            }
        }
    }

    fn refused(&mut self, pending: Pending, refusal: &TransactionError, now: Time) {
        match (pending, refusal) {
            // The graph moved on; the same question gets a new answer.
            (Pending::Take(key, _) | Pending::Start(key), TransactionError::Stale { .. }) => {
                self.candidates.push_front(key);
            }
            (Pending::End(_), TransactionError::Stale { .. }) => {}
            // Another agent was faster, or what the start would leave does not keep: later news ask again.
            (
                Pending::Take(..) | Pending::Start(_),
                TransactionError::ResourceHeld { .. } | TransactionError::KeepBroken { .. },
            ) => {}
            // The guard was faster than the end; `abort` is written.
            (Pending::End(key), TransactionError::ReflexGone { .. }) => self.stopped(&key),
            // What was taken is gone by itself if another agent took it; otherwise nothing else is left to try.
            (Pending::GiveBack, refusal) => debug!(%refusal, "nothing to give back"),
            (Pending::Take(key, _) | Pending::Start(key), refusal) => {
                error!(rule = %self.agent.rule(key.0).name, %refusal, "a rule cannot start");
                self.rest(&key, now);
            }
            (Pending::End(key), refusal) => {
                error!(rule = %self.agent.rule(key.0).name, %refusal, "a rule cannot end so");
                if let Some(instance) = self.instances.get_mut(&key) {
                    instance.phase = instance.phase.retreat();
                }
            }
        }
    }

    /// A reflex fired: if it was the guard of an instance, its skill is dropped.
    fn fired(&mut self, reflex: ReflexId) {
        let key =
            self.instances.iter().find(|(_, instance)| instance.guard == reflex).map(|(key, _)| key.clone());
        if let Some(key) = key {
            debug!(agent = %self.agent.name, rule = %self.agent.rule(key.0).name, "reflex");
            self.stopped(&key);
        }
    }

    fn stopped(&mut self, key: &Key) {
        if let Some(instance) = self.instances.remove(key) {
            self.dirty.insert(key.0);
            // Before anything that is still to be launched.
            self.actions.retain(
                |action| !matches!(action, Action::Launch { instance: id, .. } if *id == instance.id),
            );
            self.actions.push_front(Action::Stop(instance.id));
        }
    }

    fn rest(&mut self, key: &Key, now: Time) {
        self.resting.insert(key.clone(), after(now, REST));
    }
}

/// A transaction on exactly this version, the one that the decision was made on.
fn transaction(agent: &Agent, snapshot: &Snapshot) -> Transaction {
    let mut transaction = Transaction::new(agent.id);
    transaction.expect_version(snapshot.version());
    transaction
}

fn after(now: Time, duration: std::time::Duration) -> Time {
    Time(now.0.saturating_add(u64::try_from(duration.as_nanos()).unwrap_or(u64::MAX)))
}

impl std::fmt::Debug for Runtime {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Runtime")
            .field("agent", &self.agent.name)
            .field("instances", &self.instances)
            .field("resting", &self.resting)
            .finish_non_exhaustive()
    }
}
