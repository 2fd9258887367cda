//! One self-contained page: the heat map disruption × instant, and the story of each run behind it.
//!
//! The page holds its data as JSON, so that it needs no server and no second file. A story starts at the disruption; what
//! was before is the story of the undisturbed run, which the page has once. Of a good run the first lines are kept, of a
//! bad one all; the scenario to play it again stands below.

use super::instants::Instant;
use super::library::Disturbance;
use super::record::{LineId, Outcome, Run};
use clap::ValueEnum;
use maud::{DOCTYPE, PreEscaped, html};
use serde::Serialize;
use std::collections::BTreeMap;

/// Lines of a good run's story.
const LINES: usize = 30;

/// What the page is made from.
pub(super) struct Input<'a> {
    pub(super) mission: &'a str,
    pub(super) title: &'a str,
    pub(super) library: &'a [Disturbance],
    pub(super) instants: &'a [Instant],
    pub(super) runs: &'a [Run],
    pub(super) lines: &'a [String],
    pub(super) undisturbed: &'a [(f64, LineId)],
    pub(super) stories: Stories,
}

/// Which runs have their story in the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Stories {
    /// Every run.
    All,
    /// Those that are not good; the page is small.
    Failures,
}

#[derive(Serialize)]
struct Data<'a> {
    mission: &'a str,
    seed: u64,
    outcomes: Vec<Legend>,
    instants: Vec<(u64, f64, &'a str)>,
    rows: Vec<Row<'a>>,
    lines: Vec<&'a str>,
    undisturbed: Vec<f64>,
}

#[derive(Serialize)]
struct Legend {
    letter: char,
    name: &'static str,
    colour: &'static str,
}

#[derive(Serialize)]
struct Row<'a> {
    title: &'a str,
    /// A letter per instant: how the worst run of all seeds ended, capital if it broke an invariant.
    cells: String,
    stories: BTreeMap<usize, Vec<f64>>,
    cut: BTreeMap<usize, bool>,
    broken: BTreeMap<usize, Vec<&'a str>>,
    scenario: &'a str,
    /// What the run of an instant has drawn.
    tokens: BTreeMap<usize, &'a str>,
}

/// The letter and the colour of an outcome. The colours differ in lightness too.
fn legend(outcome: Outcome) -> Legend {
    let (letter, colour) = match outcome {
        Outcome::Accomplished => ('a', "#bfe3bf"),
        Outcome::WithHuman => ('h', "#7fb2d9"),
        Outcome::StillCalling => ('c', "#4a76b8"),
        Outcome::StillGoing => ('g', "#e0a840"),
        Outcome::GivenUp => ('n', "#c8762f"),
        Outcome::Panicked => ('p', "#7a1f1f"),
    };
    Legend { letter, name: outcome.name(), colour }
}

/// The page.
pub(super) fn write(input: &Input<'_>) -> String {
    let mut lines = Used::of(input.lines);
    let undisturbed = lines.flat(input.undisturbed);
    let rows: Vec<Row<'_>> =
        input.library.iter().map(|disturbance| row(disturbance, input, &mut lines)).collect();
    let counts = super::table::rows(input.runs);
    let seed = input.runs.iter().map(|run| run.key.seed).min().unwrap_or_default();
    let outcomes: Vec<Legend> = Outcome::ALL.into_iter().map(legend).collect();
    let legends: Vec<(&str, &str)> = outcomes.iter().map(|l| (l.name, l.colour)).collect();
    let data = Data {
        mission: input.mission,
        seed,
        outcomes,
        instants: input.instants.iter().map(|i| (i.version, i.time, i.change.as_str())).collect(),
        rows,
        lines: lines.kept,
        undisturbed,
    };
    // `</script>` inside a string would end the element.
    let json = serde_json::to_string(&data).unwrap_or_default().replace("</", "<\\/");
    let click = match input.stories {
        Stories::All => "Click a cell for the run's story.",
        Stories::Failures => "Click a cell for the scenario that plays its run.",
    };
    let bad = input.runs.iter().filter(|run| !run.is_good()).count();
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (input.title) " · campaign" }
                style { (PreEscaped(include_str!("page.css"))) }
            }
            body {
                h1 { (input.title) ": " (input.runs.len()) " runs, " (bad) " not good" }
                p { "A row is a disruption, a column an instant of the undisturbed run; the number counts runs that broke an invariant. " (click) }
                p class="legend" {
                    @for (name, colour) in legends {
                        span { i style={ "background:" (colour) } {} (name) }
                    }
                    span { i style="background:#c00" {} "an invariant was broken" }
                }
                div class="map" {
                    table {
                        @for disturbance in input.library {
                            tr {
                                th { (disturbance.title) }
                                td class="count" { (counts.get(disturbance.name.as_str()).map_or(0, |row| row.broken)) }
                                td { canvas {} }
                            }
                        }
                    }
                }
                div id="run" {}
                script id="data" type="application/json" { (PreEscaped(json)) }
                script { (PreEscaped(include_str!("page.js"))) }
            }
        }
    };
    page.into_string()
}

fn row<'a>(disturbance: &'a Disturbance, input: &Input<'a>, lines: &mut Used<'_>) -> Row<'a> {
    let mut worst: BTreeMap<usize, &Run> = BTreeMap::new();
    for run in input.runs.iter().filter(|run| run.key.disruption == disturbance.name) {
        let at = worst.entry(run.key.instant).or_insert(run);
        let badness = |run: &Run| (!run.broken.is_empty(), run.outcome);
        if badness(run) > badness(at) {
            *at = run;
        }
    }
    let mut row = Row {
        title: &disturbance.title,
        cells: String::new(),
        stories: BTreeMap::new(),
        cut: BTreeMap::new(),
        broken: BTreeMap::new(),
        scenario: &disturbance.template,
        tokens: BTreeMap::new(),
    };
    for at in 0..input.instants.len() {
        let Some(run) = worst.get(&at) else {
            row.cells.push(' ');
            continue;
        };
        let letter = legend(run.outcome).letter;
        row.cells.push(if run.broken.is_empty() { letter } else { letter.to_ascii_uppercase() });
        let kept = match (run.is_good(), input.stories) {
            (false, _) => run.story.len(),
            (true, Stories::All) => run.story.len().min(LINES),
            (true, Stories::Failures) => 0,
        };
        if kept > 0 {
            row.stories.insert(at, lines.flat(&run.story[..kept]));
        }
        if kept < run.story.len() {
            row.cut.insert(at, true);
        }
        row.tokens.extend(run.token.as_deref().map(|token| (at, token)));
        if !run.broken.is_empty() {
            row.broken.insert(at, run.broken.iter().map(|broken| broken.text.as_str()).collect());
        }
    }
    row
}

/// The lines of the page's stories, each once.
struct Used<'a> {
    all: &'a [String],
    kept: Vec<&'a str>,
    numbers: BTreeMap<LineId, u32>,
}

impl<'a> Used<'a> {
    fn of(all: &'a [String]) -> Self {
        Self { all, kept: Vec::new(), numbers: BTreeMap::new() }
    }

    /// A story as times and numbers of lines.
    fn flat(&mut self, story: &[(f64, LineId)]) -> Vec<f64> {
        let Self { all, kept, numbers } = self;
        let mut number = |line: LineId| {
            *numbers.entry(line).or_insert_with(|| {
                let at = usize::try_from(line).unwrap_or(usize::MAX);
                kept.push(all.get(at).map_or("", String::as_str));
                u32::try_from(kept.len() - 1).unwrap_or_default()
            })
        };
        story.iter().flat_map(|(time, line)| [*time, f64::from(number(*line))]).collect()
    }
}
