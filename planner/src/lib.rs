//! Grounding, heuristics and forward search.
