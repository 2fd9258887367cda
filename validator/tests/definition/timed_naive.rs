//! The semantics of plans with times, read off the definition: the happenings by time, each judged in the state before
//! it, no two of one time getting in each other's way; what must hold all the time, held against linear change.
//!
//! Several things may be wrong at one time; then each of them is a right answer.

use crate::fraction::Fraction;
use crate::naive::{
    Atomic, Binding, Changes, Fault, Fluent, State, Update, Value, World, empty, fluent, ground,
};
use pddl::model::{
    AssignedValue, Comparison, Condition, ConditionKind, Direction, DurativeAction, Effect, EffectKind,
    Expression, ExpressionKind, FluentFact, FluentValue, Given, Name, TimeSpecifier, TimedChange, Variables,
};
use pddl::{StepHead, TemporalPlan, TemporalStep};
use std::collections::{BTreeMap, BTreeSet};

/// What two happenings at one time may disagree about.
#[derive(Default)]
struct Touched {
    needed: BTreeSet<Atomic>,
    read: BTreeSet<Fluent>,
    changes: Changes,
}

impl Touched {
    fn disturbs(&self, other: &Self) -> bool {
        let (own, others) = (&self.changes, &other.changes);
        own.adds.iter().chain(&own.deletes).any(|atom| other.needed.contains(atom))
            || own.adds.iter().any(|atom| others.deletes.contains(atom))
            || own.updates.iter().any(|(fluent, update)| {
                other.read.contains(fluent)
                    || others
                        .updates
                        .get(fluent)
                        .is_some_and(|second| !matches!((update, second), (Update::Add(_), Update::Add(_))))
            })
    }
}

enum What {
    Timed(usize),
    Whole(usize),
    Start(usize),
    End(usize),
}

struct Active<'a> {
    index: usize,
    action: &'a DurativeAction,
    binding: Binding,
    duration: Fraction,
    /// Effects at the end whose condition at the start held.
    armed: Vec<&'a Effect>,
    /// Preferences that were violated on the way.
    broken: BTreeSet<usize>,
}

struct Run<'w, 'a> {
    world: &'w World<'a>,
    state: State,
    active: Vec<Active<'a>>,
    violated: Vec<Name>,
    faults: Vec<Fault>,
}

fn seconds(decimal: pddl::Decimal) -> Fraction {
    Fraction::of(decimal.to_f64())
}

/// How far a duration may be off, and what is nearer is at one time.
fn tolerance() -> Fraction {
    Fraction::new(1, 100)
}

fn separation() -> Fraction {
    Fraction::new(1, 1000)
}

impl<'a> World<'a> {
    /// What there is to say about a plan: if it is not valid, everything that is wrong with it at the first time at which
    /// something is.
    pub fn judge_timed(&self, plan: &TemporalPlan) -> Result<Option<Fraction>, Vec<Fault>> {
        let mut points: Vec<(Fraction, What)> = Vec::new();
        for (index, timed) in self.problem.timed.iter().enumerate() {
            points.push((seconds(timed.time), What::Timed(index)));
        }
        for (index, step) in plan.steps.iter().enumerate() {
            let start = seconds(step.start);
            match step.head {
                StepHead::Action(_) => points.push((start, What::Whole(index))),
                StepHead::DurativeAction(_) => {
                    points.push((start, What::Start(index)));
                    points.push((start.plus(seconds(step.duration.unwrap())), What::End(index)));
                }
            }
        }
        points.sort_by_key(|(time, _)| *time);
        let mut run = Run {
            world: self,
            state: self.initial(),
            active: Vec::new(),
            violated: Vec::new(),
            faults: Vec::new(),
        };
        let mut trajectory = vec![(Fraction::ZERO, run.state.clone())];
        let mut past: Vec<(Fraction, Touched)> = Vec::new();
        let mut now = Fraction::ZERO;
        for group in points.chunk_by(|a, b| a.0 == b.0) {
            run.flow(group[0].0.minus(now));
            now = group[0].0;
            run.check()?;
            let mut deeds = Vec::new();
            for (_, what) in group {
                deeds.push(run.deed(what, plan));
            }
            past.retain(|(time, _)| now.minus(*time) < separation());
            for (index, deed) in deeds.iter().enumerate() {
                let others = past.iter().map(|(_, touched)| touched).chain(&deeds[..index]);
                if others.into_iter().any(|other| deed.disturbs(other) || other.disturbs(deed)) {
                    run.faults.push(Fault::Interference);
                }
            }
            for (deed, (_, what)) in deeds.iter().zip(group) {
                if self.apply(&deed.changes, &mut run.state).is_none() {
                    run.faults.push(Fault::Effect(what.step()));
                }
            }
            run.check()?;
            past.extend(deeds.into_iter().map(|deed| (now, deed)));
            trajectory.push((now, run.state.clone()));
        }
        self.finish(&trajectory, run.violated).map_err(|fault| vec![fault])
    }

    fn needed(&self, condition: &Condition, variables: &Variables, binding: &Binding, into: &mut Touched) {
        match &condition.kind {
            ConditionKind::And(parts) | ConditionKind::Or(parts) => {
                parts.iter().for_each(|part| self.needed(part, variables, binding, into));
            }
            ConditionKind::Not(part) => self.needed(part, variables, binding, into),
            ConditionKind::Imply(if_, then) => {
                self.needed(if_, variables, binding, into);
                self.needed(then, variables, binding, into);
            }
            ConditionKind::Exists(over, body) | ConditionKind::Forall(over, body) => {
                for binding in self.bindings(over, variables, binding) {
                    self.needed(body, variables, &binding, into);
                }
            }
            ConditionKind::Atom(atom) => into.needed.extend([ground(atom, binding)]),
            ConditionKind::Compare(_, a, b) => {
                read(a, binding, into);
                read(b, binding, into);
            }
            ConditionKind::FluentIs(application, _) => into.read.extend([fluent(application, binding)]),
            ConditionKind::HasType(..) | ConditionKind::Same(..) => {}
        }
    }

    fn needed_by(&self, effect: &Effect, variables: &Variables, binding: &Binding, into: &mut Touched) {
        match &effect.kind {
            EffectKind::And(parts) => {
                parts.iter().for_each(|part| self.needed_by(part, variables, binding, into));
            }
            EffectKind::Forall(over, body) => {
                for binding in self.bindings(over, variables, binding) {
                    self.needed_by(body, variables, &binding, into);
                }
            }
            EffectKind::When(guard, body) => {
                self.needed(guard, variables, binding, into);
                self.needed_by(body, variables, binding, into);
            }
            EffectKind::Assign(_, _, AssignedValue::Number(value)) => read(value, binding, into),
            EffectKind::Add(_) | EffectKind::Delete(_) | EffectKind::Assign(..) => {}
        }
    }

    /// Where a comparison changes while the fluents run from one state to another in a straight line: parts of the way.
    fn turns(
        &self,
        condition: &Condition,
        variables: &Variables,
        binding: &Binding,
        (from, to): (&State, &State),
        into: &mut Vec<Fraction>,
    ) {
        match &condition.kind {
            ConditionKind::And(parts) | ConditionKind::Or(parts) => {
                parts.iter().for_each(|part| self.turns(part, variables, binding, (from, to), into));
            }
            ConditionKind::Not(part) => self.turns(part, variables, binding, (from, to), into),
            ConditionKind::Imply(if_, then) => {
                self.turns(if_, variables, binding, (from, to), into);
                self.turns(then, variables, binding, (from, to), into);
            }
            ConditionKind::Exists(over, body) | ConditionKind::Forall(over, body) => {
                for binding in self.bindings(over, variables, binding) {
                    self.turns(body, variables, &binding, (from, to), into);
                }
            }
            ConditionKind::Compare(_, a, b) => {
                let difference =
                    |state| Some(self.number(a, binding, state)?.minus(self.number(b, binding, state)?));
                if let (Some(first), Some(last)) = (difference(from), difference(to))
                    && let Some(slope) = first.minus(last).inverse()
                {
                    into.push(first.times(slope));
                }
            }
            _ => {}
        }
    }
}

fn read(expression: &Expression, binding: &Binding, into: &mut Touched) {
    expression.each(&mut |part| {
        if let ExpressionKind::Fluent(application) = &part.kind {
            into.read.insert(fluent(application, binding));
        }
    });
}

impl What {
    fn step(&self) -> usize {
        match self {
            Self::Whole(index) | Self::Start(index) | Self::End(index) => *index,
            Self::Timed(_) => usize::MAX,
        }
    }
}

impl<'a> Run<'_, 'a> {
    fn check(&mut self) -> Result<(), Vec<Fault>> {
        if self.faults.is_empty() { Ok(()) } else { Err(std::mem::take(&mut self.faults)) }
    }

    /// The state after some time in which nothing happens.
    fn later(&self, length: Fraction) -> Option<State> {
        let mut rates: BTreeMap<Fluent, Fraction> = BTreeMap::new();
        for Active { action, binding, .. } in &self.active {
            for effect in &action.continuous {
                let rate = self.world.number(&effect.rate, binding, &self.state)?;
                let rate = if effect.direction == Direction::Decrease { rate.negated() } else { rate };
                let sum = rates.entry(fluent(&effect.fluent, binding)).or_insert(Fraction::ZERO);
                *sum = sum.plus(rate);
            }
        }
        let mut state = self.state.clone();
        for (fluent, rate) in rates {
            let Value::Number(value) = *state.fluents.get(&fluent)? else { return None };
            state.fluents.insert(fluent, Value::Number(value.plus(rate.times(length))));
        }
        Some(state)
    }

    /// Lets time pass. Every condition is asked where a comparison turns, and in between.
    fn flow(&mut self, length: Fraction) {
        if length == Fraction::ZERO {
            return;
        }
        let Some(end) = self.later(length) else { return self.faults.push(Fault::Change) };
        let (one, two) = (Fraction::whole(1), Fraction::new(1, 2));
        for index in 0..self.active.len() {
            let Active { action, ref binding, .. } = self.active[index];
            let hard = action.conditions.iter().filter(|c| c.when == TimeSpecifier::OverAll);
            let soft =
                action.preferences.iter().enumerate().filter(|(_, p)| p.body.when == TimeSpecifier::OverAll);
            let asked: Vec<(Option<usize>, &Condition)> = hard
                .map(|c| (None, &c.condition))
                .chain(soft.map(|(i, preference)| (Some(i), &preference.body.condition)))
                .collect();
            let mut broken = Vec::new();
            for (soft, condition) in asked {
                let mut turns = Vec::new();
                self.world.turns(condition, &action.variables, binding, (&self.state, &end), &mut turns);
                turns.retain(|turn| Fraction::ZERO < *turn && *turn < one);
                turns.extend([Fraction::ZERO, one]);
                turns.sort();
                let between: Vec<_> = turns.windows(2).map(|pair| pair[0].plus(pair[1]).times(two)).collect();
                turns.retain(|turn| Fraction::ZERO < *turn && *turn < one);
                let holds = turns.iter().chain(&between).all(|part| {
                    let state = self.later(length.times(*part)).unwrap();
                    self.world.holds(condition, &action.variables, binding, &state)
                });
                match soft {
                    None if !holds => self.faults.push(Fault::Invariant(self.active[index].index)),
                    Some(preference) if !holds => broken.push(preference),
                    _ => {}
                }
            }
            self.active[index].broken.extend(broken);
        }
        self.state = end;
    }

    fn deed(&mut self, what: &What, plan: &TemporalPlan) -> Touched {
        let mut touched = Touched::default();
        match *what {
            What::Timed(index) => {
                let changes = &mut touched.changes;
                let set = |fact: &FluentFact| match fact.value {
                    FluentValue::Number(number) => Update::Assign(Some(Value::Number(Fraction::of(number)))),
                    FluentValue::Object(object) => Update::Assign(Some(Value::Object(object))),
                };
                match &self.world.problem.timed[index].change {
                    TimedChange::Add(fact) => changes.adds.extend([(fact.predicate, fact.arguments.clone())]),
                    TimedChange::Delete(fact) => {
                        changes.deletes.extend([(fact.predicate, fact.arguments.clone())]);
                    }
                    TimedChange::Assign(fact) => {
                        let fluent = (fact.application.function, fact.application.arguments.clone());
                        changes.updates.insert(fluent, set(fact));
                    }
                    TimedChange::Undefine(fluent) => {
                        let fluent = (fluent.function, fluent.arguments.clone());
                        changes.updates.insert(fluent, Update::Assign(None));
                    }
                }
            }
            What::Whole(index) => {
                let step = &plan.steps[index];
                let StepHead::Action(id) = step.head else { panic!("it takes no time") };
                let action = &self.world.domain.actions[id];
                let binding = empty(&action.variables, &step.arguments);
                self.part(
                    index,
                    &action.variables,
                    &binding,
                    &[&action.precondition],
                    &[&action.effect],
                    &mut touched,
                );
            }
            What::Start(index) => self.start(index, &plan.steps[index], &mut touched),
            What::End(index) => self.end(index, &mut touched),
        }
        touched
    }

    fn part(
        &mut self,
        index: usize,
        variables: &Variables,
        binding: &Binding,
        conditions: &[&Condition],
        effects: &[&Effect],
        touched: &mut Touched,
    ) {
        for condition in conditions {
            self.world.needed(condition, variables, binding, touched);
            if !self.world.holds(condition, variables, binding, &self.state) {
                self.faults.push(Fault::Precondition(index));
            }
        }
        for effect in effects {
            self.world.needed_by(effect, variables, binding, touched);
            if self.world.collect(effect, variables, binding, &self.state, &mut touched.changes).is_none() {
                self.faults.push(Fault::Effect(index));
            }
        }
    }

    fn half(&mut self, active: &mut Active<'a>, when: &TimeSpecifier, touched: &mut Touched) {
        let action = active.action;
        let conditions: Vec<_> =
            action.conditions.iter().filter(|c| c.when == *when).map(|c| &c.condition).collect();
        let effects =
            action.effects.iter().filter(|e| e.when == *when && e.given.is_empty()).map(|e| &e.effect);
        let mut effects: Vec<_> = effects.collect();
        if *when == TimeSpecifier::End {
            effects.append(&mut active.armed);
        }
        self.part(active.index, &action.variables, &active.binding, &conditions, &effects, touched);
        for (index, preference) in action.preferences.iter().enumerate() {
            let condition = &preference.body.condition;
            let violated = if preference.body.when == *when {
                self.world.needed(condition, &action.variables, &active.binding, touched);
                !self.world.holds(condition, &action.variables, &active.binding, &self.state)
            } else {
                *when == TimeSpecifier::End && active.broken.contains(&index)
            };
            if violated {
                self.violated.extend(preference.name.clone());
            }
        }
    }

    fn start(&mut self, index: usize, step: &TemporalStep, touched: &mut Touched) {
        let StepHead::DurativeAction(id) = step.head else { panic!("it takes time") };
        let action = &self.world.domain.durative_actions[id];
        let binding = empty(&action.variables, &step.arguments);
        let duration = seconds(step.duration.unwrap());
        for constraint in &action.duration {
            read(&constraint.bound, &binding, touched);
            let fits = self.world.number(&constraint.bound, &binding, &self.state).is_some_and(|bound| {
                let above = duration.minus(bound);
                match constraint.comparison {
                    Comparison::LessEqual => above <= tolerance(),
                    Comparison::GreaterEqual => above.negated() <= tolerance(),
                    _ => above <= tolerance() && above.negated() <= tolerance(),
                }
            });
            if !fits {
                self.faults.push(Fault::Duration(index));
            }
        }
        let mut active =
            Active { index, action, binding, duration, armed: Vec::new(), broken: BTreeSet::new() };
        for effect in action.effects.iter().filter(|effect| !effect.given.is_empty()) {
            let conditions = effect.given.iter().flat_map(|given| match given {
                Given::When(conditions) => conditions.as_slice(),
                Given::Forall(_) => panic!("samples have none"),
            });
            let mut holds = true;
            for condition in conditions {
                self.world.needed(&condition.condition, &action.variables, &active.binding, touched);
                holds &=
                    self.world.holds(&condition.condition, &action.variables, &active.binding, &self.state);
            }
            if holds {
                active.armed.push(&effect.effect);
            }
        }
        self.half(&mut active, &TimeSpecifier::Start, touched);
        self.active.push(active);
    }

    fn end(&mut self, index: usize, touched: &mut Touched) {
        let at = self.active.iter().position(|active| active.index == index).unwrap();
        let mut active = self.active.remove(at);
        debug_assert!(active.duration >= Fraction::ZERO);
        self.half(&mut active, &TimeSpecifier::End, touched);
    }
}
