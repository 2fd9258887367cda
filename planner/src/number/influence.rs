//! How a change of a fluent may affect a comparison.
//!
//! Idea: if a sum changes by a constant, the sign decides whether a comparison can become true or
//! false; any other change may do both. A possible effect is never ruled out, so relaxations stay
//! safe.

use super::{Change, Expression, Number, Relation};

/// How a comparison may change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Influence {
    pub(crate) may_hold: bool,
    pub(crate) may_fail: bool,
    /// The change of the compared expression, if it is constant.
    pub(crate) step: Option<Number>,
}

impl Influence {
    pub(crate) fn of<V: Clone + Ord>(
        (relation, expression): (Relation, &Expression<V>),
        fluent: &V,
        change: Change,
        value: Option<&Expression<V>>,
    ) -> Self {
        let any = Self { may_hold: true, may_fail: true, step: None };
        if relation == Relation::Defined {
            return Self { may_fail: value.is_none() || expression.divides(), ..any };
        }
        let Expression::Linear(linear) = expression else { return any };
        let Some(value) = value else { return Self { may_hold: false, ..any } };
        let Some(by) = value.as_constant() else { return any };
        let coefficient = linear.terms.iter().find(|(v, _)| v == fluent).map(|(_, c)| *c);
        match change {
            Change::Shift => {
                let Some(step) = coefficient.and_then(|c| c.times(by)) else { return any };
                let (up, down) = match relation {
                    _ if step.is_zero() => (false, false),
                    Relation::Positive | Relation::NonNegative => (step.sign() > 0, step.sign() < 0),
                    Relation::Zero | Relation::NonZero | Relation::Defined => (true, true),
                };
                Self { may_hold: up, may_fail: down, step: Some(step) }
            }
            Change::Assign if linear.terms.len() == 1 => {
                let holds = expression.evaluate(&|_| Some(by)).map(|v| relation.holds(v.sign()));
                holds.map_or(any, |holds| Self { may_hold: holds, may_fail: !holds, step: None })
            }
            Change::Assign | Change::Scale => any,
        }
    }
}
