//! The happenings at one time.
//!
//! Each point is judged in the state before, and its changes are collected there. Then the points
//! are compared with each other and with recent ones, and only then the state changes. So no point
//! reads a part of the changes of its own happening.

use super::active::{Active, given};
use super::footprint::{Footprint, Reader};
use super::run::{Checked, Run};
use super::timeline::Point;
use crate::cause::{Cause, Causes};
use crate::condition::compares;
use crate::effect::Changes;
use crate::expression::bind_functions;
use crate::number::Number;
use crate::plan::{StepIndex, end, start};
use crate::preference;
use crate::reads::each_guard;
use crate::scene::{Binding, Clock, Scene, each_instance};
use crate::trace::Diff;
use crate::value::Value;
use crate::verdict::{Failure, StepFault};
use pddl::model::{
    Comparison, Condition, DurativeAction, Effect, Given, TimeSpecifier, TimedChange, VariableId, Variables,
};
use pddl::{StepHead, TemporalStep};

/// The changes of one point.
struct Outcome {
    what: Cause,
    changes: Changes,
    footprint: Footprint,
}

/// The conditions and effects of a schema at a point.
struct Part<'v> {
    variables: &'v Variables,
    clock: Clock<'static>,
    conditions: Vec<&'v Condition>,
    effects: Vec<&'v Effect>,
}

impl<'v> Run<'_, 'v, '_> {
    /// Executes everything that happens at `self.now`. If it is `concurrent`, interference is
    /// checked.
    pub(super) fn happening(
        &mut self,
        points: &[Point],
        concurrent: bool,
        mut diff: Option<&mut Diff>,
    ) -> Checked {
        let mut outcomes = Vec::with_capacity(points.len());
        let mut started = Vec::new();
        for point in points {
            outcomes.push(match point.what {
                Cause::Step(index) => self.step(index, concurrent)?,
                // Events are not points: they happen when they are due.
                Cause::Event(_) => continue,
                Cause::Start(index) => {
                    let (outcome, active) = self.start(index, concurrent)?;
                    started.push(active);
                    outcome
                }
                Cause::End(index) => self.end(index, &mut started, concurrent)?,
                Cause::Timed(index) => self.timed(index),
            });
        }
        for (event, footprint) in std::mem::take(&mut self.beside_timed) {
            for outcome in outcomes.iter().filter(|outcome| matches!(outcome.what, Cause::Timed(_))) {
                if let Some(over) = footprint.interference(&outcome.footprint) {
                    return Err(Box::new(Failure::Interference { first: event, second: outcome.what, over }));
                }
            }
        }
        if concurrent {
            self.interference(&mut outcomes)?;
        }
        for outcome in &outcomes {
            self.causes.push(outcome.what);
            let moment = self.moment();
            self.watch.changed(&outcome.changes);
            if let Some(linear) = &mut self.linear {
                outcome.changes.each_write(|fluent, _| linear.wrote(fluent));
            }
            outcome
                .changes
                .apply(self.state, moment, diff.as_deref_mut())
                .map_err(|fault| Box::new(Failure::Effect { at: outcome.what, fault }))?;
        }
        started.into_iter().for_each(|active| self.join(active));
        Ok(())
    }

    /// Checks that points that are simultaneous, or too close to each other, do not interfere.
    fn interference(&mut self, outcomes: &mut [Outcome]) -> Checked {
        self.concurrent.forget(self.now, self.prepared.precision.separation);
        for outcome in outcomes {
            let footprint = std::mem::take(&mut outcome.footprint);
            if let Some((first, over)) = self.concurrent.in_the_way(&footprint) {
                return Err(Box::new(Failure::Interference { first, second: outcome.what, over }));
            }
            self.concurrent.push(self.now, outcome.what, footprint);
        }
        Ok(())
    }

    fn plan_step(&self, index: StepIndex) -> &'v TemporalStep {
        &self.plan.steps[index.0 as usize]
    }

    fn step(&mut self, index: StepIndex, concurrent: bool) -> Checked<Outcome> {
        let step = self.plan_step(index);
        let fault = |fault| Box::new(Failure::Step { step: index, fault });
        let StepHead::Action(id) = step.head else { return Err(fault(StepFault::UnknownAction)) };
        let action = self.prepared.domain.actions.get(id).ok_or_else(|| fault(StepFault::UnknownAction))?;
        self.prepared.fits(&action.variables, &step.arguments).map_err(fault)?;
        let part = Part {
            variables: &action.variables,
            clock: Clock::at(self.now),
            conditions: vec![&action.precondition],
            effects: vec![&action.effect],
        };
        let mut binding = Binding::new(&action.variables, &step.arguments);
        let mut outcome = self.outcome(Cause::Step(index), &part, &mut binding, concurrent)?;
        for preference in &action.preferences {
            if concurrent {
                let over = &preference.forall;
                self.read_soft(&part, over, &preference.body, &mut binding, &mut outcome.footprint);
            }
            self.derive_for(&preference.body);
            let scene = self.prepared.scene(self.state, part.variables, part.clock);
            let holds = |body: &_, binding: &mut Binding| scene.holds(body, binding);
            preference::judge(&mut self.demands.violations, scene, preference, &mut binding, holds);
        }
        Ok(outcome)
    }

    fn start(&mut self, index: StepIndex, concurrent: bool) -> Checked<(Outcome, Active<'v>)> {
        let step = self.plan_step(index);
        let fault = |fault| Box::new(Failure::Step { step: index, fault });
        let StepHead::DurativeAction(id) = step.head else { return Err(fault(StepFault::UnknownAction)) };
        let action =
            self.prepared.domain.durative_actions.get(id).ok_or_else(|| fault(StepFault::UnknownAction))?;
        self.prepared.fits(&action.variables, &step.arguments).map_err(fault)?;
        if step.duration.is_none() {
            return Err(fault(StepFault::NoDuration));
        }
        let duration = end(step).minus(start(step)).unwrap_or(Number::ZERO);
        let mut active = Active {
            step: index,
            action,
            binding: Binding::new(&action.variables, &step.arguments),
            duration,
            armed: Vec::new(),
            kept: Vec::new(),
        };
        let outcome = self.half(&mut active, &TimeSpecifier::Start, concurrent)?;
        Ok((outcome, active))
    }

    fn end(&mut self, index: StepIndex, started: &mut Vec<Active<'v>>, concurrent: bool) -> Checked<Outcome> {
        let mut active = match self.leave(index) {
            Some(active) => active,
            None => {
                let now = started.iter().rposition(|active| active.step == index);
                started.remove(now.expect("an end comes after its start"))
            }
        };
        self.half(&mut active, &TimeSpecifier::End, concurrent)
    }

    /// Executes the start or the end of a durative action.
    fn half(&mut self, active: &mut Active<'v>, when: &TimeSpecifier, concurrent: bool) -> Checked<Outcome> {
        let action = active.action;
        let clock = Clock { duration: Some(active.duration), ..Clock::at(self.now) };
        self.duration(active, when, clock)?;
        let part = Part {
            variables: &action.variables,
            clock,
            conditions: at(action, when).collect(),
            effects: action
                .effects
                .iter()
                .filter(|e| e.when == *when && e.given.is_empty())
                .map(|e| &e.effect)
                .collect(),
        };
        let what = match when {
            TimeSpecifier::Start => Cause::Start(active.step),
            _ => Cause::End(active.step),
        };
        let mut outcome = self.outcome(what, &part, &mut active.binding, concurrent)?;
        if concurrent {
            self.read_bounds(active, when, clock, &mut outcome.footprint);
        }
        match when {
            TimeSpecifier::Start => {
                self.arm(active, &mut outcome.footprint);
                self.keep(active, clock);
            }
            _ => self.discharge(active, &mut outcome)?,
        }
        for preference in action.preferences.iter().filter(|p| p.body.when == *when) {
            if concurrent {
                let (over, body) = (&preference.forall, &preference.body.condition);
                self.read_soft(&part, over, body, &mut active.binding, &mut outcome.footprint);
            }
            self.derive_for(&preference.body.condition);
            let scene = self.prepared.scene(self.state, part.variables, part.clock);
            preference::judge(
                &mut self.demands.violations,
                scene,
                preference,
                &mut active.binding,
                |body, binding| scene.holds(&body.condition, binding),
            );
        }
        Ok(outcome)
    }

    /// Collects the reads of a preference, like those of an effect whose condition counts the
    /// violation.
    fn read_soft(
        &self,
        part: &Part<'v>,
        over: &[VariableId],
        body: &Condition,
        binding: &mut Binding,
        into: &mut Footprint,
    ) {
        let scene = self.prepared.scene(self.state, part.variables, part.clock);
        let reader = Reader { scene, strata: &self.prepared.strata, dependencies: &self.dependencies };
        each_instance(scene, over, binding, &mut |binding| reader.condition(body, binding, into));
    }

    /// Collects the reads of the bounds of the duration.
    fn read_bounds(&self, active: &Active<'v>, when: &TimeSpecifier, clock: Clock<'_>, into: &mut Footprint) {
        let scene = self.prepared.scene(self.state, &active.action.variables, clock);
        let reader = Reader { scene, strata: &self.prepared.strata, dependencies: &self.dependencies };
        for constraint in active.action.duration.iter().filter(|constraint| constraint.when == *when) {
            reader.expression(&constraint.bound, &active.binding, into);
            for term in &constraint.functions {
                reader.application(&term.application, &active.binding, into);
            }
        }
    }

    /// Records the `over all` preferences.
    fn keep(&self, active: &mut Active<'v>, clock: Clock<'_>) {
        let action = active.action;
        let scene = self.prepared.scene(self.state, &action.variables, clock);
        for (index, preference) in action.preferences.iter().enumerate() {
            if preference.body.when == TimeSpecifier::OverAll {
                each_instance(scene, &preference.forall, &mut active.binding, &mut |binding| {
                    active.kept.push((index, binding.clone()));
                });
            }
        }
    }

    /// Records the end effects whose start conditions hold, with their bindings.
    fn arm(&mut self, active: &mut Active<'v>, footprint: &mut Footprint) {
        let action = active.action;
        let clock = Clock { duration: Some(active.duration), ..Clock::at(self.now) };
        for (index, timed) in action.effects.iter().enumerate().filter(|(_, timed)| !timed.given.is_empty()) {
            given(&timed.given, &TimeSpecifier::Start).for_each(|condition| self.derive_for(condition));
            let scene = self.prepared.scene(self.state, &action.variables, clock);
            let reader = Reader { scene, strata: &self.prepared.strata, dependencies: &self.dependencies };
            let slots: Vec<VariableId> = timed
                .given
                .iter()
                .flat_map(|given| match given {
                    Given::Forall(slots) => slots.as_slice(),
                    Given::When(_) => &[],
                })
                .copied()
                .collect();
            each_instance(scene, &slots, &mut active.binding, &mut |binding| {
                let mut armed = true;
                for condition in given(&timed.given, &TimeSpecifier::Start) {
                    reader.condition(condition, binding, footprint);
                    armed &= scene.holds(condition, binding);
                }
                if armed {
                    active.armed.push((index, binding.clone()));
                }
            });
        }
    }

    /// Collects the end effects that were recorded at the start.
    fn discharge(&mut self, active: &mut Active<'v>, outcome: &mut Outcome) -> Checked {
        let action = active.action;
        let clock = Clock { duration: Some(active.duration), ..Clock::at(self.now) };
        for (index, mut binding) in std::mem::take(&mut active.armed) {
            let timed = &action.effects[index];
            given(&timed.given, &TimeSpecifier::End).for_each(|condition| self.derive_for(condition));
            each_guard(&timed.effect, &mut |guard, _| self.derive_for(guard));
            let scene = self.prepared.scene(self.state, &action.variables, clock);
            let reader = Reader { scene, strata: &self.prepared.strata, dependencies: &self.dependencies };
            let mut holds = true;
            for condition in given(&timed.given, &TimeSpecifier::End) {
                reader.condition(condition, &mut binding, &mut outcome.footprint);
                holds &= scene.holds(condition, &mut binding);
            }
            if holds {
                reader.effect(&timed.effect, &mut binding, &mut outcome.footprint);
                outcome
                    .changes
                    .collect(scene, &timed.effect, &mut binding)
                    .map_err(|fault| Box::new(Failure::Effect { at: outcome.what, fault }))?;
            }
        }
        outcome.footprint.changes(&outcome.changes);
        Ok(())
    }

    /// Checks the constraints on the duration at this time.
    fn duration(&mut self, active: &mut Active<'v>, when: &TimeSpecifier, clock: Clock<'_>) -> Checked {
        let action = active.action;
        for constraint in action.duration.iter().filter(|constraint| constraint.when == *when) {
            let scene = self.prepared.scene(self.state, &action.variables, clock);
            let bound = bind_functions(scene, &constraint.functions, &mut active.binding)
                .and_then(|()| scene.number(&constraint.bound, &active.binding));
            let fits = bound.as_ref().is_ok_and(|&bound| {
                within(constraint.comparison, active.duration, bound, self.prepared.precision.tolerance)
            });
            if !fits {
                let why = self.prepared.why(scene, Causes::Listed(&self.causes));
                return Err(Box::new(Failure::Duration {
                    step: active.step,
                    actual: active.duration,
                    comparison: constraint.comparison,
                    bound: why.operand(&constraint.bound, &active.binding),
                    span: constraint.span,
                }));
            }
        }
        Ok(())
    }

    fn timed(&self, index: u32) -> Outcome {
        let mut changes = Changes::default();
        let timed = &self.prepared.problem.timed[index as usize];
        match &timed.change {
            TimedChange::Add(fact) => changes.add(fact.predicate, &fact.arguments),
            TimedChange::Delete(fact) => changes.delete(fact.predicate, &fact.arguments),
            TimedChange::Assign(fact) => {
                changes.set(fact.application.clone(), Value::of(fact.value), timed.span);
            }
            TimedChange::Undefine(fluent) => changes.set(fluent.clone(), None, timed.span),
        }
        let mut footprint = Footprint::default();
        footprint.changes(&changes);
        Outcome { what: Cause::Timed(index), changes, footprint }
    }

    /// Judges the conditions and collects the changes.
    fn outcome(
        &mut self,
        what: Cause,
        part: &Part<'v>,
        binding: &mut Binding,
        concurrent: bool,
    ) -> Checked<Outcome> {
        for condition in &part.conditions {
            self.derive_for(condition);
        }
        for effect in &part.effects {
            each_guard(effect, &mut |guard, _| self.derive_for(guard));
        }
        let scene = self.prepared.scene(self.state, part.variables, part.clock);
        for condition in &part.conditions {
            if !scene.holds(condition, binding) {
                let causes = Causes::Listed(&self.causes);
                let parts = self.prepared.lacks(scene, causes, condition, binding);
                return Err(Box::new(Failure::Precondition { at: what, parts }));
            }
        }
        let mut changes = Changes::default();
        for effect in &part.effects {
            changes
                .collect(scene, effect, binding)
                .map_err(|fault| Box::new(Failure::Effect { at: what, fault }))?;
        }
        let mut footprint = Footprint::default();
        if concurrent {
            self.read(scene, part, binding, &mut footprint);
            footprint.changes(&changes);
        }
        Ok(Outcome { what, changes, footprint })
    }

    fn read(&self, scene: Scene<'_>, part: &Part<'v>, binding: &mut Binding, into: &mut Footprint) {
        let reader = Reader { scene, strata: &self.prepared.strata, dependencies: &self.dependencies };
        for condition in &part.conditions {
            reader.condition(condition, binding, into);
        }
        for effect in &part.effects {
            reader.effect(effect, binding, into);
        }
    }
}

/// The conditions of an action at a time.
fn at<'v>(action: &'v DurativeAction, when: &TimeSpecifier) -> impl Iterator<Item = &'v Condition> {
    action.conditions.iter().filter(move |timed| timed.when == *when).map(|timed| &timed.condition)
}

/// Compares a duration with its bound, within the tolerance.
fn within(comparison: Comparison, duration: Number, bound: Number, tolerance: Number) -> bool {
    let above = duration.minus(bound).unwrap_or(Number::MAX);
    match comparison {
        Comparison::Equal => above <= tolerance && above.negated() <= tolerance,
        Comparison::LessEqual => above <= tolerance,
        Comparison::GreaterEqual => above.negated() <= tolerance,
        Comparison::Less | Comparison::Greater => compares(comparison, duration, bound),
    }
}
