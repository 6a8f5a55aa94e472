//! Runners of programs of other systems.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::wine;
use crate::dist::Target;
use crate::step::{Failed, root};

/// A program, and what runs it.
#[derive(Clone, Debug)]
pub(crate) enum Runner {
    /// As it is.
    Native(PathBuf),
    /// In a folder that holds nothing else: `chroot`.
    Chroot { program: PathBuf, folder: PathBuf },
    /// By QEMU, with the libraries of the system in a folder.
    Qemu { program: PathBuf, libraries: Option<PathBuf> },
    /// By Wine, with its state in a folder of the build.
    Wine { program: PathBuf, prefix: PathBuf },
}

/// Libraries of arm64 where Debian's package `libc6-arm64-cross` puts them.
const ARM_LIBRARIES: &str = "/usr/aarch64-linux-gnu";

impl Runner {
    /// Runner of the program of a target on this machine.
    ///
    /// # Errors
    /// When something is missing, with what to do.
    pub(crate) fn of(target: &Target, program: PathBuf) -> Result<Self, String> {
        if target.is_apple() && !target.is_native() {
            return Err("programs of macOS run on macOS only".to_owned());
        }
        if target.is_windows() {
            needs("wine", "apt-get install --no-install-recommends wine wine64")?;
            let prefix = root().join("target/platforms/wine");
            wine::prepare(&prefix).map_err(|Failed(why)| why)?;
            return Ok(Self::Wine { program, prefix });
        }
        if target.triple.starts_with("aarch64") && !target.is_native() {
            needs("qemu-aarch64", "apt-get install --no-install-recommends qemu-user")?;
            if target.triple.ends_with("-musl") {
                return Ok(Self::Qemu { program, libraries: None });
            }
            let libraries = PathBuf::from(ARM_LIBRARIES);
            if !libraries.is_dir() {
                let install = "apt-get install libc6-arm64-cross";
                return Err(format!("there is no {ARM_LIBRARIES}: `{install}`"));
            }
            return Ok(Self::Qemu { program, libraries: Some(libraries) });
        }
        if !target.is_native() {
            return Err(format!("{} runs no program of this target", std::env::consts::ARCH));
        }
        if target.triple.ends_with("-musl") {
            let probe = chroot(Path::new("/")).arg("/bin/true").status();
            if !probe.is_ok_and(|status| status.success()) {
                return Err("`unshare --map-root-user chroot` is not allowed here".to_owned());
            }
            return Ok(Self::Chroot { program, folder: PathBuf::new() });
        }
        Ok(Self::Native(program))
    }

    /// The runner for a folder in which the program works; to be empty, it must be new.
    pub(super) fn in_folder(&self, folder: &Path) -> Result<Self, Failed> {
        match self {
            Self::Chroot { program, .. } => {
                let copy = folder.join("periplus");
                std::fs::copy(program, &copy)
                    .map_err(|error| Failed(format!("{}: {error}", copy.display())))?;
                Ok(Self::Chroot { program: program.clone(), folder: folder.to_path_buf() })
            }
            other => Ok(other.clone()),
        }
    }

    /// The command, to which arguments are added.
    pub(crate) fn command(&self) -> Command {
        match self {
            Self::Native(program) => Command::new(program),
            Self::Chroot { folder, .. } => {
                let mut command = chroot(folder);
                // Nothing of the environment either.
                command.arg("/periplus").env_clear().env("PATH", "/usr/sbin:/usr/bin:/sbin:/bin");
                command
            }
            Self::Qemu { program, libraries } => {
                let mut command = Command::new("qemu-aarch64");
                if let Some(libraries) = libraries {
                    command.arg("-L").arg(libraries);
                }
                command.arg(program);
                command
            }
            Self::Wine { program, prefix } => {
                let mut command = wine::command(prefix);
                command.arg(program);
                command
            }
        }
    }

    /// The same runner for another program, which sees all files.
    pub(super) fn with_program(&self, other: PathBuf) -> Self {
        match self {
            Self::Native(_) | Self::Chroot { .. } => Self::Native(other),
            Self::Qemu { libraries, .. } => {
                Self::Qemu { program: other, libraries: libraries.clone() }
            }
            Self::Wine { prefix, .. } => Self::Wine { program: other, prefix: prefix.clone() },
        }
    }

    pub(crate) fn name(&self) -> &'static str {
        match self {
            Self::Native(_) => "this machine",
            Self::Chroot { .. } => "chroot",
            Self::Qemu { .. } => "qemu-aarch64",
            Self::Wine { .. } => "wine",
        }
    }
}

/// Changes the root folder; without being root in a new namespace.
fn chroot(folder: &Path) -> Command {
    let mut command = Command::new("unshare");
    command.args(["--map-root-user", "chroot"]).arg(folder);
    command
}

fn needs(name: &str, install: &str) -> Result<(), String> {
    match Command::new(name).arg("--version").env("WINEDEBUG", "-all").output() {
        Ok(output) if output.status.success() => Ok(()),
        _ => Err(format!("there is no `{name}`: `{install}`")),
    }
}
