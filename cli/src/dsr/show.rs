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
    /// A journal: the folder of `pelea run --journal`, or a file in it.
    journal: PathBuf,
    /// A version such as `12`, or a time such as `3.5s`; the last version if not given.
    #[arg(long, value_name = "VERSION|TIME")]
    at: Option<Moment>,
    /// Only this node and what is near it.
    #[arg(long, value_name = "NODE")]
    around: Option<String>,
    /// How many edges or transforms away `--around` reaches.
    #[arg(long, default_value_t = 1, value_name = "N", requires = "around")]
    steps: usize,
    #[arg(long, value_enum, default_value_t = Picture::Text)]
    format: Picture,
}

/// How a state is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Picture {
    /// Sentences.
    Text,
    /// The language of graphviz.
    Dot,
    /// A picture.
    Svg,
    /// For tools that read GraphML.
    Graphml,
    /// The export, in a line.
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
