//! Landmarks: facts that every plan makes true at some time.
//!
//! `labels` finds all fact landmarks of the delete relaxation. `graph` adds disjunctive landmarks
//! and orders. `count` estimates states by the landmarks that are still to be achieved.

mod count;
mod graph;
mod labels;

pub(crate) use count::LandmarkCount;
pub(crate) use graph::LandmarkGraph;
