//! Conditions as the sentences of the paper: "robot is speaking", "person got answer".
//!
//! An edge reads subject, label, object; underscores become spaces. A label that starts with an auxiliary verb takes its
//! negation after the verb ("person is not with robot"), any other label in front ("not: person got answer"). An unbound
//! variable reads "some part", and under a negation "any part".

use std::fmt;

use dsr::{AttributeId, Comparison, LabelId, Value, Vocabulary};
use pddl::model::VariableId;
use serde::Serialize;

use crate::formula::{Formula, Holder, Literal, Right, Term};
use crate::scope::Scope;

/// A sentence about the graph.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(transparent)]
pub struct Sentence(String);

impl fmt::Display for Sentence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// Puts formulas of one schema into words.
pub struct Speaker<'a> {
    /// The names of labels, attributes and types.
    pub vocabulary: &'a Vocabulary,
    /// The variables.
    pub scope: &'a Scope,
    /// The name of the node that a variable is bound to; `None` if it is unbound.
    pub name_of: &'a dyn Fn(VariableId) -> Option<String>,
}

/// The articles of an unbound variable.
const SOME: &str = "some";
const ANY: &str = "any";
const THAT: &str = "that";

impl Speaker<'_> {
    /// A formula in words.
    pub fn say(&self, formula: &Formula) -> Sentence {
        Sentence(self.formula(formula, SOME))
    }

    /// A literal in words, affirmed.
    pub fn affirm(&self, literal: &Literal) -> Sentence {
        Sentence(self.literal(literal, SOME, true))
    }

    /// A literal in words, denied.
    pub fn deny(&self, literal: &Literal) -> Sentence {
        Sentence(self.literal(literal, ANY, false))
    }

    fn formula(&self, formula: &Formula, article: &str) -> String {
        let join = |parts: &[Formula], word: &str, none: &str| match parts {
            [] => none.to_owned(),
            parts => parts.iter().map(|part| self.formula(part, article)).collect::<Vec<_>>().join(word),
        };
        match formula {
            Formula::All(parts) => join(parts, " and ", "always"),
            Formula::Any(parts) => join(parts, " or ", "never"),
            Formula::Some(_, part) => self.formula(part, article),
            Formula::Literal(literal, _) => self.literal(literal, article, true),
            Formula::None(variables, part) => match &**part {
                Formula::Literal(literal, _) => {
                    self.literal(literal, if article == THAT { THAT } else { ANY }, false)
                }
                part if variables.is_empty() => format!("not: {}", self.formula(part, article)),
                part => {
                    let types: Vec<_> = variables.iter().map(|&variable| self.types(variable)).collect();
                    format!("there is no {} such that {}", types.join(" and "), self.formula(part, THAT))
                }
            },
        }
    }

    fn types(&self, variable: VariableId) -> String {
        let name = |&id: &dsr::TypeId| self.vocabulary.type_name(id).map_or("node", |name| name).to_owned();
        self.scope.slot(variable).types.iter().map(name).collect::<Vec<_>>().join(" or ")
    }

    fn term(&self, term: &Term, article: &str) -> String {
        match term {
            Term::Named(name) => spaced(name),
            Term::Variable(variable) => match (self.name_of)(*variable) {
                Some(name) => spaced(&name),
                None => format!("{article} {}", self.types(*variable)),
            },
        }
    }

    fn literal(&self, literal: &Literal, article: &str, affirmed: bool) -> String {
        let term = |term: &Term| self.term(term, article);
        let not = |affirmed: bool| if affirmed { "" } else { "not " };
        match literal {
            Literal::Edge { from, label, to } => {
                edge(self.vocabulary, &term(from), *label, &term(to), affirmed)
            }
            Literal::Present { holder, attribute } => {
                format!("{} is {}defined", self.attribute(holder, *attribute, article), not(affirmed))
            }
            Literal::Compare { holder, attribute, comparison, right } => {
                let right = match right {
                    Right::Value(value) => value_text(value),
                    Right::Term(node) => term(node),
                    Right::Attribute(holder, its) => self.attribute(holder, *its, article),
                };
                let verb = verb(*comparison);
                format!("{} is {}{verb}{right}", self.attribute(holder, *attribute, article), not(affirmed))
            }
            Literal::Same(a, b) => format!("{} is {}{}", term(a), not(affirmed), term(b)),
            Literal::Differ(a, b) => format!("{} is {}{}", term(a), not(!affirmed), term(b)),
            Literal::Distance { from, to, comparison, metres } => format!(
                "distance of {} and {} is {}{}{metres} m",
                term(from),
                term(to),
                not(affirmed),
                verb(*comparison)
            ),
            Literal::Derived { name, arguments, .. } => {
                let arguments: Vec<_> = arguments.iter().map(term).collect();
                let said = format!("({} {})", name, arguments.join(" ")).replace(" )", ")");
                if affirmed { said } else { format!("not {said}") }
            }
        }
    }

    fn attribute(&self, holder: &Holder, attribute: AttributeId, article: &str) -> String {
        let name = attribute_name(self.vocabulary, attribute);
        match holder {
            Holder::Node(node) => format!("{name} of {}", self.term(node, article)),
            Holder::Edge { from, to, .. } => {
                format!("{name} of {} and {}", self.term(from, article), self.term(to, article))
            }
        }
    }
}

fn edge(vocabulary: &Vocabulary, from: &str, label: LabelId, to: &str, affirmed: bool) -> String {
    const AUXILIARIES: [&str; 13] =
        ["is", "was", "are", "were", "has", "have", "had", "can", "could", "must", "may", "will", "does"];
    let label = label_text(vocabulary, label);
    if affirmed {
        return format!("{from} {label} {to}");
    }
    if let Some(kind) = from.strip_prefix("any ") {
        return format!("no {kind} {label} {to}");
    }
    let (first, rest) = label.split_once(' ').unwrap_or((label.as_str(), ""));
    if !AUXILIARIES.contains(&first) {
        return format!("not: {from} {label} {to}");
    }
    let words: Vec<&str> = match rest.split_once(' ').unwrap_or((rest, "")) {
        ("not", rest) => vec![from, first, rest, to],
        _ => vec![from, first, "not", rest, to],
    };
    words.into_iter().filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ")
}

fn verb(comparison: Comparison) -> &'static str {
    match comparison {
        Comparison::Equal => "",
        Comparison::NotEqual => "other than ",
        Comparison::Less => "less than ",
        Comparison::LessOrEqual => "at most ",
        Comparison::Greater => "greater than ",
        Comparison::GreaterOrEqual => "at least ",
    }
}

fn value_text(value: &Value) -> String {
    match value {
        Value::Number(number) => number.to_string(),
        Value::Text(text) => format!("“{text}”"),
        Value::Bool(truth) => truth.to_string(),
        Value::Node(node) => node.to_string(),
    }
}

fn label_text(vocabulary: &Vocabulary, label: LabelId) -> String {
    vocabulary.label_name(label).map_or_else(|| label.to_string(), |name| spaced(name))
}

fn attribute_name(vocabulary: &Vocabulary, attribute: AttributeId) -> String {
    vocabulary.attribute_name(attribute).map_or_else(|| attribute.to_string(), |name| spaced(name))
}

fn spaced(name: &str) -> String {
    name.replace('_', " ")
}
