//! Compiling a pattern: terms become slots, and parts that the vocabulary can never satisfy are rejected.

use std::sync::Arc;

use super::compiled::{Constant, Pattern};
use super::plan::plan;
use super::slot::{Mask, SLOTS, Slot};
use super::source::{Atom, Carrier, Conjunction, Limit, PatternSource, Right};
use super::term::{Comparison, Scope, Term, Threshold, Variable};
use super::{measure, part, seed};
use crate::id::{AttributeId, LabelId, TypeId};
use crate::mentions::Mentions;
use crate::value::{Kind, Value};
use crate::vocabulary::{HolderType, Nature, Vocabulary};

type Name = Arc<str>;

/// Why a pattern cannot be compiled.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the fields are the names that the variant is about")]
pub enum PatternError {
    /// Too many variables and constants.
    #[error("a pattern may have {SLOTS} variables and constants, not {count}")]
    TooLarge { count: usize },
    /// Too many atoms, or negated parts that nest too deeply.
    #[error("a pattern may have {ATOMS} atoms, and negated parts {DEEPEST} deep")]
    TooManyParts,
    /// A number that is infinite or not a number.
    #[error("attribute '{attribute}' is held against a number that is not finite")]
    NotFinite { attribute: Name },
    /// The vocabulary has no such type.
    #[error("no type {id}")]
    UnknownType { id: TypeId },
    /// The vocabulary has no such label.
    #[error("no label {id}")]
    UnknownLabel { id: LabelId },
    /// The vocabulary has no such attribute.
    #[error("no attribute {id}")]
    UnknownAttribute { id: AttributeId },
    /// A local variable outside of the negated part that declares it, or a variable of another pattern.
    #[error("a variable is used outside its part")]
    OutOfScope { variable: Variable },
    /// A variable that no part declares, or more than one, or the wrong one. A builder never does this.
    #[error("a variable is not declared once, in its own part")]
    Misdeclared { variable: Variable },
    /// No signature of the label allows these types.
    #[error("'{label}' never goes from a '{from}' to a '{to}'")]
    WrongSignature { label: Name, from: Name, to: Name },
    /// The attribute is declared for other holders.
    #[error("attribute '{attribute}' is never there")]
    WrongHolder { attribute: Name },
    /// The two sides cannot be compared in this way.
    #[error("attribute '{attribute}' is a {kind}, it cannot be compared so")]
    WrongKind { attribute: Name, kind: Kind },
    /// A threshold that is not a finite number, or a threshold to disappear that is stricter than the one to appear.
    #[error("invalid threshold: appears at {}, disappears at {}", threshold.appears, threshold.disappears)]
    WrongThreshold { threshold: Threshold },
    /// A node of two types, neither of which is a subtype of the other.
    #[error("a '{first}' is never a '{second}'")]
    Disjoint { first: Name, second: Name },
    /// A metric to a node that has no pose.
    #[error("a '{node_type}' is never geometric")]
    NotGeometric { node_type: Name },
}

/// The most atoms in a pattern, including its negated parts: matching recurses once for each.
const ATOMS: usize = 1_024;

/// The deepest nesting of negated parts.
const DEEPEST: usize = 64;

/// Checks the size before any recursion over the parts.
fn bounded(body: &Conjunction<Term>) -> Result<(), PatternError> {
    let (mut atoms, mut parts) = (0, vec![(body, 0)]);
    while let Some((part, depth)) = parts.pop() {
        atoms += part.atoms.len();
        if atoms > ATOMS || depth > DEEPEST {
            return Err(PatternError::TooManyParts);
        }
        parts.extend(part.atoms.iter().filter_map(|atom| match atom {
            Atom::Without(inner) => Some((inner, depth + 1)),
            _ => None,
        }));
    }
    Ok(())
}

impl PatternSource {
    /// Checks the pattern against a vocabulary and compiles it.
    pub fn build(self, vocabulary: &Vocabulary) -> Result<Pattern, PatternError> {
        compile(vocabulary, self)
    }
}

fn compile(vocabulary: &Vocabulary, source: PatternSource) -> Result<Pattern, PatternError> {
    bounded(&source.body)?;
    let (variables, locals) = (source.variables.clone(), source.locals.clone());
    let count = variables.len() + locals.len();
    if count > SLOTS {
        return Err(PatternError::TooLarge { count });
    }
    let types: Vec<_> = variables.iter().map(|(_, id)| *id).chain(locals.iter().copied()).collect();
    let mut mentions = Mentions::default();
    for &id in &types {
        vocabulary.type_name(id).ok_or(PatternError::UnknownType { id })?;
        vocabulary.types().filter(|&sub| vocabulary.is_a(sub, id)).for_each(|sub| mentions.add_type(sub));
    }
    let mut checker = Checker {
        vocabulary,
        types,
        tops: variables.len(),
        constants: Vec::new(),
        visible: Mask::default(),
        declared: Mask::default(),
        depth: 0,
        mentions,
        remembers: false,
    };
    let body = checker.conjunction(&source.body)?;
    checker.all_declared()?;
    let Checker { types, constants, mut mentions, remembers, .. } = checker;
    let count = types.len() + constants.len();
    if count > SLOTS {
        return Err(PatternError::TooLarge { count });
    }
    if !constants.is_empty() {
        // The node of a constant may be added or removed, and its type is not known here.
        vocabulary.types().for_each(|id| mentions.add_type(id));
    }
    let mut bound = Mask::default();
    (types.len()..count).for_each(|slot| bound.insert(slot_at(slot)));
    let order = plan(&body, bound);
    let type_of = |slot: Slot| types.get(usize::from(slot.0)).copied();
    let parts = part::parts(&body, bound, &type_of, vocabulary);
    (0..variables.len()).for_each(|slot| bound.insert(slot_at(slot)));
    let judgement = plan(&body, bound);
    let (seeds, mut measured) = (seed::seedlings(&body), Vec::new());
    measure::measured(&body, &type_of, vocabulary, &mut measured);
    Ok(Pattern {
        source: Arc::new(source),
        variables,
        locals,
        constants,
        body,
        seeds,
        measured,
        parts,
        plan: order,
        judgement,
        mentions,
        remembers,
    })
}

fn slot_at(index: usize) -> Slot {
    Slot(u8::try_from(index).unwrap_or(u8::MAX))
}

struct Checker<'d> {
    vocabulary: &'d Vocabulary,
    /// The types of the variables, by slot.
    types: Vec<TypeId>,
    tops: usize,
    constants: Vec<Constant>,
    /// The variables that are visible here.
    visible: Mask,
    /// The variables that have been declared so far.
    declared: Mask,
    /// The number of parts around the present one.
    depth: usize,
    mentions: Mentions,
    remembers: bool,
}

impl Checker<'_> {
    fn conjunction(&mut self, part: &Conjunction<Term>) -> Result<Conjunction<Slot>, PatternError> {
        let outside = self.visible;
        let mut variables = Vec::new();
        for term in &part.variables {
            if let Term::Variable(variable) = term {
                let slot = self.slot_of(*variable)?;
                if self.declared.contains(slot) || (variable.scope == Scope::Top) != (self.depth == 0) {
                    return Err(PatternError::Misdeclared { variable: *variable });
                }
                self.declared.insert(slot);
                self.visible.insert(slot);
                variables.push(slot);
            }
        }
        self.depth += 1;
        let mut atoms = part.atoms.iter().map(|atom| self.atom(atom)).collect::<Result<Vec<_>, _>>()?;
        self.depth -= 1;
        atoms.retain(|atom| !self.says_nothing(atom));
        self.visible = outside;
        Ok(Conjunction { variables, atoms })
    }

    fn atom(&mut self, atom: &Atom<Term>) -> Result<Atom<Slot>, PatternError> {
        Ok(match atom {
            Atom::Edge { from, label, to } => {
                let (from, to) = self.edge(from, *label, to)?;
                Atom::Edge { from, label: *label, to }
            }
            Atom::Present { holder, attribute } => {
                Atom::Present { holder: self.carrier(holder, *attribute)?, attribute: *attribute }
            }
            Atom::Guard { holder, attribute, comparison, operand } => {
                let holder = self.carrier(holder, *attribute)?;
                let operand = self.operand(*attribute, *comparison, operand)?;
                Atom::Guard { holder, attribute: *attribute, comparison: *comparison, operand }
            }
            Atom::Distinct(a, b) => Atom::Distinct(self.term(a)?, self.term(b)?),
            Atom::IsA(node, id) => {
                // The type of a node never changes. So this atom changes only when nodes are added or removed, and the
                // mentions already include the types of the variables, and all types if the pattern has constants.
                self.vocabulary.type_name(*id).ok_or(PatternError::UnknownType { id: *id })?;
                let slot = self.term(node)?;
                if let Some(declared) = self.type_of(slot).filter(|_| !self.may_be(slot, *id)) {
                    let (first, second) = (self.type_name(declared), self.type_name(*id));
                    return Err(PatternError::Disjoint { first, second });
                }
                Atom::IsA(slot, *id)
            }
            Atom::Metric { metric, from, to, comparison, limit } => {
                self.limit(from, *comparison, *limit)?;
                let (from, to) = (self.term(from)?, self.term(to)?);
                for slot in [from, to] {
                    if let Some(id) = self.type_of(slot)
                        && !self.maybe_geometric(id)
                    {
                        return Err(PatternError::NotGeometric { node_type: self.type_name(id) });
                    }
                }
                self.mentions.add_transforms();
                Atom::Metric { metric: *metric, from, to, comparison: *comparison, limit: *limit }
            }
            Atom::Without(part) => Atom::Without(self.conjunction(part)?),
        })
    }

    /// Whether the atom gives a variable a type that it has anyway.
    fn says_nothing(&self, atom: &Atom<Slot>) -> bool {
        matches!(*atom, Atom::IsA(slot, id) if self.type_of(slot).is_some_and(|own| self.vocabulary.is_a(own, id)))
    }

    /// Checks the right-hand side of a metric.
    fn limit(&mut self, from: &Term, comparison: Comparison, limit: Limit) -> Result<(), PatternError> {
        match limit {
            Limit::Threshold(threshold) => {
                let Threshold { appears, disappears } = threshold;
                let ordered = match comparison {
                    Comparison::Less | Comparison::LessOrEqual => appears <= disappears,
                    Comparison::Greater | Comparison::GreaterOrEqual => appears >= disappears,
                    Comparison::Equal | Comparison::NotEqual => appears == disappears,
                };
                // Equal thresholds have no hysteresis.
                self.remembers |= appears != disappears;
                let finite = appears.is_finite() && disappears.is_finite();
                if ordered && finite { Ok(()) } else { Err(PatternError::WrongThreshold { threshold }) }
            }
            Limit::Attribute(attribute) => {
                self.carrier(&Carrier::Node(from.clone()), attribute)?;
                match (self.vocabulary.kind(attribute), self.vocabulary.attribute_name(attribute)) {
                    (Some(kind), Some(name)) if kind != Kind::Number => {
                        Err(PatternError::WrongKind { attribute: name.clone(), kind })
                    }
                    _ => Ok(()),
                }
            }
        }
    }

    fn edge(&mut self, from: &Term, label: LabelId, to: &Term) -> Result<(Slot, Slot), PatternError> {
        let name = self.vocabulary.label_name(label).ok_or(PatternError::UnknownLabel { id: label })?.clone();
        let (from, to) = (self.term(from)?, self.term(to)?);
        let (start, end) = (self.type_of(from), self.type_of(to));
        let signatures = self.vocabulary.signatures(label);
        if !signatures.iter().any(|s| self.may_be(from, s.from) && self.may_be(to, s.to)) {
            let name_of = |id: Option<TypeId>| id.map_or_else(|| "constant".into(), |id| self.type_name(id));
            return Err(PatternError::WrongSignature { label: name, from: name_of(start), to: name_of(end) });
        }
        self.mentions.add_label(label);
        Ok((from, to))
    }

    fn carrier(
        &mut self,
        holder: &Carrier<Term>,
        attribute: AttributeId,
    ) -> Result<Carrier<Slot>, PatternError> {
        let unknown = PatternError::UnknownAttribute { id: attribute };
        let (Some(name), Some(declared)) =
            (self.vocabulary.attribute_name(attribute).cloned(), self.vocabulary.holder(attribute))
        else {
            return Err(unknown);
        };
        self.mentions.add_attribute(attribute);
        let wrong = PatternError::WrongHolder { attribute: name };
        match holder {
            Carrier::Node(node) => {
                let slot = self.term(node)?;
                if !matches!(declared, HolderType::Node(on) if self.may_be(slot, on)) {
                    return Err(wrong);
                }
                Ok(Carrier::Node(slot))
            }
            Carrier::Edge { from, label, to } => {
                let (from, to) = self.edge(from, *label, to)?;
                let fits = matches!(declared, HolderType::Edge { label: on, signature }
                    if on == *label && self.may_be(from, signature.from) && self.may_be(to, signature.to));
                if !fits {
                    return Err(wrong);
                }
                Ok(Carrier::Edge { from, label: *label, to })
            }
        }
    }

    fn operand(
        &mut self,
        attribute: AttributeId,
        comparison: Comparison,
        operand: &Right<Term>,
    ) -> Result<Right<Slot>, PatternError> {
        let vocabulary = self.vocabulary;
        let unknown = PatternError::UnknownAttribute { id: attribute };
        let (Some(name), Some(kind)) = (vocabulary.attribute_name(attribute), vocabulary.kind(attribute))
        else {
            return Err(unknown);
        };
        let ordered = !matches!(comparison, Comparison::Equal | Comparison::NotEqual);
        let wrong = || PatternError::WrongKind { attribute: name.clone(), kind };
        if ordered && kind != Kind::Number {
            return Err(wrong());
        }
        match operand {
            Right::Value(Value::Number(number)) if kind == Kind::Number && !number.is_finite() => {
                Err(PatternError::NotFinite { attribute: name.clone() })
            }
            Right::Value(value) => match (kind, value) {
                (Kind::Number, Value::Number(_))
                | (Kind::Text, Value::Text(_))
                | (Kind::Bool, Value::Bool(_))
                | (Kind::Node(_), Value::Node(_)) => Ok(Right::Value(value.clone())),
                _ => Err(wrong()),
            },
            Right::Term(term) => {
                let slot = self.term(term)?;
                match (kind, self.type_of(slot)) {
                    (Kind::Node(_), None) => Ok(Right::Term(slot)),
                    (Kind::Node(target), Some(id)) if vocabulary.overlap(target, id) => Ok(Right::Term(slot)),
                    _ => Err(wrong()),
                }
            }
            Right::Attribute(holder, other) => {
                let holder = self.carrier(holder, *other)?;
                match (kind, vocabulary.kind(*other)) {
                    (Kind::Node(_), Some(Kind::Node(_))) => {}
                    (kind, Some(other)) if kind == other => {}
                    _ => return Err(wrong()),
                }
                Ok(Right::Attribute(holder, *other))
            }
        }
    }

    /// The slot of a term that is visible here.
    fn term(&mut self, term: &Term) -> Result<Slot, PatternError> {
        let constant = match term {
            Term::Variable(variable) => {
                let slot = self.slot_of(*variable)?;
                if self.visible.contains(slot) {
                    return Ok(slot);
                }
                return Err(PatternError::OutOfScope { variable: *variable });
            }
            Term::Node(id) => Constant::Node(*id),
            Term::Named(name) => Constant::Named(name.clone()),
        };
        let same = |other: &Constant| match (&constant, other) {
            (Constant::Node(a), Constant::Node(b)) => a == b,
            (Constant::Named(a), Constant::Named(b)) => a == b,
            _ => false,
        };
        let at = self.constants.iter().position(same).unwrap_or_else(|| {
            self.constants.push(constant.clone());
            self.constants.len() - 1
        });
        let index = self.types.len() + at;
        if index >= SLOTS { Err(PatternError::TooLarge { count: index + 1 }) } else { Ok(slot_at(index)) }
    }

    /// The slot of a variable, unless it belongs to another, larger pattern.
    fn slot_of(&self, variable: Variable) -> Result<Slot, PatternError> {
        let index = usize::from(variable.index);
        let (slot, end) = match variable.scope {
            Scope::Top => (index, self.tops),
            Scope::Local => (self.tops + index, self.types.len()),
        };
        if slot < end { Ok(slot_at(slot)) } else { Err(PatternError::OutOfScope { variable }) }
    }

    fn all_declared(&self) -> Result<(), PatternError> {
        let index = |index: usize| u16::try_from(index).unwrap_or(u16::MAX);
        let variable = |slot| match usize::checked_sub(slot, self.tops) {
            None => Variable { scope: Scope::Top, index: index(slot) },
            Some(local) => Variable { scope: Scope::Local, index: index(local) },
        };
        let missing = (0..self.types.len()).find(|&slot| !self.declared.contains(slot_at(slot)));
        missing.map_or(Ok(()), |slot| Err(PatternError::Misdeclared { variable: variable(slot) }))
    }

    /// The type of a variable; constants have none.
    fn type_of(&self, slot: Slot) -> Option<TypeId> {
        self.types.get(usize::from(slot.0)).copied()
    }

    /// Whether the node of the slot can be of the type. A constant can be of any type.
    fn may_be(&self, slot: Slot, node_type: TypeId) -> bool {
        self.type_of(slot).is_none_or(|id| self.vocabulary.overlap(id, node_type))
    }

    fn maybe_geometric(&self, id: TypeId) -> bool {
        let geometric = |id| self.vocabulary.nature(id) == Some(Nature::Geometric);
        self.vocabulary.types().any(|sub| self.vocabulary.is_a(sub, id) && geometric(sub))
    }

    fn type_name(&self, id: TypeId) -> Name {
        self.vocabulary.type_name(id).cloned().unwrap_or_else(|| id.to_string().into())
    }
}
