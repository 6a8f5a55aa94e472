//! `periplus convert`.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use periplus_diagnostics::{Diagnostic, Diagnostics, closest};
use periplus_loader::{Language, Loaded, Setting, load, load_bytes, map_world, rebase};
use periplus_maps::Distro;
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
    if matches!(loaded.language, Language::Map | Language::Picture) {
        loaded = match with_setting(&options.search.resource_path, Vec::new(), |setting| {
            walls(&loaded, options, setting)
        }) {
            Ok(world) => world,
            Err(why) => {
                terminal::complain(&why);
                return Ok(ExitCode::from(2));
            }
        };
    }
    if let Some(name) = &options.model {
        keep_model(&mut loaded, name);
    }
    let target = folder_of(options.output.as_deref().unwrap_or(file));
    if let Some(scene) = &mut loaded.scene {
        rebase(scene, &loaded.sources, &working_folder(), &target);
    }
    // Half a file must not pass for a whole one. An expansion is whole whatever it describes, as
    // the one of the program `xacro` is.
    let is_expansion = options.to == Format::Urdf
        && options.model.is_none()
        && matches!(loaded.language, Language::Xacro | Language::Urdf)
        && loaded.is_expanded;
    let may_write = |loaded: &Loaded| is_expansion || !loaded.diagnostics.has_errors();
    let text = if may_write(&loaded) { convert(&mut loaded, options.to) } else { None };
    terminal::findings(&mut anstream::stderr().lock(), &loaded)?;
    let Some(text) = text.filter(|_| may_write(&loaded)) else {
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
    if loaded.diagnostics.has_errors() {
        terminal::say("the file is expanded; the errors are about the robot that it describes");
    }
    Ok(ExitCode::SUCCESS)
}

/// Boxes beyond which a world is slow to load and to look at.
const MANY_BOXES: usize = 20_000;

/// The world of a map or floor plan. `Err` for wrong usage.
fn walls(
    loaded: &Loaded,
    options: &ConvertOptions,
    setting: &Setting<'_>,
) -> Result<Loaded, String> {
    let path = loaded.path.to_string_lossy();
    let read = match (loaded.language, options.resolution) {
        (Language::Map, None) => periplus_maps::load(&path, Distro::Jazzy, setting.host),
        (Language::Map, Some(_)) => {
            return Err("`--resolution` is for pictures; the YAML of a map has its own".into());
        }
        (_, Some(metres)) => periplus_maps::load_image(&path, metres, Distro::Jazzy, setting.host),
        (_, None) => {
            return Err(format!(
                "the scale of {path} is not known: give `--resolution METRES`, the side of a pixel"
            ));
        }
    };
    let Some(map) = read.map else {
        return Ok(Loaded {
            diagnostics: read.diagnostics,
            sources: read.sources,
            ..loaded.clone()
        });
    };
    let name = loaded.path.file_stem().unwrap_or_default().to_string_lossy();
    let (text, boxes) = map_world(&map.grid, &name, options.wall_height);
    let mut world = load_bytes(&loaded.path.with_extension("sdf"), text.as_bytes(), setting);
    world.diagnostics.append(read.diagnostics);
    if boxes == 0 {
        world.diagnostics.push(
            Diagnostic::warning(
                "no-walls",
                "no cell of this map is occupied, so there are no walls",
            )
            .help("dark pixels are walls; with `negate: 1` in the YAML light ones are"),
        );
    } else if boxes > MANY_BOXES {
        world.diagnostics.push(
            Diagnostic::warning("many-boxes", format!("the walls take {boxes} boxes"))
                .note("noise and slanted walls need many")
                .help("clean the picture in an image editor, or take a coarser resolution"),
        );
    }
    terminal::say(&format!("{boxes} boxes make the walls"));
    Ok(world)
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
            let mut document = periplus_sdf::write(scene, &mut diagnostics);
            periplus_sdf::use_plain_names(&mut document, &mut diagnostics);
            Some(write_document(&document))
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
