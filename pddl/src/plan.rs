//! Classical plan files: one ground action a line, `;` comments, an optional `; cost = N`.

use crate::Span;
use crate::model::{ActionId, ObjectId};

/// A step of a plan; name, arity and types fit the domain.
#[derive(Clone, Debug)]
pub struct PlanStep {
    /// Which action.
    pub action: ActionId,
    /// Its arguments.
    pub arguments: Vec<ObjectId>,
    /// Where it stands.
    pub span: Span,
}

/// A sequential plan.
#[derive(Clone, Debug, Default)]
pub struct Plan {
    /// The steps in order.
    pub steps: Vec<PlanStep>,
}
