//! The graph in the formats of other tools.
//!
//! A [`View`] is a snapshot or a part of it; [`lines`], [`dot`], [`graphml`] and [`svg`] write it as text.
//! [`write_mcap`] writes a whole recording for Foxglove and other tools that read MCAP. A [`CortexWorld`] is a JSON
//! file of RoboComp's cortex that becomes a graph. Each function depends only on its arguments: the same state gives
//! the same bytes, and no other program (such as graphviz) is needed.
//!
//! ```
//! use dsr::{AgentId, Graph, Nature, Time, VocabularyBuilder};
//! use formats::View;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let mut builder = VocabularyBuilder::new();
//! let place = builder.node_type("place", None, Nature::Symbolic)?;
//! let leads = builder.label("leads_to", place, place)?;
//! let graph = Graph::new(builder.build());
//! graph.edit(AgentId::DSR, Time(0), |tx| {
//!     tx.add_node("hall", place).add_node("ward", place).add_edge("hall", leads, "ward");
//! })?;
//! let snapshot = graph.snapshot();
//! let hall = snapshot.node("hall").expect("just added");
//! let view = View::around(&snapshot, hall, 1);
//! assert_eq!(formats::lines(&view), ["hall (place)", "  hall leads to ward", "ward (place)"]);
//! assert!(formats::svg(&view).contains("leads_to"));
//! # Ok(())
//! # }
//! ```
//!
//! Map, from the ground up: `xml` (escapes), `view` → `lines`, `dot`, `graphml`, `svg` (with `svg::layers`, the layout)
//! · `commit` (a commit as a record), `foxglove` (its schemas) → `mcap` · `cortex`.

mod commit;
mod cortex;
mod dot;
mod foxglove;
mod graphml;
mod lines;
mod mcap;
mod svg;
mod view;
mod xml;

pub use commit::{CommitRecord, seconds};
pub use cortex::{CortexError, CortexUnit, CortexWorld, Imported};
pub use dot::dot;
pub use graphml::graphml;
pub use lines::lines;
pub use mcap::{McapWriteError, write_mcap};
pub use svg::svg;
pub use view::View;
