//! Sets of atoms of which at most one holds at a time, found on the lifted domain.
//!
//! Two use them: `lints`, because two conditions of which one excludes the other are a mistake that
//! relaxed reachability cannot see, and `planner`, for mutex groups and finite-domain variables. What
//! changes the state is handed in as [`Happening`](crate::happening::Happening)s, since the two do not look at the same parts of
//! the language; an [`Invariant`] says that the number of its atoms never becomes more than one, and
//! [`Counts`] says where a problem lets it start. A caller that knows the instances can ask for those that
//! hold unless parameters are equal ([`conditional_invariants`]).
//!
//! ```
//! use analysis::happening::happenings;
//! use analysis::invariants::invariants;
//!
//! let source = pddl::Source::new("d", "(define (domain hall) (:predicates (at ?x ?y))
//!     (:action go :parameters (?x ?from ?to) :precondition (at ?x ?from)
//!      :effect (and (not (at ?x ?from)) (at ?x ?to))))");
//! let domain = pddl::parse_domain(&source, &[]).model.expect("a correct domain");
//! let found = invariants(&domain, &happenings(&domain));
//! assert_eq!(found.len(), 1);
//! assert_eq!((&found[0].members[0].parameters[..], found[0].members[0].counted), (&[0][..], Some(1)));
//! ```
//!
//! | module | holds |
//! |---|---|
//! | `invariant` | an invariant, its members and its provisos |
//! | `balance` | whether a candidate's number can grow |
//! | `synthesis` | candidates, and how they are mended |
//! | `counts` | the numbers in a problem's initial state |

mod balance;
mod counts;
mod invariant;
mod synthesis;

pub use balance::{differ, literals};
pub use counts::Counts;
pub use invariant::{Invariant, Member, Proviso};
pub use synthesis::{conditional_invariants, invariants};
