//! `periplus convert`.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use periplus_diagnostics::{Diagnostic, Diagnostics, closest};
use periplus_formats::{Language, Loaded, load, rebase};
use periplus_scene::Scene;
use periplus_xml::write_document;

use crate::options::{ConvertOptions, Format, split};
use crate::paths;
use crate::terminal::{self, with_setting, working_folder};

pub(crate) fn run(options: &ConvertOptions) -> io::Result<ExitCode> {
    let (files, arguments) = split(&options.words);
    let [file] = files.as_slice() else {
        terminal::complain("convert takes one file; see `periplus convert --help`");
        return Ok(ExitCode::from(2));
    };
    let mut loaded =
        with_setting(&options.search.resource_path, arguments, |setting| load(file, setting));
    if let Some(name) = &options.model {
        keep_model(&mut loaded, name);
    }
    let target = folder_of(options.output.as_deref().unwrap_or(file));
    if let Some(scene) = &mut loaded.scene {
        rebase(scene, &loaded.sources, &working_folder(), &target);
    }
    // Half a file must not pass for a whole one.
    let text =
        if loaded.diagnostics.has_errors() { None } else { convert(&mut loaded, options.to) };
    terminal::findings(&mut anstream::stderr().lock(), &loaded)?;
    let Some(text) = text.filter(|_| !loaded.diagnostics.has_errors()) else {
        terminal::complain(&format!("{} is not converted", file.display()));
        return Ok(ExitCode::FAILURE);
    };
    match &options.output {
        Some(path) => {
            if let Err(why) = paths::write(path, text.as_bytes()) {
                terminal::complain(&why);
                return Ok(ExitCode::FAILURE);
            }
        }
        None => {
            let mut out = io::stdout().lock();
            out.write_all(text.as_bytes())?;
            out.flush()?;
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// The folder of a file; what goes to stdout counts as lying beside the file it came from.
fn folder_of(file: &Path) -> PathBuf {
    let path = working_folder().join(file);
    path.parent().map(Path::to_owned).unwrap_or_default()
}

/// Leaves only one model of the scene.
fn keep_model(loaded: &mut Loaded, name: &str) {
    let Some(scene) = loaded.scene.take() else { return };
    let models = scene.worlds.into_iter().flat_map(|world| world.models).chain(scene.models);
    let (kept, others): (Vec<_>, Vec<_>) = models.partition(|model| model.name == name);
    if kept.is_empty() {
        let names = others.iter().map(|model| model.name.as_str());
        let mut diagnostic =
            Diagnostic::error("unknown-model", format!("the file holds no model `{name}`"));
        diagnostic = match closest(name, names.clone()) {
            Some(near) => diagnostic.help(format!("did you mean `{near}`?")),
            None => diagnostic.note(format!("it holds {}", names.collect::<Vec<_>>().join(", "))),
        };
        loaded.diagnostics.push(diagnostic);
    }
    // A xacro or URDF document stands for its one robot and needs no choice.
    loaded.scene = Some(Scene { models: kept, ..Scene::default() });
}

fn convert(loaded: &mut Loaded, to: Format) -> Option<String> {
    let mut diagnostics = Diagnostics::new();
    let text = match (to, &loaded.scene) {
        // The expansion itself: what a robot's other readers are given.
        (Format::Urdf, _) if matches!(loaded.language, Language::Xacro | Language::Urdf) => {
            loaded.document.as_ref().map(write_document)
        }
        (_, None) => {
            let told = format!("a {} describes no scene to convert", loaded.language.name());
            diagnostics.push(Diagnostic::error("nothing-to-convert", told));
            None
        }
        (Format::Sdf | Format::Json, Some(scene)) if is_only_shown(loaded, scene) => {
            diagnostics.push(
                Diagnostic::error(
                    "massless-robot",
                    "no link of the robot has a mass, so nothing of it can be simulated",
                )
                .help("give at least the root link an <inertial>"),
            );
            None
        }
        (Format::Sdf, Some(scene)) => {
            Some(write_document(&periplus_sdf::write(scene, &mut diagnostics)))
        }
        (Format::Json, Some(scene)) => {
            serde_json::to_string_pretty(scene).ok().map(|text| text + "\n")
        }
        (Format::Urdf, Some(scene)) => match scene.models.as_slice() {
            [model] => periplus_urdf::from_model(model, &mut diagnostics)
                .map(|robot| write_document(&periplus_urdf::write(&robot))),
            models => {
                let holds = match models.len() {
                    0 => "a world".to_owned(),
                    count => format!("{count} models"),
                };
                diagnostics.push(
                    Diagnostic::error(
                        "not-one-robot",
                        format!("a URDF holds one robot, this file {holds}"),
                    )
                    .help("convert the model's own file, or convert to sdf or json"),
                );
                None
            }
        },
    };
    loaded.diagnostics.append(diagnostics);
    text
}

/// Whether a robot has lost all its links on the way to a scene.
fn is_only_shown(loaded: &Loaded, scene: &Scene) -> bool {
    let has_links = |robot: &periplus_urdf::Robot| !robot.links.is_empty();
    loaded.robot.as_ref().is_some_and(has_links)
        && scene.models.iter().all(|model| model.links.is_empty())
}
