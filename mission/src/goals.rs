//! `[[goal]]` of `mission.toml`: what the mission owes, and when.
//!
//! Problem: a mission owes several things, at different moments, and whoever is responsible may hold or end one of them.
//! Idea: a goal is a condition over the planning domain; what makes it wanted, holds it and ends it are conditions over
//! what is perceived, so they may name tokens of the graph, which anybody may write who is permitted to. They become axioms
//! of the perception, and are sensed, kept up to date and explained like all others.

use std::time::Duration;

use pddl::Span;
use pddl::model::{Condition, Domain, Name, Problem, Variables};

use crate::fragment;
use crate::goal_entry::{GoalEntry, Worth};
use crate::layers::Layers;
use diagnostics::toml::{Reader, Text};

/// A condition over what is perceived: tokens of the graph, and what the perception derives.
#[derive(Clone, Debug)]
pub struct Perceived {
    /// The condition, in terms of the perception.
    pub condition: Condition,
    /// Its quantified variables.
    pub variables: Variables,
    /// Its place in `mission.toml`.
    pub span: Span,
}

/// A goal of a mission.
#[derive(Clone, Debug)]
pub struct MissionGoal {
    /// Its name.
    pub name: Name,
    /// The place of the name.
    pub span: Span,
    /// What is to hold, over the planning domain and the objects of the problem.
    pub condition: Condition,
    /// The quantified variables of the condition.
    pub variables: Variables,
    /// What it is worth.
    pub worth: Worth,
    /// What makes it wanted; without it, it is wanted from the start.
    pub when: Option<Perceived>,
    /// What makes it wait.
    pub hold: Option<Perceived>,
    /// What ends it.
    pub drop: Option<Perceived>,
    /// How long it may be wanted.
    pub deadline: Option<Duration>,
    /// Whether it interrupts the step that is under way.
    pub urgent: bool,
    /// Whether it is wanted again whenever it does not hold.
    pub maintained: bool,
}

/// Reads the conditions of the goals. One that has no `goal` stands for the goal of the problem.
pub(crate) fn resolve(reader: &mut Reader<'_>, entries: &[GoalEntry], layers: &Layers) -> Vec<MissionGoal> {
    let (domain, problem) = (&layers.domain.model, &layers.problem.model);
    // The problem's objects, under their ids, are the names that a goal may mention.
    let planning = Domain { constants: problem.objects.clone(), ..domain.clone() };
    entries.iter().filter_map(|entry| one(reader, entry, &planning, problem, layers)).collect()
}

fn one(
    reader: &mut Reader<'_>,
    entry: &GoalEntry,
    planning: &Domain,
    problem: &Problem,
    layers: &Layers,
) -> Option<MissionGoal> {
    let (condition, variables) = match &entry.goal {
        Some(text) => fragment::read(reader, planning, text)?,
        None => (problem.goal.clone(), problem.goal_variables.clone()),
    };
    let mut perceived = |text: &Option<Text>| {
        let text = text.as_ref()?;
        let (condition, variables) = fragment::read(reader, &layers.perception.model, text)?;
        Some(Perceived { condition, variables, span: text.span })
    };
    Some(MissionGoal {
        name: Name::new(&entry.name.value),
        span: entry.name.span,
        condition,
        variables,
        worth: entry.worth,
        when: perceived(&entry.when),
        hold: perceived(&entry.hold),
        drop: perceived(&entry.drop),
        deadline: entry.deadline,
        urgent: entry.urgent,
        maintained: entry.maintained,
    })
}
