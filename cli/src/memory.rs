//! The memory limit of a task and its search.
//!
//! A process that exceeds its address space aborts without an answer. The search therefore gets a
//! budget well below the memory that the process may have: 4 GiB, or a part of a smaller limit
//! (`ulimit -v`) or of a smaller machine. A limit that cannot be read (on systems other than Linux)
//! is ignored.

use std::fs;

const GIBIBYTE: u64 = 1 << 30;
const MOST: u64 = 4 * GIBIBYTE;

/// The bytes for the grounded task, states and open lists.
pub(crate) fn budget() -> usize {
    let limits = fs::read_to_string("/proc/self/limits").unwrap_or_default();
    let machine = fs::read_to_string("/proc/meminfo").unwrap_or_default();
    usize::try_from(share(&limits, &machine)).unwrap_or(usize::MAX)
}

/// Texts, models, stacks and code need the rest.
fn share(limits: &str, machine: &str) -> u64 {
    let address_space = limits
        .lines()
        .find_map(|line| line.strip_prefix("Max address space"))
        .and_then(|rest| rest.split_whitespace().next()?.parse::<u64>().ok())
        .map(|bytes| bytes / 5 * 3);
    let available = machine
        .lines()
        .find_map(|line| line.strip_prefix("MemAvailable:"))
        .and_then(|rest| rest.split_whitespace().next()?.parse::<u64>().ok())
        .map(|kibibytes| kibibytes.saturating_mul(1024) / 5 * 4);
    [address_space, available].into_iter().flatten().fold(MOST, u64::min)
}

#[cfg(test)]
mod tests {
    use super::{GIBIBYTE, MOST, share};

    #[test]
    fn the_smallest_limit_counts() {
        let unlimited = "Max address space         unlimited            unlimited            bytes";
        let six = "Max address space         6442450944           6442450944           bytes";
        let two = "Max address space         2147483648           2147483648           bytes";
        let plenty = "MemTotal:       16000000 kB\nMemAvailable:   15000000 kB";
        let little = "MemTotal:       16000000 kB\nMemAvailable:   1048576 kB";
        assert_eq!(share(unlimited, plenty), MOST);
        assert!(share(six, plenty) < 4 * GIBIBYTE);
        assert!(share(two, plenty) < 2 * GIBIBYTE);
        assert!(share(unlimited, little) < GIBIBYTE);
        assert_eq!(share("", ""), MOST);
    }
}
