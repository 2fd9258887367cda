//! `pelea explain [CODE]`: what a diagnostic's code means, with a wrong example and a right one.
//!
//! Without a code, all of them in a line each. As JSON there is a line per code:
//!
//! ```json
//! {"kind": "explanation", "code": "E0202", "title": "unknown predicate", "meaning": "…", "why": "…",
//!  "wrong": ["…"], "right": ["…"]}
//! ```
//!
//! `wrong` and `right` hold the texts of files, those that others need before them.

use crate::console::{Console, Form};
use crate::exit::Exit;
use crate::render::Message;
use clap::Args;
use pddl::Explanation;
use serde::Serialize;
use std::fmt::Write as _;

/// Longest line of a text.
const WIDTH: usize = 80;

/// Which code to explain.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Such as `E0202`; without it, all codes are listed.
    code: Option<String>,
}

pub(crate) fn run(arguments: &Arguments, console: &mut Console<'_>) -> Exit {
    let Some(code) = &arguments.code else {
        for explanation in pddl::explanations() {
            show(explanation, &format!("{}  {}", explanation.code, explanation.title), console);
        }
        return Exit::Yes;
    };
    match pddl::explain(code) {
        Ok(explanation) => {
            show(explanation, text(explanation).trim_end(), console);
            Exit::Yes
        }
        Err(unknown) => {
            let mut message = Message::error(format!("no diagnostic has the code `{code}`"));
            message.help = Some(match unknown.suggestion {
                Some(nearest) => format!("did you mean `{nearest}`?"),
                None => "`pelea explain` lists all codes".to_owned(),
            });
            message.show(console);
            Exit::Unreadable
        }
    }
}

fn show(explanation: &Explanation, text: &str, console: &mut Console<'_>) {
    match console.form() {
        Form::Text => console.result(text),
        Form::Json => console.record(&ExplanationRecord { kind: "explanation", explanation }),
    }
}

/// For a terminal.
fn text(explanation: &Explanation) -> String {
    let Explanation { code, title, meaning, why, wrong, right } = explanation;
    let mut text = format!("{code}: {title}\n\n{}\n{}", wrapped(meaning), wrapped(why));
    for (heading, files) in [("Wrong", wrong), ("Right", right)] {
        if !files.is_empty() {
            let _ = write!(text, "\n{heading}:\n");
        }
        for file in *files {
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

/// In lines that a terminal shows whole.
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
}
