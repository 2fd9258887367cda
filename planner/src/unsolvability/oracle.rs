//! The oracle decides which literals may ever hold.
//!
//! Idea: grounding has reached every atom that is true in some state if deletes are ignored, and it knows the atoms
//! that nothing deletes. One more exploration of the grounded relaxation from the query's state rules out more.
//! Invariant: the oracle never denies a literal that holds in a reachable state.

use crate::heuristics::{Combine, Costs, Explorer};
use crate::ids::{FactId, OperatorId, id32};
use crate::search::{Bound, Job, Query, SearchMeter, Shared};
use crate::task::{AtomStatus, Literals, LiteralsRef, Task};
use analysis::intervals::Reachable;
use analysis::{Instance, Literal};
use budget::Budget;
use pddl::model::{ActionId, EffectKind, Idx, Name, ObjectId, PredicateId};

pub(super) struct Oracle<'a> {
    pub(super) instance: Instance<'a>,
    pub(super) task: &'a Task,
    /// The state in which the query starts, and the operators that it excludes.
    pub(super) query: Query<'a>,
    /// By predicate: the atoms that may hold.
    possible: Vec<Vec<u32>>,
    /// By predicate: whether no action and no axiom changes it.
    is_static: Vec<bool>,
    /// By fact: whether it may become false.
    may_fail: Vec<bool>,
    /// The excluded operators whose preconditions may all hold.
    may_apply: Vec<OperatorId>,
}

impl<'a> Oracle<'a> {
    /// `never` lists operators that provably never apply.
    pub(super) fn new(
        instance: Instance<'a>,
        task: &'a Task,
        query: Query<'a>,
        never: &[OperatorId],
    ) -> Self {
        let domain = instance.domain;
        let excluded = [query.excluded, never].concat();
        let without = Query { excluded: &excluded, ..query };
        let (barred, meter) = (without.barred(task), SearchMeter::new(Budget::default()));
        let (bound, shared) = (Bound::none(), Shared::default());
        let (state, goal) = (query.state, query.goal);
        let job = Job { task, state, goal, barred: &barred, meter: &meter, bound: &bound, shared: &shared };
        let mut explorer = Explorer::new(&job, Vec::new(), Costs::Unit, Combine::Max);
        explorer.explore(query.state.words());
        let reached = |p: u32| explorer.cost(p) != u32::MAX;
        let predicates = (0..task.atoms.len()).map(|a| task.atoms.predicate(id32(a)).index() + 1).max();
        let mut possible = vec![Vec::new(); predicates.unwrap_or(0).max(domain.predicates.len())];
        for atom in 0..id32(task.atoms.len()) {
            let may_hold = match task.status[atom as usize] {
                AtomStatus::NeverTrue => false,
                AtomStatus::Fact(fact) => reached(fact.0),
                AtomStatus::AlwaysTrue | AtomStatus::Irrelevant => true,
            };
            if may_hold {
                possible[task.atoms.predicate(atom).index()].push(atom);
            }
        }
        let may_fail = |fact: FactId| {
            let negated = Literals { negative: Box::new([fact]), ..Literals::default() };
            task.relaxation.literals(&negated).into_iter().all(reached)
        };
        let may_fail = task.facts().ids().map(may_fail).collect();
        let may_apply = |operator: &OperatorId| {
            let LiteralsRef { positive, negative } = task.operator(*operator).precondition;
            let needed = Literals { positive: positive.into(), negative: negative.into() };
            !never.contains(operator) && task.relaxation.literals(&needed).into_iter().all(reached)
        };
        let may_apply = query.excluded.iter().copied().filter(may_apply).collect();
        let mut is_static = vec![true; domain.predicates.len()];
        for action in &domain.actions {
            action.effect.each(&mut |part| {
                if let EffectKind::Add(atom) | EffectKind::Delete(atom) = &part.kind {
                    is_static[atom.predicate.index()] = false;
                }
            });
        }
        domain.axioms.iter().for_each(|axiom| is_static[axiom.predicate.index()] = false);
        Self { instance, task, query, possible, is_static, may_fail, may_apply }
    }

    /// The arguments of the atoms that may hold and match `wanted`.
    pub(super) fn matches<'s>(&'s self, wanted: &'s Literal) -> impl Iterator<Item = &'s [u32]> {
        let atoms = self.possible.get(wanted.pattern.predicate.index()).map_or(&[][..], Vec::as_slice);
        atoms.iter().map(|&atom| self.task.atoms.row(atom)).filter(|row| fits(wanted, row))
    }

    /// The operators of an action that the query excludes and whose arguments match, with these arguments.
    pub(super) fn excluded<'s>(
        &'s self,
        action: ActionId,
        wanted: &'s [Result<ObjectId, Name>],
    ) -> impl Iterator<Item = (OperatorId, &'s [ObjectId])> {
        let operators = self.query.excluded.iter().map(|&id| (id, self.task.operator(id)));
        let fits = move |own: &[ObjectId]| {
            own.iter().zip(wanted).all(|(own, wanted)| wanted.as_ref().map_or(true, |wanted| wanted == own))
        };
        operators
            .filter(move |(_, o)| o.action == action && fits(o.arguments))
            .map(|(id, o)| (id, o.arguments))
    }

    /// Whether each literal that an excluded operator needs may hold in some reachable state; `false` is a proof.
    pub(super) fn may_apply(&self, excluded: OperatorId) -> bool {
        self.may_apply.contains(&excluded)
    }

    /// Whether no action and no axiom changes atoms of the predicate.
    pub(super) fn is_static(&self, predicate: PredicateId) -> bool {
        self.is_static.get(predicate.index()).copied().unwrap_or(false)
    }
}

impl Reachable for Oracle<'_> {
    fn may_hold(&self, wanted: &Literal) -> bool {
        if wanted.positive {
            return self.matches(wanted).next().is_some();
        }
        let arguments: Result<Vec<ObjectId>, _> = wanted.pattern.arguments.iter().cloned().collect();
        let Ok(arguments) = arguments else { return true };
        match self.task.status(wanted.pattern.predicate, &arguments) {
            AtomStatus::AlwaysTrue => false,
            AtomStatus::Fact(fact) => self.may_fail[fact.index()],
            AtomStatus::NeverTrue | AtomStatus::Irrelevant => true,
        }
    }
}

/// Whether a row matches the pattern: equal variables must have equal objects.
fn fits(wanted: &Literal, row: &[u32]) -> bool {
    let arguments = &wanted.pattern.arguments;
    arguments.iter().zip(row).enumerate().all(|(i, (argument, &object))| match argument {
        Ok(own) => own.0 == object,
        Err(name) => {
            let first = arguments[..i].iter().position(|other| other.as_ref() == Err(name));
            first.is_none_or(|first| row[first] == object)
        }
    })
}
