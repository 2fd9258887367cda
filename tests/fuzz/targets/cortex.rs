//! Any bytes as a world of cortex.
#![no_main]

use dsr::Graph;
use formats::{CortexUnit, CortexWorld, View};

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let Ok(world) = serde_json::from_slice::<CortexWorld>(bytes) else { return };
    let Ok(imported) = world.import(CortexUnit::Millimetres) else { return };
    let export = imported.graph.snapshot().export();
    let restored = Graph::restore(imported.graph.vocabulary(), &export).expect("a state is a state");
    let snapshot = restored.snapshot();
    assert_eq!(snapshot.export(), export);
    let view = View::whole(&snapshot);
    let _ = (formats::lines(&view), formats::graphml(&view));
});
