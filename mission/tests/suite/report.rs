//! The report over a graph, and the verdict of a scenario over the report.

use std::time::Duration;

use dsr::{AgentId, Graph, HolderRef, Kind, LabelId, Nature, Time, VocabularyBuilder};
use expect_test::expect;
use mission::report::{Report, Status, Times};
use mission::scenario::{Outcome, Replan};
use pddl::Span;

use crate::tea;

/// The tea mission's graph, with one edge `from -label-> drink` if asked for.
fn graph(edge: Option<(&str, &str)>) -> Graph {
    let mut builder = VocabularyBuilder::new();
    let [item, option, utterance] =
        ["item", "option", "utterance"].map(|n| builder.node_type(n, None, Nature::Symbolic).unwrap());
    let question = builder.node_type("question", Some(utterance), Nature::Symbolic).unwrap();
    let score = builder.label("score", item, option).unwrap();
    let worth = builder.attribute_on_edge("score", score, (item, option), Kind::Number).unwrap();
    builder.label("was_chosen_in", option, item).unwrap();
    builder.label("was_unanswered_in", question, item).unwrap();
    builder.label("was_said_in", utterance, item).unwrap();
    let vocabulary = builder.build();
    let graph = Graph::new(vocabulary.clone());
    let edit = |label: LabelId, from: &str, to: &str, at: u64| {
        graph.edit(AgentId::DSR, Time(at), |tx| {
            tx.add_edge(from, label, to);
        })
    };
    graph
        .edit(AgentId::DSR, Time(0), |tx| {
            tx.add_node("drink", item).add_node("black", option).add_node("green", option);
            tx.add_node("which", question).add_node("welcome", utterance);
        })
        .unwrap();
    for (name, number) in [("black", 1.0), ("green", 2.0)] {
        edit(score, "drink", name, 1).unwrap();
        graph
            .edit(AgentId::DSR, Time(1), |tx| {
                tx.set_attribute(HolderRef::edge("drink", score, name), worth, number);
            })
            .unwrap();
    }
    if let Some((from, label)) = edge {
        edit(vocabulary.label(label).unwrap(), from, "drink", 2).unwrap();
    }
    graph
}

fn report(edge: Option<(&str, &str)>, language: &str) -> Report {
    let mission = tea::mission();
    let times = Times { started: Duration::from_millis(500), finished: Duration::from_secs(9) };
    Report::new(&mission, mission.words(language).unwrap(), &graph(edge).snapshot(), times)
}

#[test]
fn an_answer_scores() {
    let report = report(Some(("green", "was_chosen_in")), "fr");
    expect![[r#"
        Bill
        Item   Price  Order
        ──────────────────────
        thé      2/2  Thé vert
        ──────────────────────
        Total    2/2
        All ordered.
    "#]]
    .assert_eq(&report.to_string());
    expect![[r#"{"mission":"tea","title":"tea","language":"fr","started_s":0.5,"finished_s":9.0,"items":[{"item":"drink","name":"thé","status":"answered","option":"green","answer":"Thé vert","score":2,"maximum":2}],"total":2,"maximum":2,"complete":true}"#]]
        .assert_eq(&serde_json::to_string(&report).unwrap());
}

#[test]
fn silence_and_not_reached_are_marked() {
    let silent = report(Some(("which", "was_unanswered_in")), "en").to_string();
    assert!(silent.contains("–/2  — no order"), "{silent}");
    assert!(silent.ends_with("Not all ordered.\n"));
    assert!(report(None, "en").to_string().contains("— not asked"));
}

#[test]
fn a_question_that_was_asked_and_interrupted_is_told_apart() {
    let asked = report(Some(("which", "was_said_in")), "en");
    assert_eq!(asked.items[0].status, Status::Interrupted);
    assert!(asked.to_string().contains("— asked, then interrupted"), "{asked}");
    // A greeting in the item's part is no question about it.
    assert_eq!(report(Some(("welcome", "was_said_in")), "en").items[0].status, Status::NotReached);
    // Without a mark of its own it has that of an item that was not asked.
    assert!(report(Some(("which", "was_said_in")), "fr").to_string().contains("— not asked"));
}

#[test]
fn a_verdict_names_each_expectation_that_was_not_met() {
    let mission = tea::mission();
    let text = r#"
title = "Strict"
[expect]
accomplished = true
holds = ["(is_with guest waiter)", "(not (is waiter speaking))"]
answered = 1
total = 2
unanswered = []
replans = { at-least = 1, at-most = 3, naming = ["is_with", "greeted"] }
asked-again = []
"#;
    let scenario = mission.read_scenario(pddl::Source::new("strict.toml", text)).unwrap();

    let report = report(Some(("which", "was_unanswered_in")), "en");
    let again = ["drink"].map(pddl::model::Name::new);
    let bad = Outcome {
        accomplished: false,
        ending: "with_human",
        report: &report,
        replans: &[],
        asked_again: &again,
        goals: &[],
        idle: &[Span::new(9, 17)],
    };
    let violations = scenario.expect.judge(&bad, |c| !c.text.starts_with("(is_with"));
    let lines: Vec<String> = violations
        .iter()
        .map(|v| format!("{}: {v}\n", scenario.source.line_column(v.span().start).line))
        .collect();
    expect![[r#"
        2: this disruption did not happen: the run ended before its trigger, or before its delay was over
        4: the mission was not accomplished
        5: (is_with guest waiter) does not hold in the end
        6: 0 items were answered, 1 expected
        7: the total is 0, 2 expected
        8: unanswered: [drink], expected: []
        9: 0 replans, at least 1 expected
        9: no replan names `is_with`
        9: no replan names `greeted`
        10: `drink` was asked again after it had been answered
    "#]]
    .assert_eq(&lines.concat());

    let report = self::report(Some(("green", "was_chosen_in")), "en");
    let names = ["is_with", "greeted"].map(pddl::model::Name::new).to_vec();
    let replans = [Replan { names }];
    let good = Outcome {
        accomplished: true,
        ending: "accomplished",
        report: &report,
        replans: &replans,
        asked_again: &[],
        goals: &[],
        idle: &[],
    };
    assert_eq!(scenario.expect.judge(&good, |_| true), []);
}
