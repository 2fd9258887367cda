//! Names of the file as names of ours, each once.
//!
//! Problem: every vocabulary has tokens of its own, and what is one name in the file may be two of ours or the other
//! way round. Idea: whoever asks first gets the name; the next gets it with a number, and a note. Cost: a look-up per
//! name, since it is remembered how far the numbers of a name have come.

use std::collections::BTreeMap;

/// The names of one sort that are taken.
pub(super) struct Names {
    /// What these are names of, for notes.
    what: &'static str,
    /// The next number to try behind each.
    taken: BTreeMap<String, usize>,
    /// How many of them every graph has.
    own: Vec<String>,
}

impl Names {
    /// With the names that every graph has.
    pub(super) fn new(what: &'static str, own: impl IntoIterator<Item = impl ToString>) -> Self {
        let own: Vec<_> = own.into_iter().map(|name| name.to_string()).collect();
        Self { what, taken: own.iter().map(|name| (name.clone(), 2)).collect(), own }
    }

    /// The name if it is free, else one like it.
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
