//! Why something never fires: from what it needs, along the rules that could make that true, to the root.
//!
//! Problem: "can never apply" is of no use without the reason, and a single mistake silences everything behind it. Idea:
//! among the atoms and checks of a rule, find a smallest part that no binding satisfies. If it is one atom, ask the rules
//! that could make it true, with the values that it gives them; if there are none, that atom is the root. Cost: a join
//! for each atom and each step of the chain, each with a budget, and one budget for all. Where a budget ends, the chain
//! ends with what is known.
//!
//! Source: minimal unsatisfiable parts by deletion: Chinneck & Dravnieks, "Locating minimal
//! infeasible constraint sets in linear programs", ORSA Journal on Computing 1991.

use std::rc::Rc;

use pddl::model::{Condition, ExpressionKind, ObjectId, Term, TypeSet, VariableId};

use budget::Meter;

use super::compile::{Compiled, goal_rules, goals};
use super::database::{RelationId, Rows};
use super::fixpoint::Reachability;
use super::join::{Join, Sink, plan, unify};
use super::rule::{Check, Origin, Pattern, Rule};
use super::world::{UNBOUND, resolve};
use crate::happening::{Phase, Schema};
use crate::intervals::Hulls;

/// Join steps for one question.
const STEPS: u64 = 300_000;
/// Join steps for all questions together.
const REASONS: u64 = 3_000_000;
/// Links of a chain.
const DEPTH: usize = 8;
/// Makers that are followed at each link.
const WIDTH: usize = 6;

/// Part of a condition, with the values that are known.
#[derive(Clone, Debug)]
pub(super) enum Piece {
    /// An atom.
    Atom(Pattern, Rc<[u32]>),
    /// A side condition.
    Check(Check, Rc<[u32]>),
}

/// Why a rule does not fire.
#[derive(Clone, Debug)]
pub(super) enum Cause {
    /// There is no object for a parameter.
    NoObject(TypeSet),
    /// No initial fact is like it, and no effect could make one.
    NothingMakes(Piece),
    /// Only these could make it true, and they do not; the next link says why of the first.
    OnlyMadeBy(Piece, Vec<Origin>),
    /// Only these could make it true, and they need it themselves.
    Circle(Piece, Vec<Origin>),
    /// Each alone can hold, not all at once.
    NeverTogether(Vec<Piece>),
    /// It is false whatever happens.
    False,
    /// The search for the reason was too long.
    Unknown,
}

/// One step of the explanation.
#[derive(Clone, Debug)]
pub(super) struct Link {
    /// What does not fire.
    pub(super) origin: Origin,
    /// Why.
    pub(super) cause: Cause,
}

struct Exists(bool);

impl Sink for Exists {
    fn wanted(&mut self, _: &Rows, _: &[u32]) -> bool {
        !self.0
    }
    fn found(&mut self, _: &mut Rows, _: &[u32]) {
        self.0 = true;
    }
    fn open(&mut self, _: &[u32]) {}
}

type Trail = Vec<(RelationId, Vec<u32>)>;

/// A conjunct of the goal that can never hold.
pub(super) struct DeadGoal<'a> {
    /// The conjunct.
    pub(super) condition: &'a Condition,
    /// The objects that a `forall` around it gives to its slots.
    pub(super) values: Vec<(VariableId, ObjectId)>,
    /// Why.
    pub(super) chain: Vec<Link>,
}

/// Answers why something never fires, within one budget for all questions.
pub(super) struct Explainer<'a> {
    reachability: Reachability<'a>,
    /// Steps that questions may still take.
    left: u64,
}

impl<'a> Explainer<'a> {
    /// Of a fixpoint.
    pub(super) fn new(reachability: Reachability<'a>) -> Self {
        Self { reachability, left: REASONS }
    }

    /// The values that numeric fluents can take.
    pub(super) fn hulls(&self) -> &Hulls {
        self.reachability.hulls()
    }

    fn compiled(&self) -> &Compiled<'a> {
        &self.reachability.compiled
    }

    /// Why a part of a schema never fires.
    pub(super) fn why(&mut self, origin: &Origin) -> Vec<Link> {
        let rule = self.compiled().rules.iter().find(|r| r.origin == *origin).cloned();
        let Some(rule) = rule else {
            return vec![Link { origin: origin.clone(), cause: Cause::False }];
        };
        let given = vec![UNBOUND; rule.slots.len()];
        self.explain(&rule, &given, &mut Vec::new())
    }

    /// The conjuncts of the goal that can never hold, at most `limit` of them.
    pub(super) fn dead_goals(&mut self, limit: usize) -> Vec<DeadGoal<'a>> {
        let Some(problem) = self.compiled().evaluator.world.problem else { return Vec::new() };
        let mut dead = Vec::new();
        for (i, (condition, values)) in goals(&self.compiled().evaluator.world).into_iter().enumerate() {
            let rules = goal_rules(self.compiled(), i, condition, &problem.goal_variables);
            let mut given = vec![UNBOUND; problem.goal_variables.slots.len()];
            for (variable, object) in &values {
                given[variable.0 as usize] = object.0;
            }
            let possible = |this: &mut Self, rule: &Rule| this.satisfiable(rule, &given) != Some(false);
            if rules.iter().any(|rule| possible(self, rule)) {
                continue;
            }
            let chain = match rules.first() {
                Some(rule) => self.explain(rule, &given, &mut Vec::new()),
                None => {
                    let origin = Origin { schema: Schema::Goal(i), phase: Phase::Whole, when: None };
                    vec![Link { origin, cause: Cause::False }]
                }
            };
            dead.push(DeadGoal { condition, values, chain });
            if dead.len() == limit {
                break;
            }
        }
        dead
    }

    /// Whether some binding satisfies the rule; `None` if that takes too long.
    fn satisfiable(&mut self, rule: &Rule, given: &[u32]) -> Option<bool> {
        let Reachability { compiled: Compiled { evaluator, rows, .. }, indices, .. } = &mut self.reachability;
        let mut bound: Vec<bool> = given.iter().map(|&g| g != UNBOUND).collect();
        let changing = vec![false; rows.relations()];
        let count = |relation: RelationId| rows.count(relation);
        let steps = plan(rule, &mut bound, None, &changing, rows, indices, &count);
        let meter = Meter::of_work(STEPS.min(self.left));
        let mut sink = Exists(false);
        let join =
            &mut Join { rule, steps: &steps, rows, indices, evaluator, meter: &meter, sink: &mut sink };
        let whole = join.run(0, false, &mut given.to_vec());
        self.left = self.left.saturating_sub(meter.work());
        whole.ok()?;
        Some(sink.0)
    }

    fn explain(&mut self, rule: &Rule, given: &[u32], trail: &mut Trail) -> Vec<Link> {
        let link = |cause| vec![Link { origin: rule.origin.clone(), cause }];
        let empty = (0..rule.parameters).find(|&s| given[s] == UNBOUND && rule.slots[s].objects.is_empty());
        if let Some(slot) = empty {
            let variable = VariableId(u32::try_from(slot).expect("slots are few"));
            let types = rule
                .origin
                .schema
                .variables(self.compiled().evaluator.world.domain)
                .and_then(|v| v.slots.get(variable))
                .map_or_else(TypeSet::any, |v| v.types.clone());
            return link(Cause::NoObject(types));
        }
        let known: Rc<[u32]> = given.into();
        let mut blocked = Vec::new();
        for atom in 0..rule.body.len() {
            if self.satisfiable(&part(rule, &[atom], &[]), given) == Some(false) {
                let makers = self.makers(&rule.body[atom], given, rule);
                blocked.push((atom, makers));
            }
        }
        // What nothing makes is the root; else what comes first.
        blocked.sort_by_key(|(_, makers)| !makers.is_empty());
        if let Some((atom, makers)) = blocked.into_iter().next() {
            let pattern = &rule.body[atom];
            let piece = Piece::Atom(pattern.clone(), known);
            if makers.is_empty() {
                return link(Cause::NothingMakes(piece));
            }
            return self.follow(rule, piece, makers, given, trail);
        }
        let (mut atoms, mut checks): (Vec<usize>, Vec<usize>) =
            ((0..rule.body.len()).collect(), (0..rule.checks.len()).collect());
        if self.satisfiable(rule, given) != Some(false) {
            return link(Cause::Unknown);
        }
        // What nothing changes is kept longest: it says most.
        for drop in 0..rule.checks.len() {
            let fewer: Vec<usize> = checks.iter().copied().filter(|&c| c != drop).collect();
            if self.satisfiable(&part(rule, &atoms, &fewer), given) == Some(false) {
                checks = fewer;
            }
        }
        for drop in 0..rule.body.len() {
            let fewer: Vec<usize> = atoms.iter().copied().filter(|&a| a != drop).collect();
            if self.satisfiable(&part(rule, &fewer, &checks), given) == Some(false) {
                atoms = fewer;
            }
        }
        let pieces = atoms.iter().map(|&a| Piece::Atom(rule.body[a].clone(), Rc::clone(&known)));
        let checks = checks.iter().map(|&c| Piece::Check(rule.checks[c].clone(), Rc::clone(&known)));
        link(Cause::NeverTogether(pieces.chain(checks).collect()))
    }

    fn follow(
        &mut self,
        rule: &Rule,
        piece: Piece,
        makers: Vec<(Rule, Vec<u32>)>,
        given: &[u32],
        trail: &mut Trail,
    ) -> Vec<Link> {
        let Piece::Atom(pattern, _) = &piece else { return Vec::new() };
        let mut origins: Vec<Origin> = Vec::new();
        for (maker, _) in &makers {
            if !origins.contains(&maker.origin) {
                origins.push(maker.origin.clone());
            }
        }
        let link = |cause| Link { origin: rule.origin.clone(), cause };
        let step = (pattern.relation, pattern.arguments.iter().map(|&t| resolve(t, given)).collect());
        if trail.contains(&step) || trail.len() >= DEPTH {
            return vec![link(Cause::Circle(piece, origins))];
        }
        trail.push(step);
        let mut fallback = None;
        for (maker, given) in makers.into_iter().take(WIDTH) {
            let chain = self.explain(&maker, &given, trail);
            let ends =
                matches!(chain.last().map(|l| &l.cause), Some(Cause::Circle(..) | Cause::Unknown) | None);
            if !ends {
                let at = origins.iter().position(|o| *o == maker.origin).unwrap_or(0);
                origins.swap(0, at);
                trail.pop();
                let first = link(Cause::OnlyMadeBy(piece, origins));
                return std::iter::once(first).chain(chain).collect();
            }
            fallback.get_or_insert(chain);
        }
        trail.pop();
        let unknown = fallback.is_some_and(|c| matches!(c.last().map(|l| &l.cause), Some(Cause::Unknown)));
        let cause = if unknown { Cause::OnlyMadeBy(piece, origins) } else { Cause::Circle(piece, origins) };
        vec![link(cause)]
    }

    /// The rules that could make an atom true, with the values that it gives them.
    fn makers(&self, pattern: &Pattern, given: &[u32], of: &Rule) -> Vec<(Rule, Vec<u32>)> {
        let mut makers = Vec::new();
        for rule in &self.compiled().rules {
            for head in rule.heads.iter().filter(|h| h.relation == pattern.relation) {
                let mut values = vec![UNBOUND; rule.slots.len()];
                let mut narrowed = rule.clone();
                let mut slots = rule.slots.to_vec();
                let fits = pattern.arguments.iter().zip(&head.arguments).all(|(&wanted, made)| {
                    let object = resolve(wanted, given);
                    if object != UNBOUND {
                        return unify(rule, &[*made], &[object], &mut values);
                    }
                    let Term::Variable(slot) = wanted else { return false };
                    let range = &of.slots[slot.0 as usize];
                    match made {
                        Term::Object(o) => range.contains(o.0),
                        Term::Variable(v) => {
                            let both = range.and(&slots[v.0 as usize]);
                            let some = !both.objects.is_empty();
                            slots[v.0 as usize] = Rc::new(both);
                            some
                        }
                    }
                });
                if fits {
                    narrowed.slots = slots.into();
                    makers.push((narrowed, values));
                    break;
                }
            }
        }
        makers
    }

    /// What a chain of causes ends in.
    pub(super) fn root_cause(&self, chain: &[Link]) -> RootCause {
        let makes = |p: &Pattern| {
            self.compiled().rules.iter().any(|r| r.heads.iter().any(|h| h.relation == p.relation))
        };
        let pieces = match chain.last().map(|l| &l.cause) {
            Some(Cause::NoObject(..)) => return RootCause::Data,
            Some(Cause::NothingMakes(Piece::Atom(pattern, _)))
                if self.compiled().rows.count(pattern.relation) == 0 && !makes(pattern) =>
            {
                return RootCause::Declared;
            }
            Some(Cause::NothingMakes(Piece::Atom(pattern, _)))
                if self.compiled().rows.count(pattern.relation) > 0 =>
            {
                return if makes(pattern) { RootCause::Facts } else { RootCause::Data };
            }
            // A task that only its own methods carry out: an endless recursion, which another lint says.
            Some(Cause::Circle(Piece::Atom(pattern, _), _))
                if matches!(self.name(pattern.relation), Some(Named::Task(_))) =>
            {
                return RootCause::Declared;
            }
            Some(Cause::NothingMakes(piece)) => std::slice::from_ref(piece),
            Some(Cause::NeverTogether(pieces)) => pieces,
            _ => return RootCause::Domain,
        };
        let hulls = self.hulls();
        let fixed = |piece: &Piece| match piece {
            Piece::Atom(pattern, _) => !makes(pattern),
            Piece::Check(Check::Compare(_, _, sides, _), _) => {
                let mut fixed = true;
                for side in [&sides.0, &sides.1] {
                    side.each(&mut |part| {
                        if let ExpressionKind::Fluent(application) = &part.kind {
                            fixed &= !hulls.changes(application.function);
                        }
                    });
                }
                fixed
            }
            Piece::Check(Check::Residual(..), _) => false,
            Piece::Check(..) => true,
        };
        if pieces.iter().all(fixed) { RootCause::Data } else { RootCause::Domain }
    }

    /// The predicate behind a relation.
    pub(super) fn predicate(&self, relation: RelationId) -> Option<pddl::model::PredicateId> {
        let at = self.compiled().evaluator.predicates.iter().position(|&r| r == relation)?;
        Some(pddl::model::PredicateId(u32::try_from(at).ok()?))
    }

    /// What a relation is called.
    pub(super) fn name(&self, relation: RelationId) -> Option<Named> {
        use pddl::model::{FunctionId, TaskId};
        let find = |all: &[RelationId]| u32::try_from(all.iter().position(|&r| r == relation)?).ok();
        if let Some(predicate) = self.predicate(relation) {
            return Some(Named::Predicate(predicate));
        }
        if let Some(function) = find(&self.compiled().evaluator.fluents) {
            return Some(Named::Function(FunctionId(function)));
        }
        find(&self.compiled().tasks).map(|t| Named::Task(TaskId(t)))
    }
}

/// What something unreachable comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RootCause {
    /// The problem's objects and facts that nothing changes: another problem may have others.
    Data,
    /// A predicate that nothing makes true and that no fact has, a task without an end: other lints say it.
    Declared,
    /// An atom that no fact is like and that no effect makes true, of a predicate that effects make true elsewhere.
    Facts,
    /// What actions do.
    Domain,
}

/// What a relation stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Named {
    /// A predicate.
    Predicate(pddl::model::PredicateId),
    /// An object fluent; the last argument is its value.
    Function(pddl::model::FunctionId),
    /// A task that can be decomposed.
    Task(pddl::model::TaskId),
}

/// The rule with some of its atoms and checks only, without heads.
fn part(rule: &Rule, atoms: &[usize], checks: &[usize]) -> Rule {
    Rule {
        origin: rule.origin.clone(),
        slots: Rc::clone(&rule.slots),
        parameters: 0,
        body: atoms.iter().map(|&a| rule.body[a].clone()).collect(),
        checks: checks.iter().map(|&c| rule.checks[c].clone()).collect(),
        needs: checks.iter().map(|&c| rule.needs[c].clone()).collect(),
        heads: Vec::new(),
    }
}
