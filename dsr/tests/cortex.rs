//! Worlds of cortex: what its types and its RT convention become, and what is refused.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

use dsr::{CortexError, CortexUnit, CortexWorld, TransactionError};
use expect_test::expect;

const KITCHEN: &str = include_str!("cortex/kitchen.json");

fn import(json: &str) -> Result<dsr::Imported, CortexError> {
    serde_json::from_str::<CortexWorld>(json).unwrap().import(CortexUnit::Millimetres)
}

#[test]
fn a_world_is_taken_over() {
    let imported = import(KITCHEN).unwrap();
    let snapshot = imported.graph.snapshot();
    let mut text = snapshot.view().lines();
    text.extend(imported.notes);
    expect![[r#"
        dsr (agent)
        cortex (agent)
        kitchen (root)
          kitchen: level 0
        shadow (omnirobot)
          shadow: battery 0.75
          shadow: level 1
          shadow: moving true
          shadow: port.number 10004
          shadow: serial “18446744073709551614”
          shadow: speed 0 0.5
          shadow: speed 1 0
          shadow: speed 2 0.1
          shadow at (1.500, -0.500, 0.000) in kitchen
          shadow interacting person 7
            shadow interacting person 7: interacting.since 4.5
        person_7 (person)
          person 7: port.text “none”
          person 7 at (2.000, 1.000, 0.000) in kitchen
        attribute `depth_image` of `shadow`: left out, it is a long list
        link `thinks_of` from `shadow` to itself: left out, no edge may do that
    "#]]
    .assert_eq(&(text.join("\n") + "\n"));
    // In the robot's frame, which is turned to the left by a right angle, the person is half a metre to the right.
    let node = |name| snapshot.node(name).unwrap();
    let person = snapshot.transform(node("shadow"), node("person_7")).unwrap();
    let at = person.translation.vector;
    assert!((at - nalgebra::Vector3::new(1.5, -0.5, 0.0)).norm() < 1e-9, "{at}");
    // Rx · Ry · Rz: the second angle turns about the y axis that the first has turned.
    let person = snapshot.transform(node("kitchen"), node("person_7")).unwrap();
    let x = person.rotation * nalgebra::Vector3::x();
    let wanted = [0.25_f64.cos(), 0.5_f64.sin() * 0.25_f64.sin(), -(0.5_f64.cos()) * 0.25_f64.sin()];
    assert!((x - nalgebra::Vector3::from(wanted)).norm() < 1e-9, "{x}");
    let metres = serde_json::from_str::<CortexWorld>(KITCHEN).unwrap().import(CortexUnit::Metres).unwrap();
    assert!(
        (metres.graph.snapshot().distance(node("kitchen"), node("shadow")).unwrap() - 1_581.138_83).abs()
            < 1e-3
    );
}

#[test]
fn what_is_no_world_is_named() {
    let dangling =
        KITCHEN.replace("\"dst\": \"100\", \"label\": \"RT\"", "\"dst\": \"9\", \"label\": \"RT\"");
    assert!(matches!(import(&dangling), Err(CortexError::NoSymbol { missing, .. }) if missing == "9"));
    let twice = KITCHEN.replace("\"id\": \"7\"", "\"id\": \"1\"");
    assert!(matches!(import(&twice), Err(CortexError::SameId { .. })));
    let short = KITCHEN.replace("[1500, -500, 0]", "[1500, -500]");
    assert!(matches!(import(&short), Err(CortexError::NoPose { .. })));
    let cycle = KITCHEN.replace("\"label\": \"interacting\"", "\"label\": \"RT\"");
    assert!(matches!(import(&cycle), Err(CortexError::NoPose { .. })));
    let parents = KITCHEN.replace(
        "\"label\": \"interacting\", \"linkAttribute\": {",
        "\"label\": \"RT\", \"linkAttribute\": {\"rt_translation\": {\"type\": 3, \"value\": [0, 0, 0]}, \
         \"rt_rotation_euler_xyz\": {\"type\": 3, \"value\": [0, 0, 0]}, ",
    );
    let error = import(&parents).unwrap_err();
    assert!(matches!(error, CortexError::Transaction(TransactionError::SecondParent { .. })), "{error}");
}
