//! Any bytes as a domain.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| pelea_fuzz::domain(bytes));
