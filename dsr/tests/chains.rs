//! Kinematic chains: the convention, and chains through the common ancestor against products from the root.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

mod world;

use std::f64::consts::FRAC_PI_2;

use dsr::{AgentId, ChainError, Graph, Isometry3, NodeId, Time};
use nalgebra::Point3;
use petgraph::graphmap::DiGraphMap;
use petgraph::visit::Dfs;
use proptest::prelude::*;

fn near(a: &Isometry3<f64>, b: &Isometry3<f64>) -> bool {
    (a.translation.vector - b.translation.vector).norm() < 1e-9 && a.rotation.angle_to(&b.rotation) < 1e-9
}

/// `transform(a, b)` is the pose of b in a: it maps coordinates of b into a.
#[test]
fn the_convention() {
    let graph = world::ward();
    // The robot stands at (1, 0) and looks along y; the camera is 1.5 above it; the person is at (3, 0).
    world::commit(&graph, "dsr", &format!("transform world clarc 1 0 0 {FRAC_PI_2}")).unwrap();
    let now = graph.snapshot();
    let id = |name| now.node(name).unwrap();
    let in_world = now.transform(id("world"), id("clarc")).unwrap();
    assert!(near(&in_world, &world::pose([1.0, 0.0, 0.0, FRAC_PI_2])));
    // One metre ahead of the robot is one metre along y in the world.
    let ahead = in_world * Point3::new(1.0, 0.0, 0.0);
    assert!((ahead - Point3::new(1.0, 1.0, 0.0)).norm() < 1e-9);
    // The person is two metres to the right of the robot, and lower than the camera.
    let person = now.transform(id("camera"), id("carlos")).unwrap();
    assert!((person.translation.vector - nalgebra::Vector3::new(0.0, -2.0, -1.5)).norm() < 1e-9);
    assert!((now.distance(id("clarc"), id("carlos")).unwrap() - 2.0).abs() < 1e-9);
    assert!(near(&now.transform(id("clarc"), id("clarc")).unwrap(), &Isometry3::identity()));
    assert_eq!(now.root(), Some(id("world")));
}

#[test]
fn no_chain_says_why() {
    let graph = world::ward();
    world::commit(&graph, "dsr", "node anna person").unwrap();
    let now = graph.snapshot();
    let id = |name| now.node(name).unwrap();
    let (anna, clarc, world) = (id("anna"), id("clarc"), id("world"));
    let apart = ChainError::NotConnected { from: "anna".into(), to: "clarc".into() };
    assert_eq!(now.transform(anna, clarc), Err(apart));
    assert_eq!(
        now.transform(world, id("speaking")),
        Err(ChainError::NotGeometric { node: "speaking".into() })
    );
    world::commit(&graph, "dsr", "no-node anna").unwrap();
    assert_eq!(graph.snapshot().distance(world, anna), Err(ChainError::UnknownNode { node: anna }));
    assert!(now.transform(anna, anna).is_ok(), "the old snapshot still has her");
}

/// A child changes its parent in one commit; a leaf may leave the tree; a root may go when its subtree is one.
#[test]
fn the_tree_changes_as_a_whole() {
    let graph = world::ward();
    let moved = "no-transform world carlos\ntransform clarc carlos 2 0 0 0";
    let commit = world::commit(&graph, "dsr", moved).unwrap();
    assert_eq!(commit.delta.changes.len(), 2);
    world::commit(&graph, "dsr", "no-transform clarc carlos").unwrap();
    world::commit(&graph, "dsr", "no-node world").unwrap();
    let now = graph.snapshot();
    assert_eq!(now.root(), now.node("clarc"));
    world::commit(&graph, "dsr", "no-transform clarc camera").unwrap();
    assert_eq!(graph.snapshot().root(), None);
}

proptest! {
    // Every pair of nodes of each tree: a few trees are many chains.
    #![proptest_config(ProptestConfig::with_cases(48))]
    #[test]
    fn a_chain_is_the_product_from_the_root(
        parents in prop::collection::vec((any::<prop::sample::Index>(), prop::array::uniform6(-3.0..3.0)), 1..25),
    ) {
        let vocabulary = world::vocabulary();
        let place = vocabulary.node_type("place").unwrap();
        let graph = Graph::new(vocabulary);
        graph.edit(AgentId::DSR, Time(0), |tx| {
            tx.add_node("n0", place);
            for (at, (parent, [x, y, z, a, b, c])) in parents.iter().enumerate() {
                tx.add_node(format!("n{}", at + 1), place).set_transform(
                    format!("n{}", parent.index(at + 1)),
                    format!("n{}", at + 1),
                    Isometry3::new([*x, *y, *z].into(), [*a, *b, *c].into()),
                );
            }
        }).unwrap();
        let now = graph.snapshot();
        let nodes: Vec<NodeId> = now.nodes_of(place).collect();
        let from_root = |mut id| {
            let mut pose = Isometry3::identity();
            while let Some((parent, step, _)) = now.get(id).unwrap().parent() {
                pose = step.transform * pose;
                id = parent;
            }
            pose
        };
        for &a in &nodes {
            for &b in &nodes {
                let chain = now.transform(a, b).unwrap();
                prop_assert!(near(&chain, &(from_root(a).inverse() * from_root(b))));
                prop_assert!(near(&chain.inverse(), &now.transform(b, a).unwrap()));
            }
        }
        // petgraph sees the same rooted tree.
        let edges = nodes.iter().filter_map(|&id| Some((now.get(id)?.parent()?.0, id)));
        let quiver = DiGraphMap::<NodeId, ()>::from_edges(edges);
        prop_assert_eq!(quiver.edge_count() + 1, quiver.node_count());
        let mut walk = Dfs::new(&quiver, now.root().unwrap());
        let mut reached = 0;
        while walk.next(&quiver).is_some() {
            reached += 1;
        }
        prop_assert_eq!(reached, nodes.len());
    }
}

/// The world with an arm on a base: the base moves along x a metre a second, the arm turns a radian a second.
fn moving() -> (Graph, [NodeId; 4]) {
    let graph = world::ward();
    for at in 0..=20_u64 {
        #[expect(clippy::cast_precision_loss, reason = "small")]
        let seconds = at as f64 / 10.0;
        let base = format!("sample world clarc {} {seconds} 0", at * 100_000_000);
        world::commit(&graph, "dsr", &base).unwrap();
        if at <= 15 {
            let turned = world::pose([0.0, 1.0, 0.0, seconds]);
            let time = Time(at * 100_000_000);
            graph
                .edit(AgentId::DSR, Time(0), |tx| _ = tx.sample_transform("clarc", "camera", time, turned))
                .unwrap();
        }
    }
    let now = graph.snapshot();
    let ids = ["world", "clarc", "camera", "carlos"].map(|name| now.node(name).unwrap());
    (graph, ids)
}

#[test]
fn a_chain_at_a_time_is_interpolated() {
    let (graph, [world, clarc, camera, carlos]) = moving();
    let now = graph.snapshot();
    let then = Time(1_234_000_000);
    assert!(near(&now.transform_at(world, clarc, then).unwrap(), &world::pose([1.234, 0.0, 0.0, 0.0])));
    assert!(near(&now.transform_at(world, camera, then).unwrap(), &world::pose([1.234, 1.0, 0.0, 1.234])));
    // Through the common ancestor; the person stands at (3, 0) at all times.
    let seen = now.transform_at(camera, carlos, then).unwrap();
    let wanted = world::pose([1.234, 1.0, 0.0, 1.234]).inv_mul(&world::pose([3.0, 0.0, 0.0, 0.0]));
    assert!(near(&seen, &wanted));
    // The newest of each, and the newest that all have.
    assert!(near(&now.transform(world, camera).unwrap(), &world::pose([2.0, 1.0, 0.0, 1.5])));
    assert_eq!(now.common_time(world, camera), Ok(Some(Time(1_500_000_000))));
    assert_eq!(now.common_time(world, carlos), Ok(None));
    assert!(near(&now.transform_together(carlos, camera).unwrap(), &{
        world::pose([3.0, 0.0, 0.0, 0.0]).inv_mul(&world::pose([1.5, 1.0, 0.0, 1.5]))
    }));
}

#[test]
fn extrapolation_is_refused_by_name() {
    let (graph, [world, _, camera, carlos]) = moving();
    let now = graph.snapshot();
    let asked = Time(1_600_000_000);
    let refused = ChainError::Extrapolation {
        parent: "clarc".into(),
        child: "camera".into(),
        asked,
        first: Time(0),
        last: Time(1_500_000_000),
    };
    assert_eq!(now.transform_at(carlos, camera, asked), Err(refused.clone()));
    assert_eq!(
        refused.to_string(),
        "'camera' in 'clarc' is known from 0 to 1500000000 ns, not at 1600000000"
    );
    // Edges above the closest common ancestor are not asked.
    assert!(now.transform_at(world, carlos, Time(99_000_000_000)).is_ok());
}

/// A new parent is a new edge with a buffer of its own; snapshots show the one or the other, never a mixture.
#[test]
fn reparenting_is_atomic_and_begins_anew() {
    let (graph, [world, clarc, camera, _]) = moving();
    let before = graph.snapshot();
    let moved = "no-transform clarc camera\nsample world camera 5 7 0";
    world::commit(&graph, "dsr", moved).unwrap();
    let now = graph.snapshot();
    assert_eq!(now.get(camera).unwrap().poses().count(), 1);
    assert_eq!(before.get(camera).unwrap().poses().count(), 16);
    assert!(near(&now.transform_at(world, camera, Time(5)).unwrap(), &world::pose([7.0, 0.0, 0.0, 0.0])));
    assert!(now.transform_at(clarc, camera, Time(4)).is_err());
    // What is written late has its place; what is refused leaves no pose behind.
    world::commit(&graph, "dsr", "sample world camera 3 5 0").unwrap();
    world::commit(&graph, "dsr", "sample world camera 9 9 9\nno-node nobody").unwrap_err();
    let now = graph.snapshot();
    assert_eq!(now.get(camera).unwrap().poses().map(|(time, _)| time.0).collect::<Vec<_>>(), [3, 5]);
    assert!(near(&now.transform(world, camera).unwrap(), &world::pose([7.0, 0.0, 0.0, 0.0])));
    assert!(near(&now.transform_at(world, camera, Time(4)).unwrap(), &world::pose([6.0, 0.0, 0.0, 0.0])));
}

/// A mounting without a covariance is exact; what moves without one makes the error unknown; a time between two samples
/// lies between their covariances.
#[test]
fn a_chain_tells_its_error_if_it_is_known() {
    let graph = world::ward();
    let pose = |time: Option<u64>| {
        let now = graph.snapshot();
        let id = |name| now.node(name).unwrap();
        let (from, to) = (id("world"), id("camera"));
        match time {
            None => now.pose(from, to).unwrap(),
            Some(time) => now.pose_at(from, to, Time(time)).unwrap(),
        }
    };
    let variance = |pose: &dsr::Pose| pose.covariance.as_ref().map(|known| known.matrix()[(0, 0)]);
    assert_eq!(variance(&pose(None)), None, "no edge has a covariance");
    world::commit(&graph, "dsr", "no-transform world clarc\nsample world clarc 0 1 0").unwrap();
    assert_eq!(variance(&pose(None)), None, "a moving edge without a covariance");
    let moved = "sample world clarc 100 1 0 0.01\nsample world clarc 200 2 0 0.03";
    world::commit(&graph, "dsr", moved).unwrap();
    // The camera stands above the robot: an error in how that leans moves it too.
    let now = graph.snapshot();
    let up = now.transform(now.node("clarc").unwrap(), now.node("camera").unwrap()).unwrap().translation.z;
    let lever = |variance: f64| variance * (1.0 + up * up);
    assert!((variance(&pose(None)).unwrap() - lever(0.03)).abs() < 1e-12);
    assert!((variance(&pose(Some(150))).unwrap() - lever(0.02)).abs() < 1e-12);
    assert_eq!(variance(&pose(Some(50))), None, "one of the two is not known");
    let (from, to) = (now.node("world").unwrap(), now.node("camera").unwrap());
    assert!(near(&pose(Some(150)).transform, &now.transform_at(from, to, Time(150)).unwrap()));
    assert!(matches!(now.pose_at(from, to, Time(201)), Err(ChainError::Extrapolation { .. })));
    let restored = Graph::restore(graph.vocabulary(), &now.export()).unwrap();
    assert_eq!(restored.snapshot().pose(from, to), now.pose(from, to));
}
