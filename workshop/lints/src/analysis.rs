//! What the lints of reachability share: computed once for a domain or a problem, when the first asks.
//!
//! Idea: everything silent is asked for its reason, and whoever's reason leads to something else that
//! is silent is a consequence, not a mistake of its own: it is named at the root, in one finding.

use std::rc::Rc;

use analysis::invariants::{Counts, Invariant, invariants};
use pddl::model::{Domain, DurativeAction, Problem};
use rustc_hash::FxHashSet;

use crate::happening::happenings;
use crate::numbers::Numbers;
use crate::reachability::{
    Cause, DeadGoal, Link, Nature, Origin, Part, Piece, Reachability, Schema, Words, World,
};
use crate::view::{all_is_seen, all_of_problem_is_seen};

/// Conjuncts of a goal that are reported.
const GOALS: usize = 5;

/// So many roots for want of facts mean that the domain is a library, of which a problem needs a part.
const LIBRARY: usize = 8;

/// Something that never fires.
pub(crate) struct Dead {
    /// What.
    pub(crate) origin: Origin,
    /// Why, as the rest of a sentence.
    pub(crate) reason: String,
    /// Who is to blame.
    pub(crate) nature: Nature,
    /// Where what is missing is needed.
    pub(crate) needed: Option<pddl::Span>,
    /// What does not fire either, because of this.
    pub(crate) consequences: Vec<Origin>,
}

/// A conjunct of the goal that can never hold.
pub(crate) struct Unreachable<'a> {
    /// Which, and the values that it is looked at with.
    pub(crate) goal: DeadGoal<'a>,
    /// Why.
    pub(crate) reason: String,
}

/// A subtask of the problem's network that cannot be carried out.
pub(crate) struct Impossible {
    /// Which.
    pub(crate) schema: Schema,
    /// Why.
    pub(crate) reason: String,
}

/// Atoms of which at most one holds at a time.
pub(crate) struct Exclusion {
    /// The invariant.
    pub(crate) invariant: Invariant,
    /// Where it starts.
    pub(crate) counts: Counts,
}

/// What is known of a domain, or of a problem.
pub(crate) struct Analysis<'a> {
    /// Possible values of fluents.
    pub(crate) numbers: Rc<Numbers>,
    /// What excludes what.
    pub(crate) exclusions: Vec<Exclusion>,
    /// Roots only.
    pub(crate) dead: Vec<Dead>,
    /// All that never fires.
    pub(crate) silent: FxHashSet<Origin>,
    /// Subtasks of the problem's network that cannot be carried out.
    pub(crate) impossible: Vec<Impossible>,
    /// Of the problem's goal.
    pub(crate) goals: Vec<Unreachable<'a>>,
}

impl<'a> Analysis<'a> {
    /// For a domain with or without a problem whose models hold all that the texts say.
    pub(crate) fn new(words: &Words<'a>) -> Self {
        let (domain, problem): (&'a Domain, Option<&'a Problem>) = (words.domain, words.problem);
        let numbers = Rc::new(Numbers::new(domain, problem));
        let world = Rc::new(World::new(domain, problem));
        let (dead, silent, impossible, goals) = (Vec::new(), FxHashSet::default(), Vec::new(), Vec::new());
        let exclusions = Vec::new();
        let mut analysis = Self { numbers, exclusions, dead, silent, impossible, goals };
        if let (Some(problem), true) = (problem, is_covered(words)) {
            analysis.exclude(domain, problem);
        }
        if is_covered(words)
            && let Some(mut reach) = Reachability::new(&world, &analysis.numbers)
        {
            analysis.gather(words, &mut reach);
        }
        analysis
    }

    fn exclude(&mut self, domain: &Domain, problem: &Problem) {
        // Neither a rule's outcome nor an effect that looks at another time has all its conditions in
        // its happening.
        let elsewhere =
            |a: &DurativeAction| a.rule.is_some() || a.effects.iter().any(|e| !e.given.is_empty());
        if domain.durative_actions.iter().any(elsewhere) {
            return;
        }
        let happenings: Vec<analysis::invariants::Happening<'_>> =
            happenings(domain).into_iter().map(Into::into).collect();
        self.exclusions = invariants(domain, &happenings)
            .into_iter()
            .filter_map(|invariant| {
                let counts = Counts::new(&invariant, problem)?;
                Some(Exclusion { invariant, counts })
            })
            .collect();
    }

    fn gather(&mut self, words: &Words<'a>, reach: &mut Reachability<'a>) {
        let silent: Vec<Origin> = reach.silent().into_iter().cloned().collect();
        self.silent = silent.iter().cloned().collect();
        // What is silent because the whole is goes without saying.
        let own = |o: &&Origin| {
            let whole = Origin { when: None, ..(*o).clone() };
            let start = Origin { part: Part::Start, ..whole.clone() };
            let by_when = o.when.is_some() && self.silent.contains(&whole);
            let by_start = o.part != Part::Start && self.silent.contains(&start);
            !by_when && !by_start
        };
        let asked: Vec<&Origin> = silent.iter().filter(own).collect();
        let chains: Vec<Vec<Link>> = asked.iter().map(|o| reach.why(o)).collect();
        let roots: Vec<usize> = (0..asked.len()).map(|i| root(i, &asked, &chains)).collect();
        for (origin, chain) in
            asked.iter().zip(&chains).filter(|(o, _)| matches!(o.schema, Schema::Initial(_)))
        {
            let reason = reach.reason(words, chain);
            self.impossible.push(Impossible { schema: origin.schema.clone(), reason });
        }
        for (i, origin) in asked.iter().enumerate().filter(|(i, _)| roots[*i] == *i) {
            let consequences = asked
                .iter()
                .zip(&roots)
                .enumerate()
                .filter(|(j, (_, r))| **r == i && *j != i)
                .map(|(_, (o, _))| (*o).clone());
            self.dead.push(Dead {
                origin: (*origin).clone(),
                reason: reach.reason(words, &chains[i]),
                nature: reach.nature(&chains[i]),
                needed: needed(&chains[i]),
                consequences: consequences.collect(),
            });
        }
        let library = self.dead.iter().filter(|d| d.nature == Nature::Facts).count() > LIBRARY;
        for dead in self.dead.iter_mut().filter(|d| d.nature == Nature::Facts) {
            dead.nature = if library { Nature::Data } else { Nature::Domain };
        }
        for goal in reach.dead_goals(GOALS) {
            let reason = reach.reason(words, &goal.chain);
            self.goals.push(Unreachable { goal, reason });
        }
    }
}

/// Whether the analyses know every part of the language that the models use.
fn is_covered(words: &Words<'_>) -> bool {
    all_is_seen(words.domain) && words.problem.is_none_or(all_of_problem_is_seen)
}

/// The silent origin that a chain ends in, `i` itself if there is none but it.
fn root(i: usize, asked: &[&Origin], chains: &[Vec<Link>]) -> usize {
    let mut seen = vec![i];
    let mut at = i;
    loop {
        // The circle's makers are silent as well: the first of them stands for it.
        let circle = chains[at].last().and_then(|l| match &l.cause {
            Cause::Circle(_, by) => Some(by.iter()),
            _ => None,
        });
        let along = chains[at].iter().skip(1).map(|l| &l.origin).chain(circle.into_iter().flatten());
        let same = |o: &Origin, a: &Origin| o.schema == a.schema && o.when == a.when;
        let next = along.filter_map(|o| asked.iter().position(|a| same(o, a))).find(|&j| j != at);
        match next {
            None => return at,
            Some(j) if seen.contains(&j) => {
                let circle = seen.iter().skip_while(|&&k| k != j);
                return circle.copied().min().unwrap_or(j);
            }
            Some(j) => {
                seen.push(j);
                at = j;
            }
        }
    }
}

/// The place of the first atom that never holds, if it is in the schema that is spoken of.
fn needed(chain: &[Link]) -> Option<pddl::Span> {
    match &chain.first()?.cause {
        Cause::NothingMakes(Piece::Atom(p, _))
        | Cause::OnlyMadeBy(Piece::Atom(p, _), _)
        | Cause::Circle(Piece::Atom(p, _), _) => Some(p.span),
        _ => None,
    }
}

/// The name's place of a schema in the domain.
pub(crate) fn place(domain: &Domain, schema: &Schema) -> pddl::Span {
    match schema {
        Schema::Action(id) => domain.actions[*id].name_span,
        Schema::Durative(id) => domain.durative_actions[*id].name_span,
        Schema::Axiom(i) => domain.axioms[*i].span,
        Schema::Method(id) => domain.methods[*id].span,
        Schema::Event(id) => domain.events[*id].name_span,
        Schema::Goal(_) | Schema::Initial(_) => pddl::Span::default(),
    }
}
