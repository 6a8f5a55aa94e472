//! Includes.
#![allow(clippy::disallowed_methods, reason = "one test measures time")]

mod common;

use std::time::Instant;

use common::{Files, read_with, show, told};
use expect_test::{Expect, expect};

const CUP: &str = r#"<sdf version="1.9"><model name="cup">
  <pose>9 9 9 0 0 0</pose><link name="body"/>
  <frame name="handle"><pose>1 0 0 0 0 0</pose></frame>
</model></sdf>"#;

fn world(content: &str) -> String {
    format!("<sdf version=\"1.9\"><world name=\"w\">{content}</world></sdf>")
}

fn check(content: &str, mut files: Files, expected: Expect) {
    let (scene, diagnostics, sources) = read_with(&world(content), &mut files);
    expected.assert_eq(&format!("{}{}", show(&scene), told(&diagnostics, &sources)));
}

#[test]
fn an_include_overrides_name_and_pose() {
    check(
        r#"<include><uri>cup</uri></include>
           <include><uri>cup</uri><name>two</name><pose>1 2 3 0 0 0</pose></include>
           <include><uri>cup</uri><name>three</name><pose>5 0 0 0 0 0</pose>
             <placement_frame>handle</placement_frame></include>"#,
        Files::default().with("cup", CUP),
        expect![[r#"
            model cup (9 9 9) yaw 0
              link body (0 0 0) yaw 0
              frame handle on __model__ (1 0 0) yaw 0
            model two (1 2 3) yaw 0
              link body (0 0 0) yaw 0
              frame handle on __model__ (1 0 0) yaw 0
            model three (4 0 0) yaw 0
              link body (0 0 0) yaw 0
              frame handle on __model__ (1 0 0) yaw 0
        "#]],
    );
}

#[test]
fn a_merged_model_leaves_only_a_frame() {
    let arm = r#"<sdf version="1.9"><model name="arm">
        <link name="upper"/><link name="lower"><pose relative_to="upper">0 0 1 0 0 0</pose></link>
        <joint name="elbow" type="fixed"><parent>upper</parent><child>lower</child></joint>
        <frame name="mount"><pose>0 0 2 0 0 0</pose></frame>
      </model></sdf>"#;
    check(
        r#"<model name="robot"><link name="base"/>
             <include merge="true"><uri>arm</uri><pose relative_to="base">7 0 0 0 0 0</pose></include>
           </model>"#,
        Files::default().with("arm", arm),
        expect![[r#"
            model robot (0 0 0) yaw 0
              link base (0 0 0) yaw 0
              link upper (7 0 0) yaw 0
              link lower (7 0 1) yaw 0
              joint elbow upper -> lower (0 0 0) yaw 0
              frame _merged__arm__model__ on upper (7 0 0) yaw 0
              frame mount on _merged__arm__model__ (7 0 2) yaw 0
        "#]],
    );
}

#[test]
fn the_sun_and_the_ground_are_built_in() {
    check(
        r#"<include><uri>model://sun</uri></include>
           <include><uri>model://ground_plane</uri></include>"#,
        Files::default(),
        expect![[r#"
            model ground_plane (0 0 0) yaw 0
              link link (0 0 0) yaw 0
            light sun (0 0 10) yaw 0
        "#]],
    );
}

#[test]
fn a_missing_model_is_told_and_the_world_still_loads() {
    check(
        r#"
<include><uri>model://table</uri></include>
<model name="box"><link name="l"/></model>"#,
        Files::default(),
        expect![[r#"
            model box (0 0 0) yaw 0
              link l (0 0 0) yaw 0
            error[missing-include]: `model://table` is not found
             --> test.sdf:2:15
              |
            2 | <include><uri>model://table</uri></include>
              |               ^^^^^^^^^^^^^
              |
              = note: looked at /models/model://table
        "#]],
    );
}

#[test]
fn a_circle_of_includes_is_told_with_its_chain() {
    let includes = |uri: &str| {
        format!(
            r#"<sdf version="1.9"><model name="x"><link name="l"/>
<include><uri>{uri}</uri></include></model></sdf>"#
        )
    };
    check(
        "<include><uri>a</uri></include>",
        Files::default().with("a", includes("b")).with("b", includes("a")),
        expect![[r#"
            model x (0 0 0) yaw 0
              link l (0 0 0) yaw 0
              model x (0 0 0) yaw 0
                link l (0 0 0) yaw 0
            error[include-cycle]: this file includes itself
             --> b:2:15
              |
            2 | <include><uri>a</uri></include></model></sdf>
              |               ^
              |
             ::: a:2:15
              |
            2 | <include><uri>b</uri></include></model></sdf>
              |               - included here
              |
             ::: test.sdf:1:50
              |
            1 | <sdf version="1.9"><world name="w"><include><uri>a</uri></include></world></sdf>
              |                                                  - included here
              |
              = note: a -> b -> a
        "#]],
    );
}

#[test]
fn a_bomb_of_includes_is_defused() {
    let mut files = Files::default();
    for level in 0..10 {
        let mut content = String::from(r#"<link name="l"/>"#);
        for index in 0..10 {
            let uri = format!("level{}", level + 1);
            content.push_str(&format!("<include><uri>{uri}</uri><name>n{index}</name></include>"));
        }
        files = files.with(
            &format!("level{level}"),
            format!(r#"<sdf version="1.9"><model name="m">{content}</model></sdf>"#),
        );
    }
    files = files.with("level10", CUP);
    let start = Instant::now();
    let text = world("<include><uri>level0</uri></include>");
    let (_, diagnostics, _) = read_with(&text, &mut files);
    assert!(diagnostics.iter().any(|it| it.code == "too-many-includes"));
    assert!(start.elapsed().as_secs() < 20, "{:?}", start.elapsed());
}

#[test]
fn findings_in_an_included_file_are_told_once() {
    let odd = r#"<sdf version="1.9"><model name="odd"><link name="l"/><colour/></model></sdf>"#;
    let text = world(
        r#"<include><uri>odd</uri><name>a</name></include>
           <include><uri>odd</uri><name>b</name></include>"#,
    );
    let (scene, diagnostics, _) = read_with(&text, &mut Files::default().with("odd", odd));
    assert_eq!(scene.worlds[0].models.len(), 2);
    assert_eq!(diagnostics.iter().count(), 1);
}

/// A host that turns other formats into models.
struct Robots;

impl periplus_sdf::IncludeResolver for Robots {
    fn open(
        &mut self,
        uri: &str,
        _: periplus_diagnostics::Origin,
        _: &mut periplus_diagnostics::SourceMap,
        _: &mut periplus_diagnostics::Diagnostics,
    ) -> periplus_sdf::IncludeTarget {
        let mut model = periplus_scene::Model::new("robot");
        model.links = vec![periplus_scene::Link::new("base"), periplus_scene::Link::new("hand")];
        model.links[1].model_from_link = periplus_geometry::Pose::from_xyz(1.0, 0.0, 0.0);
        let mut joint =
            periplus_scene::Joint::new("wrist", periplus_scene::JointKind::Fixed, "base", "hand");
        joint.child_from_joint = periplus_geometry::Pose::from_xyz(0.0, 0.0, 2.0);
        model.joints = vec![joint];
        model.frames = vec![periplus_scene::NamedFrame {
            name: "tool".into(),
            parent_from_frame: periplus_geometry::Pose::from_xyz(1.0, 0.0, 3.0),
            attached_to: "hand".into(),
            role: periplus_scene::FrameRole::MergedLink,
            origin: periplus_diagnostics::Origin::default(),
        }];
        periplus_sdf::IncludeTarget::Model { model: Box::new(model), key: uri.into() }
    }
}

#[test]
fn a_model_of_another_format_keeps_its_frames() {
    let mut sources = periplus_diagnostics::SourceMap::new();
    let mut diagnostics = periplus_diagnostics::Diagnostics::new();
    let text = world(
        r#"<include><uri>robot.urdf</uri><name>r</name><pose>0 0 1 0 0 0</pose>
             <placement_frame>tool</placement_frame></include>"#,
    );
    let file = sources.add("test.sdf", text);
    let document = periplus_xml::parse(file, &sources, &mut diagnostics).unwrap();
    let mut context = periplus_sdf::SdfContext {
        sources: &mut sources,
        diagnostics: &mut diagnostics,
        includes: &mut Robots,
    };
    let scene = periplus_sdf::read_document(&document, &mut context);
    expect![[r#"
        model r (-1 0 -2) yaw 0
          link base (0 0 0) yaw 0
          link hand (1 0 0) yaw 0
          joint wrist base -> hand (0 0 2) yaw 0
          frame tool on hand (1 0 3) yaw 0
    "#]]
    .assert_eq(&format!("{}{}", show(&scene), told(&diagnostics, &sources)));
}
