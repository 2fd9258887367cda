//! `(increase (f ?x) (* #t RATE))`: continuous effects of processes and durative actions.
//!
//! `#t` is the time since the process or action began, so its factor is the rate of change. Besides the
//! grammar's `(* #t RATE)` and `(* RATE #t)` every expression that is linear in `#t` is read. The model
//! holds the rate without `#t`.
//!
//! Source: Fox & Long, "PDDL2.1", JAIR 2003, §5; "Modelling mixed discrete-continuous domains", JAIR 2006.

use super::body::Body;
use super::effect::assign_operator;
use crate::diagnostic::DiagnosticKind;
use crate::model::{
    ArithmeticOperator, AssignOperator, ContinuousEffect, Direction, Expression, ExpressionKind,
    FunctionValue,
};
use crate::syntax::Node;

/// Whether the word stands anywhere in `node`.
fn holds(node: Node<'_>, word: &str) -> bool {
    node.is(word) || node.children().any(|n| holds(n, word))
}

impl Body<'_> {
    /// Whether `node` is a change by `#t`.
    pub(super) fn is_continuous(&self, node: Node<'_>) -> bool {
        let head = node.head();
        head.is_some_and(|head| {
            assign_operator(head).is_some() && self.world.predicate(head.text()).is_none()
        }) && node.children().nth(2).is_some_and(|value| holds(value, "#t"))
    }

    /// Reads the continuous effects among others.
    pub(super) fn continuous_effects(&mut self, node: Node<'_>) -> Vec<ContinuousEffect> {
        let (mut foralls, mut effects) = (Vec::new(), Vec::new());
        self.find_continuous(node, &mut foralls, &mut effects);
        effects
    }

    fn find_continuous<'t>(
        &mut self,
        node: Node<'t>,
        foralls: &mut Vec<Node<'t>>,
        into: &mut Vec<ContinuousEffect>,
    ) {
        if node.is_headed("and") {
            for part in node.children().skip(1) {
                self.find_continuous(part, foralls, into);
            }
        } else if node.is_headed("forall") {
            if let Some(body) = node.children().nth(2) {
                foralls.push(node);
                self.find_continuous(body, foralls, into);
                foralls.pop();
            }
        } else if self.is_continuous(node) {
            let mut forall = Vec::new();
            for &around in foralls.iter() {
                forall.extend(self.quantifier(around).map(|(bound, _)| bound).unwrap_or_default());
            }
            let (effect, functions) = self.binding(|body| body.change(node));
            self.schema.unbind(forall.len());
            into.extend(effect.map(|effect| ContinuousEffect { forall, functions, ..effect }));
        }
    }

    fn change(&mut self, node: Node<'_>) -> Option<ContinuousEffect> {
        let direction = match assign_operator(node.head()?)? {
            AssignOperator::Increase => Some(Direction::Increase),
            AssignOperator::Decrease => Some(Direction::Decrease),
            AssignOperator::Assign | AssignOperator::ScaleUp | AssignOperator::ScaleDown => {
                self.sink.unexpected(node, "`(increase (FUNCTION …) (* #t RATE))`, or `decrease`");
                None
            }
        };
        let [target, value] = self.parts(node, "`(increase (FUNCTION …) (* #t RATE))`")?;
        let fluent = self.application(target);
        let rate = self.rate(value);
        let fluent = fluent?;
        let function = &self.world.functions[fluent.function];
        if function.value != FunctionValue::Number {
            let (name, found, expected) = (function.name.clone(), "an object", "a number");
            self.sink.report(target.span(), DiagnosticKind::WrongValue { name, found, expected });
            return None;
        }
        let (forall, functions) = (Vec::new(), Vec::new());
        Some(ContinuousEffect {
            forall,
            functions,
            direction: direction?,
            fluent,
            rate: rate?,
            span: node.span(),
        })
    }

    /// The factor of `#t` in `node`.
    fn rate(&mut self, node: Node<'_>) -> Option<Expression> {
        let number = |number| Expression { kind: ExpressionKind::Number(number), span: node.span() };
        if node.is("#t") {
            return Some(number(1.0));
        }
        let parts: Vec<Node<'_>> = node.children().skip(1).collect();
        let timed = parts.iter().filter(|part| holds(**part, "#t")).count();
        let operator = node.head().map_or("", |head| head.text());
        let kind = match operator {
            "*" if timed == 1 => {
                let (mut factors, mut rate) = (Vec::new(), None);
                let mut sound = true;
                for part in parts {
                    if part.is("#t") {
                        continue;
                    }
                    if holds(part, "#t") {
                        rate = self.rate(part);
                        sound &= rate.is_some();
                    } else {
                        let factor = self.expression(part);
                        sound &= factor.is_some();
                        factors.extend(factor);
                    }
                }
                factors.extend(rate);
                match factors.pop().filter(|_| sound) {
                    None if sound => return Some(number(1.0)),
                    None => return None,
                    Some(only) if factors.is_empty() => return Some(only),
                    Some(last) => {
                        factors.push(last);
                        ExpressionKind::Arithmetic(ArithmeticOperator::Multiply, factors)
                    }
                }
            }
            "/" if timed == 1 && parts.len() > 1 && holds(parts[0], "#t") => {
                let mut operands = vec![self.rate(parts[0])];
                operands.extend(parts[1..].iter().map(|&part| self.expression(part)));
                let operands = operands.into_iter().collect::<Option<Vec<_>>>()?;
                ExpressionKind::Arithmetic(ArithmeticOperator::Divide, operands)
            }
            "+" | "-" if timed == parts.len() && timed > 0 => {
                let operands: Vec<_> = parts.into_iter().map(|part| self.rate(part)).collect();
                let operands = operands.into_iter().collect::<Option<Vec<_>>>()?;
                let operator = match operator {
                    "+" => ArithmeticOperator::Add,
                    _ => ArithmeticOperator::Subtract,
                };
                ExpressionKind::Arithmetic(operator, operands)
            }
            _ => {
                self.sink.report(node.span(), DiagnosticKind::NotLinear);
                return None;
            }
        };
        Some(Expression { kind, span: node.span() })
    }
}
