//! Any bytes as a domain, a problem and a plan, with a line `===` between them.
#![no_main]

#[path = "../../../validator/tests/support/triple.rs"]
mod triple;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| triple::check(bytes));
