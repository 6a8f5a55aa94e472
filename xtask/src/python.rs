//! The Python package: its wheel, built and used as a user gets it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::step::{Failed, build_program, root, run, timed};

/// Folder of environments and wheels.
const FOLDER: &str = "target/python";

/// Programs that build the wheel and test it.
const TOOLS: [&str; 21] = [
    "maturin>=1.9,<2",
    "numpy",
    "pytest",
    "hypothesis",
    "mypy",
    "pandas",
    "polars",
    "matplotlib",
    "nbclient",
    "ipykernel",
    "gymnasium>=1.0",
    "pettingzoo",
    "onnx",
    "onnxruntime",
    "optuna",
    "pyarrow",
    "ray",
    "mcp>=2,<3",
    "jsonschema>=4,<5",
    // Readers of the datasets of `periplus dataset`.
    "pycocotools>=2.0.7,<3",
    "pykitti>=0.3.1",
];

/// Maximum size of the wheel [bytes].
const MAX_WHEEL_BYTES: u64 = 30_000_000;

/// Part of the check.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Part {
    /// Build the wheel and install it
    Build,
    /// mypy and stubtest
    Types,
    /// Tests and the examples in docstrings
    Test,
    /// The numbered examples and the notebooks
    Examples,
    /// The command in the wheel against the native one
    Command,
}

/// One of the checks.
type Check = fn() -> Result<(), Failed>;

/// Page of the documentation that is made from the docstrings.
const REFERENCE: &str = "docs/python-reference.md";

/// Writes the page that is made from the docstrings, and the types of the messages.
pub(crate) fn update() -> Result<(), Failed> {
    timed("wheel", build)?;
    reference(&[])?;
    let mut stubs = Command::new(python("tools")?);
    stubs.arg(root().join("python/tools/make_msgs_stubs.py")).current_dir(root());
    run(&mut stubs, "see the errors above")
}

fn reference(options: &[&str]) -> Result<(), Failed> {
    let mut making = Command::new(python("tools")?);
    making.arg(root().join("python/tools/make_reference.py")).arg(root().join(REFERENCE));
    run(making.args(options), "run `cargo xtask python --update`, and commit the page")
}

/// Checks the package, or one part of it after a build.
pub(crate) fn check(only: Option<Part>) -> Result<(), Failed> {
    let parts: [(Part, &str, Check); 5] = [
        (Part::Build, "wheel", build),
        (Part::Types, "types", types),
        (Part::Test, "tests", test),
        (Part::Examples, "examples and notebooks", examples),
        (Part::Command, "command", command),
    ];
    let chosen = parts.into_iter().filter(|(part, _, _)| only.is_none_or(|it| it == *part));
    chosen.into_iter().try_for_each(|(_, name, check)| timed(name, check))
}

fn folder(name: &str) -> PathBuf {
    root().join(FOLDER).join(name)
}

/// Python with the package; the wheel is built if it has not been.
pub(crate) fn with_package() -> Result<PathBuf, Failed> {
    let python = folder("clean").join("bin/python");
    if !python.exists() {
        timed("wheel", build)?;
    }
    Ok(python)
}

/// Python of an environment with the package and these packages; the wheel is built if it has not been.
pub(crate) fn with_packages(name: &str, packages: &[&str]) -> Result<PathBuf, Failed> {
    if wheel().is_err() {
        timed("wheel", build)?;
    }
    let python = python(name)?;
    pip(&python, packages)?;
    let wheel = wheel()?.display().to_string();
    pip(&python, &["--force-reinstall", "--no-deps", &wheel])?;
    pip(&python, &[&wheel])?;
    Ok(python)
}

/// Python of an environment, which is made if it is missing.
fn python(name: &str) -> Result<PathBuf, Failed> {
    let python = folder(name).join("bin/python");
    if !python.exists() {
        let mut making = Command::new("python3");
        making.args(["-m", "venv"]).arg(folder(name)).current_dir(root());
        run(&mut making, "install Python 3.10 or later with its module `venv`")?;
    }
    Ok(python)
}

fn pip(python: &Path, arguments: &[&str]) -> Result<(), Failed> {
    let mut command = Command::new(python);
    command.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]);
    run(command.args(arguments), "see whether PyPI can be reached")
}

fn build() -> Result<(), Failed> {
    let tools = python("tools")?;
    pip(&tools, &TOOLS)?;
    let wheels = folder("wheels");
    if wheels.exists() {
        fs::remove_dir_all(&wheels).map_err(|error| Failed(error.to_string()))?;
    }
    let mut building = Command::new(&tools);
    building.args(["-m", "maturin", "build", "--release", "--quiet", "--out"]).arg(&wheels);
    building.current_dir(root()).env("CARGO_TARGET_DIR", root().join("target"));
    run(&mut building, "see the errors above")?;
    let wheel = wheel()?;
    let bytes = fs::metadata(&wheel).map_err(|error| Failed(error.to_string()))?.len();
    println!("{}: {:.1} MB", wheel.display(), bytes as f64 * 1e-6);
    if bytes > MAX_WHEEL_BYTES {
        return Err(Failed(format!("the wheel has {bytes} bytes, {MAX_WHEEL_BYTES} are allowed")));
    }
    // Once where the tests find their tools, and once where there is nothing but numpy.
    for environment in ["tools", "clean"] {
        let python = python(environment)?;
        let wheel = wheel.display().to_string();
        pip(&python, &["--force-reinstall", "--no-deps", &wheel])?;
        pip(&python, &[&wheel])?;
    }
    Ok(())
}

fn wheel() -> Result<PathBuf, Failed> {
    let missing = || Failed("no wheel: run `cargo xtask python` first".to_owned());
    let entries = fs::read_dir(folder("wheels")).map_err(|_| missing())?;
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    paths.into_iter().find(|path| path.extension() == Some("whl".as_ref())).ok_or_else(missing)
}

/// A module of Python, which finds the installed package and not the sources.
fn module(words: &[&str]) -> Result<Command, Failed> {
    let mut command = Command::new(python("tools")?);
    command.arg("-m").args(words).current_dir(folder("")).env_remove("PYTHONPATH");
    Ok(command)
}

/// Folders of the modules by their names of ROS, and the search path of each. Those of ROS 1 import some of ROS 2.
const ROS_MODULES: [(&str, &str); 2] = [
    ("python/periplus/ros/ros2", "python:python/periplus/ros/ros2"),
    ("python/periplus/ros/ros1", "python:python/periplus/ros/ros1:python/periplus/ros/ros2"),
];

/// The check of such a folder. Its messages are made when they are imported, so there is no file to find.
fn ros_types() -> Result<Command, Failed> {
    let mut command = Command::new(python("tools")?);
    command.args(["-m", "mypy", "--config-file=", "--strict", "--python-version", "3.10"]);
    command.args(["--explicit-package-bases", "--implicit-reexport"]);
    for code in ["import-not-found", "import-untyped"] {
        command.args(["--disable-error-code", code]);
    }
    command.current_dir(root());
    Ok(command)
}

fn types() -> Result<(), Failed> {
    let help = "correct the types, or the stubs in python/periplus";
    let settings = root().join("pyproject.toml").display().to_string();
    let mut own = Command::new(python("tools")?);
    own.args(["-m", "mypy", "--strict"]).current_dir(root()).env("MYPYPATH", "python");
    run(own.args(["python/periplus", "python/examples"]), help)?;
    for (generation, path) in ROS_MODULES {
        run(ros_types()?.arg(generation).env("MYPYPATH", path), help)?;
    }
    reference(&["--check"])?;
    let allowed = root().join("python/tools/stubtest-allowlist.txt").display().to_string();
    let mut stubs = module(&["mypy.stubtest", "periplus", "--mypy-config-file", &settings])?;
    run(stubs.args(["--allowlist", &allowed]), help)
}

fn test() -> Result<(), Failed> {
    pytest(&["python/tests"])
}

fn examples() -> Result<(), Failed> {
    pytest(&["python/examples", "python/notebooks"])
}

fn pytest(folders: &[&str]) -> Result<(), Failed> {
    let words = ["pytest", "-q", "-p", "no:cacheprovider", "--import-mode=importlib"];
    let mut command = module(&words)?;
    command.args(folders.iter().map(|folder| root().join(folder)));
    // Real ROS 2, for the tests of both.
    let peer = root().join("target/peers/ros2/bin/python");
    if peer.exists() {
        command.env("PERIPLUS_REAL_RCLPY", peer);
    }
    run(&mut command, "see the failures above")
}

/// The demo by the wheel writes the same bytes as by the native program.
fn command() -> Result<(), Failed> {
    let native = root().join("target/release/periplus");
    build_program()?;
    let mut outputs = Vec::new();
    for (name, mut command) in [
        ("native", Command::new(native)),
        ("wheel", Command::new(folder("clean").join("bin/periplus"))),
    ] {
        let out = folder(&format!("demo-{name}"));
        if out.exists() {
            fs::remove_dir_all(&out).map_err(|error| Failed(error.to_string()))?;
        }
        command.args(["demo", "--headless", "--duration", "20", "--out"]).arg(&out);
        run(&mut command, "see the errors above")?;
        outputs.push(out);
    }
    let names = |folder: &Path| -> Result<Vec<String>, Failed> {
        let entries = fs::read_dir(folder).map_err(|error| Failed(error.to_string()))?;
        let names = entries.filter_map(|it| it.ok()?.file_name().into_string().ok());
        let mut names: Vec<String> = names.collect();
        names.sort();
        Ok(names)
    };
    let (native, wheel) = (names(&outputs[0])?, names(&outputs[1])?);
    if native != wheel || native.is_empty() {
        return Err(Failed(format!("native wrote {native:?}, the wheel {wheel:?}")));
    }
    for name in native.iter().filter(|name| !TIMED.contains(&name.as_str())) {
        let [one, other] = [&outputs[0], &outputs[1]].map(|folder| fs::read(folder.join(name)));
        if one.ok() != other.ok() {
            return Err(Failed(format!("{name} differs between the native program and the wheel")));
        }
        println!("{name}: equal");
    }
    Ok(())
}

/// Results that hold wall times.
const TIMED: [&str; 1] = ["report.json"];
