//! `(:constraints …)` of domains and problems: conditions on all states of a plan.
//!
//! The modal operators are ordinary words elsewhere, and here too if their argument is not a list. A
//! condition without a modal operator is about one state, and needs an operator around it that says which
//! states.

use super::body::Body;
use super::keys::Keys;
use super::sink::{Sink, first_word};
use super::world::World;
use crate::diagnostic::DiagnosticKind;
use crate::model::{Constraint, ConstraintKind, Constraints, VariableId};
use crate::syntax::{Node, NodeKind};
use crate::{Decimal, NotADecimal};

const OPERATORS: &[&str] = &[
    "always",
    "sometime",
    "within",
    "at-most-once",
    "sometime-after",
    "sometime-before",
    "always-within",
    "hold-during",
    "hold-after",
];

/// Whether a constraint stands inside a modal operator.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Below {
    Nothing,
    Operator,
}

/// Whether the word is a modal operator.
pub(super) fn is_modal(head: Node<'_>) -> bool {
    OPERATORS.iter().any(|operator| head.is(operator))
}

pub(crate) fn constraints<'t>(
    world: &World,
    sink: &mut Sink,
    sections: impl Iterator<Item = Node<'t>>,
    global: impl Iterator<Item = Node<'t>>,
) -> Constraints {
    let mut body = Body::new(world, sink);
    let mut constraints = Constraints::default();
    let mut found = Vec::new();
    for section in sections {
        let Some([node]) = body.parts(section, "`(:constraints CONSTRAINT)`") else { continue };
        body.hard_constraints(node, &mut constraints.hard);
        found.extend(body.preferences_in(node));
    }
    for section in global {
        constraints.hard.extend(body.global(section));
    }
    for found in found {
        let read = |body: &mut Body<'_>, node| body.constraint(node, Below::Nothing);
        constraints.preferences.extend(body.preference(&found, read));
    }
    constraints.variables = body.schema.variables;
    constraints
}

impl Body<'_> {
    /// `(:constraint NAME :parameters (…) :condition …)` of some planners for PDDL+: it must hold in all
    /// states.
    fn global(&mut self, section: Node<'_>) -> Option<Constraint> {
        let named = section.children().nth(1).is_some_and(Node::is_name);
        let rest = section.children().skip(1 + usize::from(named));
        let keys = Keys::read(self.sink, rest, "a constraint", &[":parameters", ":condition"]);
        let span = section.span();
        self.schema.scope = span;
        let bound = match keys.get(":parameters") {
            Some(node) => self.schema.bind(self.world, self.sink, node.children()),
            None => Vec::new(),
        };
        let condition = match keys.get(":condition") {
            Some(node) => Some(self.condition(node)),
            None => {
                self.sink.missing(section, "the constraint", "`:condition`");
                None
            }
        };
        self.schema.unbind(bound.len());
        let holds = Constraint { kind: ConstraintKind::Holds(condition?), span };
        let always = Constraint { kind: ConstraintKind::Always(Box::new(holds)), span };
        Some(match bound.is_empty() {
            true => always,
            false => Constraint { kind: ConstraintKind::Forall(bound, Box::new(always)), span },
        })
    }

    /// Appends the parts of the conjunction at the top that are not preferences.
    fn hard_constraints(&mut self, node: Node<'_>, into: &mut Vec<Constraint>) {
        if self.is_soft(node) || node.is_list() && node.head().is_none() {
            return;
        }
        if node.is_headed("and") {
            for part in node.children().skip(1) {
                self.hard_constraints(part, into);
            }
        } else if self.preferences_in(node).is_empty() {
            into.extend(self.constraint(node, Below::Nothing));
        } else if let Some((bound, inner)) = self.quantifier(node) {
            let mut parts = Vec::new();
            self.hard_constraints(inner, &mut parts);
            self.schema.unbind(bound.len());
            let span = node.span();
            let inner = match parts.pop() {
                Some(only) if parts.is_empty() => only,
                last => {
                    parts.extend(last);
                    Constraint { kind: ConstraintKind::And(parts), span }
                }
            };
            into.push(Constraint { kind: ConstraintKind::Forall(bound, Box::new(inner)), span });
        }
    }

    /// A constraint with no operator around it.
    pub(super) fn whole_constraint(&mut self, node: Node<'_>) -> Option<Constraint> {
        self.constraint(node, Below::Nothing)
    }

    fn constraint(&mut self, node: Node<'_>, below: Below) -> Option<Constraint> {
        let kind = if self.holds_operator(node) {
            self.constraint_kind(node, below)?
        } else if below == Below::Operator {
            ConstraintKind::Holds(self.condition(node))
        } else {
            self.condition(node);
            if node.is_list() {
                self.sink.report(first_word(node), DiagnosticKind::BareCondition);
            }
            return None;
        };
        Some(Constraint { kind, span: node.span() })
    }

    /// Whether a modal operator stands in `node`.
    fn holds_operator(&self, node: Node<'_>) -> bool {
        self.is_operator(node) || node.children().any(|part| self.holds_operator(part))
    }

    fn is_operator(&self, node: Node<'_>) -> bool {
        let Some(head) = node.head() else { return false };
        let about_a_list = node.children().skip(1).last().is_some_and(Node::is_list);
        if head.is("at") {
            return about_a_list && node.children().nth(1).is_some_and(|when| when.is("end"));
        }
        is_modal(head) && (about_a_list || self.world.predicate(head.text()).is_none())
    }

    fn constraint_kind(&mut self, node: Node<'_>, below: Below) -> Option<ConstraintKind> {
        use ConstraintKind as Kind;
        let head = node.head()?;
        if !self.is_operator(node) {
            return self.connective(node, head, below);
        }
        Some(match () {
            () if head.is("at") => {
                let [_, what] = self.parts(node, "`(at end CONDITION)`")?;
                Kind::AtEnd(self.operand(what)?)
            }
            () if head.is("always") => Kind::Always(self.only_operand(node)?),
            () if head.is("sometime") => Kind::Sometime(self.only_operand(node)?),
            () if head.is("at-most-once") => Kind::AtMostOnce(self.only_operand(node)?),
            () if head.is("within") => {
                let [time, what] = self.parts(node, "`(within SECONDS CONDITION)`")?;
                let (time, what) = (self.seconds(time), self.operand(what));
                Kind::Within(time?, what?)
            }
            () if head.is("hold-after") => {
                let [time, what] = self.parts(node, "`(hold-after SECONDS CONDITION)`")?;
                let (time, what) = (self.seconds(time), self.operand(what));
                Kind::HoldAfter(time?, what?)
            }
            () if head.is("hold-during") => {
                let [from, to, what] = self.parts(node, "`(hold-during SECONDS SECONDS CONDITION)`")?;
                let (from, to, what) = (self.seconds(from), self.seconds(to), self.operand(what));
                Kind::HoldDuring(from?, to?, what?)
            }
            () if head.is("always-within") => {
                let [time, if_, then] = self.parts(node, "`(always-within SECONDS CONDITION CONDITION)`")?;
                let (time, if_, then) = (self.seconds(time), self.operand(if_), self.operand(then));
                Kind::AlwaysWithin(time?, if_?, then?)
            }
            () => {
                let [if_, then] = self.parts(node, "two conditions")?;
                let (if_, then) = (self.operand(if_), self.operand(then));
                match head.is("sometime-after") {
                    true => Kind::SometimeAfter(if_?, then?),
                    false => Kind::SometimeBefore(if_?, then?),
                }
            }
        })
    }

    fn operand(&mut self, node: Node<'_>) -> Option<Box<Constraint>> {
        self.constraint(node, Below::Operator).map(Box::new)
    }

    fn only_operand(&mut self, node: Node<'_>) -> Option<Box<Constraint>> {
        let [what] = self.parts(node, "one condition")?;
        self.operand(what)
    }

    fn connective(&mut self, node: Node<'_>, head: Node<'_>, below: Below) -> Option<ConstraintKind> {
        match () {
            () if head.is("and") => self.all_of(node, below).map(ConstraintKind::And),
            () if head.is("or") => self.all_of(node, below).map(ConstraintKind::Or),
            () if head.is("not") => {
                let [inner] = self.parts(node, "`(not CONSTRAINT)`")?;
                self.constraint(inner, below).map(|c| ConstraintKind::Not(Box::new(c)))
            }
            () if head.is("imply") => {
                let [if_, then] = self.parts(node, "`(imply CONSTRAINT CONSTRAINT)`")?;
                let (if_, then) = (self.constraint(if_, below), self.constraint(then, below));
                Some(ConstraintKind::Imply(Box::new(if_?), Box::new(then?)))
            }
            () if head.is("forall") => self.quantified_constraint(node, below, ConstraintKind::Forall),
            () if head.is("exists") => self.quantified_constraint(node, below, ConstraintKind::Exists),
            () if self.is_preference(node) => {
                self.misplaced_preference(node);
                None
            }
            () => {
                self.sink.unexpected(node, "a constraint such as `(always (p ?x))`");
                None
            }
        }
    }

    fn all_of(&mut self, node: Node<'_>, below: Below) -> Option<Vec<Constraint>> {
        let parts: Vec<_> = node.children().skip(1).map(|part| self.constraint(part, below)).collect();
        parts.into_iter().collect()
    }

    fn quantified_constraint(
        &mut self,
        node: Node<'_>,
        below: Below,
        make: fn(Vec<VariableId>, Box<Constraint>) -> ConstraintKind,
    ) -> Option<ConstraintKind> {
        let (bound, inner) = self.quantifier(node)?;
        let inner = self.constraint(inner, below);
        self.schema.unbind(bound.len());
        Some(make(bound, Box::new(inner?)))
    }

    /// A time or a duration: a number that is not negative.
    pub(super) fn seconds(&mut self, node: Node<'_>) -> Option<Decimal> {
        let number = match node.kind() {
            NodeKind::Number => node.text().parse::<Decimal>(),
            _ => Err(NotADecimal::Malformed),
        };
        match number {
            Ok(value) if value.is_negative() => {
                self.sink.report(node.span(), DiagnosticKind::NegativeTime { what: "time", value });
                None
            }
            Ok(value) => Some(value),
            Err(NotADecimal::Malformed) => {
                self.sink.unexpected(node, "a number of seconds");
                None
            }
            Err(NotADecimal::TooLong) => {
                self.sink.unexpected(node, "a number of fewer digits");
                None
            }
        }
    }
}
