//! Files without a scene that are common next to robots and worlds: recognised by name and content, to
//! report their format and the command that uses them.

use std::path::Path;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_images::Raster;
use periplus_maps::Distro;
use periplus_yaml::YamlNode;

use crate::detect::FileFormat;
use crate::load::LoadedFile;
use crate::setting::{LoadContext, shown};

/// Maximum number of nodes and displays that are listed.
const MAX_LISTED: usize = 20;

/// Format of a file that is not XML; `None` if it must be parsed as XML.
pub(crate) fn recognise(path: &Path, bytes: &[u8]) -> Option<FileFormat> {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    let ends = |endings: &[&str]| endings.iter().any(|ending| name.ends_with(ending));
    let starts = |magic: &[u8]| bytes.starts_with(magic);
    Some(match () {
        () if ends(&[".png", ".pgm", ".ppm", ".jpg", ".jpeg", ".bmp"])
            || starts(b"\x89PNG\r\n")
            || starts(b"\xff\xd8\xff") =>
        {
            FileFormat::Picture
        }
        () if ends(&[".zip", ".tar", ".tar.gz", ".tgz", ".tar.xz", ".7z", ".gz"])
            || starts(b"PK\x03\x04")
            || starts(b"\x1f\x8b") =>
        {
            FileFormat::Archive
        }
        () if ends(&[".mcap", ".bag", ".db3", ".db3.zstd", ".mcap.zstd"])
            || starts(b"\x89MCAP")
            || starts(b"#ROSBAG")
            || starts(b"SQLite format 3") =>
        {
            FileFormat::Recording
        }
        () if ends(&[".py"]) => match is_launch(&name, bytes) {
            true => FileFormat::LaunchPython,
            false => FileFormat::Python,
        },
        () if ends(&[".rviz", ".vcg"]) => FileFormat::Rviz,
        // The document determines the format.
        () if ends(&[".yaml", ".yml"]) => FileFormat::Yaml,
        () => return None,
    })
}

fn is_launch(name: &str, bytes: &[u8]) -> bool {
    const ENTRY: &[u8] = b"generate_launch_description";
    name.ends_with("launch.py") || bytes.windows(ENTRY.len()).any(|window| window == ENTRY)
}

/// Reads a file of a recognised format and describes its content.
pub(crate) fn read(bytes: &[u8], setting: &LoadContext<'_>, loaded: &mut LoadedFile) {
    let name = shown(&loaded.path, &setting.working_folder);
    match loaded.language {
        FileFormat::Picture => picture(&name, bytes, loaded),
        FileFormat::Rviz | FileFormat::Yaml => yaml(&name, bytes, setting, loaded),
        FileFormat::Archive => {
            let message = format!("`{name}` is an archive, which is not opened");
            let error = Diagnostic::error("archive", message);
            loaded.diagnostics.push(error.help("unpack it, and pass the file in it"));
        }
        _ => {}
    }
}

fn picture(name: &str, bytes: &[u8], loaded: &mut LoadedFile) {
    match Raster::decode(bytes) {
        Ok(raster) => {
            let channels = raster.layout.channels();
            let (width, height) = (raster.width, raster.height);
            loaded.contents.push(format!("{width} x {height} pixels, {channels} channels"));
        }
        Err(error) => loaded.diagnostics.push(
            Diagnostic::error("picture", format!("`{name}` cannot be used: {error}"))
                .help("save it as PNG or PGM again"),
        ),
    }
}

fn yaml(name: &str, bytes: &[u8], setting: &LoadContext<'_>, loaded: &mut LoadedFile) {
    let Ok(text) = String::from_utf8(bytes.to_vec()) else {
        loaded.diagnostics.push(Diagnostic::error("encoding", format!("`{name}` is not UTF-8")));
        return;
    };
    let file = loaded.sources.add(name, text);
    let tree = match periplus_yaml::parse(file, &loaded.sources) {
        Ok(Some(tree)) => tree,
        Ok(None) => {
            loaded.diagnostics.push(Diagnostic::error("empty-file", format!("`{name}` is empty")));
            return;
        }
        Err(error) => {
            loaded.diagnostics.push(*error);
            return;
        }
    };
    if loaded.language == FileFormat::Yaml {
        loaded.language = kind_of(&tree);
    }
    match loaded.language {
        FileFormat::Map => map(setting, loaded),
        FileFormat::Rviz => displays(&tree, loaded),
        FileFormat::Parameters => {
            let mut nodes = Vec::new();
            parameters(&tree, "", &mut nodes, &mut loaded.diagnostics);
            let more = nodes.len().saturating_sub(MAX_LISTED);
            loaded.contents.extend(nodes.into_iter().take(MAX_LISTED));
            if more > 0 {
                loaded.contents.push(format!("and {more} more nodes"));
            }
        }
        FileFormat::Bridge => {
            let topics = tree.list().map_or(0, <[YamlNode]>::len);
            loaded.contents.push(format!("{topics} topics"));
        }
        _ => {}
    }
}

/// Format of a YAML document.
fn kind_of(tree: &YamlNode) -> FileFormat {
    let has = |name: &str| tree.get(name).is_some();
    if has("image") && (has("resolution") || has("origin")) {
        FileFormat::Map
    } else if has("Visualization Manager") {
        FileFormat::Rviz
    } else if has("launch") {
        FileFormat::LaunchYaml
    } else if holds_parameters(tree, 0) {
        FileFormat::Parameters
    } else if tree.list().is_some_and(|entries| entries.iter().any(is_bridged)) {
        FileFormat::Bridge
    } else {
        FileFormat::Yaml
    }
}

fn is_bridged(entry: &YamlNode) -> bool {
    ["ros_topic_name", "gz_topic_name", "ros_type_name"].iter().any(|key| entry.get(key).is_some())
}

/// Maximum depth of namespaces around a node's parameters.
const MAX_NAMESPACES: usize = 6;

fn holds_parameters(node: &YamlNode, depth: usize) -> bool {
    depth <= MAX_NAMESPACES
        && node.entries().is_some_and(|entries| {
            entries.iter().any(|(key, value)| {
                key.text() == Some("ros__parameters") || holds_parameters(value, depth + 1)
            })
        })
}

/// Nodes of a parameter file, each with its number of parameters. An entry without `ros__parameters` next
/// to others sets none in ROS 2.
fn parameters(node: &YamlNode, name: &str, nodes: &mut Vec<String>, diagnostics: &mut Diagnostics) {
    for (key, value) in node.entries().unwrap_or_default() {
        let Some(key_text) = key.text() else { continue };
        if key_text == "ros__parameters" {
            let count = value.entries().map_or(0, <[_]>::len);
            nodes.push(format!("{name}: {count} parameters"));
            if value.entries().is_none() && !value.is_null() {
                diagnostics.push(
                    Diagnostic::error(
                        "bad-parameters",
                        format!("`ros__parameters` of `{name}` is {}, not a mapping", value.kind()),
                    )
                    .at(value.span),
                );
            }
            continue;
        }
        let path = format!("{name}/{key_text}");
        if holds_parameters(value, 1) {
            parameters(value, &path, nodes, diagnostics);
        } else if value.entries().is_some_and(|entries| !entries.is_empty()) {
            diagnostics.push(
                Diagnostic::warning(
                    "no-ros-parameters",
                    format!("`{path}` has no `ros__parameters`, so no node receives the parameters below it"),
                )
                .at(key.span)
                .help(format!(
                    "write `{key_text}:`, below it `ros__parameters:`, and the rest below that"
                )),
            );
        }
    }
}

fn map(setting: &LoadContext<'_>, loaded: &mut LoadedFile) {
    let path = loaded.path.to_string_lossy().into_owned();
    let read = periplus_maps::load(&path, Distro::Jazzy, setting.host);
    loaded.sources = read.sources;
    loaded.diagnostics.append(read.diagnostics);
    let Some(map) = read.map else { return };
    let info = &map.grid.info;
    let (width_m, height_m) = info.size_m();
    let walls = map.grid.cells.iter().filter(|cell| **cell >= periplus_maps::MIN_WALL_PERCENT);
    let unknown = map.grid.cells.iter().filter(|cell| **cell < 0).count();
    loaded.contents.push(format!(
        "{} x {} cells of {} m: {width_m:.2} x {height_m:.2} m",
        info.width, info.height, info.resolution_m
    ));
    loaded.contents.push(format!(
        "{} occupied, {unknown} unknown, the rest free; origin {} {} {}",
        walls.count(),
        info.origin.x_m,
        info.origin.y_m,
        info.origin.yaw_rad
    ));
    loaded.files.push(map.image_path);
}

fn displays(tree: &YamlNode, loaded: &mut LoadedFile) {
    let Some(manager) = tree.get("Visualization Manager") else {
        loaded.diagnostics.push(
            Diagnostic::error("bad-rviz", "this configuration has no `Visualization Manager`")
                .at(tree.span)
                .help("save it in RViz again"),
        );
        return;
    };
    let fixed_frame = manager.get("Global Options").and_then(|options| options.get("Fixed Frame"));
    if let Some(frame) = fixed_frame.and_then(YamlNode::text) {
        loaded.contents.push(format!("fixed frame {frame}"));
    }
    let displays = manager.get("Displays").and_then(YamlNode::list).unwrap_or_default();
    let text = |display: &YamlNode, key: &str| {
        display.get(key).and_then(YamlNode::text).map(str::to_owned)
    };
    for display in displays.iter().take(MAX_LISTED) {
        let class = text(display, "Class").unwrap_or_default();
        let name = text(display, "Name").unwrap_or_default();
        loaded.contents.push(format!("display {name} ({class})"));
    }
}
