//! The form for viewers has what the readers read.

#[path = "support/packed.rs"]
mod packed;

use std::fmt::Write;

use expect_test::expect_file;
use packed::{Packed, PackedMaterial, unpack};
use periplus_meshes::{MeshFormat, pack_file, read, sibling_uri};
use proptest::prelude::*;

const OBJ: &str = "mtllib a.mtl
v 0 0 0
v 2 0 0
v 0 1 0
vt 0 0
vt 1 0
vt 0 1
vn 0 0 1
o bare
f 3 2 1
o plate
usemtl steel
f 1/1/1 2/2/1 3/3/1
";
const MTL: &str = "newmtl steel
Kd 0.5 0.25 1
Ke 0 0.5 0
d 0.75
map_Kd ./steel plate.png
";

fn pack_obj() -> Vec<u8> {
    let mut side = |name: &str| (name == "a.mtl").then(|| MTL.into());
    pack_file("package://bot/meshes/plate.obj#submesh=bare", OBJ.as_bytes(), &mut side)
        .expect("a mesh")
}

#[test]
fn a_mesh_of_two_parts_has_all_its_content() {
    let packed = unpack(&pack_obj());
    assert_eq!(packed.textures, [(0, b"package://bot/meshes/steel plate.png".to_vec())]);
    let steel = PackedMaterial {
        diffuse_rgba: [0.5, 0.25, 1.0, 0.75],
        emissive_rgb: [0.0, 0.5, 0.0],
        cutoff: 0.0,
        flags: 0,
        texture: 1,
    };
    assert_eq!(packed.materials, [steel]);
    let [bare, plate] = packed.parts.as_slice() else { panic!("two parts") };
    assert_eq!((plate.name.as_str(), plate.material), ("plate", 1));
    assert_eq!(plate.positions_m, [[0.0; 3], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(plate.normals, [[0, 0, 32767]; 3]);
    assert_eq!(plate.uvs, [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    assert_eq!(plate.triangles, [[0, 1, 2]]);
    assert_eq!((bare.name.as_str(), bare.material, bare.normals.len()), ("bare", 0, 0));
}

/// The page's tests decode the same bytes.
#[test]
fn the_bytes_are_those_that_the_page_reads() {
    let mut hex = String::new();
    for line in pack_obj().chunks(32) {
        line.iter().for_each(|byte| write!(hex, "{byte:02x}").unwrap());
        hex.push('\n');
    }
    expect_file!["data/plate.hex"].assert_eq(&hex);
}

/// A triangle of a glTF file with this material.
fn gltf(material: &str) -> Packed {
    // Three corners: (0,0,0), (1,0,0), (0,1,0).
    let corners = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    let text = format!(
        r#"{{"asset":{{"version":"2.0"}},"nodes":[{{"mesh":0}}],
        "buffers":[{{"byteLength":36,"uri":"data:;base64,{corners}"}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",
            "min":[0,0,0],"max":[1,1,0]}}],
        "images":[{{"uri":"data:image/png;base64,AQIDBA=="}}],"textures":[{{"source":0}}],
        "materials":[{material}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"material":0}}]}}]}}"#
    );
    unpack(&pack_file("file:///a.gltf", text.as_bytes(), &mut |_| None).expect("a mesh"))
}

#[test]
fn an_image_inside_the_file_is_sent_with_it() {
    let packed = gltf(r#"{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}"#);
    assert_eq!(packed.textures, [(1, vec![1, 2, 3, 4])]);
    assert_eq!(packed.materials[0].texture, 1);
    assert!(packed.has_linear_colours);
}

#[test]
fn sides_and_alpha_of_gltf() {
    let check = |material: &str| {
        let [material] = gltf(material).materials.try_into().unwrap();
        (material.flags, material.cutoff, material.diffuse_rgba[3])
    };
    let half = r#""pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.5]}"#;
    assert_eq!(check(&format!("{{{half}}}")), (0, 0.0, 1.0));
    assert_eq!(check(&format!(r#"{{{half},"doubleSided":true}}"#)), (1, 0.0, 1.0));
    assert_eq!(check(&format!(r#"{{{half},"alphaMode":"BLEND"}}"#)), (2, 0.0, 0.5));
    let mask = format!(r#"{{{half},"alphaMode":"MASK","alphaCutoff":0.25}}"#);
    assert_eq!(check(&mask), (4, 0.25, 0.5));
}

#[test]
fn emission_sides_and_transparency_of_collada() {
    let text = r##"<COLLADA version="1.4.1">
      <library_effects><effect id="e"><profile_COMMON><technique sid="c"><lambert>
        <emission><color>0 0 1 1</color></emission><diffuse><color>1 0 0 1</color></diffuse>
        <transparent><texture texture="t" texcoord="u"/></transparent>
        </lambert><extra><technique profile="GOOGLEEARTH"><double_sided>1</double_sided></technique>
        </extra></technique></profile_COMMON></effect></library_effects>
      <library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
      <library_geometries><geometry id="g"><mesh>
        <source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array>
          <technique_common><accessor source="#a" count="3" stride="3"/></technique_common></source>
        <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
        <triangles count="1" material="m"><input semantic="VERTEX" source="#v" offset="0"/>
          <p>0 1 2</p></triangles></mesh></geometry></library_geometries></COLLADA>"##;
    let packed = unpack(&pack_file("a.dae", text.as_bytes(), &mut |_| None).unwrap());
    assert_eq!((packed.materials[0].emissive_rgb, packed.materials[0].flags), ([0.0, 0.0, 1.0], 3));
}

#[test]
fn files_of_a_mesh_are_beside_it() {
    let check = |name| sibling_uri("package://bot/meshes/arm.dae?v=1#submesh=a/b", name);
    assert_eq!(check("skin.png"), "package://bot/meshes/skin.png");
    assert_eq!(check("./a/skin.png"), "package://bot/meshes/a/skin.png");
    assert_eq!(check("../skin.png"), "package://bot/meshes/../skin.png");
    assert_eq!(check(r"a\skin.png"), "package://bot/meshes/a/skin.png");
    assert_eq!(check(r"C:\me\skin.png"), "package://bot/meshes/skin.png");
    assert_eq!(check("/me/skin.png"), "file:///me/skin.png");
    assert_eq!(check("model://bot/skin.png"), "model://bot/skin.png");
    assert_eq!(sibling_uri("arm.dae", "skin.png"), "skin.png");
}

#[test]
fn a_coordinate_beyond_single_precision_is_an_error() {
    let error = pack_file("a.obj", b"v 0 0 0\nv 1e300 0 0\nv 0 1 0\nf 1 2 3\n", &mut |_| None);
    assert!(error.unwrap_err().to_string().contains("check its unit"));
}

#[test]
fn a_part_of_more_than_65536_vertices_has_long_indices() {
    let mut text = String::new();
    for i in 0..65_538 {
        let _ = writeln!(text, "v {i} 0 0");
    }
    text += "f 1 2 3\n";
    (0..21_845).for_each(|i| {
        let _ = writeln!(text, "f {} {} {}", 3 * i + 4, 3 * i + 5, 3 * i + 6);
    });
    let packed = unpack(&pack_file("a.obj", text.as_bytes(), &mut |_| None).unwrap());
    assert_eq!(packed.parts[0].positions_m.len(), 65_538);
    assert_eq!(packed.parts[0].triangles.last(), Some(&[65_535, 65_536, 65_537]));
}

proptest! {
    #[test]
    fn triangles_survive(soup in prop::collection::vec(prop::array::uniform9(-1e6f32..1e6), 1..40)) {
        let mut text = String::new();
        for (i, triangle) in soup.iter().enumerate() {
            for [x, y, z] in triangle.as_chunks::<3>().0 {
                let _ = writeln!(text, "v {x} {y} {z}");
            }
            let _ = writeln!(text, "f {} {} {}", 3 * i + 1, 3 * i + 2, 3 * i + 3);
        }
        let mesh = read(text.as_bytes(), MeshFormat::Obj, &mut |_| None).unwrap();
        let packed = unpack(&pack_file("a.obj", text.as_bytes(), &mut |_| None).unwrap());
        prop_assert_eq!(packed.parts.len(), mesh.submeshes.len());
        for (packed, part) in packed.parts.iter().zip(&mesh.submeshes) {
            let short: Vec<_> = part.positions_m.iter().map(|p| p.map(|x| x as f32)).collect();
            prop_assert_eq!(&packed.positions_m, &short);
            prop_assert_eq!(&packed.triangles, &part.triangles);
        }
    }
}
