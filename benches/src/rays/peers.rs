//! Other ray casters.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// A peer that is installed.
pub(super) enum Peer {
    /// A Python package, run by the script of the shared bench.
    Python { engine: &'static str, script: PathBuf, folder: PathBuf },
    /// ODE as Gazebo Classic uses it, or with shapes instead of triangles.
    Ode { engine: &'static str, program: PathBuf, folder: PathBuf },
    /// Embree through its C interface: `benches/oracles/rays_embree.cc`.
    Embree { program: PathBuf, folder: PathBuf },
}

/// Engine, the package that it needs, whether it takes shapes only.
const PYTHON: [(&str, &str); 5] = [
    ("embreex", "embreex"),
    ("open3d", "open3d"),
    ("mujoco", "mujoco"),
    ("mujoco-prim", "mujoco"),
    ("warp", "warp"),
];

impl Peer {
    pub(super) fn name(&self) -> &'static str {
        match self {
            Self::Python { engine, .. } | Self::Ode { engine, .. } => engine,
            Self::Embree { .. } => "embree",
        }
    }

    /// Shapes are there in the tutorial's scene only; for the city ODE and MuJoCo take minutes.
    pub(super) fn takes(&self, scene: &str) -> bool {
        match self.name() {
            name if name.ends_with("-prim") => scene == "tutorial",
            "ode" | "mujoco" => scene != "city",
            _ => true,
        }
    }

    pub(super) fn command(&self, scene: &str) -> Command {
        match self {
            Self::Python { engine, script, folder } => {
                let mut command = python();
                command.arg(script).args(["--engine", engine, "--scene", scene]);
                if *engine == "mujoco" {
                    command.args(["--maxrays", "20000"]);
                }
                command.current_dir(folder);
                command
            }
            Self::Ode { engine, program, folder } => {
                let mut command = Command::new(program);
                command.args([*engine, scene]).current_dir(folder);
                command
            }
            Self::Embree { program, folder } => {
                let mut command = Command::new(program);
                command.args(["scenes", scene, "out"]).current_dir(folder);
                command
            }
        }
    }
}

/// `PERIPLUS_PYTHON`, or the one on the path.
fn python() -> Command {
    Command::new(std::env::var_os("PERIPLUS_PYTHON").unwrap_or_else(|| "python3".into()))
}

fn runs(command: &mut Command) -> bool {
    let quiet = command.stdout(Stdio::null()).stderr(Stdio::null());
    quiet.status().is_ok_and(|status| status.success())
}

/// Makes the scenes once, about 300 MB. Returns false, and prints the reason, if that is not possible.
pub(super) fn make_scenes(engines: &Path, work: &Path) -> bool {
    if work.join("scenes/dynamic.json").exists() {
        return true;
    }
    eprintln!("making the scenes");
    let mut command = python();
    command.arg(engines.join("gen_scenes.py")).arg("scenes").current_dir(work);
    let made = runs(&mut command);
    if !made {
        eprintln!("SKIPPED: scenes are made by Python with numpy; set PERIPLUS_PYTHON");
    }
    made
}

/// Installed peers; prints those that are missing.
pub(super) fn all(engines: &Path, work: &Path) -> Result<Vec<Peer>, String> {
    let mut all = Vec::new();
    for (engine, package) in PYTHON {
        if runs(python().args(["-c", &format!("import {package}")])) {
            let (script, folder) = (engines.join("rays.py"), work.to_owned());
            all.push(Peer::Python { engine, script, folder });
        } else {
            eprintln!("SKIPPED: {engine}; `pip install {package}`, and set PERIPLUS_PYTHON");
        }
    }
    let program = work.join("ode_bullet");
    let mut compile = Command::new("sh");
    compile
        .arg("-c")
        .arg("g++ -O3 -march=native \"$1\" -o \"$2\" $(pkg-config --cflags --libs ode bullet)");
    compile.arg("sh").arg(engines.join("ode_bullet.cpp")).arg(&program);
    if program.exists() || runs(&mut compile) {
        write_primitives(work)?;
        for engine in ["ode", "ode-prim"] {
            all.push(Peer::Ode { engine, program: program.clone(), folder: work.to_owned() });
        }
    } else {
        eprintln!("SKIPPED: ode; `apt install libode-dev libbullet-dev g++ pkg-config`");
    }
    all.extend(embree(work));
    Ok(all)
}

/// Compiles the race against Embree's C interface: with the installation in the folder that
/// `PERIPLUS_EMBREE` names (`include/embree4` and `lib`), else with the system's Embree 4 or 3.
fn embree(work: &Path) -> Option<Peer> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("oracles/rays_embree.cc");
    let program = work.join("rays_embree");
    let prefix = std::env::var_os("PERIPLUS_EMBREE").map(PathBuf::from);
    let compiled = ["embree4", "embree3"].into_iter().any(|library| {
        let mut compile = Command::new("g++");
        compile.args(["-std=c++17", "-O3", "-march=native", "-o"]).arg(&program).arg(&source);
        if let Some(prefix) = &prefix {
            let libraries = prefix.join("lib");
            compile.arg("-I").arg(prefix.join("include")).arg("-L").arg(&libraries);
            for option in ["-Wl,-rpath,", "-Wl,-rpath-link,"] {
                let mut option = std::ffi::OsString::from(option);
                option.push(&libraries);
                compile.arg(option);
            }
        }
        compile.arg(format!("-l{library}"));
        runs(&mut compile)
    });
    if !compiled {
        eprintln!(
            "SKIPPED: Embree's C interface; `apt install libembree-dev g++`, or name an \
             installation of Embree 4 by PERIPLUS_EMBREE"
        );
        return None;
    }
    Some(Peer::Embree { program, folder: work.to_owned() })
}

/// The tutorial's shapes as the program for ODE reads them.
fn write_primitives(work: &Path) -> Result<(), String> {
    let failed = |error: std::io::Error| format!("{}: {error}", work.display());
    let text = std::fs::read_to_string(work.join("scenes/tutorial.json")).map_err(failed)?;
    let scene: serde_json::Value =
        serde_json::from_str(&text).map_err(|error| error.to_string())?;
    let mut lines = String::new();
    for each in scene["primitives"].as_array().map_or(&[][..], Vec::as_slice) {
        let kind = each["type"].as_str().unwrap_or_default();
        let sizes = match kind {
            "box" => [0, 1, 2].map(|axis: usize| each["size"][axis].as_f64().unwrap_or_default()),
            "sphere" | "cylinder" => {
                ["radius", "length", "-"].map(|name| each[name].as_f64().unwrap_or_default())
            }
            _ => continue,
        };
        let middle = [0, 1, 2].map(|axis: usize| each["center"][axis].as_f64().unwrap_or_default());
        let numbers: Vec<String> =
            middle.iter().chain(&sizes).map(|number| number.to_string()).collect();
        lines.push_str(&format!("{kind} {}\n", numbers.join(" ")));
    }
    std::fs::write(work.join("scenes/tutorial.prim"), lines).map_err(failed)
}
