//! Explains why a rule never fires: follows the rules that could satisfy it back to the root cause.
//!
//! Problem: "can never apply" does not help without the reason, and a single mistake makes every
//! later action unreachable. Idea: among the atoms and checks of a rule, find a smallest part that
//! no binding satisfies. If it is a single atom, continue with the rules that could make it true,
//! with the values that it gives them. If there are none, that atom is the root. Cost: a join for
//! each atom and each step of the chain; each join has a budget, and there is one budget for all.
//! If a budget is used up, the chain ends with the causes found so far.
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

/// The most join steps for one question.
const STEPS: u64 = 300_000;
/// The most join steps for all questions.
const REASONS: u64 = 3_000_000;
/// The most links of a chain.
const DEPTH: usize = 8;
/// The most makers that are followed at each link.
const WIDTH: usize = 6;

/// A part of a condition, with the known values of its variables.
#[derive(Clone, Debug)]
pub(super) enum Piece {
    /// An atom.
    Atom(Pattern, Rc<[u32]>),
    /// A side condition.
    Check(Check, Rc<[u32]>),
}

/// The cause why a rule does not fire.
#[derive(Clone, Debug)]
pub(super) enum Cause {
    /// There is no object for a parameter.
    NoObject(TypeSet),
    /// No initial fact matches it, and no effect makes it true.
    NothingMakes(Piece),
    /// Only these rules could make it true, and they never fire; the next link explains the first
    /// of them.
    OnlyMadeBy(Piece, Vec<Origin>),
    /// Only these rules could make it true, and they need it themselves.
    Circle(Piece, Vec<Origin>),
    /// Each part can hold alone, but not all together.
    NeverTogether(Vec<Piece>),
    /// It is false in every state.
    False,
    /// The search for the cause exceeded its budget.
    Unknown,
}

/// One step of the explanation.
#[derive(Clone, Debug)]
pub(super) struct Link {
    /// The rule part that does not fire.
    pub(super) origin: Origin,
    /// The cause.
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

/// A conjunct of the goal that never holds.
pub(super) struct DeadGoal<'a> {
    /// The conjunct.
    pub(super) condition: &'a Condition,
    /// The values of the variables of its enclosing `forall`s.
    pub(super) values: Vec<(VariableId, ObjectId)>,
    /// The explanation.
    pub(super) chain: Vec<Link>,
}

/// Explains why rules never fire, within one budget for all questions.
pub(super) struct Explainer<'a> {
    reachability: Reachability<'a>,
    /// The remaining steps for all questions.
    left: u64,
}

impl<'a> Explainer<'a> {
    /// An explainer for a fixpoint.
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

    /// The explanation why a part of a schema never fires.
    pub(super) fn why(&mut self, origin: &Origin) -> Vec<Link> {
        let rule = self.compiled().rules.iter().find(|r| r.origin == *origin).cloned();
        let Some(rule) = rule else {
            return vec![Link { origin: origin.clone(), cause: Cause::False }];
        };
        let given = vec![UNBOUND; rule.slots.len()];
        self.explain(&rule, &given, &mut Vec::new())
    }

    /// The conjuncts of the goal that never hold, at most `limit` of them.
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

    /// Whether some binding satisfies the rule; `None` if the budget does not suffice.
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
        // An atom without makers is the root; otherwise take the first atom.
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
        // Drop checks before atoms, because atoms explain more.
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

    /// The root cause of a chain.
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
            // A task that is reachable only through its own methods: an endless recursion, which
            // another lint reports.
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

    /// The name of a relation.
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

/// The origin of something unreachable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RootCause {
    /// The problem's objects and facts that nothing changes; another problem may have others.
    Data,
    /// A predicate without facts or effects that make it true, or a task with endless recursion;
    /// other lints report these.
    Declared,
    /// An atom that matches no fact and that no effect makes true; effects make other atoms of its
    /// predicate true.
    Facts,
    /// The actions of the domain.
    Domain,
}

/// The declaration behind a relation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Named {
    /// A predicate.
    Predicate(pddl::model::PredicateId),
    /// An object fluent; the last argument is its value.
    Function(pddl::model::FunctionId),
    /// A task that can be decomposed.
    Task(pddl::model::TaskId),
}

/// The rule with only some of its atoms and checks, without heads.
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
