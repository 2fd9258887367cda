//! Two campaigns beside each other: which runs end otherwise than before.
//!
//! Runs are compared by disruption, instant and seed. If the undisturbed runs differ, an instant of one has no counterpart
//! in the other; then the counts of each disruption are compared.

use super::record::{Outcome, Run};
use super::store::Kept;
use super::table::rows;
use crate::console::Console;
use std::collections::{BTreeMap, BTreeSet};

/// Writes what changed from the old campaign to the new one. Returns whether a good run became a bad one.
pub(super) fn show(old: &Kept, new: &Kept, console: &mut Console<'_>) -> bool {
    if old.instants == new.instants { by_run(old, new, console) } else { by_count(old, new, console) }
}

/// How a run ended, for a comparison.
type Ending = (Outcome, bool);

fn by_run(old: &Kept, new: &Kept, console: &mut Console<'_>) -> bool {
    let before: BTreeMap<_, &Run> = old.runs.iter().map(|run| (&run.key, run)).collect();
    let ending = |run: &Run| -> Ending { (run.outcome, !run.broken.is_empty()) };
    let mut changes: BTreeMap<(&str, Ending, Ending), usize> = BTreeMap::new();
    let (mut compared, mut worse) = (0_usize, 0_usize);
    for run in &new.runs {
        let Some(was) = before.get(&run.key) else { continue };
        compared += 1;
        worse += usize::from(was.is_good() && !run.is_good());
        if ending(was) != ending(run) {
            *changes.entry((&run.key.disruption, ending(was), ending(run))).or_default() += 1;
        }
    }
    for ((disruption, from, to), count) in &changes {
        console.result(&format!("{disruption}: {count} runs, {} → {}", words(*from), words(*to)));
    }
    let changed: usize = changes.values().sum();
    console.result(&format!(
        "{compared} runs compared: {changed} end otherwise, {worse} of them were good and are not"
    ));
    worse > 0
}

fn by_count(old: &Kept, new: &Kept, console: &mut Console<'_>) -> bool {
    console.result("the undisturbed runs differ, so that counts are compared");
    let (before, after) = (rows(&old.runs), rows(&new.runs));
    let mut worse = false;
    let names: BTreeSet<&str> = before.keys().chain(after.keys()).copied().collect();
    for name in names {
        let (Some(was), Some(is)) = (before.get(name), after.get(name)) else {
            let which = if before.contains_key(name) { "old" } else { "new" };
            console.result(&format!("{name}: only in the {which} campaign"));
            continue;
        };
        let share = |count: usize, of: usize| format!("{count}/{of}");
        for outcome in Outcome::ALL.into_iter().filter(|&o| was.of(o) + is.of(o) > 0) {
            // Shares are compared crosswise, since the campaigns have different numbers of runs.
            if was.of(outcome) * is.runs() != is.of(outcome) * was.runs() {
                let (was, is) = (share(was.of(outcome), was.runs()), share(is.of(outcome), is.runs()));
                console.result(&format!("{name}: {} {was} → {is}", outcome.name()));
            }
        }
        if was.broken * is.runs() != is.broken * was.runs() {
            let (was, is) = (share(was.broken, was.runs()), share(is.broken, is.runs()));
            console.result(&format!("{name}: invariants broken {was} → {is}"));
        }
        worse |= is.broken * was.runs() > was.broken * is.runs();
    }
    worse
}

fn words((outcome, broken): Ending) -> String {
    format!("{}{}", outcome.name(), if broken { " with a broken invariant" } else { "" })
}
