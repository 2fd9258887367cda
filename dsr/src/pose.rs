//! Poses with the covariance of their error.
//!
//! Convention: a covariance is that of `(x, y, z, α, β, γ)`, the error of the position and a small rotation, both along
//! the axes of the frame in which the pose is given: `T' = (t + δt, exp(δφ)·R)`, as in ROS's `PoseWithCovariance`.
//! Metres and radians. The errors of different edges count as independent.
//!
//! Along a chain, errors add up to first order. For `T = T₁·T₂` with `r = R₁·t₂`
//!
//! ```text
//! δt = δt₁ − [r]ₓ·δφ₁ + R₁·δt₂          δφ = δφ₁ + R₁·δφ₂
//! ```
//!
//! and for `T⁻¹`: `δt' = −Rᵀ·(δt + [t]ₓ·δφ)`, `δφ' = −Rᵀ·δφ`. Invariant: a [`Covariance`] is finite, symmetric and has
//! no negative variance in any direction, also when it was read from a file. Cost: four products of 6×6 matrices per
//! edge that has one.
//!
//! Source: Smith, Self and Cheeseman, "Estimating uncertain spatial relationships in robotics", 1990 (compounding);
//! Barfoot and Furgale, "Associating uncertainty with three-dimensional poses", IEEE T-RO 30, 2014 (rotations by their
//! exponential).

use std::ops::Mul;
use std::sync::Arc;

use nalgebra::{Cholesky, Isometry3, Matrix3, Matrix6};
use serde::{Deserialize, Serialize};

/// The covariance of a pose: position in metres, then rotation in radians, along the axes of the parent's frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "[[f64; 6]; 6]", into = "[[f64; 6]; 6]")]
pub struct Covariance(Matrix6<f64>);

/// Why a matrix is not a covariance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum CovarianceError {
    /// A number is infinite or not a number.
    #[error("the covariance has a number that is not finite")]
    NotFinite,
    /// The matrix differs from its transpose.
    #[error("the covariance is not symmetric")]
    NotSymmetric,
    /// The variance in some direction is negative.
    #[error("the covariance has a negative variance in some direction")]
    NotPositive,
}

/// The rounding error that is tolerated, relative to the largest number.
const ROUNDING: f64 = 1e-9;

impl Covariance {
    /// Checks a matrix, and evens out the asymmetry that rounding left.
    pub fn new(matrix: Matrix6<f64>) -> Result<Self, CovarianceError> {
        if !matrix.iter().all(|number| number.is_finite()) {
            return Err(CovarianceError::NotFinite);
        }
        let even = 0.5 * matrix + 0.5 * matrix.transpose();
        if (matrix - even).amax() > matrix.amax() * ROUNDING {
            return Err(CovarianceError::NotSymmetric);
        }
        // Singular matrices are common: a robot on a floor has no error upwards. The check is of the symmetric matrix,
        // which is the one that is stored: so a covariance that was accepted once is accepted again when it is read.
        let scale = even.amax();
        let shifted = even + Matrix6::identity() * (scale * ROUNDING);
        if scale > 0.0 && Cholesky::new(shifted).is_none() {
            return Err(CovarianceError::NotPositive);
        }
        Ok(Self(even))
    }

    /// The mean at the fraction `part` of the way to another; `None` if rounding has made it invalid.
    pub(crate) fn towards(&self, other: &Self, part: f64) -> Option<Self> {
        Self::new(self.0 * (1.0 - part) + other.0 * part).ok()
    }

    /// As a matrix.
    pub fn matrix(&self) -> &Matrix6<f64> {
        &self.0
    }
}

impl TryFrom<[[f64; 6]; 6]> for Covariance {
    type Error = CovarianceError;

    fn try_from(rows: [[f64; 6]; 6]) -> Result<Self, CovarianceError> {
        Self::new(Matrix6::from_fn(|row, column| rows[row][column]))
    }
}

impl From<Covariance> for [[f64; 6]; 6] {
    fn from(covariance: Covariance) -> Self {
        std::array::from_fn(|row| std::array::from_fn(|column| covariance.0[(row, column)]))
    }
}

/// A pose, with its covariance if it is known.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    /// Maps coordinates of the child into the parent's frame.
    pub transform: Isometry3<f64>,
    /// The covariance of its error; `None` if it is unknown, or if the pose is exact.
    pub covariance: Option<Arc<Covariance>>,
}

impl From<Isometry3<f64>> for Pose {
    fn from(transform: Isometry3<f64>) -> Self {
        Self { transform, covariance: None }
    }
}

impl Pose {
    /// A pose with a covariance.
    pub fn new(transform: Isometry3<f64>, covariance: Covariance) -> Self {
        Self { transform, covariance: Some(Arc::new(covariance)) }
    }

    pub(crate) fn is_finite(&self) -> bool {
        let Isometry3 { translation, rotation } = &self.transform;
        translation.vector.iter().chain(rotation.coords.iter()).all(|number| number.is_finite())
    }

    /// Whether the rotation is a unit quaternion, as far as rounding allows. One that was read, or made without a
    /// check, need not be. It is not normalised here, because a read must return the bits that were written.
    pub(crate) fn is_rigid(&self) -> bool {
        self.is_finite() && (self.transform.rotation.coords.norm() - 1.0).abs() < 1e-3
    }

    /// Equal to the bit.
    pub(crate) fn same(&self, other: &Self) -> bool {
        let bits = |pose: &Self| {
            let (t, q) = (&pose.transform.translation.vector, &pose.transform.rotation.coords);
            [t.x, t.y, t.z, q.x, q.y, q.z, q.w].map(f64::to_bits)
        };
        let same = |a: &Arc<Covariance>, b: &Arc<Covariance>| {
            Arc::ptr_eq(a, b) || a.0.iter().map(|a| a.to_bits()).eq(b.0.iter().map(|b| b.to_bits()))
        };
        bits(self) == bits(other)
            && match (&self.covariance, &other.covariance) {
                (None, None) => true,
                (Some(a), Some(b)) => same(a, b),
                _ => false,
            }
    }
}

/// The pose of a part of a chain.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Uncertain {
    transform: Isometry3<f64>,
    error: Error,
}

/// The error of the pose of a part of a chain.
#[derive(Debug, Clone, Copy)]
#[expect(clippy::large_enum_variant, reason = "a box per edge would cost more than the room on the stack")]
enum Error {
    /// The pose is exact.
    None,
    Known(Matrix6<f64>),
    /// The error is unknown.
    Unknown,
}

impl Error {
    fn map(self, change: impl FnOnce(Matrix6<f64>) -> Matrix6<f64>) -> Self {
        match self {
            Self::Known(matrix) => Self::Known(change(matrix)),
            other => other,
        }
    }

    fn plus(self, other: Self) -> Self {
        match (self, other) {
            (Self::Unknown, _) | (_, Self::Unknown) => Self::Unknown,
            (Self::None, other) | (other, Self::None) => other,
            (Self::Known(one), Self::Known(other)) => Self::Known(one + other),
        }
    }
}

/// A matrix of four parts: `[a b; 0 d]`.
fn parts(a: &Matrix3<f64>, b: &Matrix3<f64>, d: &Matrix3<f64>) -> Matrix6<f64> {
    let mut whole = Matrix6::zeros();
    whole.fixed_view_mut::<3, 3>(0, 0).copy_from(a);
    whole.fixed_view_mut::<3, 3>(0, 3).copy_from(b);
    whole.fixed_view_mut::<3, 3>(3, 3).copy_from(d);
    whole
}

impl Uncertain {
    pub(crate) fn identity() -> Self {
        Self { transform: Isometry3::identity(), error: Error::None }
    }

    /// The pose of one edge. Without a covariance, a static pose is exact, like a mounting; a moving pose was measured,
    /// so its error is unknown.
    pub(crate) fn of(pose: &Pose, moves: bool) -> Self {
        let error = match &pose.covariance {
            Some(covariance) => Error::Known(covariance.0),
            None if moves => Error::Unknown,
            None => Error::None,
        };
        Self { transform: pose.transform, error }
    }

    pub(crate) fn inverse(self) -> Self {
        let back = self.transform.rotation.to_rotation_matrix().matrix().transpose();
        let lever = back * self.transform.translation.vector.cross_matrix();
        let by = parts(&-back, &-lever, &-back);
        Self {
            transform: self.transform.inverse(),
            error: self.error.map(|matrix| by * matrix * by.transpose()),
        }
    }

    /// The pose as callers see it.
    pub(crate) fn pose(self) -> Pose {
        let covariance = match self.error {
            // Numbers that are too large, or were lost in rounding along a chain of kilometres, make the error unknown.
            Error::Known(matrix) => Covariance::new(matrix).ok().map(Arc::new),
            Error::None | Error::Unknown => None,
        };
        Pose { transform: self.transform, covariance }
    }
}

impl Mul for Uncertain {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let turn = *self.transform.rotation.to_rotation_matrix().matrix();
        let lever = -(turn * other.transform.translation.vector).cross_matrix();
        let own = parts(&Matrix3::identity(), &lever, &Matrix3::identity());
        let others = parts(&turn, &Matrix3::zeros(), &turn);
        let one = self.error.map(|matrix| own * matrix * own.transpose());
        let two = other.error.map(|matrix| others * matrix * others.transpose());
        Self { transform: self.transform * other.transform, error: one.plus(two) }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Translation3, UnitQuaternion, Vector6};
    use proptest::prelude::*;

    use super::*;

    fn isometry(n: [f64; 6]) -> Isometry3<f64> {
        Isometry3::new([n[0], n[1], n[2]].into(), [n[3], n[4], n[5]].into())
    }

    /// The pose with this error.
    fn off(pose: &Isometry3<f64>, error: &Vector6<f64>) -> Isometry3<f64> {
        let translation = pose.translation.vector + error.fixed_rows::<3>(0);
        let turn = UnitQuaternion::from_scaled_axis(error.fixed_rows::<3>(3).into_owned());
        Isometry3::from_parts(Translation3::from(translation), turn * pose.rotation)
    }

    /// The error of the one pose, if the other is the right one.
    fn error(found: &Isometry3<f64>, right: &Isometry3<f64>) -> Vector6<f64> {
        let mut error = Vector6::zeros();
        error.fixed_rows_mut::<3>(0).copy_from(&(found.translation.vector - right.translation.vector));
        error.fixed_rows_mut::<3>(3).copy_from(&(found.rotation * right.rotation.inverse()).scaled_axis());
        error
    }

    fn uncertain(transform: Isometry3<f64>, error: &Vector6<f64>) -> Uncertain {
        Uncertain { transform, error: Error::Known(error * error.transpose()) }
    }

    fn known(uncertain: Uncertain) -> Matrix6<f64> {
        *uncertain.pose().covariance.expect("it is known").matrix()
    }

    proptest! {
        /// To first order, an error in one direction changes the product as a numeric derivative says, and independent
        /// errors add up.
        #[test]
        fn errors_add_up_along_a_chain(
            a in prop::array::uniform6(-3.0..3.0),
            b in prop::array::uniform6(-3.0..3.0),
            d in prop::array::uniform6(-1.0..1.0),
            e in prop::array::uniform6(-1.0..1.0),
        ) {
            const SMALL: f64 = 1e-6;
            let (a, b) = (isometry(a), isometry(b));
            let (d, e) = (Vector6::from(d), Vector6::from(e));
            let by_first = error(&(off(&a, &(d * SMALL)) * b), &(a * b)) / SMALL;
            let by_second = error(&(a * off(&b, &(e * SMALL))), &(a * b)) / SMALL;
            let wanted = by_first * by_first.transpose() + by_second * by_second.transpose();
            let found = known(uncertain(a, &d) * uncertain(b, &e));
            prop_assert!((found - wanted).amax() < 1e-3, "{found} {wanted}");

            let back = error(&off(&a, &(d * SMALL)).inverse(), &a.inverse()) / SMALL;
            let found = known(uncertain(a, &d).inverse());
            prop_assert!((found - back * back.transpose()).amax() < 1e-3);
        }

        #[test]
        fn a_sum_of_covariances_is_a_covariance(
            poses in prop::collection::vec((prop::array::uniform6(-3.0..3.0), prop::array::uniform6(-1.0..1.0)), 1..20),
        ) {
            let along = poses.iter().fold(Uncertain::identity(), |sum, (pose, error)| {
                uncertain(isometry(*pose), &Vector6::from(*error)) * sum
            });
            prop_assert!(Covariance::new(known(along.inverse())).is_ok());
        }
    }

    /// A variance that means "unknown" may be too large to be added up.
    #[test]
    fn a_covariance_that_overflows_is_unknown() {
        let vast =
            Uncertain { transform: Isometry3::identity(), error: Error::Known(Matrix6::identity() * 1e308) };
        assert_eq!(vast.pose().covariance.map(|known| known.matrix()[(0, 0)]), Some(1e308));
        assert_eq!((vast * vast).pose().covariance, None);
    }

    #[test]
    fn invalid_matrices_are_rejected() {
        let whole = |change: fn(&mut Matrix6<f64>)| {
            let mut matrix = Matrix6::identity() * 0.01;
            change(&mut matrix);
            Covariance::new(matrix)
        };
        assert!(whole(|_| {}).is_ok());
        assert!(whole(|m| m.fill(0.0)).is_ok(), "an exact pose");
        assert_eq!(whole(|m| m[(2, 2)] = f64::NAN), Err(CovarianceError::NotFinite));
        assert_eq!(whole(|m| m[(0, 1)] = 0.002), Err(CovarianceError::NotSymmetric));
        assert_eq!(whole(|m| m[(5, 5)] = -0.001), Err(CovarianceError::NotPositive));
        assert_eq!(
            whole(|m| (m[(0, 1)], m[(1, 0)]) = (0.02, 0.02)),
            Err(CovarianceError::NotPositive),
            "two that agree more than each with itself"
        );
        let json = serde_json::to_string(&whole(|_| {}).expect("one")).expect("plain numbers");
        assert_eq!(
            serde_json::from_str::<Covariance>(&json).expect("as written"),
            whole(|_| {}).expect("one")
        );
        assert!(serde_json::from_str::<Covariance>(&json.replacen("0.01", "-0.01", 1)).is_err());
    }
}
