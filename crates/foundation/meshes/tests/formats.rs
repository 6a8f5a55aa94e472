//! Readers on small files with obvious results.

mod support;

use expect_test::{Expect, expect};
use periplus_meshes::{Mesh, MeshError, MeshFormat, read};
use support::show;

fn no_side_files(_: &str) -> Option<Vec<u8>> {
    None
}

fn load(bytes: &[u8], format: MeshFormat) -> Result<Mesh, MeshError> {
    read(bytes, format, &mut no_side_files)
}

fn check(format: MeshFormat, bytes: impl AsRef<[u8]>, expected: Expect) {
    let shown = load(bytes.as_ref(), format).map_or_else(|e| format!("error: {e}\n"), |m| show(&m));
    expected.assert_eq(&shown);
}

/// One binary STL triangle (0 0 0) (1 0 0) (0 1 0).
fn binary_stl(header: &[u8], count: u32, triangles: usize) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, b' ');
    bytes.extend(count.to_le_bytes());
    for _ in 0..triangles {
        for x in [0f32, 0., 1., 0., 0., 0., 1., 0., 0., 0., 1., 0.] {
            bytes.extend(x.to_le_bytes());
        }
        bytes.extend([0, 0]);
    }
    bytes
}

mod stl {
    use super::*;

    #[test]
    fn ascii_solids_are_submeshes() {
        let facet = "FACET NORMAL nan 0 0 outer loop\n vertex 0 0 0\nvertex 1 0 0 vertex 0 2e0 0
            endloop endfacet";
        let text =
            format!("solid left wheel\n{facet}\nendsolid left wheel\nsolid\n{facet} endsolid");
        check(
            MeshFormat::Stl,
            text,
            expect![[r#"
            `left wheel`
              (0 0 0) (1 0 0) (0 2 0)
            ``
              (0 0 0) (1 0 0) (0 2 0)
        "#]],
        );
    }

    #[test]
    fn equal_corners_become_one_vertex() {
        let mesh = load(&binary_stl(b"", 2, 2), MeshFormat::Stl).unwrap();
        assert_eq!((mesh.triangle_count(), mesh.vertex_count()), (2, 3));
    }

    #[test]
    fn binary_that_begins_with_solid_is_binary() {
        check(
            MeshFormat::Stl,
            binary_stl(b"solid facet endsolid", 1, 1),
            expect![[r#"
            ``
              (0 0 0) (1 0 0) (0 1 0)
        "#]],
        );
    }

    #[test]
    fn a_header_promising_four_billion_triangles_is_not_believed() {
        check(
            MeshFormat::Stl,
            binary_stl(b"", u32::MAX, 1),
            expect![[r#"
            error: byte 80: binary STL promises 4294967295 triangles (214748364834 bytes) but has 134 bytes; the file is cut short or not an STL: export or fetch it again
        "#]],
        );
    }

    #[test]
    fn trailing_bytes_are_noted() {
        check(
            MeshFormat::Stl,
            binary_stl(b"", 1, 2),
            expect![[r#"
            ``
              (0 0 0) (1 0 0) (0 1 0)
            note 1x: 50 bytes after the last triangle left out
        "#]],
        );
    }

    #[test]
    fn a_corner_that_is_not_a_number_is_refused() {
        let mut bytes = binary_stl(b"", 1, 1);
        bytes[96..100].copy_from_slice(&f32::NAN.to_le_bytes());
        check(
            MeshFormat::Stl,
            bytes,
            expect![[r#"
            error: byte 96: vertex position (NaN, 0, 0) is not finite; repair the mesh in a modelling program and export it again
        "#]],
        );
    }

    #[test]
    fn a_damaged_text_names_its_line() {
        check(
            MeshFormat::Stl,
            "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 y\n",
            expect![[r#"
            error: line 4: ASCII STL: expected a number, found `y`; the file is cut short or damaged: export it again, best as binary STL
        "#]],
        );
    }

    #[test]
    fn nothing_is_not_a_mesh() {
        check(
            MeshFormat::Stl,
            "",
            expect![[r#"
            error: byte 0: not an STL file: 0 bytes are too few; the file may be empty or a failed download: export or fetch it again
        "#]],
        );
        check(
            MeshFormat::Stl,
            "solid x\nendsolid x\n",
            expect![[r#"
            error: the file has no triangles; export the mesh with its faces, or refer to another file
        "#]],
        );
    }
}

mod obj {
    use super::*;

    #[test]
    fn groups_materials_negative_indices_and_polygons() {
        let text = "mtllib my colours.mtl\n\
            v 0 0 0\nv 1 0 0\nv 1 1 0 0.5 0.5 0.5\nv 0 1 0\n\
            o box\nusemtl red#1\nf -4//  -3// -2// -1//\n\
            g lid # comment\nf 1 \\\n 2 3\n\
            o box\nusemtl red#1\nf 1 3 4\n";
        let mtl = "newmtl red#1\nKd 1 0 0\nd 0.5\nmap_Kd -s 2 2 -clamp on my skin.png\n";
        let mut side_files = |file: &str| (file == "my colours.mtl").then(|| mtl.into());
        let mesh = read(text.as_bytes(), MeshFormat::Obj, &mut side_files).unwrap();
        expect![[r#"
            `box` [red#1 [1.0, 0.0, 0.0, 0.5] my skin.png]
              (0 0 0) (1 0 0) (1 1 0)
              (0 0 0) (1 1 0) (0 1 0)
              (0 0 0) (1 1 0) (0 1 0)
            `lid` [red#1 [1.0, 0.0, 0.0, 0.5] my skin.png]
              (0 0 0) (1 0 0) (1 1 0)
        "#]]
        .assert_eq(&show(&mesh));
    }

    #[test]
    fn corners_that_differ_in_texture_or_normal_are_vertices_of_their_own() {
        let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvn 0 0 2\n\
            f 1/1/1 2/1/1 3/1/1\nf 1/2/1 3/1/1 2/1/1\n";
        let mesh = load(text.as_bytes(), MeshFormat::Obj).unwrap();
        let part = &mesh.submeshes[0];
        assert_eq!(part.triangles, [[0, 1, 2], [3, 2, 1]]);
        assert_eq!(part.normals, Some(vec![[0.0, 0.0, 1.0]; 4]));
        assert_eq!(part.uvs.as_ref().unwrap()[3], [1.0, 0.0]);
    }

    #[test]
    fn a_face_may_stand_before_its_vertices() {
        check(
            MeshFormat::Obj,
            "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n",
            expect![[r#"
            ``
              (0 0 0) (1 0 0) (0 1 0)
        "#]],
        );
    }

    #[test]
    fn wrong_indices_name_the_line() {
        for (face, expected) in [
            (
                "f 1 2 4",
                expect![[r#"
                error: line 4: face refers to `v` number `4`, but the file has 3 of them; indices count from 1, or back from the face when negative; export the file again
            "#]],
            ),
            (
                "f 0 1 2",
                expect![[r#"
                error: line 4: face refers to `v` number `0`, but the file has 3 of them; indices count from 1, or back from the face when negative; export the file again
            "#]],
            ),
            (
                "f 1 -9223372036854775808 2",
                expect![[r#"
                error: line 4: face refers to `v` number `-9223372036854775808`, but the file has 3 of them; indices count from 1, or back from the face when negative; export the file again
            "#]],
            ),
        ] {
            check(MeshFormat::Obj, format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{face}\n"), expected);
        }
    }

    #[test]
    fn what_is_left_out_is_said() {
        let text =
            "mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\nl 1 2\nf 1 2\n";
        check(
            MeshFormat::Obj,
            text,
            expect![[r#"
            ``
              (0 0 0) (1 0 0) (0 1 0)
            note 1x: material file `gone.mtl` not found: parts have no colour
            note 1x: lines and points left out: only faces make a mesh
            note 1x: faces with fewer than three corners left out
        "#]],
        );
    }
}

mod formats {
    use super::*;

    #[test]
    fn the_extension_decides_and_then_the_bytes() {
        let of = |path: &str, bytes: &[u8]| MeshFormat::from_path_and_bytes(path, bytes);
        assert_eq!(of("a/b.c/Wheel.STL", b""), Ok(MeshFormat::Stl));
        assert_eq!(of("x.glb", b""), Ok(MeshFormat::Gltf));
        assert_eq!(of("fuel_download", b"<?xml?><COLLADA>"), Ok(MeshFormat::Collada));
        assert_eq!(
            of("robot.fbx", b"Kaydara").unwrap_err().to_string(),
            "mesh format `.fbx` is not supported; \
             convert it to one of: .stl, .obj, .dae, .gltf, .glb"
        );
    }

    #[test]
    fn a_misnamed_file_is_recognised() {
        let text = "<COLLADA version=\"1.4.1\">".to_owned() + &" ".repeat(99);
        let error = load(text.as_bytes(), MeshFormat::Stl).unwrap_err();
        assert!(error.message.ends_with("(it looks like Collada, not Stl)"), "{error}");
    }
}
