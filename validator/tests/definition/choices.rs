//! Choices out of a string of bytes.
//!
//! Random tasks are made by choosing among forms; the bytes say what is chosen, so that proptest can shrink a task by
//! shrinking the bytes. When they are used up, the first form is chosen: every generator's first form is a leaf.

/// The bytes that are left.
pub struct Choices<'a>(std::slice::Iter<'a, u8>);

impl<'a> Choices<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self(bytes.iter())
    }

    /// A number below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        self.0.next().map_or(0, |&byte| usize::from(byte) % count.max(1))
    }

    /// So in one of `count` cases; never when the bytes are used up.
    pub fn one_in(&mut self, count: usize) -> bool {
        self.below(count) + 1 == count
    }

    pub fn of<'i, T>(&mut self, items: &'i [T]) -> &'i T {
        &items[self.below(items.len())]
    }
}
