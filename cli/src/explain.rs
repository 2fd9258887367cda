//! `pelea explain [CODE]`: the meaning of a diagnostic code, with a wrong example and a right one.
//!
//! Every crate that reports codes has its own pages; this module puts them together. Without a code, it lists all codes,
//! one per line. With `--json`, one line per code:
//!
//! ```json
//! {"kind": "explanation", "code": "E0202", "title": "unknown predicate", "meaning": "…", "why": "…",
//!  "wrong": ["…"], "right": ["…"]}
//! ```
//!
//! `wrong` and `right` contain the texts of files, each after the files that it needs; the first line of a part of a mission
//! names its file. The code of
//! a lint also has the field `lint`, the lint's name.

use crate::console::{Console, Form};
use crate::exit::Exit;
use crate::render::error_with_help;
use clap::Args;
use diagnostics::{Explanation, explained, nearest};
use lints::{Level, Lint};
use serde::Serialize;
use std::fmt::Write as _;
use std::sync::LazyLock;

/// The length of the longest line.
const WIDTH: usize = 80;

/// The arguments of `pelea explain`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// A code such as `E0202`, or a lint such as `unused-parameter` [default: list all codes]
    code: Option<String>,
}

/// The codes that `assemble` and `scenario` report.
#[rustfmt::skip]
static OWN: LazyLock<Vec<Explanation>> = LazyLock::new(|| explained![
    "assemble": "E1001" "E1002" "E1003" "E1004" "E1005" "E1006" "E1007" "E1008" "E1009" "E1010"
    "E1011";
]);

/// The codes of scenarios as tests.
static PLAYED: LazyLock<Vec<Explanation>> = LazyLock::new(|| explained!["test": "T0401" "T0402";]);

/// All explanations but those of lints: of the language, of missions, of suites.
fn explanations() -> impl Iterator<Item = &'static Explanation> {
    let mission = diagnostics::toml::explanations().chain(mission::explanations());
    pddl::explanations().chain(mission).chain(OWN.iter()).chain(suite::explanations()).chain(PLAYED.iter())
}

pub(crate) fn run(arguments: &Arguments, console: &mut Console<'_>) -> Exit {
    let Some(code) = &arguments.code else {
        list(console);
        return Exit::Yes;
    };
    if let Some(lint) = lints::find(code) {
        let text = text(&lint.explanation) + "\n" + &wrapped(&silencing(lint));
        show(&lint.explanation, Some(lint), text.trim_end(), console);
        return Exit::Yes;
    }
    if let Some(explanation) = explanations().find(|e| e.code.eq_ignore_ascii_case(code)) {
        show(explanation, None, text(explanation).trim_end(), console);
        return Exit::Yes;
    }
    let help = match similar(code) {
        Some(nearest) => format!("did you mean `{nearest}`?"),
        None => "`pelea explain` lists all codes".to_owned(),
    };
    error_with_help(format!("no diagnostic has the code `{code}`"), Some(&help), console);
    Exit::Unreadable
}

fn list(console: &mut Console<'_>) {
    for explanation in explanations() {
        show(explanation, None, &format!("{}  {}", explanation.code, explanation.title), console);
    }
    for lint in lints::all() {
        let Lint { name, explanation, level, .. } = lint;
        let pedantic = if *level == Level::Pedantic { ", pedantic" } else { "" };
        let line = format!("{}  {} ({name}{pedantic})", explanation.code, explanation.title);
        show(explanation, Some(lint), &line, console);
    }
}

/// The code of the same number, or else the code or lint with the most similar spelling.
fn similar(code: &str) -> Option<String> {
    let codes = || explanations().map(|e| e.code).chain(lints::all().map(Lint::code));
    let same_number = |known: &&str| code.len() > 1 && known.get(1..) == code.get(1..);
    let same = codes().find(same_number).map(str::to_owned);
    same.or_else(|| nearest(code, codes().chain(lints::all().map(|lint| lint.name))))
}

/// How to silence a lint if its finding is intended.
fn silencing(lint: &Lint) -> String {
    let shown = match lint.level {
        Level::Default => "",
        Level::Pedantic => "It is shown by `pelea check --pedantic` only. ",
    };
    format!("{shown}Where it is meant, say so on the same line or the line before: `; allow({})`.", lint.name)
}

fn show(explanation: &Explanation, lint: Option<&Lint>, text: &str, console: &mut Console<'_>) {
    match console.form() {
        Form::Text => console.result(text),
        Form::Json => {
            let lint = lint.map(|lint| lint.name);
            console.record(&ExplanationRecord { kind: "explanation", explanation, lint });
        }
    }
}

/// The explanation as text for a terminal.
fn text(explanation: &Explanation) -> String {
    let Explanation { code, title, meaning, why, wrong, right } = explanation;
    let why: String = why.lines().map(wrapped).collect();
    let mut text = format!("{code}: {title}\n\n{}\n{}", wrapped(meaning), why);
    for (heading, files) in [("Wrong", wrong), ("Right", right)] {
        if !files.is_empty() {
            let _ = write!(text, "\n{heading}:\n");
        }
        for file in files {
            text.push('\n');
            for line in file.lines() {
                text.push_str(if line.is_empty() { "" } else { "    " });
                text.push_str(line);
                text.push('\n');
            }
        }
    }
    text
}

/// Wraps text to lines that fit a terminal.
fn wrapped(paragraph: &str) -> String {
    let (mut text, mut column) = (String::new(), 0);
    for word in paragraph.split(' ') {
        let width = word.chars().count();
        if column > 0 {
            let fits = column + 1 + width <= WIDTH;
            text.push(if fits { ' ' } else { '\n' });
            column = if fits { column + 1 } else { 0 };
        }
        text.push_str(word);
        column += width;
    }
    text.push('\n');
    text
}

#[derive(Serialize)]
struct ExplanationRecord<'a> {
    kind: &'static str,
    #[serde(flatten)]
    explanation: &'a Explanation,
    /// The name of the lint with this code.
    #[serde(skip_serializing_if = "Option::is_none")]
    lint: Option<&'a str>,
}
