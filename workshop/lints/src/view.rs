//! The domain and the problem as lints see them. What several lints need is computed once, when the first one asks.

use std::cell::{Cell, OnceCell};

use pddl::model::{Domain, Problem};
use pddl::syntax::{self, Tree};
use pddl::{Source, Span};

use crate::allow::{Allows, KnownLint};
use crate::analysis::Analysis;
use crate::coverage::{all_is_seen, all_of_problem_is_seen};
use crate::schema::Schema;
use crate::usage::Usage;
use analysis::reachability::Wording;

/// A domain.
pub(crate) struct DomainView<'a> {
    pub(crate) source: &'a Source,
    pub(crate) domain: &'a Domain,
    pub(crate) allows: Allows,
    /// Whether an object of a problem belongs to several types. The analysis of a domain alone does not know such objects.
    pub(crate) types_are_combined: Cell<bool>,
    tree: OnceCell<Tree<'a>>,
    usage: OnceCell<Usage>,
    analysis: OnceCell<Analysis<'a>>,
}

impl<'a> DomainView<'a> {
    pub(crate) fn new(source: &'a Source, domain: &'a Domain, known: KnownLint) -> Self {
        let allows = Allows::of(source, known);
        let (tree, usage, analysis) = (OnceCell::new(), OnceCell::new(), OnceCell::new());
        Self { source, domain, allows, types_are_combined: Cell::new(false), tree, usage, analysis }
    }

    /// The syntax tree, for lints about how something is written.
    pub(crate) fn tree(&self) -> &Tree<'a> {
        self.tree.get_or_init(|| syntax::parse(self.source).0)
    }

    /// Which names are used.
    pub(crate) fn usage(&self) -> &Usage {
        self.usage.get_or_init(|| Usage::of_domain(self.domain, self.schemas()))
    }

    /// Whether the model represents the whole text. Only then is a name without a use unused.
    pub(crate) fn is_complete(&self) -> bool {
        all_is_seen(self.domain)
    }

    /// The models and texts that reasons quote.
    pub(crate) fn wording(&self) -> Wording<'a> {
        Wording { domain: self.domain, problem: None, domain_source: self.source, problem_source: None }
    }

    /// The analyses that hold for every problem.
    pub(crate) fn analysis(&self) -> &Analysis<'a> {
        self.analysis.get_or_init(|| Analysis::new(&self.wording()))
    }

    /// Whether it only has declarations, for other domains that import it.
    pub(crate) fn is_vocabulary(&self) -> bool {
        self.schemas().next().is_none()
    }

    /// Everything with a body, in the order of the kinds.
    pub(crate) fn schemas(&self) -> impl Iterator<Item = Schema<'a>> + use<'a> {
        let domain = self.domain;
        let actions = domain.actions.iter().map(Schema::Action);
        let durative = domain.durative_actions.iter().map(Schema::Durative);
        let axioms = domain.axioms.iter().map(Schema::Axiom);
        let methods = domain.methods.iter().map(Schema::Method);
        let events = domain.events.iter().map(Schema::Event);
        let processes = domain.processes.iter().map(Schema::Process);
        actions.chain(durative).chain(axioms).chain(methods).chain(events).chain(processes)
    }
}

/// A problem with its domain.
pub(crate) struct ProblemView<'a, 'd> {
    pub(crate) domain: &'a DomainView<'d>,
    pub(crate) source: &'a Source,
    pub(crate) problem: &'a Problem,
    pub(crate) allows: Allows,
    tree: OnceCell<Tree<'a>>,
    usage: OnceCell<Usage>,
    analysis: OnceCell<Analysis<'a>>,
}

impl<'a, 'd> ProblemView<'a, 'd> {
    pub(crate) fn new(
        domain: &'a DomainView<'d>,
        source: &'a Source,
        problem: &'a Problem,
        known: KnownLint,
    ) -> Self {
        let allows = Allows::of(source, known);
        let (tree, usage, analysis) = (OnceCell::new(), OnceCell::new(), OnceCell::new());
        Self { domain, source, problem, allows, tree, usage, analysis }
    }

    /// The syntax tree, for lints about how something is written.
    pub(crate) fn tree(&self) -> &Tree<'a> {
        self.tree.get_or_init(|| syntax::parse(self.source).0)
    }

    /// Which names are used, in the problem alone.
    pub(crate) fn usage(&self) -> &Usage {
        self.usage.get_or_init(|| Usage::of_problem(self.domain.domain, self.problem))
    }

    /// The models and texts that reasons quote.
    pub(crate) fn wording(&self) -> Wording<'a> {
        let (problem, problem_source) = (Some(self.problem), Some(self.source));
        Wording { domain: self.domain.domain, problem, domain_source: self.domain.source, problem_source }
    }

    /// The analyses that hold for this problem.
    pub(crate) fn analysis(&self) -> &Analysis<'a> {
        self.analysis.get_or_init(|| Analysis::new(&self.wording()))
    }

    /// Whether both models represent their whole texts.
    pub(crate) fn is_complete(&self) -> bool {
        self.domain.is_complete() && all_of_problem_is_seen(self.problem)
    }
}

/// Whether a declaration is in this file. An imported declaration has no place in it.
pub(crate) fn is_here(span: Span) -> bool {
    span != Span::default()
}
