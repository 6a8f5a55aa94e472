//! Parsing of models and lights from text.

use std::collections::BTreeMap;
use std::path::PathBuf;

use periplus_diagnostics::{Diagnostics, Origin, RenderStyle, Severity, SourceMap, render};
use periplus_loader::{
    LoadContext, LoadedFile, load, load_bytes, settle_images, settle_parameter_files,
};
use periplus_os::Overlay;
use periplus_resources::Resolver;
use periplus_scene::{Light, Model, Plugin};

use crate::compose::{description_of, models_of};

/// Search paths for files of a spawned model.
#[derive(Clone, Debug, Default)]
pub struct Search {
    /// Folders besides those of the environment.
    pub folders: Vec<PathBuf>,
    /// Base folder of relative paths.
    pub working_folder: PathBuf,
    /// Environment variables that differ from those of this process; `None` for a removed one.
    pub variables: BTreeMap<String, Option<String>>,
    /// Hint for a file that cannot be found, from the code that knows the source of the variables.
    pub advice: Option<String>,
}

/// Source of a model.
pub(super) enum Source<'a> {
    /// A text, and its name in findings; empty for the default.
    Text(&'a str, &'a str),
    File(&'a str),
}

/// Result of parsing.
pub(super) struct Reading {
    pub(super) found: Found,
    pub(super) findings: Diagnostics,
    pub(super) sources: SourceMap,
}

/// The first model of a text, or else its first light.
pub(super) enum Found {
    Model {
        model: Box<Model>,
        /// URDF source of the model.
        description: Option<String>,
    },
    Light(Box<Light>),
}

impl Search {
    /// Runs a function with a context for reading files: the machine with the variables of the
    /// search, and a resolver over its folders.
    pub fn with_context<T>(&self, open_meshes: bool, run: impl FnOnce(&LoadContext<'_>) -> T) -> T {
        let host = Overlay { variables: self.variables.clone(), ..Overlay::default() };
        let resolver = Resolver::new(&host, &self.folders).advising(self.advice.clone());
        let working_folder = self.working_folder.clone();
        run(&LoadContext {
            host: &host,
            resolver: &resolver,
            working_folder,
            arguments: Vec::new(),
            open_meshes,
        })
    }

    /// Reads a model or light.
    ///
    /// # Errors
    /// The problems, with their positions.
    pub(super) fn read(&self, source: &Source<'_>) -> Result<Reading, String> {
        self.with_context(true, |context| self.read_in(source, context))
    }

    fn read_in(&self, source: &Source<'_>, context: &LoadContext<'_>) -> Result<Reading, String> {
        let mut loaded = match source {
            Source::Text(text, _) if text.trim().is_empty() => {
                return Err("the text is empty; send a URDF or SDF".into());
            }
            Source::Text(text, called) => load_bytes(&file_of(called), text.as_bytes(), context),
            Source::File(uri) => {
                let from = self.working_folder.join(SPAWNED);
                let path = context.resolver.resolve(uri, &from).map_err(|miss| {
                    let finding = miss.into_diagnostic(Origin::default());
                    render(&finding, &SourceMap::new(), RenderStyle::Plain)
                })?;
                load(&path, context)
            }
        };
        if let Some(scene) = &mut loaded.scene {
            settle_images(scene, &loaded.sources, context, &mut loaded.diagnostics);
            settle_parameter_files(scene, &loaded.sources, context, &mut loaded.diagnostics);
        }
        let scene = loaded.scene.take().unwrap_or_default();
        let description = description_of(&loaded);
        let LoadedFile { diagnostics: findings, sources, .. } = loaded;
        let mut lights = scene.worlds.iter().flat_map(|world| &world.lights).chain(&scene.lights);
        let light = lights.next().cloned();
        let found = match (models_of(scene).into_iter().next(), light) {
            _ if findings.has_errors() => return Err(told(&findings, &sources)),
            (Some(mut model), _) => {
                // A world that is saved includes it as Gazebo does, instead of repeating its file.
                if let Source::File(uri) = source
                    && uri.contains("://")
                {
                    model.included_from.get_or_insert_with(|| (*uri).to_owned());
                }
                Found::Model { model: Box::new(model), description }
            }
            (None, Some(light)) => Found::Light(Box::new(light)),
            (None, None) => {
                let notes = told(&findings, &sources);
                return Err(format!(
                    "the text contains neither a model nor a light
                {notes}"
                ));
            }
        };
        Ok(Reading { found, findings, sources })
    }
}

/// Default name of a text in findings.
const SPAWNED: &str = "spawned.xml";

/// Returns the file name of a text in findings, in the working folder: `robot_description.xml` for a
/// text from `/robot_description`.
fn file_of(called: &str) -> PathBuf {
    let name = called.trim_matches('/').replace(['/', '\\'], "_");
    if name.is_empty() { SPAWNED.into() } else { format!("{name}.xml").into() }
}

/// Renders findings with their positions, without hints for authors of the file.
pub(super) fn told(findings: &Diagnostics, sources: &SourceMap) -> String {
    let mut text = String::new();
    for finding in findings.iter().filter(|one| one.severity != Severity::Hint) {
        text.push_str(render(finding, sources, RenderStyle::Plain).trim_end());
        text.push('\n');
    }
    text
}

/// Removes the namespaces of all plugins of a model: Gazebo replaces them by that of the spawned
/// robot.
pub(super) fn drop_namespaces(model: &mut Model) {
    // Iterative: models can be nested deeper than the call stack allows.
    let mut open = vec![model];
    while let Some(model) = open.pop() {
        model.plugins.iter_mut().for_each(drop_namespace);
        for link in &mut model.links {
            link.sensors.iter_mut().flat_map(|sensor| &mut sensor.plugins).for_each(drop_namespace);
            link.visuals.iter_mut().flat_map(|visual| &mut visual.plugins).for_each(drop_namespace);
        }
        open.extend(&mut model.models);
    }
}

fn drop_namespace(plugin: &mut Plugin) {
    plugin.content.retain(|element| element.name != "robotNamespace");
    for ros in plugin.content.iter_mut().filter(|element| element.name == "ros") {
        let is_namespace = |node: &periplus_xml::XmlNode| {
            node.as_element().is_some_and(|element| element.name == "namespace")
        };
        ros.children.retain(|node| !is_namespace(node));
    }
}
