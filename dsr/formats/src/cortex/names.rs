//! Names of the file as unique names of the graph.
//!
//! Problem: every vocabulary has tokens of its own, and one name in the file may become two of ours, or the reverse.
//! Idea: the first use gets the name; later ones get it with a number, and a note. Cost: one look-up per name, since
//! the next free number of each name is kept.

use std::collections::BTreeMap;

/// The names of one kind that are taken.
pub(super) struct Names {
    /// The kind, for notes.
    what: &'static str,
    /// For each taken name, the next number to try after it.
    taken: BTreeMap<String, usize>,
    /// The names that every graph has.
    own: Vec<String>,
}

impl Names {
    /// Begins with the names that every graph has.
    pub(super) fn new(what: &'static str, own: impl IntoIterator<Item = impl ToString>) -> Self {
        let own: Vec<_> = own.into_iter().map(|name| name.to_string()).collect();
        Self { what, taken: own.iter().map(|name| (name.clone(), 2)).collect(), own }
    }

    /// The wanted name if it is free, or else a similar one.
    pub(super) fn give(&mut self, wanted: &str, notes: &mut Vec<String>) -> String {
        let is_own = wanted.is_empty() || self.own.iter().any(|own| own == wanted);
        let base = if is_own { format!("cortex_{wanted}") } else { wanted.to_owned() };
        let mut given = base.clone();
        while self.taken.contains_key(&given) {
            let number = self.taken.entry(base.clone()).or_insert(2);
            given = format!("{base}_{number}");
            *number += 1;
        }
        self.taken.insert(given.clone(), 2);
        if given != wanted {
            let why = match wanted {
                "" => "a name is not empty",
                _ if is_own => "every graph has that name",
                _ => "the name is taken",
            };
            notes.push(format!("{} `{wanted}`: called `{given}`, {why}", self.what));
        }
        given
    }
}
