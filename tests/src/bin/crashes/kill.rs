//! Real processes, real files, `kill -9`.

use pelea_tests::crashes::{Held, folder};
use pelea_tests::root;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::channel;
use std::time::Duration;

type Failure = Box<dyn std::error::Error + Send + Sync>;

/// Kills as many runs at random moments, in turn of the scenarios. How many did not survive.
pub(crate) fn all(
    mission: &Path,
    scenarios: &[String],
    kills: usize,
    seed: u64,
    base: &Path,
) -> Result<usize, Failure> {
    let mut random = seed.wrapping_mul(2).wrapping_add(0x9e37_79b9_7f4a_7c15);
    let (mut failed, mut killed) = (0, 0);
    for number in 0..kills {
        let Some(scenario) = scenarios.get(number % scenarios.len().max(1)) else { break };
        let at = folder(base, "killed");
        let _ = fs::remove_dir_all(&at);
        let process = Process { mission, scenario, at: &at };
        let mut held: Vec<Held> = Vec::new();
        // A run may be killed several times; the last life is left alone.
        for life in 0..3 {
            let mut child = process.start(if life == 0 { "--journal" } else { "--resume" }, "300")?;
            // Nothing is ever sent here: the time that the wait takes is what counts.
            let (_never, silence) = channel::<()>();
            let _ = silence.recv_timeout(Duration::from_millis(20 + next(&mut random) % 1_200));
            let was_alive = child.try_wait()?.is_none();
            // By its own handle: nothing else is ended.
            child.kill()?;
            child.wait()?;
            if let Ok(now) = Held::read(&at) {
                held.push(now);
            } else if life == 0 {
                // Killed before the journal had a state: there is nothing to go on with.
                break;
            }
            killed += usize::from(was_alive);
        }
        if held.is_empty() {
            continue;
        }
        let output = process.command("--resume", "max").arg("--json").output()?;
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        let result: serde_json::Value =
            said.lines().last().map(serde_json::from_str).transpose()?.unwrap_or_default();
        let mut wrong = Vec::new();
        if !matches!(result["ending"].as_str(), Some("accomplished" | "with_human" | "still_calling")) {
            wrong.push(format!("no ending: {}", String::from_utf8_lossy(&output.stderr)));
        }
        wrong.extend(
            result["broken"].as_array().into_iter().flatten().map(|broken| format!("broken: {broken}")),
        );
        for held in &held {
            wrong.extend(held.lost(&at)?);
        }
        if !wrong.is_empty() {
            println!("  {scenario}, killed {} times: {}", held.len(), wrong.join("; "));
            let kept = folder(base, &format!("killed-{number}"));
            let _ = fs::remove_dir_all(&kept);
            fs::rename(&at, kept)?;
            failed += 1;
        }
    }
    println!("{killed} processes of {kills} runs killed, {failed} runs failed");
    Ok(failed)
}

struct Process<'a> {
    mission: &'a Path,
    scenario: &'a str,
    at: &'a PathBuf,
}

impl Process<'_> {
    fn command(&self, option: &str, speed: &str) -> Command {
        let mut command = Command::new(root().join("target/release/pelea"));
        command.arg("run").arg(self.mission).args(["--scenario", self.scenario, "--speed", speed, option]);
        command.arg(self.at);
        command
    }

    fn start(&self, option: &str, speed: &str) -> Result<Child, Failure> {
        let mut command = self.command(option, speed);
        Ok(command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).spawn()?)
    }
}

/// The next number of a sequence that the seed determines (xorshift).
fn next(state: &mut u64) -> u64 {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    *state
}
