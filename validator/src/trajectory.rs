//! Judges trajectory constraints on the states of a plan.
//!
//! Problem: constraints refer to many states and may be nested, but the validator has one state
//! that it changes in place. Idea: ground the constraints first (a copy for each binding of their
//! quantifiers), so that only plain conditions remain. During the plan, record for each condition
//! whether it holds in each state. Then evaluate the paper's definitions on these records.
//!
//! A state lasts from its own time until just before the next state's time, and the last one for
//! ever. A state between two instants of continuous change begins just after the first. The n-th
//! state of a sequential plan has the time n. Cost: one evaluation and one bit per condition and
//! state, and one pass over the states for each operator: the truth of a part is computed for every
//! suffix of the trajectory first.
//!
//! Deviation: the papers do not nest operators. Here a nested operator refers to the rest of the
//! trajectory, and its times count from the state in which it is evaluated.
//!
//! Source: Gerevini & Long, "Plan constraints and preferences in PDDL3", 2005, §3; Gerevini, Haslum,
//! Long, Saetti & Dimopoulos, "Deterministic planning in the fifth international planning competition",
//! AIJ 2009, §3.2.

use crate::number::Number;
use crate::scene::{Binding, Clock, Scene, each_instance};
use crate::state::State;
use crate::trace::Stretch;
use crate::universe::Universe;
use crate::verdict::{Breach, Position};
use pddl::Span;
use pddl::model::{Condition, Constraint, ConstraintKind, Name, ObjectId, Variable, VariableId, Variables};

/// A condition of a ground constraint.
#[derive(Clone, Debug)]
struct Leaf<'a> {
    condition: &'a Condition,
    variables: &'a Variables,
    binding: Binding,
    /// By state: whether it holds.
    truth: Vec<bool>,
}

/// A constraint without variables, over numbered leaves.
#[derive(Clone, Debug)]
pub(crate) struct Formula {
    kind: Kind,
    pub(crate) span: Span,
}

#[derive(Clone, Debug)]
enum Kind {
    Leaf(usize),
    And(Vec<Formula>),
    Or(Vec<Formula>),
    Not(Box<Formula>),
    AtEnd(Box<Formula>),
    Always(Box<Formula>),
    Sometime(Box<Formula>),
    Within(Number, Box<Formula>),
    AtMostOnce(Box<Formula>),
    SometimeAfter(Box<Formula>, Box<Formula>),
    SometimeBefore(Box<Formula>, Box<Formula>),
    AlwaysWithin(Number, Box<Formula>, Box<Formula>),
    Hold { from: Number, until: Option<Number>, body: Box<Formula> },
}

impl Formula {
    /// Its parts, in the order of the text.
    fn parts(&self) -> impl Iterator<Item = &Self> {
        let (first, others): (Option<&Self>, &[Self]) = match &self.kind {
            Kind::Leaf(_) => (None, &[]),
            Kind::And(parts) | Kind::Or(parts) => (None, parts),
            Kind::Not(part)
            | Kind::AtEnd(part)
            | Kind::Always(part)
            | Kind::Sometime(part)
            | Kind::Within(_, part)
            | Kind::AtMostOnce(part)
            | Kind::Hold { body: part, .. } => (Some(part), &[]),
            Kind::SometimeAfter(if_, then)
            | Kind::SometimeBefore(if_, then)
            | Kind::AlwaysWithin(_, if_, then) => (Some(if_), std::slice::from_ref(&**then)),
        };
        first.into_iter().chain(others)
    }

    fn each_leaf(&self, visit: &mut dyn FnMut(usize)) {
        match self.kind {
            Kind::Leaf(leaf) => visit(leaf),
            _ => self.parts().for_each(|part| part.each_leaf(visit)),
        }
    }
}

/// When a state begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Since {
    pub(crate) time: Number,
    pub(crate) nearness: Nearness,
}

/// Whether a state begins at an instant, or has no first instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Nearness {
    At,
    JustAfter,
}

impl Since {
    /// At this time.
    pub(crate) fn at(time: Number) -> Self {
        Self { time, nearness: Nearness::At }
    }

    /// Just after this time.
    pub(crate) fn just_after(time: Number) -> Self {
        Self { time, nearness: Nearness::JustAfter }
    }

    fn later(self, by: Number) -> Self {
        // Times of plans and limits of constraints are decimals of a file, so their sum exists.
        Self { time: self.time.plus(by).unwrap_or(Number::MAX), ..self }
    }
}

/// The records of the states.
#[derive(Clone, Debug, Default)]
pub(crate) struct Trajectory<'a> {
    leaves: Vec<Leaf<'a>>,
    times: Vec<Since>,
}

impl<'a> Trajectory<'a> {
    /// Prepares a constraint before the first state, so that its conditions are recorded.
    pub(crate) fn ground(
        &mut self,
        scene: Scene<'_>,
        variables: &'a Variables,
        constraint: &'a Constraint,
        binding: &mut Binding,
    ) -> Formula {
        let boxed = |this: &mut Self, part: &'a Constraint, binding: &mut Binding| {
            Box::new(this.ground(scene, variables, part, binding))
        };
        let time = Number::from_decimal;
        let kind = match &constraint.kind {
            ConstraintKind::Holds(condition) => {
                self.leaves.push(Leaf { condition, variables, binding: binding.clone(), truth: Vec::new() });
                Kind::Leaf(self.leaves.len() - 1)
            }
            ConstraintKind::And(parts) => Kind::And(self.ground_all(scene, variables, parts, binding)),
            ConstraintKind::Or(parts) => Kind::Or(self.ground_all(scene, variables, parts, binding)),
            ConstraintKind::Not(part) => Kind::Not(boxed(self, part, binding)),
            ConstraintKind::Imply(if_, then) => {
                let if_ = boxed(self, if_, binding);
                let not = Formula { span: if_.span, kind: Kind::Not(if_) };
                Kind::Or(vec![not, self.ground(scene, variables, then, binding)])
            }
            ConstraintKind::Exists(over, part) => {
                Kind::Or(self.ground_each(scene, variables, over, part, binding))
            }
            ConstraintKind::Forall(over, part) => {
                Kind::And(self.ground_each(scene, variables, over, part, binding))
            }
            ConstraintKind::AtEnd(part) => Kind::AtEnd(boxed(self, part, binding)),
            ConstraintKind::Always(part) => Kind::Always(boxed(self, part, binding)),
            ConstraintKind::Sometime(part) => Kind::Sometime(boxed(self, part, binding)),
            ConstraintKind::Within(limit, part) => Kind::Within(time(*limit), boxed(self, part, binding)),
            ConstraintKind::AtMostOnce(part) => Kind::AtMostOnce(boxed(self, part, binding)),
            ConstraintKind::SometimeAfter(if_, then) => {
                Kind::SometimeAfter(boxed(self, if_, binding), boxed(self, then, binding))
            }
            ConstraintKind::SometimeBefore(if_, then) => {
                Kind::SometimeBefore(boxed(self, if_, binding), boxed(self, then, binding))
            }
            ConstraintKind::AlwaysWithin(limit, if_, then) => {
                Kind::AlwaysWithin(time(*limit), boxed(self, if_, binding), boxed(self, then, binding))
            }
            ConstraintKind::HoldDuring(from, until, part) => {
                Kind::Hold { from: time(*from), until: Some(time(*until)), body: boxed(self, part, binding) }
            }
            ConstraintKind::HoldAfter(from, part) => {
                Kind::Hold { from: time(*from), until: None, body: boxed(self, part, binding) }
            }
        };
        Formula { kind, span: constraint.span }
    }

    fn ground_all(
        &mut self,
        scene: Scene<'_>,
        variables: &'a Variables,
        parts: &'a [Constraint],
        binding: &mut Binding,
    ) -> Vec<Formula> {
        parts.iter().map(|part| self.ground(scene, variables, part, binding)).collect()
    }

    fn ground_each(
        &mut self,
        scene: Scene<'_>,
        variables: &'a Variables,
        over: &[VariableId],
        part: &'a Constraint,
        binding: &mut Binding,
    ) -> Vec<Formula> {
        let mut instances = Vec::new();
        each_instance(scene, over, binding, &mut |binding| {
            instances.push(self.ground(scene, variables, part, binding));
        });
        instances
    }

    /// Records a state. Two states at one time are two states.
    pub(crate) fn observe(&mut self, since: Since, universe: &Universe, state: &State) {
        self.times.push(since);
        for leaf in &mut self.leaves {
            if !state.work.spend(1) {
                return;
            }
            let clock = Clock::at(since.time);
            let scene = Scene { universe, state, variables: leaf.variables, clock };
            leaf.truth.push(scene.holds(leaf.condition, &mut leaf.binding));
        }
    }

    /// The recorded conditions, each with its variables and their values.
    pub(crate) fn conditions(&self) -> impl Iterator<Item = (&'a Condition, &'a Variables, &Binding)> {
        self.leaves.iter().map(|leaf| (leaf.condition, leaf.variables, &leaf.binding))
    }

    /// Each condition in a constraint: its place and the intervals in which it holds.
    pub(crate) fn stretches(&self, formula: &Formula) -> Vec<(Span, Vec<Stretch>)> {
        let mut found = Vec::new();
        formula.each_leaf(&mut |leaf| {
            let leaf = &self.leaves[leaf];
            let mut stretches: Vec<Stretch> = Vec::new();
            for (i, &holds) in leaf.truth.iter().enumerate() {
                let from = self.times[i].time;
                match (stretches.last_mut(), holds, i > 0 && leaf.truth[i - 1]) {
                    (Some(open), false, true) => open.until = Some(from),
                    (_, true, false) => stretches.push(Stretch { from, until: None }),
                    _ => {}
                }
            }
            found.push((leaf.condition.span, stretches));
        });
        found
    }

    /// The values of the variables that are bound at its first condition.
    pub(crate) fn values(&self, formula: &Formula) -> Vec<(Name, ObjectId)> {
        let mut first = None;
        formula.each_leaf(&mut |leaf| first = first.or(Some(leaf)));
        let Some(leaf) = first.map(|leaf| &self.leaves[leaf]) else { return Vec::new() };
        let slots = leaf.variables.slots.enumerate();
        slots.filter_map(|(id, variable)| Some((variable.name.clone(), leaf.binding.get(id)?))).collect()
    }

    /// The time of a state.
    pub(crate) fn time(&self, position: Position) -> Option<Number> {
        self.times.get(position).map(|since| since.time)
    }
}

/// The violation of a ground constraint, with its evidence.
#[derive(Clone, Debug)]
pub(crate) struct Broken {
    /// The place of the constraint.
    pub(crate) span: Span,
    pub(crate) breach: Breach,
    /// The condition that violates the constraint in a state, if a single one does.
    pub(crate) asked: Option<Asked>,
    /// One of its conditions, which has the values of its variables.
    leaf: Option<usize>,
    /// The violating states.
    pub(crate) states: Vec<Position>,
}

/// A condition with the wrong truth value in a state.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Asked {
    leaf: usize,
    pub(crate) position: Position,
    pub(crate) wanted: bool,
}

impl Formula {
    fn leaf(&self) -> Option<usize> {
        match &self.kind {
            Kind::Leaf(leaf) => Some(*leaf),
            _ => None,
        }
    }

    fn some_leaf(&self) -> Option<usize> {
        self.leaf().or_else(|| self.parts().find_map(Self::some_leaf))
    }
}

impl<'a> Trajectory<'a> {
    /// The violation of the constraint with its evidence, if it is violated.
    pub(crate) fn broken(&self, formula: &Formula) -> Option<Broken> {
        if let Kind::And(parts) = &formula.kind {
            return parts.iter().find_map(|part| self.broken(part));
        }
        let (span, breach) = self.breach(formula)?;
        let last = self.last();
        let at = breach.position().unwrap_or(last);
        let asked = match &formula.kind {
            Kind::Leaf(_) | Kind::And(_) | Kind::Or(_) | Kind::Not(_) => (formula.leaf(), 0, true),
            Kind::AtEnd(body) | Kind::Sometime(body) | Kind::Within(_, body) => (body.leaf(), last, true),
            Kind::Always(body) | Kind::Hold { body, .. } => (body.leaf(), at, true),
            Kind::AtMostOnce(body) => (body.leaf(), at, false),
            Kind::SometimeAfter(_, then) | Kind::AlwaysWithin(_, _, then) => (then.leaf(), last, true),
            Kind::SometimeBefore(_, then) => (then.leaf(), at, true),
        };
        let states = match &formula.kind {
            Kind::Always(body) => {
                let truth = self.truth(body);
                (0..truth.len()).filter(|&i| !truth[i]).collect()
            }
            Kind::Hold { from, until, body } => {
                let truth = self.truth(body);
                self.asked(0, *from, *until).filter(|&i| !truth[i]).collect()
            }
            Kind::SometimeAfter(if_, then) => unanswered(&self.answered(if_, then, None)),
            Kind::AlwaysWithin(limit, if_, then) => unanswered(&self.answered(if_, then, Some(*limit))),
            _ => breach.position().into_iter().collect(),
        };
        let (leaf, position, wanted) = asked;
        let asked = leaf.map(|leaf| Asked { leaf, position, wanted });
        Some(Broken { span, breach, asked, leaf: formula.some_leaf(), states })
    }

    /// The condition that was evaluated, its variables and their values.
    pub(crate) fn asked_condition(&self, asked: Asked) -> (&'a Condition, &'a Variables, &Binding) {
        let leaf = &self.leaves[asked.leaf];
        (leaf.condition, leaf.variables, &leaf.binding)
    }

    /// The values of the variables around the violated part.
    pub(crate) fn binding(&self, broken: &Broken) -> Vec<(Name, ObjectId)> {
        let Some(leaf) = broken.leaf.map(|leaf| &self.leaves[leaf]) else { return Vec::new() };
        let named = |(id, variable): (VariableId, &Variable)| {
            leaf.binding.get(id).map(|object| (variable.name.clone(), object))
        };
        leaf.variables.slots.enumerate().filter_map(named).collect()
    }
}

fn unanswered(answered: &[bool]) -> Vec<Position> {
    (0..answered.len()).filter(|&i| !answered[i]).collect()
}

impl Trajectory<'_> {
    /// Whether the trajectory satisfies the constraint.
    pub(crate) fn satisfies(&self, formula: &Formula) -> bool {
        self.breach(formula).is_none()
    }

    /// The violation of the constraint, if it is violated.
    pub(crate) fn breach(&self, formula: &Formula) -> Option<(Span, Breach)> {
        if let Kind::And(parts) = &formula.kind {
            return parts.iter().find_map(|part| self.breach(part));
        }
        if self.truth(formula).first().copied().unwrap_or(false) {
            return None;
        }
        let breach = match &formula.kind {
            Kind::Leaf(_) => Some(Breach::Here(0)),
            Kind::AtEnd(_) => Some(Breach::Here(self.last())),
            Kind::Always(body) => first(&self.truth(body), false).map(Breach::Here),
            Kind::AtMostOnce(body) => second_stretch(&self.truth(body)).map(Breach::Again),
            Kind::SometimeAfter(if_, then) => {
                first(&self.answered(if_, then, None), false).map(Breach::NeverAfter)
            }
            Kind::AlwaysWithin(limit, if_, then) => {
                first(&self.answered(if_, then, Some(*limit)), false).map(Breach::NeverAfter)
            }
            Kind::SometimeBefore(if_, _) => first(&self.truth(if_), true).map(Breach::NeverBefore),
            Kind::Hold { from, until, body } => {
                let body = self.truth(body);
                self.asked(0, *from, *until).find(|&i| !body[i]).map(Breach::Here)
            }
            Kind::And(_) | Kind::Sometime(_) | Kind::Within(..) | Kind::Or(_) | Kind::Not(_) => None,
        };
        Some((formula.span, breach.unwrap_or(Breach::Nowhere)))
    }

    /// The position of the last state.
    pub(crate) fn last(&self) -> Position {
        self.times.len().saturating_sub(1)
    }

    /// By position: whether the constraint holds for the part of the trajectory that starts there.
    fn truth(&self, formula: &Formula) -> Vec<bool> {
        let length = self.times.len();
        let join = |parts: &[Formula], all: bool| {
            let mut truth = vec![all; length];
            for part in parts {
                for (sum, one) in truth.iter_mut().zip(self.truth(part)) {
                    *sum = if all { *sum && one } else { *sum || one };
                }
            }
            truth
        };
        match &formula.kind {
            Kind::Leaf(leaf) => {
                let mut truth = self.leaves[*leaf].truth.clone();
                truth.resize(length, false);
                truth
            }
            Kind::And(parts) => join(parts, true),
            Kind::Or(parts) => join(parts, false),
            Kind::Not(part) => self.truth(part).into_iter().map(|truth| !truth).collect(),
            Kind::AtEnd(part) => vec![self.truth(part).last().copied().unwrap_or(false); length],
            Kind::Always(body) => from_here_on(self.truth(body)),
            Kind::Sometime(body) => next(&self.truth(body)).iter().map(Option::is_some).collect(),
            Kind::Within(limit, body) => {
                let next = next(&self.truth(body));
                (0..length).map(|i| next[i].is_some_and(|j| self.is_within(i, j, *limit))).collect()
            }
            Kind::AtMostOnce(body) => {
                let body = self.truth(body);
                let mut truth = vec![true; length];
                // The number of times that it begins to hold in the remaining states, if it did not
                // hold just before.
                let mut stretches = 0;
                for i in (0..length).rev() {
                    if body[i] && !body.get(i + 1).copied().unwrap_or(false) {
                        stretches += 1;
                    }
                    truth[i] = stretches <= 1;
                }
                truth
            }
            Kind::SometimeAfter(if_, then) => from_here_on(self.answered(if_, then, None)),
            Kind::AlwaysWithin(limit, if_, then) => from_here_on(self.answered(if_, then, Some(*limit))),
            Kind::SometimeBefore(if_, then) => {
                let (if_, then) = (next(&self.truth(if_)), next(&self.truth(then)));
                let prepared = |i: Position| if_[i].is_none_or(|wanted| then[i].is_some_and(|j| j < wanted));
                (0..length).map(prepared).collect()
            }
            Kind::Hold { from, until, body } => {
                let mut broken = vec![0_usize; length + 1];
                for (i, truth) in self.truth(body).into_iter().enumerate() {
                    broken[i + 1] = broken[i] + usize::from(!truth);
                }
                let whole = |i: Position| {
                    let asked = self.asked(i, *from, *until);
                    broken[asked.end] == broken[asked.start]
                };
                (0..length).map(whole).collect()
            }
        }
    }

    fn is_within(&self, from: Position, to: Position, limit: Number) -> bool {
        self.times[to] <= self.times[from].later(limit)
    }

    /// By state: whether `if_` is false, or `then` holds there or in a later state within the
    /// limit.
    fn answered(&self, if_: &Formula, then: &Formula, limit: Option<Number>) -> Vec<bool> {
        let (if_, next) = (self.truth(if_), next(&self.truth(then)));
        let in_time = |i, j| limit.is_none_or(|limit| self.is_within(i, j, limit));
        (0..if_.len()).map(|i| !if_[i] || next[i].is_some_and(|j| in_time(i, j))).collect()
    }

    /// The states that begin inside `start..until` after the one at `from`, and the state at time
    /// `start`.
    fn asked(&self, from: Position, start: Number, until: Option<Number>) -> std::ops::Range<Position> {
        let times = &self.times;
        let start = times[from].later(start);
        let lasting = times.partition_point(|&since| since <= start).max(from + 1) - 1;
        let end = match until {
            Some(until) => {
                let until = times[from].later(until);
                times.partition_point(|&since| since < until)
            }
            None => times.len(),
        };
        let begun = times.partition_point(|&since| since < start).max(from);
        let first = if begun < end { begun.min(lasting) } else { lasting };
        first..end.max(lasting + 1)
    }
}

fn first(truth: &[bool], wanted: bool) -> Option<Position> {
    truth.iter().position(|&truth| truth == wanted)
}

/// By position: whether it and all later ones are true.
fn from_here_on(mut truth: Vec<bool>) -> Vec<bool> {
    let mut all = true;
    for truth in truth.iter_mut().rev() {
        all &= *truth;
        *truth = all;
    }
    truth
}

/// By position: the first true position from there on.
fn next(truth: &[bool]) -> Vec<Option<Position>> {
    let mut next = vec![None; truth.len()];
    let mut nearest = None;
    for i in (0..truth.len()).rev() {
        if truth[i] {
            nearest = Some(i);
        }
        next[i] = nearest;
    }
    next
}

/// The position at which it becomes true for the second time.
fn second_stretch(truth: &[bool]) -> Option<Position> {
    let start = first(truth, true)?;
    let end = start + first(&truth[start..], false)?;
    Some(end + first(&truth[end..], true)?)
}
