//! Units of measure, for numeric attributes.
//!
//! An attribute that is declared with a unit stores numbers in that unit. A writer gives a plain number, which is in
//! that unit, or a quantity in a unit of its own, which is converted. A quantity of another dimension is rejected, so
//! degrees never stand where metres are meant. Invariant: each dimension has one unit with the factor 1, and every
//! factor converts to it.

use std::fmt;

use serde::{Deserialize, Serialize};

/// A unit of measure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "the names say it")]
pub enum Unit {
    Metre,
    Centimetre,
    Millimetre,
    Radian,
    Degree,
    Second,
    Millisecond,
    MetrePerSecond,
    RadianPerSecond,
    Kilogram,
    Newton,
    Volt,
    Ratio,
    Percent,
}

#[derive(PartialEq)]
enum Dimension {
    Length,
    Angle,
    Duration,
    Speed,
    Rotation,
    Mass,
    Force,
    Tension,
    Ratio,
}

impl Unit {
    fn measure(self) -> (Dimension, f64) {
        match self {
            Self::Metre => (Dimension::Length, 1.0),
            Self::Centimetre => (Dimension::Length, 1e-2),
            Self::Millimetre => (Dimension::Length, 1e-3),
            Self::Radian => (Dimension::Angle, 1.0),
            Self::Degree => (Dimension::Angle, std::f64::consts::PI / 180.0),
            Self::Second => (Dimension::Duration, 1.0),
            Self::Millisecond => (Dimension::Duration, 1e-3),
            Self::MetrePerSecond => (Dimension::Speed, 1.0),
            Self::RadianPerSecond => (Dimension::Rotation, 1.0),
            Self::Kilogram => (Dimension::Mass, 1.0),
            Self::Newton => (Dimension::Force, 1.0),
            Self::Volt => (Dimension::Tension, 1.0),
            Self::Ratio => (Dimension::Ratio, 1.0),
            Self::Percent => (Dimension::Ratio, 1e-2),
        }
    }

    /// Converts a number of this unit to another unit; `None` if the two have different dimensions.
    pub fn convert(self, number: f64, to: Self) -> Option<f64> {
        if self == to {
            return Some(number);
        }
        let ((dimension, factor), (wanted, divisor)) = (self.measure(), to.measure());
        (dimension == wanted).then_some(number * factor / divisor)
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Metre => "m",
            Self::Centimetre => "cm",
            Self::Millimetre => "mm",
            Self::Radian => "rad",
            Self::Degree => "°",
            Self::Second => "s",
            Self::Millisecond => "ms",
            Self::MetrePerSecond => "m/s",
            Self::RadianPerSecond => "rad/s",
            Self::Kilogram => "kg",
            Self::Newton => "N",
            Self::Volt => "V",
            Self::Ratio => "1",
            Self::Percent => "%",
        })
    }
}
