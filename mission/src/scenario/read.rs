//! Reading a scenario file.

use std::sync::Arc;
use std::time::Duration;

use pddl::Source;

use super::disruption::Triggers;
use super::{Clinician, Scenario, disruption, expect, patient};
use crate::errors::MissionErrors;
use crate::files::{Files, join, stem};
use crate::mission::Mission;
use diagnostics::did_you_mean;
use diagnostics::toml::{Reader, Table};
use diagnostics::{Finding, Sources};

impl Mission {
    /// Reads a scenario of the mission's folder by its name.
    pub fn scenario(&self, files: &dyn Files, name: &str) -> Result<Scenario, MissionErrors> {
        let path = join(&self.manifest.paths.scenarios, &format!("{name}.toml"));
        match files.read(&path) {
            Ok(text) => self.read_scenario(Source::new(path, text)),
            Err(error) => {
                let place = Sources::start_of(self.manifest_source);
                let help = did_you_mean(name, self.scenarios()).or_else(|| {
                    let all: Vec<&str> = self.scenarios().collect();
                    Some(format!("the scenarios are: {}", all.join(", ")))
                });
                let finding = Finding::error("E0901", place, format!("cannot read `{path}`: {error}"));
                Err(MissionErrors { sources: self.sources.clone(), findings: vec![finding.help_if(help)] })
            }
        }
    }

    /// Reads a scenario from any source.
    pub fn read_scenario(&self, source: Source) -> Result<Scenario, MissionErrors> {
        let mut sources = self.sources.clone();
        let id = sources.push(source);
        let source = sources.shared(id);
        let (scenario, mut findings) =
            Reader::read(id, &source, |reader, root| read_root(reader, self, root, &source));
        match scenario {
            Some(scenario) if !findings.iter().any(Finding::is_error) => Ok(scenario),
            _ => {
                findings.sort_by_key(|f| f.place.span);
                Err(MissionErrors { sources, findings })
            }
        }
    }
}

fn read_root(
    reader: &mut Reader<'_>,
    mission: &Mission,
    mut root: Table<'_>,
    source: &Arc<Source>,
) -> Option<Scenario> {
    let title = root.required_text(reader, "title");
    let patient = root.table(reader, "patient");
    let patient = patient::read(reader, mission, patient);
    let clinician = root.table(reader, "clinician");
    let clinician = self::clinician(reader, clinician);
    let horizon = root.seconds(reader, "horizon");
    let disruptions = root.tables(reader, "disruption");
    let disruptions = disruptions
        .into_iter()
        .filter_map(|t| disruption::read(reader, mission, t, Triggers::Required))
        .collect();
    let expect = root.table(reader, "expect");
    let expect = expect::read(reader, mission, expect);
    root.finish(reader);
    Some(Scenario {
        name: stem(source.name()).to_owned(),
        title: title?.value,
        patient,
        clinician,
        horizon,
        disruptions,
        expect,
        source: Arc::clone(source),
    })
}

/// Reads `[clinician]`.
pub(super) fn clinician(reader: &mut Reader<'_>, table: Option<Table<'_>>) -> Clinician {
    let stays = Duration::from_secs(5);
    let mut clinician = Clinician { comes_after: None, only_urgent: false, stays, fetches: true };
    if let Some(mut table) = table {
        clinician.comes_after = table.seconds(reader, "comes-after");
        clinician.only_urgent = table.boolean(reader, "only-urgent").unwrap_or_default();
        clinician.stays = table.seconds(reader, "stays").unwrap_or(clinician.stays);
        clinician.fetches = table.boolean(reader, "fetches").unwrap_or(clinician.fetches);
        table.finish(reader);
    }
    clinician
}
