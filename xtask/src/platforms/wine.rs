//! The folder in which Wine keeps its state, made for the programs of a release.

use std::path::Path;
use std::process::Command;

use crate::dist;
use crate::step::{Failed, root, run};

/// The library in Wine's folders, for versions from 9 on.
const LIBRARY: &str = "bcryptprimitives.dll";

/// Makes the folder, as Windows 10, with the library that versions of Wine before 9 lack.
pub(super) fn prepare(prefix: &Path) -> Result<(), Failed> {
    let library = prefix.join("drive_c/windows/system32").join(LIBRARY);
    if library.is_file() {
        return Ok(());
    }
    let parent = prefix.parent().unwrap_or(prefix);
    std::fs::create_dir_all(parent)
        .map_err(|error| Failed(format!("cannot create {}: {error}", parent.display())))?;
    // Also makes the folder.
    run(command(prefix).args(["winecfg", "-v", "win10"]), "see the messages of Wine above")?;
    if library.is_file() {
        return Ok(());
    }
    let mut compiling = dist::zig()?;
    compiling.args(["cc", "-target", "x86_64-windows-gnu", "-shared", "-O2", "-s", "-o"]);
    compiling.arg(&library).arg(root().join("xtask/src/platforms/bcryptprimitives.c"));
    run(compiling.arg("-ladvapi32"), "see the errors above")
}

/// Wine with its state in a folder, without its messages and without programs that need a window.
pub(super) fn command(prefix: &Path) -> Command {
    let mut command = Command::new("wine");
    command.env("WINEPREFIX", prefix).env("WINEDEBUG", "-all");
    command.env("WINEDLLOVERRIDES", "mscoree,mshtml=");
    command
}
