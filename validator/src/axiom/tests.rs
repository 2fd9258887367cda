//! Random axioms and changes: the incremental update equals the definition.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use super::Strata;
use crate::number::Number;
use crate::prepare::initial_state;
use crate::reads::each_predicate;
use crate::scene::{Binding, Clock, Scene};
use crate::state::State;
use crate::universe::Universe;
use crate::value::Value;
use crate::work::Work;
use pddl::model::{Domain, GroundApplication, Idx, ObjectId, PredicateId, Problem};
use pddl::{Source, parse_domain, parse_problem};
use proptest::prelude::*;
use std::collections::BTreeSet;
use std::fmt::Write;

/// Base predicates, then derived ones: name and parameters. `?x` is a `t`, `?y` any object.
const BASE: [(&str, &[&str]); 4] = [("p", &["x"]), ("q", &["y"]), ("e", &["y", "z"]), ("on", &[])];
const DERIVED: [(&str, &[&str]); 5] =
    [("reach", &["y", "z"]), ("good", &["y"]), ("any", &[]), ("pair", &["y", "z"]), ("last", &["x"])];
const OBJECTS: [&str; 5] = ["a", "b", "c", "d", "g"];
/// The number of objects of type `t`.
const TYPED: u32 = 3;

#[derive(Clone, Debug)]
enum Formula {
    /// A predicate, and its arguments: variables in scope, or objects.
    Atom(usize, [usize; 2]),
    Same(usize, usize),
    More(usize),
    Not(Box<Formula>),
    And(Vec<Formula>),
    Or(Vec<Formula>),
    Imply(Box<Formula>, Box<Formula>),
    Exists(bool, Box<Formula>),
    Forall(bool, Box<Formula>),
}

fn formula() -> impl Strategy<Value = Formula> {
    let leaf = prop_oneof![
        12 => (0..BASE.len() + DERIVED.len(), [0_usize..9, 0_usize..9]).prop_map(|(p, t)| Formula::Atom(p, t)),
        2 => (0_usize..9, 0_usize..9).prop_map(|(a, b)| Formula::Same(a, b)),
        1 => (0_usize..9).prop_map(Formula::More),
    ];
    leaf.prop_recursive(3, 10, 3, |inner| {
        let boxed = || inner.clone().prop_map(Box::new);
        prop_oneof![
            3 => prop::collection::vec(inner.clone(), 0..3).prop_map(Formula::And),
            3 => prop::collection::vec(inner.clone(), 0..3).prop_map(Formula::Or),
            1 => boxed().prop_map(Formula::Not),
            1 => (boxed(), boxed()).prop_map(|(a, b)| Formula::Imply(a, b)),
            3 => (any::<bool>(), boxed()).prop_map(|(typed, f)| Formula::Exists(typed, f)),
            1 => (any::<bool>(), boxed()).prop_map(|(typed, f)| Formula::Forall(typed, f)),
        ]
    })
}

fn text(formula: &Formula, scope: &mut Vec<String>, out: &mut String) {
    let term = |which: usize, scope: &[String]| {
        let variables = scope.len();
        if which < 7 && variables > 0 {
            scope[which % variables].clone()
        } else {
            OBJECTS[which % 5].to_owned()
        }
    };
    let all = |word: &str, parts: &[&Formula], scope: &mut Vec<String>, out: &mut String| {
        write!(out, "({word}").unwrap();
        for part in parts {
            out.push(' ');
            text(part, scope, out);
        }
        out.push(')');
    };
    match formula {
        Formula::Atom(predicate, terms) => {
            let (name, parameters) = BASE.iter().chain(&DERIVED).nth(*predicate).unwrap();
            write!(out, "({name}").unwrap();
            for (&which, &kind) in terms.iter().zip(*parameters) {
                // A term that may not be a `t` is replaced by an object of type `t`.
                let term = term(which, scope);
                let term =
                    if kind == "x" && !term.starts_with("?x") { OBJECTS[which % 3].to_owned() } else { term };
                write!(out, " {term}").unwrap();
            }
            out.push(')');
        }
        Formula::Same(a, b) => write!(out, "(= {} {})", term(*a, scope), term(*b, scope)).unwrap(),
        Formula::More(a) => write!(out, "(> (f {}) 1)", term(*a, scope)).unwrap(),
        Formula::Not(part) => all("not", &[part], scope, out),
        Formula::And(parts) => all("and", &parts.iter().collect::<Vec<_>>(), scope, out),
        Formula::Or(parts) => all("or", &parts.iter().collect::<Vec<_>>(), scope, out),
        Formula::Imply(a, b) => all("imply", &[a, b], scope, out),
        Formula::Exists(typed, part) | Formula::Forall(typed, part) => {
            let word = if matches!(formula, Formula::Exists(..)) { "exists" } else { "forall" };
            let kind = if *typed { ("x", "t") } else { ("y", "object") };
            let variable = format!("?{}{}", kind.0, scope.len());
            write!(out, "({word} ({variable} - {}) ", kind.1).unwrap();
            scope.push(variable);
            text(part, scope, out);
            scope.pop();
            out.push(')');
        }
    }
}

fn task(axioms: &[(usize, Formula)]) -> Option<(Domain, Problem)> {
    let declared = |parameters: &[&str]| {
        let each = |p: &&str| format!(" ?{p} - {}", if *p == "x" { "t" } else { "object" });
        parameters.iter().map(each).collect::<String>()
    };
    let mut domain = "(define (domain d) (:requirements :adl :derived-predicates :numeric-fluents) (:types t)
        (:constants a b c - t d g - object) (:functions (f ?y - object)) (:predicates"
        .to_owned();
    for (name, parameters) in BASE.iter().chain(&DERIVED) {
        write!(domain, " ({name}{})", declared(parameters)).unwrap();
    }
    domain.push(')');
    for (head, body) in axioms {
        let (name, parameters) = DERIVED[*head];
        write!(domain, " (:derived ({name}{}) ", declared(parameters)).unwrap();
        let mut scope = parameters.iter().map(|p| format!("?{p}")).collect();
        text(body, &mut scope, &mut domain);
        domain.push(')');
    }
    domain.push(')');
    let domain = parse_domain(&Source::new("domain", domain), &[]);
    let domain = domain.model.unwrap_or_else(|| panic!("{:?}", domain.diagnostics));
    let problem = "(define (problem p) (:domain d) (:init (e a b) (e b c) (p a)) (:goal (and)))";
    let problem = parse_problem(&Source::new("problem", problem), &domain).model?;
    Some((domain, problem))
}

/// The tuples of a derived predicate that hold.
fn extension(state: &State, predicate: PredicateId) -> BTreeSet<Vec<ObjectId>> {
    state.derived[predicate].holding().map(<[ObjectId]>::to_vec).collect()
}

/// Evaluates every axiom for every tuple of objects until nothing is new, from the lowest component
/// up.
fn by_definition(
    strata: &Strata,
    domain: &Domain,
    universe: &Universe,
    state: &State,
    initial: &State,
) -> State {
    let mut result = state.clone();
    result.derived = initial.derived.clone();
    for component in &strata.components {
        loop {
            let mut grown = false;
            for axiom in domain.axioms.iter().filter(|axiom| component.own().contains(&axiom.predicate)) {
                let parameters: Vec<_> = axiom.variables.parameter_ids().collect();
                let mut tuples: Vec<Vec<ObjectId>> = vec![Vec::new()];
                for &parameter in &parameters {
                    let objects = universe.extent(&axiom.variables[parameter].types).objects();
                    let longer = |tuple: &Vec<ObjectId>, &object| [tuple.as_slice(), &[object]].concat();
                    tuples = tuples.iter().flat_map(|t| objects.iter().map(move |o| longer(t, o))).collect();
                }
                for tuple in tuples {
                    let variables = &axiom.variables;
                    let scene = Scene { universe, state: &result, variables, clock: Clock::steps(0) };
                    if scene.holds(&axiom.body, &mut Binding::new(variables, &tuple)) {
                        grown |= result.derived[axiom.predicate].add(&tuple, 0);
                    }
                }
            }
            if !grown {
                break;
            }
        }
    }
    result
}

#[derive(Clone, Debug)]
enum Change {
    Fact(usize, [u32; 2], bool),
    Fluent(u32, Option<i64>),
    /// Query a derived predicate.
    Ask(usize),
}

fn change() -> impl Strategy<Value = Change> {
    prop_oneof![
        6 => (0..BASE.len(), [0_u32..5, 0_u32..5], any::<bool>()).prop_map(|(p, a, add)| Change::Fact(p, a, add)),
        1 => (0_u32..5, prop::option::of(0_i64..3)).prop_map(|(o, v)| Change::Fluent(o, v)),
        4 => (0..DERIVED.len()).prop_map(Change::Ask),
    ]
}

/// Transitive closure in its usual form, so that every run has long proofs.
fn paths() -> (usize, Formula) {
    let reach = BASE.len();
    let step = Formula::Atom(2, [0, 1]);
    // The third variable in scope is the quantified one.
    let further = Formula::And(vec![Formula::Atom(2, [0, 2]), Formula::Atom(reach, [2, 1])]);
    (0, Formula::Or(vec![step, Formula::Exists(false, Box::new(further))]))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn what_is_kept_up_to_date_is_what_follows(
        axioms in prop::collection::vec((0..DERIVED.len(), formula()), 1..7),
        with_paths in any::<bool>(),
        changes in prop::collection::vec(change(), 1..30),
    ) {
        let mut axioms = axioms;
        if with_paths {
            axioms.push(paths());
        }
        let (domain, problem) = task(&axioms).unwrap();
        let Ok(strata) = Strata::new(&domain) else { return Ok(()) };
        let universe = Universe::new(&domain, &problem);
        let mut initial = initial_state(&domain, &problem);
        initial.work = Work::for_steps(0);
        let mut state = initial.clone();
        for (now, change) in (1..).zip(changes) {
            match change {
                Change::Fact(which, arguments, add) => {
                    let (name, parameters) = BASE[which];
                    let predicate = domain.predicate(name).unwrap();
                    let fits = |(&kind, object): (&&str, u32)| ObjectId(if kind == "x" { object % TYPED } else { object });
                    let arguments: Vec<_> = parameters.iter().zip(arguments).map(fits).collect();
                    let relation = &mut state.facts[predicate];
                    let _changed = if add { relation.add(&arguments, now) } else { relation.delete(&arguments, now) };
                }
                Change::Fluent(object, value) => {
                    let function = domain.function("f").unwrap();
                    let application = GroundApplication { function, arguments: vec![ObjectId(object)] };
                    state.set_fluent(application, value.map(|v| Value::Number(Number::integer(v))));
                }
                Change::Ask(which) => {
                    let predicate = domain.predicate(DERIVED[which].0).unwrap();
                    let needs = super::Needs(strata.below[predicate].clone());
                    strata.derive_needed(&needs, &domain, &universe, &mut state, now);
                    let expected = by_definition(&strata, &domain, &universe, &state, &initial);
                    prop_assert_eq!(extension(&state, predicate), extension(&expected, predicate));
                }
            }
        }
        strata.derive(&domain, &universe, &mut state, u32::MAX);
        let expected = by_definition(&strata, &domain, &universe, &state, &initial);
        for (predicate, _) in domain.predicates.enumerate().filter(|&(p, _)| strata.derives(p)) {
            prop_assert_eq!(extension(&state, predicate), extension(&expected, predicate), "{}", predicate.index());
            let relation = &state.derived[predicate];
            let listed: BTreeSet<_> = relation.live().iter().map(|&slot| relation.tuple(slot).to_vec()).collect();
            prop_assert_eq!(listed, extension(&state, predicate));
        }
    }
}

#[test]
fn the_generator_reaches_recursion_and_refusals() {
    let (domain, _) = task(&[paths()]).unwrap();
    let strata = Strata::new(&domain).unwrap();
    let reach = domain.predicate("reach").unwrap();
    assert!(strata.derives(reach));
    let mut own = false;
    each_predicate(&domain.axioms[0].body, true, &mut |predicate, _| own |= predicate == reach);
    assert!(own);
    let circle = Formula::Not(Box::new(Formula::Atom(BASE.len() + 2, [0, 0])));
    let (domain, _) = task(&[(2, circle)]).unwrap();
    assert!(Strata::new(&domain).is_err());
}
