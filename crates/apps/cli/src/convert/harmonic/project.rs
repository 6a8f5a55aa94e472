//! Files of a robot or world, converted.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use periplus_diagnostics::Diagnostics;
use periplus_loader::{FileFormat, LoadContext, LoadedFile, load};
use periplus_migration::{
    BridgeEntry, ExpectedDifference, JointGeometry, Migrated, MigrationContext, MigrationEntry,
    MigrationOutcome, migrate,
};
use periplus_os::{Machine, Overlay};
use periplus_plugin_specs::{Family, library_id, sites};
use periplus_resources::{Host as _, Resolver};
use periplus_scene::Shape;
use periplus_xml::{Element, decode, write_document};

use crate::error::CliError;
use crate::options::SearchOptions;
use crate::terminal::working_folder;

/// A converted file.
#[derive(Clone, Debug)]
pub(super) struct ConvertedFile {
    /// Canonical path of the old file.
    pub(super) path: PathBuf,
    /// Path in the output folder.
    pub(super) output: PathBuf,
    /// New text.
    pub(super) text: String,
}

/// A robot or world with all files that it reads.
#[derive(Debug)]
pub(super) struct Project {
    /// Path of the main file as given.
    pub(super) file: PathBuf,
    /// Arguments for xacro.
    pub(super) arguments: Vec<(String, String)>,
    /// The old file.
    pub(super) loaded: LoadedFile,
    /// Converted files that differ from the old ones.
    pub(super) files: Vec<ConvertedFile>,
    /// Old elements of all files.
    pub(super) entries: Vec<MigrationEntry>,
    /// Topics with their final names.
    pub(super) bridge: Vec<BridgeEntry>,
    /// Differences that the conversion causes knowingly.
    pub(super) expected: Vec<ExpectedDifference>,
}

impl Project {
    /// Reads and converts a file and those that it includes.
    pub(super) fn read(
        file: &Path,
        arguments: Vec<(String, String)>,
        search: &SearchOptions,
    ) -> Result<Self, CliError> {
        let host = Machine;
        let folders = folders(search);
        let resolver = Resolver::new(&host, &folders);
        let context = LoadContext {
            host: &host,
            resolver: &resolver,
            working_folder: working_folder(),
            arguments: arguments.clone(),
            open_meshes: false,
        };
        let loaded = load(file, &context);
        if !matches!(loaded.language, FileFormat::Sdf | FileFormat::Urdf | FileFormat::Xacro) {
            return Err(refusal(&loaded));
        }
        if loaded.document.is_none() {
            crate::terminal::findings(&mut anstream::stderr().lock(), &loaded)?;
            let name = file.display();
            return Err(CliError::failed(format!("{name} cannot be read, so it is not converted")));
        }
        let mut project = Self {
            file: file.to_owned(),
            arguments,
            files: Vec::new(),
            entries: Vec::new(),
            bridge: Vec::new(),
            expected: Vec::new(),
            loaded,
        };
        project.convert(&resolver)?;
        Ok(project)
    }

    fn convert(&mut self, resolver: &Resolver<'_>) -> Result<(), CliError> {
        let host = Machine;
        let (ros, has_ros_control) = self.generation();
        let joints = self.joints();
        let expanded = self.expanded_values();
        let main = canonical(&self.loaded.path);
        let mut paths = vec![main.clone()];
        for path in &self.loaded.files {
            let path = canonical(path);
            if !paths.contains(&path) {
                paths.push(path);
            }
        }
        let is_expanded = self.loaded.language != FileFormat::Sdf;
        for path in paths {
            // Other files, such as YAML, are read by xacro.
            let Ok(bytes) = host.read(&path) else { continue };
            let Ok(text) = decode(&bytes) else { continue };
            let context = MigrationContext {
                ros,
                has_ros_control,
                joints: Some(&joints),
                expanded: expanded.get(&path),
                ..MigrationContext::new(&path, &host, resolver)
            };
            let Some(migrated) = migrate(&text, &context) else {
                if path == main {
                    return Err(CliError::failed(format!("{} is not XML", path.display())));
                }
                continue;
            };
            let migrated = if path == main { self.upgraded(migrated, &context) } else { migrated };
            self.entries.extend(migrated.entries);
            if !is_expanded {
                self.bridge.extend(migrated.bridge);
                self.expected.extend(migrated.expected);
            }
            if migrated.text != *text {
                self.files.push(ConvertedFile {
                    path,
                    output: PathBuf::new(),
                    text: migrated.text,
                });
            }
        }
        let changed: Vec<PathBuf> = self.files.iter().map(|file| file.path.clone()).collect();
        let base = common_folder(&changed);
        for file in &mut self.files {
            file.output = output_path(&file.path, &base);
        }
        if is_expanded && let Some(document) = &self.loaded.document {
            // Macros have their values in the expanded robot only.
            let context = MigrationContext {
                ros,
                has_ros_control,
                joints: Some(&joints),
                ..MigrationContext::new(&main, &host, resolver)
            };
            if let Some(migrated) = migrate(&write_document(document), &context) {
                self.bridge = migrated.bridge;
                self.expected = migrated.expected;
            }
        }
        let mut seen: Vec<BridgeEntry> = Vec::new();
        for entry in std::mem::take(&mut self.bridge) {
            if !seen.contains(&entry) {
                seen.push(entry);
            }
        }
        self.bridge = seen;
        Ok(())
    }

    /// Rewrites a file whose root is `<gazebo>`, which no libsdformat of current Gazebo reads.
    fn upgraded(&self, migrated: Migrated, context: &MigrationContext<'_>) -> Migrated {
        let root = self.loaded.document.as_ref().map(|document| &document.root);
        let Some(root) = root.filter(|root| root.local_name() == "gazebo") else { return migrated };
        let Some(scene) = &self.loaded.scene else { return migrated };
        if self.loaded.diagnostics.has_errors() {
            return migrated;
        }
        let mut diagnostics = Diagnostics::new();
        let mut document = periplus_sdf::write(scene, &mut diagnostics);
        periplus_sdf::use_plain_names(&mut document, &mut diagnostics);
        let Some(rewritten) = migrate(&write_document(&document), context) else { return migrated };
        let version = root.value("version").unwrap_or_default();
        let position = root.origin.0.map(|span| self.loaded.sources.locate(span).1);
        let entry = MigrationEntry {
            file: context.path.display().to_string(),
            line: position.map_or(1, |position| position.line),
            column: position.map_or(1, |position| position.column),
            old: format!("<gazebo version {version}>"),
            new: "<sdf>".to_owned(),
            outcome: MigrationOutcome::Converted,
            remarks: vec![
                "libsdformat does not read this version any more: the whole file was rewritten in a new one, with \
                 included models in place; its comments and layout are lost"
                    .to_owned(),
            ],
        };
        let entries = std::iter::once(entry).chain(migrated.entries).collect();
        Migrated { text: rewritten.text, entries, ..migrated }
    }

    /// ROS version of the plugins, and whether `ros_control` runs.
    fn generation(&self) -> (Option<Family>, bool) {
        let Some(scene) = &self.loaded.scene else { return (None, false) };
        let sites = sites(scene);
        let ros = sites.iter().find_map(|site| site.context.ros);
        let controls =
            sites.iter().any(|site| library_id(&site.plugin.filename) == "gazebo_ros_control");
        (ros, controls)
    }

    /// Values of attributes in the expanded robot, by file and position.
    fn expanded_values(&self) -> BTreeMap<PathBuf, BTreeMap<u32, Vec<String>>> {
        let mut values = BTreeMap::new();
        if let Some(document) = &self.loaded.document {
            self.collect_values(&document.root, &mut values);
        }
        values
    }

    fn collect_values(
        &self,
        element: &Element,
        values: &mut BTreeMap<PathBuf, BTreeMap<u32, Vec<String>>>,
    ) {
        let attribute = match element.name.as_str() {
            "plugin" => "filename",
            "sensor" => "type",
            _ => "",
        };
        if let (Some(value), Some(span)) = (element.value(attribute), element.origin.0) {
            let file = working_folder().join(&self.loaded.sources.file(span.file).name);
            let known = values.entry(canonical(&file)).or_default().entry(span.start).or_default();
            if !known.iter().any(|known| known == value) {
                known.push(value.to_owned());
            }
        }
        for child in element.elements() {
            self.collect_values(child, values);
        }
    }

    /// Joints of all models, by name.
    fn joints(&self) -> BTreeMap<String, JointGeometry> {
        let mut joints = BTreeMap::new();
        let Some(scene) = &self.loaded.scene else { return joints };
        let of_worlds = scene.worlds.iter().flat_map(|world| &world.models);
        for model in of_worlds.chain(&scene.models) {
            for joint in &model.joints {
                let Some(link) = model.links.iter().find(|link| link.name == joint.child) else {
                    continue;
                };
                let model_from_joint = link.model_from_link * joint.child_from_joint;
                let wheel_radius_m =
                    link.collisions.iter().find_map(|collision| match collision.shape {
                        Shape::Cylinder { radius_m, .. } | Shape::Sphere { radius_m } => {
                            Some(radius_m)
                        }
                        _ => None,
                    });
                let position_m = model_from_joint.translation.to_array();
                let geometry = JointGeometry { position_m, wheel_radius_m };
                joints.entry(joint.name.clone()).or_insert(geometry);
            }
        }
        joints
    }

    /// True if no file changes.
    pub(super) fn is_current(&self) -> bool {
        self.files.is_empty()
    }

    /// The machine with the new files in place of the old ones.
    pub(super) fn overlay(&self) -> Overlay {
        self.files.iter().fold(Overlay::default(), |overlay, file| {
            overlay.with_text(file.path.clone(), file.text.clone())
        })
    }

    /// True for a file that describes a robot or model instead of a world.
    pub(super) fn is_robot(&self) -> bool {
        self.loaded.scene.as_ref().is_some_and(|scene| scene.worlds.is_empty())
    }
}

/// Folders of the search options.
pub(super) fn folders(search: &SearchOptions) -> Vec<PathBuf> {
    crate::terminal::search(&search.resource_path).folders
}

pub(super) fn canonical(path: &Path) -> PathBuf {
    Machine.canonical(path).unwrap_or_else(|| path.to_owned())
}

/// Innermost folder that contains all files.
fn common_folder(paths: &[PathBuf]) -> PathBuf {
    let mut folders = paths.iter().filter_map(|path| path.parent());
    let Some(first) = folders.next() else { return PathBuf::new() };
    folders.fold(first.to_owned(), |common, folder| {
        common
            .ancestors()
            .find(|above| folder.starts_with(above))
            .map(Path::to_owned)
            .unwrap_or_default()
    })
}

/// Path in the output folder: below the name of the package or model that contains the file, else below the common folder.
pub(super) fn output_path(path: &Path, base: &Path) -> PathBuf {
    let host = Machine;
    let root = path.ancestors().skip(1).find(|up| {
        let has = |name: &str| host.kind(&up.join(name)).is_some();
        has("package.xml") || has("manifest.xml")
    });
    let root = root.or_else(|| {
        path.ancestors().skip(1).find(|up| host.kind(&up.join("model.config")).is_some())
    });
    if let Some(root) = root {
        let above = root.parent().unwrap_or(root);
        return path.strip_prefix(above).unwrap_or(path).to_owned();
    }
    match path.strip_prefix(base) {
        Ok(inside) => inside.to_owned(),
        Err(_) => PathBuf::from(path.file_name().unwrap_or_default()),
    }
}

fn refusal(loaded: &LoadedFile) -> CliError {
    let name = loaded.path.display();
    let findings = terminal_findings(loaded);
    if loaded.document.is_none() && loaded.diagnostics.has_errors() {
        return CliError::failed(findings.unwrap_or_else(|| format!("{name} cannot be read")));
    }
    CliError::failed(format!(
        "{name} is a {}; `--to harmonic` converts robots (URDF, xacro, SDF), worlds and launch files",
        loaded.language.name()
    ))
}

/// First error of a file.
fn terminal_findings(loaded: &LoadedFile) -> Option<String> {
    let error = loaded.diagnostics.iter().next()?;
    let help = error.help.first().map(|help| format!("; {help}")).unwrap_or_default();
    Some(format!("{}{help}", error.message))
}
