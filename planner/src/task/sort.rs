//! Counting sort.

use budget::{Interrupted, Meter};

/// Sorts by small keys, stably, in one counting pass.
pub(crate) fn sort_by_count(
    items: &[u32],
    keys: usize,
    meter: &Meter<'_>,
    key: impl Fn(u32) -> usize,
) -> Result<Vec<u32>, Interrupted> {
    let mut at = vec![0_usize; keys + 1];
    for chunk in meter.chunks(items, 4) {
        chunk?.iter().for_each(|&i| at[key(i) + 1] += 1);
    }
    for k in 0..keys {
        at[k + 1] += at[k];
    }
    meter.spend(keys)?;
    let mut sorted = vec![0; items.len()];
    for chunk in meter.chunks(items, 8) {
        for &i in chunk? {
            let place = &mut at[key(i)];
            sorted[*place] = i;
            *place += 1;
        }
    }
    Ok(sorted)
}

#[cfg(test)]
mod tests {
    use super::sort_by_count;
    use budget::Meter;

    #[test]
    fn sorting_by_count_is_stable() {
        let items: Vec<u32> = (0..20_000).rev().collect();
        let sorted = sort_by_count(&items, 7, &Meter::default(), |i| i as usize % 7).unwrap();
        assert!(sorted.windows(2).all(|w| (w[0] % 7, u32::MAX - w[0]) < (w[1] % 7, u32::MAX - w[1])));
    }
}
