//! The library of disruptions: what a campaign does to a run at each of its instants.
//!
//! A file has a title and the `[[disruption]]`s of a scenario. One without a trigger happens at the instant that the
//! campaign chooses; another has its own trigger and answers to what the first one did ("when the person is out of
//! view, they return after three seconds"). A file may also replace the patient or the clinician.
//!
//! A file that flips any token, `(_ _ _)`, stands for one disruption per predicate; which token of it, each run chooses by
//! a number, the *draw*.

use std::sync::Arc;

use pddl::Source;
use pddl::model::Name;

use super::disruption::{Triggers, by_label};
use super::read;
use super::{Act, Clinician, Disruption, Patient, Scenario, Token, Trigger};
use super::{disruption, patient};
use crate::errors::MissionErrors;
use crate::files::{Files, join, stem};
use crate::mission::Mission;
use diagnostics::Finding;
use diagnostics::toml::{Reader, Table};

/// A file of the library.
#[derive(Clone, Debug)]
pub struct Disturbance {
    /// The file's name without extension.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// Another patient than the scenario's.
    pub patient: Option<Patient>,
    /// Another clinician than the scenario's.
    pub clinician: Option<Clinician>,
    /// What happens.
    pub disruptions: Vec<Disruption>,
    /// Its text; all its spans refer to it.
    pub source: Arc<Source>,
}

impl Disturbance {
    /// One disruption per predicate, if the file flips a token of any.
    fn by_predicate(self) -> Vec<Self> {
        let open = self.disruptions.iter().find_map(|disruption| match &disruption.act {
            Act::FlipOneOf(tokens) => Some(by_label(tokens)),
            _ => None,
        });
        let Some(labels) = open.filter(|labels| labels.len() > 1) else { return vec![self] };
        let one = |(label, tokens): (Name, Arc<[Token]>)| {
            let mut one = self.clone();
            one.name = format!("{}-{label}", self.name);
            one.title = format!("{}: {label}", self.title);
            for disruption in &mut one.disruptions {
                if let Act::FlipOneOf(all) = &mut disruption.act {
                    *all = Arc::clone(&tokens);
                }
            }
            one
        };
        labels.into_iter().map(one).collect()
    }

    /// The token that a draw chooses, if the file leaves it open.
    pub fn token(&self, draw: u64) -> Option<&Token> {
        self.disruptions.iter().find_map(|disruption| match &disruption.act {
            Act::FlipOneOf(tokens) => drawn(tokens, draw),
            _ => None,
        })
    }

    /// The scenario with this happening at an instant.
    pub fn within(&self, scenario: &Scenario, instant: &Trigger, draw: u64) -> Scenario {
        let mut disturbed = scenario.clone();
        disturbed.title.clone_from(&self.title);
        disturbed.patient = self.patient.clone().unwrap_or(disturbed.patient);
        disturbed.clinician = self.clinician.unwrap_or(disturbed.clinician);
        disturbed.disruptions.extend(self.disruptions.iter().cloned().map(|mut disruption| {
            if matches!(disruption.trigger, Trigger::Instant) {
                disruption.trigger = instant.clone();
            }
            if let Act::FlipOneOf(tokens) = &disruption.act
                && let Some(token) = drawn(tokens, draw)
            {
                disruption.act = Act::Flip(token.clone());
            }
            disruption
        }));
        disturbed
    }
}

/// Neighbouring draws are far apart.
fn drawn(tokens: &[Token], draw: u64) -> Option<&Token> {
    let scattered = draw.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 32;
    let count = u64::try_from(tokens.len()).unwrap_or(u64::MAX);
    tokens.get(usize::try_from(scattered.checked_rem(count)?).unwrap_or_default())
}

impl Mission {
    /// All files of the library, the robot's before the mission's, each by name.
    ///
    /// # Errors
    /// Every mistake in every file.
    pub fn library(&self, files: &dyn Files) -> Result<Vec<Disturbance>, MissionErrors> {
        let mut sources = self.sources.clone();
        let (mut library, mut findings) = (Vec::new(), Vec::new());
        for folder in [&self.manifest.paths.robot_disruptions, &self.manifest.paths.disruptions] {
            // Either folder may be missing.
            let mut names = files.list(folder).unwrap_or_default();
            names.retain(|name| name.ends_with(".toml"));
            names.sort();
            for name in names {
                let path = join(folder, &name);
                let Ok(text) = files.read(&path) else { continue };
                let id = sources.push(Source::new(path, text));
                let source = sources.shared(id);
                let (read, found) =
                    Reader::read(id, &source, |reader, root| disturbance(reader, self, root, &source));
                findings.extend(found);
                library.extend(read.into_iter().flat_map(Disturbance::by_predicate));
            }
        }
        if findings.iter().any(Finding::is_error) {
            return Err(MissionErrors { sources, findings });
        }
        Ok(library)
    }
}

fn disturbance(
    reader: &mut Reader<'_>,
    mission: &Mission,
    mut root: Table<'_>,
    source: &Arc<Source>,
) -> Option<Disturbance> {
    let title = root.required_text(reader, "title");
    let patient = root.table(reader, "patient").map(|table| patient::read(reader, mission, Some(table)));
    let clinician = root.table(reader, "clinician").map(|table| read::clinician(reader, Some(table)));
    let disruptions = root.tables(reader, "disruption");
    let read = |table| disruption::read(reader, mission, table, Triggers::OrInstant);
    let disruptions = disruptions.into_iter().filter_map(read).collect();
    root.finish(reader);
    let name = stem(source.name()).to_owned();
    Some(Disturbance {
        name,
        title: title?.value,
        patient,
        clinician,
        disruptions,
        source: Arc::clone(source),
    })
}
