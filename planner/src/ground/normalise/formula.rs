//! Conditions in negation normal form.
//!
//! Idea: push negations to the literals, remove implications, flatten conjunctions and
//! disjunctions, split quantifiers over independent parts, and hoist existential variables from the
//! top level, so that they are joined like parameters. Nested parts (universal quantifiers,
//! disjunctions) are expanded when a binding is known and static facts decide most of them. The
//! remaining disjunctions become copies of the operator or an auxiliary axiom, so no exponential
//! normal form is ever built. Invariant: the formula is equivalent to the condition, negated or
//! not.
//!
//! Source: Helmert, "Concise finite-domain representations", AIJ 2009, §4.

use super::universe::Universe;
use crate::ground::error::{Feature, GroundError, Origin};
use crate::number::Relation;
use pddl::model::{
    Comparison, Condition, ConditionKind, Expression, ExpressionKind, Extent, PredicateId, Term, VariableId,
};
use std::sync::Arc;

/// An atom or its negation over terms.
#[derive(Clone, Debug)]
pub(crate) struct Literal {
    pub(crate) positive: bool,
    pub(crate) predicate: PredicateId,
    pub(crate) arguments: Box<[Term]>,
}

/// A condition in which only literals are negated.
#[derive(Clone, Debug)]
pub(crate) enum Formula {
    And(Vec<Formula>),
    Or(Vec<Formula>),
    Exists(Vec<VariableId>, Box<Formula>),
    Forall(Vec<VariableId>, Box<Formula>),
    Literal(Literal),
    Same {
        positive: bool,
        left: Term,
        right: Term,
    },
    /// Whether an object is one of these objects, which have the required types.
    OneOf {
        positive: bool,
        term: Term,
        extent: Arc<Extent>,
    },
    /// The relation of `left - right` to 0. An undefined value is in no relation, so the negation
    /// of a comparison is another relation and not its complement.
    Compare {
        relation: Relation,
        left: Arc<Expression>,
        right: Arc<Expression>,
    },
}

/// The relation of a comparison or of its negation, and whether to swap its sides.
fn relation(comparison: Comparison, positive: bool) -> (Relation, bool) {
    match (comparison, positive) {
        (Comparison::Greater, true) => (Relation::Positive, false),
        (Comparison::GreaterEqual, true) => (Relation::NonNegative, false),
        (Comparison::Less, true) => (Relation::Positive, true),
        (Comparison::LessEqual, true) => (Relation::NonNegative, true),
        (Comparison::Equal, true) => (Relation::Zero, false),
        (Comparison::Equal, false) => (Relation::NonZero, false),
        (Comparison::Greater, false) => (Relation::NonNegative, true),
        (Comparison::GreaterEqual, false) => (Relation::Positive, true),
        (Comparison::Less, false) => (Relation::NonNegative, false),
        (Comparison::LessEqual, false) => (Relation::Positive, false),
    }
}

impl Formula {
    pub(crate) fn always() -> Self {
        Self::And(Vec::new())
    }

    /// The normal form of `condition`, or of its negation.
    pub(crate) fn of(
        condition: &Condition,
        positive: bool,
        origin: Origin,
        universe: &mut Universe<'_>,
    ) -> Result<Self, GroundError> {
        let unsupported = |feature| Err(GroundError::Unsupported { feature, origin, span: condition.span });
        let all = |parts: &[Condition], positive, universe: &mut Universe<'_>| {
            parts.iter().map(|p| Self::of(p, positive, origin, universe)).collect::<Result<Vec<_>, _>>()
        };
        Ok(match (&condition.kind, positive) {
            (ConditionKind::And(parts), true) => Self::and(all(parts, true, universe)?),
            (ConditionKind::And(parts), false) => Self::or(all(parts, false, universe)?),
            (ConditionKind::Or(parts), true) => Self::or(all(parts, true, universe)?),
            (ConditionKind::Or(parts), false) => Self::and(all(parts, false, universe)?),
            (ConditionKind::Not(inner), _) => Self::of(inner, !positive, origin, universe)?,
            (ConditionKind::Imply(left, right), true) => Self::or(vec![
                Self::of(left, false, origin, universe)?,
                Self::of(right, true, origin, universe)?,
            ]),
            (ConditionKind::Imply(left, right), false) => Self::and(vec![
                Self::of(left, true, origin, universe)?,
                Self::of(right, false, origin, universe)?,
            ]),
            (ConditionKind::Exists(vs, inner), true) | (ConditionKind::Forall(vs, inner), false) => {
                Self::exists(vs.clone(), Self::of(inner, positive, origin, universe)?)
            }
            (ConditionKind::Exists(vs, inner), false) | (ConditionKind::Forall(vs, inner), true) => {
                Self::forall(vs.clone(), Self::of(inner, positive, origin, universe)?)
            }
            (ConditionKind::Atom(atom), _) => Self::Literal(Literal {
                positive,
                predicate: atom.predicate,
                arguments: atom.arguments.clone().into(),
            }),
            (&ConditionKind::Same(left, right), _) => Self::Same { positive, left, right },
            (ConditionKind::HasType(term, types), _) => {
                Self::OneOf { positive, term: *term, extent: universe.extent(types) }
            }
            (ConditionKind::Compare(comparison, left, right), _) => {
                let (relation, swapped) = relation(*comparison, positive);
                let (left, right) = if swapped { (right, left) } else { (left, right) };
                let share = |side: &Expression| Arc::new(side.clone());
                Self::Compare { relation, left: share(left), right: share(right) }
            }
            // Object fluents were compiled to atoms before.
            (ConditionKind::FluentIs(..), _) => return unsupported(Feature::OutsideTheModel),
        })
    }

    pub(crate) fn and(parts: Vec<Self>) -> Self {
        let mut flat = Vec::with_capacity(parts.len());
        for part in parts {
            match part {
                Self::And(inner) => flat.extend(inner),
                Self::Or(inner) if inner.is_empty() => return Self::Or(inner),
                other => flat.push(other),
            }
        }
        // Cheap tests come first: a false literal saves the expansion of a quantifier.
        flat.sort_by_key(Self::rank);
        if flat.len() == 1 { flat.remove(0) } else { Self::And(flat) }
    }

    fn or(parts: Vec<Self>) -> Self {
        let mut flat = Vec::with_capacity(parts.len());
        for part in parts {
            match part {
                Self::Or(inner) => flat.extend(inner),
                Self::And(inner) if inner.is_empty() => return Self::And(inner),
                other => flat.push(other),
            }
        }
        flat.sort_by_key(Self::rank);
        if flat.len() == 1 { flat.remove(0) } else { Self::Or(flat) }
    }

    fn rank(&self) -> u8 {
        match self {
            Self::Same { .. } | Self::OneOf { .. } => 0,
            Self::Literal(_) | Self::Compare { .. } => 1,
            Self::And(_) => 2,
            Self::Or(_) => 3,
            Self::Exists(..) => 4,
            Self::Forall(..) => 5,
        }
    }

    /// Removes existential quantifiers from the top and returns the rest. Only the first group of
    /// connected variables is hoisted: joining independent groups would multiply their bindings,
    /// and under a quantifier they only add up.
    pub(crate) fn hoisted(self, variables: &mut Vec<VariableId>) -> Self {
        let mut own = Vec::new();
        let inner = self.pulled(&mut own);
        let parts = if let Self::And(parts) = inner { parts } else { vec![inner] };
        let (mut groups, mut rest) = components(own, parts);
        if !groups.is_empty() {
            let (taken, parts) = groups.remove(0);
            variables.extend(taken);
            rest.extend(parts);
        }
        rest.extend(groups.into_iter().map(|(vs, parts)| Self::Exists(vs, Box::new(Self::and(parts)))));
        Self::and(rest)
    }

    /// `exists`, one for each group of connected variables.
    fn exists(vs: Vec<VariableId>, inner: Self) -> Self {
        let parts = if let Self::And(parts) = inner { parts } else { vec![inner] };
        let (groups, mut all) = components(vs, parts);
        all.extend(groups.into_iter().map(|(vs, parts)| Self::Exists(vs, Box::new(Self::and(parts)))));
        Self::and(all)
    }

    /// `forall`, one for each group of connected variables.
    fn forall(vs: Vec<VariableId>, inner: Self) -> Self {
        let parts = if let Self::Or(parts) = inner { parts } else { vec![inner] };
        let (groups, mut all) = components(vs, parts);
        all.extend(groups.into_iter().map(|(vs, parts)| Self::Forall(vs, Box::new(Self::or(parts)))));
        Self::or(all)
    }

    fn pulled(self, variables: &mut Vec<VariableId>) -> Self {
        match self {
            Self::Exists(vs, inner) => {
                variables.extend(vs);
                inner.pulled(variables)
            }
            Self::And(parts) => Self::and(parts.into_iter().map(|p| p.pulled(variables)).collect()),
            other => other,
        }
    }

    /// Appends the variables that it mentions, with repetitions.
    fn mention(&self, variables: &mut Vec<VariableId>) {
        let mut term = |t: &Term| {
            if let Term::Variable(v) = t {
                variables.push(*v);
            }
        };
        match self {
            Self::And(parts) | Self::Or(parts) => parts.iter().for_each(|p| p.mention(variables)),
            Self::Exists(_, inner) | Self::Forall(_, inner) => inner.mention(variables),
            Self::Literal(literal) => literal.arguments.iter().for_each(term),
            Self::Same { left, right, .. } => [left, right].into_iter().for_each(term),
            Self::OneOf { term: of, .. } => term(of),
            Self::Compare { left, right, .. } => {
                for side in [left, right] {
                    side.each(&mut |part| {
                        if let ExpressionKind::Fluent(fluent) = &part.kind {
                            fluent.arguments.iter().for_each(&mut term);
                        }
                    });
                }
            }
        }
    }

    /// Disjuncts whose disjunction is the formula. Disjunctions at the top are multiplied out up to
    /// `limit` disjuncts; beyond that they stay nested.
    pub(crate) fn disjuncts(self, limit: usize) -> Vec<Self> {
        match self {
            Self::Or(parts) => parts.into_iter().flat_map(|p| p.disjuncts(limit)).collect(),
            Self::Exists(vs, inner) => {
                inner.disjuncts(limit).into_iter().map(|f| Self::Exists(vs.clone(), Box::new(f))).collect()
            }
            Self::And(parts) => {
                let mut rows: Vec<Vec<Self>> = vec![Vec::new()];
                for part in parts {
                    let options = match &part {
                        Self::Or(_) | Self::And(_) | Self::Exists(..) => part.clone().disjuncts(limit),
                        _ => Vec::new(),
                    };
                    if options.len() < 2 || options.len() * rows.len() > limit {
                        rows.iter_mut().for_each(|row| row.push(part.clone()));
                        continue;
                    }
                    rows = rows
                        .iter()
                        .flat_map(|row| {
                            options.iter().map(|o| {
                                let mut longer = row.clone();
                                longer.push(o.clone());
                                longer
                            })
                        })
                        .collect();
                }
                rows.into_iter().map(Self::and).collect()
            }
            other => vec![other],
        }
    }

    /// Whether it is a literal or a test.
    pub(crate) fn is_flat(&self) -> bool {
        matches!(self, Self::Literal(_) | Self::Same { .. } | Self::OneOf { .. })
    }

    /// The number of literals and tests in it.
    pub(crate) fn leaves(&self) -> usize {
        match self {
            Self::And(parts) | Self::Or(parts) => parts.iter().map(Self::leaves).sum(),
            Self::Exists(_, inner) | Self::Forall(_, inner) => inner.leaves(),
            Self::Literal(_) | Self::Same { .. } | Self::OneOf { .. } | Self::Compare { .. } => 1,
        }
    }

    /// Whether its structure alone shows that it never holds.
    pub(crate) fn is_refuted(&self) -> bool {
        self.conjuncts().iter().any(|c| matches!(c, Self::Or(parts) if parts.is_empty()))
    }

    /// The conjuncts of the top level.
    pub(crate) fn conjuncts(&self) -> &[Self] {
        match self {
            Self::And(parts) => parts,
            other => std::slice::from_ref(other),
        }
    }
}

/// Variables, and the parts that mention them.
type Component = (Vec<VariableId>, Vec<Formula>);

/// Groups of connected variables, each with the parts that mention them; and the parts that mention
/// none. Splitting a quantifier over these groups replaces a product by a sum.
fn components(variables: Vec<VariableId>, parts: Vec<Formula>) -> (Vec<Component>, Vec<Formula>) {
    let mut groups: Vec<Component> = variables.into_iter().map(|v| (vec![v], Vec::new())).collect();
    let mut rest = Vec::new();
    for part in parts {
        let mut mentioned = Vec::new();
        part.mention(&mut mentioned);
        let touched = |group: &Component| group.0.iter().any(|v| mentioned.contains(v));
        let Some(at) = groups.iter().position(touched) else {
            rest.push(part);
            continue;
        };
        // The part connects several groups: merge the others into the first.
        let (joined, apart): (Vec<_>, Vec<_>) = groups.drain(at + 1..).partition(touched);
        groups.extend(apart);
        for (vs, parts) in joined {
            groups[at].0.extend(vs);
            groups[at].1.extend(parts);
        }
        groups[at].1.push(part);
    }
    (groups, rest)
}
