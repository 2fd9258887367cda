//! Costs of operators as integers.

use crate::ground::normalise::{CostModel, Measure};
use crate::task::Operators;
use budget::{Interrupted, Meter};
use rustc_hash::FxHashSet;

/// Converts the costs to integers and returns the scale.
pub(super) fn set_costs(
    operators: &mut Operators,
    amounts: &[f64],
    costs: &CostModel,
    meter: &Meter<'_>,
) -> Result<u32, Interrupted> {
    // If no operator costs anything, every operator costs 1, so that shorter plans are better.
    if costs.is_unit() || (matches!(costs.measure, Measure::Value(_)) && amounts.iter().all(|&a| a == 0.0)) {
        return Ok(1);
    }
    let mut different = FxHashSet::default();
    for part in meter.chunks(amounts, 8) {
        different.extend(part?.iter().map(|amount| amount.to_bits()));
    }
    let scale = scale(&different.into_iter().map(f64::from_bits).collect::<Vec<_>>());
    for (operator, amount) in amounts.iter().enumerate() {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "not negative; saturates"
        )]
        let cost = (amount * f64::from(scale)).round() as u32;
        operators.set_cost(operator, cost);
        meter.spend(8)?;
    }
    Ok(scale)
}

/// The smallest power of ten that makes all costs integers (up to six decimals).
fn scale(costs: &[f64]) -> u32 {
    (0..6)
        .map(|k| 10_u32.pow(k))
        .take_while(|&s| s == 1 || costs.iter().all(|c| c * f64::from(s) < f64::from(u32::MAX / 2)))
        .find(|&s| costs.iter().all(|c| ((c * f64::from(s)) - (c * f64::from(s)).round()).abs() < 1e-6))
        .unwrap_or(1)
}
