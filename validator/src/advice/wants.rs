//! What a failure lacks: atoms that should or should not hold, fluents that should have another value.
//!
//! No step adds a derived atom, so it is replaced by the unsatisfied parts of its axioms.

use crate::cause::{Cause, Causes};
use crate::prepared::Prepared;
use crate::scene::{Binding, Clock};
use crate::state::State;
use crate::value::GroundAtom;
use crate::verdict::{Failure, Operand, Unsatisfied};
use crate::why::Why;
use pddl::model::GroundApplication;

/// How deep wants are followed through axioms.
const DEPTH: usize = 4;

/// The most wants.
const MOST: usize = 64;

/// Something that a change should bring about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Want {
    /// An atom should hold.
    Holds(GroundAtom),
    /// An atom should not hold.
    HoldsNot(GroundAtom),
    /// A fluent should have another value.
    Another(GroundApplication),
}

/// The wants of a failure, and the causes of the failure.
#[derive(Clone, Debug, Default)]
pub(super) struct Wants {
    pub(super) list: Vec<Want>,
    pub(super) blamed: Vec<Cause>,
}

impl Wants {
    /// The wants of a failure. `state` is the state of the failure with its derived atoms.
    pub(super) fn of(prepared: &Prepared<'_>, state: &State, failure: &Failure) -> Self {
        let mut wants = Self::default();
        match failure {
            Failure::Duration { bound, .. } => wants.operand(bound),
            _ => wants.parts(prepared, state, failure.parts(), DEPTH),
        }
        wants
    }

    fn push(&mut self, want: Want) {
        if self.list.len() < MOST && !self.list.contains(&want) {
            self.list.push(want);
        }
    }

    fn operand(&mut self, operand: &Operand) {
        for (fluent, _) in &operand.fluents {
            self.push(Want::Another(fluent.clone()));
        }
    }

    fn parts(&mut self, prepared: &Prepared<'_>, state: &State, parts: &[Unsatisfied], depth: usize) {
        Unsatisfied::each(parts, &mut |part| match part {
            Unsatisfied::Missing { atom, derived: true, .. } => {
                self.derived(prepared, state, atom, true, depth);
            }
            Unsatisfied::Present { atom, derived: true, .. } => {
                self.derived(prepared, state, atom, false, depth);
            }
            Unsatisfied::Missing { atom, deleted_by, .. } => {
                self.push(Want::Holds(atom.clone()));
                self.blamed.extend(*deleted_by);
            }
            Unsatisfied::Present { atom, added_by, .. } => {
                self.push(Want::HoldsNot(atom.clone()));
                self.blamed.extend(*added_by);
            }
            Unsatisfied::Comparison { left, right, .. } => {
                self.operand(left);
                self.operand(right);
            }
            Unsatisfied::Fluent { fluent, .. } => self.push(Want::Another(fluent.clone())),
            _ => {}
        });
    }

    fn derived(
        &mut self,
        prepared: &Prepared<'_>,
        state: &State,
        atom: &GroundAtom,
        wanted: bool,
        depth: usize,
    ) {
        let Some(depth) = depth.checked_sub(1) else { return };
        for axiom in prepared.domain.axioms.iter().filter(|axiom| axiom.predicate == atom.predicate) {
            if prepared.fits(&axiom.variables, &atom.arguments).is_err() {
                continue;
            }
            let scene = prepared.scene(state, &axiom.variables, Clock::steps(0));
            let why = Why { depth: 0, ..prepared.why(scene, Causes::Listed(&[])) };
            let mut binding = Binding::new(&axiom.variables, &atom.arguments);
            let parts = why.unsatisfied(&axiom.body, wanted, &mut binding);
            self.parts(prepared, state, &parts, depth);
        }
    }
}
