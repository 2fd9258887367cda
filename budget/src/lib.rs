//! What one operation may use up, and how its caller cancels it.
//!
//! Problem: planning, validating and linting can each take longer or hold more than a machine has, and their
//! caller may lose interest at any moment. Idea: the caller passes a [`Budget`]; the operation counts its work
//! with a [`Meter`], which compares it with the budget and now and then asks whether the caller cancelled. An
//! [`Interrupted`] then runs up through the operation with `?`. Several threads share one [`Cancellation`].
//!
//! Invariant: nothing here reads a clock. A deadline is a closure of the caller's. Where only work is limited, the
//! same call therefore gives the same answer on each machine.
//!
//! Cost: [`Meter::spend`] is an addition and a comparison.
//!
//! ```
//! use budget::{Budget, Cancellation, Interrupted, Meter};
//!
//! fn sum(numbers: &[u64], meter: &Meter) -> Result<u64, Interrupted> {
//!     let mut sum = 0;
//!     for number in numbers {
//!         meter.spend(1)?;
//!         sum += number;
//!     }
//!     Ok(sum)
//! }
//!
//! assert_eq!(sum(&[1, 2, 3], &Meter::of_work(3)), Ok(6));
//! assert_eq!(sum(&[1, 2, 3], &Meter::of_work(2)), Err(Interrupted::Work));
//!
//! let cancellation = Cancellation::default();
//! cancellation.cancel();
//! let interrupted = || cancellation.is_cancelled();
//! let meter = Meter::new(Budget { interrupted: &interrupted, ..Budget::default() });
//! assert_eq!(sum(&[1, 2, 3], &meter), Err(Interrupted::Cancelled));
//! ```
//!
//! | module | holds |
//! |---|---|
//! | `cancellation` | a switch that several threads share |
//! | `limits` | the budget, and the reason for an early end |
//! | `meter` | counted work |

mod cancellation;
mod limits;
mod meter;

pub use cancellation::Cancellation;
pub use limits::{Budget, Interrupted};
pub use meter::{INTERVAL, Meter};
