//! House rules that a compiler does not check: each module says what it is for, no test is switched
//! off or sleeps, and a file that grew past 700 lines says at its top why.

use crate::failure::Failure;
use std::path::{Path, PathBuf};

const LONGEST: usize = 700;

/// What breaks a rule, a sentence each.
pub(crate) fn check(root: &Path) -> Result<Vec<String>, Failure> {
    let mut findings = Vec::new();
    for path in rust_files(root)? {
        let text = read(&path)?;
        let name = path.strip_prefix(root).unwrap_or(&path).display().to_string();
        findings.extend(findings_in(&text).into_iter().map(|finding| format!("{name}: {finding}")));
    }
    Ok(findings)
}

fn findings_in(text: &str) -> Vec<String> {
    let mut findings = Vec::new();
    if !text.starts_with("//!") {
        findings.push("does not open with `//!`".to_owned());
    }
    let lines = text.lines().count();
    let opening = text.lines().take_while(|line| line.starts_with("//!"));
    if lines > LONGEST && !opening.into_iter().any(|line| line.contains("Length:")) {
        findings.push(format!("{lines} lines, and its opening does not say why (`Length: …`)"));
    }
    for (number, line) in text.lines().enumerate() {
        let code = line.split("//").next().unwrap_or("");
        for banned in [concat!("#[", "ignore"), concat!("thread::", "sleep")] {
            if code.contains(banned) {
                findings.push(format!("line {}: `{banned}`", number + 1));
            }
        }
    }
    findings
}

pub(crate) fn rust_files(root: &Path) -> Result<Vec<PathBuf>, Failure> {
    let mut files = Vec::new();
    let mut folders = vec![root.to_path_buf()];
    while let Some(folder) = folders.pop() {
        let entries =
            std::fs::read_dir(&folder).map_err(|error| Failure::File(folder.display().to_string(), error))?;
        for path in entries.flatten().map(|entry| entry.path()) {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if path.is_dir() && name != "target" && !name.starts_with('.') {
                folders.push(path);
            } else if name.ends_with(".rs") {
                files.push(path);
            }
        }
    }
    files.sort();
    Ok(files)
}

pub(crate) fn read(path: &Path) -> Result<String, Failure> {
    std::fs::read_to_string(path).map_err(|error| Failure::File(path.display().to_string(), error))
}

#[cfg(test)]
mod tests {
    use super::findings_in;

    #[test]
    fn a_documented_module_is_fine() {
        assert!(findings_in("//! What it is.\nfn f() {}\n").is_empty());
    }

    #[test]
    fn what_breaks_a_rule_is_found() {
        let off = concat!("#[", "ignore]\n");
        assert_eq!(findings_in(off).len(), 2);
        let long = "//! What.\n".to_owned() + &"//\n".repeat(700);
        assert_eq!(findings_in(&long).len(), 1);
    }
}
