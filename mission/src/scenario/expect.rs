//! `[expect]`: the required results of a scenario. Each expectation is optional.

use pddl::Span;
use pddl::model::Name;

use super::GraphCondition;
use super::names::node;
use crate::layers::Layers;
use crate::mission::Mission;
use diagnostics::Finding;
use diagnostics::did_you_mean;
use diagnostics::toml::{Reader, Table, Text};

/// An expected value and its place.
#[derive(Clone, Debug)]
pub struct Expected<T> {
    /// The value.
    pub value: T,
    /// Its place.
    pub span: Span,
}

/// A token that some replan must name as its reason.
#[derive(Clone, Debug)]
pub struct Naming {
    /// A predicate or function of the graph, of perception or of the planning domain.
    pub token: Name,
    /// Its place.
    pub span: Span,
}

/// The expectations on the replans.
#[derive(Clone, Debug, Default)]
pub struct ReplanExpectation {
    /// The least number.
    pub at_least: Option<Expected<u32>>,
    /// The greatest number.
    pub at_most: Option<Expected<u32>>,
    /// Some replan names each of these tokens.
    pub naming: Vec<Naming>,
}

/// The required results.
#[derive(Clone, Debug, Default)]
pub struct Expectation {
    /// Whether the mission reaches its goal.
    pub accomplished: Option<Expected<bool>>,
    /// The name of the ending.
    pub ending: Option<Expected<String>>,
    /// Conditions over the final graph.
    pub holds: Vec<GraphCondition>,
    /// The number of answered items.
    pub answered: Option<Expected<u32>>,
    /// The sum of the scores.
    pub total: Option<Expected<u32>>,
    /// The items that were asked and not answered, exactly.
    pub unanswered: Option<Expected<Vec<Name>>>,
    /// The expectations on the replans.
    pub replans: ReplanExpectation,
    /// The only answered items that may be asked again.
    pub asked_again: Option<Expected<Vec<Name>>>,
    /// The stages in which the lives of these goals end.
    pub goals: Vec<(Name, Expected<String>)>,
}

/// Reads `[expect]`.
pub(super) fn read(reader: &mut Reader<'_>, mission: &Mission, table: Option<Table<'_>>) -> Expectation {
    let layers = &mission.layers;
    let mut expect = Expectation::default();
    let Some(mut table) = table else { return expect };
    let span = table.key_span("accomplished");
    expect.accomplished = table.boolean(reader, "accomplished").map(|value| Expected { value, span });
    expect.ending = table.text(reader, "ending").and_then(|text| ending(reader, &text));
    for text in table.texts(reader, "holds").unwrap_or_default() {
        expect.holds.extend(super::condition::read(reader, layers, &text));
    }
    expect.answered = count(reader, &mut table, "answered");
    expect.total = count(reader, &mut table, "total");
    expect.unanswered = items(reader, layers, &mut table, "unanswered");
    expect.asked_again = items(reader, layers, &mut table, "asked-again");
    if let Some(mut replans) = table.table(reader, "replans") {
        expect.replans.at_least = count(reader, &mut replans, "at-least");
        expect.replans.at_most = count(reader, &mut replans, "at-most");
        for text in replans.texts(reader, "naming").unwrap_or_default() {
            expect.replans.naming.extend(token(reader, layers, &text));
        }
        replans.finish(reader);
    }
    if let Some(goals) = table.table(reader, "goals") {
        expect.goals = self::goals(reader, mission, goals);
    }
    table.finish(reader);
    expect
}

/// The stages that a goal's life may end in, and "dormant" for a goal that was never wanted.
const STAGES: [&str; 9] =
    ["dormant", "wanted", "selected", "pursued", "suspended", "held", "achieved", "dropped", "given_up"];

/// `[expect.goals]`: a stage for each goal that it names.
fn goals(reader: &mut Reader<'_>, mission: &Mission, mut table: Table<'_>) -> Vec<(Name, Expected<String>)> {
    let mut expected = Vec::new();
    for goal in &mission.goals {
        let Some(text) = table.text(reader, &goal.name) else { continue };
        if STAGES.contains(&text.value.as_str()) {
            expected.push((goal.name.clone(), Expected { value: text.value, span: text.span }));
        } else {
            let message =
                format!("no goal is `{}` in the end; it is one of {}", text.value, STAGES.join(", "));
            reader.error("E0705", text.span, message);
        }
    }
    table.finish(reader);
    expected
}

/// The ways in which a run ends, as its result names them.
const ENDINGS: [&str; 5] = ["accomplished", "given_up", "with_human", "still_calling", "still_going"];

fn ending(reader: &mut Reader<'_>, text: &Text) -> Option<Expected<String>> {
    if !ENDINGS.contains(&text.value.as_str()) {
        let message = format!("no run ends `{}`; it ends {}", text.value, ENDINGS.join(", "));
        reader.error("E0705", text.span, message);
        return None;
    }
    Some(Expected { value: text.value.clone(), span: text.span })
}

fn count(reader: &mut Reader<'_>, table: &mut Table<'_>, key: &str) -> Option<Expected<u32>> {
    table.count(reader, key, 0).map(|(value, span)| Expected { value, span })
}

fn items(
    reader: &mut Reader<'_>,
    layers: &Layers,
    table: &mut Table<'_>,
    key: &str,
) -> Option<Expected<Vec<Name>>> {
    let span = table.key_span(key);
    let mut value = Vec::new();
    for text in table.texts(reader, key)? {
        let id = node(reader, layers, &text, layers.tokens.items, "item");
        value.extend(id.map(|id| layers.graph.model.objects[id].name.clone()));
    }
    Some(Expected { value, span })
}

fn token(reader: &mut Reader<'_>, layers: &Layers, text: &Text) -> Option<Naming> {
    let mut known: Vec<&str> = Vec::new();
    for domain in [&layers.nodes, &layers.perception.model, &layers.domain.model] {
        known.extend(domain.predicates.enumerate().map(|(_, p)| p.name.as_str()));
        known.extend(domain.functions.enumerate().map(|(_, f)| f.name.as_str()));
    }
    let token = Name::new(&text.value);
    if !known.contains(&token.as_str()) {
        let message = format!("unknown token `{}`", text.value);
        let finding = Finding::error("E0910", reader.place(text.span), message);
        reader.findings.push(finding.help_if(did_you_mean(&token, known)));
        return None;
    }
    Some(Naming { token, span: text.span })
}
