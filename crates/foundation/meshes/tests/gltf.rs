//! glTF assets put together piece by piece.

mod support;

use expect_test::{Expect, expect};
use periplus_meshes::{MeshFormat, MeshLimits, read, read_within};
use support::show;

/// Positions of a unit square (48 bytes), then indices 0 1 2, 0 2 3 as u16 (12 bytes).
fn square() -> Vec<u8> {
    let corners = [0f32, 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.];
    let indices = [0u16, 1, 2, 0, 2, 3];
    let corners = corners.iter().flat_map(|x| x.to_le_bytes());
    corners.chain(indices.iter().flat_map(|i| i.to_le_bytes())).collect()
}

const PRIMITIVE: &str = r#"{"attributes":{"POSITION":0},"indices":1}"#;

fn asset(nodes: &str, primitive: &str, more: &str) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{nodes}],
        "meshes":[{{"name":"square","primitives":[{primitive}]}}],{more}
        "buffers":[{{"uri":"my%20square.bin","byteLength":60}}],
        "bufferViews":[{{"buffer":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":12}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}},
                     {{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}}]}}"#
    )
}

fn check(json: &str, expected: Expect) {
    let mut side_files = |file: &str| (file == "my square.bin").then(square);
    let mesh = read(json.as_bytes(), MeshFormat::Gltf, &mut side_files);
    expected.assert_eq(&mesh.map_or_else(|e| format!("error: {e}\n"), |mesh| show(&mesh)));
}

#[test]
fn nodes_place_their_meshes_and_y_stays_y() {
    // Turned a quarter about z after scaling, then moved; the child is unnamed and mirrored.
    let nodes = r#"{"name":"lid","mesh":0,"translation":[10,0,0],"scale":[2,3,1],
        "rotation":[0,0,0.70710678,0.70710678],"children":[1]},
        {"mesh":0,"matrix":[1,0,0,0, 0,1,0,0, 0,0,-1,0, 0,0,5,1]}"#;
    check(
        &asset(nodes, PRIMITIVE, ""),
        expect![[r#"
        `lid`
          (10 0 0) (10 2 0) (7 2 0)
          (10 0 0) (7 2 0) (7 0 0)
        `square`
          (10 0 5) (7 2 5) (10 2 5)
          (10 0 5) (7 0 5) (7 2 5)
    "#]],
    );
}

#[test]
fn strips_and_fans_and_lists_without_indices() {
    let primitive = |mode: u32| format!(r#"{{"attributes":{{"POSITION":0}},"mode":{mode}}}"#);
    check(
        &asset(r#"{"mesh":0}"#, &primitive(5), ""),
        expect![[r#"
        `square`
          (0 0 0) (1 0 0) (1 1 0)
          (1 1 0) (1 0 0) (0 1 0)
    "#]],
    );
    check(
        &asset(r#"{"mesh":0}"#, &primitive(6), ""),
        expect![[r#"
        `square`
          (0 0 0) (1 0 0) (1 1 0)
          (0 0 0) (1 1 0) (0 1 0)
    "#]],
    );
    check(
        &asset(r#"{"mesh":0}"#, &primitive(4), ""),
        expect![[r#"
        `square`
          (0 0 0) (1 0 0) (1 1 0)
        note 1x: corners left over after the last triangle of a part left out
    "#]],
    );
    check(
        &asset(r#"{"mesh":0}"#, &primitive(1), ""),
        expect![[r#"
        error: the file has no triangles (points and lines left out: only triangles make a mesh); export the mesh with its faces, or refer to another file
    "#]],
    );
}

#[test]
fn base_colour_and_texture() {
    let primitive = r#"{"attributes":{"POSITION":0},"indices":1,"material":0}"#;
    let material = |image: &str| {
        format!(
            r#""materials":[{{"name":"wood","pbrMetallicRoughness":{{"baseColorFactor":[0.5,0.25,0,1],
            "baseColorTexture":{{"index":0}}}}}}],"textures":[{{"source":0}}],"images":[{image}],"#
        )
    };
    let file = material(r#"{"uri":"oak%20grain.png"}"#);
    check(
        &asset(r#"{"mesh":0}"#, primitive, &file),
        expect![[r#"
        `square` [wood [0.5, 0.25, 0.0, 1.0] oak grain.png]
          (0 0 0) (1 0 0) (1 1 0)
          (0 0 0) (1 1 0) (0 1 0)
    "#]],
    );
    let embedded = material(r#"{"bufferView":1,"mimeType":"image/png"}"#);
    check(
        &asset(r#"{"mesh":0}"#, primitive, &embedded),
        expect![[r#"
        `square` [wood [0.5, 0.25, 0.0, 1.0] image/png of 12 bytes]
          (0 0 0) (1 0 0) (1 1 0)
          (0 0 0) (1 1 0) (0 1 0)
    "#]],
    );
}

#[test]
fn sparse_accessors_replace_what_they_name() {
    // All zeros, but vertices 0, 1 and 2 replaced by the first three of the buffer.
    let sparse = r#"{"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":3,
        "indices":{"bufferView":1,"componentType":5123},"values":{"bufferView":0}}}"#;
    let json = asset(r#"{"mesh":0}"#, PRIMITIVE, "");
    let json =
        json.replace(r#"{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}"#, sparse);
    check(
        &json,
        expect![[r#"
        `square`
          (0 0 0) (1 0 0) (1 1 0)
          (0 0 0) (1 1 0) (0 0 0)
    "#]],
    );
}

#[test]
fn a_binary_container_holds_its_own_buffer() {
    let json = asset(r#"{"mesh":0}"#, PRIMITIVE, "").replace(r#""uri":"my%20square.bin","#, "");
    let chunk = |kind: &[u8], data: &[u8]| {
        [&u32::try_from(data.len()).unwrap().to_le_bytes(), kind, data].concat()
    };
    let chunks = [chunk(b"JSON", json.as_bytes()), chunk(b"BIN\0", &square())].concat();
    let glb = [b"glTF\x02\0\0\0\0\0\0\0".as_slice(), &chunks].concat();
    let load = |bytes: &[u8]| read(bytes, MeshFormat::Gltf, &mut |_| None);
    assert_eq!(load(&glb).unwrap().triangle_count(), 2);
    assert_eq!(
        load(&glb[..glb.len() - 1]).unwrap_err().message,
        "a GLB chunk reaches beyond the end of the file"
    );
}

#[test]
fn hostile_numbers_are_refused() {
    let json = asset(r#"{"mesh":0}"#, PRIMITIVE, "");
    for (from, to, expected) in [
        (
            r#""count":4"#,
            r#""count":4000000000"#,
            expect![[r#"
            error: accessor 0 counts 4000000000 elements, more than its data holds; the file is damaged: export it again
        "#]],
        ),
        (
            r#""count":6"#,
            r#""count":18446744073709551615"#,
            expect![[r#"
            error: accessor 1 counts 18446744073709551615 elements, more than its data holds; the file is damaged: export it again
        "#]],
        ),
        (
            r#""byteOffset":48"#,
            r#""byteOffset":18446744073709551615"#,
            expect![[r#"
            error: buffer view 1 reaches beyond the 60 bytes of buffer 0; the file or its .bin is cut short: export or fetch it again
        "#]],
        ),
        (
            r#""nodes":[0]"#,
            r#""nodes":[7]"#,
            expect![[r#"
            error: node 7 is referred to but does not exist; the file is damaged: export it again
        "#]],
        ),
        (
            r#"{"mesh":0}"#,
            r#"{"mesh":0,"children":[0,0]}"#,
            expect![[r#"
            error: scene nodes are nested more than 128 deep; look for a node that contains or instances itself
        "#]],
        ),
        (
            "my%20square.bin",
            "gone.bin",
            expect![[r#"
            error: buffer file `gone.bin` not found; put it beside the glTF file, or export a single .glb
        "#]],
        ),
        (
            r#""scenes""#,
            r#""extensionsRequired":["KHR_draco_mesh_compression"],"scenes""#,
            expect![[r#"
            error: the file requires the glTF extension `KHR_draco_mesh_compression`, which is not supported; export it without compression and without that extension
        "#]],
        ),
        (
            r#""version":"2.0""#,
            r#""version":"1.0""#,
            expect![[r#"
            error: glTF version `1.0` is not supported; convert the file to glTF 2.0
        "#]],
        ),
    ] {
        check(&json.replace(from, to), expected);
    }
}

#[test]
fn four_billion_vertices_without_data_cost_nothing() {
    let json = asset(r#"{"mesh":0}"#, PRIMITIVE, "");
    let huge = r#"{"componentType":5126,"count":4000000000,"type":"VEC3"}"#;
    let json =
        json.replace(r#"{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}"#, huge);
    check(
        &json,
        expect![[r#"
        `square`
          (0 0 0) (0 0 0) (0 0 0)
          (0 0 0) (0 0 0) (0 0 0)
    "#]],
    );
}

#[test]
fn a_flood_of_empty_objects_is_stopped_before_it_unfolds() {
    let json = format!(r#"{{"asset":{{"version":"2.0"}},"nodes":[{}{{}}]}}"#, "{},".repeat(10_000));
    let limits = MeshLimits { bytes_max: 1 << 20, ..MeshLimits::default() };
    let error = read_within(limits, json.as_bytes(), MeshFormat::Gltf, &mut |_| None).unwrap_err();
    assert_eq!(error.message, "the mesh unfolds to more than 1 MiB");
}

#[test]
fn a_count_without_data_is_refused_before_memory_is_taken() {
    let file = |primitive: &str, accessors: &str| {
        format!(
            r#"{{"asset":{{"version":"2.0"}},"nodes":[{{"mesh":0}}],"scenes":[{{"nodes":[0]}}],
            "meshes":[{{"primitives":[{{{primitive}}}]}}],"accessors":[{accessors}],
            "bufferViews":[{{"buffer":0,"byteLength":16}}],"buffers":[{{"byteLength":16,
            "uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAAA=="}}]}}"#
        )
    };
    let plain = r#"{"componentType":5126,"count":1000000000,"type":"VEC3"}"#;
    let sparse = r#"{"componentType":5126,"count":1000000000,"type":"VEC3","sparse":{"count":1,
        "indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":0}}}"#;
    let indices = r#"{"componentType":5125,"count":900000000,"type":"SCALAR"}"#;
    let indexed = format!("{plain},{indices}");
    for (primitive, accessors) in [
        (r#""attributes":{"POSITION":0}"#, plain),
        (r#""attributes":{"POSITION":0}"#, sparse),
        (r#""attributes":{"POSITION":0},"indices":1"#, &indexed),
    ] {
        let text = file(primitive, accessors);
        let error = read(text.as_bytes(), MeshFormat::Gltf, &mut |_| None).unwrap_err();
        assert!(error.message.ends_with("corners and has no data for them"), "{}", error.message);
    }
}

/// The memory limit grows with the size of the file, so a small file stays small.
#[test]
fn overlapping_elements_unfold_no_further_than_their_file_allows() {
    // One element a byte: elements that overlap because of the stride, all of them different.
    let bytes: Vec<u8> =
        (0..3_000_000_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8 & 0x3f).collect();
    let json = r#"{"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"bufferView":0,"componentType":5120,"count":2999990,"type":"VEC3"}],
        "bufferViews":[{"buffer":0,"byteLength":3000000,"byteStride":1}],
        "buffers":[{"byteLength":3000000,"uri":"a.bin"}]}"#;
    let mut side = |_: &str| Some(bytes.clone());
    let error = read_within(MeshLimits::default(), json.as_bytes(), MeshFormat::Gltf, &mut side)
        .unwrap_err();
    assert!(error.message.starts_with("the mesh unfolds to more than"), "{}", error.message);
}
