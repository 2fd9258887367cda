//! The tokens that an effect reads or writes: who subscribes to them sees every change on which its edits depend.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use pddl::{Source, parse_domain};
use vocabulary::Tokens;

/// An intention that assigns from an attribute which nothing else reads would otherwise write an old value.
#[test]
fn the_operands_of_a_numeric_effect_are_mentioned() {
    let words = "(define (domain words) (:requirements :typing :fluents :vocabulary)
        (:types robot - object) (:functions (speed ?r - robot) (battery ?r - robot) (load ?r - robot)))";
    let words = parse_domain(&Source::new("words", words), &[]).model.unwrap();
    let tokens = Tokens::new(&words).unwrap();
    let rules = "(define (domain rules) (:requirements :typing :fluents) (:import words)
        (:action set :parameters (?r - robot) :effect (assign (speed ?r) (* 2 (battery ?r))))
        (:action add :parameters (?r - robot) :effect (increase (speed ?r) (load ?r))))";
    let rules = parse_domain(&Source::new("rules", rules), &[&words]).model.unwrap();
    let link = tokens.link(&rules);
    let read = |name: &str| {
        let action = rules.actions.iter().find(|action| action.name.as_str() == name).unwrap();
        let effect = link.effect(&action.variables, [&action.effect]).unwrap();
        let vocabulary = tokens.vocabulary();
        let mut names: Vec<_> = effect
            .mentions()
            .attributes()
            .map(|attribute| vocabulary.attribute_name(attribute).unwrap().to_string())
            .collect();
        names.sort();
        names
    };
    assert_eq!(read("set"), ["battery", "speed"]);
    assert_eq!(read("add"), ["load", "speed"]);
}
