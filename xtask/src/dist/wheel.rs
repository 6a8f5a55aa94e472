//! Wheels for CPython 3.10 and later, one for each platform.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::build::{self, Profile};
use super::target::Target;
use super::tools;
use super::{make_folder, version};
use crate::step::{Failed, root, run};

/// Versions of CPython that the wheel is tried in, where they are installed.
const MINORS: std::ops::RangeInclusive<u32> = 10..=14;

/// Use of the installed package: a simulation, its scan, and the command.
const USE: &str = "xtask/src/dist/use_wheel.py";

/// Builds the wheel for a target into `out`.
pub(super) fn build(target: &Target, out: &Path, profile: Profile) -> Result<(), Failed> {
    let python = tools::programs()?.join("python");
    let mut command = Command::new(python);
    command.args(["-m", "maturin", "build", "--profile", profile.name(), "--locked", "--quiet"]);
    command.args(["--target", target.triple, "--zig", "--compatibility", target.wheel_tag()]);
    command.arg("--out").arg(out).current_dir(root());
    build::environment(&mut command, &root(), profile)?;
    command.env("PATH", tools::path()?);
    run(&mut command, "see the errors above")?;
    let wheel = path(target, out)?;
    let bytes = std::fs::metadata(&wheel).map(|it| it.len()).unwrap_or_default();
    println!("{}: {:.1} MB", wheel.display(), bytes as f64 * 1e-6);
    Ok(())
}

/// Path of the wheel for a target.
fn path(target: &Target, out: &Path) -> Result<PathBuf, Failed> {
    let arch = target.triple.split('-').next().unwrap_or_default();
    let name = format!("periplus-{}-cp310-abi3-{}_{arch}.whl", version(), target.wheel_tag());
    let path = out.join(name);
    if path.is_file() {
        Ok(path)
    } else {
        Err(Failed(format!("there is no {}: run `cargo xtask dist --wheels`", path.display())))
    }
}

/// Installs the wheel for this machine into a new environment of every CPython that is found, and uses it.
///
/// # Errors
/// When there is no wheel or no CPython, or a use fails.
pub(crate) fn check_in_clean_environments(out: &Path) -> Result<(), Failed> {
    let native = super::TARGETS.iter().find(|it| it.is_native() && it.has_wheel());
    let native = native.ok_or_else(|| Failed("there are no wheels for this system".to_owned()))?;
    let wheel = path(native, out)?;
    let mut count = 0;
    for minor in MINORS {
        let Some(python) = interpreter(minor) else {
            eprintln!("SKIPPED: CPython 3.{minor} is not installed");
            continue;
        };
        let folder = root().join(format!("target/distribution/clean-3.{minor}"));
        if folder.exists() {
            std::fs::remove_dir_all(&folder)
                .map_err(|error| Failed(format!("cannot remove {}: {error}", folder.display())))?;
        }
        run(Command::new(&python).args(["-m", "venv"]).arg(&folder), "see above")?;
        let clean = folder.join("bin/python");
        let mut install = Command::new(&clean);
        install.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]);
        run(install.arg(&wheel), "see whether PyPI can be reached")?;
        // Not from the tree, whose folder `python` would be found in place of the package.
        let elsewhere = folder.join("use");
        make_folder(&elsewhere)?;
        let mut using = Command::new(&clean);
        using.arg(root().join(USE)).arg(root()).current_dir(&elsewhere).env_remove("PYTHONPATH");
        run(&mut using, "see the failure above")?;
        println!("CPython 3.{minor}: installed and used");
        count += 1;
    }
    if count == 0 {
        return Err(Failed("no CPython from 3.10 on was found".to_owned()));
    }
    Ok(())
}

/// CPython of a minor version: on the search path, or among those of pyenv.
fn interpreter(minor: u32) -> Option<PathBuf> {
    let runs = |path: &Path| {
        let output = Command::new(path).arg("--version").output();
        output.is_ok_and(|output| {
            let text = String::from_utf8_lossy(&output.stdout).into_owned();
            output.status.success() && text.starts_with(&format!("Python 3.{minor}."))
        })
    };
    let named = PathBuf::from(format!("python3.{minor}"));
    if runs(&named) {
        return Some(named);
    }
    let home = std::env::var_os("PYENV_ROOT")
        .map(PathBuf::from)
        .or_else(|| Some(PathBuf::from(std::env::var_os("HOME")?).join(".pyenv")))?;
    let entries = std::fs::read_dir(home.join("versions")).ok()?;
    let mut found: Vec<PathBuf> =
        entries.filter_map(|it| Some(it.ok()?.path().join("bin/python"))).collect();
    found.sort();
    found.into_iter().find(|path| runs(path))
}
