//! Change between two happenings.
//!
//! Every running continuous effect adds its rate to that of its fluent. A rate may read fluents that
//! change as well, as long as none depends on itself: then all of them are polynomials of the time since
//! the last happening ([`Curve`]), found by integrating from the ground up. A rate that depends on itself
//! makes an exponential, which is refused by name.
//!
//! Source: Fox & Long, "PDDL2.1", JAIR 2003, §9; Howey, Long & Fox, "VAL", ICTAI 2004, §5.

use crate::curve::Curve;
use crate::expression::NumericFault;
use crate::number::{NoResult, Number};
use crate::scene::{Binding, Clock, Scene};
use crate::state::{State, Value};
use crate::trajectory::each_instance;
use crate::universe::Universe;
use crate::verdict::ChangeFault;
use pddl::Span;
use pddl::model::{
    ArithmeticOperator, Condition, ConditionKind, Direction, Expression, ExpressionKind, GroundApplication,
    Variables,
};
use rustc_hash::FxHashMap;

/// A continuous effect that runs.
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

/// How the fluents run from now on.
#[derive(Clone, Debug, Default)]
pub(super) struct Flow {
    curves: FxHashMap<GroundApplication, Curve>,
}

/// What rates are read from.
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
        let mut making = Making { by_fluent, present, flow: Self::default(), open: Vec::new() };
        for effect in running {
            making.fluent(effect)?;
        }
        Ok(making.flow)
    }

    /// Whether nothing changes.
    pub(super) fn is_still(&self) -> bool {
        self.curves.values().all(|curve| curve.as_constant().is_some())
    }

    /// Gives every running fluent its value so many seconds after the last happening.
    pub(super) fn apply(&self, after: Number, state: &mut State) -> Result<(), NoResult> {
        for (fluent, curve) in &self.curves {
            state.set_fluent(fluent.clone(), Some(Value::Number(curve.at(after)?)));
        }
        Ok(())
    }

    /// Takes the values of running fluents away, so that what is said of them is only possible.
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
        into: &mut Vec<Number>,
    ) {
        match &condition.kind {
            ConditionKind::And(parts) | ConditionKind::Or(parts) => {
                parts.iter().for_each(|part| self.critical(part, scene, binding, length, into));
            }
            ConditionKind::Not(part) => self.critical(part, scene, binding, length, into),
            ConditionKind::Imply(if_, then) => {
                self.critical(if_, scene, binding, length, into);
                self.critical(then, scene, binding, length, into);
            }
            ConditionKind::Exists(variables, body) | ConditionKind::Forall(variables, body) => {
                each_instance(scene, variables, binding, &mut |binding| {
                    self.critical(body, scene, binding, length, into);
                });
            }
            ConditionKind::Compare(_, left, right) => {
                // A side without a value has none at any time: the comparison never changes.
                let roots = self.side(left, scene, binding).ok().zip(self.side(right, scene, binding).ok());
                let roots = roots.and_then(|(left, right)| left.minus(&right).ok());
                into.extend(roots.and_then(|d| d.roots(Number::ZERO, length).ok()).unwrap_or_default());
            }
            ConditionKind::Atom(_)
            | ConditionKind::HasType(..)
            | ConditionKind::Same(..)
            | ConditionKind::FluentIs(..) => {}
        }
    }

    fn side(
        &self,
        expression: &Expression,
        scene: Scene<'_>,
        binding: &Binding,
    ) -> Result<Curve, ChangeFault> {
        curve_of(expression, scene, binding, &mut |fluent| Ok(self.curves.get(fluent).cloned()))
    }
}

/// A flow while it is made.
struct Making<'a, 'r> {
    by_fluent: FxHashMap<&'a GroundApplication, Vec<&'a Running<'r>>>,
    present: Present<'a>,
    flow: Flow,
    /// Fluents whose curves are being made.
    open: Vec<GroundApplication>,
}

impl Making<'_, '_> {
    fn fluent(&mut self, effect: &Running<'_>) -> Result<Curve, ChangeFault> {
        let fluent = &effect.fluent;
        if let Some(curve) = self.flow.curves.get(fluent) {
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
        self.flow.curves.insert(fluent.clone(), curve.clone());
        Ok(curve)
    }
}

/// The curve of a fluent, if it changes.
type Curves<'f> = dyn FnMut(&GroundApplication) -> Result<Option<Curve>, ChangeFault> + 'f;

/// The curve of an expression.
fn curve_of(
    expression: &Expression,
    scene: Scene<'_>,
    binding: &Binding,
    running: &mut Curves<'_>,
) -> Result<Curve, ChangeFault> {
    let span = expression.span;
    match &expression.kind {
        ExpressionKind::Fluent(application) => {
            let fluent = scene.ground(application, binding);
            if let Some(curve) = running(&fluent)? {
                return Ok(curve);
            }
        }
        ExpressionKind::Arithmetic(operator, operands) => {
            let Some((first, rest)) = operands.split_first() else {
                return Ok(Curve::constant(Number::ZERO));
            };
            let mut result = curve_of(first, scene, binding, running)?;
            if rest.is_empty() && *operator == ArithmeticOperator::Subtract {
                return Ok(result.negated());
            }
            for operand in rest {
                let operand = curve_of(operand, scene, binding, running)?;
                result = match operator {
                    ArithmeticOperator::Add => result.plus(&operand),
                    ArithmeticOperator::Subtract => result.minus(&operand),
                    ArithmeticOperator::Multiply => result.times(&operand),
                    ArithmeticOperator::Divide => match operand.as_constant() {
                        Some(divisor) => result.over(divisor),
                        None => return Err(ChangeFault::NotPolynomialExpression { span }),
                    },
                }
                .map_err(|fault| numeric(fault, span))?;
            }
            return Ok(result);
        }
        ExpressionKind::Number(_)
        | ExpressionKind::Duration
        | ExpressionKind::TotalTime
        | ExpressionKind::IsViolated(_) => {}
    }
    scene.number(expression, binding).map(Curve::constant).map_err(ChangeFault::Numeric)
}

fn numeric(fault: NoResult, span: Span) -> ChangeFault {
    ChangeFault::Numeric(NumericFault::of(fault, span))
}
