//! Builds of the program that do not depend on the folder of the sources.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use super::target::Target;
use super::tools;
use crate::step::{Failed, cargo, root, run};

/// Build profile.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Profile {
    /// Optimized across crates: for releases
    Dist,
    /// Optimized, as everyone builds it
    Release,
    /// Hardly optimized, built in half the time: for checks of a platform
    Quick,
}

impl Profile {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Dist => "dist",
            Self::Release => "release",
            Self::Quick => "quick",
        }
    }
}

/// Builds the program from the sources in `source`; returns its path.
pub(super) fn build(source: &Path, target: &Target, profile: Profile) -> Result<PathBuf, Failed> {
    let mut command = command(source, target, profile)?;
    run(command.args(["--package", "periplus-cli"]), &help(target))?;
    Ok(program_in(source, target, profile))
}

/// Path and profile of the program that was last built of this tree.
pub(crate) fn last_program(target: &Target) -> Option<(PathBuf, Profile)> {
    let programs = [Profile::Dist, Profile::Release, Profile::Quick]
        .map(|it| (program_in(&root(), target, it), it));
    programs
        .into_iter()
        .filter(|(path, _)| path.is_file())
        .max_by_key(|(path, _)| std::fs::metadata(path).and_then(|it| it.modified()).ok())
}

fn program_in(source: &Path, target: &Target, profile: Profile) -> PathBuf {
    let folder = source.join("target").join(target.triple).join(profile.name());
    folder.join(target.executable("periplus"))
}

/// A build by cargo, without the packages.
pub(crate) fn command(source: &Path, target: &Target, profile: Profile) -> Result<Command, Failed> {
    let mut command = cargo();
    command.current_dir(source);
    // Apple's own linker where it is; zig elsewhere.
    if target.is_apple() && cfg!(target_os = "macos") {
        command.args(["build", "--target", target.triple]);
    } else {
        command.args(["zigbuild", "--target", &target.linker_triple()]);
        command.env("PATH", tools::path()?);
    }
    command.args(["--locked", "--quiet", "--profile", profile.name()]);
    environment(&mut command, source, profile)?;
    Ok(command)
}

/// Sets the variables by which two builds are equal: paths are replaced, and the time is that of the last commit.
pub(super) fn environment(
    command: &mut Command,
    source: &Path,
    profile: Profile,
) -> Result<(), Failed> {
    let replaced = replaced_paths(source)?;
    let flags = |option: &str| -> String {
        let flags = replaced.iter().map(|(from, to)| format!("{option}={from}={to}"));
        flags.collect::<Vec<_>>().join(" ")
    };
    command.env("RUSTFLAGS", flags("--remap-path-prefix"));
    command.env("CFLAGS", flags("-ffile-prefix-map"));
    command.env("SOURCE_DATE_EPOCH", source_date(&root())?.to_string());
    command.env("PERIPLUS_BUILD_PROFILE", profile.name()).env("PERIPLUS_BUILD_COMMIT", commit()?);
    command.env("CARGO_TARGET_DIR", source.join("target")).env("CARGO_INCREMENTAL", "0");
    Ok(())
}

/// Folders that would be in messages of panics and of C code, with the names that they get.
fn replaced_paths(source: &Path) -> Result<Vec<(String, &'static str)>, Failed> {
    let home = std::env::var_os("CARGO_HOME").map(PathBuf::from).or_else(|| {
        let home = std::env::var_os("HOME").or_else(|| std::env::var_os("USERPROFILE"))?;
        Some(Path::new(&home).join(".cargo"))
    });
    let sources = home.map(|home| home.join("registry/src")).filter(|folder| folder.is_dir());
    let sources = sources.ok_or_else(|| {
        Failed("there are no sources of crates: run `cargo fetch --locked` first".to_owned())
    })?;
    let mut replaced = vec![(source.display().to_string(), "/periplus")];
    // One folder per registry, which is the only one that `deny.toml` allows.
    let entries = std::fs::read_dir(&sources)
        .map_err(|error| Failed(format!("cannot read {}: {error}", sources.display())))?;
    let mut folders: Vec<PathBuf> = entries.filter_map(|it| Some(it.ok()?.path())).collect();
    folders.sort();
    replaced.extend(folders.into_iter().map(|it| (it.display().to_string(), "/cargo")));
    if let Some((path, _)) = replaced.iter().find(|(path, _)| path.contains(' ')) {
        return Err(Failed(format!("`{path}` has a space in it, which RUSTFLAGS cannot have")));
    }
    Ok(replaced)
}

/// Time of the last commit, or `SOURCE_DATE_EPOCH` [s since 1970].
pub(super) fn source_date(source: &Path) -> Result<u64, Failed> {
    if let Some(given) = std::env::var_os("SOURCE_DATE_EPOCH") {
        let text = given.to_string_lossy().into_owned();
        return text.parse().map_err(|_| Failed(format!("SOURCE_DATE_EPOCH={text} is no number")));
    }
    let mut command = Command::new("git");
    command.args(["log", "-1", "--format=%ct"]).current_dir(source);
    let output = command.output().map_err(|error| Failed(format!("git: {error}")))?;
    String::from_utf8_lossy(&output.stdout).trim().parse().map_err(|_| {
        Failed("there is no commit to take the time from: set SOURCE_DATE_EPOCH".to_owned())
    })
}

/// Commit of the sources; with `+changes` if the tree differs from it. It is read once, so that a second build names the
/// same one.
fn commit() -> Result<String, Failed> {
    static COMMIT: OnceLock<String> = OnceLock::new();
    if let Some(known) = COMMIT.get() {
        return Ok(known.clone());
    }
    let git = |words: &[&str]| -> Result<String, Failed> {
        let output = Command::new("git").args(words).current_dir(root()).output();
        let output = output.map_err(|error| Failed(format!("git: {error}")))?;
        Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned())
    };
    let changed = git(&["status", "--porcelain", "--untracked-files=no"])?;
    let commit = git(&["rev-parse", "--short=12", "HEAD"])?;
    let commit = if changed.is_empty() { commit } else { commit + "+changes" };
    Ok(COMMIT.get_or_init(|| commit).clone())
}

fn help(target: &Target) -> String {
    format!("see the errors above; `rustup target add {}` adds the target", target.triple)
}
