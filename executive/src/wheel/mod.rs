//! The High Level Executive: one turn of the wheel per event.
//!
//! Problem: an executive that waits for its planner cannot notice that the patient left; one that acts on
//! what it believes talks to an empty chair. Idea: a pure state machine, `step(event) -> effects`. Time is
//! an argument; committing, planning and timers are effects that the shell carries out. Planning does
//! not stop the wheel: a decision is compared with the present before it is used.
//!
//! A turn: LowToHigh reports which predicates changed → Monitoring finds the furthest suffix of the plan that
//! still reaches the goal → the goal holds: done · a later suffix: skip ahead · the current one: refine on ·
//! none: ask Decision Support, with the reason. No plan: the mission's fallback.
//!
//! **Invariant:** the same events give the same effects. **Invariant:** a step counts as done only when
//! LowToHigh sees what it was to achieve.
//!
//! Source: §4.2 of the CORTEX/CLARC paper (HLE, Monitoring, Decision Support, HighToLow, LowToHigh).

mod course;
mod effects;
mod event;
mod failures;

pub use event::{Effect, Event};

use crate::decision_support::{Decision, Request, RequestId};
use crate::monitoring::Deviation;
use crate::narration::Narration;
use crate::outcome::{Ending, Fallback, NoPlan, StepFailure};
use crate::{Model, Step};
use course::{Course, Progress};
use dsr::{AgentId, Delta, Interest, Snapshot, Time, TransactionError};
use effects::{in_one_transaction, is_write, tell, write};
use failures::Failures;
use high_to_low::{Methods, Refinement, Status};
use low_to_high::{LowToHigh, Perception};
use planner::{FactId, OperatorId, State};
use std::sync::Arc;

/// The limits of a mission, and its fallback.
#[derive(Clone, Debug)]
pub struct Policy {
    /// The task to carry out when there is no plan, with its arguments.
    pub fallback: Step,
    /// How many states one search may expand.
    pub expansions: u64,
    /// How often one step may fail before it is not tried again in this mission.
    pub attempts: u32,
}

/// PELEA between two events.
///
/// It decides only with its own writes in view: between asking for a write and seeing it in the graph, it
/// takes in what happens and does nothing. It takes old writes back before it writes anything new, so that no intention
/// is mistaken for the remains of another.
pub struct Wheel {
    model: Arc<Model>,
    methods: Arc<Methods>,
    perception: Arc<Perception>,
    policy: Policy,
    /// LowToHigh over the last graph seen; `None` before the first.
    sight: Option<Sight>,
    phase: Phase,
    failures: Failures,
    next_request: u64,
    plans: u32,
    /// A write was asked for and not yet answered.
    unanswered: bool,
    /// A decision that came while its own write was out of view.
    deferred: Option<(RequestId, Decision)>,
}

struct Sight {
    snapshot: Snapshot,
    low_to_high: LowToHigh,
    state: State,
}

enum Phase {
    /// Nothing has been seen yet.
    Waiting,
    /// A plan has been asked for, from this state; the running step goes on until the answer comes.
    Deciding { request: RequestId, from: State, old: Old },
    /// A plan is being carried out.
    Acting(Course),
    /// There is no plan.
    FallingBack { refinement: Box<Refinement>, why: NoPlan },
    /// It is over.
    Ended,
}

/// The plan before a new one was asked for.
#[expect(clippy::large_enum_variant, reason = "a wheel has one of it")]
enum Old {
    /// No plan.
    Nothing,
    /// A plan whose current step has ended: the steps that were left.
    Stopped(Vec<OperatorId>),
    /// A plan whose current step may go on.
    Running(Course),
}

impl Old {
    /// The rest of the plan, and its step that is under way.
    fn left(&self) -> (&[OperatorId], Option<OperatorId>) {
        match self {
            Self::Nothing => (&[], None),
            Self::Stopped(left) => (left, None),
            Self::Running(course) => {
                let left = course.left();
                (left, left.first().copied().filter(|_| course.is_under_way()))
            }
        }
    }
}

impl Wheel {
    /// A wheel at rest; the first [`Event::Seen`] sets it in motion.
    pub fn new(
        model: Arc<Model>,
        perception: Arc<Perception>,
        methods: Arc<Methods>,
        policy: Policy,
    ) -> Self {
        let failures = Failures::new(policy.attempts);
        Self {
            model,
            methods,
            perception,
            policy,
            sight: None,
            phase: Phase::Waiting,
            failures,
            next_request: 0,
            plans: 0,
            unanswered: false,
            deferred: None,
        }
    }

    /// The model it plans with; Decision Support needs it.
    pub fn model(&self) -> &Arc<Model> {
        &self.model
    }

    /// The part of the graph that it reads as this writer: the tokens of perception and of the methods, and its own
    /// commits.
    pub fn interest(&self, writer: AgentId) -> Interest {
        let mut interest = Interest::default();
        interest.add_tokens(&self.perception.mentions());
        interest.add_tokens(&self.methods.mentions());
        interest.follow_commits(writer);
        interest
    }

    /// One turn.
    pub fn step(&mut self, event: Event, now: Time) -> Vec<Effect> {
        let mut effects = Vec::new();
        if matches!(self.phase, Phase::Ended) {
            return effects;
        }
        match event {
            Event::Seen(snapshot) => self.see(snapshot, None, now, &mut effects),
            Event::Changed { snapshot, delta } => self.see(snapshot, Some(&delta), now, &mut effects),
            Event::Woke => self.advance(now, &mut effects),
            Event::Decided(id, decision) => {
                self.deferred = Some((id, decision));
                self.advance(now, &mut effects);
            }
            Event::Written => {
                self.unanswered = false;
                self.advance(now, &mut effects);
            }
            Event::Refused(why) => {
                self.unanswered = false;
                self.refused(why, now, &mut effects);
            }
        }
        let effects = in_one_transaction(effects);
        self.unanswered |= effects.iter().any(is_write);
        effects
    }

    /// Takes in a version of the graph, then goes on from there.
    fn see(&mut self, snapshot: Snapshot, delta: Option<&Delta>, now: Time, effects: &mut Vec<Effect>) {
        let changes = match (&mut self.sight, delta) {
            (Some(sight), Some(delta)) => {
                let change = sight.low_to_high.update(&snapshot, delta);
                sight.snapshot = snapshot;
                let model = &self.model;
                let gone = change.disappeared.iter().filter_map(|f| Some((model.fact(f)?, false)));
                let come = change.appeared.iter().filter_map(|f| Some((model.fact(f)?, true)));
                gone.chain(come).collect::<Vec<_>>()
            }
            (sight, _) => {
                let low_to_high = LowToHigh::new(self.perception.clone(), &snapshot);
                let state = self.model.state(low_to_high.facts());
                let before = sight.replace(Sight { snapshot, low_to_high, state: state.clone() });
                before.map_or_else(Vec::new, |before| differences(&before.state, &state))
            }
        };
        if !changes.is_empty() {
            if let Some(sight) = &mut self.sight {
                sight.state = self.model.state(sight.low_to_high.facts());
            }
            if let Phase::Acting(course) | Phase::Deciding { old: Old::Running(course), .. } = &mut self.phase
            {
                course.monitor.change(&changes);
            }
        }
        self.advance(now, effects);
    }

    /// Finds the current step of the plan, and carries it further.
    fn advance(&mut self, now: Time, effects: &mut Vec<Effect>) {
        // Between asking for a write and seeing it, there is nothing to decide on.
        if self.unanswered {
            return;
        }
        let Some(sight) = &self.sight else { return };
        let task = self.model.task();
        if !matches!(self.phase, Phase::FallingBack { .. }) && task.satisfies(&sight.state, task.goal()) {
            return self.accomplished(effects);
        }
        let deferred = self.deferred.take();
        match std::mem::replace(&mut self.phase, Phase::Ended) {
            Phase::Waiting => self.ask(Old::Nothing, effects),
            Phase::Deciding { request, from, old } => match deferred {
                Some((id, decision)) if id == request => self.decided(decision, &from, old, now, effects),
                _ => self.phase = Phase::Deciding { request, from, old },
            },
            Phase::Acting(course) => self.act(course, now, effects),
            Phase::FallingBack { refinement, why } => self.fall(refinement, why, now, effects),
            Phase::Ended => {}
        }
    }

    /// Monitoring and HighToLow for the plan at hand.
    fn act(&mut self, mut course: Course, now: Time, effects: &mut Vec<Effect>) {
        let sight = self.sight.as_ref().expect("a plan is made from what was seen");
        match course.progress(self.model.task(), &sight.state) {
            Progress::Stays => {}
            Progress::Moves { to } => {
                self.failures.forget(&self.model.step(course.monitor.plan()[course.current]));
                course.move_to(to, &self.model, &sight.snapshot, effects);
            }
            Progress::Deviates => {
                let mut deviation = course.monitor.deviation(&self.model, &sight.state, course.current);
                sight.name_tokens(&mut deviation);
                effects.push(Effect::Tell(Narration::Deviated(deviation)));
                return self.ask(Old::Running(course), effects);
            }
        }
        if effects.iter().any(is_write) {
            self.phase = Phase::Acting(course);
            return;
        }
        match course.refine(&self.model, &self.methods, &sight.snapshot, now, effects) {
            Status::Running { wake_at } => {
                effects.extend(wake_at.map(Effect::WakeAt));
                self.phase = Phase::Acting(course);
            }
            // Its effects would have moved the course on above: it is carried out, and its effects are not sensed.
            Status::Done => {
                self.failed(course, StepFailure::NotSensed, effects);
            }
            Status::Failed(failure) => self.failed(course, StepFailure::Refinement(failure), effects),
        }
    }

    /// The current step failed: bar it in this state and ask for another plan.
    fn failed(&mut self, mut course: Course, why: StepFailure, effects: &mut Vec<Effect>) {
        let sight = self.sight.as_ref().expect("a plan is made from what was seen");
        let step = self.model.step(course.monitor.plan()[course.current]);
        effects.push(Effect::Tell(Narration::Failed { step: step.clone(), why }));
        self.failures.add(step, &sight.state);
        course.withdraw(&sight.snapshot, effects);
        self.ask(Old::Stopped(course.left().to_vec()), effects);
    }

    /// Asks Decision Support for a plan from here.
    fn ask(&mut self, old: Old, effects: &mut Vec<Effect>) {
        let Some(sight) = &self.sight else { return };
        let id = RequestId(self.next_request);
        self.next_request += 1;
        let (broken, running) = old.left();
        effects.push(Effect::Plan(Request {
            id,
            state: sight.state.clone(),
            broken: broken.to_vec(),
            running,
            barred: self.failures.barred(&sight.state),
            expansions: self.policy.expansions,
        }));
        self.phase = Phase::Deciding { request: id, from: sight.state.clone(), old };
    }

    /// Compares a decision, which was made for the state `from`, with the present.
    fn decided(&mut self, decision: Decision, from: &State, old: Old, now: Time, effects: &mut Vec<Effect>) {
        let Some(sight) = &self.sight else { return };
        let moved_on = sight.state != *from;
        match decision {
            Decision::Plan { operators, expanded, repair } => {
                let mut course = Course::new(&self.model, operators, &sight.state);
                if course.monitor.furthest(self.model.task(), &sight.state).is_none() {
                    return self.ask(old, effects);
                }
                let survives = match old {
                    Old::Running(old) => course.take_over(old, &sight.snapshot, effects),
                    Old::Nothing | Old::Stopped(_) => false,
                };
                self.plans += 1;
                let plan = course.monitor.plan().iter().map(|&o| self.model.step(o)).collect();
                let count = self.plans;
                effects.push(Effect::Tell(Narration::Planned { plan, expanded, survives, repair, count }));
                self.act(course, now, effects);
            }
            // A decision for another state does not hold for this one.
            Decision::NoPlan(_) if moved_on => self.ask(old, effects),
            Decision::NoPlan(why) => self.fall_back(old, why, now, effects),
        }
    }

    /// The graph refused what the current step wanted to write.
    fn refused(&mut self, why: TransactionError, now: Time, effects: &mut Vec<Effect>) {
        effects.push(Effect::Tell(Narration::Refused { why: why.clone() }));
        match std::mem::replace(&mut self.phase, Phase::Ended) {
            Phase::Acting(course) => self.failed(course, StepFailure::Refused(why), effects),
            // A fallback under way goes on too: the missing write is noticed at its deadline, and the next
            // method is tried. To end here would leave the person alone.
            other => {
                self.phase = other;
                self.advance(now, effects);
            }
        }
    }

    fn fall_back(&mut self, old: Old, why: NoPlan, now: Time, effects: &mut Vec<Effect>) {
        let Some(sight) = &self.sight else { return };
        if let Old::Running(mut course) = old {
            course.withdraw(&sight.snapshot, effects);
        }
        effects.push(Effect::Tell(Narration::FellBack { why: why.clone() }));
        let Step { action, arguments } = &self.policy.fallback;
        match Refinement::new(&self.methods, &sight.snapshot, action, arguments) {
            Ok(refinement) if effects.iter().any(is_write) => {
                self.phase = Phase::FallingBack { refinement: Box::new(refinement), why };
            }
            Ok(refinement) => self.fall(Box::new(refinement), why, now, effects),
            Err(error) => self.end_without(why, Fallback::NotStarted(error), effects),
        }
    }

    /// Carries the fallback further.
    fn fall(&mut self, mut refinement: Box<Refinement>, why: NoPlan, now: Time, effects: &mut Vec<Effect>) {
        let Some(sight) = &self.sight else { return };
        let step = refinement.step(&self.methods, &sight.snapshot, now);
        write(step.edits, effects);
        tell(step.events, effects);
        match step.status {
            Status::Running { wake_at } => {
                effects.extend(wake_at.map(Effect::WakeAt));
                self.phase = Phase::FallingBack { refinement, why };
            }
            Status::Done => self.end_without(why, Fallback::Done, effects),
            Status::Failed(failure) => self.end_without(why, Fallback::Failed(failure), effects),
        }
    }

    fn accomplished(&mut self, effects: &mut Vec<Effect>) {
        if let (Phase::Acting(course) | Phase::Deciding { old: Old::Running(course), .. }, Some(sight)) =
            (&mut self.phase, &self.sight)
        {
            let end = course.monitor.plan().len();
            course.move_to(end, &self.model, &sight.snapshot, effects);
        }
        self.end(Ending::Accomplished, effects);
    }

    fn end_without(&mut self, why: NoPlan, fallback: Fallback, effects: &mut Vec<Effect>) {
        self.end(Ending::NotAccomplished { why, fallback }, effects);
    }

    fn end(&mut self, ending: Ending, effects: &mut Vec<Effect>) {
        self.phase = Phase::Ended;
        effects.push(Effect::Tell(Narration::Ended(ending.clone())));
        effects.push(Effect::End(ending));
    }
}

impl Sight {
    /// Adds the tokens of the graph to each reason.
    fn name_tokens(&self, deviation: &mut Deviation) {
        for literal in &mut deviation.broken {
            if let Some(fact) = &literal.fact {
                literal.seen = self.low_to_high.explain(&self.snapshot, fact);
            }
        }
    }
}

fn differences(before: &State, after: &State) -> Vec<(FactId, bool)> {
    let gone = before.facts().into_iter().filter(|&f| !after.contains(f)).map(|f| (f, false));
    let come = after.facts().into_iter().filter(|&f| !before.contains(f)).map(|f| (f, true));
    gone.chain(come).collect()
}
