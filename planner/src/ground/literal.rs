//! Ground literals over the atoms of the table.

/// A ground literal: `atom << 1 | negated`.
pub(crate) type Lit = u32;

/// Sorts without duplicates; `None` if the literals contain a literal and its negation.
pub(crate) fn consistent(mut literals: Vec<Lit>) -> Option<Vec<Lit>> {
    literals.sort_unstable();
    literals.dedup();
    (!literals.windows(2).any(|w| w[0] ^ 1 == w[1])).then_some(literals)
}
