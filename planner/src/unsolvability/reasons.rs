//! Why a literal never holds: its achievers and what they lack, down to literals without achievers.
//!
//! Idea: if the oracle denies a literal, then every effect (or axiom) that would achieve it is impossible, too. It
//! needs a literal that never holds or a comparison that never holds, or its conditions never hold together. Each
//! literal is a node of one graph, explored once, breadth first; a cycle is an edge to a known node. If no single
//! condition of an achiever is denied, its static conditions are joined, and each instance in the result is checked by
//! itself. If that is not enough, all its conditions are joined. A ban of the query is reported only if the banned
//! instance lacks nothing else. Cost: the nodes, the achievers of each node and the rows of a join are bounded;
//! achievers beyond the bound are counted.

use super::bans::Bans;
use super::oracle::Oracle;
use crate::ids::id32;
use analysis::changes::{Change, changes};
use analysis::intervals::{NeverCompares, Ranges, Reachable};
use analysis::{Binding, Literal, Needs};
use budget::Budget;
use pddl::model::{Action, ActionId, Axiom, Condition, Name, ObjectId};
use std::cell::OnceCell;

/// The most literals that are explored.
const REASONS: usize = 48;
/// The most achievers of a literal that are reported.
const GIVERS: usize = 8;
/// The most rows that a join reads.
const ROWS: usize = 20_000;
/// The most instances of an achiever that are reported one by one.
const INSTANCES: usize = 24;

/// A position in [`Explanation::reasons`](super::Explanation::reasons).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReasonId(pub u32);

/// A literal that never holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reason {
    /// The literal.
    pub wanted: Literal,
    /// Why it never holds.
    pub why: Why,
}

/// Why a literal never holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Why {
    /// No action and no axiom achieves it, and it does not hold in the initial state.
    NothingAchieves,
    /// None of its achievers ever applies.
    Achievers {
        /// The achievers.
        achievers: Vec<Achiever>,
        /// The number of achievers that are left out.
        more: usize,
    },
    /// Not explored: there are too many reasons.
    Unexplored,
}

/// An action or axiom that would achieve a literal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Achiever {
    /// The action; `None` for an axiom of the wanted predicate.
    pub action: Option<ActionId>,
    /// Its arguments: an object, or the name of a parameter that is not bound.
    pub arguments: Vec<Result<ObjectId, Name>>,
    /// Why it never achieves the literal.
    pub obstruction: Obstruction,
}

/// Why an achiever never achieves its literal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Obstruction {
    /// It needs all of these, and each of them never holds.
    Needs(Vec<Need>),
    /// Each of these literals may hold for some objects, but never all of them for the same objects.
    NeverTogether(Vec<Literal>),
    /// Its conditions never hold together.
    NeverApplies,
    /// The query excludes it, and no other reason is known.
    Excluded,
}

/// A need that never holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Need {
    /// A literal.
    Literal(ReasonId),
    /// A comparison of numbers.
    Number(NeverCompares),
}

/// The graph as it grows.
pub(super) struct Reasons<'a> {
    oracle: &'a Oracle<'a>,
    ranges: &'a Ranges<'a>,
    budget: &'a Budget<'a>,
    bans: OnceCell<Bans>,
    found: Vec<Reason>,
}

/// A way to a literal: the effect's conditions under a binding.
struct Candidate<'a> {
    action: Option<ActionId>,
    binding: Binding<'a>,
    conditions: Vec<&'a Condition>,
}

impl Candidate<'_> {
    fn denied(&self, binding: &Binding<'_>, obstruction: Obstructed) -> Denied {
        let arguments = if self.action.is_some() { binding.parameters() } else { Vec::new() };
        Denied { action: self.action, arguments, obstruction }
    }
}

impl<'a> Reasons<'a> {
    /// `budget` bounds the visit of states that finds out which bans matter.
    pub(super) fn new(oracle: &'a Oracle<'a>, ranges: &'a Ranges<'a>, budget: &'a Budget<'a>) -> Self {
        Self { oracle, ranges, budget, bans: OnceCell::new(), found: Vec::new() }
    }

    /// An empty graph for the same oracle, ranges and budget.
    pub(super) fn without_nodes(&self) -> Self {
        Self::new(self.oracle, self.ranges, self.budget)
    }

    /// The node of a literal that the oracle denies.
    pub(super) fn of(&mut self, wanted: &Literal) -> ReasonId {
        let known = self.found.iter().position(|reason| reason.wanted == *wanted);
        ReasonId(id32(known.unwrap_or_else(|| {
            self.found.push(Reason { wanted: wanted.clone(), why: Why::Unexplored });
            self.found.len() - 1
        })))
    }

    pub(super) fn wanted(&self, id: ReasonId) -> &Literal {
        &self.found[id.0 as usize].wanted
    }

    /// Explores all nodes, including those that are added on the way.
    pub(super) fn finish(mut self) -> Vec<Reason> {
        let mut next = 0;
        while next < self.found.len().min(REASONS) {
            let wanted = self.found[next].wanted.clone();
            self.found[next].why = self.why(&wanted);
            next += 1;
        }
        self.found
    }

    fn why(&mut self, wanted: &Literal) -> Why {
        // The predicates of object fluents are not declared in the domain, and a negated derived
        // atom has no achiever.
        let predicates = &self.oracle.instance.domain.predicates;
        let is_known = (wanted.pattern.predicate.0 as usize) < predicates.len();
        if !is_known || (!wanted.positive && predicates[wanted.pattern.predicate].derived) {
            return Why::Unexplored;
        }
        let mut achievers = Vec::new();
        for candidate in self.candidates(wanted) {
            achievers.extend(self.hindered(&candidate));
        }
        if achievers.is_empty() {
            return Why::NothingAchieves;
        }
        // An achiever with a single unsatisfiable need is the most helpful.
        achievers.sort_by_key(|achiever| match &achiever.obstruction {
            Obstructed::Needs(needs) => needs.len(),
            Obstructed::Excluded => 0,
            Obstructed::NeverTogether(_) => usize::MAX - 1,
            Obstructed::NeverApplies => usize::MAX,
        });
        let more = achievers.len().saturating_sub(GIVERS);
        achievers.truncate(GIVERS);
        Why::Achievers {
            achievers: achievers.into_iter().map(|achiever| self.told(achiever)).collect(),
            more,
        }
    }

    fn told(&mut self, achiever: Denied) -> Achiever {
        let obstruction = match achiever.obstruction {
            Obstructed::Needs(needs) => Obstruction::Needs(
                needs
                    .into_iter()
                    .map(|need| match need {
                        Lacks::Literal(wanted) => Need::Literal(self.of(&wanted)),
                        Lacks::Number(number) => Need::Number(number),
                    })
                    .collect(),
            ),
            Obstructed::NeverTogether(all) => Obstruction::NeverTogether(all),
            Obstructed::NeverApplies => Obstruction::NeverApplies,
            Obstructed::Excluded => Obstruction::Excluded,
        };
        Achiever { action: achiever.action, arguments: achiever.arguments, obstruction }
    }

    /// Every effect and axiom that would achieve the literal.
    fn candidates(&self, wanted: &Literal) -> Vec<Candidate<'a>> {
        let oracle = self.oracle;
        let mut found = Vec::new();
        for (id, action) in oracle.instance.domain.actions.enumerate() {
            let Action { variables, precondition, effect, .. } = action;
            changes(effect, &mut |context, change| {
                let atom = match change {
                    Change::Add(atom) if wanted.positive => atom,
                    Change::Delete(atom) if !wanted.positive => atom,
                    _ => return,
                };
                let unified = Binding::new(variables).unified(atom, &wanted.pattern, oracle.instance);
                if let Some(binding) = unified {
                    let conditions =
                        std::iter::once(precondition).chain(context.when.iter().copied()).collect();
                    found.push(Candidate { action: Some(id), binding, conditions });
                }
            });
        }
        let axioms =
            oracle.instance.domain.axioms.iter().filter(|axiom| axiom.predicate == wanted.pattern.predicate);
        for Axiom { variables, body, .. } in axioms {
            let terms: Vec<_> = variables.parameter_ids().map(pddl::model::Term::Variable).collect();
            let arguments = &wanted.pattern.arguments;
            if let Some(binding) = Binding::new(variables).unified_terms(&terms, arguments, oracle.instance) {
                found.push(Candidate { action: None, binding, conditions: vec![body] });
            }
        }
        found
    }

    /// Why an achiever, or each instance of it, never achieves its literal.
    fn hindered(&self, candidate: &Candidate<'a>) -> Vec<Denied> {
        let Some(needs) = self.needs(candidate, &candidate.binding) else { return Vec::new() };
        let denied = |binding: &Binding<'_>, obstruction: Obstructed| candidate.denied(binding, obstruction);
        let lacking = self.lacking(&needs, &candidate.binding);
        if !lacking.is_empty() {
            return vec![denied(&candidate.binding, Obstructed::Needs(lacking))];
        }
        let (fixed, others): (Vec<&Literal>, Vec<&Literal>) = needs
            .literals
            .iter()
            .filter(|wanted| wanted.positive)
            .partition(|wanted| self.oracle.is_static(wanted.pattern.predicate));
        let mut join = Join { oracle: self.oracle, rows: 0 };
        let together = || match self.never_together(&fixed, &others, candidate) {
            Some(never) => vec![denied(&candidate.binding, never)],
            None => self.each(candidate, &[fixed.as_slice(), &others].concat()),
        };
        let Some(rows) = join.all(&fixed, &candidate.binding, INSTANCES) else { return together() };
        let mut found = Vec::new();
        for row in &rows {
            // An instance that equality or types rule out is not an achiever.
            let Some(needs) = self.needs(candidate, row) else { continue };
            let lacking = self.lacking(&needs, row);
            if lacking.is_empty() {
                return together();
            }
            let new = denied(row, Obstructed::Needs(lacking));
            if !found.contains(&new) {
                found.push(new);
            }
        }
        if found.is_empty() { together() } else { found }
    }

    /// Why each instance in the join of `literals` is impossible, if no single need of the achiever is denied.
    fn each(&self, candidate: &Candidate<'a>, literals: &[&Literal]) -> Vec<Denied> {
        let denied = |binding: &Binding<'_>, obstruction: Obstructed| candidate.denied(binding, obstruction);
        let mut join = Join { oracle: self.oracle, rows: 0 };
        let rows = join.all(literals, &candidate.binding, INSTANCES);
        let rows = rows.unwrap_or_else(|| vec![candidate.binding.clone()]);
        let (mut found, mut open): (Vec<Denied>, Vec<Denied>) = Default::default();
        for row in &rows {
            let Some(needs) = self.needs(candidate, row) else { continue };
            let lacking = self.lacking(&needs, row);
            let mut new = Vec::new();
            if lacking.is_empty() {
                new = self.excluded(candidate, row);
                if new.iter().all(|new| new.obstruction != Obstructed::Excluded) {
                    open.push(denied(row, Obstructed::NeverApplies));
                }
            } else {
                new.push(denied(row, Obstructed::Needs(lacking)));
            }
            for new in new {
                if !found.contains(&new) {
                    found.push(new);
                }
            }
        }
        // "Never applies" would be wrong of an instance that only a ban keeps from applying.
        let bars = found.iter().any(|found| found.obstruction == Obstructed::Excluded);
        if bars {
            open.dedup();
            found.extend(open);
        } else if !open.is_empty() || found.is_empty() {
            found.push(denied(&candidate.binding, Obstructed::NeverApplies));
        }
        found
    }

    /// The instances of an achiever that the query excludes: those that lack something, and those that only the ban
    /// keeps from applying. Instances that are impossible for another reason are left out.
    fn excluded(&self, candidate: &Candidate<'a>, binding: &Binding<'a>) -> Vec<Denied> {
        let Some(action) = candidate.action else { return Vec::new() };
        let wanted = binding.parameters();
        let mut found: Vec<Denied> = Vec::new();
        for (operator, arguments) in self.oracle.excluded(action, &wanted) {
            let mut binding = binding.clone();
            binding.set_parameters(arguments);
            let Some(needs) = self.needs(candidate, &binding) else { continue };
            let lacking = self.lacking(&needs, &binding);
            let bans = || self.bans.get_or_init(|| Bans::visit(self.oracle, self.budget));
            let obstruction = if !lacking.is_empty() {
                Obstructed::Needs(lacking)
            } else if self.oracle.may_apply(operator) && bans().may_bar(operator) {
                Obstructed::Excluded
            } else {
                continue;
            };
            let new = candidate.denied(&binding, obstruction);
            if !found.contains(&new) {
                found.push(new);
            }
        }
        found
    }

    fn needs(&self, candidate: &Candidate<'a>, binding: &Binding<'_>) -> Option<Needs<'a>> {
        let conditions = candidate.conditions.iter().copied();
        let needs = Needs::of(conditions, binding, self.oracle.instance);
        (!needs.is_false).then_some(needs)
    }

    fn lacking(&self, needs: &Needs<'_>, binding: &Binding<'_>) -> Vec<Lacks> {
        let mut lacking: Vec<Lacks> = Vec::new();
        for wanted in needs.literals.iter().filter(|wanted| !self.oracle.may_hold(wanted)) {
            let lack = Lacks::Literal(wanted.clone());
            if !lacking.contains(&lack) {
                lacking.push(lack);
            }
        }
        let numbers = needs.comparisons.iter().filter_map(|c| self.ranges.never(c, binding));
        lacking.extend(numbers.map(Lacks::Number));
        lacking
    }

    /// The shortest prefix of the conditions that provably no objects satisfy.
    fn never_together(
        &self,
        fixed: &[&Literal],
        others: &[&Literal],
        candidate: &Candidate<'_>,
    ) -> Option<Obstructed> {
        let mut all: Vec<&Literal> = fixed.to_vec();
        all.extend(others);
        let mut join = Join { oracle: self.oracle, rows: 0 };
        for count in 2..=all.len() {
            match join.all(&all[..count], &candidate.binding, 1) {
                // No row is a proof, unless the join reached its limit.
                Some(rows) if rows.is_empty() => {
                    let together = all[..count].iter().map(|&w| w.clone()).collect();
                    return Some(Obstructed::NeverTogether(together));
                }
                _ if join.rows >= ROWS => break,
                _ => {}
            }
        }
        None
    }
}

/// An achiever whose needs have no nodes yet.
#[derive(PartialEq)]
struct Denied {
    action: Option<ActionId>,
    arguments: Vec<Result<ObjectId, Name>>,
    obstruction: Obstructed,
}

#[derive(PartialEq)]
enum Obstructed {
    Needs(Vec<Lacks>),
    NeverTogether(Vec<Literal>),
    NeverApplies,
    Excluded,
}

#[derive(PartialEq)]
enum Lacks {
    Literal(Literal),
    Number(NeverCompares),
}

/// Joins literals over the atoms that may hold.
struct Join<'a> {
    oracle: &'a Oracle<'a>,
    rows: usize,
}

impl Join<'_> {
    /// All bindings that satisfy the literals; `None` if there are more than `most`, or if the join reads too many
    /// rows.
    fn all<'v>(
        &mut self,
        literals: &[&Literal],
        binding: &Binding<'v>,
        most: usize,
    ) -> Option<Vec<Binding<'v>>> {
        let mut found = vec![binding.clone()];
        for (i, wanted) in literals.iter().enumerate() {
            let is_last = i + 1 == literals.len();
            let mut next = Vec::new();
            for binding in &found {
                let here = binding.literal(wanted);
                for row in self.oracle.matches(&here) {
                    self.rows += 1;
                    if self.rows >= ROWS || (is_last && next.len() >= most) {
                        return None;
                    }
                    let mut bound = binding.clone();
                    let open = here.pattern.arguments.iter().zip(row);
                    let fits = open.into_iter().all(|(argument, &object)| match argument {
                        Err(name) => bound.set_named(name, ObjectId(object), self.oracle.instance),
                        Ok(_) => true,
                    });
                    if fits {
                        next.push(bound);
                    }
                }
            }
            found = next;
        }
        Some(found)
    }
}
