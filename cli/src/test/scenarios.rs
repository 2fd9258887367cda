//! The scenarios of missions as cases: each is played in simulated time and compared with its expectations.
//!
//! A case passes if every expectation of the scenario is met, every disruption happened, and no invariant was broken. A
//! scenario that says nothing of its ending expects the mission to be accomplished.
//!
//! Codes: T0401 an expectation, T0402 an invariant.

use crate::assemble::{Assembly, assemble, load};
use crate::console::Console;
use crate::disk;
use crate::exit::Exit;
use crate::nearby::MANIFEST;
use crate::panics;
use crate::run::{Content, Verdict, rehearse};
use crate::scenario;
use diagnostics::{Finding, Place, SourceId, Sources};
use mission::scenario::Scenario;
use std::path::Path;
use std::sync::Arc;

/// A mission that is ready to be tested.
pub(super) struct Troupe {
    path: String,
    content: Content,
    assembly: Assembly,
}

/// A scenario of a mission.
pub(super) struct Rehearsal<'a> {
    troupe: &'a Troupe,
    scenario: Scenario,
    pub(super) name: String,
    /// The mission's texts, and the scenario's.
    pub(super) sources: Sources,
    source: SourceId,
}

impl Troupe {
    /// Reads a mission, or shows why it cannot be tested.
    pub(super) fn read(folder: &Path, console: &mut Console<'_>) -> Result<Self, Exit> {
        let mission = load(&folder.join(MANIFEST)).map_err(|error| error.show(console))?;
        let (assembly, findings) = assemble(&mission);
        let Some(assembly) = assembly else { return Err(disk::show(&mission.sources, &findings, console)) };
        let path = super::find::shown(folder);
        let language = mission.manifest.language.clone();
        Ok(Self { path, content: Content { mission: Arc::new(mission), language }, assembly })
    }

    /// The path of its folder.
    pub(super) fn path(&self) -> &str {
        &self.path
    }

    /// Its scenarios, or shows why one cannot be read.
    pub(super) fn scenarios(&self, console: &mut Console<'_>) -> Result<Vec<Rehearsal<'_>>, Exit> {
        let mission = &self.content.mission;
        let (mut all, mut worst) = (Vec::new(), Exit::Yes);
        for name in mission.scenarios() {
            let read = scenario::read(mission, name).and_then(|scenario| {
                // Conditions are compiled again for each run.
                scenario::stage(scenario.clone(), mission, &self.assembly.vocabulary).map(|_| scenario)
            });
            match read {
                Ok(scenario) => all.push(self.rehearsal(scenario)),
                Err(error) => worst = worst.and(error.show(console)),
            }
        }
        if worst == Exit::Yes { Ok(all) } else { Err(worst) }
    }

    fn rehearsal(&self, scenario: Scenario) -> Rehearsal<'_> {
        let mut sources = self.content.mission.sources.clone();
        let name = format!("{}::run", scenario.source.name());
        let source = sources.push((*scenario.source).clone());
        Rehearsal { troupe: self, scenario, name, sources, source }
    }
}

impl Rehearsal<'_> {
    /// The path of its mission.
    pub(super) fn mission(&self) -> &str {
        self.troupe.path()
    }

    /// Plays it; how the run differs from what is expected.
    pub(super) fn run(&self) -> Vec<Finding> {
        let Troupe { content, assembly, .. } = self.troupe;
        let start = Sources::start_of(self.source);
        let Ok(staged) = scenario::stage(self.scenario.clone(), &content.mission, &assembly.vocabulary)
        else {
            return vec![Finding::answer(start, "this scenario cannot be compiled")];
        };
        match panics::survive(|| rehearse(content.clone(), assembly.again(), staged)) {
            Some(Some(verdict)) => self.compare(&verdict),
            None => vec![Finding::answer(start, "a bug in pelea: the run panicked")],
            Some(None) => vec![Finding::answer(start, "the system gives no threads or timers")],
        }
    }

    fn compare(&self, verdict: &Verdict) -> Vec<Finding> {
        let (start, expect) = (Sources::start_of(self.source), &self.scenario.expect);
        let mut findings: Vec<Finding> = Vec::new();
        for violation in &verdict.violations {
            let place = Place { source: self.source, span: violation.span() };
            findings.push(Finding::error("T0401", place, violation.to_string()));
        }
        if expect.accomplished.is_none() && expect.ending.is_none() && verdict.ending != "accomplished" {
            let message = format!("the mission ended {}, and nothing says that it should", verdict.ending);
            let help = format!("expect it: `ending = \"{}\"` in [expect]", verdict.ending);
            findings.push(Finding::error("T0401", start, message).help(help));
        }
        for broken in &verdict.broken {
            let (time, what) = (broken.time, &broken.what);
            let message = format!("an invariant is broken at {time:.2} s: {what}");
            let mut finding = Finding::error("T0402", start, message);
            for layer in &self.troupe.content.mission.layers.safety {
                let declared = layer.model.invariants.iter().find(|i| i.name == what.invariant);
                if let Some(declared) = declared {
                    let place = Place { source: layer.source, span: declared.name_span };
                    finding = finding.related(place, "this is what must hold");
                }
            }
            let help =
                format!("`pelea run {} --scenario {} --speed max`", self.mission(), self.scenario.name);
            findings.push(finding.help(format!("the whole story: {help}")));
        }
        findings
    }
}
