//! The smallest unsatisfied parts of a condition that does not hold.
//!
//! The walk mirrors `condition`. Of a conjunction it returns the parts that fail, of a disjunction the unsatisfied
//! parts of each branch, of a universal condition one counterexample, of an existential one the objects that come
//! closest. It runs once per failure, so it may cost more than an evaluation; the search for the closest objects is
//! bounded.

use crate::axiom::Strata;
use crate::cause::Causes;
use crate::condition::Strictness;
use crate::scene::{Binding, Scene};
use crate::value::{GroundAtom, Value};
use crate::verdict::{Near, Operand, Unsatisfied};
use pddl::Span;
use pddl::model::{
    Application, Atom, Condition, ConditionKind, Domain, Expression, ExpressionKind, Name, ObjectId, Term,
    VariableId,
};
use std::ops::ControlFlow;

/// The most axioms that are followed in a chain.
pub(crate) const DEPTH: u8 = 3;

/// The most bindings that are tried to find the closest one.
const BINDINGS_TRIED: usize = 512;

/// Explains failures in one scene.
#[derive(Clone, Copy)]
pub(crate) struct Why<'a> {
    pub(crate) domain: &'a Domain,
    pub(crate) scene: Scene<'a>,
    pub(crate) strata: &'a Strata,
    pub(crate) causes: Causes<'a>,
    /// The number of axioms that may still be followed.
    pub(crate) depth: u8,
}

impl Why<'_> {
    /// The parts that keep `condition` from being `wanted`; empty if it is.
    pub(crate) fn unsatisfied(
        &self,
        condition: &Condition,
        wanted: bool,
        binding: &mut Binding,
    ) -> Vec<Unsatisfied> {
        if self.scene.satisfied(condition, wanted, Strictness::Certain, binding) {
            return Vec::new();
        }
        let span = condition.span;
        match &condition.kind {
            ConditionKind::And(parts) | ConditionKind::Or(parts) => {
                let conjunction = matches!(condition.kind, ConditionKind::And(_)) == wanted;
                let branches = parts.iter().map(|part| self.unsatisfied(part, wanted, binding)).collect();
                combine(conjunction, branches, span)
            }
            ConditionKind::Not(part) => self.unsatisfied(part, !wanted, binding),
            ConditionKind::Imply(if_, then) => {
                let branches =
                    vec![self.unsatisfied(if_, !wanted, binding), self.unsatisfied(then, wanted, binding)];
                combine(!wanted, branches, span)
            }
            ConditionKind::Exists(variables, body) | ConditionKind::Forall(variables, body) => {
                if matches!(condition.kind, ConditionKind::Exists(..)) == wanted {
                    vec![self.no_witness(variables, body, wanted, span, binding)]
                } else {
                    vec![self.counterexample(variables, body, wanted, span, binding)]
                }
            }
            ConditionKind::Atom(atom) => vec![self.atom(atom, wanted, binding)],
            ConditionKind::HasType(term, types) => {
                vec![Unsatisfied::Type { object: binding.object(*term), types: types.clone(), wanted, span }]
            }
            ConditionKind::Same(left, right) => {
                let (left, right) = (binding.object(*left), binding.object(*right));
                vec![if wanted {
                    Unsatisfied::Different { left, right, span }
                } else {
                    Unsatisfied::Same { object: left, span }
                }]
            }
            ConditionKind::Compare(comparison, left, right) => {
                let (left, right) = (self.operand(left, binding), self.operand(right, binding));
                vec![Unsatisfied::Comparison { comparison: *comparison, wanted, left, right, span }]
            }
            ConditionKind::FluentIs(application, value) => {
                vec![self.fluent(application, *value, wanted, span, binding)]
            }
        }
    }

    fn atom(&self, atom: &Atom, wanted: bool, binding: &Binding) -> Unsatisfied {
        let arguments: Box<[_]> = atom.arguments.iter().map(|&t| binding.object(t)).collect();
        let record = self.scene.state.facts[atom.predicate].record(&arguments);
        let span = atom.span;
        let derived = self.strata.derives(atom.predicate);
        let since = record.filter(|r| r.holds != wanted).and_then(|r| self.causes.of(r.since));
        let atom = GroundAtom { predicate: atom.predicate, arguments };
        let because = if derived { self.derivation(&atom, wanted) } else { Vec::new() };
        if wanted {
            Unsatisfied::Missing { atom, deleted_by: since, derived, because, span }
        } else {
            Unsatisfied::Present { atom, added_by: since, derived, because, span }
        }
    }

    /// The parts that keep the axioms from deriving the atom (or from not deriving it), for the
    /// axiom with the fewest such parts.
    fn derivation(&self, atom: &GroundAtom, wanted: bool) -> Vec<Unsatisfied> {
        let Some(depth) = self.depth.checked_sub(1) else { return Vec::new() };
        let axioms = self.domain.axioms.iter().filter(|axiom| axiom.predicate == atom.predicate);
        let parts = axioms.map(|axiom| {
            let scene = Scene { variables: &axiom.variables, ..self.scene };
            let mut binding = Binding::new(&axiom.variables, &atom.arguments);
            let of_its_types =
                axiom.variables.parameter_ids().zip(&atom.arguments).all(|(parameter, object)| {
                    self.scene.universe.is_of(*object, &axiom.variables[parameter].types)
                });
            if of_its_types {
                Why { scene, depth, ..*self }.unsatisfied(&axiom.body, wanted, &mut binding)
            } else {
                Vec::new()
            }
        });
        parts.filter(|parts| !parts.is_empty()).min_by_key(Vec::len).unwrap_or_default()
    }

    fn fluent(
        &self,
        application: &Application,
        value: Term,
        wanted: bool,
        span: Span,
        binding: &Binding,
    ) -> Unsatisfied {
        let actual = match self.scene.fluent(application, binding) {
            Some(Value::Object(object)) => Some(object),
            _ => None,
        };
        let fluent = self.scene.ground(application, binding);
        Unsatisfied::Fluent { fluent, value: binding.object(value), wanted, actual, span }
    }

    pub(crate) fn operand(&self, expression: &Expression, binding: &Binding) -> Operand {
        let mut fluents = Vec::new();
        self.fluents(expression, binding, &mut fluents);
        Operand { value: self.scene.number(expression, binding), fluents, span: expression.span }
    }

    fn fluents(
        &self,
        expression: &Expression,
        binding: &Binding,
        into: &mut Vec<(pddl::model::GroundApplication, Option<crate::Number>)>,
    ) {
        match &expression.kind {
            ExpressionKind::Fluent(application) => {
                let value = match self.scene.fluent(application, binding) {
                    Some(Value::Number(number)) => Some(number),
                    _ => None,
                };
                into.push((self.scene.ground(application, binding), value));
            }
            ExpressionKind::Arithmetic(_, operands) => {
                for operand in operands {
                    self.fluents(operand, binding, into);
                }
            }
            ExpressionKind::Number(_)
            | ExpressionKind::Duration
            | ExpressionKind::TotalTime
            | ExpressionKind::IsViolated(_) => {}
        }
    }

    fn named(&self, variables: &[VariableId], binding: &Binding) -> Vec<(Name, ObjectId)> {
        variables
            .iter()
            .filter_map(|&v| binding.get(v).map(|object| (self.scene.variables[v].name.clone(), object)))
            .collect()
    }

    fn counterexample(
        &self,
        variables: &[VariableId],
        body: &Condition,
        wanted: bool,
        span: Span,
        binding: &mut Binding,
    ) -> Unsatisfied {
        let mut found = (Vec::new(), Vec::new());
        let guards = [(body, !wanted)];
        let flow =
            self.scene.each_binding(variables, &guards, Strictness::Possible, binding, &mut |binding| {
                found = (self.named(variables, binding), self.unsatisfied(body, wanted, binding));
                ControlFlow::Break(())
            });
        debug_assert!(
            flow.is_break() || self.scene.state.work.is_exhausted(),
            "a universal condition that does not hold has a counterexample"
        );
        Unsatisfied::Counterexample { binding: found.0, parts: found.1, span }
    }

    fn no_witness(
        &self,
        variables: &[VariableId],
        body: &Condition,
        wanted: bool,
        span: Span,
        binding: &mut Binding,
    ) -> Unsatisfied {
        let mut closest: Option<(usize, Binding)> = None;
        // Axioms are followed only for the closest binding.
        let shallow = Why { depth: 0, ..*self };
        let mut tried = 0;
        let flow = self.scene.each_binding(variables, &[], Strictness::Certain, binding, &mut |binding| {
            let parts = shallow.unsatisfied(body, wanted, binding).len();
            if closest.as_ref().is_none_or(|(best, _)| parts < *best) {
                closest = Some((parts, binding.clone()));
            }
            tried += 1;
            if tried < BINDINGS_TRIED { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
        debug_assert_eq!(flow.is_break(), tried == BINDINGS_TRIED);
        let closest = closest.map(|(_, mut binding)| Near {
            binding: self.named(variables, &binding),
            parts: self.unsatisfied(body, wanted, &mut binding),
        });
        Unsatisfied::NoWitness { closest, span }
    }
}

fn combine(conjunction: bool, mut branches: Vec<Vec<Unsatisfied>>, span: Span) -> Vec<Unsatisfied> {
    if conjunction {
        branches.into_iter().flatten().collect()
    } else if branches.len() == 1 {
        branches.remove(0)
    } else {
        vec![Unsatisfied::Alternatives { branches, span }]
    }
}
