//! Mesh file formats.

use crate::error::MeshError;

/// Supported mesh formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshFormat {
    /// STL, ASCII or binary.
    Stl,
    /// Wavefront OBJ with MTL materials.
    Obj,
    /// COLLADA 1.4 and 1.5.
    Collada,
    /// glTF 2.0, as JSON (`.gltf`) or binary (`.glb`).
    Gltf,
}

impl MeshFormat {
    /// Format of a file, by its extension as in Gazebo and RViz, or by its first bytes if the extension is
    /// unknown.
    ///
    /// # Errors
    /// If the format is not supported; the error lists the supported ones.
    pub fn from_path_and_bytes(path: &str, bytes: &[u8]) -> Result<MeshFormat, MeshError> {
        let file = path.rsplit(['/', '\\']).next().unwrap_or(path);
        let extension = file.rsplit_once('.').map_or("", |(_, extension)| extension);
        match extension.to_ascii_lowercase().as_str() {
            "stl" | "stla" | "stlb" => Ok(MeshFormat::Stl),
            "obj" => Ok(MeshFormat::Obj),
            "dae" => Ok(MeshFormat::Collada),
            "gltf" | "glb" => Ok(MeshFormat::Gltf),
            other => MeshFormat::from_bytes(bytes).ok_or_else(|| unsupported(other)),
        }
    }

    /// Format by the first bytes of a file. Binary STL and OBJ have no signature and are never returned.
    pub fn from_bytes(bytes: &[u8]) -> Option<MeshFormat> {
        let head = &bytes[..bytes.len().min(4096)];
        let has = |mark: &[u8]| head.windows(mark.len()).any(|window| window == mark);
        if bytes.starts_with(b"glTF") || (has(b"\"asset\"") && has(b"{")) {
            Some(MeshFormat::Gltf)
        } else if has(b"<COLLADA") {
            Some(MeshFormat::Collada)
        } else if crate::stl::is_ascii(bytes) {
            Some(MeshFormat::Stl)
        } else {
            None
        }
    }
}

fn unsupported(extension: &str) -> MeshError {
    let what = match extension {
        "" => "a mesh file without an extension".to_owned(),
        "zae" => "a zipped COLLADA file (.zae)".to_owned(),
        other => format!("mesh format `.{}`", other.chars().take(20).collect::<String>()),
    };
    let help = match extension {
        "zae" => "unzip it and refer to the .dae inside",
        _ => "convert it to one of: .stl, .obj, .dae, .gltf, .glb",
    };
    MeshError::new(format!("{what} is not supported"), help)
}
