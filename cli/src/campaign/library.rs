//! The library of disruptions of a mission: what its folder and its robot's folder have.

use crate::console::Console;
use crate::disk::{Disk, show};
use crate::exit::Exit;
use crate::render;
use diagnostics::nearest;
use mission::Mission;
use mission::scenario::Disturbance as File;
use toml::{Table, Value};

/// What stands in a template for the trigger at the instant.
const PLACE: &str = "@VERSION@";
/// What stands in a template for the token that the run has drawn.
const TOKEN: &str = "@TOKEN@";

/// A disruption of the library.
pub(super) struct Disturbance {
    /// Its file's name.
    pub(super) name: String,
    /// One line for people.
    pub(super) title: String,
    /// It, read.
    pub(super) file: File,
    /// The scenario that shows it, with [`PLACE`] for the version.
    pub(super) template: String,
}

/// The disruptions of a mission; if some are `wanted`, only those.
pub(super) fn read(
    mission: &Mission,
    base: &Table,
    wanted: &[String],
    console: &mut Console<'_>,
) -> Result<Vec<Disturbance>, Exit> {
    let library = match mission.library(&Disk) {
        Ok(library) => library,
        Err(errors) => return Err(show(&errors.sources, &errors.findings, console)),
    };
    if let Some(unknown) = wanted.iter().find(|name| !library.iter().any(|d| d.name == **name)) {
        let help = match nearest(unknown, library.iter().map(|d| d.name.as_str())) {
            Some(name) => format!("did you mean `{name}`?"),
            None => format!("the library has: {}", names(&library)),
        };
        render::error_with_help(format!("there is no disruption `{unknown}`"), Some(&help), console);
        return Err(Exit::Unreadable);
    }
    let library = library.into_iter().filter(|d| wanted.is_empty() || wanted.contains(&d.name));
    let disturbance = |file: File| {
        let template = scenario(base, &file, &Value::String(PLACE.to_owned()), TOKEN).to_string();
        let template = template.replace(&format!("\"{PLACE}\""), PLACE);
        Disturbance { name: file.name.clone(), title: file.title.clone(), template, file }
    };
    Ok(library.map(disturbance).collect())
}

fn names(library: &[File]) -> String {
    library.iter().map(|d| d.name.as_str()).collect::<Vec<_>>().join(", ")
}

/// The scenario as a table: the base with the disruption in it, at a version or at a time, with the token that was drawn.
pub(super) fn scenario(base: &Table, file: &File, version: &Value, token: &str) -> Table {
    let own: Table = file.source.text().parse().unwrap_or_default();
    let mut scenario = base.clone();
    scenario.remove("expect");
    scenario.insert("title".to_owned(), Value::String(file.title.clone()));
    for key in ["patient", "clinician"] {
        if let Some(table) = own.get(key) {
            scenario.insert(key.to_owned(), table.clone());
        }
    }
    let list = |table: &Table| table.get("disruption").and_then(Value::as_array).cloned().unwrap_or_default();
    let mut disruptions = list(base);
    for mut disruption in list(&own) {
        if let Some(table) = disruption.as_table_mut()
            && !["at", "when", "step", "version"].iter().any(|key| table.contains_key(*key))
        {
            let key = if version.is_float() { "at" } else { "version" };
            table.insert(key.to_owned(), version.clone());
        } else if let Some(table) = disruption.as_table_mut() {
            // It answers to what others did, if they did.
            table.insert("optional".to_owned(), Value::Boolean(true));
        }
        if let Some(flip) = disruption.as_table_mut().filter(|table| table.contains_key("token"))
            && file.token(0).is_some()
        {
            flip.insert("token".to_owned(), Value::String(token.to_owned()));
            flip.remove("except");
        }
        disruptions.push(disruption);
    }
    scenario.insert("disruption".to_owned(), Value::Array(disruptions));
    scenario
}
