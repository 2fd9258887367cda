//! Facts over classes of nodes: what may hold at some time, and what may cease to hold.

use std::collections::BTreeSet;

use pddl::model::Name;

use super::classes::{ClassId, Classes};

/// A token over classes. That a fluent has a value is a fact with the value as its last argument.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::check) struct Fact {
    pub(in crate::check) symbol: Name,
    pub(in crate::check) arguments: Vec<ClassId>,
    /// Whether the last argument is the value of a fluent.
    pub(in crate::check) valued: bool,
}

impl Fact {
    /// As PDDL, with the first node of each class.
    pub(in crate::check) fn text(&self, classes: &Classes) -> String {
        let names: Vec<&str> = self.arguments.iter().map(|&c| classes.name(c).as_str()).collect();
        match names.split_last().filter(|_| self.valued) {
            Some((value, arguments)) => format!("(= {} {value})", list(&self.symbol, arguments)),
            None => list(&self.symbol, &names),
        }
    }

    /// The fluent without its value; a predicate's fact is itself.
    pub(super) fn holder(&self) -> Self {
        let mut holder = self.clone();
        if self.valued {
            holder.arguments.pop();
            holder.valued = false;
        }
        holder
    }
}

/// `(symbol argument …)`
pub(in crate::check) fn list(symbol: &str, arguments: &[&str]) -> String {
    let mut words = vec![symbol];
    words.extend(arguments);
    format!("({})", words.join(" "))
}

/// Facts that may hold, and those that may cease to hold (fluents by their holders).
#[derive(Clone, Debug, Default)]
pub(in crate::check) struct Facts {
    pub(in crate::check) true_: BTreeSet<Fact>,
    pub(in crate::check) false_: BTreeSet<Fact>,
}

impl Facts {
    pub(super) fn len(&self) -> usize {
        self.true_.len() + self.false_.len()
    }

    pub(super) fn extend(&mut self, other: &Self) {
        self.true_.extend(other.true_.iter().cloned());
        self.false_.extend(other.false_.iter().cloned());
    }

    pub(in crate::check) fn may_hold(&self, fact: &Fact) -> bool {
        self.true_.contains(fact)
    }

    /// Whether something takes the fact away, or the value of the fluent.
    pub(in crate::check) fn may_cease(&self, fact: &Fact) -> bool {
        self.false_.contains(&fact.holder())
    }
}
