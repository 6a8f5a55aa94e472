//! `cargo xtask platforms`: the programs that `cargo xtask dist` built, run on what is like their systems: arm64 by QEMU,
//! Windows by Wine, and musl where there is nothing but the program.

mod page;
mod runner;
mod tests;
mod wine;

use std::fs;
use std::path::{Path, PathBuf};

pub(crate) use runner::Runner;

use crate::dist::{Profile, TARGETS, Target, last_program};
use crate::step::{Failed, build_native, equal_start, root, timed};

/// Wish of the caller.
#[derive(clap::Args)]
pub(crate) struct Options {
    /// Target triple; repeatable. By default all whose program is built
    #[arg(long = "target", value_name = "TRIPLE", value_parser = crate::dist::parse)]
    targets: Vec<&'static Target>,
    /// Program of this machine to compare with, in place of a release build
    #[arg(long, value_name = "FILE")]
    program: Option<PathBuf>,
    /// Also run the unit tests of central libraries, which are compiled for the target first
    #[arg(long)]
    tests: bool,
}

/// Robot of the checks.
const ROBOT: &str = "robots/sam_bot/urdf/sam_bot.urdf.xacro";

/// Runs all checks on each target.
///
/// # Errors
/// When a program behaves differently from that of this machine, or nothing could be run.
pub(crate) fn run(options: &Options) -> Result<(), Failed> {
    let is_chosen = |target: &&Target| match options.targets.as_slice() {
        [] => last_program(target).is_some(),
        chosen => chosen.contains(target),
    };
    let chosen: Vec<&'static Target> = TARGETS.iter().filter(is_chosen).collect();
    let host = match &options.program {
        Some(program) => root().join(program),
        None => build_native()?,
    };
    let host = Runner::Native(host);
    let native = Folder::new("native")?;
    let mut count = 0;
    for target in chosen {
        let Some((program, profile)) = last_program(target) else {
            let triple = target.triple;
            return Err(Failed(format!(
                "no program for {triple}: run `cargo xtask dist --target {triple}` first"
            )));
        };
        match Runner::of(target, program) {
            Err(why) => eprintln!("SKIPPED: {}: {why}", target.triple),
            Ok(runner) => {
                let tests = options.tests.then_some(profile);
                timed(target.triple, || check(target, &runner, (&host, &native), tests))?;
                count += 1;
            }
        }
    }
    if count == 0 {
        return Err(Failed("nothing was run: build programs with `cargo xtask dist`".to_owned()));
    }
    println!("{count} platforms behave like this machine");
    Ok(())
}

/// Programs that run here, with runners that see all files; the others are reported.
pub(crate) fn built() -> Vec<(&'static Target, Runner)> {
    let built = TARGETS.iter().filter_map(|target| Some((target, last_program(target)?.0)));
    let with_runner =
        built.filter_map(|(target, program)| match Runner::of(target, program.clone()) {
            Ok(runner) => Some((target, runner.with_program(program))),
            Err(why) => {
                eprintln!("SKIPPED: {}: {why}", target.triple);
                None
            }
        });
    with_runner.collect()
}

/// A folder of results, in which a program runs.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Result<Self, Failed> {
        let path = root().join("target/platforms").join(name);
        let failed = |error: std::io::Error| Failed(format!("{}: {error}", path.display()));
        if path.exists() {
            fs::remove_dir_all(&path).map_err(failed)?;
        }
        fs::create_dir_all(&path).map_err(failed)?;
        Ok(Self(path))
    }

    fn read(&self, name: &str) -> Result<Vec<u8>, Failed> {
        let path = self.0.join(name);
        fs::read(&path).map_err(|error| Failed(format!("{}: {error}", path.display())))
    }
}

/// A check: its name, the words of the command, and the files that it writes, which must be equal to those of the program
/// of this machine.
struct Check {
    name: &'static str,
    words: &'static [&'static str],
    files: &'static [&'static str],
}

/// Checks, in an order in which later ones read the files of earlier ones.
const CHECKS: [Check; 4] = [
    Check { name: "check", words: &["check", "robot.urdf"], files: &[] },
    Check {
        name: "demo --headless",
        words: &[
            "demo",
            "--headless",
            "--duration",
            "8",
            "--bag-compression",
            "none",
            "--out",
            "demo",
        ],
        files: &["demo/demo.mcap", "demo/map.pgm", "demo/map.yaml"],
    },
    Check {
        name: "sim --record",
        words: &[
            "sim",
            "world.sdf",
            "--robot",
            "robot.urdf",
            "--duration",
            "0.6",
            "--seed",
            "7",
            "--quiet",
            "--record",
            "run.mcap",
        ],
        files: &["run.mcap"],
    },
    Check {
        name: "slam",
        words: &["slam", "demo/demo.mcap", "--out", "map"],
        files: &["map/map.pgm", "map/map.yaml"],
    },
];

fn check(
    target: &Target,
    runner: &Runner,
    (host, native): (&Runner, &Folder),
    tests: Option<Profile>,
) -> Result<(), Failed> {
    let folder = Folder::new(target.triple)?;
    let runner = runner.in_folder(&folder.0)?;
    version(&runner, &folder.0)?;
    identity(target, &runner, &folder.0)?;
    for it in [&folder.0, &native.0] {
        inputs(host, it)?;
    }
    for check in &CHECKS {
        let printed = output(&runner, &folder.0, check.words)?;
        let expected = output(host, &native.0, check.words)?;
        // What is printed besides has times in it.
        if check.files.is_empty() && printed.replace("\r\n", "\n") != expected {
            return Err(Failed(format!(
                "`periplus {}` printed\n{printed}\nand on this machine\n{expected}",
                check.words.join(" ")
            )));
        }
        for name in check.files {
            same(name, &folder.read(name)?, &native.read(name)?)?;
        }
        println!("{}: as on this machine", check.name);
    }
    tree(&runner, host)?;
    page::serve(&runner, &folder.0)?;
    println!("page: served");
    tests.map_or(Ok(()), |profile| tests::run(target, profile, &runner))
}

/// A robot of several files and a world with models, by relative paths. A program that sees no other files has neither.
fn tree(runner: &Runner, host: &Runner) -> Result<(), Failed> {
    if matches!(runner, Runner::Chroot { .. }) {
        return Ok(());
    }
    for file in [ROBOT, "worlds/house.sdf"] {
        let printed = output(runner, &root(), &["check", file])?.replace("\r\n", "\n");
        let expected = output(host, &root(), &["check", file])?;
        if printed != expected {
            return Err(Failed(format!(
                "`periplus check {file}` printed\n{printed}\nand on this machine\n{expected}"
            )));
        }
    }
    println!("check of files that include others: as on this machine");
    Ok(())
}

/// Writes a robot and a world without other files, since an empty folder is all that some programs see.
fn inputs(host: &Runner, folder: &Path) -> Result<(), Failed> {
    let robot = root().join(ROBOT).display().to_string();
    let out = folder.join("robot.urdf").display().to_string();
    output(host, &root(), &["convert", &robot, "--to", "urdf", "-o", &out])?;
    let world = root().join("worlds/closed_room.world");
    fs::copy(&world, folder.join("world.sdf"))
        .map(drop)
        .map_err(|error| Failed(format!("{}: {error}", world.display())))
}

fn version(runner: &Runner, folder: &Path) -> Result<(), Failed> {
    let printed = output(runner, folder, &["--version"])?;
    let expected = format!("periplus {}", crate::dist::version());
    if printed.trim() != expected {
        return Err(Failed(format!("`--version` printed `{printed}` in place of `{expected}`")));
    }
    Ok(())
}

/// The program knows its target, and finds no error on the machine.
fn identity(target: &Target, runner: &Runner, folder: &Path) -> Result<(), Failed> {
    let printed = output(runner, folder, &["doctor", "--self", "--json"])?;
    let report: serde_json::Value = serde_json::from_str(&printed)
        .map_err(|error| Failed(format!("`doctor --self --json` printed `{printed}`: {error}")))?;
    if report["program"]["target"] != target.triple {
        return Err(Failed(format!("the program takes itself for {}", report["program"])));
    }
    println!("doctor --self: {}", report["status"]);
    Ok(())
}

/// Standard output of a command that succeeds.
fn output(runner: &Runner, folder: &Path, words: &[&str]) -> Result<String, Failed> {
    let mut command = runner.command();
    let output = command.args(words).current_dir(folder).output();
    let output = output.map_err(|error| Failed(format!("{}: {error}", runner.name())))?;
    if !output.status.success() {
        return Err(Failed(format!(
            "`periplus {}` failed by {} ({}):\n{}{}",
            words.join(" "),
            runner.name(),
            output.status,
            String::from_utf8_lossy(&output.stdout),
            String::from_utf8_lossy(&output.stderr)
        )));
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

fn same(name: &str, one: &[u8], other: &[u8]) -> Result<(), Failed> {
    if one == other {
        return Ok(());
    }
    let at = equal_start(one, other);
    Err(Failed(format!(
        "{name} differs from that of this machine at byte {at} ({} and {} bytes): a function differs by platform, \
         such as `f64::sin` in place of `libm::sin`",
        one.len(),
        other.len()
    )))
}
