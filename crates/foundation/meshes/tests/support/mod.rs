//! Helpers shared by the tests of the readers.

use periplus_meshes::{Mesh, MeshTexture};

/// Triangles as their corner positions, one line per submesh and triangle.
pub(crate) fn show(mesh: &Mesh) -> String {
    let mut text = String::new();
    for part in &mesh.submeshes {
        let material = part.material.as_ref().map_or(String::new(), |material| {
            let texture = match &material.texture {
                None => String::new(),
                Some(MeshTexture::File(file)) => format!(" {file}"),
                Some(MeshTexture::Embedded { media_type, bytes }) => {
                    format!(" {media_type} of {} bytes", bytes.len())
                }
            };
            format!(" [{} {:?}{texture}]", material.name, material.diffuse_rgba)
        });
        text += &format!("`{}`{material}\n", part.name);
        for triangle in &part.triangles {
            let corner = |&i: &u32| {
                // Adding zero prints -0 as 0.
                let [x, y, z] = part.positions_m[i as usize].map(|x| (x * 1e6).round() / 1e6 + 0.0);
                format!("({x} {y} {z})")
            };
            text += &format!("  {}\n", triangle.iter().map(corner).collect::<Vec<_>>().join(" "));
        }
    }
    for note in &mesh.notes {
        text += &format!("note {}x: {}\n", note.count, note.message);
    }
    text
}
