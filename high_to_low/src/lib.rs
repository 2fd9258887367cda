//! HighToLow: a high-level action refined into intentions on the graph.
