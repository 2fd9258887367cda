//! From the typed model's conditions to logic over tokens.

use dsr::{AttributeId, Comparison};
use pddl::Span;
use pddl::model::{self, Application, Atom, ConditionKind, Domain, Expression, ExpressionKind, VariableId};

use crate::formula::{Formula, Holder, Literal, Right, Term};
use crate::link_error::{LinkError, LinkErrorKind};
use crate::located::Located;
use crate::number::{Number, calculate};
use crate::scope::Scope;
use crate::tokens::{FunctionToken, Tokens};

/// Whether predicates that are not tokens may occur.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Derived {
    Allowed,
    Refused,
}

/// A term that may also be a value.
pub(crate) enum TermOrValue {
    Term(Term),
    Value(dsr::Value),
}

pub(crate) struct Translator<'a> {
    pub(crate) tokens: &'a Tokens,
    pub(crate) domain: &'a Domain,
    pub(crate) scope: &'a Scope,
    derived: Derived,
    errors: Vec<LinkError>,
}

impl<'a> Translator<'a> {
    pub(crate) fn new(tokens: &'a Tokens, domain: &'a Domain, scope: &'a Scope, derived: Derived) -> Self {
        Self { tokens, domain, scope, derived, errors: Vec::new() }
    }

    /// The result, unless there were errors.
    pub(crate) fn finish<T>(self, result: T) -> Result<T, Vec<LinkError>> {
        if self.errors.is_empty() { Ok(result) } else { Err(self.errors) }
    }

    pub(crate) fn error(&mut self, span: Span, kind: LinkErrorKind) {
        self.errors.push(Located::new(span, kind));
    }

    pub(crate) fn condition(&mut self, condition: &model::Condition) -> Formula {
        let span = condition.span;
        match &condition.kind {
            ConditionKind::And(parts) => {
                Formula::All(parts.iter().map(|part| self.condition(part)).collect())
            }
            ConditionKind::Or(parts) => Formula::Any(parts.iter().map(|part| self.condition(part)).collect()),
            ConditionKind::Not(part) => self.condition(part).negated(),
            ConditionKind::Imply(left, right) => {
                Formula::Any(vec![self.condition(left).negated(), self.condition(right)])
            }
            ConditionKind::Exists(variables, part) => {
                let part = self.condition(part);
                Formula::Some(self.quantified(variables, span), Box::new(part))
            }
            ConditionKind::Forall(variables, part) => {
                let part = self.condition(part).negated();
                Formula::None(self.quantified(variables, span), Box::new(part))
            }
            ConditionKind::Atom(atom) => self.atom(atom),
            ConditionKind::HasType(..) => {
                self.error(span, LinkErrorKind::TypeCondition);
                Formula::always()
            }
            ConditionKind::Same(a, b) => match (self.node(*a, span), self.node(*b, span)) {
                (Some(a), Some(b)) => Formula::Literal(Literal::Same(a, b), span),
                _ => Formula::always(),
            },
            ConditionKind::Compare(comparison, left, right) => {
                self.comparison(comparison_of(*comparison), left, right, span).unwrap_or_else(Formula::always)
            }
            ConditionKind::FluentIs(application, term) => {
                self.fluent(application, *term, span).unwrap_or_else(Formula::always)
            }
        }
    }

    /// Quantified variables. A variable of a value is reported.
    pub(crate) fn quantified(&mut self, variables: &[VariableId], span: Span) -> Vec<VariableId> {
        for &variable in variables {
            if !self.scope.is_node(variable) {
                let name = self.scope.slot(variable).name.clone();
                self.error(span, LinkErrorKind::ValueVariable { variable: name });
            }
        }
        variables.to_vec()
    }

    fn atom(&mut self, atom: &Atom) -> Formula {
        let name = &self.domain.predicates[atom.predicate].name;
        if let Some(literal) = self.edge(atom) {
            return Formula::Literal(literal, atom.span);
        }
        if self.tokens.label(name).is_none() {
            if self.derived == Derived::Allowed {
                let arguments = atom.arguments.iter().map(|&term| self.node(term, atom.span)).collect();
                let Some(arguments) = arguments else { return Formula::always() };
                let literal = Literal::Derived { predicate: atom.predicate, name: name.clone(), arguments };
                return Formula::Literal(literal, atom.span);
            }
            let (name, vocabulary) = (name.clone(), self.tokens.name.clone());
            self.error(atom.span, LinkErrorKind::NotAToken { name, vocabulary });
        }
        Formula::always()
    }

    /// The edge of an atom, if its predicate is a label.
    pub(crate) fn edge(&mut self, atom: &Atom) -> Option<Literal> {
        let label = self.tokens.label(&self.domain.predicates[atom.predicate].name)?;
        let &[from, to] = atom.arguments.as_slice() else { return None };
        let (from, to) = (self.node(from, atom.span)?, self.node(to, atom.span)?);
        Some(Literal::Edge { from, label, to })
    }

    /// A term that must be a node. A value is reported.
    pub(crate) fn node(&mut self, term: model::Term, span: Span) -> Option<Term> {
        match self.term(term) {
            TermOrValue::Term(Term::Variable(variable)) if !self.scope.is_node(variable) => {
                let variable = self.scope.slot(variable).name.clone();
                self.error(span, LinkErrorKind::ValueVariable { variable });
                None
            }
            TermOrValue::Term(term) => Some(term),
            TermOrValue::Value(_) => {
                let name = self.object_name(term);
                self.error(span, LinkErrorKind::ValueTerm { name });
                None
            }
        }
    }

    fn object_name(&self, term: model::Term) -> pddl::model::Name {
        match term {
            model::Term::Object(id) => self.domain.constants[id].name.clone(),
            model::Term::Variable(id) => self.scope.slot(id).name.clone(),
        }
    }

    pub(crate) fn term(&self, term: model::Term) -> TermOrValue {
        match term {
            model::Term::Variable(variable) => TermOrValue::Term(Term::Variable(variable)),
            model::Term::Object(id) => {
                let name = &self.domain.constants[id].name;
                match self.tokens.value(name) {
                    Some(value) => TermOrValue::Value(value.clone()),
                    None => TermOrValue::Term(Term::Named(name.clone())),
                }
            }
        }
    }

    fn fluent(&mut self, application: &Application, term: model::Term, span: Span) -> Option<Formula> {
        let (holder, attribute) = self.attribute(application)?;
        let right = match self.term(term) {
            TermOrValue::Value(value) => Right::Value(value),
            TermOrValue::Term(_) => Right::Term(self.node(term, span)?),
        };
        let literal = Literal::Compare { holder, attribute, comparison: Comparison::Equal, right };
        Some(Formula::Literal(literal, span))
    }

    /// The holder and the attribute of an application. An application that is not an attribute is reported.
    pub(crate) fn attribute(&mut self, application: &Application) -> Option<(Holder, AttributeId)> {
        let name = self.domain.functions[application.function].name.clone();
        let span = application.span;
        let mut arguments = Vec::new();
        for &argument in &application.arguments {
            arguments.push(self.node(argument, span)?);
        }
        let kind = match (self.tokens.function(&name), arguments.as_slice()) {
            (Some(FunctionToken::Node { attribute }), [node]) => {
                return Some((Holder::Node(node.clone()), attribute));
            }
            (Some(FunctionToken::Edge { label, attribute }), [from, to]) => {
                return Some((Holder::Edge { from: from.clone(), label, to: to.clone() }, attribute));
            }
            (Some(FunctionToken::Transform), _) => LinkErrorKind::PoseComparison { name },
            (Some(FunctionToken::Pose(_)), _) => LinkErrorKind::PosePart { name },
            (Some(FunctionToken::Distance), _) => LinkErrorKind::Comparison,
            _ => LinkErrorKind::NotAnAttribute { name, vocabulary: self.tokens.name.clone() },
        };
        self.error(span, kind);
        None
    }

    /// A numeric expression. An expression without a value is reported.
    pub(crate) fn number(&mut self, expression: &Expression) -> Option<Number> {
        match &expression.kind {
            ExpressionKind::Number(number) => Some(Number::Constant(*number)),
            ExpressionKind::Fluent(application) => {
                let name = &self.domain.functions[application.function].name;
                if self.tokens.function(name) == Some(FunctionToken::Distance)
                    && let &[a, b] = application.arguments.as_slice()
                {
                    return Some(Number::Distance(
                        self.node(a, application.span)?,
                        self.node(b, application.span)?,
                    ));
                }
                let (holder, attribute) = self.attribute(application)?;
                Some(Number::Attribute(holder, attribute))
            }
            ExpressionKind::Arithmetic(operator, operands) => {
                let mut numbers = Vec::new();
                for operand in operands {
                    numbers.push(self.number(operand)?);
                }
                let constants: Option<Vec<_>> = numbers.iter().map(Number::constant).collect();
                match constants {
                    Some(constants) => {
                        let folded = calculate(*operator, &constants);
                        if folded.is_none() {
                            self.error(expression.span, LinkErrorKind::NoValue);
                        }
                        folded.map(Number::Constant)
                    }
                    None => Some(Number::Arithmetic(*operator, numbers)),
                }
            }
            ExpressionKind::Duration | ExpressionKind::TotalTime | ExpressionKind::IsViolated(_) => {
                self.error(expression.span, LinkErrorKind::NoValue);
                None
            }
        }
    }

    fn comparison(
        &mut self,
        comparison: Comparison,
        left: &Expression,
        right: &Expression,
        span: Span,
    ) -> Option<Formula> {
        let (left, right) = (self.number(left)?, self.number(right)?);
        let literal = match (left, right) {
            (Number::Constant(left), Number::Constant(right)) => {
                let holds = holds(comparison, left, right);
                return Some(if holds { Formula::always() } else { Formula::Any(Vec::new()) });
            }
            (Number::Attribute(holder, attribute), Number::Constant(number)) => {
                let right = Right::Value(dsr::Value::Number(number));
                Literal::Compare { holder, attribute, comparison, right }
            }
            (Number::Constant(number), Number::Attribute(holder, attribute)) => {
                let right = Right::Value(dsr::Value::Number(number));
                Literal::Compare { holder, attribute, comparison: flipped(comparison), right }
            }
            (Number::Attribute(holder, attribute), Number::Attribute(other, its)) => {
                Literal::Compare { holder, attribute, comparison, right: Right::Attribute(other, its) }
            }
            (Number::Distance(from, to), Number::Constant(metres)) => {
                Literal::Distance { from, to, comparison, metres }
            }
            (Number::Constant(metres), Number::Distance(from, to)) => {
                Literal::Distance { from, to, comparison: flipped(comparison), metres }
            }
            _ => {
                self.error(span, LinkErrorKind::Comparison);
                return None;
            }
        };
        Some(Formula::Literal(literal, span))
    }
}

fn comparison_of(comparison: model::Comparison) -> Comparison {
    match comparison {
        model::Comparison::Less => Comparison::Less,
        model::Comparison::LessEqual => Comparison::LessOrEqual,
        model::Comparison::Equal => Comparison::Equal,
        model::Comparison::GreaterEqual => Comparison::GreaterOrEqual,
        model::Comparison::Greater => Comparison::Greater,
    }
}

/// The comparison with its sides exchanged.
fn flipped(comparison: Comparison) -> Comparison {
    match comparison {
        Comparison::Less => Comparison::Greater,
        Comparison::LessOrEqual => Comparison::GreaterOrEqual,
        Comparison::Greater => Comparison::Less,
        Comparison::GreaterOrEqual => Comparison::LessOrEqual,
        same @ (Comparison::Equal | Comparison::NotEqual) => same,
    }
}

/// Whether the comparison holds for two numbers.
pub(crate) fn holds(comparison: Comparison, left: f64, right: f64) -> bool {
    match comparison {
        Comparison::Equal => left == right,
        Comparison::NotEqual => left != right,
        Comparison::Less => left < right,
        Comparison::LessOrEqual => left <= right,
        Comparison::Greater => left > right,
        Comparison::GreaterOrEqual => left >= right,
    }
}
