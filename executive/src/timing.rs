//! The durative actions of a model: the steps that stand for them, when they have started, how long they may take.

use crate::compression::{Compressed, Steps};
use crate::order::Accesses;
use pddl::model::{
    ActionId, Comparison, Domain, DurativeAction, Effect, EffectKind, Expression, ExpressionKind,
    FluentValue, GroundApplication, Idx, ObjectId, PredicateId, Problem, Term, TimeSpecifier,
};
use planner::{FactId, OperatorId, State, Task};
use rustc_hash::FxHashMap;

/// A durative action behind an action of the planner.
#[derive(Clone, Debug)]
struct Timed {
    action: DurativeAction,
    is_rest: bool,
    rest: ActionId,
    under_way: PredicateId,
}

/// What the planner does not know about durative actions.
#[derive(Clone, Debug, Default)]
pub(crate) struct Timing {
    timed: FxHashMap<ActionId, Timed>,
    rests: FxHashMap<(ActionId, Box<[ObjectId]>), OperatorId>,
}

/// How long a step takes, in seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Duration {
    /// How long it should take.
    pub expected: f64,
    /// When it has failed.
    pub deadline: f64,
}

impl Timing {
    pub(crate) fn new(domain: &Domain, compressed: &Compressed, task: &Task) -> Self {
        let mut timed = FxHashMap::default();
        for &Steps { durative, whole, rest, under_way } in &compressed.steps {
            for (id, is_rest) in [(whole, false), (rest, true)] {
                let action = domain.durative_actions[durative].clone();
                timed.insert(id, Timed { action, is_rest, rest, under_way });
            }
        }
        let mut rests = FxHashMap::default();
        for (id, operator) in task.operators().enumerate() {
            if timed.get(&operator.action).is_some_and(|timed| timed.is_rest) {
                rests.entry((operator.action, operator.arguments.into())).or_insert(id);
            }
        }
        Self { timed, rests }
    }

    fn of(&self, task: &Task, operator: OperatorId) -> Option<&Timed> {
        self.timed.get(&task.operator(operator).action)
    }

    /// Whether the step is what is left of an action that has started.
    pub(crate) fn is_rest(&self, task: &Task, operator: OperatorId) -> bool {
        self.of(task, operator).is_some_and(|timed| timed.is_rest)
    }

    /// What is left of a step once it has started.
    pub(crate) fn rest(&self, task: &Task, operator: OperatorId) -> Option<OperatorId> {
        let timed = self.of(task, operator).filter(|timed| !timed.is_rest)?;
        let arguments = task.operator(operator).arguments;
        self.rests.get(&(timed.rest, arguments.into())).copied()
    }

    /// The fact that the action of a step is under way.
    pub(crate) fn under_way(&self, task: &Task, operator: OperatorId) -> Option<FactId> {
        task.fact(self.of(task, operator)?.under_way, task.operator(operator).arguments)
    }

    /// Whether everything is seen that the start of a step makes true or false under no condition.
    pub(crate) fn has_started(&self, task: &Task, operator: OperatorId, state: &State) -> bool {
        let Some(timed) = self.of(task, operator) else { return false };
        let arguments = task.operator(operator).arguments;
        let at_start = timed.action.effects.iter().filter(|effect| effect.when == TimeSpecifier::Start);
        let mut literals = Vec::new();
        at_start.for_each(|effect| plain(&effect.effect, arguments, &mut literals));
        let adds = literals.iter().filter(|(.., wanted)| *wanted);
        let added: Vec<_> = adds.map(|(predicate, row, _)| (*predicate, row.clone())).collect();
        literals.retain(|(predicate, row, wanted)| *wanted || !added.contains(&(*predicate, row.clone())));
        literals.iter().all(|(predicate, row, wanted)| {
            task.fact(*predicate, row).is_none_or(|fact| state.contains(fact) == *wanted)
        })
    }

    /// For each step of a plan, the earlier steps that must be done before it starts; without those that one of them is
    /// ordered behind.
    pub(crate) fn order(&self, domain: &Domain, task: &Task, plan: &[OperatorId]) -> Vec<Vec<usize>> {
        let accesses: Vec<Option<Accesses>> = plan
            .iter()
            .map(|&step| {
                let timed = self.of(task, step)?;
                Some(Accesses::of(domain, &timed.action, task.operator(step).arguments))
            })
            .collect();
        let ordered = |i: usize, j: usize| {
            let (first, second) = (task.operator(plan[i]), task.operator(plan[j]));
            let same_name = |a: ActionId, b: ActionId| {
                self.timed
                    .get(&a)
                    .zip(self.timed.get(&b))
                    .is_some_and(|(a, b)| a.action.name == b.action.name)
            };
            let again = same_name(first.action, second.action) && first.arguments == second.arguments;
            let conflict = accesses[i].as_ref().zip(accesses[j].as_ref()).is_none_or(|(a, b)| a.conflict(b));
            again || conflict
        };
        let mut before: Vec<Vec<usize>> = Vec::with_capacity(plan.len());
        let mut above: Vec<Vec<bool>> = Vec::with_capacity(plan.len());
        for j in 0..plan.len() {
            let (mut own, mut all) = (Vec::new(), vec![false; plan.len()]);
            for i in (0..j).rev() {
                if !all[i] && ordered(i, j) {
                    own.push(i);
                    all[i] = true;
                    all.iter_mut().zip(&above[i]).for_each(|(all, above)| *all |= above);
                }
            }
            before.push(own);
            above.push(all);
        }
        before
    }

    /// How long a step may take from a state; `None` for a step without a duration, or whose duration has no value. A
    /// fixed duration is what the step should take; its deadline is twice that.
    pub(crate) fn duration(
        &self,
        problem: &Problem,
        task: &Task,
        operator: OperatorId,
        state: &State,
    ) -> Option<Duration> {
        let timed = self.of(task, operator)?;
        let arguments = task.operator(operator).arguments;
        let (mut least, mut most) = (0.0_f64, f64::INFINITY);
        let mut fixed = None;
        for bound in &timed.action.duration {
            let value = value(&bound.bound, arguments, &|fluent| {
                let sensed = task.numbers(state).find(|(other, _)| *other == fluent);
                match sensed {
                    Some((_, value)) => value.map(planner::Number::to_f64),
                    None => given(problem, fluent),
                }
            })?;
            match bound.comparison {
                Comparison::Equal => fixed = Some(value),
                Comparison::Less | Comparison::LessEqual => most = most.min(value),
                Comparison::Greater | Comparison::GreaterEqual => least = least.max(value),
            }
        }
        let (expected, deadline) = match fixed {
            Some(value) => (value, most.min(2.0 * value)),
            None if most.is_finite() => (f64::midpoint(least, most), most),
            None => return None,
        };
        (deadline.is_finite() && deadline >= 0.0).then_some(Duration { expected, deadline })
    }
}

fn given(problem: &Problem, fluent: &GroundApplication) -> Option<f64> {
    let known = problem.fluents.iter().find(|known| known.application == *fluent)?;
    match known.value {
        FluentValue::Number(value) => Some(value),
        FluentValue::Object(_) => None,
    }
}

fn value(
    expression: &Expression,
    arguments: &[ObjectId],
    of: &impl Fn(&GroundApplication) -> Option<f64>,
) -> Option<f64> {
    use pddl::model::ArithmeticOperator::{Add, Divide, Multiply, Subtract};
    match &expression.kind {
        ExpressionKind::Number(value) => Some(*value),
        ExpressionKind::Fluent(application) => {
            let arguments: Option<_> = application.arguments.iter().map(|&t| object(t, arguments)).collect();
            of(&GroundApplication { function: application.function, arguments: arguments? })
        }
        ExpressionKind::Arithmetic(operator, parts) => {
            let mut parts = parts.iter().map(|part| value(part, arguments, of));
            let first = parts.next()??;
            let rest: Vec<f64> = parts.collect::<Option<_>>()?;
            if rest.is_empty() && *operator == Subtract {
                return Some(-first);
            }
            Some(rest.into_iter().fold(first, |sum, part| match operator {
                Add => sum + part,
                Subtract => sum - part,
                Multiply => sum * part,
                Divide => sum / part,
            }))
        }
        _ => None,
    }
}

fn object(term: Term, arguments: &[ObjectId]) -> Option<ObjectId> {
    match term {
        Term::Object(object) => Some(object),
        Term::Variable(slot) => arguments.get(slot.index()).copied(),
    }
}

type Literal = (PredicateId, Vec<ObjectId>, bool);

/// The literals that an effect gives under no condition.
fn plain(effect: &Effect, arguments: &[ObjectId], into: &mut Vec<Literal>) {
    let (atom, wanted) = match &effect.kind {
        EffectKind::And(parts) => return parts.iter().for_each(|part| plain(part, arguments, into)),
        EffectKind::Add(atom) => (atom, true),
        EffectKind::Delete(atom) => (atom, false),
        EffectKind::Assign(..) | EffectKind::Forall(..) | EffectKind::When(..) => return,
    };
    let row: Option<Vec<_>> = atom.arguments.iter().map(|&term| object(term, arguments)).collect();
    into.extend(row.map(|row| (atom.predicate, row, wanted)));
}
