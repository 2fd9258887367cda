//! `mission.toml`: the texts of a mission, and the tokens that Rust code needs to know.
//!
//! No mission appears in Rust source. The manifest therefore names what the report counts, what is said, and what happens
//! without a plan, as tokens of the graph and tasks of the methods.

use std::time::Duration;

use pddl::Span;
use pddl::model::Name;

use crate::files::join;
use crate::goal_entry::{self, GoalEntry};
use diagnostics::toml::{Reader, Table, Text};

/// A name that the manifest mentions, with its place.
#[derive(Clone, Debug)]
pub struct Mention {
    /// The name.
    pub name: Name,
    /// Its place in `mission.toml`.
    pub span: Span,
}

/// The files of a mission, as paths for [`crate::Files`].
#[derive(Clone, Debug)]
pub(crate) struct Paths {
    /// The robot's vocabulary.
    pub(crate) vocabulary: String,
    /// The world before a person is seen.
    pub(crate) world: String,
    /// The folder of the agents' rules.
    pub(crate) agents: String,
    /// The test as nodes and edges.
    pub(crate) graph: String,
    /// The planning domain.
    pub(crate) domain: String,
    /// The planning problem.
    pub(crate) problem: String,
    /// LowToHigh.
    pub(crate) perception: String,
    /// HighToLow.
    pub(crate) methods: String,
    /// The folder of the languages.
    pub(crate) content: String,
    /// The folder of the scenarios.
    pub(crate) scenarios: String,
    /// The robot's library of disruptions; it need not exist.
    pub(crate) robot_disruptions: String,
    /// The mission's own; it need not exist.
    pub(crate) disruptions: String,
    /// What all tests with the robot must satisfy; it need not exist.
    pub(crate) robot_safety: String,
    /// What this test must satisfy; it need not exist.
    pub(crate) safety: String,
}

/// The limits of planning and of retries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// States that one replan may expand.
    pub replan_expansions: u32,
    /// How often one action may fail without progress before its failure is escalated.
    pub attempts: u32,
}

/// What happens when a mission does not get on, and while it waits for a decision. What is `None` is for the executive
/// to choose.
#[derive(Clone, Debug, Default)]
pub struct Patience {
    /// Plans that may replace a plan without progress.
    pub replans: Option<u32>,
    /// Starts of one step without progress.
    pub restarts: Option<u32>,
    /// Requests in a row whose answers the world had overtaken.
    pub asks: Option<u32>,
    /// How long a decision may take before the fallback starts.
    pub deciding: Option<Duration>,
    /// How long a decision takes before the task `meanwhile` starts.
    pub meanwhile_after: Option<Duration>,
}

/// The tokens that make the report.
#[derive(Clone, Debug)]
pub struct ReportTokens {
    /// The node of the report, for its delivery.
    pub document: Mention,
    /// The type of the items.
    pub items: Mention,
    /// Label from an item to an option that it offers.
    pub offers: Mention,
    /// Label from the chosen option to its item.
    pub answer: Mention,
    /// Label from an unanswered question to its item.
    pub unanswered: Mention,
    /// Label from a question that a sensor noticed to its item; without it every question counts as perceived.
    pub sensed: Option<Mention>,
    /// Attribute of the pair (item, option): the score of the option.
    pub score: Mention,
    /// Further labels whose tokens must outlive the process: calls and deliveries.
    pub lasting: Vec<Mention>,
}

impl ReportTokens {
    /// Every label whose tokens must outlive the process: what the report is made of, and what the mission adds.
    pub fn lasting(&self) -> impl Iterator<Item = &Mention> {
        [&self.answer, &self.unanswered].into_iter().chain(&self.sensed).chain(&self.lasting)
    }
}

/// The types that have words in every language.
#[derive(Clone, Debug)]
pub(crate) struct WordTypes {
    /// Utterances, which are said or shown.
    pub(crate) utterances: Mention,
    /// Parts of a test, in which utterances are said or shown.
    pub(crate) parts: Mention,
    /// A person's requests, possible at any moment.
    pub(crate) requests: Mention,
}

/// A task with its arguments: `fall-back` or `(fall-back person)`.
#[derive(Clone, Debug)]
pub(crate) struct TaskText {
    pub(crate) task: Mention,
    /// Its arguments, if the manifest gives them.
    pub(crate) arguments: Vec<Mention>,
}

/// `mission.toml`, its names not yet resolved.
#[derive(Clone, Debug)]
pub struct Manifest {
    /// Short name.
    pub name: String,
    /// Name for people.
    pub title: String,
    /// Tag of the default language.
    pub language: String,
    /// The place of that tag.
    pub(crate) language_span: Span,
    /// The place of the robot's folder.
    pub(crate) robot_span: Span,
    /// The task to execute without a plan.
    pub(crate) fallback: TaskText,
    /// The task to execute without progress, if it is another.
    pub(crate) escalation: Option<TaskText>,
    /// The task to execute while a decision takes its time.
    pub(crate) meanwhile: Option<TaskText>,
    /// The files.
    pub(crate) paths: Paths,
    /// The place of `invariants = "none"`, if the mission is to run without invariants.
    pub(crate) no_invariants: Option<Span>,
    /// The goals; without any, the problem's goal is the only one.
    pub(crate) goals: Vec<GoalEntry>,
    /// The limits of planning and of retries.
    pub budget: Budget,
    /// The limits of progress and of decisions.
    pub patience: Patience,
    /// The tokens of the report.
    pub report: ReportTokens,
    /// The types of the words.
    pub(crate) words: WordTypes,
}

const DEFAULT_BUDGET: Budget = Budget { replan_expansions: 20_000, attempts: 3 };

/// Reads the manifest in `folder`; `None` if a key without a default is missing.
pub(crate) fn read(reader: &mut Reader<'_>, mut root: Table<'_>, folder: &str) -> Option<Manifest> {
    let name = root.required_text(reader, "name");
    let title = root.text(reader, "title");
    let robot = root.required_text(reader, "robot");
    let language = root.required_text(reader, "language");
    let fallback = root.required_text(reader, "fallback");
    let meanwhile = root.text(reader, "meanwhile");
    let no_invariants = no_invariants(reader, &mut root);
    let goals = goal_entry::entries(reader, &mut root);
    let mut patience = Patience::default();
    let budget = budget(reader, &mut root, &mut patience);
    let escalation = progress(reader, &mut root, &mut patience);
    root.require(reader, "report");
    let report = root.table(reader, "report").and_then(|t| report(reader, t));
    let words = words(reader, &mut root);
    let robot_folder = robot.as_ref().map_or_else(String::new, |r| join(folder, &r.value));
    let paths = paths(reader, &mut root, folder, &robot_folder);
    root.finish(reader);

    let (name, robot, language, fallback) = (name?, robot?, language?, fallback?);
    let fallback = task_text(reader, "fallback", &fallback)?;
    let escalation = escalation.and_then(|text| task_text(reader, "escalation", &text));
    let meanwhile = meanwhile.and_then(|text| task_text(reader, "meanwhile", &text));
    Some(Manifest {
        title: title.map_or_else(|| name.value.clone(), |t| t.value),
        name: name.value,
        language: language.value,
        language_span: language.span,
        robot_span: robot.span,
        fallback,
        escalation,
        meanwhile,
        paths,
        no_invariants,
        goals,
        budget,
        patience,
        report: report?,
        words,
    })
}

/// `invariants = "none"`, the only value: the invariants themselves are PDDL.
fn no_invariants(reader: &mut Reader<'_>, root: &mut Table<'_>) -> Option<Span> {
    let text = root.text(reader, "invariants")?;
    if text.value != "none" {
        let message = "`invariants` is \"none\" or left out; what must hold stands in `safety.pddl`";
        reader.error("E0705", text.span, message);
    }
    Some(text.span)
}

fn task_text(reader: &mut Reader<'_>, key: &str, text: &Text) -> Option<TaskText> {
    let mut mentions = symbols(text);
    if mentions.is_empty() {
        reader.error("E0705", text.span, format!("`{key}` should name a task, as in \"(fall-back person)\""));
        return None;
    }
    let arguments = mentions.split_off(1);
    Some(TaskText { task: mentions.remove(0), arguments })
}

/// `[progress]`: its bounds, and the task when one is reached.
fn progress(reader: &mut Reader<'_>, root: &mut Table<'_>, patience: &mut Patience) -> Option<Text> {
    let mut table = root.table(reader, "progress")?;
    patience.replans = table.count(reader, "replans", 1).map(|(n, _)| n);
    patience.restarts = table.count(reader, "restarts", 1).map(|(n, _)| n);
    patience.asks = table.count(reader, "asks", 1).map(|(n, _)| n);
    let escalation = table.text(reader, "escalation");
    table.finish(reader);
    escalation
}

fn budget(reader: &mut Reader<'_>, root: &mut Table<'_>, patience: &mut Patience) -> Budget {
    let Some(mut table) = root.table(reader, "budget") else { return DEFAULT_BUDGET };
    let expansions = table.count(reader, "replan-expansions", 1).map(|(n, _)| n);
    let attempts = table.count(reader, "attempts", 1).map(|(n, _)| n);
    patience.deciding = table.seconds(reader, "deciding");
    patience.meanwhile_after = table.seconds(reader, "meanwhile-after");
    table.finish(reader);
    Budget {
        replan_expansions: expansions.unwrap_or(DEFAULT_BUDGET.replan_expansions),
        attempts: attempts.unwrap_or(DEFAULT_BUDGET.attempts),
    }
}

fn report(reader: &mut Reader<'_>, mut table: Table<'_>) -> Option<ReportTokens> {
    let document = required_mention(reader, &mut table, "document");
    let items = required_mention(reader, &mut table, "items");
    let offers = required_mention(reader, &mut table, "offers");
    let answer = required_mention(reader, &mut table, "answer");
    let unanswered = required_mention(reader, &mut table, "unanswered");
    let sensed = table.text(reader, "sensed").map(|text| mention(&text));
    let score = required_mention(reader, &mut table, "score");
    let lasting = table.texts(reader, "lasting").unwrap_or_default().iter().map(mention).collect();
    table.finish(reader);
    Some(ReportTokens {
        document: document?,
        items: items?,
        offers: offers?,
        answer: answer?,
        unanswered: unanswered?,
        sensed,
        score: score?,
        lasting,
    })
}

fn words(reader: &mut Reader<'_>, root: &mut Table<'_>) -> WordTypes {
    let at = root.span;
    let mut table = root.table(reader, "words");
    let mut of = |key: &str, default: &str| {
        let text = table.as_mut().and_then(|t| t.text(reader, key));
        text.map_or_else(|| Mention { name: Name::new(default), span: at }, |t| mention(&t))
    };
    let types = WordTypes {
        utterances: of("utterances", "utterance"),
        parts: of("parts", "part"),
        requests: of("requests", "request"),
    };
    if let Some(table) = table {
        table.finish(reader);
    }
    types
}

fn paths(reader: &mut Reader<'_>, root: &mut Table<'_>, folder: &str, robot: &str) -> Paths {
    let mut table = root.table(reader, "files");
    let mut of = |key: &str, base: &str, default: &str| {
        let text = table.as_mut().and_then(|t| t.text(reader, key));
        text.map_or_else(|| join(base, default), |t| join(folder, &t.value))
    };
    let paths = Paths {
        vocabulary: of("vocabulary", robot, "vocabulary.pddl"),
        world: of("world", robot, "world.pddl"),
        agents: of("agents", robot, "agents"),
        graph: of("graph", folder, "graph.pddl"),
        domain: of("domain", folder, "domain.pddl"),
        problem: of("problem", folder, "problem.pddl"),
        perception: of("perception", folder, "perception.pddl"),
        methods: of("methods", folder, "methods.hddl"),
        content: of("content", folder, "content"),
        scenarios: of("scenarios", folder, "scenarios"),
        robot_disruptions: of("robot-disruptions", robot, "disruptions"),
        disruptions: of("disruptions", folder, "disruptions"),
        robot_safety: of("robot-safety", robot, "safety.pddl"),
        safety: of("safety", folder, "safety.pddl"),
    };
    if let Some(table) = table {
        table.finish(reader);
    }
    paths
}

fn required_mention(reader: &mut Reader<'_>, table: &mut Table<'_>, key: &str) -> Option<Mention> {
    table.required_text(reader, key).map(|t| mention(&t))
}

fn mention(text: &Text) -> Mention {
    Mention { name: Name::new(&text.value), span: text.span }
}

/// The symbols of a ground term `(name argument …)`, parentheses optional, each with its place.
pub(crate) fn symbols(text: &Text) -> Vec<Mention> {
    let mut mentions = Vec::new();
    let mut start = None;
    for (i, c) in text.value.char_indices().chain(std::iter::once((text.value.len(), ' '))) {
        let inside = !c.is_whitespace() && c != '(' && c != ')';
        match (inside, start) {
            (true, None) => start = Some(i),
            (false, Some(from)) => {
                let at = |i: usize| u32::try_from(i).unwrap_or(u32::MAX);
                let span = text.within(Span::new(at(from), at(i)));
                mentions.push(Mention { name: Name::new(&text.value[from..i]), span });
                start = None;
            }
            _ => {}
        }
    }
    mentions
}
