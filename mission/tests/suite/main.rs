//! The public interface: the missions of this repository, a small one of its own, and invalid input.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod cases;
mod disk;
mod domains;
mod report;
mod tea;
mod words;
