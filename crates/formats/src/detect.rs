//! What kind of file this is.

use std::path::Path;

use periplus_xml::Document;
use serde::Serialize;

/// The languages that are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Language {
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
    /// Triangles.
    Mesh,
    /// None of these.
    Unknown,
}

impl Language {
    /// The name people use.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Xacro => "xacro",
            Self::Urdf => "URDF",
            Self::Sdf => "SDF",
            Self::Launch => "launch file",
            Self::ModelConfig => "model.config",
            Self::Mesh => "mesh",
            Self::Unknown => "unknown format",
        }
    }
}

/// The language that the name of a file promises, for when nothing can be read of it.
pub(crate) fn promised(path: &Path) -> Language {
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    match extension {
        "xacro" => Language::Xacro,
        "urdf" => Language::Urdf,
        "sdf" | "world" => Language::Sdf,
        "launch" => Language::Launch,
        _ => Language::Unknown,
    }
}

/// The language of an XML document, by its root and its name.
pub(crate) fn language(path: &Path, document: &Document) -> Language {
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    if extension.eq_ignore_ascii_case("xacro") || periplus_xacro::is_xacro(document) {
        return Language::Xacro;
    }
    match document.root.local_name() {
        "robot" => Language::Urdf,
        "sdf" | "gazebo" => Language::Sdf,
        "launch" => Language::Launch,
        "model" if path.file_name().is_some_and(|name| name == "model.config") => {
            Language::ModelConfig
        }
        _ => Language::Unknown,
    }
}
