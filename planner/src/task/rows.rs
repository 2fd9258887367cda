//! Rows of numbers in one vector, and their transposition.
//!
//! Problem: a million operators with a few vectors each need millions of allocations, which take
//! longer to make and to free than to use. Idea: one vector holds all rows, another the start of
//! each row. Invariant: rows do not change once they are pushed. Cost: four bytes an item and a
//! row.

use crate::ids::id32;
use budget::{Interrupted, Meter};

/// Rows of `u32` in one vector.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rows {
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Rows {
    /// This many rows without items.
    pub(crate) fn empty(rows: usize) -> Self {
        Self { starts: vec![0; rows + 1], items: Vec::new() }
    }

    pub(crate) fn push(&mut self, row: impl IntoIterator<Item = u32>) {
        self.begin();
        self.items.extend(row);
        self.starts.push(id32(self.items.len()));
    }

    /// Adds a row: sorted, without duplicates.
    pub(crate) fn push_sorted(&mut self, row: impl IntoIterator<Item = u32>) {
        self.begin();
        let start = self.items.len();
        self.items.extend(row);
        self.items[start..].sort_unstable();
        let mut kept = start;
        for i in start..self.items.len() {
            if i == start || self.items[i] != self.items[kept - 1] {
                self.items[kept] = self.items[i];
                kept += 1;
            }
        }
        self.items.truncate(kept);
        self.starts.push(id32(kept));
    }

    fn begin(&mut self) {
        if self.starts.is_empty() {
            self.starts.push(0);
        }
    }

    pub(crate) fn row(&self, i: u32) -> &[u32] {
        &self.items[self.range(i)]
    }

    /// The positions of a row's items among all items.
    pub(crate) fn range(&self, i: u32) -> std::ops::Range<usize> {
        self.starts[i as usize] as usize..self.starts[i as usize + 1] as usize
    }

    /// The item at a position among all items.
    pub(crate) fn item(&self, position: usize) -> u32 {
        self.items[position]
    }

    /// The bytes that they hold.
    pub(crate) fn memory_bytes(&self) -> usize {
        (self.starts.capacity() + self.items.capacity()) * size_of::<u32>()
    }

    /// The number of items in all rows.
    pub(crate) fn items(&self) -> usize {
        self.items.len()
    }

    pub(crate) fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// For each of `n` items: the rows that contain it, in order.
    pub(crate) fn transposed(&self, n: usize, meter: &Meter<'_>) -> Result<Self, Interrupted> {
        self.transposed_in(0..id32(self.len()), n, meter)
    }

    /// For each of `n` items: the rows that contain it, in the given order of rows.
    pub(crate) fn transposed_in(
        &self,
        order: impl Iterator<Item = u32>,
        n: usize,
        meter: &Meter<'_>,
    ) -> Result<Self, Interrupted> {
        let mut starts = vec![0_u32; n + 1];
        for part in meter.chunks(&self.items, 2) {
            part?.iter().for_each(|&item| starts[item as usize + 1] += 1);
        }
        for i in 0..n {
            starts[i + 1] += starts[i];
        }
        meter.spend(n)?;
        let mut fill = starts.clone();
        let mut items = vec![0; self.items.len()];
        for row in order {
            let own = self.row(row);
            meter.spend(4 + 8 * own.len())?;
            for &item in own {
                items[fill[item as usize] as usize] = row;
                fill[item as usize] += 1;
            }
        }
        Ok(Self { starts, items })
    }
}

#[cfg(test)]
mod tests {
    use super::Rows;
    use budget::Meter;

    #[test]
    fn rows_are_transposed_in_any_order() {
        let mut rows = Rows::default();
        rows.push_sorted([3, 1, 3, 1]);
        rows.push([]);
        rows.push_sorted([2, 1]);
        assert_eq!((rows.row(0), rows.row(1), rows.row(2)), (&[1, 3][..], &[][..], &[1, 2][..]));
        let meter = Meter::default();
        let by_item = rows.transposed(4, &meter).unwrap();
        assert_eq!((by_item.row(0), by_item.row(1), by_item.row(3)), (&[][..], &[0, 2][..], &[0][..]));
        let reversed = rows.transposed_in([2, 1, 0].into_iter(), 4, &meter).unwrap();
        assert_eq!(reversed.row(1), &[2, 0]);
    }
}
