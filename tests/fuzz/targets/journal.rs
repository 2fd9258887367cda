//! Any bytes as a journal, a frame of one with a right checksum, or a story of commits and of what spoilt their journal.
#![no_main]

#[path = "../../../dsr/tests/support/story.rs"]
mod story;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| story::check(bytes));
