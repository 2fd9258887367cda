//! The invariants of every run, checked on its records.

use crate::scenario::MadeUp;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// The utterances that may be spoken to a person who is not in view, or who asks for help.
const SUMMONS: [&str; 3] = ["sit-down", "stay-calm", "help-is-coming"];

/// The horizon of a simulated run.
const LONGEST: f64 = 14_401.0;
const MOST_RECORDS: usize = 6_000;

/// The graph as the records report it, and the findings.
#[derive(Default)]
struct Run {
    tokens: BTreeSet<String>,
    label: String,
    /// The utterance that is being spoken.
    speaking: Option<String>,
    chosen: BTreeMap<String, String>,
    delivered: Option<Value>,
    /// The person asked for help and has not been attended to.
    unheard: bool,
    /// The room reports that the microphone works.
    microphone: bool,
    /// The times of answers that were given and are not recorded yet.
    given: Vec<f64>,
    broken: Vec<String>,
}

/// The invariants that do not hold.
pub(crate) fn broken(records: &[Value], made_up: &MadeUp) -> Vec<String> {
    let mut run = Run { microphone: true, ..Run::default() };
    for record in records {
        match record["source"].as_str() {
            Some("graph") => run.graph(record, made_up),
            Some("room") => run.room(record),
            Some("pelea") => run.pelea(record),
            _ => {}
        }
    }
    run.end(records, made_up);
    run.broken
}

fn strings(value: &Value) -> impl Iterator<Item = &str> {
    value.as_array().unwrap().iter().map(|v| v.as_str().unwrap())
}

impl Run {
    fn finding(&mut self, record: &Value, what: &str) {
        self.broken.push(format!("{:.3} s: {what}", record["time"].as_f64().unwrap()));
    }

    fn holds(&self, token: &str) -> bool {
        self.tokens.contains(token)
    }

    fn graph(&mut self, record: &Value, made_up: &MadeUp) {
        let began = strings(&record["now"]).any(|t| t == "robot is speaking");
        for token in strings(&record["no_longer"]) {
            self.tokens.remove(token);
        }
        let time = record["time"].as_f64().unwrap();
        if let Some(given) = self.given.iter().find(|&&given| given < time) {
            let lost = format!("what was answered at {given:.3} s is not recorded");
            self.given.clear();
            self.finding(record, &lost);
        }
        for token in strings(&record["now"]) {
            self.tokens.insert(token.to_owned());
            if let Some((_, utterance)) =
                token.split_once(" label of ").and_then(|(_, t)| t.split_once(" is "))
            {
                self.label = utterance.to_owned();
            }
            if let Some((option, item)) = token.split_once(" was chosen in ")
                && let Some(before) = self.chosen.insert(item.to_owned(), option.to_owned())
            {
                self.finding(record, &format!("{item} was answered with {option} after {before}"));
            }
            if token.contains(" was chosen in ") && self.given.pop().is_none() {
                self.finding(record, &format!("no answer in the room explains {token}"));
            }
            // A silence may be that of an empty chair, so the tracker is tested after it.
            let unfounded = token.ends_with(" is doubted") && token != "tracker is doubted";
            if made_up.sound && (unfounded || token.ends_with(" is broken")) {
                self.finding(record, &format!("{token}, and no device failed"));
            }
            if token.starts_with("clinician is called for ") || token.starts_with("clinician attended ") {
                self.unheard = false;
            }
            if token == "person asks help" {
                self.unheard = !self.tokens.iter().any(|t| t.starts_with("clinician is called for "));
            }
        }
        self.speaking = match (self.holds("robot is speaking"), began) {
            (false, _) => None,
            (true, true) => Some(self.label.clone()),
            (true, false) => self.speaking.take(),
        };
        if let Some(utterance) = self.speaking.clone().filter(|u| !SUMMONS.contains(&u.as_str())) {
            for (token, wanted) in
                [("person is with robot", true), ("barthel is paused", false), ("barthel is aborted", false)]
            {
                if self.holds(token) != wanted {
                    let not = if wanted { "not: " } else { "" };
                    self.finding(record, &format!("`{utterance}` is being said, and {not}{token}"));
                }
            }
        }
    }

    fn room(&mut self, record: &Value) {
        match record["event"].as_str().unwrap() {
            "robot_says" if self.speaking.is_none() => {
                self.finding(record, "the robot says what the graph knows nothing of");
            }
            "person_says" if self.microphone && record["words"] != "the blue one" => self.given(record),
            "person_touches" => self.given(record),
            "report_delivered" => self.delivered = Some(record["report"].clone()),
            "device_fails" | "device_lies" if record["device"] == "speech_in" => self.microphone = false,
            "device_recovers" if record["device"] == "speech_in" => self.microphone = true,
            _ => {}
        }
    }

    /// An answer: recorded in the same instant, unless a reflex ended the question in it.
    fn given(&mut self, record: &Value) {
        self.given.push(record["time"].as_f64().unwrap());
    }

    fn pelea(&mut self, record: &Value) {
        if record["event"] == "refused" {
            self.finding(record, &format!("the graph refused PELEA: {}", record["why"]));
        }
    }

    fn end(&mut self, records: &[Value], made_up: &MadeUp) {
        let Some(result) = records.last().filter(|r| r["source"] == "result") else {
            return self.broken.push("the last record is no result".to_owned());
        };
        if result["time"].as_f64().unwrap() > LONGEST {
            self.finding(result, "far too long");
        }
        if records.len() > MOST_RECORDS {
            self.finding(result, &format!("{} records", records.len()));
        }
        for item in strings(&result["asked_again"]) {
            self.finding(result, &format!("{item} was asked again"));
        }
        for violation in strings(&result["violations"]) {
            self.finding(result, violation);
        }
        let reported: BTreeMap<_, _> = result["report"]["items"]
            .as_array()
            .unwrap()
            .iter()
            .filter(|item| item["status"] == "answered")
            .map(|i| (i["item"].as_str().unwrap().to_owned(), i["option"].as_str().unwrap().to_owned()))
            .collect();
        if reported != self.chosen {
            self.finding(result, &format!("chosen {:?}, reported {reported:?}", self.chosen));
        }
        self.delivery(result);
        let accomplished = result["ending"] == "accomplished";
        if accomplished && self.holds("person asks help") {
            self.finding(result, "accomplished, and the person still asks for help");
        }
        if self.unheard {
            self.finding(result, "help was asked for, and the clinician was not called");
        }
        if !accomplished {
            if !records.iter().any(|r| r["event"] == "fell_back") {
                self.finding(result, "not accomplished, and nothing else was tried");
            }
            if made_up.comes && result["ending"] != "with_human" {
                self.finding(result, &format!("{}: {}", result["ending"], result["why"]));
            }
        }
        let silent =
            result["report"]["items"].as_array().unwrap().iter().any(|i| i["status"] == "unanswered");
        if made_up.willing && made_up.sound && silent {
            self.finding(result, "an item is unanswered although the person always answers");
        }
        for token in ["robot is speaking", "robot is showing", "person waiting answer", "person can answer"] {
            if accomplished && self.holds(token) {
                self.finding(result, &format!("left behind: {token}"));
            }
        }
    }

    fn delivery(&mut self, result: &Value) {
        match &self.delivered {
            None => self.finding(result, "no report was delivered"),
            Some(delivered) if delivered["items"] != result["report"]["items"] => {
                self.finding(result, "the report that was delivered is not the last word");
            }
            Some(_) => {}
        }
    }
}
