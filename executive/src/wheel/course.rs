//! A plan under way: a partial order of steps, those that are being carried out, and their refinements.
//!
//! Idea: a step may start when the steps that it is ordered behind are done ([`Model::order`]); a plan without durative
//! actions is a total order. Steps that are not ordered have no effect on each other, so one linearisation of what is
//! left speaks for all. To see which step is done, each step that may come first has a *line*: a linearisation that
//! begins with it, monitored. The furthest suffix of a line that reaches the goal leaves out what is done. A step whose
//! start was perceived stands in the lines as what is left of it.
//!
//! Invariant: every line has exactly the steps that are not done, and there is always one. Cost: as many monitors as
//! steps may come first; a total order has one, which lives as long as the course.

use super::backoff::after;
use super::effects::{tell, write};
use super::event::Effect;
use crate::Model;
use crate::monitoring::{Deviation, Monitor};
use crate::narration::Narration;
use dsr::{Edit, HolderRef, Snapshot, Time};
use high_to_low::{Methods, Moment, Refinement, Status};
use planner::{FactId, Goal, OperatorId, State, Task};

/// A plan under way.
pub(super) struct Course {
    plan: Vec<OperatorId>,
    goal: Goal,
    /// By step: the steps that must be done before it starts.
    before: Vec<Vec<usize>>,
    done: Vec<bool>,
    lines: Vec<Line>,
    running: Vec<Running>,
    /// A step has ended without its effects: the plan does not fit, whatever is perceived.
    stopped: bool,
}

/// A linearisation of the steps that are not done, from `at` on.
struct Line {
    steps: Vec<usize>,
    at: usize,
    monitor: Monitor,
}

/// A step that is being carried out.
struct Running {
    step: usize,
    refinement: Refinement,
    wake_at: Option<Time>,
    /// When the step has failed, and after how many seconds.
    deadline: Option<(Time, f64)>,
}

/// What Monitoring finds about a course.
pub(super) enum Progress {
    /// Nothing more is done.
    Stays,
    /// These steps are done or not necessary any more.
    Moves(Vec<usize>),
    /// What is left does not reach the goal.
    Deviates,
}

/// What became of a step that was to be carried further.
pub(super) enum Carried {
    /// Another step has what it wants to write.
    Waits,
    /// It took its deadline of so many seconds.
    Late(f64),
    Is(Status),
}

impl Course {
    pub(super) fn new(model: &Model, plan: Vec<OperatorId>, goal: Goal, state: &State) -> Self {
        let (before, done) = (model.order(&plan), vec![false; plan.len()]);
        let (lines, running) = (Vec::new(), Vec::new());
        let mut course = Self { plan, goal, before, done, lines, running, stopped: false };
        course.draw_lines(model, state);
        course
    }

    /// The same plan with what has been begun of another, whose steps these are; those that are `None` are withdrawn.
    pub(super) fn carrying(
        mut self,
        mut other: Self,
        places: &[Option<usize>],
        snapshot: &Snapshot,
        effects: &mut Vec<Effect>,
    ) -> Self {
        let left = other.lines[0].left().to_vec();
        for mut own in std::mem::take(&mut other.running) {
            let place = left.iter().position(|&step| step == own.step).and_then(|at| places[at]);
            match place {
                Some(step) => self.running.push(Running { step, ..own }),
                None => write(own.refinement.cancel(snapshot), effects),
            }
        }
        self
    }

    /// The whole plan.
    pub(super) fn plan(&self) -> &[OperatorId] {
        &self.plan
    }

    /// The steps that are left, as one of them may be carried out after the other.
    pub(super) fn left(&self) -> Vec<OperatorId> {
        self.lines[0].left().iter().map(|&step| self.plan[step]).collect()
    }

    /// The operator of a step.
    pub(super) fn operator(&self, step: usize) -> OperatorId {
        self.plan[step]
    }

    /// The steps that may be carried out now: those under way, and those that are not ordered behind any step that is
    /// left.
    pub(super) fn front(&self) -> Vec<usize> {
        let free = |&step: &usize| {
            !self.done[step]
                && (self.is_running(step) || self.before[step].iter().all(|&before| self.done[before]))
        };
        (0..self.plan.len()).filter(free).collect()
    }

    /// The steps that are being carried out.
    pub(super) fn running(&self) -> Vec<usize> {
        self.running.iter().map(|running| running.step).collect()
    }

    /// Whether a step has been started.
    pub(super) fn is_running(&self, step: usize) -> bool {
        self.running.iter().any(|running| running.step == step)
    }

    /// Whether any step has been started and is not done.
    pub(super) fn is_under_way(&self) -> bool {
        !self.running.is_empty()
    }

    /// When a step goes on even if nothing changes.
    pub(super) fn wake_at(&self) -> Option<Time> {
        let times = self.running.iter().flat_map(|own| [own.wake_at, own.deadline.map(|(at, _)| past(at))]);
        times.flatten().min()
    }

    pub(super) fn observe(&mut self, task: &Task, state: &State) {
        self.lines.iter_mut().for_each(|line| line.monitor.observe(task, state));
    }

    pub(super) fn progress(&self, task: &Task) -> Progress {
        if self.stopped {
            return Progress::Deviates;
        }
        // An earlier suffix may reach the goal, by steps that were meant for another situation; Decision Support
        // decides whether that is the best way from here.
        let further = |line: &Line| line.monitor.furthest(task).filter(|&to| to >= line.at);
        let lines = self.lines.iter().filter_map(|line| Some((line, further(line)?)));
        // Of two lines that get as far, the first.
        match lines.rev().max_by_key(|(line, to)| to - line.at) {
            None => Progress::Deviates,
            Some((line, to)) if to == line.at => Progress::Stays,
            Some((line, to)) => Progress::Moves(line.steps[line.at..to].to_vec()),
        }
    }

    /// Why what is left does not reach the goal.
    pub(super) fn deviation(&self, model: &Model, state: &State) -> Deviation {
        self.lines[0].monitor.deviation(model, state, self.lines[0].at)
    }

    /// Leaves steps that are done. Returns those that were being carried out, and the first.
    pub(super) fn leave(
        &mut self,
        steps: &[usize],
        model: &Model,
        state: &State,
        snapshot: &Snapshot,
        effects: &mut Vec<Effect>,
    ) -> Vec<OperatorId> {
        let (mut achieved, mut skipped) = (Vec::new(), Vec::new());
        for (i, &step) in steps.iter().enumerate() {
            let (index, operator) = (step, self.plan[step]);
            if i == 0 || self.is_running(step) {
                effects.push(Effect::Tell(Narration::Achieved { index, step: model.step(operator) }));
                achieved.push(operator);
            } else {
                skipped.push(model.step(operator));
            }
        }
        if !skipped.is_empty() {
            effects.push(Effect::Tell(Narration::Skipped { steps: skipped }));
        }
        for &step in steps {
            self.withdraw_one(step, snapshot, effects);
            self.done[step] = true;
        }
        self.draw_lines(model, state);
        achieved
    }

    /// A line for each step that may come first. One that is still what it should be stays.
    fn draw_lines(&mut self, model: &Model, state: &State) {
        for line in &mut self.lines {
            while line.steps.get(line.at).is_some_and(|&step| self.done[step]) {
                line.at += 1;
            }
        }
        let is_left = |&step: &usize| !self.done[step];
        let left: Vec<usize> = (0..self.plan.len()).filter(is_left).collect();
        let first = |&step: &usize| self.before[step].iter().all(|&before| self.done[before]);
        let fronts: Vec<Option<usize>> = match left.iter().copied().filter(first).collect::<Vec<_>>() {
            none if none.is_empty() => vec![None],
            fronts => fronts.into_iter().map(Some).collect(),
        };
        let mut old = std::mem::take(&mut self.lines);
        for front in fronts {
            let fits = |line: &Line| {
                line.left().first().copied() == front && line.left().iter().all(|&step| !self.done[step])
            };
            let line = match old.iter().position(fits) {
                Some(at) => old.swap_remove(at),
                None => {
                    let others = left.iter().copied().filter(|&step| Some(step) != front);
                    let steps: Vec<usize> = front.into_iter().chain(others).collect();
                    let plan = steps.iter().map(|&step| self.plan[step]).collect();
                    let goal = self.goal.clone();
                    Line { steps, at: 0, monitor: Monitor::new(model.task(), plan, goal, state) }
                }
            };
            self.lines.push(line);
        }
    }

    /// The facts that actions are under way.
    pub(super) fn under_way(&self, model: &Model) -> Vec<FactId> {
        let running: Vec<_> = self.running.iter().map(|own| self.plan[own.step]).collect();
        model.under_way(&running)
    }

    /// Puts what is left of them in the place of the steps whose start is perceived. Whether there are any; the lines
    /// must then be drawn anew.
    pub(super) fn notice_starts(&mut self, model: &Model, state: &State) -> bool {
        let (timing, task) = (model.timing(), model.task());
        let mut any = false;
        for own in &self.running {
            let whole = self.plan[own.step];
            if timing.has_started(task, whole, state)
                && let Some(rest) = timing.rest(task, whole)
            {
                self.plan[own.step] = rest;
                any = true;
            }
        }
        any
    }

    /// Draws all lines anew.
    pub(super) fn redraw(&mut self, model: &Model, state: &State) {
        self.lines.clear();
        self.draw_lines(model, state);
    }

    /// Carries a step further, and starts it first if it has not been started.
    pub(super) fn refine(
        &mut self,
        step: usize,
        model: &Model,
        methods: &Methods,
        (state, snapshot): (&State, &Snapshot),
        moment: Moment,
        effects: &mut Vec<Effect>,
    ) -> Carried {
        let known = self.running.iter().position(|own| own.step == step);
        if let Some((at, seconds)) = known.and_then(|i| self.running[i].deadline)
            && moment.seen > at
        {
            return Carried::Late(seconds);
        }
        let operator = self.plan[step];
        let start = || Effect::Tell(Narration::Started { index: step, step: model.step(operator) });
        let mut own = match known {
            Some(known) => self.running.remove(known),
            None => {
                let named = model.step(operator);
                match Refinement::new(methods, snapshot, &named.action, &named.arguments) {
                    Ok(refinement) => Running { step, refinement, wake_at: None, deadline: None },
                    Err(error) => {
                        effects.push(start());
                        return Carried::Is(Status::Failed(error.into()));
                    }
                }
            }
        };
        // A step that runs alone finds nothing taken: it need not be kept as it was.
        let was = (!self.running.is_empty()).then(|| own.refinement.clone());
        let turn = own.refinement.step(methods, snapshot, moment);
        if let Some(was) = was
            && self.is_taken(&turn.edits)
        {
            if let Some(known) = known {
                own.refinement = was;
                self.running.insert(known, own);
            }
            return Carried::Waits;
        }
        if known.is_none() {
            effects.push(start());
            own.deadline = model.duration(operator, state).and_then(|duration| {
                let span = std::time::Duration::try_from_secs_f64(duration.deadline).ok()?;
                Some((after(moment.now, span), duration.deadline))
            });
        }
        write(turn.edits, effects);
        tell(turn.events, effects);
        own.wake_at = match turn.status {
            Status::Running { wake_at } => wake_at,
            Status::Done | Status::Failed(_) => None,
        };
        self.running.insert(known.unwrap_or(self.running.len()), own);
        Carried::Is(turn.status)
    }

    /// Whether an edit is about a token that another step has written and waits for.
    fn is_taken(&self, edits: &[Edit]) -> bool {
        self.running.iter().any(|own| {
            let written: Vec<_> = own.refinement.written().filter_map(token).collect();
            edits.iter().filter_map(token).any(|token| written.contains(&token))
        })
    }

    /// Takes back the intentions of all steps that are not yet achieved.
    pub(super) fn withdraw(&mut self, snapshot: &Snapshot, effects: &mut Vec<Effect>) {
        for step in self.running() {
            self.withdraw_one(step, snapshot, effects);
        }
    }

    /// What takes back the intentions of all steps if PELEA is gone.
    pub(super) fn withdrawal(&self, methods: &Methods) -> Vec<Edit> {
        self.running.iter().flat_map(|own| own.refinement.withdrawal(methods)).collect()
    }

    /// Takes back the intentions of a step.
    fn withdraw_one(&mut self, step: usize, snapshot: &Snapshot, effects: &mut Vec<Effect>) {
        if let Some(at) = self.running.iter().position(|own| own.step == step) {
            let mut own = self.running.remove(at);
            write(own.refinement.cancel(snapshot), effects);
        }
    }

    /// A step has failed: the plan does not fit any more. Whether others are still being carried out.
    pub(super) fn stop(&mut self, step: usize, snapshot: &Snapshot, effects: &mut Vec<Effect>) -> bool {
        self.withdraw_one(step, snapshot, effects);
        self.stopped = true;
        !self.running.is_empty()
    }

    /// Goes on with the steps of `old` that are being carried out and that this plan may carry out now; withdraws the
    /// others. Whether there are any.
    pub(super) fn take_over(
        &mut self,
        mut old: Self,
        model: &Model,
        snapshot: &Snapshot,
        effects: &mut Vec<Effect>,
    ) -> bool {
        let (timing, task) = (model.timing(), model.task());
        for mut own in std::mem::take(&mut old.running) {
            let was = old.plan[own.step];
            let here = (0..self.plan.len()).find(|&step| {
                let first = self.before[step].is_empty() || timing.is_rest(task, was);
                first && self.plan[step] == was && !self.is_running(step)
            });
            match here {
                Some(step) => self.running.push(Running { step, ..own }),
                None => write(own.refinement.cancel(snapshot), effects),
            }
        }
        !self.running.is_empty()
    }
}

impl Line {
    fn left(&self) -> &[usize] {
        &self.steps[self.at..]
    }
}

/// The edge or the attribute that an edit is about.
#[derive(PartialEq)]
enum Token<'e> {
    Edge(&'e dsr::NodeRef, dsr::LabelId, &'e dsr::NodeRef),
    Attribute(&'e dsr::NodeRef, dsr::AttributeId),
}

fn token(edit: &Edit) -> Option<Token<'_>> {
    match edit {
        Edit::AddEdge { from, label, to } | Edit::RemoveEdge { from, label, to } => {
            Some(Token::Edge(from, *label, to))
        }
        Edit::SetAttribute { holder, attribute, .. } | Edit::ClearAttribute { holder, attribute } => {
            Some(match holder {
                HolderRef::Edge { from, label, to } => Token::Edge(from, *label, to),
                HolderRef::Node(node) => Token::Attribute(node, *attribute),
            })
        }
        _ => None,
    }
}

/// Right after a deadline, when every commit of its instant has been handed in.
fn past(deadline: Time) -> Time {
    after(deadline, std::time::Duration::from_millis(1))
}
