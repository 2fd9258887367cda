//! Building a pattern in code: variables first, parts in any order; mistakes are reported by `build`.

use std::sync::Arc;

use super::check::PatternError;
use super::compiled::Pattern;
use super::source::{Atom, Carrier, Conjunction, Limit, PatternSource, Right};
use super::term::{Comparison, HolderTerm, Metric, Operand, Scope, Term, Threshold, Variable};
use crate::id::{AttributeId, LabelId, TypeId};
use crate::vocabulary::Vocabulary;

/// Collects the parts of a pattern.
#[derive(Debug)]
pub struct PatternBuilder<'d> {
    vocabulary: &'d Vocabulary,
    variables: Vec<(Arc<str>, TypeId)>,
    locals: Vec<TypeId>,
    /// The conjunction being written, innermost last; the first is the pattern itself.
    open: Vec<Conjunction<Term>>,
}

impl<'d> PatternBuilder<'d> {
    /// An empty pattern, which always has one match.
    pub fn new(vocabulary: &'d Vocabulary) -> Self {
        Self {
            vocabulary,
            variables: Vec::new(),
            locals: Vec::new(),
            open: vec![Conjunction { variables: Vec::new(), atoms: Vec::new() }],
        }
    }

    /// Declares a variable for nodes of a type: a variable of the pattern, or a local variable of the negated part that
    /// is being written.
    pub fn variable(&mut self, name: &str, node_type: TypeId) -> Variable {
        let (scope, index) = if self.open.len() == 1 {
            self.variables.push((name.into(), node_type));
            (Scope::Top, self.variables.len() - 1)
        } else {
            self.locals.push(node_type);
            (Scope::Local, self.locals.len() - 1)
        };
        // A pattern with more variables than a u16 can count is too large, which `build` reports.
        let variable = Variable { scope, index: u16::try_from(index).unwrap_or(u16::MAX) };
        self.top().variables.push(Term::Variable(variable));
        variable
    }

    /// The edge must exist.
    pub fn edge(&mut self, from: impl Into<Term>, label: LabelId, to: impl Into<Term>) -> &mut Self {
        self.add(Atom::Edge { from: from.into(), label, to: to.into() })
    }

    /// The attribute must have a value.
    pub fn present(&mut self, holder: impl Into<HolderTerm>, attribute: AttributeId) -> &mut Self {
        self.add(Atom::Present { holder: carrier(holder.into()), attribute })
    }

    /// The comparison with the value of the attribute must hold. If the attribute must equal a node variable that no
    /// other part binds, this part binds it.
    pub fn guard(
        &mut self,
        holder: impl Into<HolderTerm>,
        attribute: AttributeId,
        comparison: Comparison,
        operand: impl Into<Operand>,
    ) -> &mut Self {
        let operand = match operand.into() {
            Operand::Value(value) => Right::Value(value),
            Operand::Term(term) => Right::Term(term),
            Operand::Attribute(holder, attribute) => Right::Attribute(carrier(holder), attribute),
        };
        self.add(Atom::Guard { holder: carrier(holder.into()), attribute, comparison, operand })
    }

    /// The two must be different nodes.
    pub fn distinct(&mut self, a: impl Into<Term>, b: impl Into<Term>) -> &mut Self {
        self.add(Atom::Distinct(a.into(), b.into()))
    }

    /// The node must be of the type. Use this for constants, and in a negated part for variables from outside of it;
    /// other variables have their type from their declaration.
    pub fn is_a(&mut self, node: impl Into<Term>, node_type: TypeId) -> &mut Self {
        self.add(Atom::IsA(node.into(), node_type))
    }

    /// The comparison with the distance between the origins of the two frames must hold. It does not hold between nodes
    /// that no kinematic chain connects.
    pub fn distance(
        &mut self,
        from: impl Into<Term>,
        to: impl Into<Term>,
        comparison: Comparison,
        metres: impl Into<Threshold>,
    ) -> &mut Self {
        self.metric(Metric::Distance, from, to, comparison, metres)
    }

    /// The comparison with the metric between the two frames must hold. With hysteresis, a subscription remembers the
    /// matches that it has; a single query has no history, and returns the matches that would appear. See [`Threshold`]
    /// for negated parts.
    pub fn metric(
        &mut self,
        metric: Metric,
        from: impl Into<Term>,
        to: impl Into<Term>,
        comparison: Comparison,
        threshold: impl Into<Threshold>,
    ) -> &mut Self {
        let limit = Limit::Threshold(threshold.into());
        self.add(Atom::Metric { metric, from: from.into(), to: to.into(), comparison, limit })
    }

    /// The distance must be at most the attribute of `from`, in metres.
    pub fn reachable(&mut self, from: impl Into<Term>, to: impl Into<Term>, reach: AttributeId) -> &mut Self {
        let (metric, comparison) = (Metric::Distance, Comparison::LessOrEqual);
        let limit = Limit::Attribute(reach);
        self.add(Atom::Metric { metric, from: from.into(), to: to.into(), comparison, limit })
    }

    /// The conjunction that `write` adds, with its own local variables, must have no match. Negated parts may nest.
    pub fn without<R>(&mut self, write: impl FnOnce(&mut Self) -> R) -> R {
        self.open.push(Conjunction { variables: Vec::new(), atoms: Vec::new() });
        let result = write(self);
        let part = self.open.pop().expect("pushed above, and every inner `without` pops its own");
        self.add(Atom::Without(part));
        result
    }

    /// Checks the pattern against the vocabulary and compiles it.
    pub fn build(self) -> Result<Pattern, PatternError> {
        let Self { vocabulary, variables, locals, mut open } = self;
        let body = open.pop().expect("the pattern's own conjunction is never popped before");
        PatternSource { variables, locals, body }.build(vocabulary)
    }

    fn top(&mut self) -> &mut Conjunction<Term> {
        self.open.last_mut().expect("the pattern's own conjunction is always open")
    }

    fn add(&mut self, atom: Atom<Term>) -> &mut Self {
        self.top().atoms.push(atom);
        self
    }
}

fn carrier(holder: HolderTerm) -> Carrier<Term> {
    match holder {
        HolderTerm::Node(node) => Carrier::Node(node),
        HolderTerm::Edge { from, label, to } => Carrier::Edge { from, label, to },
    }
}
