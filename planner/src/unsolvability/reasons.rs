//! Why a literal is never so: what would give it, and what that lacks, down to what nothing gives.
//!
//! Idea: of a literal that the oracle denies, every effect (or axiom) that would give it is denied, too: it needs
//! a literal that is never so, or a comparison that never holds, or its conditions never come together. Each
//! literal is a node of one graph, looked at once, breadth first; a cycle is an edge to a node that is known. Where
//! no single condition of a giver is denied, its static conditions are joined, and each instance that these leave is
//! asked by itself; where that is not enough, all its conditions are. Of the query's bans only those are told that keep
//! an instance that lacks nothing else. Cost: bounded nodes, givers of each and rows of a join; what is beyond is counted.

use super::bans::Bans;
use super::needs::{Binding, Needs};
use super::oracle::Oracle;
use super::ranges::{NeverCompares, Ranges};
use super::{Pattern, Wanted};
use crate::ids::id32;
use analysis::invariants::{Change, changes};
use budget::Budget;
use pddl::model::{Action, ActionId, Axiom, Condition, Name, ObjectId};
use std::cell::OnceCell;

/// Literals that are looked at.
const REASONS: usize = 48;
/// Givers told of each literal.
const GIVERS: usize = 8;
/// Rows looked at in a join, and instances told apart.
const ROWS: usize = 20_000;
const INSTANCES: usize = 24;

/// A position in [`Explanation::reasons`](super::Explanation::reasons).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReasonId(pub u32);

/// A literal that is never so.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reason {
    /// The literal.
    pub wanted: Wanted,
    /// Why it is never so.
    pub why: Why,
}

/// Why a literal is never so.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Why {
    /// No action and no axiom gives it, and it is not so to begin with.
    NothingGives,
    /// Whatever would give it never does.
    Givers {
        /// What would.
        givers: Vec<Giver>,
        /// How many more there are.
        more: usize,
    },
    /// That was not looked at: there are too many reasons.
    Unexplored,
}

/// What would give a literal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Giver {
    /// The action; `None` for an axiom of the wanted predicate.
    pub action: Option<ActionId>,
    /// Its parameters, as far as they are known.
    pub arguments: Vec<Result<ObjectId, Name>>,
    /// What is in its way.
    pub hindrance: Hindrance,
}

/// What is in the way of a giver.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Hindrance {
    /// Each of these is enough.
    Needs(Vec<Need>),
    /// Each of these may be so at some time, for some objects, but never all for the same ones.
    NeverTogether(Vec<Wanted>),
    /// Its conditions never hold together.
    NeverApplies,
    /// The query excludes it, and nothing else is known to be in its way.
    Excluded,
}

/// Something that is needed and never so.
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
    fn denied(&self, binding: &Binding<'_>, hindrance: Hindered) -> Denied {
        let arguments = if self.action.is_some() { binding.parameters() } else { Vec::new() };
        Denied { action: self.action, arguments, hindrance }
    }
}

impl<'a> Reasons<'a> {
    /// `budget` bounds the visit of states that tells what the bans are to blame for.
    pub(super) fn new(oracle: &'a Oracle<'a>, ranges: &'a Ranges<'a>, budget: &'a Budget<'a>) -> Self {
        Self { oracle, ranges, budget, bans: OnceCell::new(), found: Vec::new() }
    }

    /// Another graph on the same ground.
    pub(super) fn without_nodes(&self) -> Self {
        Self::new(self.oracle, self.ranges, self.budget)
    }

    /// The node of a literal that the oracle denies.
    pub(super) fn of(&mut self, wanted: &Wanted) -> ReasonId {
        let known = self.found.iter().position(|reason| reason.wanted == *wanted);
        ReasonId(id32(known.unwrap_or_else(|| {
            self.found.push(Reason { wanted: wanted.clone(), why: Why::Unexplored });
            self.found.len() - 1
        })))
    }

    pub(super) fn wanted(&self, id: ReasonId) -> &Wanted {
        &self.found[id.0 as usize].wanted
    }

    /// Looks at all nodes, those that come up on the way included.
    pub(super) fn finish(mut self) -> Vec<Reason> {
        let mut next = 0;
        while next < self.found.len().min(REASONS) {
            let wanted = self.found[next].wanted.clone();
            self.found[next].why = self.why(&wanted);
            next += 1;
        }
        self.found
    }

    fn why(&mut self, wanted: &Wanted) -> Why {
        // Values of object fluents are predicates that the domain does not have, and a negated axiom has no giver.
        let predicates = &self.oracle.domain.predicates;
        let is_known = (wanted.pattern.predicate.0 as usize) < predicates.len();
        if !is_known || (!wanted.positive && predicates[wanted.pattern.predicate].derived) {
            return Why::Unexplored;
        }
        let mut givers = Vec::new();
        for candidate in self.candidates(wanted) {
            givers.extend(self.hindered(&candidate));
        }
        if givers.is_empty() {
            return Why::NothingGives;
        }
        // Those that lack one thing say most.
        givers.sort_by_key(|giver| match &giver.hindrance {
            Hindered::Needs(needs) => needs.len(),
            Hindered::Excluded => 0,
            Hindered::NeverTogether(_) => usize::MAX - 1,
            Hindered::NeverApplies => usize::MAX,
        });
        let more = givers.len().saturating_sub(GIVERS);
        givers.truncate(GIVERS);
        Why::Givers { givers: givers.into_iter().map(|giver| self.told(giver)).collect(), more }
    }

    fn told(&mut self, giver: Denied) -> Giver {
        let hindrance = match giver.hindrance {
            Hindered::Needs(needs) => Hindrance::Needs(
                needs
                    .into_iter()
                    .map(|need| match need {
                        Lacks::Literal(wanted) => Need::Literal(self.of(&wanted)),
                        Lacks::Number(number) => Need::Number(number),
                    })
                    .collect(),
            ),
            Hindered::NeverTogether(all) => Hindrance::NeverTogether(all),
            Hindered::NeverApplies => Hindrance::NeverApplies,
            Hindered::Excluded => Hindrance::Excluded,
        };
        Giver { action: giver.action, arguments: giver.arguments, hindrance }
    }

    /// Every effect and axiom that would give it.
    fn candidates(&self, wanted: &Wanted) -> Vec<Candidate<'a>> {
        let oracle = self.oracle;
        let mut found = Vec::new();
        for (id, action) in oracle.domain.actions.enumerate() {
            let Action { variables, precondition, effect, .. } = action;
            changes(effect, &mut |context, change| {
                let atom = match change {
                    Change::Add(atom) if wanted.positive => atom,
                    Change::Delete(atom) if !wanted.positive => atom,
                    _ => return,
                };
                let unified = Binding::new(variables).unified(atom, &wanted.pattern, oracle);
                if let Some(binding) = unified {
                    let conditions =
                        std::iter::once(precondition).chain(context.when.iter().copied()).collect();
                    found.push(Candidate { action: Some(id), binding, conditions });
                }
            });
        }
        let axioms = oracle.domain.axioms.iter().filter(|axiom| axiom.predicate == wanted.pattern.predicate);
        for Axiom { variables, body, .. } in axioms {
            let terms: Vec<_> = variables.parameter_ids().map(pddl::model::Term::Variable).collect();
            let arguments = &wanted.pattern.arguments;
            if let Some(binding) = Binding::new(variables).unified_terms(&terms, arguments, oracle) {
                found.push(Candidate { action: None, binding, conditions: vec![body] });
            }
        }
        found
    }

    /// What is in the way of a giver, or of each instance of it.
    fn hindered(&self, candidate: &Candidate<'a>) -> Vec<Denied> {
        let Some(needs) = self.needs(candidate, &candidate.binding) else { return Vec::new() };
        let denied = |binding: &Binding<'_>, hindrance: Hindered| candidate.denied(binding, hindrance);
        let lacking = self.lacking(&needs, &candidate.binding);
        if !lacking.is_empty() {
            return vec![denied(&candidate.binding, Hindered::Needs(lacking))];
        }
        let (fixed, others): (Vec<&Wanted>, Vec<&Wanted>) = needs
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
            // An instance that equality or types rule out is no giver.
            let Some(needs) = self.needs(candidate, row) else { continue };
            let lacking = self.lacking(&needs, row);
            if lacking.is_empty() {
                return together();
            }
            let new = denied(row, Hindered::Needs(lacking));
            if !found.contains(&new) {
                found.push(new);
            }
        }
        if found.is_empty() { together() } else { found }
    }

    /// What is in the way of each instance that the literals leave, where no single need of the giver is denied.
    fn each(&self, candidate: &Candidate<'a>, literals: &[&Wanted]) -> Vec<Denied> {
        let denied = |binding: &Binding<'_>, hindrance: Hindered| candidate.denied(binding, hindrance);
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
                if new.iter().all(|new| new.hindrance != Hindered::Excluded) {
                    open.push(denied(row, Hindered::NeverApplies));
                }
            } else {
                new.push(denied(row, Hindered::Needs(lacking)));
            }
            for new in new {
                if !found.contains(&new) {
                    found.push(new);
                }
            }
        }
        // What nothing but a ban keeps from applying must not be among what never applies.
        let bars = found.iter().any(|found| found.hindrance == Hindered::Excluded);
        if bars {
            open.dedup();
            found.extend(open);
        } else if !open.is_empty() || found.is_empty() {
            found.push(denied(&candidate.binding, Hindered::NeverApplies));
        }
        found
    }

    /// The instances of a giver that the query excludes: what they lack, or that nothing else is in their way. What is
    /// in the way of others is left out.
    fn excluded(&self, candidate: &Candidate<'a>, binding: &Binding<'a>) -> Vec<Denied> {
        let Some(action) = candidate.action else { return Vec::new() };
        let wanted = binding.parameters();
        let mut found: Vec<Denied> = Vec::new();
        for (operator, arguments) in self.oracle.excluded(action, &wanted) {
            let mut binding = binding.clone();
            for (parameter, &object) in binding.variables.parameter_ids().zip(arguments) {
                binding.set(parameter, Some(object));
            }
            let Some(needs) = self.needs(candidate, &binding) else { continue };
            let lacking = self.lacking(&needs, &binding);
            let bans = || self.bans.get_or_init(|| Bans::visit(self.oracle, self.budget));
            let hindrance = if !lacking.is_empty() {
                Hindered::Needs(lacking)
            } else if self.oracle.may_apply(operator) && bans().may_bar(operator) {
                Hindered::Excluded
            } else {
                continue;
            };
            let new = candidate.denied(&binding, hindrance);
            if !found.contains(&new) {
                found.push(new);
            }
        }
        found
    }

    fn needs(&self, candidate: &Candidate<'a>, binding: &Binding<'_>) -> Option<Needs<'a>> {
        let mut needs = Needs::default();
        candidate.conditions.iter().for_each(|c| needs.add(c, true, binding, self.oracle));
        (!needs.is_false).then_some(needs)
    }

    fn lacking(&self, needs: &Needs<'_>, binding: &Binding<'_>) -> Vec<Lacks> {
        let mut lacking: Vec<Lacks> = Vec::new();
        for wanted in needs.literals.iter().filter(|wanted| !self.oracle.may_be(wanted)) {
            let lack = Lacks::Literal(wanted.clone());
            if !lacking.contains(&lack) {
                lacking.push(lack);
            }
        }
        let numbers = needs.comparisons.iter().filter_map(|c| self.ranges.never(c, binding));
        lacking.extend(numbers.map(Lacks::Number));
        lacking
    }

    /// The first conditions of which it is known that no objects satisfy all.
    fn never_together(
        &self,
        fixed: &[&Wanted],
        others: &[&Wanted],
        candidate: &Candidate<'_>,
    ) -> Option<Hindered> {
        let mut all: Vec<&Wanted> = fixed.to_vec();
        all.extend(others);
        let mut join = Join { oracle: self.oracle, rows: 0 };
        for count in 2..=all.len() {
            match join.all(&all[..count], &candidate.binding, 1) {
                // One that is found says that there are some; none where the limit was reached says nothing.
                Some(rows) if rows.is_empty() => {
                    let together = all[..count].iter().map(|&w| w.clone()).collect();
                    return Some(Hindered::NeverTogether(together));
                }
                _ if join.rows >= ROWS => break,
                _ => {}
            }
        }
        None
    }
}

/// A giver before its needs have nodes.
#[derive(PartialEq)]
struct Denied {
    action: Option<ActionId>,
    arguments: Vec<Result<ObjectId, Name>>,
    hindrance: Hindered,
}

#[derive(PartialEq)]
enum Hindered {
    Needs(Vec<Lacks>),
    NeverTogether(Vec<Wanted>),
    NeverApplies,
    Excluded,
}

#[derive(PartialEq)]
enum Lacks {
    Literal(Wanted),
    Number(NeverCompares),
}

/// Joins literals over the atoms that may hold.
struct Join<'a> {
    oracle: &'a Oracle<'a>,
    rows: usize,
}

impl Join<'_> {
    /// All bindings that satisfy the literals; `None` if there are more than `most`, or it takes too long.
    fn all<'v>(
        &mut self,
        literals: &[&Wanted],
        binding: &Binding<'v>,
        most: usize,
    ) -> Option<Vec<Binding<'v>>> {
        let mut found = vec![binding.clone()];
        for (i, wanted) in literals.iter().enumerate() {
            let is_last = i + 1 == literals.len();
            let mut next = Vec::new();
            for binding in &found {
                let here = under(wanted, binding);
                for row in self.oracle.matches(&here) {
                    self.rows += 1;
                    if self.rows >= ROWS || (is_last && next.len() >= most) {
                        return None;
                    }
                    let mut bound = binding.clone();
                    let open = here.pattern.arguments.iter().zip(row);
                    let fits = open.into_iter().all(|(argument, &object)| match argument {
                        Err(name) => bound.set_named(name, ObjectId(object), self.oracle),
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

/// The literal with what is bound by now.
fn under(wanted: &Wanted, binding: &Binding<'_>) -> Wanted {
    let argument = |argument: &Result<ObjectId, Name>| match argument {
        Ok(object) => Ok(*object),
        Err(name) => binding.named(name).ok_or_else(|| name.clone()),
    };
    let arguments = wanted.pattern.arguments.iter().map(argument).collect();
    Wanted { pattern: Pattern { predicate: wanted.pattern.predicate, arguments }, positive: wanted.positive }
}
