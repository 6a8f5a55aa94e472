//! Written meshes are read back unchanged, and no damage to a file makes a reader panic.

use std::fmt::Write;

use periplus_meshes::{MeshFormat, MeshLimits, read, read_within};
use proptest::prelude::*;

type Soup = Vec<[[f32; 3]; 3]>;

fn soup() -> impl Strategy<Value = Soup> {
    let number = prop_oneof![-1e6f32..1e6, proptest::num::f32::NORMAL, Just(0.0)];
    prop::collection::vec(prop::array::uniform3(prop::array::uniform3(number)), 1..20)
}

fn binary_stl(soup: &Soup) -> Vec<u8> {
    let mut bytes = vec![b'x'; 80];
    bytes.extend(u32::try_from(soup.len()).unwrap_or(0).to_le_bytes());
    for triangle in soup {
        let numbers = [0f32; 3].into_iter().chain(triangle.iter().flatten().copied());
        bytes.extend(numbers.flat_map(f32::to_le_bytes).chain([0, 0]));
    }
    bytes
}

fn ascii_stl(soup: &Soup) -> Vec<u8> {
    let mut text = "solid s\n".to_owned();
    for triangle in soup {
        text += "facet normal 0 0 0\nouter loop\n";
        for [x, y, z] in triangle {
            let _ = writeln!(text, "vertex {x:e} {y} {z}");
        }
        text += "endloop\nendfacet\n";
    }
    (text + "endsolid s\n").into_bytes()
}

fn obj(soup: &Soup) -> Vec<u8> {
    let mut text = String::new();
    for triangle in soup {
        for [x, y, z] in triangle {
            let _ = writeln!(text, "v {x} {y} {z:e}");
        }
        text += "f -3 -2 -1\n";
    }
    text.into_bytes()
}

fn corners(bytes: &[u8], format: MeshFormat) -> Vec<[[f64; 3]; 3]> {
    let mesh = read(bytes, format, &mut |_| None).expect("a sound file");
    let part = &mesh.submeshes[0];
    part.triangles.iter().map(|t| t.map(|i| part.positions_m[i as usize])).collect()
}

/// Widened, and with one kind of zero: the STL reader welds both.
fn widened(soup: &Soup) -> Vec<[[f64; 3]; 3]> {
    soup.iter().map(|t| t.map(|p| p.map(|x| f64::from(x) + 0.0))).collect()
}

/// Decimal text of an f32 read as f64 is not the widened f32; back as f32 it is.
fn narrowed(corners: &[[[f64; 3]; 3]]) -> Soup {
    corners.iter().map(|t| t.map(|p| p.map(|x| x as f32))).collect()
}

proptest! {
    #[test]
    fn binary_stl_comes_back(soup in soup()) {
        prop_assert_eq!(corners(&binary_stl(&soup), MeshFormat::Stl), widened(&soup));
    }

    #[test]
    fn ascii_stl_comes_back(soup in soup()) {
        prop_assert_eq!(narrowed(&corners(&ascii_stl(&soup), MeshFormat::Stl)), soup);
    }

    #[test]
    fn obj_comes_back(soup in soup()) {
        prop_assert_eq!(narrowed(&corners(&obj(&soup), MeshFormat::Obj)), soup);
    }

    #[test]
    fn bounds_hold_every_corner(soup in soup()) {
        let mesh = read(&binary_stl(&soup), MeshFormat::Stl, &mut |_| None).expect("sound");
        let bounds = mesh.bounds().expect("has vertices");
        for p in widened(&soup).iter().flatten() {
            prop_assert!((0..3).all(|i| bounds.min_m[i] <= p[i] && p[i] <= bounds.max_m[i]));
        }
    }
}

/// Small files that use most features of each reader.
fn seeds() -> Vec<(MeshFormat, &'static [u8])> {
    macro_rules! seed {
        ($format:ident, $path:literal) => {
            (
                MeshFormat::$format,
                include_bytes!(concat!("../../../../fuzz/seeds/", $path)).as_slice(),
            )
        };
    }
    vec![
        seed!(Stl, "stl/ascii.stl"),
        seed!(Stl, "stl/binary.stl"),
        seed!(Stl, "stl/solid_binary.stl"),
        seed!(Obj, "obj/groups.obj"),
        seed!(Obj, "obj/polygon.obj"),
        seed!(Collada, "collada/triangles.dae"),
        seed!(Collada, "collada/polygons.dae"),
        seed!(Collada, "collada/instances.dae"),
        seed!(Gltf, "gltf/box.glb"),
        seed!(Gltf, "gltf/data_uri.gltf"),
        seed!(Gltf, "gltf/sparse.gltf"),
        seed!(Gltf, "gltf/strip.gltf"),
    ]
}

const SMALL: MeshLimits =
    MeshLimits { triangles_max: 1000, visits_max: 1000, depth_max: 32, bytes_max: 1 << 20 };

#[test]
fn every_seed_loads() {
    for (format, bytes) in seeds() {
        let mesh = read_within(SMALL, bytes, format, &mut |_| Some(vec![0; 60]));
        assert!(mesh.is_ok_and(|mesh| mesh.triangle_count() > 0), "{format:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn damaged_files_never_panic(
        seed in 0..12usize,
        edits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..3u8), 1..8),
        cut in prop::option::of(any::<prop::sample::Index>()),
    ) {
        let (format, bytes) = seeds()[seed];
        let mut bytes = bytes.to_vec();
        for (at, byte, kind) in edits {
            let at = at.index(bytes.len());
            match kind {
                0 => bytes[at] = byte,
                1 => bytes.insert(at, byte),
                _ if bytes.len() > 1 => drop(bytes.remove(at)),
                _ => {}
            }
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        if let Ok(mesh) = read_within(SMALL, &bytes, format, &mut |_| Some(bytes.clone())) {
            for part in &mesh.submeshes {
                prop_assert!(part.positions_m.iter().flatten().all(|x| x.is_finite()));
                prop_assert!(part.triangles.iter().flatten().all(|&i| (i as usize) < part.positions_m.len()));
            }
        }
    }
}
