//! Reading a scenario file.

use std::sync::Arc;
use std::time::Duration;

use pddl::Source;
use pddl::model::{ObjectId, PredicateId, TypeId};

use super::{Clinician, Scenario, disruption, expect, patient};
use crate::errors::MissionErrors;
use crate::files::stem;
use crate::layers::Layers;
use crate::mission::Mission;
use diagnostics::Finding;
use diagnostics::did_you_mean;
use diagnostics::toml::{Reader, Table, Text};

/// Reads `source` as a scenario of `mission`.
pub(crate) fn read(mission: &Mission, source: Source) -> Result<Scenario, MissionErrors> {
    let mut sources = mission.sources.clone();
    let id = sources.push(source);
    let source = sources.shared(id);
    let (scenario, mut findings) =
        Reader::read(id, &source, |reader, root| read_root(reader, mission, root, &source));
    match scenario {
        Some(scenario) if !findings.iter().any(Finding::is_error) => Ok(scenario),
        _ => {
            findings.sort_by_key(|f| f.place.span);
            Err(MissionErrors { sources, findings })
        }
    }
}

fn read_root(
    reader: &mut Reader<'_>,
    mission: &Mission,
    mut root: Table<'_>,
    source: &Arc<Source>,
) -> Option<Scenario> {
    let layers = &mission.layers;
    let title = root.required_text(reader, "title");
    let patient = root.table(reader, "patient");
    let patient = patient::read(reader, mission, patient);
    let clinician = root.table(reader, "clinician");
    let clinician = read_clinician(reader, clinician);
    let disruptions = root.tables(reader, "disruption");
    let disruptions = disruptions.into_iter().filter_map(|t| disruption::read(reader, layers, t)).collect();
    let expect = root.table(reader, "expect");
    let expect = expect::read(reader, layers, expect);
    root.finish(reader);
    Some(Scenario {
        name: stem(source.name()).to_owned(),
        title: title?.value,
        patient,
        clinician,
        disruptions,
        expect,
        source: Arc::clone(source),
    })
}

fn read_clinician(reader: &mut Reader<'_>, table: Option<Table<'_>>) -> Clinician {
    let mut clinician = Clinician { comes_after: None, stays: Duration::from_secs(5), fetches: true };
    if let Some(mut table) = table {
        clinician.comes_after = table.seconds(reader, "comes-after");
        clinician.stays = table.seconds(reader, "stays").unwrap_or(clinician.stays);
        clinician.fetches = table.boolean(reader, "fetches").unwrap_or(clinician.fetches);
        table.finish(reader);
    }
    clinician
}

/// A node of a type, by its name.
pub(super) fn node(
    reader: &mut Reader<'_>,
    layers: &Layers,
    text: &Text,
    ty: TypeId,
    kind: &str,
) -> Option<ObjectId> {
    find(reader, layers, text, kind, &|id| layers.is_a(id, ty))
}

/// A node that may stand as the `position`-th argument of a predicate.
pub(super) fn argument(
    reader: &mut Reader<'_>,
    layers: &Layers,
    text: &Text,
    predicate: PredicateId,
    position: usize,
    kind: &str,
) -> Option<ObjectId> {
    let parameter = layers.nodes.predicates[predicate].variables.parameters().get(position);
    let objects = &layers.graph.model.objects;
    let fits = |id| parameter.is_some_and(|p| layers.nodes.types.is_subset(&objects[id].types, &p.types));
    find(reader, layers, text, kind, &fits)
}

fn find(
    reader: &mut Reader<'_>,
    layers: &Layers,
    text: &Text,
    kind: &str,
    fits: &dyn Fn(ObjectId) -> bool,
) -> Option<ObjectId> {
    let graph = &layers.graph.model;
    let found = graph.object(&text.value.to_ascii_lowercase()).filter(|&id| fits(id));
    if found.is_none() {
        let known: Vec<&str> = graph.objects.ids().filter(|&id| fits(id)).map(|id| layers.name(id)).collect();
        let help = did_you_mean(&text.value, known.iter().copied());
        let help = help.unwrap_or_else(|| format!("one of: {}", known.join(", ")));
        let message = format!("there is no {kind} `{}`", text.value);
        reader.findings.push(Finding::error("E0909", reader.place(text.span), message).help(help));
    }
    found
}
