//! Users' own nodes in Python, and the interpreter that runs them.
//!
//! Each node runs in a separate process, `PYTHON -m periplus.ros.run PACKAGE PROGRAM`, in which the module of
//! the package `periplus` provides `rclpy`, `rospy` and the messages. Programs are found in source trees, as
//! `ros2 run` finds them in a workspace that was built.

use std::fmt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{Arc, OnceLock};

use periplus_os::{Machine, Overlay};
use periplus_resources::{EntryKind, Host as _, Resolver};
use periplus_sim::Search;

use crate::bringup::catalogue::{Role, of_program};
use crate::bringup::environment::Environment;

/// Module of the package `periplus` that runs a node.
const RUN_MODULE: &str = "periplus.ros.run";

/// Environment variable with the interpreter of Python nodes.
pub const INTERPRETER_VARIABLE: &str = "PERIPLUS_PYTHON";

/// Environment variable with folders in which the module searches packages first.
const PACKAGES_VARIABLE: &str = "PERIPLUS_PACKAGES";

/// Environment variable that makes the module use an installed ROS.
const REAL_ROS_VARIABLE: &str = "PERIPLUS_REAL_ROS";

/// Interpreters that are tried if none is given.
const INTERPRETERS: [&str; 2] = ["python3", "python"];

/// Folders of a package that may contain programs.
const FOLDERS: [&str; 7] = ["scripts", "nodes", "bin", "src", "script", "node", ""];

/// Files of a package that declare entry points.
const ENTRY_POINT_FILES: [&str; 3] = ["setup.py", "setup.cfg", "pyproject.toml"];

/// Maximum depth of the search for scripts of a package that is built with CMake.
const MAX_SCRIPT_DEPTH: usize = 4;

/// Maximum number of entries of that search.
const MAX_SCRIPT_ENTRIES: usize = 2_000;

/// Number of bytes that are read to recognize a script.
const MAX_SHEBANG_BYTES: usize = 120;

/// Interpreter of Python nodes, searched at the first use.
#[derive(Clone, Debug, Default)]
pub struct PythonInterpreter {
    own: Option<String>,
    found: Arc<OnceLock<Result<String, NoInterpreter>>>,
}

/// Reason why there is no interpreter for Python nodes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoInterpreter {
    /// The given interpreter cannot import the package.
    WithoutPackage(String),
    /// No interpreter on the PATH has the package.
    NotFound,
}

impl fmt::Display for NoInterpreter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::WithoutPackage(given) => write!(
                f,
                "`{INTERPRETER_VARIABLE}` is `{given}`, which cannot import `periplus.ros`; install the package \
                 there: `{given} -m pip install periplus`"
            ),
            Self::NotFound => write!(
                f,
                "nodes in Python need the Python package of Periplus, and no `python3` on the PATH has it: \
                 `pip install periplus`, or set `{INTERPRETER_VARIABLE}` to an interpreter that has it"
            ),
        }
    }
}

impl std::error::Error for NoInterpreter {}

impl PythonInterpreter {
    /// Interpreter `own`, in whose package this program is; otherwise that of `PERIPLUS_PYTHON`, or a
    /// `python3` of the PATH that can import the package.
    #[must_use]
    pub fn new(own: Option<String>) -> Self {
        Self { own, found: Arc::default() }
    }

    /// Path or name of the interpreter.
    ///
    /// # Errors
    /// [`NoInterpreter`] if there is none with the package `periplus`.
    pub fn command(&self) -> Result<&str, &NoInterpreter> {
        let found = self.found.get_or_init(|| match &self.own {
            Some(own) => Ok(own.clone()),
            None => search(Machine.variable(INTERPRETER_VARIABLE)),
        });
        found.as_deref()
    }
}

fn search(given: Option<String>) -> Result<String, NoInterpreter> {
    if let Some(given) = given.filter(|given| !given.is_empty()) {
        return if can_import(&given) {
            Ok(given)
        } else {
            Err(NoInterpreter::WithoutPackage(given))
        };
    }
    let found = INTERPRETERS.into_iter().find(|name| can_import(name));
    found.map(str::to_owned).ok_or(NoInterpreter::NotFound)
}

/// Returns true if an interpreter exists and has the module.
fn can_import(interpreter: &str) -> bool {
    let mut command = Command::new(interpreter);
    command.args(["-c", "import periplus.ros"]);
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.status().is_ok_and(|status| status.success())
}

/// Node in Python.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PythonNode {
    /// Package and program; `None` for a file.
    program: Option<(String, String)>,
    /// Folder of the package, or the file.
    path: PathBuf,
}

impl PythonNode {
    /// Node of a file.
    #[must_use]
    pub fn of_file(path: PathBuf) -> Self {
        Self { program: None, path }
    }

    /// Program of a package in a source tree that is visible from the file or folder `from`; `None` if there
    /// is no such package, or its program is not Python. In a package of Python alone every program is: the module
    /// that runs it evaluates `setup.py`, and names the programs that there are.
    #[must_use]
    pub fn of_package(
        package: &str,
        program: &str,
        search: &Search,
        from: &Path,
        environment: &Environment,
    ) -> Option<Self> {
        let node = Self::in_package(package, program, search, from, environment)?;
        let is_python = has_python_program(&node.path, package, program)
            || (is_python_package(&node.path) && !has_file(&node.path, package, program));
        is_python.then_some(node)
    }

    fn in_package(
        package: &str,
        program: &str,
        search: &Search,
        from: &Path,
        environment: &Environment,
    ) -> Option<Self> {
        let host = Overlay { variables: environment.clone(), ..Overlay::default() };
        let resolver = Resolver::new(&host, &search.folders);
        let path = resolver.find_package(package, from).ok()?;
        // A package of rosbuild has a manifest.xml.
        let mut manifests = ["package.xml", "manifest.xml"].into_iter().map(|name| path.join(name));
        let is_source = manifests.any(|file| Machine.kind(&file) == Some(EntryKind::File))
            && !path.parent().is_some_and(|above| above.ends_with("share"));
        is_source.then(|| Self { program: Some((package.to_owned(), program.to_owned())), path })
    }

    /// Package folder or file.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Command line of the node, without its arguments.
    #[must_use]
    pub fn command(&self, interpreter: &str) -> Vec<String> {
        let mut words = vec![interpreter.to_owned(), "-m".into(), RUN_MODULE.into()];
        match &self.program {
            Some((package, program)) => words.extend([package.clone(), program.clone()]),
            None => words.push(self.path.display().to_string()),
        }
        words
    }

    /// Environment variables of the process: packages of `search` are found, and output is not buffered.
    #[must_use]
    pub fn environment(&self, search: &Search, uses_real_ros: bool) -> Vec<(String, String)> {
        let mut folders: Vec<PathBuf> = Vec::new();
        folders.extend(self.program.is_some().then(|| self.path.clone()));
        folders.extend(search.folders.iter().map(|folder| search.working_folder.join(folder)));
        let given = Machine.variable(PACKAGES_VARIABLE).unwrap_or_default();
        folders.extend(std::env::split_paths(&given).filter(|path| !path.as_os_str().is_empty()));
        let mut variables = vec![("PYTHONUNBUFFERED".to_owned(), "1".to_owned())];
        if let Ok(joined) = std::env::join_paths(folders)
            && !joined.is_empty()
        {
            let joined = joined.to_string_lossy().into_owned();
            variables.push((PACKAGES_VARIABLE.to_owned(), joined));
        }
        if uses_real_ros {
            variables.push((REAL_ROS_VARIABLE.to_owned(), "1".to_owned()));
        }
        variables
    }
}

/// Returns true for programs that a built-in node replaces.
#[must_use]
pub fn is_built_in(package: &str, program: &str) -> bool {
    let entry = of_program(Some(package), program);
    entry.is_some_and(|entry| !matches!(entry.role, Role::Lacking | Role::Needless))
}

/// Returns true if a file is a Python script, by its name or its first line.
#[must_use]
pub fn is_python_file(path: &Path) -> bool {
    if Machine.kind(path) != Some(EntryKind::File) {
        return false;
    }
    let is_named = path.extension().is_some_and(|extension| extension == "py");
    is_named || has_python_shebang(path)
}

fn has_python_shebang(path: &Path) -> bool {
    use std::io::Read as _;
    let Ok(reader) = Machine.reader(path) else { return false };
    let mut start = Vec::new();
    let read = reader.take(MAX_SHEBANG_BYTES as u64).read_to_end(&mut start);
    let line = start.split(|byte| *byte == b'\n').next().unwrap_or_default();
    read.is_ok() && line.starts_with(b"#!") && String::from_utf8_lossy(line).contains("python")
}

/// Returns true if a package in a source tree has this program, and it is Python.
fn has_python_program(folder: &Path, package: &str, program: &str) -> bool {
    let name = program.strip_suffix(".py").unwrap_or(program);
    let declares = |file: &str| {
        let bytes = Machine.read(&folder.join(file)).unwrap_or_default();
        has_word(&String::from_utf8_lossy(&bytes), name)
    };
    if ENTRY_POINT_FILES.iter().any(|file| declares(file)) {
        return true;
    }
    let names = [program.to_owned(), format!("{name}.py"), name.to_owned()];
    let usual = in_usual_folders(folder, package, &names);
    if !usual.is_empty() {
        return usual.iter().any(|path| is_python_file(path));
    }
    // CMake installs scripts of any folder, by names and patterns.
    let mut entries = 0;
    script_below(folder, &names, 0, &mut entries)
}

/// Files of these names in the folders that usually contain programs.
fn in_usual_folders(folder: &Path, package: &str, names: &[String]) -> Vec<PathBuf> {
    let paths = FOLDERS
        .into_iter()
        .chain([package])
        .flat_map(|inside| names.iter().map(move |name| folder.join(inside).join(name)));
    paths.filter(|path| Machine.kind(path) == Some(EntryKind::File)).collect()
}

/// Returns true if one of these folders has a file with the name of the program.
fn has_file(folder: &Path, package: &str, program: &str) -> bool {
    !in_usual_folders(folder, package, &[program.to_owned()]).is_empty()
}

/// Returns true for a package without anything to compile.
fn is_python_package(folder: &Path) -> bool {
    let has = |name: &str| Machine.kind(&folder.join(name)) == Some(EntryKind::File);
    has("setup.py") && !has("CMakeLists.txt")
}

fn script_below(folder: &Path, names: &[String], depth: usize, entries: &mut usize) -> bool {
    const BUILT: [&str; 5] = ["build", "install", "log", "test", "launch"];
    for entry in Machine.list(folder).iter().filter(|entry| !entry.starts_with('.')) {
        *entries += 1;
        if *entries > MAX_SCRIPT_ENTRIES {
            return false;
        }
        let path = folder.join(entry);
        if names.contains(entry) && is_python_file(&path) {
            return true;
        }
        let is_searched = depth < MAX_SCRIPT_DEPTH && !BUILT.contains(&entry.as_str());
        if is_searched
            && Machine.kind(&path) == Some(EntryKind::Folder)
            && script_below(&path, names, depth + 1, entries)
        {
            return true;
        }
    }
    false
}

/// Returns true if a text contains a name that is not part of a longer one.
fn has_word(text: &str, name: &str) -> bool {
    let is_part = |letter: char| letter.is_alphanumeric() || letter == '_' || letter == '-';
    !name.is_empty()
        && text.match_indices(name).any(|(at, _)| {
            !text[..at].ends_with(is_part) && !text[at + name.len()..].starts_with(is_part)
        })
}

/// Node of a command in a launch file: `python3 FILE.py` and `FILE.py` that use ROS.
pub(crate) fn of_command(words: &[String], folder: &Path) -> Option<(PythonNode, usize)> {
    let is_interpreter = |word: &String| {
        let name = word.rsplit('/').next().unwrap_or_default();
        name.strip_prefix("python").is_some_and(|version| {
            version.chars().all(|letter| letter.is_ascii_digit() || letter == '.')
        })
    };
    let at = match words {
        [interpreter, ..] if is_interpreter(interpreter) => 1,
        _ => 0,
    };
    let path = folder.join(words.get(at)?);
    let uses_ros = || {
        let bytes = Machine.read(&path).unwrap_or_default();
        let text = String::from_utf8_lossy(&bytes);
        has_word(&text, "rclpy") || has_word(&text, "rospy")
    };
    let is_node = is_python_file(&path) && uses_ros();
    is_node.then(|| (PythonNode::of_file(path), at + 1))
}

/// Arguments of a node of ROS 1 that set its names, as `roslaunch` gives them.
pub(crate) fn ros1_names(name: Option<&str>, remaps: &[(String, String)]) -> Vec<String> {
    let name = name.map(|name| format!("__name:={name}"));
    name.into_iter().chain(remaps.iter().map(|(from, to)| format!("{from}:={to}"))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_whole_words() {
        let text = "'guard = trail_nodes.guard:main', 'wall_follower=a.b:main'";
        assert!(has_word(text, "guard") && has_word(text, "wall_follower"));
        assert!(!has_word(text, "wall") && !has_word(text, "trail") && !has_word(text, ""));
    }

    #[test]
    fn a_given_interpreter_must_have_the_package() {
        let error = search(Some("periplus-has-no-such-python".into())).unwrap_err();
        assert!(
            error.to_string().contains("periplus-has-no-such-python -m pip install periplus"),
            "{error}"
        );
        let own = PythonInterpreter::new(Some("/wheel/python".into()));
        assert_eq!(own.command(), Ok("/wheel/python"));
    }
}
