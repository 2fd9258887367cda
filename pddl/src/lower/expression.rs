//! Numeric expressions and applications of functions.

use super::body::{Applied, Body};
use super::schema::Owner;
use crate::diagnostic::{DiagnosticKind, SymbolKind, UnsupportedFeature};
use crate::model::{Application, ArithmeticOperator, Expression, ExpressionKind, FunctionValue, Name};
use crate::occurrence::NameKind;
use crate::syntax::{Node, NodeKind};

/// Operators that the language does not have and some planners read.
const OPERATORS: &[&str] =
    &["^", "abs", "sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "exp", "log", "min", "max"];

impl Body<'_> {
    /// Reads a numeric expression; `None` if something in it is wrong.
    pub(crate) fn expression(&mut self, node: Node<'_>) -> Option<Expression> {
        let kind = match node.kind() {
            NodeKind::List => self.compound(node),
            NodeKind::Number => self.number(node),
            NodeKind::Variable if self.schema.is_durative() && node.is("?duration") => {
                Some(ExpressionKind::Duration)
            }
            NodeKind::Name if node.is("#t") => self.continuous(node),
            NodeKind::Name if node.is("total-time") && self.world.function("total-time").is_none() => {
                self.of_metric(node, ExpressionKind::TotalTime)
            }
            NodeKind::Name => self.fluent(node),
            NodeKind::Variable | NodeKind::Keyword => {
                self.sink.unexpected(node, "a number, a function or an arithmetic expression");
                None
            }
        };
        Some(Expression { kind: kind?, span: node.span() })
    }

    fn number(&mut self, node: Node<'_>) -> Option<ExpressionKind> {
        let number = node.text().parse().ok();
        if number.is_none() {
            self.sink.unexpected(node, "a number");
        }
        number.map(ExpressionKind::Number)
    }

    /// `#t` outside of continuous effects, which read `#t` themselves.
    fn continuous(&mut self, node: Node<'_>) -> Option<ExpressionKind> {
        let name = node.text().to_ascii_lowercase();
        self.sink.report(node.span(), DiagnosticKind::OutOfPlace { name, place: "a continuous effect" });
        None
    }

    fn compound(&mut self, node: Node<'_>) -> Option<ExpressionKind> {
        let Some(head) = node.head() else {
            self.sink.unexpected(node, "an arithmetic expression");
            return None;
        };
        let operator = match head.text() {
            "+" => ArithmeticOperator::Add,
            "-" => ArithmeticOperator::Subtract,
            "*" => ArithmeticOperator::Multiply,
            "/" => ArithmeticOperator::Divide,
            _ => return self.called(node, head),
        };
        self.arithmetic(node, operator)
    }

    fn arithmetic(&mut self, node: Node<'_>, operator: ArithmeticOperator) -> Option<ExpressionKind> {
        let mut operands = Vec::new();
        let mut sound = true;
        for part in node.children().skip(1) {
            let operand = self.expression(part);
            sound &= operand.is_some();
            operands.extend(operand);
        }
        if sound && (operands.is_empty() || operator == ArithmeticOperator::Divide && operands.len() < 2) {
            self.sink.unexpected(node, "operands");
            return None;
        }
        sound.then_some(ExpressionKind::Arithmetic(operator, operands))
    }

    fn called(&mut self, node: Node<'_>, head: Node<'_>) -> Option<ExpressionKind> {
        if self.world.function(head.text()).is_none() {
            if head.is("total-time") && node.children().count() == 1 {
                return self.of_metric(node, ExpressionKind::TotalTime);
            }
            if head.is("is-violated") {
                let [name] = self.parts(node, "`(is-violated PREFERENCE)`")?;
                if !name.is_name() {
                    self.sink.unexpected(name, "the name of a preference");
                    return None;
                }
                self.sink.mention(NameKind::Preference, name, None);
                return self.of_metric(node, ExpressionKind::IsViolated(Name::new(name.text())));
            }
        }
        if OPERATORS.iter().any(|operator| head.is(operator))
            && self.world.function(head.text()).is_none()
            && node.children().count() > 1
        {
            self.sink.unsupported(head.span(), UnsupportedFeature::Operators);
            for operand in node.children().skip(1) {
                self.expression(operand);
            }
            return Some(ExpressionKind::Number(0.0));
        }
        self.fluent(node)
    }

    /// Words that have a value in metrics only.
    fn of_metric(&mut self, node: Node<'_>, kind: ExpressionKind) -> Option<ExpressionKind> {
        if self.schema.owner != Owner::Metric {
            let name = node.head().unwrap_or(node).text().to_ascii_lowercase();
            self.sink.report(node.span(), DiagnosticKind::OutOfPlace { name, place: "a metric" });
            return None;
        }
        Some(kind)
    }

    fn fluent(&mut self, node: Node<'_>) -> Option<ExpressionKind> {
        let application = self.application(node)?;
        let function = &self.world.functions[application.function];
        if function.value != FunctionValue::Number {
            let kind = DiagnosticKind::WrongValue {
                name: function.name.clone(),
                found: "an object",
                expected: "a number",
            };
            self.sink.report(node.span(), kind);
            return None;
        }
        Some(ExpressionKind::Fluent(application))
    }

    /// `(f t …)`, or the bare name of a function without parameters.
    pub(super) fn application(&mut self, node: Node<'_>) -> Option<Application> {
        let head = if node.is_list() { node.head() } else { Some(node) };
        let Some(head) = head.filter(|h| h.is_name()) else {
            self.sink.unexpected(node, "a function such as `(f ?x)`");
            return None;
        };
        let Some(id) = self.world.function(head.text()) else {
            self.world.unknown(self.sink, head, SymbolKind::Function);
            self.stray_terms(node);
            return None;
        };
        self.sink.mention(NameKind::Function, head, None);
        let function = &self.world.functions[id];
        let of = Applied {
            symbol: SymbolKind::Function,
            name: &function.name,
            parameters: function.variables.parameters(),
        };
        // An atom has no children to skip the head of.
        let arguments = self.arguments(node, node.children().skip(1), &of)?;
        Some(Application { function: id, arguments, span: node.span() })
    }
}
