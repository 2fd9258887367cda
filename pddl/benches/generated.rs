//! A long problem, made up.

use std::fmt::Write as _;

/// What the problem is a problem of.
pub const DOMAIN: &str =
    "(define (domain delivery) (:requirements :typing) (:types truck parcel - thing place)
  (:predicates (at ?x - thing ?p - place) (road ?a ?b - place) (in ?p - parcel ?t - truck)))";

/// A problem of about `bytes` bytes: objects, then facts.
pub fn problem(bytes: usize) -> String {
    let mut text = "(define (problem big) (:domain delivery) (:objects truck - truck".to_owned();
    let places = bytes / 100;
    for i in 0..places {
        let _ = write!(text, " place-{i} - place parcel-{i} - parcel");
    }
    text.push_str(")\n  (:init");
    for i in 0.. {
        if text.len() >= bytes {
            break;
        }
        let (a, b) = (i % places, (i * 7 + 3) % places);
        let _ = write!(text, "\n    (at parcel-{a} place-{b}) (road place-{a} place-{b})");
    }
    text + ")\n  (:goal (at truck place-0)))"
}
