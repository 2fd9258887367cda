//! Converts groups of atoms that exclude each other to groups of facts.

use super::view::NONE;
use crate::ground::exclusion::Exclusions;
use budget::{Interrupted, Meter};

/// The groups with at least two atoms that are facts.
pub(super) fn groups(
    exclusions: &Exclusions,
    numbers: &[u32],
    known: u32,
    meter: &Meter<'_>,
) -> Result<Vec<Vec<u32>>, Interrupted> {
    let mut groups: Vec<Vec<u32>> = vec![Vec::new(); exclusions.len()];
    for atom in (0..known).filter(|&a| numbers[a as usize] != NONE) {
        meter.spend(8 + 16 * exclusions.of(atom).len())?;
        for &group in exclusions.of(atom) {
            groups[group as usize].push(numbers[atom as usize]);
        }
    }
    // Different groups of atoms may become the same group of facts. The result is sorted by first
    // fact.
    let mut by_first: Vec<Vec<Vec<u32>>> = vec![Vec::new(); numbers.len()];
    for group in groups.into_iter().filter(|g| g.len() > 1) {
        meter.spend(32)?;
        by_first[group[0] as usize].push(group);
    }
    let mut sorted = Vec::new();
    for mut group in by_first {
        meter.spend(4 + 256 * group.len())?;
        group.sort_unstable();
        group.dedup();
        sorted.append(&mut group);
    }
    Ok(sorted)
}
