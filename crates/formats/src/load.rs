//! From a path to a scene.

use std::path::{Path, PathBuf};

use periplus_diagnostics::{Diagnostic, Diagnostics, SourceMap};
use periplus_resources::{ReadError, nearest};
use periplus_scene::Scene;
use periplus_urdf::Robot;
use periplus_xml::Document;

use crate::detect::{Language, language, promised};
use crate::documents::{model_of, read_xml};
use crate::includes::Files;
use crate::mesh_files::{self, MeshSummary};
use crate::setting::{Setting, shown};

/// What a file gave.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The file.
    pub path: PathBuf,
    /// What it is written in.
    pub language: Language,
    /// The texts that took part.
    pub sources: SourceMap,
    /// What is wrong with them.
    pub diagnostics: Diagnostics,
    /// The XML, with xacro expanded. None when it is not XML, or does not expand.
    pub document: Option<Document>,
    /// The robot, of a URDF.
    pub robot: Option<Robot>,
    /// What it means. None for files that describe no scene.
    pub scene: Option<Scene>,
    /// What a mesh file holds.
    pub mesh: Option<MeshSummary>,
    /// Other files that took part, in order of use.
    pub files: Vec<PathBuf>,
}

/// Reads a file of any kind that is known.
#[must_use]
pub fn load(path: &Path, setting: &Setting<'_>) -> Loaded {
    let path = setting.working_folder.join(path);
    match setting.host.read(&path) {
        Ok(bytes) => load_bytes(&path, &bytes, setting),
        Err(error) => {
            let mut loaded = empty(path);
            let near = match error {
                ReadError::Missing => nearest(setting.host, &loaded.path),
                _ => None,
            };
            let help = match near {
                Some(near) => format!("did you mean `{}`?", shown(&near, &setting.working_folder)),
                None => "check the path; it is taken from the folder you stand in".to_owned(),
            };
            loaded.diagnostics.push(
                Diagnostic::error(
                    "unreadable-file",
                    format!(
                        "`{}` cannot be read: {error}",
                        shown(&loaded.path, &setting.working_folder)
                    ),
                )
                .help(help),
            );
            loaded
        }
    }
}

/// Reads what a file of this name would hold: a text that came over a wire, or is built in. What it
/// mentions is looked for from that place.
#[must_use]
pub fn load_bytes(path: &Path, bytes: &[u8], setting: &Setting<'_>) -> Loaded {
    let mut loaded = empty(setting.working_folder.join(path));
    let path = loaded.path.clone();
    if mesh_files::is_mesh(&path) {
        loaded.language = Language::Mesh;
        loaded.mesh = mesh_files::summarise(&path, bytes, setting, &mut loaded.diagnostics);
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

/// Nothing yet of a file.
fn empty(path: PathBuf) -> Loaded {
    Loaded {
        language: promised(&path),
        path,
        sources: SourceMap::new(),
        diagnostics: Diagnostics::new(),
        document: None,
        robot: None,
        scene: None,
        mesh: None,
        files: Vec::new(),
    }
}

fn interpret(document: Document, setting: &Setting<'_>, loaded: &mut Loaded) {
    let document = if loaded.language == Language::Xacro {
        let expansion = periplus_xacro::Setting {
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
        expanded.document
    } else {
        document
    };
    match document.root.local_name() {
        // A file of macros for others to include is a `robot` without a name.
        "robot" if loaded.language == Language::Xacro && document.root.value("name").is_none() => {}
        "robot" => {
            loaded.robot = periplus_urdf::read(&document, &mut loaded.diagnostics);
            if let Some(robot) = &loaded.robot {
                let model = model_of(robot, &mut loaded.sources, &mut loaded.diagnostics);
                loaded.scene = Some(Scene { models: vec![model], ..Scene::default() });
            }
        }
        "sdf" | "gazebo" => {
            let mut files = Files::new(setting);
            let mut context = periplus_sdf::Context {
                sources: &mut loaded.sources,
                diagnostics: &mut loaded.diagnostics,
                includes: &mut files,
            };
            loaded.scene = Some(periplus_sdf::read_document(&document, &mut context));
            loaded.files.extend(files.into_paths());
        }
        _ if matches!(loaded.language, Language::Launch | Language::ModelConfig) => {}
        other => {
            let origin = document.root.name_origin();
            loaded.diagnostics.push(
                Diagnostic::error(
                    "unknown-format",
                    format!("`<{other}>` is no robot, model or world"),
                )
                .at(origin)
                .did_you_mean(origin, other, ["robot", "sdf", "launch"])
                .help("a URDF starts with <robot>, an SDF with <sdf>"),
            );
        }
    }
    if let Some(scene) = &mut loaded.scene {
        mesh_files::resolve(scene, setting, &loaded.sources, &mut loaded.diagnostics);
        periplus_plugins::lint(scene, &mut loaded.diagnostics);
    }
    loaded.document = Some(document);
}
