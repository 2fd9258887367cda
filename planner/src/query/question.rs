//! A query: initial state, goal and excluded operators.

use crate::ids::OperatorId;
use crate::task::{Goal, State, Task};

/// A planning query on a grounded task.
#[derive(Clone, Copy, Debug)]
pub struct Query<'a> {
    /// The state in which the plan starts.
    pub state: &'a State,
    /// The goal that the plan must reach.
    pub goal: &'a Goal,
    /// Operators that the plan must not use (for example, those that have just failed).
    pub excluded: &'a [OperatorId],
}

impl<'a> Query<'a> {
    /// The problem's own query.
    pub fn of(task: &'a Task) -> Self {
        Self { state: task.initial_state(), goal: task.goal(), excluded: &[] }
    }

    pub(crate) fn barred(&self, task: &Task) -> Barred {
        if self.excluded.is_empty() {
            return Barred { words: Vec::new() };
        }
        let mut words = vec![0_u64; task.operators.len().div_ceil(64)];
        for operator in self.excluded {
            words[operator.0 as usize / 64] |= 1 << (operator.0 % 64);
        }
        Barred { words }
    }
}

/// The excluded operators as a bit set; empty if no operator is excluded.
pub(crate) struct Barred {
    words: Vec<u64>,
}

impl Barred {
    pub(crate) fn is_empty(&self) -> bool {
        self.words.is_empty()
    }

    pub(crate) fn contains_number(&self, operator: u32) -> bool {
        !self.words.is_empty() && self.words[operator as usize / 64] >> (operator % 64) & 1 == 1
    }

    /// Removes the excluded operators from a list.
    pub(crate) fn filter(&self, operators: &mut Vec<OperatorId>) {
        if !self.words.is_empty() {
            operators.retain(|o| !self.contains_number(o.0));
        }
    }
}
