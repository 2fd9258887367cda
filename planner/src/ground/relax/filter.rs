//! Tests on bound variables.

use crate::number::Relation;
use pddl::model::{Expression, ExpressionKind, Extent, PredicateId, Term};
use std::sync::Arc;

/// A test on bound variables.
#[derive(Clone, Debug)]
pub(crate) enum Filter {
    Same {
        positive: bool,
        left: Term,
        right: Term,
    },
    /// The object must be, or must not be, in a range.
    OneOf {
        positive: bool,
        term: Term,
        extent: Arc<Extent>,
    },
    /// A static atom that must not hold.
    Absent {
        predicate: PredicateId,
        arguments: Box<[Term]>,
    },
    /// The relation of `left - right` to 0, if no action changes either.
    Compare {
        relation: Relation,
        left: Arc<Expression>,
        right: Arc<Expression>,
    },
}

impl Filter {
    pub(super) fn is_bound(&self, bound: &[bool]) -> bool {
        match self {
            Self::Same { left, right, .. } => is_bound(*left, bound) && is_bound(*right, bound),
            Self::OneOf { term, .. } => is_bound(*term, bound),
            Self::Absent { arguments, .. } => arguments.iter().all(|&t| is_bound(t, bound)),
            Self::Compare { left, right, .. } => {
                let mut all = true;
                for side in [left, right] {
                    side.each(&mut |part| {
                        if let ExpressionKind::Fluent(application) = &part.kind {
                            all &= application.arguments.iter().all(|&t| is_bound(t, bound));
                        }
                    });
                }
                all
            }
        }
    }
}

pub(super) fn is_bound(term: Term, bound: &[bool]) -> bool {
    match term {
        Term::Variable(v) => bound[v.0 as usize],
        Term::Object(_) => true,
    }
}
