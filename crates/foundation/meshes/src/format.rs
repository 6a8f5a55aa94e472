//! Which format a mesh file is in.

use crate::error::MeshError;

/// The mesh formats that can be read.
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
    /// The format of a file, by its extension as Gazebo and RViz do, or by its
    /// first bytes when the extension says nothing.
    ///
    /// # Errors
    /// For a format that is not read here, naming those that are.
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

    /// The format that the first bytes of a file speak for; binary STL and OBJ
    /// have no mark of their own and are never guessed.
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
