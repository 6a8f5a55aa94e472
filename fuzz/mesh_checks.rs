//! Invariants of every mesh that a reader returns.

use periplus_meshes::{MeshFormat, MeshLimits, read_within};

/// Small, so that a step of the fuzzer stays short.
const LIMITS: MeshLimits =
    MeshLimits { triangles_max: 20_000, visits_max: 5_000, depth_max: 64, bytes_max: 16 << 20 };

/// Reads the bytes and checks the result. Side files are the input itself, so
/// that the fuzzer reaches their readers too.
pub fn read_and_check(bytes: &[u8], format: MeshFormat) {
    let side = |_: &str| Some(bytes.to_vec());
    let Ok(mesh) = read_within(LIMITS, bytes, format, &mut { side }) else { return };
    assert!(!mesh.submeshes.is_empty());
    assert!(mesh.triangle_count() <= LIMITS.triangles_max);
    let bounds = mesh.bounds().expect("a mesh has vertices");
    assert!(bounds.size_m().iter().all(|size| *size >= 0.0));
    for part in &mesh.submeshes {
        let vertices = part.positions_m.len();
        assert!(!part.triangles.is_empty());
        assert!(part.triangles.iter().flatten().all(|&i| (i as usize) < vertices));
        assert!(part.positions_m.iter().flatten().all(|x| x.is_finite()));
        assert!(part.degenerate_triangle_count() <= part.triangles.len());
        if let Some(normals) = &part.normals {
            assert_eq!(normals.len(), vertices);
            assert!(normals.iter().flatten().all(|x| x.is_finite()));
        }
        if let Some(uvs) = &part.uvs {
            assert_eq!(uvs.len(), vertices);
            assert!(uvs.iter().flatten().all(|x| x.is_finite()));
        }
        if let Some(material) = &part.material {
            assert!(material.diffuse_rgba.iter().all(|x| (0.0..=1.0).contains(x)));
        }
    }
}
