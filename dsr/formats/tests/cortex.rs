//! Worlds of cortex: what its types and its RT convention become, and what is refused.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

use dsr::TransactionError;
use expect_test::expect;
use formats::{CortexError, CortexUnit, CortexWorld, Imported, View};
use proptest::prelude::*;
use serde_json::{Value as Json, json};

const KITCHEN: &str = include_str!("cortex/kitchen.json");

fn import(json: &str) -> Result<Imported, CortexError> {
    serde_json::from_str::<CortexWorld>(json).unwrap().import(CortexUnit::Millimetres)
}

#[test]
fn a_world_is_taken_over() {
    let imported = import(KITCHEN).unwrap();
    let snapshot = imported.graph.snapshot();
    let mut text = formats::lines(&View::whole(&snapshot));
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
          shadow: serial “18446744073709551614”
          shadow: port.number 10004
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
    let noted = "link `RT` from 1 to 9: left out, no symbol has the id 9".to_owned();
    assert!(import(&dangling).unwrap().notes.contains(&noted));
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

fn take(world: &Json) -> Imported {
    serde_json::from_value::<CortexWorld>(world.clone()).unwrap().import(CortexUnit::Metres).unwrap()
}

fn ring(attributes: &Json) -> Imported {
    take(&json!({"DSRModel": {"symbols": {
        "1": {"id": "1", "type": "root", "name": "world", "links": [
            {"src": "1", "dst": "2", "label": "RT", "linkAttribute": attributes}]},
        "2": {"id": "2", "type": "robot", "name": "shadow"}}}}))
}

/// Where the robot is, and when it was where.
fn along_x(imported: &Imported) -> (f64, Vec<(u64, f64)>) {
    let snapshot = imported.graph.snapshot();
    let node = |name| snapshot.node(name).unwrap();
    let now = snapshot.transform(node("world"), node("shadow")).unwrap().translation.x;
    let export = snapshot.export();
    let samples = export.transforms[0].samples.iter();
    (now, samples.map(|sample| (sample.time.0 / 1_000_000, sample.translation[0])).collect())
}

#[test]
fn the_newest_pose_of_a_ring_is_told_by_its_stamps() {
    let zeros = json!({"type": 3, "value": vec![0; 9]});
    let xs = |a: u32, b: u32, c: u32| json!({"type": 3, "value": [a, 0, 0, b, 0, 0, c, 0, 0]});
    let with = |head: Json, stamps: Json| {
        along_x(&ring(&json!({
            "rt_head_index": {"type": 6, "value": head},
            "rt_timestamps": {"type": 9, "value": stamps},
            "rt_translation": xs(1, 2, 3),
            "rt_rotation_euler_xyz": zeros})))
    };
    // The head is the block written last, or the one that is written next: the stamps know.
    let samples = vec![(1_722_433_444_000, 3.0), (1_722_433_444_050, 1.0), (1_722_433_444_100, 2.0)];
    let stamps = json!(["1722433444050", "1722433444100", "1722433444000"]);
    assert_eq!(with(json!(3), stamps.clone()), (2.0, samples.clone()));
    assert_eq!(with(json!(6), stamps), (2.0, samples));
    // Of a ring that was never filled only what was written counts, and once is a mounting, which holds at any time.
    assert_eq!(with(json!(0), json!([70, 50, 0])), (1.0, vec![(50, 2.0), (70, 1.0)]));
    assert_eq!(with(json!(0), json!(["0", "50", "0"])), (2.0, vec![]));
    // What is further back than the horizon is not there.
    assert_eq!(with(json!(0), json!([5, 30_000, 30_001])), (3.0, vec![(30_000, 2.0), (30_001, 3.0)]));
    assert_eq!(with(json!(0), json!([5, 30_000, 6])), (2.0, vec![]));
    // Two of one millisecond: the head tells, or else the place.
    assert_eq!(with(json!(0), json!([9, 9, 9])).0, 1.0);
    assert_eq!(with(json!(7), json!([9, 9, 0])).0, 2.0);
    // Without stamps, the head; without a head, the first.
    assert_eq!(with(json!(6), json!([0, 0, 0])), (3.0, vec![]));
    let bare = |attributes: Json| along_x(&ring(&attributes)).0;
    let poses = json!({"rt_translation": xs(4, 5, 6), "rt_rotation_euler_xyz": zeros});
    assert_eq!(bare(poses.clone()), 4.0);
    let zero = json!({"type": 3, "value": [0, 0, 0]});
    let old = ring(&json!({"translation": xs(7, 0, 0), "rotation_euler_xyz": zero, "linear_speed": zero}));
    assert_eq!(along_x(&old).0, 7.0);
    assert_eq!(old.notes, ["attribute `linear_speed` of `world RT shadow`: left out, a transform has none"]);
    let mut headed = poses;
    headed["rt_head_index"] = json!({"type": 6, "value": 3});
    assert_eq!(bare(headed), 5.0);
}

#[test]
fn names_that_clash_are_told() {
    let world = json!({"DSRModel": {"symbols": {
        "1": {"id": "1", "type": "object", "name": "dsr", "attribute": {
            "is.since": {"type": 1, "value": 1},
            "port": {"type": 1, "value": 2},
            "port.number": {"type": 1, "value": 3},
            "speed": {"type": 3, "value": [4, 5]},
            "speed_0": {"type": 1, "value": 6},
            "claim": {"type": 1, "value": 7}},
          "links": [
            {"src": "1", "dst": "2", "label": "is", "linkAttribute": {"since": {"type": 1, "value": 8}}},
            {"src": "1", "dst": "2", "label": "a", "linkAttribute": {"b.c": {"type": 1, "value": 9}}},
            {"src": "1", "dst": "2", "label": "a.b", "linkAttribute": {"c": {"type": 1, "value": 10}}},
            {"src": "1", "dst": "2", "label": "a.b", "linkAttribute": {"c": {"type": 1, "value": 11}}}]},
        "2": {"id": "2", "type": "cortex_object", "name": "cortex_dsr", "attribute": {
            "port": {"type": 0, "value": "x"}}}}}});
    let imported = take(&world);
    let mut text = formats::lines(&View::whole(&imported.graph.snapshot()));
    text.extend(imported.notes);
    expect![[r#"
        dsr (agent)
        cortex (agent)
        cortex_dsr (cortex_object)
          cortex dsr: cortex claim 7
          cortex dsr: is.since 1
          cortex dsr: port.number 3
          cortex dsr: speed 0 6
          cortex dsr: port.number 2 2
          cortex dsr: speed 0 2 4
          cortex dsr: speed 1 5
          cortex dsr is cortex dsr 2
            cortex dsr is cortex dsr 2: is.since 2 8
          cortex dsr a cortex dsr 2
            cortex dsr a cortex dsr 2: a.b.c 9
          cortex dsr a.b cortex dsr 2
            cortex dsr a.b cortex dsr 2: a.b.c 2 10
        cortex_dsr_2 (cortex_object_2)
          cortex dsr 2: port.text “x”
        node `dsr`: called `cortex_dsr`, every graph has that name
        node `cortex_dsr`: called `cortex_dsr_2`, the name is taken
        link `a.b` from `cortex_dsr` to `cortex_dsr_2`: left out, there is one already
        type `object`: called `cortex_object`, every graph has that name
        type `cortex_object`: called `cortex_object_2`, the name is taken
        attribute `claim`: called `cortex_claim`, every graph has that name
        attribute `port.number`: called `port.number_2`, the name is taken
        attribute `speed_0`: called `speed_0_2`, the name is taken
        attribute `a.b.c`: called `a.b.c_2`, the name is taken
        attribute `is.since`: called `is.since_2`, the name is taken
    "#]]
    .assert_eq(&(text.join("\n") + "\n"));
}

/// Names that are built in, that contain our punctuation, or that are empty.
const NAMES: [&str; 18] = [
    "",
    "a",
    "b",
    "a.b",
    "b.a",
    "a_0",
    "a_1",
    "a_2",
    "a.number",
    "a.text",
    "a.a",
    "object",
    "cortex_object",
    "dsr",
    "cortex",
    "holds",
    "claim",
    "cortex_claim",
];

fn contents() -> impl Strategy<Value = Vec<(usize, usize)>> {
    prop::collection::vec((0..NAMES.len(), 0..4_usize), 0..6)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]
    /// Whatever things are called, nothing is refused and nothing is lost.
    #[test]
    fn no_world_is_refused_for_its_names(
        symbols in prop::collection::vec((0..NAMES.len(), 0..NAMES.len(), contents()), 1..6),
        links in prop::collection::vec((0..6_usize, 0..6_usize, 0..NAMES.len(), contents()), 0..8),
    ) {
        // Every number is another one, so that each value can be found again.
        let mut next = 0;
        let mut wanted = Vec::new();
        let mut attributes = |contents: &[(usize, usize)], is_kept: bool| {
            let mut map = serde_json::Map::new();
            for (name, sort) in contents {
                if map.contains_key(NAMES[*name]) {
                    continue;
                }
                let mut number = || {
                    next += 1;
                    if is_kept {
                        wanted.push(next.to_string());
                    }
                    next
                };
                let value = match sort {
                    0 => json!({"type": 1, "value": number()}),
                    1 => json!({"type": 0, "value": number().to_string()}),
                    _ => json!({"type": 3, "value": (1..*sort).map(|_| number()).collect::<Vec<_>>()}),
                };
                map.insert(NAMES[*name].to_owned(), value);
            }
            map
        };
        let mut world = json!({"DSRModel": {"symbols": {}}});
        let count = symbols.len();
        for (id, (kind, name, contents)) in symbols.iter().enumerate() {
            world["DSRModel"]["symbols"][id.to_string()] = json!({
                "id": id.to_string(), "type": NAMES[*kind], "name": NAMES[*name],
                "attribute": attributes(contents, true), "links": []});
        }
        let mut seen = std::collections::BTreeSet::new();
        for (from, to, label, contents) in &links {
            let (from, to) = (from % count, to % count);
            let is_kept = from != to && seen.insert((from, to, *label));
            let link = json!({"src": from.to_string(), "dst": to.to_string(), "label": NAMES[*label],
                "linkAttribute": attributes(contents, is_kept)});
            world["DSRModel"]["symbols"][from.to_string()]["links"].as_array_mut().unwrap().push(link);
        }
        let zero = json!({"type": 3, "value": [0, 0, 0]});
        for child in 1..count {
            let link = json!({"src": "0", "dst": child.to_string(), "label": "RT",
                "linkAttribute": {"rt_translation": zero, "rt_rotation_euler_xyz": zero}});
            world["DSRModel"]["symbols"]["0"]["links"].as_array_mut().unwrap().push(link);
        }
        let export = take(&world).graph.snapshot().export();
        prop_assert_eq!(export.nodes.len(), count + 2, "the nodes and two agents");
        prop_assert_eq!(export.edges.len(), seen.len());
        prop_assert_eq!(export.transforms.len(), count - 1);
        let of_nodes = export.nodes.iter().flat_map(|node| &node.attributes);
        let of_edges = export.edges.iter().flat_map(|edge| &edge.attributes);
        let mut found: Vec<_> = of_nodes.chain(of_edges).map(|attribute| match &attribute.value {
            dsr::ExportedValue::Number(number) => number.to_string(),
            dsr::ExportedValue::Text(text) => text.to_string(),
            other => panic!("{other:?}"),
        }).collect();
        found.sort();
        wanted.sort();
        prop_assert_eq!(found, wanted);
    }
}
