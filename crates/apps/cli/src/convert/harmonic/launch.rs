//! Launch files, with the robots and worlds that they name.

use std::fmt::Write as _;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use periplus_launch::{Dialect, dialect};
use periplus_migration::{BridgeEntry, MigrationEntry, migrate_launch, migrate_python_launch};
use periplus_os::Machine;
use periplus_resources::{Host as _, Resolver, package_of};
use periplus_xml::decode;
use serde_json::{Value, json};

use super::compare::Comparison;
use super::output::{self, BRIDGE, JSON_REPORT, REPORT};
use super::project::{Project, canonical, folders, output_path};
use super::report;
use crate::error::CliError;
use crate::options::ConvertOptions;
use crate::terminal::{self, working_folder};

/// Maximum number of launch files that include each other.
const MAX_LAUNCH_FILES: usize = 64;

/// True for names of launch files.
pub(super) fn is_launch_file(file: &Path) -> bool {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    [".launch", ".launch.py", ".launch.xml", ".launch.yaml"].iter().any(|end| name.ends_with(end))
}

fn is_python(file: &Path) -> bool {
    file.extension().is_some_and(|extension| extension == "py")
}

/// Robot or world that a launch file names.
struct LaunchPart {
    project: Project,
    comparison: Comparison,
}

/// Converted launch files and their parts.
#[derive(Default)]
struct LaunchProject {
    files: Vec<(String, PathBuf)>,
    entries: Vec<MigrationEntry>,
    parts: Vec<LaunchPart>,
    bridge: Vec<BridgeEntry>,
    /// Files that are named but cannot be converted, with the reason.
    missing: Vec<String>,
}

/// Converts a launch file of ROS 1 or a Python one of ROS 2, those that it includes, and their robots and worlds.
pub(super) fn run(
    file: &Path,
    arguments: Vec<(String, String)>,
    folder: &Path,
    options: &ConvertOptions,
) -> Result<ExitCode, CliError> {
    let main = working_folder().join(file);
    if Machine.kind(&main).is_none() {
        let near = crate::paths::advice(file);
        return Err(CliError::failed(format!(
            "{} cannot be read: no such file{near}",
            file.display()
        )));
    }
    if dialect(&Machine, &main) == Dialect::Ros2 && !is_python(&main) {
        return Err(CliError::failed(format!(
            "{} is a launch file of ROS 2 in XML or YAML, which is not converted: replace gazebo.launch.py by \
             gz_sim.launch.py of ros_gz_sim (argument `gz_args`), spawn_entity.py by ros_gz_sim's create (`-entity` is \
             `-name`), and start parameter_bridge with the ros_gz_bridge.yaml that the conversion of the robot writes",
            file.display()
        )));
    }
    let mut project = LaunchProject::default();
    project.convert(&canonical(&main), folder, arguments, options)?;
    let is_unexplained = project.parts.iter().any(|part| part.comparison.is_unexplained());
    let json = project.json(file);
    output::write_file(folder, REPORT, &project.markdown(file))?;
    output::write_file(folder, JSON_REPORT, &format!("{json:#}\n"))?;
    if options.json {
        writeln!(io::stdout().lock(), "{json:#}")?;
    } else {
        for line in report::counts_of(&project.entries) {
            terminal::say(&line);
        }
        for part in &project.parts {
            terminal::say(&format!(
                "{}: {}",
                part.project.file.display(),
                part.comparison.summary()
            ));
        }
        for missing in &project.missing {
            terminal::say(missing);
        }
        let report = folder.join(REPORT);
        terminal::say(&format!(
            "{} launch files; read {} first",
            project.files.len(),
            report.display()
        ));
    }
    Ok(if is_unexplained { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}

impl LaunchProject {
    fn convert(
        &mut self,
        main: &Path,
        folder: &Path,
        arguments: Vec<(String, String)>,
        options: &ConvertOptions,
    ) -> Result<(), CliError> {
        let folders = folders(&options.search);
        let host = Machine;
        let resolver = Resolver::new(&host, &folders);
        let base = main.parent().unwrap_or(main).to_owned();
        let mut waiting = vec![main.to_owned()];
        let mut references: Vec<PathBuf> = Vec::new();
        let mut launches: Vec<PathBuf> = Vec::new();
        while let Some(path) = waiting.pop() {
            if self.files.len() >= MAX_LAUNCH_FILES {
                self.missing.push(format!(
                    "more than {MAX_LAUNCH_FILES} launch files: the rest is left out"
                ));
                break;
            }
            if self.files.iter().any(|(_, known)| *known == path) {
                continue;
            }
            let Ok(bytes) = host.read(&path) else { continue };
            let text = decode(&bytes)
                .map_err(|error| CliError::failed(format!("{}: {error}", path.display())))?;
            let shown = path.display().to_string();
            let migrated = if is_python(&path) {
                migrate_python_launch(&text, &shown)
            } else {
                migrate_launch(&text, &shown)
            };
            let Some(launch) = migrated else {
                if path == main {
                    let what = if is_python(&path) {
                        "starts nothing of Gazebo Classic, so nothing is converted"
                    } else {
                        "is not a launch file in XML"
                    };
                    return Err(CliError::failed(format!("{shown} {what}")));
                }
                continue;
            };
            if is_python(&path) {
                self.missing.push(format!(
                    "the robots and worlds that {shown} names: convert them, too, and put the topics of their \
                     {BRIDGE} into the one beside the launch file"
                ));
            }
            let mut name = output_path(&path, &base);
            if !is_python(&path) {
                let stem = name.file_name().unwrap_or_default().to_string_lossy().into_owned();
                let stem = stem.trim_end_matches(".launch").to_owned();
                name.set_file_name(format!("{stem}.launch.py"));
            }
            output::write_file(folder, &name.display().to_string(), &launch.text)?;
            self.files.push((name.display().to_string(), path.clone()));
            self.entries.extend(launch.entries);
            let beside = path.parent().unwrap_or(&path);
            let mut resolved = |uri: &String| {
                let inside = own_package(&host, &path, uri);
                let found = inside.or_else(|| resolver.resolve(uri, beside).ok());
                if found.is_none() {
                    self.missing.push(format!("{uri} is not found, so it is not converted"));
                }
                found.map(|path| canonical(&path))
            };
            waiting.extend(launch.includes.iter().filter_map(&mut resolved));
            references.extend(launch.references.iter().filter_map(&mut resolved));
            launches.push(name);
        }
        references.sort();
        references.dedup();
        for path in references {
            match Project::read(&path, arguments.clone(), &options.search) {
                Ok(project) => {
                    let comparison = if project.is_current() {
                        Comparison::not_needed()
                    } else if options.no_compare {
                        Comparison::not_run("left out with --no-compare")
                    } else {
                        Comparison::run(&project, &options.search)
                    };
                    output::converted(&project, folder)?;
                    for entry in &project.bridge {
                        if !self.bridge.contains(entry) {
                            self.bridge.push(entry.clone());
                        }
                    }
                    self.entries.extend(project.entries.iter().cloned());
                    self.parts.push(LaunchPart { project, comparison });
                }
                Err(error) => self.missing.push(format!("{}: {}", path.display(), error.message())),
            }
        }
        // The launch files read the topics beside them.
        let mut places: Vec<PathBuf> =
            launches.iter().map(|name| name.with_file_name(BRIDGE)).collect();
        places.sort();
        places.dedup();
        for place in places {
            output::write_file(
                folder,
                &place.display().to_string(),
                &output::bridge(&self.bridge),
            )?;
        }
        Ok(())
    }

    fn json(&self, file: &Path) -> Value {
        let files: Vec<Value> = self
            .files
            .iter()
            .map(|(name, old)| json!({ "path": name, "replaces": old.display().to_string() }))
            .chain(self.parts.iter().flat_map(|part| {
                part.project.files.iter().map(|file| {
                    json!({
                        "path": file.output.display().to_string(),
                        "replaces": file.path.display().to_string(),
                    })
                })
            }))
            .collect();
        let parts: Vec<Value> = self
            .parts
            .iter()
            .map(|part| report::json(&part.project, &[], &part.comparison))
            .collect();
        let is_unexplained = self.parts.iter().any(|part| part.comparison.is_unexplained());
        json!({
            "file": file.display().to_string(),
            "is_current": false,
            "files": files,
            "elements": self.entries,
            "bridge": self.bridge,
            "comparison": Comparison::not_run("each robot and world is compared in `parts`"),
            "parts": parts,
            "missing": self.missing,
            "ok": !is_unexplained,
        })
    }

    fn markdown(&self, file: &Path) -> String {
        let mut text = String::new();
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        let _ = writeln!(text, "# `{name}` for Gazebo Harmonic\n");
        for line in report::counts_of(&self.entries) {
            let _ = writeln!(text, "- {line}");
        }
        text.push_str("\n## Files\n\n");
        for (name, _) in &self.files {
            let _ = writeln!(text, "- `{name}`");
        }
        for file in self.parts.iter().flat_map(|part| &part.project.files) {
            let _ = writeln!(text, "- `{}`", file.output.display());
        }
        text.push_str(
            "\nInstall the launch files and the `ros_gz_bridge.yaml` beside them, and add `ros_gz_sim`, `ros_gz_bridge`, \
             `xacro` and `robot_state_publisher` to `package.xml`. Meshes by `package://` are found by Gazebo if the \
             `share` folder above the package is on GZ_SIM_RESOURCE_PATH.\n\n",
        );
        if !self.missing.is_empty() {
            text.push_str("## Not converted\n\n");
            for missing in &self.missing {
                let _ = writeln!(text, "- {missing}");
            }
            text.push('\n');
        }
        report::elements(&self.entries, &mut text);
        for part in &self.parts {
            let name = part.project.file.file_name().unwrap_or_default().to_string_lossy();
            let _ = writeln!(text, "## `{name}`\n");
            report::comparison(&part.comparison, &mut text);
            text.push('\n');
        }
        text
    }
}

/// A file of the package that contains the launch file, which need not be on the search paths.
fn own_package(host: &Machine, launch: &Path, uri: &str) -> Option<PathBuf> {
    let (package, inside) = uri.strip_prefix("package://")?.split_once('/')?;
    let (own, within) = package_of(host, launch)?;
    if own != package {
        return None;
    }
    let folder = launch.ancestors().nth(Path::new(&within).components().count())?;
    let path = folder.join(inside);
    host.kind(&path).map(|_| path)
}
