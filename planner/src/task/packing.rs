//! Packs states into finite-domain variables, to store them.
//!
//! Problem: with one bit per fact, a lorry that may be in a thousand places takes a thousand bits
//! of every stored state. Idea: for each variable, store only the number of its value, in as many
//! bits as necessary; a variable with a single fact keeps its bit. A reader of a stored state
//! unpacks it. Invariant: packing and unpacking returns the same words if at most one fact of each
//! variable holds; the search checks this for its first state. Cost: a step for each variable and
//! each fact that holds, so packing is used only if it makes states much smaller.
//!
//! Source: Edelkamp & Helmert, "Exhibiting knowledge in planning problems to minimize state encoding
//! length", ECP 1999.

use super::{Variable, for_each_set, set};
use crate::ids::{FactId, id32};
use pddl::model::Idx;

/// The factor by which packing must reduce the size of a state.
const WORTH: usize = 3;

/// The bits of a variable with several facts.
#[derive(Clone, Debug)]
struct Field {
    word: u32,
    shift: u32,
    mask: u64,
    /// The position of its first value in `values`.
    first: u32,
}

/// The positions of facts in a packed state.
#[derive(Clone, Debug)]
pub(crate) struct Packing {
    /// By fact: its word, and the bits that it sets in the word.
    places: Vec<(u32, u64)>,
    fields: Vec<Field>,
    /// The facts of all fields, field after field.
    values: Vec<FactId>,
    /// The first word in which each bit is a fact, and these facts.
    singles_from: usize,
    singles: Vec<FactId>,
    /// The number of words of facts, unpacked and packed.
    unpacked: usize,
    packed: usize,
}

impl Packing {
    /// Packing for states with this many facts; `None` if it does not make states much smaller.
    /// Facts without a variable (derived ones) keep their bit.
    pub(crate) fn new(facts: usize, variables: &[Variable]) -> Option<Self> {
        let mut packing = Self {
            places: vec![(u32::MAX, 0); facts],
            fields: Vec::new(),
            values: Vec::new(),
            singles_from: 0,
            singles: Vec::new(),
            unpacked: facts.div_ceil(64),
            packed: 0,
        };
        let (mut word, mut used) = (0_u32, 0_u32);
        for variable in variables.iter().filter(|v| v.facts.len() > 1) {
            let bits = usize::BITS - variable.facts.len().leading_zeros();
            if used + bits > 64 {
                (word, used) = (word + 1, 0);
            }
            packing.fields.push(Field {
                word,
                shift: used,
                mask: (1 << bits) - 1,
                first: id32(packing.values.len()),
            });
            for (value, fact) in (1_u64..).zip(&variable.facts) {
                packing.places[fact.index()] = (word, value << used);
            }
            packing.values.extend_from_slice(&variable.facts);
            used += bits;
        }
        packing.singles_from = word as usize + usize::from(used > 0);
        for fact in (0..facts).filter(|&f| packing.places[f].0 == u32::MAX).collect::<Vec<_>>() {
            let at = packing.singles.len();
            packing.places[fact] = (id32(packing.singles_from + at / 64), 1 << (at % 64));
            packing.singles.push(FactId::from_index(fact));
        }
        packing.packed = packing.singles_from + packing.singles.len().div_ceil(64);
        (packing.packed * WORTH <= packing.unpacked).then_some(packing)
    }

    /// The number of words of a packed state whose unpacked form has `words` words.
    pub(crate) fn width(&self, words: usize) -> usize {
        self.packed + (words - self.unpacked)
    }

    /// Packs a state; the words after the facts are copied.
    pub(crate) fn pack(&self, words: &[u64], packed: &mut [u64]) {
        let (facts, more) = words.split_at(self.unpacked);
        packed[..self.packed].fill(0);
        for_each_set(facts, |fact| {
            let (word, bits) = self.places[fact as usize];
            packed[word as usize] |= bits;
        });
        packed[self.packed..].copy_from_slice(more);
    }

    /// Unpacks a state.
    pub(crate) fn unpack(&self, packed: &[u64], words: &mut [u64]) {
        let (facts, more) = words.split_at_mut(self.unpacked);
        facts.fill(0);
        for field in &self.fields {
            let value = packed[field.word as usize] >> field.shift & field.mask;
            if value > 0 {
                set(facts, self.values[field.first as usize + low(value) - 1]);
            }
        }
        for_each_set(&packed[self.singles_from..self.packed], |i| set(facts, self.singles[i as usize]));
        more.copy_from_slice(&packed[self.packed..]);
    }
}

/// A value's number: fields are narrower than 32 bits.
#[expect(clippy::cast_possible_truncation, reason = "fields are narrower than 32 bits")]
fn low(value: u64) -> usize {
    value as u32 as usize
}

#[cfg(test)]
mod tests {
    use crate::{GroundOptions, ground};

    #[test]
    fn states_of_few_variables_are_packed_and_come_back() {
        let places: String = (0..300).map(|i| format!(" p{i}")).collect();
        let domain = "(define (domain d) (:predicates (at ?x ?y) (van ?x) (place ?y) (seen))
           (:action go :parameters (?x ?a ?b) :precondition (and (van ?x) (at ?x ?a) (place ?b))
            :effect (and (not (at ?x ?a)) (at ?x ?b) (seen))))";
        let all: String = (0..300).map(|i| format!("(place p{i})")).collect();
        let problem = format!(
            "(define (problem p) (:domain d) (:objects v w{places})
             (:init (van v) (van w) (at v p0) (at w p299) {all}) (:goal (and (at v p7) (at w p8) (seen))))"
        );
        let domain = pddl::parse_domain(&pddl::Source::new("d", domain), &[]).model.expect("correct");
        let problem = pddl::parse_problem(&pddl::Source::new("p", problem), &domain).model.expect("correct");
        let task = ground(&domain, &problem, &GroundOptions::default()).expect("small");
        let packing = task.packing.as_ref().expect("601 facts, two variables of 300 values and one of 1");
        assert_eq!((packing.unpacked, packing.packed), (10, 2));
        let mut states = vec![task.initial_state().clone()];
        for i in 0..50 {
            let operators = task.applicable(&states[i]);
            let next = task.successor(&states[i], operators[i * 7 % operators.len()]);
            states.push(next.expect("it is applicable"));
        }
        let (mut packed, mut again) = (vec![0; 2], vec![0; 10]);
        for state in states {
            packing.pack(state.words(), &mut packed);
            packing.unpack(&packed, &mut again);
            assert_eq!(again, state.words());
        }
    }
}
