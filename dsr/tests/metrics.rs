//! What is measured: units of attributes, and distances, bearings and reach in patterns.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

use dsr::{
    AgentId, Comparison, Graph, Isometry3, Kind, Matches, Metric, Nature, PatternBuilder, PatternError,
    Threshold, Time, TransactionError, Unit, Value, VocabularyBuilder, VocabularyError,
};

fn room() -> Graph {
    let mut builder = VocabularyBuilder::new();
    let place = builder.node_type("place", None, Nature::Geometric).unwrap();
    let reach = builder.attribute_on_node("reach", place, Kind::Number).unwrap();
    builder.measured_in(reach, Unit::Metre).unwrap();
    builder.attribute_on_node("count", place, Kind::Number).unwrap();
    let name = builder.attribute_on_node("name", place, Kind::Text).unwrap();
    let refused = builder.measured_in(name, Unit::Metre).unwrap_err();
    assert_eq!(refused, VocabularyError::NotMeasured { name: "name".into() });
    let graph = Graph::new(builder.build());
    graph
        .edit(AgentId::DSR, Time(0), |tx| {
            ["room", "robot", "person"].iter().for_each(|name| _ = tx.add_node(*name, place));
            tx.set_transform("room", "robot", Isometry3::identity());
        })
        .unwrap();
    walk(&graph, 5.0, 0.0);
    graph
}

/// The person goes there.
fn walk(graph: &Graph, x: f64, y: f64) {
    let pose = Isometry3::new([x, y, 0.0].into(), Default::default());
    graph.edit(AgentId::DSR, Time(0), |tx| _ = tx.set_transform("room", "person", pose)).unwrap();
}

fn watch(graph: &Graph, write: impl FnOnce(&mut PatternBuilder<'_>)) -> Matches {
    let vocabulary = graph.vocabulary();
    let mut pattern = PatternBuilder::new(&vocabulary);
    write(&mut pattern);
    let mut matches = graph.subscribe(pattern.build().unwrap());
    while matches.try_recv().is_some() {}
    matches
}

fn holds(matches: &mut Matches) -> bool {
    while matches.try_recv().is_some() {}
    !matches.held().is_empty()
}

#[test]
fn a_quantity_is_kept_in_the_unit_of_its_attribute() {
    let graph = room();
    let vocabulary = graph.vocabulary();
    let attribute = |name| vocabulary.attribute(name).unwrap();
    let set = |name, number, unit| {
        graph.edit(AgentId::DSR, Time(0), |tx| {
            tx.set_attribute("robot", attribute(name), (number, unit));
        })
    };
    let committed = set("reach", 80.0, Unit::Centimetre).unwrap();
    let robot = committed.snapshot.node("robot").unwrap();
    let kept = committed.snapshot.attribute(robot, attribute("reach")).and_then(Value::as_number).unwrap();
    assert!((kept - 0.8).abs() < 1e-12);
    let wrong = set("reach", 80.0, Unit::Degree).unwrap_err();
    assert_eq!(wrong.to_string(), "attribute 'reach' is measured in m, not in °");
    assert!(matches!(wrong, TransactionError::WrongUnit { .. }));
    let none = set("count", 3.0, Unit::Metre).unwrap_err();
    assert_eq!(none.to_string(), "attribute 'count' is measured in no unit, not in m");
    assert!(set("reach", f64::MAX, Unit::Metre).is_ok());
    assert!(matches!(set("reach", f64::NAN, Unit::Metre), Err(TransactionError::NotFinite { .. })));
    assert!(matches!(set("name", 1.0, Unit::Metre), Err(TransactionError::WrongKind { .. })));
    // What is written down of a vocabulary has its units.
    let read: dsr::Vocabulary = serde_json::from_str(&serde_json::to_string(&*vocabulary).unwrap()).unwrap();
    assert_eq!(read.unit(attribute("reach")), Some(Unit::Metre));
    assert_eq!(read.unit(attribute("count")), None);
}

/// Close at one metre, no longer close at one and a half.
#[test]
fn a_threshold_with_hysteresis_does_not_flutter() {
    let graph = room();
    let near = Threshold { appears: 1.0, disappears: 1.5 };
    let mut close = watch(&graph, |p| _ = p.distance("robot", "person", Comparison::LessOrEqual, near));
    let mut steady = String::new();
    for x in [5.0, 1.2, 1.0, 1.2, 1.49, 1.0, 1.5, 1.51, 1.2, 0.9] {
        walk(&graph, x, 0.0);
        steady += if holds(&mut close) { "#" } else { "." };
    }
    assert_eq!(steady, "..#####..#");
    // Without history: only what would appear.
    walk(&graph, 1.2, 0.0);
    assert!(holds(&mut close) && !close.pattern().holds(&graph.snapshot()));
    // A subscriber that missed steps, and continues from the newest state, keeps the matches that it has.
    let vocabulary = graph.vocabulary();
    let mut pattern = PatternBuilder::new(&vocabulary);
    pattern.distance("robot", "person", Comparison::LessOrEqual, near);
    walk(&graph, 0.5, 0.0);
    let one = std::num::NonZeroUsize::new(1).unwrap();
    let mut slow = graph.subscribe_with(pattern.build().unwrap(), one);
    assert!(holds(&mut slow));
    (0..9).for_each(|step| walk(&graph, 1.1 + 0.01 * f64::from(step), 0.0));
    assert!(holds(&mut slow));
    graph.edit(AgentId::DSR, Time(0), |tx| _ = tx.remove_node("person")).unwrap();
    assert!(!holds(&mut slow) && !holds(&mut close), "who is gone is not close");
}

/// No person close: appears beyond one and a half metres, disappears within one.
#[test]
fn a_negated_threshold_does_not_flutter_either() {
    let graph = room();
    let near = Threshold { appears: 1.0, disappears: 1.5 };
    let negated = |p: &mut PatternBuilder<'_>| {
        p.without(|p| _ = p.distance("robot", "person", Comparison::LessOrEqual, near));
    };
    let twice = |p: &mut PatternBuilder<'_>| p.without(negated);
    let (mut alone, mut close) = (watch(&graph, negated), watch(&graph, twice));
    let (mut steady, mut twofold, mut asked) = (String::new(), String::new(), String::new());
    let sign = |holds| if holds { "#" } else { "." };
    for x in [5.0, 1.2, 1.0, 1.2, 1.49, 1.0, 1.5, 1.51, 1.2, 0.9] {
        walk(&graph, x, 0.0);
        steady += sign(holds(&mut alone));
        twofold += sign(holds(&mut close));
        asked += sign(alone.pattern().holds(&graph.snapshot()));
    }
    assert_eq!((&*steady, &*twofold), ("##.....##.", "..#####..#"));
    assert_eq!(asked, "#......#..", "without a history, what is in the band does not hold");
}

#[test]
fn bearing_and_reach_follow_frames_and_attributes() {
    let graph = room();
    let reach = graph.vocabulary().attribute("reach").unwrap();
    let mut ahead =
        watch(&graph, |p| _ = p.metric(Metric::Bearing, "robot", "person", Comparison::Less, 0.5));
    let mut within = watch(&graph, |p| _ = p.reachable("robot", "person", reach));
    assert_eq!((holds(&mut ahead), holds(&mut within)), (true, false));
    graph.edit(AgentId::DSR, Time(0), |tx| _ = tx.set_attribute("robot", reach, 0.8)).unwrap();
    for ((x, y), expected) in [
        ((0.7, 0.2), (true, true)),
        ((0.7, -0.2), (true, true)),
        ((0.2, 0.7), (false, true)),
        ((-0.7, 0.0), (false, true)),
        ((0.8, 0.2), (true, false)),
    ] {
        walk(&graph, x, y);
        let now = graph.snapshot();
        let (robot, person) = (now.node("robot").unwrap(), now.node("person").unwrap());
        assert_eq!((holds(&mut ahead), holds(&mut within)), expected, "{x} {y}");
        assert!((now.bearing(robot, person).unwrap() - y.atan2(x)).abs() < 1e-12);
        assert_eq!(now.reachable(robot, person, reach).unwrap(), expected.1);
    }
    // A longer arm reaches what a shorter one did not.
    graph.edit(AgentId::DSR, Time(0), |tx| _ = tx.set_attribute("robot", reach, (1.0, Unit::Metre))).unwrap();
    assert!(holds(&mut within));
    graph.edit(AgentId::DSR, Time(0), |tx| _ = tx.clear_attribute("robot", reach)).unwrap();
    assert!(!holds(&mut within));
}

/// What is asked as text is what a program would write.
#[test]
fn texts_measure_too() {
    let graph = room();
    let (vocabulary, reach) = (graph.vocabulary(), graph.vocabulary().attribute("reach").unwrap());
    let mut texts = [
        "(< (bearing robot person) 0.5)",
        "(<= (distance robot person) (reach robot))",
        "(<= (distance robot person) 1 1.5)",
    ]
    .map(|text| graph.subscribe(dsr::Pattern::parse(&vocabulary, text).unwrap()));
    let near = Threshold { appears: 1.0, disappears: 1.5 };
    let mut written = [
        watch(&graph, |p| _ = p.metric(Metric::Bearing, "robot", "person", Comparison::Less, 0.5)),
        watch(&graph, |p| _ = p.reachable("robot", "person", reach)),
        watch(&graph, |p| _ = p.distance("robot", "person", Comparison::LessOrEqual, near)),
    ];
    graph.edit(AgentId::DSR, Time(0), |tx| _ = tx.set_attribute("robot", reach, 0.8)).unwrap();
    let mut seen = [false; 3];
    for (x, y) in [(5.0, 0.0), (0.7, 0.2), (1.2, 0.0), (0.2, 0.7), (1.6, 0.0), (1.2, 0.0)] {
        walk(&graph, x, y);
        for ((text, written), seen) in texts.iter_mut().zip(&mut written).zip(&mut seen) {
            let holds = holds(text);
            assert_eq!(holds, self::holds(written), "{x} {y}");
            *seen |= holds;
        }
    }
    assert_eq!(seen, [true; 3]);
}

#[test]
fn a_threshold_that_makes_no_sense_is_refused() {
    let graph = room();
    let vocabulary = graph.vocabulary();
    let build = |comparison, appears, disappears| {
        let mut pattern = PatternBuilder::new(&vocabulary);
        pattern.distance("robot", "person", comparison, Threshold { appears, disappears });
        pattern.build().map(|_| ())
    };
    assert!(build(Comparison::Less, 1.0, 2.0).is_ok() && build(Comparison::Greater, 2.0, 1.0).is_ok());
    for (comparison, appears, disappears) in [
        (Comparison::Less, 2.0, 1.0),
        (Comparison::GreaterOrEqual, 1.0, 2.0),
        (Comparison::Equal, 1.0, 2.0),
        (Comparison::Less, f64::NAN, f64::NAN),
    ] {
        let refused = build(comparison, appears, disappears);
        assert!(matches!(refused, Err(PatternError::WrongThreshold { .. })), "{comparison:?}");
    }
    let mut pattern = PatternBuilder::new(&vocabulary);
    pattern.reachable("robot", "person", vocabulary.attribute("name").unwrap());
    assert!(matches!(pattern.build(), Err(PatternError::WrongKind { .. })));
}
