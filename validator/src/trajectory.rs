//! Whether the states that a plan goes through satisfy trajectory constraints.
//!
//! Problem: constraints speak of many states and may be nested, but the validator has one state that it
//! changes in place. Idea: ground the constraints first (a copy for each binding of their quantifiers),
//! so that only plain conditions are left in them; while the plan runs, note for each of these whether
//! it holds in each state; and then read the definitions off the notes as the paper writes them.
//!
//! A state lasts from its own time until before the next one's, and the last one for ever. A sequential
//! plan's n-th state has the time n. Cost: one evaluation a condition a state, a bit of memory for it,
//! and for an operator that is not nested one look at each state.
//!
//! Source: Gerevini & Long, "Plan constraints and preferences in PDDL3", 2005, §3; Gerevini, Haslum,
//! Long, Saetti & Dimopoulos, "Deterministic planning in the fifth international planning competition",
//! AIJ 2009, §3.2.

use crate::number::Number;
use crate::scene::{Binding, Clock, Scene};
use crate::state::State;
use crate::universe::Universe;
use pddl::Span;
use pddl::model::{Condition, Constraint, ConstraintKind, VariableId, Variables};

/// The position of a state on the trajectory: 0 is the initial one.
pub(crate) type Position = usize;

/// A condition of a ground constraint.
#[derive(Clone, Debug)]
struct Leaf<'a> {
    condition: &'a Condition,
    variables: &'a Variables,
    binding: Binding,
    /// Whether it holds, per state.
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

/// What is noted of the states.
#[derive(Clone, Debug, Default)]
pub(crate) struct Trajectory<'a> {
    leaves: Vec<Leaf<'a>>,
    times: Vec<Number>,
}

impl<'a> Trajectory<'a> {
    /// Prepares a constraint: from now on its conditions are noted. Before the first state.
    pub(crate) fn ground(
        &mut self,
        scene: Scene<'a>,
        constraint: &'a Constraint,
        binding: &mut Binding,
    ) -> Formula {
        let boxed = |this: &mut Self, part: &'a Constraint, binding: &mut Binding| {
            Box::new(this.ground(scene, part, binding))
        };
        let time = Number::from_decimal;
        let kind = match &constraint.kind {
            ConstraintKind::Holds(condition) => {
                let variables = scene.variables;
                self.leaves.push(Leaf { condition, variables, binding: binding.clone(), truth: Vec::new() });
                Kind::Leaf(self.leaves.len() - 1)
            }
            ConstraintKind::And(parts) => Kind::And(self.ground_all(scene, parts, binding)),
            ConstraintKind::Or(parts) => Kind::Or(self.ground_all(scene, parts, binding)),
            ConstraintKind::Not(part) => Kind::Not(boxed(self, part, binding)),
            ConstraintKind::Imply(if_, then) => {
                let if_ = boxed(self, if_, binding);
                let not = Formula { span: if_.span, kind: Kind::Not(if_) };
                Kind::Or(vec![not, self.ground(scene, then, binding)])
            }
            ConstraintKind::Exists(variables, part) => {
                Kind::Or(self.ground_each(scene, variables, part, binding))
            }
            ConstraintKind::Forall(variables, part) => {
                Kind::And(self.ground_each(scene, variables, part, binding))
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
        scene: Scene<'a>,
        parts: &'a [Constraint],
        binding: &mut Binding,
    ) -> Vec<Formula> {
        parts.iter().map(|part| self.ground(scene, part, binding)).collect()
    }

    fn ground_each(
        &mut self,
        scene: Scene<'a>,
        variables: &[VariableId],
        part: &'a Constraint,
        binding: &mut Binding,
    ) -> Vec<Formula> {
        let mut instances = Vec::new();
        each_instance(scene, variables, binding, &mut |binding| {
            instances.push(self.ground(scene, part, binding));
        });
        instances
    }

    /// Notes a state. Two states at one time are two states.
    pub(crate) fn observe(&mut self, time: Number, universe: &Universe, state: &State) {
        self.times.push(time);
        for leaf in &mut self.leaves {
            let scene = Scene { universe, state, variables: leaf.variables, clock: Clock::at(time) };
            leaf.truth.push(scene.holds(leaf.condition, &mut leaf.binding));
        }
    }

    /// The conditions that are noted, each with its variables and their values.
    pub(crate) fn conditions(&self) -> impl Iterator<Item = (&'a Condition, &'a Variables, &Binding)> {
        self.leaves.iter().map(|leaf| (leaf.condition, leaf.variables, &leaf.binding))
    }

    /// The time of a state.
    pub(crate) fn time(&self, position: Position) -> Option<Number> {
        self.times.get(position).copied()
    }
}

/// Visits each binding of `variables`; they are unbound again on return.
pub(crate) fn each_instance(
    scene: Scene<'_>,
    variables: &[VariableId],
    binding: &mut Binding,
    visit: &mut dyn FnMut(&mut Binding),
) {
    let Some((&first, rest)) = variables.split_first() else { return visit(binding) };
    for &object in &scene.extent(first).objects {
        binding.set(first, Some(object));
        each_instance(scene, rest, binding, visit);
    }
    binding.set(first, None);
}

/// Where and how a constraint is broken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Breach {
    /// In a state in which its condition had to hold.
    Here(Position),
    /// Nothing came after this state that had to come.
    NeverAfter(Position),
    /// Nothing came before this state that had to come.
    NeverBefore(Position),
    /// It became true again in this state.
    Again(Position),
    /// No state satisfies it.
    Nowhere,
}

impl Breach {
    /// The state that it is about.
    pub(crate) fn position(self) -> Option<Position> {
        match self {
            Self::Here(at) | Self::NeverAfter(at) | Self::NeverBefore(at) | Self::Again(at) => Some(at),
            Self::Nowhere => None,
        }
    }
}

impl Trajectory<'_> {
    /// How often states were noted.
    pub(crate) fn len(&self) -> Position {
        self.times.len()
    }

    /// Whether the trajectory satisfies the constraint.
    pub(crate) fn satisfies(&self, formula: &Formula) -> bool {
        self.breach(formula).is_none()
    }

    /// How the constraint is broken, if it is.
    pub(crate) fn breach(&self, formula: &Formula) -> Option<(Span, Breach)> {
        let at = |breach| Some((formula.span, breach));
        match &formula.kind {
            Kind::And(parts) => parts.iter().find_map(|part| self.breach(part)),
            _ if self.holds(formula, 0) => None,
            Kind::Leaf(_) => at(Breach::Here(0)),
            Kind::AtEnd(_) => at(Breach::Here(self.last())),
            Kind::Always(body) => at(Breach::Here(self.first(0, |i| !self.holds(body, i))?)),
            Kind::AtMostOnce(body) => at(Breach::Again(self.second_stretch(body, 0)?)),
            Kind::SometimeAfter(if_, then) => at(Breach::NeverAfter(self.unanswered(if_, then, 0, None)?)),
            Kind::AlwaysWithin(limit, if_, then) => {
                at(Breach::NeverAfter(self.unanswered(if_, then, 0, Some(*limit))?))
            }
            Kind::SometimeBefore(if_, then) => at(Breach::NeverBefore(self.unprepared(if_, then, 0)?)),
            Kind::Hold { from, until, body } => {
                at(Breach::Here(self.broken_between(*from, *until, body, 0)?))
            }
            Kind::Sometime(_) | Kind::Within(..) | Kind::Or(_) | Kind::Not(_) => at(Breach::Nowhere),
        }
    }

    fn last(&self) -> Position {
        self.len().saturating_sub(1)
    }

    fn first(&self, from: Position, test: impl Fn(Position) -> bool) -> Option<Position> {
        (from..self.len()).find(|&i| test(i))
    }

    /// Whether it holds for the part of the trajectory that starts at `from`.
    fn holds(&self, formula: &Formula, from: Position) -> bool {
        match &formula.kind {
            Kind::Leaf(leaf) => self.leaves[*leaf].truth.get(from).copied().unwrap_or(false),
            Kind::And(parts) => parts.iter().all(|part| self.holds(part, from)),
            Kind::Or(parts) => parts.iter().any(|part| self.holds(part, from)),
            Kind::Not(part) => !self.holds(part, from),
            Kind::AtEnd(part) => self.holds(part, self.last()),
            Kind::Always(body) => self.first(from, |i| !self.holds(body, i)).is_none(),
            Kind::Sometime(body) => self.first(from, |i| self.holds(body, i)).is_some(),
            Kind::Within(limit, body) => self
                .first(from, |i| self.elapsed(from, i) > *limit || self.holds(body, i))
                .is_some_and(|i| self.elapsed(from, i) <= *limit),
            Kind::AtMostOnce(body) => self.second_stretch(body, from).is_none(),
            Kind::SometimeAfter(if_, then) => self.unanswered(if_, then, from, None).is_none(),
            Kind::AlwaysWithin(limit, if_, then) => self.unanswered(if_, then, from, Some(*limit)).is_none(),
            Kind::SometimeBefore(if_, then) => self.unprepared(if_, then, from).is_none(),
            Kind::Hold { from: start, until, body } => {
                self.broken_between(*start, *until, body, from).is_none()
            }
        }
    }

    fn elapsed(&self, from: Position, to: Position) -> Number {
        // Times of plans are decimals of a file: their differences have a value.
        self.times[to].minus(self.times[from]).unwrap_or(Number::ZERO)
    }

    /// Where `body` becomes true for the second time.
    fn second_stretch(&self, body: &Formula, from: Position) -> Option<Position> {
        let start = self.first(from, |i| self.holds(body, i))?;
        let end = self.first(start, |i| !self.holds(body, i))?;
        self.first(end, |i| self.holds(body, i))
    }

    /// The first state with `if_` that no later one with `then` follows, or none in time.
    fn unanswered(
        &self,
        if_: &Formula,
        then: &Formula,
        from: Position,
        limit: Option<Number>,
    ) -> Option<Position> {
        // From the end on, the next state with `then` is known.
        let mut next = None;
        let mut found = None;
        for i in (from..self.len()).rev() {
            if self.holds(then, i) {
                next = Some(i);
            }
            let answered = next.is_some_and(|j| limit.is_none_or(|limit| self.elapsed(i, j) <= limit));
            if !answered && self.holds(if_, i) {
                found = Some(i);
            }
        }
        found
    }

    /// The first state with `if_` that no earlier one with `then` precedes.
    fn unprepared(&self, if_: &Formula, then: &Formula, from: Position) -> Option<Position> {
        let wanted = self.first(from, |i| self.holds(if_, i))?;
        (from..wanted).all(|i| !self.holds(then, i)).then_some(wanted)
    }

    /// The first state that lasts into `start..until` without `body`.
    fn broken_between(
        &self,
        start: Number,
        until: Option<Number>,
        body: &Formula,
        from: Position,
    ) -> Option<Position> {
        self.first(from, |i| {
            let begins_in_time = until.is_none_or(|until| self.elapsed(from, i) < until);
            let lasts = i == self.last() || self.elapsed(from, i + 1) > start;
            // Beyond the plan's end its last state stays.
            let asked = if i == self.last() {
                begins_in_time || self.elapsed(from, i) <= start
            } else {
                begins_in_time
            };
            asked && lasts && !self.holds(body, i)
        })
    }
}
