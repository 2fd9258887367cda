//! From the typed model of an invariant to its formula.

use crate::error::{Error, ErrorKind};
use crate::formula::{Condition, ConditionId, Formula, Part, PartId, Span};
use dsr::TypeId;
use pddl::model::{
    self, Atom, ConditionKind, Constraint, ConstraintKind, Domain, Idx, Term, VariableId, Variables,
};
use rustc_hash::FxHashMap;
use smallvec::SmallVec;
use std::sync::Arc;
use vocabulary::{Link, LinkError, Located, Scope, Tokens};

/// The longest time of a constraint, in seconds.
const LONGEST: f64 = 500.0 * 365.25 * 86_400.0;

/// The conditions of all invariants; a token that several mention is one of them.
#[derive(Default)]
pub(crate) struct Conditions {
    pub(crate) all: Vec<Condition>,
    atoms: FxHashMap<String, ConditionId>,
}

impl Conditions {
    fn add(&mut self, compiled: &vocabulary::Condition, variables: usize) -> ConditionId {
        let patterns = compiled.alternatives().iter().map(|a| Arc::clone(a.pattern())).collect();
        self.all.push(Condition { patterns, variables });
        ConditionId(u32::try_from(self.all.len() - 1).expect("a text has fewer conditions than bytes"))
    }
}

/// Compiles an invariant: a formula for each conjunct at the top.
pub(crate) fn compile(
    domain: &Domain,
    invariant: &model::Invariant,
    tokens: &Tokens,
    conditions: &mut Conditions,
) -> Result<Vec<Formula>, Vec<Error>> {
    let mut formulas = Vec::new();
    let mut errors = Vec::new();
    let mut open = vec![(&invariant.constraint, invariant.variables.parameters)];
    while let Some((constraint, parameters)) = open.pop() {
        match &constraint.kind {
            ConstraintKind::And(parts) => open.extend(parts.iter().rev().map(|part| (part, parameters))),
            // Variables that are quantified at the top are parameters, so that a report names their nodes.
            ConstraintKind::Forall(bound, inner)
                if bound.first().is_some_and(|v| v.index() == parameters) =>
            {
                open.push((inner, parameters + bound.len()));
            }
            _ => match conjunct(domain, invariant, (constraint, parameters), tokens, conditions) {
                Ok(formula) => formulas.push(formula),
                Err(found) => errors.extend(found),
            },
        }
    }
    if errors.is_empty() { Ok(formulas) } else { Err(errors) }
}

fn conjunct(
    domain: &Domain,
    invariant: &model::Invariant,
    (constraint, parameters): (&Constraint, usize),
    tokens: &Tokens,
    conditions: &mut Conditions,
) -> Result<Formula, Vec<Error>> {
    let link = tokens.link(domain);
    let scope = link.scope(&invariant.variables).map_err(errors)?;
    let variables: Vec<(model::Name, Vec<TypeId>)> =
        scope.slots().iter().map(|slot| (slot.name.clone(), slot.types.clone())).collect();
    // A condition is about the variables that occur in it, not about all parameters.
    let free = Variables { slots: invariant.variables.slots.clone(), parameters: 0 };
    let bound = Variables { slots: invariant.variables.slots.clone(), parameters };
    let (parts, uses) = (Vec::new(), Vec::new());
    let mut compiler =
        Compiler { domain, link, scope, free, bound, conditions, parts, uses, errors: Vec::new(), depth: 0 };
    let (root, trigger) = compiler.root(constraint);
    if !compiler.errors.is_empty() {
        return Err(compiler.errors);
    }
    let Compiler { parts, uses, .. } = compiler;
    Ok(Formula {
        name: invariant.name.clone(),
        says: invariant.says.clone(),
        variables,
        parameters,
        trigger,
        parts,
        root,
        uses,
    })
}

fn errors(errors: Vec<LinkError>) -> Vec<Error> {
    errors.into_iter().map(|error| Located::new(error.span, error.kind.into())).collect()
}

struct Compiler<'a> {
    domain: &'a Domain,
    link: Link<'a>,
    scope: Scope,
    /// The variables, none of them a parameter.
    free: Variables,
    /// The variables with the parameters.
    bound: Variables,
    conditions: &'a mut Conditions,
    parts: Vec<Part>,
    uses: Vec<(ConditionId, SmallVec<[VariableId; 4]>)>,
    errors: Vec<Error>,
    /// How many operators stand around.
    depth: usize,
}

impl Compiler<'_> {
    fn push(&mut self, part: Part) -> PartId {
        self.parts.push(part);
        PartId(u32::try_from(self.parts.len() - 1).expect("a text has fewer parts than bytes"))
    }

    /// The whole constraint, and its trigger if it has one.
    fn root(&mut self, constraint: &Constraint) -> (PartId, Option<ConditionId>) {
        use ConstraintKind as Kind;
        let (trigger, then) = match &constraint.kind {
            Kind::Always(inner) => match &inner.kind {
                // Never its opposite.
                Kind::Holds(condition) => {
                    let span = condition.span;
                    let opposite = ConditionKind::Not(Box::new(condition.clone()));
                    let trigger = self.trigger(&model::Condition { kind: opposite, span });
                    (trigger, self.push(Part::Any(Vec::new())))
                }
                Kind::Imply(if_, then) if let Kind::Holds(condition) = &if_.kind => {
                    (self.trigger(condition), self.below(then))
                }
                _ => return (self.constraint(constraint), None),
            },
            Kind::AlwaysWithin(_, if_, then) | Kind::SometimeAfter(if_, then)
                if let Kind::Holds(condition) = &if_.kind =>
            {
                let within = match &constraint.kind {
                    Kind::AlwaysWithin(time, ..) => Some(self.time(*time, constraint.span)),
                    _ => None,
                };
                let (trigger, part) = (self.trigger(condition), self.below(then));
                (trigger, self.push(Part::Finally { within, part }))
            }
            _ => return (self.constraint(constraint), None),
        };
        let arguments = self.bound.parameter_ids().collect();
        let if_ = self.push(Part::Holds { condition: trigger, arguments });
        self.uses.push((trigger, self.bound.parameter_ids().collect()));
        let part = self.imply(if_, then);
        (self.push(Part::Globally { from: None, until: None, part }), Some(trigger))
    }

    /// A condition with a match for each binding of the parameters for which it holds.
    fn trigger(&mut self, condition: &model::Condition) -> ConditionId {
        match self.link.condition(&self.bound, [condition]) {
            Ok(compiled) => self.conditions.add(&compiled, self.bound.parameters),
            Err(found) => {
                self.errors.extend(errors(found));
                ConditionId(0)
            }
        }
    }

    fn constraint(&mut self, constraint: &Constraint) -> PartId {
        use ConstraintKind as Kind;
        let at = constraint.span;
        let part = match &constraint.kind {
            Kind::Holds(condition) => return self.condition(condition),
            Kind::And(parts) => Part::All(parts.iter().map(|part| self.constraint(part)).collect()),
            Kind::Or(parts) => Part::Any(parts.iter().map(|part| self.constraint(part)).collect()),
            Kind::Not(inner) => Part::Not(self.negated(inner)),
            Kind::Imply(if_, then) => {
                let (if_, then) = (self.negated(if_), self.constraint(then));
                return self.imply(if_, then);
            }
            Kind::Exists(variables, inner) => Part::Some(self.nodes(variables, at), self.constraint(inner)),
            Kind::Forall(variables, inner) => Part::Every(self.nodes(variables, at), self.constraint(inner)),
            Kind::AtEnd(inner) => Part::AtEnd(self.below(inner)),
            Kind::Always(inner) => Part::Globally { from: None, until: None, part: self.below(inner) },
            Kind::Sometime(inner) => Part::Finally { within: None, part: self.below(inner) },
            Kind::Within(time, inner) => {
                Part::Finally { within: Some(self.time(*time, at)), part: self.below(inner) }
            }
            Kind::AtMostOnce(inner) => Part::AtMostOnce(self.state(inner)),
            Kind::SometimeAfter(if_, then) => return self.after(if_, then, None),
            Kind::SometimeBefore(if_, then) => Part::Before(self.state(if_), self.state(then)),
            Kind::AlwaysWithin(time, if_, then) => {
                let within = self.time(*time, at);
                return self.after(if_, then, Some(within));
            }
            Kind::HoldDuring(from, until, inner) => {
                let (from, until) = (self.time(*from, at), self.time(*until, at));
                self.window(at);
                Part::Globally { from: Some(from), until: Some(until), part: self.below(inner) }
            }
            Kind::HoldAfter(from, inner) => {
                self.window(at);
                Part::Globally { from: Some(self.time(*from, at)), until: None, part: self.below(inner) }
            }
        };
        self.push(part)
    }

    fn imply(&mut self, if_: PartId, then: PartId) -> PartId {
        let not = self.push(Part::Not(if_));
        self.push(Part::Any(vec![not, then]))
    }

    /// At every moment with the first, the second from then on, within a time if there is a limit.
    fn after(&mut self, if_: &Constraint, then: &Constraint, within: Option<Span>) -> PartId {
        self.depth += 1;
        let (if_, then) = (self.negated(if_), self.constraint(then));
        self.depth -= 1;
        let then = self.push(Part::Finally { within, part: then });
        let part = self.imply(if_, then);
        self.push(Part::Globally { from: None, until: None, part })
    }

    /// An operand.
    fn below(&mut self, operand: &Constraint) -> PartId {
        self.depth += 1;
        let part = self.constraint(operand);
        self.depth -= 1;
        part
    }

    /// An operand that counts as negated: below another operator, it must be about one state.
    fn negated(&mut self, operand: &Constraint) -> PartId {
        if self.depth > 0 && !matches!(operand.kind, ConstraintKind::Holds(_)) {
            self.errors.push(Located::new(operand.span, ErrorKind::Negated));
        }
        self.constraint(operand)
    }

    fn window(&mut self, at: pddl::Span) {
        if self.depth > 0 {
            self.errors.push(Located::new(at, ErrorKind::Window));
        }
    }

    /// An operand that must be about one state.
    fn state(&mut self, operand: &Constraint) -> PartId {
        let before = self.parts.len();
        let part = self.constraint(operand);
        let temporal = |part: &Part| {
            !matches!(part, Part::Holds { .. } | Part::All(_) | Part::Any(_) | Part::Not(_))
                && !matches!(part, Part::Every(..) | Part::Some(..))
        };
        if self.parts[before..].iter().any(temporal) {
            self.errors.push(Located::new(operand.span, ErrorKind::Operator));
        }
        part
    }

    fn time(&mut self, seconds: pddl::Decimal, at: pddl::Span) -> Span {
        let seconds = seconds.to_f64();
        if seconds > LONGEST {
            self.errors.push(Located::new(at, ErrorKind::TooLong));
            return 0;
        }
        u64::try_from(std::time::Duration::from_secs_f64(seconds.max(0.0)).as_nanos()).unwrap_or(u64::MAX)
    }

    /// Quantified variables, which must stand for nodes.
    fn nodes(&mut self, variables: &[VariableId], at: pddl::Span) -> Vec<VariableId> {
        for &variable in variables.iter().filter(|&&v| !self.scope.is_node(v)) {
            let variable = self.scope.slot(variable).name.clone();
            let kind = vocabulary::LinkErrorKind::ValueVariable { variable };
            self.errors.push(Located::new(at, kind.into()));
        }
        variables.to_vec()
    }

    /// The connectives of a condition become parts; what remains is a condition of its own.
    fn condition(&mut self, condition: &model::Condition) -> PartId {
        let part = match &condition.kind {
            ConditionKind::And(parts) => Part::All(parts.iter().map(|part| self.condition(part)).collect()),
            ConditionKind::Or(parts) => Part::Any(parts.iter().map(|part| self.condition(part)).collect()),
            ConditionKind::Not(part) => Part::Not(self.condition(part)),
            ConditionKind::Imply(if_, then) => {
                let (if_, then) = (self.condition(if_), self.condition(then));
                return self.imply(if_, then);
            }
            ConditionKind::Forall(variables, inner) => {
                // No counterexample: a pattern with the variables inside, not one match for each node.
                let span = condition.span;
                let counter = ConditionKind::Not(inner.clone());
                let counter = model::Condition { kind: counter, span: inner.span };
                let exists = ConditionKind::Exists(variables.clone(), Box::new(counter));
                Part::Not(self.leaf(&model::Condition { kind: exists, span }))
            }
            _ => return self.leaf(condition),
        };
        self.push(part)
    }

    fn leaf(&mut self, condition: &model::Condition) -> PartId {
        let key = match &condition.kind {
            ConditionKind::Atom(atom) => self.key(atom),
            _ => None,
        };
        let known = key.as_ref().and_then(|key| self.conditions.atoms.get(key).copied());
        let compiled = match self.link.condition(&self.free, [condition]) {
            Ok(compiled) => compiled,
            Err(found) => {
                self.errors.extend(errors(found));
                return self.push(Part::All(Vec::new()));
            }
        };
        let arguments: SmallVec<[VariableId; 4]> = match compiled.alternatives() {
            [first, ..] => first.variables().map(|(variable, _)| variable).collect(),
            [] => SmallVec::new(),
        };
        let condition = known.unwrap_or_else(|| self.conditions.add(&compiled, arguments.len()));
        if let Some(key) = key {
            self.conditions.atoms.insert(key, condition);
        }
        self.uses.push((condition, arguments.clone()));
        self.push(Part::Holds { condition, arguments })
    }

    /// The atom with its variables by their order and types, so that equal atoms of two invariants are one condition.
    fn key(&self, atom: &Atom) -> Option<String> {
        let variables = atom.arguments.iter().filter_map(|term| match term {
            Term::Variable(variable) => Some(*variable),
            Term::Object(_) => None,
        });
        let mut order: Vec<VariableId> = variables.collect();
        order.sort_unstable();
        order.dedup();
        let mut key = self.domain.predicates[atom.predicate].name.to_string();
        for term in &atom.arguments {
            key.push(' ');
            match term {
                Term::Object(object) => key.push_str(&self.domain.constants[*object].name),
                Term::Variable(variable) => {
                    let at = order.iter().position(|v| v == variable)?;
                    let types: Vec<_> = self.scope.slot(*variable).types.iter().map(|t| t.index()).collect();
                    key.push_str(&format!("?{at}{types:?}"));
                }
            }
        }
        Some(key)
    }
}

/// The position of a variable in an environment.
pub(crate) fn slot(variable: VariableId) -> usize {
    variable.index()
}
