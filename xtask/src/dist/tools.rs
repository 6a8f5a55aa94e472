//! Tools of a release that come from PyPI, in a separate environment.

use std::path::PathBuf;
use std::process::Command;

use crate::step::{Failed, root, run};

/// zig is the C compiler and linker of every target; pinned, since its version is part of the bytes of a program.
const PACKAGES: [&str; 3] = ["ziglang==0.17.1", "cargo-zigbuild==0.24.1", "maturin==1.16.0"];

/// Folder of the environment.
fn folder() -> PathBuf {
    root().join("target/distribution/tools")
}

/// Folder of the programs, which is created and filled if it is missing.
///
/// # Errors
/// When Python is missing or PyPI cannot be reached.
pub(super) fn programs() -> Result<PathBuf, Failed> {
    let programs = folder().join(if cfg!(windows) { "Scripts" } else { "bin" });
    let python = programs.join("python");
    if !python.exists() {
        let mut making = Command::new("python3");
        making.args(["-m", "venv"]).arg(folder());
        run(&mut making, "install Python 3.10 or later with its module `venv`")?;
    }
    // Read without the network, which a later run may not have.
    let noted = folder().join("installed");
    if std::fs::read_to_string(&noted).is_ok_and(|text| text == PACKAGES.join("\n")) {
        return Ok(programs);
    }
    let mut installing = Command::new(&python);
    installing.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]);
    run(installing.args(PACKAGES), "see whether PyPI can be reached")?;
    super::write(&noted, PACKAGES.join("\n").as_bytes())?;
    Ok(programs)
}

/// The search path with the programs of the environment first.
pub(super) fn path() -> Result<std::ffi::OsString, Failed> {
    let old = std::env::var_os("PATH").unwrap_or_default();
    let all = std::iter::once(programs()?).chain(std::env::split_paths(&old));
    std::env::join_paths(all).map_err(|error| Failed(format!("PATH: {error}")))
}

/// zig as a C compiler and linker.
pub(crate) fn zig() -> Result<Command, Failed> {
    let mut command = Command::new(programs()?.join("python"));
    command.args(["-m", "ziglang"]);
    Ok(command)
}
