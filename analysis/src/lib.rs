//! What the planner and the lints both ask of a model before any search: which atoms exclude each other, which values
//! numeric fluents can take, and what can ever become true.
//!
//! Every answer holds for all reachable states and is a proof in one direction only: "never" is proven, "possibly" is
//! not.
//!
//! | module | holds |
//! |---|---|
//! | `number`, `expression` | exact numbers; expressions over numeric fluents |
//! | [`text`] | lists and quotations for messages |
//! | [`walk`] | conditions, effects and expressions, part by part |
//! | [`changes`], [`happening`] | what changes the state, as flat lists |
//! | `instance` | a domain with a problem, and the values in a state |
//! | `literal` | atoms with open arguments, bindings of a schema's variables |
//! | `needs` | what a condition certainly needs |
//! | [`invariants`] | sets of atoms of which at most one holds at a time (mutexes) |
//! | [`intervals`] | the values that numeric fluents can take |
//! | [`reachability`] | what can become true if nothing is ever deleted, and why something cannot |

pub mod changes;
mod expression;
pub mod happening;
mod instance;
pub mod intervals;
pub mod invariants;
mod literal;
mod needs;
mod number;
pub mod reachability;
#[cfg(test)]
mod test_support;
pub mod text;
pub mod walk;

pub use expression::{Expression, Linear, NoValue, Operator};
pub use instance::{Instance, Values};
pub use literal::{Binding, Literal, Pattern};
pub use needs::{Compared, Needs};
pub use number::Number;
