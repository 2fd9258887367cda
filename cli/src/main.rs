//! The binary `pelea`.

fn main() {}
