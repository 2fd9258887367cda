//! Continuous change between two happenings.
//!
//! Every running continuous effect adds its rate to the rate of its fluent. A rate may read fluents
//! that change as well, as long as no fluent depends on itself. Then all of them are polynomials of
//! the time since the last happening ([`Curve`]), and each is integrated after those that it
//! depends on. A rate that depends on itself leads to an exponential, which is rejected as
//! unsupported.
//!
//! Source: Fox & Long, "PDDL2.1", JAIR 2003, §9; Howey, Long & Fox, "VAL", ICTAI 2004, §5.

use crate::curve::Curve;
use crate::evolution::{curve_of, difference, numeric};
use crate::expression::bind_functions;
use crate::number::{NoResult, Number};
use crate::root::{Instant, Root, Undecided};
use crate::scene::{Binding, Clock, Scene, each_instance};
use crate::state::{Curves, Passage, State};
use crate::universe::Universe;
use crate::value::Value;
use crate::verdict::{ChangeFault, NumericFault};
use pddl::Span;
use pddl::model::{
    Condition, ConditionKind, ContinuousEffect, Direction, Expression, GroundApplication, Variables,
};
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// A running continuous effect.
#[derive(Clone, Debug)]
pub(super) struct Running<'a> {
    pub(super) fluent: GroundApplication,
    pub(super) direction: Direction,
    pub(super) rate: &'a Expression,
    pub(super) variables: &'a Variables,
    pub(super) binding: Binding,
    pub(super) duration: Option<Number>,
    pub(super) span: Span,
}

/// The curves of the fluents from now on.
#[derive(Clone, Debug, Default)]
pub(super) struct Flow {
    curves: Arc<Curves>,
}

/// The state and the values from which rates are computed.
#[derive(Clone, Copy)]
pub(super) struct Present<'a> {
    pub(super) universe: &'a Universe,
    pub(super) state: &'a State,
    pub(super) now: Number,
}

impl<'a> Present<'a> {
    fn scene(self, variables: &'a Variables, duration: Option<Number>) -> Scene<'a> {
        let clock = Clock { duration, ..Clock::at(self.now) };
        Scene { universe: self.universe, state: self.state, variables, clock }
    }
}

impl Flow {
    pub(super) fn new(running: &[Running<'_>], present: Present<'_>) -> Result<Self, ChangeFault> {
        let mut by_fluent: FxHashMap<&GroundApplication, Vec<&Running<'_>>> = FxHashMap::default();
        for effect in running {
            by_fluent.entry(&effect.fluent).or_default().push(effect);
        }
        let mut making = Making { by_fluent, present, curves: Curves::default(), open: Vec::new() };
        for effect in running {
            making.fluent(effect)?;
        }
        Ok(Self { curves: Arc::new(making.curves) })
    }

    /// A flow with these curves.
    pub(super) fn of(curves: Vec<(GroundApplication, Curve)>) -> Self {
        Self { curves: Arc::new(curves.into_iter().collect()) }
    }

    /// Whether no fluent changes.
    pub(super) fn is_still(&self) -> bool {
        self.curves.values().all(|curve| curve.as_constant().is_some())
    }

    /// The fluents that have a curve.
    pub(super) fn fluents(&self) -> impl Iterator<Item = &GroundApplication> {
        self.curves.keys()
    }

    /// The fluents that change.
    pub(super) fn moving(&self) -> impl Iterator<Item = &GroundApplication> {
        let moving = self.curves.iter().filter(|(_, curve)| curve.as_constant().is_none());
        moving.map(|(fluent, _)| fluent)
    }

    /// Sets every running fluent to its value at this time after the last happening.
    pub(super) fn apply(&self, after: &Instant, state: &mut State) -> Result<(), NoResult> {
        let near = after.near();
        state.passage = None;
        let mut exact = near.is_exact() && matches!(after, Instant::At(_));
        for (fluent, curve) in &*self.curves {
            let mut value = curve.at(near)?;
            if let Instant::Root(root) = after
                && curve.as_constant().is_none()
            {
                value = fraction_at(curve, root, value).unwrap_or(value);
            }
            exact &= value.is_exact();
            state.set_fluent(fluent.clone(), Some(Value::Number(value)));
        }
        let passage = || Arc::new(Passage { curves: Arc::clone(&self.curves), at: after.clone() });
        state.passage = (!exact).then(passage);
        Ok(())
    }

    /// Makes running fluents undefined, so that conditions over them are only possible.
    pub(super) fn forget(&self, state: &mut State) {
        for fluent in self.curves.keys() {
            state.set_fluent(fluent.clone(), None);
        }
    }

    /// Adds the instants inside `0..length` at which a comparison in the condition may change.
    pub(super) fn critical(
        &self,
        condition: &Condition,
        scene: Scene<'_>,
        binding: &mut Binding,
        length: Number,
        into: &mut Vec<Instant>,
    ) {
        match &condition.kind {
            ConditionKind::Exists(variables, body) | ConditionKind::Forall(variables, body) => {
                each_instance(scene, variables, binding, &mut |binding| {
                    self.critical(body, scene, binding, length, into);
                });
            }
            ConditionKind::Compare(_, left, right) => {
                // A side without a value never has one, so the comparison never changes.
                let roots = match difference(&self.curves, left, right, scene, binding) {
                    Ok(Some(curve)) => curve.roots(Number::ZERO, length),
                    Ok(None) => Ok(Vec::new()),
                    Err(undecided) => Err(undecided),
                };
                match roots {
                    Ok(roots) => into.extend(roots),
                    Err(Undecided) => scene.state.work.mark_undecided(),
                }
            }
            _ => condition.parts().for_each(|part| self.critical(part, scene, binding, length, into)),
        }
    }
}

/// The value of a curve at an irrational root, if that value is a fraction: the ball is exactly on
/// the ground.
fn fraction_at(curve: &Curve, root: &Root, near: Number) -> Option<Number> {
    let (value, error) = (near.to_f64(), 1e-12 * near.to_f64().abs().max(1.0));
    let fraction = Number::simplest_between(value - error, value + error)?;
    let rest = curve.minus(&Curve::constant(fraction)).ok()?;
    root.sign_of(&rest.polynomial()).ok()?.is_eq().then_some(fraction)
}

/// A flow under construction.
struct Making<'a, 'r> {
    by_fluent: FxHashMap<&'a GroundApplication, Vec<&'a Running<'r>>>,
    present: Present<'a>,
    curves: Curves,
    /// Fluents whose curves are under construction.
    open: Vec<GroundApplication>,
}

impl Making<'_, '_> {
    fn fluent(&mut self, effect: &Running<'_>) -> Result<Curve, ChangeFault> {
        let fluent = &effect.fluent;
        if let Some(curve) = self.curves.get(fluent) {
            return Ok(curve.clone());
        }
        if self.open.contains(fluent) {
            return Err(ChangeFault::NotPolynomial { fluent: fluent.clone(), span: effect.span });
        }
        let Some(Value::Number(value)) = self.present.state.fluent(fluent) else {
            let fault = NumericFault::Undefined { fluent: fluent.clone(), span: effect.span };
            return Err(ChangeFault::Numeric(fault));
        };
        self.open.push(fluent.clone());
        let mut rate = Curve::constant(Number::ZERO);
        for part in self.by_fluent.get(fluent).cloned().unwrap_or_default() {
            let present = self.present;
            let scene = present.scene(part.variables, part.duration);
            let own = curve_of(part.rate, scene, &part.binding, &mut |read| match self
                .by_fluent
                .get(read)
                .and_then(|effects| effects.first().copied())
            {
                Some(effect) => self.fluent(effect).map(Some),
                None => Ok(None),
            })?;
            let own = if part.direction == Direction::Decrease { own.negated() } else { own };
            rate = rate.plus(&own).map_err(|fault| numeric(fault, part.span))?;
        }
        self.open.pop();
        let curve = rate.integrated(value).map_err(|fault| numeric(fault, effect.span))?;
        self.curves.insert(fluent.clone(), curve.clone());
        Ok(curve)
    }
}

pub(super) fn each_running<'v>(
    scene: Scene<'v>,
    effect: &'v ContinuousEffect,
    mut binding: Binding,
    running: &mut Vec<Running<'v>>,
) -> Result<(), ChangeFault> {
    let mut result = Ok(());
    each_instance(scene, &effect.forall, &mut binding, &mut |binding| {
        let mut binding = binding.clone();
        if let Err(fault) = bind_functions(scene, &effect.functions, &mut binding) {
            result = Err(ChangeFault::Numeric(fault));
            return;
        }
        running.push(Running {
            fluent: scene.ground(&effect.fluent, &binding),
            direction: effect.direction,
            rate: &effect.rate,
            variables: scene.variables,
            binding,
            duration: scene.clock.duration,
            span: effect.span,
        });
    });
    result
}
