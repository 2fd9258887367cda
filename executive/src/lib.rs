//! PELEA: the High Level Executive, Monitoring and Decision Support.
//!
//! The [`Wheel`] turns on events (the graph changed, a deadline passed, a plan came back) and answers with
//! effects (write intentions, plan, set a timer, report). It is pure; [`Shell`] carries its effects out on tokio.
//!
//! ```
//! use executive::{Decision, GoalId, Model, Request, RequestId, decide};
//! use pddl::{Source, model::Name, parse_domain, parse_problem};
//! use std::sync::Arc;
//!
//! let domain = Source::new("d", "(define (domain d) (:predicates (lit) (dark))
//!     (:action light :parameters () :precondition (dark) :effect (lit)))");
//! let domain = parse_domain(&domain, &[]).model.unwrap();
//! let problem = Source::new("p", "(define (problem p) (:domain d) (:init) (:goal (lit)))");
//! let problem = parse_problem(&problem, &domain).model.unwrap();
//!
//! // `lit` and `dark` are sensed: no plan from what the problem says, one from what is seen now.
//! let model = Arc::new(Model::new(domain, problem, &[Name::new("lit"), Name::new("dark")]).unwrap());
//! let dark = low_to_high::Fact { predicate: Name::new("dark"), arguments: Vec::new() };
//! let state = model.state([&dark]);
//! let request = Request {
//!     id: RequestId(0), state, goals: vec![GoalId(0)], broken: Vec::new(), served: Vec::new(),
//!     running: Vec::new(), barred: Vec::new(), expansions: 100, arrived: None,
//! };
//! let never = budget::Cancellation::default();
//! assert!(matches!(decide(&model, &request, &never), Decision::Plan { operators, .. } if operators.len() == 1));
//! ```
//!
//! | module | PELEA's module (paper §4.2) |
//! |---|---|
//! | `wheel` | High Level Executive |
//! | `monitoring` | Monitoring |
//! | `decision_support` | Decision Support |
//! | `goal`, `goals` | the mission's goals: their text, their lives, which of them one plan serves |
//! | `arrivals` | objects that appear at run time |
//! | `soft_plans` | plans that go for soft goals as far as they are worth it |
//! | `model` | the high-level model that they share |
//! | `compression`, `order`, `timing` | durative actions: as single steps, in a partial order, with deadlines |
//! | `outcome` | why there is no plan, why a step failed, how the mission ended |
//! | `narration` | the story: every decision with its reason |
//! | `record` | a turn of the wheel as data, to be taken again |
//! | `lasting` | what waits for the disk, and outlives the process |
//! | `shell` | where the pure wheel meets graph, clock and threads |
//! | `wording` | outcomes and reasons as sentences |

mod arrivals;
mod compression;
mod decision_support;
#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test")]
mod dispatch_tests;
mod goal;
mod goals;
mod lasting;
mod model;
mod monitoring;
mod narration;
mod order;
mod outcome;
mod record;
mod shell;
mod soft_plans;
mod timing;
mod wheel;
mod wording;

pub use arrivals::{Arrival, Arrivals};
pub use compression::{CompressionError, Meanwhile};
pub use decision_support::{Arrived, Decision, Figures, Repair, Request, RequestId, decide};
pub use goal::{GoalId, GoalText, Importance};
pub use goals::{GoalChange, Life, Reason, Stage};
pub use lasting::Lasting;
pub use model::{Changes, Model, ModelError, Sensed, Step};
pub use monitoring::{BrokenLiteral, Deviation, Monitor};
pub use narration::Narration;
pub use outcome::{Ending, NoPlan, StepFailure, Stuck, Trouble, Unsolvable};
pub use record::{Occurrence, Turn};
pub use shell::Shell;
pub use timing::Duration;
pub use wheel::{Bounds, Effect, Event, Policy, Wheel};
