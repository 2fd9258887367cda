//! The file as written: symbols with links, and attributes with numbered types.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use dsr::NewValue;

/// Longer lists are data, such as images, not attributes.
const LONGEST: usize = 16;
/// Above this, a double does not hold every whole number exactly.
const EXACT: f64 = 9_007_199_254_740_992.0;

#[derive(Debug, Clone, Deserialize, Serialize)]
pub(super) struct Model {
    pub(super) symbols: BTreeMap<String, Symbol>,
}

#[derive(Debug, Clone, Deserialize, Serialize)]
pub(super) struct Symbol {
    pub(super) id: Number,
    #[serde(rename = "type")]
    pub(super) kind: String,
    #[serde(default)]
    pub(super) name: String,
    #[serde(default)]
    pub(super) attribute: Attributes,
    #[serde(default)]
    pub(super) links: Vec<Link>,
}

#[derive(Debug, Clone, Deserialize, Serialize)]
pub(super) struct Link {
    pub(super) src: Number,
    pub(super) dst: Number,
    pub(super) label: String,
    #[serde(default, rename = "linkAttribute")]
    pub(super) attribute: Attributes,
}

pub(super) type Attributes = BTreeMap<String, Content>;

/// A 64-bit number, which cortex writes as a string.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Deserialize, Serialize)]
#[serde(untagged)]
pub(super) enum Number {
    Plain(u64),
    Quoted(String),
}

impl Number {
    pub(super) fn text(&self) -> String {
        match self {
            Self::Plain(number) => number.to_string(),
            Self::Quoted(text) => text.clone(),
        }
    }
}

/// A value with the number of its type.
#[derive(Debug, Clone, Deserialize, Serialize)]
pub(super) struct Content {
    #[serde(rename = "type")]
    kind: u32,
    pub(super) value: Plain,
}

#[derive(Debug, Clone, Deserialize, Serialize)]
#[serde(untagged)]
pub(super) enum Plain {
    Bool(bool),
    Number(f64),
    Text(String),
    List(Vec<Plain>),
    Nothing(Option<()>),
}

impl Plain {
    pub(super) fn number(&self) -> Option<f64> {
        let number = match self {
            Self::Number(number) => Some(*number),
            // Cortex writes a decimal comma if the locale has one.
            Self::Text(text) => text.replace(',', ".").parse().ok(),
            Self::Bool(_) | Self::List(_) | Self::Nothing(_) => None,
        };
        number.filter(|number: &f64| number.is_finite())
    }

    pub(super) fn numbers(&self) -> Option<Vec<f64>> {
        if let Self::List(list) = self { list.iter().map(Self::number).collect() } else { None }
    }
}

impl Content {
    /// The values, each with its position if it is a list.
    pub(super) fn values(&self) -> Result<Vec<(Option<usize>, NewValue)>, &'static str> {
        let one = |value| Ok(vec![(None, value)]);
        match (self.kind, &self.value) {
            (_, Plain::Nothing(_)) => Err("it has no value"),
            (_, Plain::Bool(truth)) => one(NewValue::Bool(*truth)),
            (1 | 2 | 6 | 7 | 8, value) => match value.number() {
                Some(number) if self.kind != 7 || number < EXACT => one(NewValue::Number(number)),
                _ => match value {
                    Plain::Text(text) => one(NewValue::Text(text.as_str().into())),
                    _ => Err("it is no number"),
                },
            },
            (_, Plain::Text(text)) => one(NewValue::Text(text.as_str().into())),
            (_, Plain::Number(number)) => one(NewValue::Number(*number)),
            (_, Plain::List(list)) if list.len() > LONGEST => Err("it is a long list"),
            (_, list @ Plain::List(_)) => {
                let numbers = list.numbers().ok_or("it is no list of numbers")?;
                let placed = numbers.into_iter().enumerate();
                Ok(placed.map(|(at, number)| (Some(at), NewValue::Number(number))).collect())
            }
        }
    }
}
