//! Loading of a path to a scene.

use std::path::{Path, PathBuf};

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin, SourceMap, closest};
use periplus_resources::{EntryKind, FileReadError, nearest};
use periplus_scene::Scene;
use periplus_urdf::UrdfRobot;
use periplus_xml::Document;

use crate::detect::{FileFormat, language, promised};
use crate::documents::{model_of, read_xml};
use crate::example_worlds::{self, Example};
use crate::includes::Files;
use crate::mesh_files::{self, MeshSummary};
use crate::other_files;
use crate::setting::{LoadContext, shown};

/// Result of loading a file.
#[derive(Clone, Debug)]
pub struct LoadedFile {
    /// Path of the file.
    pub path: PathBuf,
    /// Format of the file.
    pub language: FileFormat,
    /// Source texts.
    pub sources: SourceMap,
    /// Findings about them.
    pub diagnostics: Diagnostics,
    /// XML document with xacro expanded. `None` if the file is not XML or cannot be expanded.
    pub document: Option<Document>,
    /// True if the document is completely expanded: no error occurred before it was interpreted.
    pub is_expanded: bool,
    /// Robot, for a URDF.
    pub robot: Option<UrdfRobot>,
    /// Scene. `None` for files that describe none.
    pub scene: Option<Scene>,
    /// Content of a mesh file.
    pub mesh: Option<MeshSummary>,
    /// Content of other files, one line each.
    pub contents: Vec<String>,
    /// Other files that were read, in order.
    pub files: Vec<PathBuf>,
    /// Arguments that the file declares or reads; empty if it is not xacro.
    pub known_arguments: Vec<String>,
}

impl LoadedFile {
    /// Names among these arguments that are unknown to the file; empty for a file that could not be
    /// expanded.
    #[must_use]
    pub fn unknown_arguments<'a>(&self, given: &'a [(String, String)]) -> Vec<&'a str> {
        if self.document.is_none() {
            return Vec::new();
        }
        let names = given.iter().map(|(name, _)| name.as_str());
        names.filter(|name| !self.known_arguments.iter().any(|known| known == name)).collect()
    }

    /// Warns about an argument that has no effect on the file.
    pub fn warn_of_argument(&mut self, name: &str) {
        let file = self.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let warning = Diagnostic::warning(
            "unknown-argument",
            format!("`{file}` has no argument `{name}`: `{name}:=...` has no effect"),
        );
        let known = self.known_arguments.iter().map(String::as_str);
        let warning = match closest(name, known) {
            Some(near) => warning.help(format!("did you mean `{near}`?")),
            None if self.language != FileFormat::Xacro => {
                warning.help("only xacro files take arguments")
            }
            None if self.known_arguments.is_empty() => {
                warning.help("declare it: <xacro:arg name=\"...\" default=\"...\"/>")
            }
            None => warning.help(format!("it has {}", self.known_arguments.join(", "))),
        };
        self.diagnostics.push(warning);
    }
}

/// Loads a file of any supported format.
#[must_use]
pub fn load(path: &Path, setting: &LoadContext<'_>) -> LoadedFile {
    let written = path;
    let path = setting.working_folder.join(path);
    if setting.host.kind(&path) == Some(EntryKind::Folder) {
        return load_folder(path, setting);
    }
    // Large files, recognised by name only.
    if let Some(FileFormat::Recording | FileFormat::Archive) = other_files::recognise(&path, &[])
        && setting.host.kind(&path).is_some()
    {
        return load_bytes(&path, &[], setting);
    }
    match setting.host.read(&path) {
        Ok(bytes) => load_bytes(&path, &bytes, setting),
        Err(FileReadError::Missing) if let Some(found) = on_resource_path(written, setting) => {
            load(&found, setting)
        }
        Err(FileReadError::Missing)
            if let Some(Example::BuiltIn(text)) = example_worlds::find(written) =>
        {
            let mut loaded = load_bytes(&path, text.as_bytes(), setting);
            let name = written.display();
            loaded.diagnostics.push(
                Diagnostic::hint(
                    "example-world",
                    format!("`{name}` is the built-in world of that name"),
                )
                .note(
                    "it has the models, sensors and topics of Gazebo's example, with simple shapes",
                ),
            );
            loaded
        }
        Err(error) => {
            let found = example_worlds::find(written).filter(|_| error == FileReadError::Missing);
            let mut loaded = empty(path);
            let near = match error {
                FileReadError::Missing => nearest(setting.host, &loaded.path),
                _ => None,
            };
            let helped = match found {
                Some(Example::OfGazebo) => Some(
                    "Gazebo has an example of that name, which is not built in: copy it from a \
                     machine with Gazebo (`/usr/share/gz/gz-sim8/worlds`, or \
                     `/usr/share/gazebo-11/worlds`) and put its folder on GZ_SIM_RESOURCE_PATH"
                        .to_owned(),
                ),
                _ if near.is_some() => near.map(|near| {
                    format!("did you mean `{}`?", shown(&near, &setting.working_folder))
                }),
                Some(Example::Unknown(Some(near))) => {
                    Some(format!("did you mean `{near}.sdf`, which is built in?"))
                }
                _ => None,
            };
            let name = shown(&loaded.path, &setting.working_folder);
            let message = format!("`{name}` cannot be read: {error}");
            let finding = Diagnostic::error("unreadable-file", message).caused_by(error.cause());
            loaded.diagnostics.push(finding.help(helped.unwrap_or_else(|| {
                "check the path; it is relative to the working folder".to_owned()
            })));
            loaded
        }
    }
}

/// Resolves a relative path in the resource folders, which Gazebo also searches for worlds.
fn on_resource_path(written: &Path, setting: &LoadContext<'_>) -> Option<PathBuf> {
    if written.is_absolute() || written.starts_with("..") {
        return None;
    }
    let found = setting.resolver.resolve(written.to_str()?, &setting.working_folder).ok()?;
    (setting.host.kind(&found) == Some(EntryKind::File)).then_some(found)
}

/// Loads the model in a folder.
fn load_folder(path: PathBuf, setting: &LoadContext<'_>) -> LoadedFile {
    let has = |name: &str| setting.host.kind(&path.join(name)) == Some(EntryKind::File);
    if has("model.config") || has("model.sdf") {
        match setting.resolver.model_file(&path) {
            Ok(file) => return load(&file, setting),
            Err(miss) => {
                let mut loaded = empty(path);
                loaded.diagnostics.push(miss.into_diagnostic(Origin::default()));
                return loaded;
            }
        }
    }
    let what = if has("metadata.yaml") {
        (FileFormat::Recording, "a recording")
    } else if has("package.xml") {
        (FileFormat::Folder, "a package")
    } else {
        (FileFormat::Folder, "a folder without a model.config")
    };
    let mut loaded = empty(path);
    loaded.language = what.0;
    let message = format!("`{}` is {}", shown(&loaded.path, &setting.working_folder), what.1);
    let advice = what.0.advice().unwrap_or_default();
    loaded.diagnostics.push(Diagnostic::error("folder", message).help(advice));
    loaded
}

/// Loads bytes as the content of a file with this path: a text received over a network, or built in.
/// References are resolved relative to the path.
#[must_use]
pub fn load_bytes(path: &Path, bytes: &[u8], setting: &LoadContext<'_>) -> LoadedFile {
    let mut loaded = empty(setting.working_folder.join(path));
    let path = loaded.path.clone();
    if mesh_files::is_mesh(&path) {
        loaded.language = FileFormat::Mesh;
        loaded.mesh = mesh_files::summarise(&path, bytes, setting, &mut loaded.diagnostics);
        return loaded;
    }
    if let Some(language) = other_files::recognise(&path, bytes) {
        loaded.language = language;
        other_files::read(bytes, setting, &mut loaded);
        return loaded;
    }
    if let Some(document) =
        read_xml(&path, bytes, setting, &mut loaded.sources, &mut loaded.diagnostics)
    {
        loaded.language = language(&path, &document);
        interpret(document, setting, &mut loaded);
    }
    loaded
}

/// Empty result for a file.
fn empty(path: PathBuf) -> LoadedFile {
    LoadedFile {
        language: promised(&path),
        path,
        sources: SourceMap::new(),
        diagnostics: Diagnostics::new(),
        document: None,
        is_expanded: false,
        robot: None,
        scene: None,
        mesh: None,
        contents: Vec::new(),
        files: Vec::new(),
        known_arguments: Vec::new(),
    }
}

/// Returns true if an expanded file has only macros and properties for other files to include: a robot
/// without links, or any other root such as `<root>` or `<xacro>`.
fn is_for_inclusion(document: &Document) -> bool {
    let root = &document.root;
    match root.local_name() {
        "robot" => root.value("name").is_none() || root.child("link").is_none(),
        "sdf" | "gazebo" | "launch" => false,
        _ => true,
    }
}

fn interpret(document: Document, setting: &LoadContext<'_>, loaded: &mut LoadedFile) {
    let document = if loaded.language == FileFormat::Xacro {
        let expansion = periplus_xacro::XacroContext {
            path: loaded.path.clone(),
            working_folder: setting.working_folder.clone(),
            arguments: setting.arguments.clone(),
            host: setting.host,
            resolver: setting.resolver,
        };
        let expanded = periplus_xacro::expand(
            &document,
            expansion,
            &mut loaded.sources,
            &mut loaded.diagnostics,
        );
        let Some(expanded) = expanded else { return };
        loaded.files.extend(expanded.includes);
        loaded.known_arguments = expanded.known_arguments;
        expanded.document
    } else {
        document
    };
    loaded.is_expanded = !loaded.diagnostics.has_errors();
    match document.root.local_name() {
        _ if loaded.language == FileFormat::Xacro && is_for_inclusion(&document) => {
            loaded.diagnostics.push(
                Diagnostic::hint(
                    "macros-only",
                    "this file has no link, so it is not a complete robot",
                )
                .at(document.root.origin)
                .help("include it in a robot: <xacro:include filename=\"...\"/>"),
            );
        }
        "robot" => {
            loaded.robot = periplus_urdf::read(&document, &mut loaded.diagnostics);
            if let Some(robot) = &loaded.robot {
                periplus_urdf::advise(robot, &mut loaded.diagnostics);
                let model = model_of(robot, &mut loaded.sources, &mut loaded.diagnostics);
                loaded.scene = Some(Scene { models: vec![model], ..Scene::default() });
            }
        }
        "sdf" | "gazebo" => {
            let mut files = Files::new(setting);
            let mut context = periplus_sdf::SdfContext {
                sources: &mut loaded.sources,
                diagnostics: &mut loaded.diagnostics,
                includes: &mut files,
            };
            loaded.scene = Some(periplus_sdf::read_document(&document, &mut context));
            loaded.files.extend(files.into_paths());
        }
        _ if matches!(loaded.language, FileFormat::Launch | FileFormat::ModelConfig) => {}
        _ if loaded.language == FileFormat::Package => {
            let name = document.root.child("name").map(|name| name.text().into_owned());
            loaded.contents.extend(name.map(|name| format!("package {name}")));
        }
        other => {
            let origin = document.root.name_origin();
            loaded.diagnostics.push(
                Diagnostic::error(
                    "unknown-format",
                    format!("`<{other}>` is not a robot, model or world"),
                )
                .at(origin)
                .did_you_mean(origin, other, ["robot", "sdf", "launch"])
                .help("a URDF starts with <robot>, an SDF with <sdf>"),
            );
        }
    }
    if let Some(scene) = &mut loaded.scene {
        mesh_files::resolve(scene, setting, &loaded.sources, &mut loaded.diagnostics);
        periplus_plugin_specs::lint(scene, &mut loaded.diagnostics);
    }
    loaded.document = Some(document);
}
