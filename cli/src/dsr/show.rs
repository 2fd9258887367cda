//! `pelea dsr show`: one state.

use super::failed::Failed;
use super::journal::{Moment, open, state};
use crate::console::{Console, Form};
use crate::exit::Exit;
use clap::{Args, ValueEnum};
use dsr::Export;
use formats::{View, seconds};
use serde::Serialize;
use std::path::PathBuf;

/// Arguments of `pelea dsr show`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// The journal: the folder of `pelea run --journal`, or a file in it
    journal: PathBuf,
    /// The state: a version such as `12`, or a time such as `3.5s` [default: the last version]
    #[arg(long, value_name = "VERSION|TIME")]
    at: Option<Moment>,
    /// Show only this node and its neighbourhood
    #[arg(long, value_name = "NODE")]
    around: Option<String>,
    /// The number of edges or transforms that `--around` follows
    #[arg(long, default_value_t = 1, value_name = "N", requires = "around")]
    steps: usize,
    /// The format of the output
    #[arg(long, value_enum, default_value_t = Picture::Text)]
    format: Picture,
}

/// The format of a state.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Picture {
    /// Sentences
    Text,
    /// Graphviz
    Dot,
    /// A picture
    Svg,
    /// GraphML
    Graphml,
    /// The export, as one line of JSON
    Json,
}

#[derive(Serialize)]
struct Record {
    kind: &'static str,
    #[serde(flatten)]
    export: Export,
}

pub(super) fn run(arguments: &Arguments, console: &mut Console<'_>) -> Result<Exit, Failed> {
    if arguments.format == Picture::Json {
        console.set_form(Form::Json);
    }
    let (recording, exit) = open(&arguments.journal, console)?;
    let snapshot = state(&recording, arguments.at)?;
    let view = match &arguments.around {
        None => View::whole(&snapshot),
        Some(name) => {
            let unknown = || {
                let text = format!("no node `{name}` in version {}", snapshot.version().0);
                let nearest = diagnostics::nearest(name, snapshot.nodes().map(|node| node.name()));
                Failed(
                    Exit::No,
                    nearest.map_or(text.clone(), |nearest| format!("{text}; is it `{nearest}`?")),
                )
            };
            View::around(&snapshot, snapshot.node(name).ok_or_else(unknown)?, arguments.steps)
        }
    };
    console.record(&Record { kind: "graph", export: view.export() });
    match arguments.format {
        Picture::Text => {
            let (version, time) = (snapshot.version().0, seconds(snapshot.time()));
            console.result(&format!("version {version}, at {time:.3} s: {} nodes", view.nodes().count()));
            formats::lines(&view).iter().for_each(|line| console.result(line));
        }
        Picture::Dot => console.result(formats::dot(&view).trim_end()),
        Picture::Svg => console.result(formats::svg(&view).trim_end()),
        Picture::Graphml => console.result(formats::graphml(&view).trim_end()),
        Picture::Json => {}
    }
    Ok(exit)
}
