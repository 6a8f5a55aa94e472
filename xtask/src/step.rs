//! Running other programs, and printing their run time.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use serde_json::Value;

/// Reason why a task failed.
#[derive(Debug)]
pub(crate) struct Failed(pub(crate) String);

/// The root of the source tree.
pub(crate) fn root() -> PathBuf {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    own.parent().unwrap_or(own).to_path_buf()
}

/// The cargo that runs this, at the root of the tree.
pub(crate) fn cargo() -> Command {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.current_dir(root());
    command
}

/// The packages of the workspace and its folders, as `cargo metadata` prints them.
///
/// # Errors
/// When cargo cannot read the workspace.
pub(crate) fn metadata() -> Result<Value, Failed> {
    let failed = |why: String| Failed(format!("cargo metadata failed: {why}"));
    let mut command = cargo();
    command.args(["metadata", "--no-deps", "--format-version", "1"]);
    let output = command.output().map_err(|error| failed(error.to_string()))?;
    if !output.status.success() {
        return Err(failed(String::from_utf8_lossy(&output.stderr).into_owned()));
    }
    serde_json::from_slice(&output.stdout).map_err(|error| failed(error.to_string()))
}

/// Most resident memory of a process so far \[kB\], from the text of its `/proc/PID/status`; none once it has gone.
pub(crate) fn peak_memory_kb(status: &str) -> Option<u64> {
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix(" kB")?.trim().parse().ok()
}

/// Runs a program to its end.
///
/// # Errors
/// When it cannot be started or fails, with what to do.
pub(crate) fn run(command: &mut Command, help: &str) -> Result<(), Failed> {
    let shown = shown(command);
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(_) => Err(Failed(format!("`{shown}` failed: {help}"))),
        Err(error) => Err(Failed(format!("`{shown}` cannot be started ({error}): {help}"))),
    }
}

/// Builds the release program. The native module of Python is built with it, so that libraries get the same
/// features as for the wheel and are compiled once for both.
///
/// # Errors
/// When it cannot be built.
pub(crate) fn build_program() -> Result<(), Failed> {
    let packages = ["-p", "periplus-cli", "-p", "periplus-python"];
    run(cargo().args(["build", "--quiet", "--release"]).args(packages), "see the errors above")
}

/// Builds the release program alone, as everyone does; returns its path.
///
/// # Errors
/// When it cannot be built.
pub(crate) fn build_native() -> Result<PathBuf, Failed> {
    run(cargo().args(["build", "--quiet", "--release", "--package", "periplus-cli"]), "see above")?;
    Ok(root().join("target/release").join(format!("periplus{}", std::env::consts::EXE_SUFFIX)))
}

/// Copies the files of a folder that are wanted, without their permissions.
///
/// # Errors
/// When a file cannot be read or written.
pub(crate) fn copy_folder(
    from: &Path,
    to: &Path,
    is_wanted: impl Fn(&Path) -> bool + Copy,
) -> std::io::Result<()> {
    std::fs::create_dir_all(to)?;
    for entry in std::fs::read_dir(from)? {
        let entry = entry?;
        let (path, target) = (entry.path(), to.join(entry.file_name()));
        if path.is_dir() {
            copy_folder(&path, &target, is_wanted)?;
        } else if is_wanted(&path) {
            std::fs::write(&target, std::fs::read(&path)?)?;
        }
    }
    Ok(())
}

/// Number of bytes with which two files begin alike.
pub(crate) fn equal_start(one: &[u8], other: &[u8]) -> usize {
    one.iter().zip(other).take_while(|(a, b)| a == b).count()
}

/// The command as one would type it.
fn shown(command: &Command) -> String {
    let program = Path::new(command.get_program()).file_name().unwrap_or_default();
    let words = std::iter::once(program).chain(command.get_args());
    words.map(|word| word.to_string_lossy()).collect::<Vec<_>>().join(" ")
}

/// Runs a step of a longer task, with a line before and after.
///
/// # Errors
/// Those of the step.
pub(crate) fn timed(name: &str, step: impl FnOnce() -> Result<(), Failed>) -> Result<(), Failed> {
    println!("== {name}");
    let start = Instant::now();
    let outcome = step();
    let verdict = if outcome.is_ok() { "ok" } else { "FAILED" };
    println!("== {name}: {verdict}, {:.1} s", start.elapsed().as_secs_f64());
    outcome
}
