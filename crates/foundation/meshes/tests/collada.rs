//! COLLADA documents put together piece by piece, so that each test contains only the relevant
//! elements.

mod support;

use expect_test::{Expect, expect};
use periplus_meshes::{MeshFormat, MeshLimits, UpAxis, read, read_within};
use support::show;

/// A unit square in the xy plane, wound anticlockwise, as a source `#at` with
/// vertices `#v`.
const SQUARE: &str = r##"
  <source id="at"><float_array id="a" count="12">0 0 0  1 0 0  1 1 0  0 1 0</float_array>
    <technique_common><accessor source="#a" count="4" stride="3">
      <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
    </accessor></technique_common></source>
  <vertices id="v"><input semantic="POSITION" source="#at"/></vertices>"##;

const TRIANGLE: &str = r##"<triangles count="1" material="paint">
  <input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>"##;

fn geometry(primitives: &str) -> String {
    format!(
        r#"<library_geometries><geometry id="g" name="shape"><mesh>{SQUARE}{primitives}</mesh>
        </geometry></library_geometries>"#
    )
}

fn document(libraries: &str, nodes: &str) -> String {
    format!(
        r##"<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema">
        {libraries}<library_visual_scenes><visual_scene id="s">{nodes}</visual_scene>
        </library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>"##
    )
}

const INSTANCE: &str = r##"<instance_geometry url="#g"/>"##;

fn check(text: &str, expected: Expect) {
    let mesh = read(text.as_bytes(), MeshFormat::Collada, &mut |_| None);
    expected.assert_eq(&mesh.map_or_else(|e| format!("error: {e}\n"), |mesh| show(&mesh)));
}

fn check_primitive(primitive: &str, expected: Expect) {
    check(&document(&geometry(primitive), &format!("<node name='n'>{INSTANCE}</node>")), expected);
}

fn check_transform(transform: &str, expected: Expect) {
    let node = format!("<node name='n'>{transform}{INSTANCE}</node>");
    let primitive = TRIANGLE.replace("material=\"paint\"", "");
    check(&document(&geometry(&primitive), &node), expected);
}

#[test]
fn unit_scales_and_up_axis_does_not_turn() {
    let asset = r#"<asset><unit name="centimetre" meter="0.01"/><up_axis>Y_UP</up_axis></asset>"#;
    let node = format!("<node name='n'><translate>0 0 100</translate>{INSTANCE}</node>");
    let text = document(&(asset.to_owned() + &geometry(TRIANGLE)), &node);
    let mesh = read(text.as_bytes(), MeshFormat::Collada, &mut |_| None).unwrap();
    assert_eq!(mesh.declared_up, Some(UpAxis::Y));
    expect![[r#"
        `n`
          (0 0 1) (0.01 0 1) (0.01 0.01 1)
        note 1x: `<up_axis>` other than Z_UP has no effect, as in Gazebo and RViz
        note 1x: material `paint` is bound to nothing
    "#]]
    .assert_eq(&show(&mesh));
}

#[test]
fn a_unit_that_is_no_length_is_refused() {
    let text = document(r#"<asset><unit meter="-1"/></asset>"#, "");
    check(
        &text,
        expect![[r#"
        error: line 2: `<unit>`: `meter="-1"` is not a length; export the COLLADA file again, or repair it by hand
    "#]],
    );
}

#[test]
fn polylist_and_polygons_and_trifans_make_two_triangles_of_a_square() {
    let input = r##"<input semantic="VERTEX" source="#v" offset="0"/>"##;
    for primitive in [
        format!("<polylist count='1'>{input}<vcount>4</vcount><p>0 1 2 3</p></polylist>"),
        format!("<polygons count='1'>{input}<p>0 1 2 3</p></polygons>"),
        format!("<trifans count='1'>{input}<p>0 1 2 3</p></trifans>"),
        format!("<triangles count='2'>{input}<p>0 1 2 0 2 3</p></triangles>"),
    ] {
        check_primitive(
            &primitive,
            expect![[r#"
            `n`
              (0 0 0) (1 0 0) (1 1 0)
              (0 0 0) (1 1 0) (0 1 0)
        "#]],
        );
    }
}

#[test]
fn strips_keep_their_winding() {
    let input = r##"<input semantic="VERTEX" source="#v" offset="0"/>"##;
    check_primitive(
        &format!("<tristrips count='1'>{input}<p>0 1 3 2</p></tristrips>"),
        expect![[r#"
        `n`
          (0 0 0) (1 0 0) (0 1 0)
          (0 1 0) (1 0 0) (1 1 0)
    "#]],
    );
}

#[test]
fn several_primitives_and_lines() {
    let lines = r##"<lines count="1"><input semantic="VERTEX" source="#v" offset="0"/>
        <p>0 1</p></lines>"##;
    let plain = TRIANGLE.replace("material=\"paint\"", "");
    check_primitive(
        &format!("{plain}{lines}{plain}"),
        expect![[r#"
        `n`
          (0 0 0) (1 0 0) (1 1 0)
        `n`
          (0 0 0) (1 0 0) (1 1 0)
        note 1x: lines left out: only faces make a mesh
    "#]],
    );
}

#[test]
fn transforms_apply_in_document_order() {
    check_transform(
        "<translate>10 0 0</translate><rotate>0 0 2 90</rotate><scale>2 3 1</scale>",
        expect![[r#"
        `n`
          (10 0 0) (10 2 0) (7 2 0)
    "#]],
    );
    check_transform(
        "<matrix>1 0 0 5  0 1 0 6  0 0 1 7  0 0 0 1</matrix>",
        expect![[r#"
        `n`
          (5 6 7) (6 6 7) (6 7 7)
    "#]],
    );
    // From (5,0,0) towards the origin with z up: right is +y, up +z, back +x.
    check_transform(
        "<lookat>5 0 0  0 0 0  0 0 1</lookat>",
        expect![[r#"
        `n`
          (5 0 0) (5 1 0) (5 1 1)
    "#]],
    );
    check_transform(
        "<lookat>5 0 0  5 0 0  0 0 1</lookat>",
        expect![[r#"
        error: line 9: `<lookat>`: eye, target and up direction do not make a frame; export the COLLADA file again, or repair it by hand
    "#]],
    );
}

#[test]
fn a_mirror_keeps_the_outside_outside() {
    // Mirrored in x, the corners run the other way round and are turned back.
    check_transform(
        "<scale>-1 1 1</scale>",
        expect![[r#"
        `n`
          (0 0 0) (-1 1 0) (-1 0 0)
    "#]],
    );
}

#[test]
fn instanced_nodes_take_the_name_of_the_nearest_named_node() {
    let library = format!(
        r#"{}<library_nodes><node id="leg"><translate>0 0 1</translate>{INSTANCE}</node>
        </library_nodes>"#,
        geometry(&TRIANGLE.replace("material=\"paint\"", ""))
    );
    let nodes = r##"<node name="table"><node><translate>1 0 0</translate><instance_node url="#leg"/>
        </node></node><node><instance_node url="#leg"/><instance_node url="#arm"/></node>"##;
    check(
        &document(&library, nodes),
        expect![[r#"
        `table`
          (1 0 1) (2 0 1) (2 1 1)
        `unnamed_submesh_0`
          (0 0 1) (1 0 1) (1 1 1)
        note 1x: `<instance_node>` left out: `#arm` is not in the file
    "#]],
    );
}

#[test]
fn a_skin_stands_in_its_bind_pose() {
    let library = geometry(&TRIANGLE.replace("material=\"paint\"", ""))
        + r##"<library_controllers><controller id="c"><skin source="#g">
            <bind_shape_matrix>2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1</bind_shape_matrix>
            </skin></controller></library_controllers>"##;
    let node =
        r##"<node name="n"><translate>0 0 9</translate><instance_controller url="#c"/></node>"##;
    check(
        &document(&library, node),
        expect![[r#"
        `n`
          (0 0 9) (2 0 9) (2 2 9)
        note 1x: skin or morph target loaded in its bind pose, without animation
    "#]],
    );
}

#[test]
fn materials_by_binding_sampler_and_surface() {
    let library = geometry(TRIANGLE)
        + r##"<library_images><image id="i"><init_from>wood%20grain.png</init_from></image></library_images>
        <library_materials><material id="m" name="Wood"><instance_effect url="#e"/></material></library_materials>
        <library_effects><effect id="e"><profile_COMMON>
          <newparam sid="surf"><surface type="2D"><init_from>i</init_from></surface></newparam>
          <newparam sid="samp"><sampler2D><source>surf</source></sampler2D></newparam>
          <technique sid="t"><phong><diffuse>PLACE</diffuse></phong></technique>
        </profile_COMMON></effect></library_effects>"##;
    let node = r##"<node name="n"><instance_geometry url="#g"><bind_material><technique_common>
        <instance_material symbol="paint" target="#m"/></technique_common></bind_material>
        </instance_geometry></node>"##;
    let text = document(&library, node);
    check(
        &text.replace("PLACE", "<color>0.5 0.25 0 1</color>"),
        expect![[r#"
        `n` [Wood [0.5, 0.25, 0.0, 1.0]]
          (0 0 0) (1 0 0) (1 1 0)
    "#]],
    );
    for texture in ["samp", "i"] {
        check(
            &text.replace("PLACE", &format!("<texture texture='{texture}'/>")),
            expect![[r#"
            `n` [Wood [1.0, 1.0, 1.0, 1.0] wood%20grain.png]
              (0 0 0) (1 0 0) (1 1 0)
        "#]],
        );
    }
}

#[test]
fn accessors_skip_unnamed_parameters_and_honour_offset() {
    let source = SQUARE
        .replace("0 0 0  1 0 0  1 1 0  0 1 0", "7 7  0 9 0 0  1 9 0 0  1 9 1 0")
        .replace("stride=\"3\"", "stride=\"4\" offset=\"2\"")
        .replace("<param name=\"Y\"", "<param/><param name=\"Y\"");
    let text = document(
        &geometry(&TRIANGLE.replace("material=\"paint\"", "")),
        &format!("<node name='n'>{INSTANCE}</node>"),
    );
    check(
        &text.replace(SQUARE, &source),
        expect![[r#"
        `n`
          (0 0 0) (1 0 0) (1 1 0)
    "#]],
    );
}

#[test]
fn hostile_numbers_are_refused_with_their_line() {
    let node = format!("<node name='n'>{INSTANCE}</node>");
    for (from, to, expected) in [
        (
            "<p>0 1 2</p>",
            "<p>0 1 4</p>",
            expect![[r#"
                error: line 8: `<p>`: vertex number 4 does not exist: the source has 4; export the COLLADA file again, or repair it by hand
            "#]],
        ),
        (
            "<p>0 1 2</p>",
            "<p>0 1 -2</p>",
            expect![[r#"
                error: line 8: `<p>`: `-2` is not a valid number here; export the COLLADA file again, or repair it by hand
            "#]],
        ),
        (
            "stride=\"3\"",
            "stride=\"2\"",
            expect![[r#"
            error: line 4: `<accessor>`: stride 2 is too small for 3 numbers; export the COLLADA file again, or repair it by hand
        "#]],
        ),
        (
            "stride=\"3\"",
            "stride=\"18446744073709551615\"",
            expect![[r#"
                error: line 8: `<p>`: vertex number 1 does not exist: the source has 0; export the COLLADA file again, or repair it by hand
            "#]],
        ),
        (
            "offset=\"0\"",
            "offset=\"4294967295\"",
            expect![[r#"
                error: line 8: `<input>`: offset 4294967295 is beyond any real file; export the COLLADA file again, or repair it by hand
            "#]],
        ),
        (
            "1 1 0",
            "1 1 1.#QNAN",
            expect![[r#"
                error: line 8: vertex position (1, 1, NaN) is not finite; repair the mesh in a modelling program and export it again
            "#]],
        ),
    ] {
        check(&document(&geometry(TRIANGLE), &node).replace(from, to), expected);
    }
}

#[test]
fn a_node_that_instances_itself_ends() {
    let library = r##"<library_nodes><node id="a"><instance_node url="#b"/></node>
        <node id="b"><instance_node url="#a"/></node></library_nodes>"##;
    check(
        &document(library, "<node><instance_node url='#a'/></node>"),
        expect![[r#"
        error: scene nodes are nested more than 128 deep; look for a node that contains or instances itself
    "#]],
    );
}

#[test]
fn forty_levels_of_doubling_end_at_the_budget() {
    let mut library = geometry(TRIANGLE) + "<library_nodes><node id='n0'>" + INSTANCE + "</node>";
    for i in 1..=40 {
        let below = i - 1;
        library += &format!(
            "<node id='n{i}'><instance_node url='#n{below}'/><instance_node url='#n{below}'/></node>"
        );
    }
    let text =
        document(&(library + "</library_nodes>"), "<node><instance_node url='#n40'/></node>");
    let limits = MeshLimits { visits_max: 1000, ..MeshLimits::default() };
    let error =
        read_within(limits, text.as_bytes(), MeshFormat::Collada, &mut |_| None).unwrap_err();
    assert_eq!(error.message, "the scene unfolds to more than 1000 nodes");
    let limits = MeshLimits { triangles_max: 100, ..MeshLimits::default() };
    let error =
        read_within(limits, text.as_bytes(), MeshFormat::Collada, &mut |_| None).unwrap_err();
    assert_eq!(error.message, "the mesh has more than 100 triangles");
}

#[test]
fn deep_nesting_and_many_attributes_do_not_hurt() {
    let deep = "<a>".repeat(200_000);
    check(
        &format!("<COLLADA>{deep}"),
        expect![[r#"
        error: line 1: `<a>` is never closed; export the COLLADA file again, or repair it by hand
    "#]],
    );
    let wide: String = (0..50_000).map(|i| format!(" a{i}='1' xmlns:n{i}='n'")).collect();
    check(
        &format!("<COLLADA{wide}/>"),
        expect![[r#"
        error: the file has no triangles; export the mesh with its faces, or refer to another file
    "#]],
    );
}

#[test]
fn a_flood_of_elements_is_stopped() {
    let text = format!("<COLLADA>{}</COLLADA>", "<a/>".repeat(10_000));
    let limits = MeshLimits { bytes_max: 1 << 20, ..MeshLimits::default() };
    let error =
        read_within(limits, text.as_bytes(), MeshFormat::Collada, &mut |_| None).unwrap_err();
    assert_eq!(error.message, "the mesh unfolds to more than 1 MiB");
}

#[test]
fn text_that_is_no_collada_says_so() {
    check(
        "<html></html>",
        expect![[r#"
        error: line 1: the root element is `<html>`, not `<COLLADA>`; export the COLLADA file again, or repair it by hand
    "#]],
    );
    check(
        "<COLLADA>\n<a></b>",
        expect![[r#"
        error: line 2: not well-formed XML: ill-formed document: expected `</a>`, but `</b>` was found; export the COLLADA file again, or repair it by hand
    "#]],
    );
    let latin = document(&geometry(TRIANGLE), "<node name='T\u{fc}r'/>").into_bytes();
    assert!(read(&latin, MeshFormat::Collada, &mut |_| None).is_err());
}

#[test]
fn old_encodings_are_read() {
    let text = document(&geometry(TRIANGLE), &format!("<node name='Tür'>{INSTANCE}</node>"));
    let named = |bytes: &[u8]| {
        read(bytes, MeshFormat::Collada, &mut |_| None).unwrap().submeshes[0].name.clone()
    };
    let latin: Vec<u8> = text
        .replace("<?xml version=\"1.0\"?>", "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>")
        .chars()
        .map(|c| u8::try_from(c).unwrap())
        .collect();
    let utf16: Vec<u8> =
        [0xFEFF].into_iter().chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect();
    assert_eq!((named(&latin).as_str(), named(&utf16).as_str()), ("Tür", "Tür"));
}
