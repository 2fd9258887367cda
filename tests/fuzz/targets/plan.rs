//! Any bytes as a plan.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| pelea_fuzz::plan(bytes));
