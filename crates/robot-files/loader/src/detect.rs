//! Recognition of file formats.

use std::path::Path;

use periplus_xml::Document;
use serde::Serialize;

/// Recognised file formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum FileFormat {
    /// URDF with macros.
    Xacro,
    /// A robot description.
    Urdf,
    /// A world or model.
    Sdf,
    /// A launch file of ROS 1 or ROS 2 in XML.
    Launch,
    /// The description of a model folder.
    ModelConfig,
    /// Triangle mesh.
    Mesh,
    /// Image: a map, a floor plan, a texture.
    Picture,
    /// The YAML of a map.
    Map,
    /// Parameters of ROS nodes in YAML.
    Parameters,
    /// Topics of a bridge between ROS and Gazebo in YAML.
    Bridge,
    /// The configuration of `RViz`.
    Rviz,
    /// A launch file in YAML.
    LaunchYaml,
    /// A launch file in Python.
    LaunchPython,
    /// Other Python program.
    Python,
    /// Other YAML.
    Yaml,
    /// Recording (a bag).
    Recording,
    /// Archive.
    Archive,
    /// The manifest of a package.
    Package,
    /// Folder that is not a model.
    Folder,
    /// Unknown format.
    Unknown,
}

impl FileFormat {
    /// Common name of the format.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Xacro => "xacro",
            Self::Urdf => "URDF",
            Self::Sdf => "SDF",
            Self::Launch => "launch file",
            Self::ModelConfig => "model.config",
            Self::Mesh => "mesh",
            Self::Picture => "picture",
            Self::Map => "map",
            Self::Parameters => "file of node parameters",
            Self::Bridge => "file of bridged topics",
            Self::Rviz => "configuration of RViz",
            Self::LaunchYaml => "launch file in YAML",
            Self::LaunchPython => "launch file in Python",
            Self::Python => "program in Python",
            Self::Yaml => "YAML file",
            Self::Recording => "recording",
            Self::Archive => "archive",
            Self::Package => "package manifest",
            Self::Folder => "folder",
            Self::Unknown => "unknown format",
        }
    }
}

impl FileFormat {
    /// Advice for a file that holds neither robot nor world; `None` for those that do.
    #[must_use]
    pub fn advice(self) -> Option<&'static str> {
        Some(match self {
            Self::Xacro | Self::Urdf | Self::Sdf | Self::ModelConfig | Self::Unknown => {
                return None;
            }
            Self::Launch | Self::LaunchYaml | Self::LaunchPython => {
                "`periplus launch FILE` runs it, `periplus launch FILE --print` shows its plan"
            }
            Self::Mesh => "refer to it in the <mesh> of a robot or world",
            Self::Picture => {
                "a map needs a YAML beside it; `periplus convert FILE --to sdf --resolution 0.05` \
                 makes a world of a floor plan"
            }
            Self::Map => {
                "`periplus convert FILE --to sdf` makes a world of it, `periplus map` shows and \
                 serves it, `periplus localize` finds a robot on it"
            }
            Self::Parameters => {
                "give it to the nodes that it is for: `periplus costmap`, `localize` and `slam \
                 --live`, or `params_file:=FILE` of a launch file; `periplus doctor FILE` examines it"
            }
            Self::Bridge => "`periplus bridge --config FILE` connects these topics",
            Self::Rviz => "open it on the page: `periplus view`, then Open beside the displays",
            Self::Python => "run it with python3 beside `periplus sim`",
            Self::Yaml => "no Periplus command reads it",
            Self::Recording => "`periplus bag info FILE` shows what it holds, `bag play` plays it",
            Self::Archive => "unpack it, and pass the file in it",
            Self::Package => "pass a robot, world or launch file of the package",
            Self::Folder => "pass a file in it",
        })
    }
}

/// Format by the file name alone, for files that cannot be read.
pub(crate) fn promised(path: &Path) -> FileFormat {
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    match extension {
        "xacro" => FileFormat::Xacro,
        "urdf" => FileFormat::Urdf,
        "sdf" | "world" => FileFormat::Sdf,
        "launch" => FileFormat::Launch,
        _ => FileFormat::Unknown,
    }
}

/// Format of an XML document, by its root and its file name.
pub(crate) fn language(path: &Path, document: &Document) -> FileFormat {
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    if extension.eq_ignore_ascii_case("xacro") || periplus_xacro::is_xacro(document) {
        return FileFormat::Xacro;
    }
    match document.root.local_name() {
        "robot" => FileFormat::Urdf,
        "sdf" | "gazebo" => FileFormat::Sdf,
        "launch" => FileFormat::Launch,
        "package" => FileFormat::Package,
        "model" if path.file_name().is_some_and(|name| name == "model.config") => {
            FileFormat::ModelConfig
        }
        _ => FileFormat::Unknown,
    }
}
