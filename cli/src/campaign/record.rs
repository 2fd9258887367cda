//! What a campaign keeps of its runs, in memory and in its results file.
//!
//! A line of a story ("step 7/34: …") occurs in thousands of runs, so a story is a list of times and numbers of lines.

use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};

/// How a run ended. Whatever has another name is a bug of ours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Outcome {
    /// The mission reached its goal.
    Accomplished,
    /// It did not, and a clinician has attended to the person.
    WithHuman,
    /// It did not, and a clinician is being called.
    StillCalling,
    /// The longest time of a run is over, and it goes on.
    StillGoing,
    /// It ended in none of these ways.
    GivenUp,
    /// A panic that nothing has caught.
    Panicked,
}

impl Outcome {
    /// Every outcome, from the best on.
    pub(super) const ALL: [Self; 6] = [
        Self::Accomplished,
        Self::WithHuman,
        Self::StillCalling,
        Self::StillGoing,
        Self::GivenUp,
        Self::Panicked,
    ];

    /// Its name for people.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Accomplished => "accomplished",
            Self::WithHuman => "with a human",
            Self::StillCalling => "still calling",
            Self::StillGoing => "still going",
            Self::GivenUp => "given up",
            Self::Panicked => "panicked",
        }
    }

    /// Whether a run may end like this.
    pub(super) fn is_accounted_for(self) -> bool {
        matches!(self, Self::Accomplished | Self::WithHuman | Self::StillCalling)
    }
}

/// A run of a campaign: which disruption, when, and from which seed.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub(super) struct Key {
    /// The disruption, by its file's name.
    pub(super) disruption: String,
    /// The instant at which it happens, by its place among the campaign's.
    pub(super) instant: usize,
    /// The seed of both runs.
    pub(super) seed: u64,
}

impl Key {
    /// What chooses a token for the run, if the disruption leaves it open.
    pub(super) fn draw(&self) -> u64 {
        (self.seed << 32) | u64::try_from(self.instant).unwrap_or_default()
    }
}

/// The number of a line of a story.
pub(super) type LineId = u32;

/// What became of a run.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Run {
    /// Which run.
    #[serde(flatten)]
    pub(super) key: Key,
    /// The token that the run has drawn, if the disruption leaves it open.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) token: Option<String>,
    /// How it ended.
    pub(super) outcome: Outcome,
    /// How long it lasted, in simulated seconds.
    pub(super) seconds: f64,
    /// How often a plan was made again.
    pub(super) replans: u32,
    /// The invariants that it broke.
    pub(super) broken: Vec<Breakage>,
    /// What happened from the disruption on: seconds, and the number of a line.
    pub(super) story: Vec<(f64, LineId)>,
}

impl Run {
    /// Whether it ended in a way that is accounted for, with every invariant.
    pub(super) fn is_good(&self) -> bool {
        self.outcome.is_accounted_for() && self.broken.is_empty()
    }
}

/// An invariant that a run broke.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub(super) struct Breakage {
    /// Its name.
    pub(super) invariant: String,
    /// What it says, who it was broken for, and the version.
    pub(super) text: String,
    /// What broke it.
    #[serde(skip)]
    pub(super) by: By,
}

/// What broke an invariant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum By {
    /// The commit that made a version.
    Version(u64),
    /// The end of the run.
    End,
    /// Time; or it is not known any more.
    #[default]
    Time,
}

/// The lines of all stories, each once.
#[derive(Default)]
pub(super) struct Lines(Mutex<Numbered>);

#[derive(Default)]
struct Numbered {
    ids: HashMap<String, LineId>,
    texts: Vec<String>,
}

impl Lines {
    /// The lines of an earlier campaign, in their order.
    pub(super) fn of(texts: Vec<String>) -> Self {
        let id = |at: usize| LineId::try_from(at).unwrap_or(LineId::MAX);
        let ids = texts.iter().enumerate().map(|(at, text)| (text.clone(), id(at))).collect();
        Self(Mutex::new(Numbered { ids, texts }))
    }

    /// The number of a line.
    pub(super) fn number(&self, text: &str) -> LineId {
        let mut lines = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(&id) = lines.ids.get(text) {
            return id;
        }
        let id = LineId::try_from(lines.texts.len()).unwrap_or(LineId::MAX);
        lines.ids.insert(text.to_owned(), id);
        lines.texts.push(text.to_owned());
        id
    }

    /// The lines from a number on.
    pub(super) fn since(&self, first: usize) -> Vec<String> {
        let lines = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        lines.texts.get(first..).unwrap_or_default().to_vec()
    }
}
