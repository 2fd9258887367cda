//! Any bytes as a hierarchical domain and a problem.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| pelea_fuzz::hddl(bytes));
