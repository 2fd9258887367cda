//! Any bytes as a world of cortex.
#![no_main]

use dsr::{CortexUnit, CortexWorld, Graph};

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let Ok(world) = serde_json::from_slice::<CortexWorld>(bytes) else { return };
    let Ok(imported) = world.import(CortexUnit::Millimetres) else { return };
    let export = imported.graph.snapshot().export();
    let restored = Graph::restore(imported.graph.vocabulary(), &export).expect("a state is a state");
    assert_eq!(restored.snapshot().export(), export);
});
