//! Random tasks with plans, as text.
//!
//! All of them share one vocabulary, so that conditions and effects can be put together at random and mostly mean
//! something: types of which some overlap, objects of several types, predicates of up to two places, two derived ones
//! (one recursive, one that may deny the other), numeric fluents of which some have no value, and object fluents.
//! Invariant: nothing is quantified over `object`, so that objects of another type are irrelevant.

use crate::choices::Choices;
use crate::types::{self, BOTH, HIERARCHY, fits};
use std::fmt::Write;

/// A task and a plan, still in parts.
#[derive(Clone, Debug)]
pub struct Sample {
    pub derived: Vec<String>,
    pub actions: Vec<String>,
    pub objects: Vec<(String, &'static str)>,
    pub init: Vec<String>,
    pub goal: Vec<String>,
    pub constraints: Vec<String>,
    pub metric: String,
    pub plan: Vec<String>,
    /// More that the domain declares: a type, a predicate, a function that nothing else speaks of.
    pub strangers: bool,
}

/// A variable or object and its type.
pub type Named = (String, &'static str);

/// Which forms may be chosen.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Language {
    /// All that a plan without times knows.
    Sequential,
    /// What is read of the facts only.
    Facts,
    /// No derived predicates and object fluents; sums of numbers.
    Timed,
}

/// Forms over what is in scope.
pub struct Forms<'c, 'b> {
    pub choices: &'c mut Choices<'b>,
    pub language: Language,
    pub variables: usize,
}

impl Forms<'_, '_> {
    /// Something in scope of a type, if there is.
    fn term(&mut self, scope: &[Named], wanted: &str) -> Option<String> {
        let fitting: Vec<&Named> = scope.iter().filter(|named| fits(named, wanted)).collect();
        (!fitting.is_empty()).then(|| self.choices.of(&fitting).0.clone())
    }

    fn applied(&mut self, name: &str, types: &[&str], scope: &[Named]) -> Option<String> {
        let terms: Option<Vec<String>> = types.iter().map(|t| self.term(scope, t)).collect();
        Some(terms?.iter().fold(format!("({name}"), |text, term| format!("{text} {term}")) + ")")
    }

    /// An atom that actions may change.
    pub fn atom(&mut self, scope: &[Named]) -> String {
        let atom = match self.choices.below(7) {
            0 => None,
            1 | 2 => self.applied("p1", &["t0"], scope),
            3 => self.applied("p2", &["t0", "t0"], scope),
            4 => self.applied("p3", &["t1"], scope),
            5 => self.applied("p4", &["t3"], scope),
            _ => self.applied("p5", &[BOTH], scope),
        };
        atom.unwrap_or_else(|| "(p0)".to_owned())
    }

    fn fluent(&mut self, scope: &[Named]) -> String {
        let fluent = match self.choices.below(5) {
            0 | 1 => None,
            2 | 3 => self.applied("f1", &["t0"], scope),
            _ => self.applied("f2", &["t3"], scope),
        };
        fluent.unwrap_or_else(|| "(f0)".to_owned())
    }

    fn number(&mut self) -> &'static str {
        self.choices.of::<&str>(&["1", "2", "0.1", "0.5", "3", "-1"])
    }

    fn expression(&mut self, depth: usize, scope: &[Named]) -> String {
        match if depth == 0 { self.choices.below(2) } else { self.choices.below(5) } {
            0 => self.number().to_owned(),
            1 | 2 => self.fluent(scope),
            3 => {
                let operator = *self.choices.of(&["+", "-"]);
                let (a, b) = (self.expression(depth - 1, scope), self.expression(depth - 1, scope));
                format!("({operator} {a} {b})")
            }
            _ => {
                let operator = *self.choices.of(&["*", "/"]);
                let (a, b) = (self.expression(depth - 1, scope), self.number());
                format!("({operator} {a} {b})")
            }
        }
    }

    /// A new variable.
    fn variable(&mut self) -> Named {
        self.variables += 1;
        (format!("?v{}", self.variables), *self.choices.of(&["t0", "t1", "t3", BOTH, "t0", "t4"]))
    }

    pub fn comparison(&mut self, scope: &[Named]) -> String {
        let comparison = *self.choices.of(&["<", "<=", "=", ">=", ">"]);
        let (a, b) = (self.expression(1, scope), self.expression(1, scope));
        format!("({comparison} {a} {b})")
    }

    pub fn condition(&mut self, depth: usize, scope: &[Named]) -> String {
        let leaves = if self.language == Language::Facts { 2 } else { 5 };
        match if depth == 0 { self.choices.below(leaves) } else { self.choices.below(12) } {
            0 => self.atom(scope),
            1 | 5 => format!("(not {})", self.atom(scope)),
            2 if self.language != Language::Facts => self.comparison(scope),
            3 if self.language == Language::Sequential => {
                let derived = self.applied("d0", &["t0"], scope);
                let derived = derived.filter(|_| self.choices.below(3) > 0);
                derived.unwrap_or_else(|| "(d1)".to_owned())
            }
            4 if self.language == Language::Sequential => {
                let (form, [of, value]) = *self.choices.of(&[
                    ("(= A B)", ["t0", "t0"]),
                    ("(= (g A) B)", ["t0", "t0"]),
                    ("(= (k A) B)", ["t1", "t3"]),
                ]);
                match (self.term(scope, of), self.term(scope, value)) {
                    (Some(a), Some(b)) => form.replace('A', &a).replace('B', &b),
                    _ => self.atom(scope),
                }
            }
            2..=4 => self.atom(scope),
            6 | 7 => {
                let word = *self.choices.of(&["and", "or", "imply"]);
                let (a, b) = (self.condition(depth - 1, scope), self.condition(depth - 1, scope));
                format!("({word} {a} {b})")
            }
            8 => format!("(not {})", self.condition(depth - 1, scope)),
            9 | 10 => {
                let word = *self.choices.of(&["exists", "forall"]);
                let (name, of) = self.variable();
                let inner = [scope, &[(name.clone(), of)]].concat();
                format!("({word} ({name} - {of}) {})", self.condition(depth - 1, &inner))
            }
            _ => {
                let (a, b) = (self.condition(depth - 1, scope), self.condition(depth - 1, scope));
                format!("(and {a} {b})")
            }
        }
    }

    pub fn effect(&mut self, depth: usize, scope: &[Named]) -> String {
        match if depth == 0 { self.choices.below(4) } else { self.choices.below(8) } {
            0 | 4 => self.atom(scope),
            1 => format!("(not {})", self.atom(scope)),
            2 => {
                let word = *self.choices.of(&["increase", "decrease", "assign"]);
                let (fluent, value) = (self.fluent(scope), self.expression(1, scope));
                format!("({word} {fluent} {value})")
            }
            3 if self.language == Language::Sequential => {
                let (name, of, value) = *self.choices.of(&[("g", "t0", "t0"), ("k", "t1", "t3")]);
                match (self.term(scope, of), self.term(scope, value), self.choices.below(4)) {
                    (Some(a), Some(b), 0 | 1) => format!("(assign ({name} {a}) {b})"),
                    (Some(a), _, 2) => format!("(assign ({name} {a}) undefined)"),
                    _ => format!("(scale-up {} {})", self.fluent(scope), self.number()),
                }
            }
            3 => self.atom(scope),
            5 => {
                let guard = self.condition(1, scope);
                format!("(when {guard} {})", self.effect(depth - 1, scope))
            }
            6 => {
                let (name, of) = self.variable();
                let inner = [scope, &[(name.clone(), of)]].concat();
                format!("(forall ({name} - {of}) {})", self.effect(depth - 1, &inner))
            }
            _ => {
                let (a, b) = (self.effect(depth - 1, scope), self.effect(depth - 1, scope));
                format!("(and {a} {b})")
            }
        }
    }

    pub fn parameters(&mut self) -> Vec<Named> {
        (0..self.choices.below(3)).map(|_| self.variable()).collect()
    }
}

pub fn typed(names: &[Named]) -> String {
    names.iter().map(|(name, of)| format!("{name} - {of}")).collect::<Vec<_>>().join(" ")
}

/// Two to four objects, often one of two types.
pub fn objects(choices: &mut Choices<'_>) -> Vec<Named> {
    let count = 2 + choices.below(3);
    let mut of = || *choices.of(&[BOTH, "t1", "t0", BOTH, "t3", "t0", BOTH, "t4"]);
    (0..count).map(|n| (format!("o{n}"), of())).collect()
}

/// The values of fluents, some missing, and some atoms.
pub fn init(choices: &mut Choices<'_>, objects: &[Named], language: Language) -> Vec<String> {
    let mut init = vec![format!("(= (f0) {})", choices.below(4))];
    for named @ (object, _) in objects {
        if fits(named, "t3") && !choices.one_in(6) {
            init.push(format!("(= (f2 {object}) {})", choices.of(&["0", "1", "2"])));
        }
        if !choices.one_in(6) {
            init.push(format!("(= (f1 {object}) {})", choices.of(&["0", "1", "2.5", "0.3"])));
        }
        if language == Language::Sequential && choices.below(3) > 0 {
            init.push(format!("(= (g {object}) {})", choices.of(objects).0));
        }
        let values: Vec<&Named> = objects.iter().filter(|value| fits(value, "t3")).collect();
        if language == Language::Sequential && fits(named, "t1") && !values.is_empty() {
            init.push(format!("(= (k {object}) {})", choices.of(&values).0));
        }
    }
    let mut forms = Forms { choices, language, variables: 0 };
    for _ in 0..3 + objects.len() {
        let atom = forms.atom(objects);
        if !init.contains(&atom) {
            init.push(atom);
        }
    }
    init
}

impl Sample {
    /// Actions without times, and steps of any kind.
    pub fn sequential(bytes: &[u8]) -> Self {
        let choices = &mut Choices::new(bytes);
        let objects = objects(choices);
        let init = init(choices, &objects, Language::Sequential);
        let mut forms = Forms { choices, language: Language::Facts, variables: 0 };
        let over = [("?x".to_owned(), "t0")];
        let derived = vec![
            format!("(:derived (d0 ?x - t0) {})", forms.condition(1, &over)),
            "(:derived (d0 ?x - t0) (exists (?y - t0) (and (p2 ?x ?y) (d0 ?y))))".to_owned(),
            format!("(:derived (d1) (and (forall (?x - t1) (not (d0 ?x))) {}))", forms.condition(1, &[])),
        ];
        forms.language = Language::Sequential;
        let mut actions = Vec::new();
        let mut signatures = Vec::new();
        for index in 0..3 + forms.choices.below(3) {
            let parameters = forms.parameters();
            let precondition = forms.condition(2, &parameters);
            let soft = forms.condition(1, &parameters);
            let soft =
                if forms.choices.one_in(4) { format!("(preference w1 {soft})") } else { String::new() };
            let (one, other) = (forms.effect(2, &parameters), forms.effect(1, &parameters));
            actions.push(format!(
                "(:action a{index} :parameters ({}) :precondition (and {precondition} {soft}) :effect (and {one} {other}))",
                typed(&parameters)
            ));
            signatures.push(parameters);
        }
        let goal =
            vec![forms.condition(1, &objects), format!("(preference w0 {})", forms.condition(1, &objects))];
        let constraints = constraints(&mut forms, &objects, 2);
        let mut plan = Vec::new();
        for _ in 0..forms.choices.below(8) {
            let index = forms.choices.below(signatures.len());
            plan.extend(step(forms.choices, index, &signatures[index], &objects));
        }
        let metric =
            "(+ (f0) (* 3 (is-violated w0)) (* 7 (is-violated w1)) (* 11 (is-violated w2)))".to_owned();
        Self { derived, actions, objects, init, goal, constraints, metric, plan, strangers: false }
    }

    /// A task that has nothing but a goal: what the planner is asked.
    pub fn plannable(bytes: &[u8]) -> Self {
        let mut sample = Self::sequential(bytes);
        sample.goal.pop();
        for action in &mut sample.actions {
            *action = action.replace("(preference w1 ", "(and ");
        }
        Self { constraints: Vec::new(), metric: String::new(), plan: Vec::new(), ..sample }
    }

    pub fn domain(&self) -> String {
        let mut text = "(define (domain random) (:requirements :adl :derived-predicates :numeric-fluents :object-fluents \
                        :constraints :preferences :durative-actions :duration-inequalities :continuous-effects \
                        :timed-initial-literals :conditional-effects)\n"
            .to_owned();
        let (types, predicate, function) =
            if self.strangers { ("t2", "(p9 ?x - t2 ?y - t0)", "(f9 ?x - t2)") } else { ("", "", "") };
        writeln!(text, "(:types {HIERARCHY} t0 {types} - object)").unwrap();
        writeln!(text, "(:constants {})", types::constants(&self.objects)).unwrap();
        writeln!(
            text,
            "(:predicates (p0) (p1 ?x - t0) (p2 ?x ?y - t0) (p3 ?x - t1) (p4 ?x - t3) (p5 ?x - {BOTH}) (d0 ?x - t0) (d1) \
             {predicate})"
        )
        .unwrap();
        writeln!(text, "(:functions (f0) (f1 ?x - t0) (f2 ?x - t3) {function} - number (g ?x - t0) - t0 (k ?x - t1) - t3)")
            .unwrap();
        for part in self.derived.iter().chain(&self.actions) {
            writeln!(text, "{part}").unwrap();
        }
        text + ")"
    }

    pub fn problem(&self) -> String {
        let (mut constraints, mut metric) = (String::new(), String::new());
        if !self.metric.is_empty() {
            constraints = format!("(:constraints (and {}))", self.constraints.join("\n  "));
            metric = format!("(:metric minimize {})", self.metric);
        }
        format!(
            "(define (problem one) (:domain random)\n(:objects {})\n(:init {})\n(:goal (and {}))\n{constraints}\n{metric})",
            types::objects(&self.objects),
            self.init.join("\n  "),
            self.goal.join("\n  "),
        )
    }
}

impl Sample {
    /// Actions with times, timed changes, and steps at times that often meet.
    pub fn timed(bytes: &[u8]) -> Self {
        let choices = &mut Choices::new(bytes);
        let objects = objects(choices);
        let mut init = init(choices, &objects, Language::Timed);
        let mut forms = Forms { choices, language: Language::Timed, variables: 0 };
        for _ in 0..forms.choices.below(4) {
            let time = *forms.choices.of(&["0.5", "1", "1.5", "2", "3.5", "6"]);
            let change = match forms.choices.below(3) {
                0 => forms.atom(&objects),
                1 => format!("(not {})", forms.atom(&objects)),
                _ => format!("(= {} {})", forms.fluent(&objects), forms.number()),
            };
            init.push(format!("(at {time} {change})"));
        }
        let (mut actions, mut signatures) = (Vec::new(), Vec::new());
        for index in 0..2 + forms.choices.below(3) {
            let parameters = forms.parameters();
            let typed = typed(&parameters);
            let durative = index == 0 || forms.choices.below(3) > 0;
            actions.push(if durative {
                forms.durative(index, &parameters)
            } else {
                let (condition, effect) = (forms.condition(1, &parameters), forms.effect(1, &parameters));
                format!("(:action a{index} :parameters ({typed}) :precondition {condition} :effect {effect})")
            });
            signatures.push((parameters, durative));
        }
        let goal =
            vec![forms.condition(1, &objects), format!("(preference w0 {})", forms.condition(1, &objects))];
        forms.language = Language::Facts;
        let constraints = constraints(&mut forms, &objects, 2);
        let mut plan = Vec::new();
        for _ in 0..forms.choices.below(6) {
            let index = forms.choices.below(signatures.len());
            let (parameters, durative) = &signatures[index];
            let step = step(forms.choices, index, parameters, &objects);
            let start = *forms
                .choices
                .of(&["0.0", "0.5", "1.0", "1.5", "2.0", "3.0", "1.0005", "0.999", "4.0", "5.5"]);
            let duration = *forms.choices.of(&["1", "2", "0.5", "1.5", "2", "0.5", "3", "0"]);
            let duration = if *durative { format!(" [{duration}]") } else { String::new() };
            plan.extend(step.map(|step| format!("{start}: {step}{duration}")));
        }
        let metric =
            "(+ (f0) (* 3 (is-violated w0)) (* 7 (is-violated w1)) (* 11 (is-violated w2)))".to_owned();
        let derived = Vec::new();
        Self { derived, actions, objects, init, goal, constraints, metric, plan, strangers: false }
    }
}

impl Forms<'_, '_> {
    fn durative(&mut self, index: usize, parameters: &[Named]) -> String {
        let duration = match self.choices.below(8) {
            0..=5 => "(and (>= ?duration 0) (<= ?duration 2))".to_owned(),
            6 => format!("(= ?duration {})", self.expression(1, parameters)),
            _ => format!("(>= ?duration {})", self.expression(1, parameters)),
        };
        let (mut conditions, mut effects) = (String::new(), String::new());
        for _ in 0..1 + self.choices.below(2) {
            let when = *self.choices.of(&["over all", "at start", "at end"]);
            write!(conditions, " ({when} {})", self.condition(1, parameters)).unwrap();
        }
        if self.choices.one_in(3) {
            let when = *self.choices.of(&["over all", "at start", "at end"]);
            write!(conditions, " (preference w1 ({when} {}))", self.condition(1, parameters)).unwrap();
        }
        for _ in 0..1 + self.choices.below(3) {
            let when = *self.choices.of(&["at end", "at start"]);
            write!(effects, " ({when} {})", self.effect(1, parameters)).unwrap();
        }
        if self.choices.one_in(3) {
            let (guard, effect) = (self.condition(1, parameters), self.effect(0, parameters));
            write!(effects, " (when (at start {guard}) (at end {effect}))").unwrap();
        }
        if self.choices.below(2) == 1 {
            let word = *self.choices.of(&["increase", "decrease"]);
            write!(effects, " ({word} {} (* #t {}))", self.fluent(parameters), self.number()).unwrap();
        }
        format!(
            "(:durative-action a{index} :parameters ({}) :duration {duration} :condition (and {conditions}) \
             :effect (and {effects}))",
            typed(parameters)
        )
    }
}

/// A step with arguments of the right types, if there are any.
pub fn step(
    choices: &mut Choices<'_>,
    index: usize,
    parameters: &[Named],
    objects: &[Named],
) -> Option<String> {
    let mut step = format!("(a{index}");
    for (_, of) in parameters {
        let fitting: Vec<&Named> = objects.iter().filter(|object| fits(object, of)).collect();
        if fitting.is_empty() {
            return None;
        }
        write!(step, " {}", choices.of(&fitting).0).unwrap();
    }
    Some(step + ")")
}

/// Up to `most` constraints, the last one a preference.
pub fn constraints(forms: &mut Forms<'_, '_>, objects: &[Named], most: usize) -> Vec<String> {
    let mut constraints = Vec::new();
    for index in 0..forms.choices.below(most + 1) {
        let (a, b) = (forms.condition(1, objects), forms.condition(1, objects));
        let time = forms.choices.below(4);
        let constraint = match forms.choices.below(10) {
            0 => format!("(sometime {a})"),
            1 => format!("(always {a})"),
            2 => format!("(at-most-once {a})"),
            3 => format!("(sometime-after {a} {b})"),
            4 => format!("(sometime-before {a} {b})"),
            5 => format!("(at end {a})"),
            6 => format!("(within {time} {a})"),
            7 => format!("(always-within {time} {a} {b})"),
            8 => format!("(hold-during {time} {} {a})", time + 2),
            _ => format!("(hold-after {time} {a})"),
        };
        constraints.push(if index + 1 == most {
            format!("(preference w2 {constraint})")
        } else {
            constraint
        });
    }
    constraints
}
