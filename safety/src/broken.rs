//! A broken invariant, for reports.

use crate::facts::Facts;
use crate::formula::Formula;
use crate::residue::Environment;
use dsr::{Time, Version};
use pddl::model::{Idx, Name, Word};
use serde::{Serialize, Serializer};
use std::fmt;

/// An invariant that a run broke, for one binding of its parameters. Written by serde without version and time, which
/// the records around it have.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Broken {
    /// The invariant.
    #[serde(serialize_with = "as_text")]
    pub invariant: Name,
    /// What it says, with names for its parameters; its own name if it says nothing.
    pub says: String,
    /// Each parameter with the name of its node.
    #[serde(serialize_with = "as_map")]
    pub binding: Vec<(String, String)>,
    /// The version in which it was broken: the last one, if time broke it.
    #[serde(skip)]
    pub version: Version,
    /// When it was broken.
    #[serde(skip)]
    pub time: Time,
    /// What broke it.
    pub by: Cause,
}

/// What broke an invariant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Cause {
    /// What became true or false in the version.
    Change,
    /// A time that ran out.
    Time,
    /// The end of the run: what was still to come did not.
    End,
}

fn as_text<S: Serializer>(name: &Name, to: S) -> Result<S::Ok, S::Error> {
    to.collect_str(name)
}

fn as_map<S: Serializer>(binding: &[(String, String)], to: S) -> Result<S::Ok, S::Error> {
    to.collect_map(binding.iter().map(|(variable, node)| (variable, node)))
}

impl Broken {
    pub(crate) fn new(
        formula: &Formula,
        facts: &Facts,
        environment: &Environment,
        (version, time, by): (Version, Time, Cause),
    ) -> Self {
        let name = |slot: usize| environment[slot].map_or("", |node| facts.name(node)).to_owned();
        let word = |word: &Word| match word {
            Word::Text(text) => text.clone(),
            Word::Variable(variable) => name(variable.index()),
        };
        let says = match formula.says.as_slice() {
            [] => formula.name.to_string(),
            words => words.iter().map(word).collect::<Vec<_>>().join(" "),
        };
        let parameters = formula.variables.iter().take(formula.parameters).enumerate();
        Self {
            invariant: formula.name.clone(),
            says,
            binding: parameters.map(|(slot, (variable, _))| (variable.to_string(), name(slot))).collect(),
            version,
            time,
            by,
        }
    }
}

impl fmt::Display for Broken {
    /// `help-is-called: a request is acted upon (?p = person), broken by version 31`
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.invariant, self.says)?;
        for (at, (variable, node)) in self.binding.iter().enumerate() {
            write!(f, "{}?{variable} = {node}", if at == 0 { " (" } else { ", " })?;
        }
        if !self.binding.is_empty() {
            f.write_str(")")?;
        }
        let Version(version) = self.version;
        match self.by {
            Cause::Change => write!(f, "; broken by version {version}"),
            Cause::Time => write!(f, "; broken by the time after version {version}"),
            Cause::End => write!(f, "; broken by the end of the run, at version {version}"),
        }
    }
}
