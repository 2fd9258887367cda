//! Which values numeric fluents can take.
//!
//! Two analyses, one arithmetic. [`Hulls`] has one interval for each function, whatever its arguments: a few passes over
//! the effects, so that it answers for every fluent of every problem. [`Ranges`] follows the single fluents that a
//! comparison reads and takes the conditions of the effects into account, so that it proves more; where it stops, the
//! hulls answer.
//!
//! | module | holds |
//! |---|---|
//! | `interval` | the arithmetic |
//! | `hulls` | one interval for each function |
//! | `ranges` | one interval for each fluent that is followed |

mod hulls;
mod interval;
mod ranges;

pub use hulls::{Expected, Hulls, Value};
pub use interval::{End, Interval};
pub use ranges::{Extent, NeverCompares, Ranges, Reachable};
