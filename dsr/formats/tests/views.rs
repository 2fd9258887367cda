//! States as text and pictures.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

#[path = "../../tests/world/mod.rs"]
mod world;

use dsr::{AgentId, Covariance, Graph, Kind, Nature, NewValue, Pose, Time, Transaction, VocabularyBuilder};
use expect_test::expect;
use formats::View;

#[test]
fn a_state_is_sentences_and_pictures() {
    let graph = world::ward();
    let lines = "node a<b person\nedge a<b is_with clarc\nset-edge barthel is_in feeding says text \"hi\"";
    world::commit(&graph, "dsr", lines).unwrap();
    let snapshot = graph.snapshot();
    let clarc = View::around(&snapshot, snapshot.node("clarc").unwrap(), 1);
    expect![[r#"
        world (place)
        clarc (robot)
          clarc at (1.000, 0.000, 0.000) in world
        camera (place)
          camera at (0.000, 0.000, 1.500) in clarc
        carlos (person)
          carlos at (3.000, 0.000, 0.000) in world
          carlos is with clarc
        a<b (person)
          a<b is with clarc
    "#]]
    .assert_eq(&(formats::lines(&clarc).join("\n") + "\n"));
    let barthel = View::around(&snapshot, snapshot.node("barthel").unwrap(), 1);
    expect![[r#"
        digraph dsr {
          node [shape=box];
          n12 [label="barthel\ntest"];
          n13 [label="feeding\npart"];
          n12 -> n13 [label="is_in\nsays: \"hi\""];
        }
    "#]]
    .assert_eq(&formats::dot(&barthel));
    expect![[r#"
        <?xml version="1.0" encoding="UTF-8"?>
        <graphml xmlns="http://graphml.graphdrawing.org/xmlns">
          <key id="k3" for="edge" attr.name="attribute.says" attr.type="string"/>
          <key id="k2" for="edge" attr.name="label" attr.type="string"/>
          <key id="k0" for="node" attr.name="name" attr.type="string"/>
          <key id="k1" for="node" attr.name="type" attr.type="string"/>
          <graph id="dsr" edgedefault="directed">
            <node id="n12">
              <data key="k0">barthel</data>
              <data key="k1">test</data>
            </node>
            <node id="n13">
              <data key="k0">feeding</data>
              <data key="k1">part</data>
            </node>
            <edge source="n12" target="n13">
              <data key="k2">is_in</data>
              <data key="k3">&quot;hi&quot;</data>
            </edge>
          </graph>
        </graphml>
    "#]]
    .assert_eq(&formats::graphml(&barthel));
    let svg = formats::svg(&clarc);
    assert_eq!(svg.matches("rx=").count(), 5, "five nodes");
    assert_eq!(svg.matches("<path").count(), 6, "three transforms, two edges, an arrow");
    assert!(svg.contains("a&lt;b") && !svg.contains("a<b") && !svg.contains("NaN"));
    assert_eq!(clarc.export().nodes.len(), 5);
    // All of it, with a cycle.
    world::commit(&graph, "dsr", "edge carlos knows a<b\nedge a<b knows clarc\nedge clarc knows carlos")
        .unwrap();
    let all = graph.snapshot();
    assert_eq!(formats::svg(&View::whole(&all)).matches("rx=").count(), all.nodes().count());
}

#[test]
fn whatever_a_name_has_in_it_the_xml_is_well_formed() {
    let mut builder = VocabularyBuilder::new();
    let kind = builder.node_type("a type\u{ffff}", None, Nature::Geometric).unwrap();
    let level = builder.attribute_on_node("battery level\n\"1\"", kind, Kind::Text).unwrap();
    let graph = Graph::new(builder.build());
    let mut tx = Transaction::new(AgentId::DSR);
    tx.add_node("a\u{fffe}b", kind).add_node("c\u{0}\u{1b}<", kind);
    let error =
        Covariance::new(nalgebra::Matrix6::from_diagonal(&[0.25, 0.5, 1.0, 0.0, 0.0, 2.0].into())).unwrap();
    tx.set_transform("a\u{fffe}b", "c\u{0}\u{1b}<", Pose::new(world::pose([1.0, 2.0, 3.0, 0.0]), error));
    tx.set_attribute("a\u{fffe}b", level, NewValue::Text("one\r\ntwo\tthree\u{ffff}".into()));
    graph.commit(&tx, Time(0)).unwrap();
    let snapshot = graph.snapshot();
    let (graphml, svg) = (formats::graphml(&View::whole(&snapshot)), formats::svg(&View::whole(&snapshot)));
    for xml in [&graphml, &svg] {
        let is_char = |c: char| c == '\n' || (c >= ' ' && c != '\u{fffe}' && c != '\u{ffff}');
        assert!(xml.chars().all(is_char), "{xml}");
    }
    let ids: Vec<_> =
        graphml.split("key id=\"").skip(1).map(|rest| rest.split('"').next().unwrap()).collect();
    assert_eq!(ids.len(), 6);
    assert!(ids.iter().all(|id| id.chars().all(|c| c.is_ascii_alphanumeric())), "{ids:?}");
    let uses = graphml.split("data key=\"").skip(1).map(|rest| rest.split('"').next().unwrap());
    assert!(uses.clone().all(|id| ids.contains(&id)) && uses.count() > 6);
    assert!(graphml.contains("attr.name=\"attribute.battery level&#10;&quot;1&quot;\""), "{graphml}");
    assert!(graphml.contains(">one&#13;&#10;two&#9;three\u{fffd}<"), "{graphml}");
    let covariance = "0.25 0 0 0 0 0 0 0.5 0 0 0 0 0 0 1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 2";
    assert!(graphml.contains(&format!(">{covariance}</data>")), "{graphml}");
}
