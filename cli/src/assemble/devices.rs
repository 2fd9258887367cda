//! E1010: a device that the robot does not have.
//!
//! Problem: a device is a node of the graph, and a rule finds out about its health by the node's name. A name that the
//! hardware does not know would make the rule fail again and again, and never say why. Idea: each node that a rule may hand
//! to a skill as its `device` is one of [`Device`].

use agents::Skills;
use diagnostics::{Finding, did_you_mean};
use hal::Device;
use mission::{Layer, Layers, Mission};
use pddl::model::{Domain, DurativeAction, ObjectId, Term, TypeSet};
use std::collections::BTreeSet;

/// The name of such an argument in a skill's signature.
const DEVICE: &str = "device";

pub(super) fn check(mission: &Mission, skills: &Skills, findings: &mut Vec<Finding>) {
    let layers = &mission.layers;
    let mut nodes = BTreeSet::new();
    for agent in &layers.agents {
        for rule in &agent.model.durative_actions {
            nodes.extend(named_by(layers, agent, rule, skills));
        }
    }
    for node in nodes {
        let name = layers.name(node);
        if Device::named(name).is_none() {
            let known = Device::ALL.map(Device::name);
            let help = did_you_mean(name, known).unwrap_or_else(|| format!("it has: {}", known.join(", ")));
            let message = format!("the robot has no device `{name}`");
            findings.push(Finding::error("E1010", layers.node_place(node), message).help(help));
        }
    }
}

/// The nodes that a rule may hand to its skill as a device.
fn named_by(layers: &Layers, agent: &Layer<Domain>, rule: &DurativeAction, skills: &Skills) -> Vec<ObjectId> {
    let Some(call) = rule.rule.as_ref().and_then(|rule| rule.skill.as_ref()) else { return Vec::new() };
    let Some(skill) = skills.get(&call.name) else { return Vec::new() };
    let position = skill.signature().arguments.iter().position(|argument| *argument == DEVICE);
    let objects = &layers.graph.model.objects;
    match position.and_then(|position| call.arguments.get(position)) {
        None => Vec::new(),
        Some(Term::Object(id)) => {
            layers.graph.model.object(&agent.model.constants[*id].name).into_iter().collect()
        }
        Some(Term::Variable(id)) => {
            let types = rule.variables[*id].types.0.iter();
            let types = types.filter_map(|&t| layers.nodes.types.find(&agent.model.types[t].name));
            let types = TypeSet(types.collect());
            objects.ids().filter(|&id| objects[id].is_of(&types, &layers.nodes.types)).collect()
        }
    }
}
