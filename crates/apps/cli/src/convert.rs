//! `periplus convert`.

mod harmonic;

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use periplus_diagnostics::{Diagnostic, Diagnostics, closest};
use periplus_loader::{FileFormat, LoadContext, LoadedFile, load, load_bytes, map_world, rebase};
use periplus_maps::Distro;
use periplus_scene::Scene;
use periplus_xml::write_document;

use crate::error::CliError;
use crate::options::{ConvertOptions, Format, split};
use crate::paths;
use crate::terminal::{self, with_setting, working_folder};

pub(crate) fn run(options: &ConvertOptions) -> Result<ExitCode, CliError> {
    if options.to == Format::Harmonic {
        return harmonic::run(options);
    }
    if options.out.is_some() || options.no_compare || options.json {
        return Err(CliError::usage(
            "`--out`, `--no-compare` and `--json` are for `--to harmonic`; other formats are written to \
             stdout or to `--output FILE`",
        ));
    }
    let (files, arguments) = split(&options.words);
    let [file] = files.as_slice() else {
        return Err(CliError::usage("convert takes one file; see `periplus convert --help`"));
    };
    let (loaded, text, boxes) = convert_file(file, arguments, options).map_err(CliError::usage)?;
    if let Some(boxes) = boxes {
        terminal::say(&format!("the walls consist of {boxes} boxes"));
    }
    terminal::findings(&mut anstream::stderr().lock(), &loaded)?;
    let Some(text) = text else {
        return Err(CliError::failed(format!("{} is not converted", file.display())));
    };
    match &options.output {
        Some(path) => {
            if let Err(why) = paths::write(path, text.as_bytes()) {
                return Err(CliError::failed(why));
            }
        }
        None => {
            let mut out = io::stdout().lock();
            out.write_all(text.as_bytes())?;
            out.flush()?;
        }
    }
    if loaded.diagnostics.has_errors() {
        terminal::say("the file was expanded; the errors concern the robot that it describes");
    }
    Ok(ExitCode::SUCCESS)
}

/// Loaded file, its converted text if it can be converted, and the number of boxes of the walls of a map.
pub(crate) type Converted = (LoadedFile, Option<String>, Option<usize>);

/// Reads and converts a file. `Err` for wrong usage.
pub(crate) fn convert_file(
    file: &Path,
    arguments: Vec<(String, String)>,
    options: &ConvertOptions,
) -> Result<Converted, String> {
    let mut boxes = None;
    let mut loaded =
        with_setting(&options.search.resource_path, arguments, |setting| load(file, setting));
    if matches!(loaded.language, FileFormat::Map | FileFormat::Picture) {
        loaded = match with_setting(&options.search.resource_path, Vec::new(), |setting| {
            walls(&loaded, options, setting)
        }) {
            Ok((world, count)) => {
                boxes = count;
                world
            }
            Err(why) => return Err(why),
        };
    }
    if let Some(name) = &options.model {
        keep_model(&mut loaded, name);
    }
    let target = folder_of(options.output.as_deref().unwrap_or(file));
    if let Some(scene) = &mut loaded.scene {
        rebase(scene, &loaded.sources, &working_folder(), &target);
    }
    // A partial conversion would pass for a complete one. An xacro expansion is complete whatever
    // it describes, as with the program `xacro`.
    let is_expansion = options.to == Format::Urdf
        && options.model.is_none()
        && matches!(loaded.language, FileFormat::Xacro | FileFormat::Urdf)
        && loaded.is_expanded;
    let may_write = |loaded: &LoadedFile| is_expansion || !loaded.diagnostics.has_errors();
    let text = if may_write(&loaded) { convert(&mut loaded, options.to) } else { None };
    let text = text.filter(|_| may_write(&loaded));
    Ok((loaded, text, boxes))
}

/// Number of boxes above which a world loads and renders slowly.
const MANY_BOXES: usize = 20_000;

/// World of a map or floor plan. `Err` for wrong usage.
fn walls(
    loaded: &LoadedFile,
    options: &ConvertOptions,
    setting: &LoadContext<'_>,
) -> Result<(LoadedFile, Option<usize>), String> {
    let path = loaded.path.to_string_lossy();
    let read = match (loaded.language, options.resolution) {
        (FileFormat::Map, None) => periplus_maps::load(&path, Distro::Jazzy, setting.host),
        (FileFormat::Map, Some(_)) => {
            return Err("`--resolution` is for images only; the YAML of a map sets its own".into());
        }
        (_, Some(metres)) => periplus_maps::load_image(&path, metres, Distro::Jazzy, setting.host),
        (_, None) => {
            return Err(format!(
                "the resolution of {path} is unknown: give `--resolution METRES`, the side of a pixel"
            ));
        }
    };
    let Some(map) = read.map else {
        let unread =
            LoadedFile { diagnostics: read.diagnostics, sources: read.sources, ..loaded.clone() };
        return Ok((unread, None));
    };
    let name = loaded.path.file_stem().unwrap_or_default().to_string_lossy();
    let (text, boxes) = map_world(&map.grid, &name, options.wall_height);
    let mut world = load_bytes(&loaded.path.with_extension("sdf"), text.as_bytes(), setting);
    world.diagnostics.append(read.diagnostics);
    if boxes == 0 {
        world.diagnostics.push(
            Diagnostic::warning(
                "no-walls",
                "no cell of this map is occupied, so there are no walls to build",
            )
            .help("dark pixels are walls; set `negate: 1` in the YAML if light pixels are"),
        );
    } else if boxes > MANY_BOXES {
        world.diagnostics.push(
            Diagnostic::warning("many-boxes", format!("the walls consist of {boxes} boxes"))
                .note("noise and slanted walls need many boxes")
                .help("clean the image in an editor, or use a coarser resolution"),
        );
    }
    Ok((world, Some(boxes)))
}

/// Folder of a file; output to stdout resolves paths like its input file.
fn folder_of(file: &Path) -> PathBuf {
    let path = working_folder().join(file);
    path.parent().map(Path::to_owned).unwrap_or_default()
}

/// Removes all models of the scene but one.
fn keep_model(loaded: &mut LoadedFile, name: &str) {
    let Some(scene) = loaded.scene.take() else { return };
    let models = scene.worlds.into_iter().flat_map(|world| world.models).chain(scene.models);
    let (kept, others): (Vec<_>, Vec<_>) = models.partition(|model| model.name == name);
    if kept.is_empty() {
        let names = others.iter().map(|model| model.name.as_str());
        let mut diagnostic =
            Diagnostic::error("unknown-model", format!("the file has no model `{name}`"));
        diagnostic = match closest(name, names.clone()) {
            Some(near) => diagnostic.help(format!("did you mean `{near}`?")),
            None => {
                diagnostic.note(format!("its models are {}", names.collect::<Vec<_>>().join(", ")))
            }
        };
        loaded.diagnostics.push(diagnostic);
    }
    // An xacro or URDF document has exactly one robot, so no choice is needed.
    loaded.scene = Some(Scene { models: kept, ..Scene::default() });
}

fn convert(loaded: &mut LoadedFile, to: Format) -> Option<String> {
    let mut diagnostics = Diagnostics::new();
    let text = match (to, &loaded.scene) {
        // The expansion itself, as other readers of the robot receive it.
        (Format::Urdf, _) if matches!(loaded.language, FileFormat::Xacro | FileFormat::Urdf) => {
            loaded.document.as_ref().map(write_document)
        }
        (Format::Harmonic, _) => {
            let message = "a conversion to Harmonic writes several files";
            let finding = Diagnostic::error("several-files", message);
            diagnostics
                .push(finding.help("use `periplus convert FILE --to harmonic --out FOLDER`"));
            None
        }
        (_, None) => {
            let told = format!("a {} file has no scene to convert", loaded.language.name());
            diagnostics.push(Diagnostic::error("nothing-to-convert", told));
            None
        }
        (Format::Sdf | Format::Json, Some(scene)) if is_only_shown(loaded, scene) => {
            diagnostics.push(
                Diagnostic::error(
                    "massless-robot",
                    "no link of the robot has a mass, so it cannot be simulated",
                )
                .help("add an <inertial> to the root link at least"),
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
                        format!("a URDF file has one robot, this file has {holds}"),
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

/// Returns true if a robot has no links left after conversion to a scene.
fn is_only_shown(loaded: &LoadedFile, scene: &Scene) -> bool {
    let has_links = |robot: &periplus_urdf::UrdfRobot| !robot.links.is_empty();
    loaded.robot.as_ref().is_some_and(has_links)
        && scene.models.iter().all(|model| model.links.is_empty())
}
