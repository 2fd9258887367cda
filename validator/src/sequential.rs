//! Judges a plan without times, step by step. Its n-th state has the time n.

use crate::axiom::Needs;
use crate::cause::{Cause, Causes};
use crate::demands::Demands;
use crate::effect::Changes;
use crate::number::Number;
use crate::plan::StepIndex;
use crate::preference::judge;
use crate::prepared::{End, Prepared};
use crate::reads::each_guard;
use crate::recorder::Recorder;
use crate::scene::{Binding, Clock};
use crate::state::State;
use crate::trace::{Diff, Happening, Trace};
use crate::trajectory::{Asked, Since};
use crate::verdict::{Failure, StepFault, Unsatisfied, Valid};
use crate::work::Work;
use pddl::PlanStep;
use pddl::model::{Action, ActionId, IndexVec};

/// Executes the steps. Calls `visit` with each state and the number of steps before it.
pub(crate) fn run<'p>(
    prepared: &Prepared<'_>,
    plan: impl Iterator<Item = &'p PlanStep> + Clone,
    state: &mut State,
    mut trace: Option<&mut Trace>,
    visit: &mut dyn FnMut(u32, &mut State),
) -> Result<Valid, Box<Failure>> {
    let mut run = Run {
        prepared,
        needs: needs(prepared),
        demands: prepared.demands(state),
        state,
        changes: Changes::default(),
        binding: Binding::default(),
    };
    let mut recorder = trace.as_mut().map(|trace| Recorder::new(prepared, run.state, &mut trace.initial));
    run.observe(0);
    visit(0, run.state);
    let mut steps = 0;
    for step in plan.clone() {
        let mut diff = trace.is_some().then(Diff::default);
        run.step(StepIndex(steps), step, diff.as_mut())?;
        if let (Some(trace), Some(recorder), Some(mut diff)) = (&mut trace, &mut recorder, diff) {
            recorder.after(prepared, run.state, steps + 1, &mut diff);
            let time = Number::integer(i64::from(steps) + 1);
            trace.happenings.push(Happening { time, causes: vec![Cause::Step(StepIndex(steps))], diff });
        }
        steps += 1;
        run.observe(steps);
        visit(steps, run.state);
    }
    if let Some((file, broken)) = run.demands.broken() {
        let asked = broken.asked.filter(|asked| asked.position <= steps as usize);
        let parts = asked.map(|asked| run.lacked(asked, plan)).unwrap_or_default();
        return Err(run.demands.failure(file, &broken, parts));
    }
    let end = End {
        state: run.state,
        causes: Causes::Steps,
        total_time: Number::integer(i64::from(steps)),
        makespan: None,
        steps,
    };
    if let Some(trace) = trace {
        trace.watched = run.demands.watched();
    }
    prepared.finish(end, run.demands)
}

/// Calls `visit` with the states of the steps as [`run`] does, even if a step fails; `steps` sets
/// the budget. Returns whether the budget sufficed.
pub(crate) fn replay<'p>(
    prepared: &Prepared<'_>,
    plan: impl Iterator<Item = &'p PlanStep> + Clone,
    steps: usize,
    visit: &mut dyn FnMut(u32, &mut State),
) -> bool {
    let mut state = prepared.initial.clone();
    state.work = Work::for_steps(steps);
    let _ = run(prepared, plan, &mut state, None, visit);
    !state.work.is_exhausted()
}

/// By action: the derived predicates that its conditions read.
fn needs(prepared: &Prepared<'_>) -> IndexVec<ActionId, Needs> {
    let needs = |action: &Action| {
        let mut conditions = vec![&action.precondition];
        conditions.extend(action.preferences.iter().map(|preference| &preference.body));
        each_guard(&action.effect, &mut |guard, _| conditions.push(guard));
        prepared.strata.needs(conditions)
    };
    prepared.domain.actions.iter().map(needs).collect()
}

struct Run<'s, 'v, 'a> {
    prepared: &'v Prepared<'a>,
    needs: IndexVec<ActionId, Needs>,
    state: &'s mut State,
    demands: Demands<'v>,
    changes: Changes,
    binding: Binding,
}

impl Run<'_, '_, '_> {
    /// The unsatisfied parts in an earlier state: executes the plan again up to that state.
    fn lacked<'p>(&self, asked: Asked, plan: impl Iterator<Item = &'p PlanStep>) -> Vec<Unsatisfied> {
        let mut state = self.prepared.initial.clone();
        state.work = self.state.work.clone();
        let mut again = Run {
            prepared: self.prepared,
            needs: needs(self.prepared),
            demands: Demands::none(),
            state: &mut state,
            changes: Changes::default(),
            binding: Binding::default(),
        };
        for (index, step) in (0..).map(StepIndex).zip(plan.take(asked.position)) {
            if again.step(index, step, None).is_err() {
                return Vec::new();
            }
        }
        let now = Number::integer(i64::try_from(asked.position).unwrap_or(i64::MAX));
        self.prepared.lacks_of_constraint(again.state, (Causes::Steps, now), &self.demands, asked)
    }

    fn observe(&mut self, steps: u32) {
        self.prepared.derive_needed(self.demands.needs(), self.state, steps);
        let since = Since::at(Number::integer(i64::from(steps)));
        self.demands.observe(since, &self.prepared.universe, self.state);
    }

    fn step(
        &mut self,
        index: StepIndex,
        step: &PlanStep,
        diff: Option<&mut Diff>,
    ) -> Result<(), Box<Failure>> {
        let (prepared, at) = (self.prepared, Cause::Step(index));
        let fault = |fault| Box::new(Failure::Step { step: index, fault });
        let action =
            prepared.domain.actions.get(step.action).ok_or_else(|| fault(StepFault::UnknownAction))?;
        prepared.fits(&action.variables, &step.arguments).map_err(fault)?;
        prepared.derive_needed(&self.needs[step.action], self.state, index.0);
        self.binding.reset(&action.variables, &step.arguments);
        let scene = prepared.scene(self.state, &action.variables, Clock::steps(index.0));
        if !scene.holds(&action.precondition, &mut self.binding) {
            let parts = prepared.lacks(scene, Causes::Steps, &action.precondition, &mut self.binding);
            return Err(Box::new(Failure::Precondition { at, parts }));
        }
        for preference in &action.preferences {
            let holds = |body: &_, binding: &mut Binding| scene.holds(body, binding);
            judge(&mut self.demands.violations, scene, preference, &mut self.binding, holds);
        }
        self.changes.clear();
        self.changes
            .collect(scene, &action.effect, &mut self.binding)
            .and_then(|()| self.changes.apply(self.state, index.0 + 1, diff))
            .map_err(|fault| Box::new(Failure::Effect { at, fault }))
    }
}
