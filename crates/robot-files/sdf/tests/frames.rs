//! Frames that poses are relative to.

mod common;

use common::{findings, model, read, show};
use expect_test::{Expect, expect};
use periplus_geometry::DVec3;

fn check(content: &str, expected: Expect) {
    expected.assert_eq(&show(&read(&model(content))));
}

fn check_findings(content: &str, expected: Expect) {
    expected.assert_eq(&findings(&model(content)));
}

#[test]
fn chains_of_frames_add_up() {
    check(
        r#"<link name="a"><pose relative_to="f">1 0 0 0 0 0</pose></link>
           <frame name="f"><pose relative_to="g">0 0 0 0 0 1.5707963267948966</pose></frame>
           <frame name="g"><pose>0 0 5 0 0 0</pose></frame>"#,
        expect![[r#"
            model m (0 0 0) yaw 0
              link a (0 1 5) yaw 90
              frame f on __model__ (0 0 5) yaw 90
              frame g on __model__ (0 0 5) yaw 0
        "#]],
    );
}

#[test]
fn a_rotated_frame_turns_what_hangs_on_it() {
    check(
        r#"<link name="a"><pose degrees="true">0 0 0 0 0 90</pose></link>
           <link name="b"><pose relative_to="a">1 0 0 0 0 0</pose></link>
           <frame name="f" attached_to="b"><pose>1 0 0 0 0 0</pose></frame>"#,
        expect![[r#"
            model m (0 0 0) yaw 0
              link a (0 0 0) yaw 90
              link b (0 1 0) yaw 90
              frame f on b (0 2 0) yaw 90
        "#]],
    );
}

#[test]
fn a_joint_lies_in_its_child_and_links_may_lie_in_a_joint() {
    check(
        r#"<link name="base"/>
           <link name="wheel"><pose relative_to="axle">0 0 0 0 0 0</pose></link>
           <joint name="axle" type="fixed">
             <pose relative_to="base">1 2 3 0 0 0</pose>
             <parent>base</parent><child>wheel</child>
           </joint>
           <joint name="in_child" type="fixed">
             <pose>0 0 1 0 0 0</pose><parent>base</parent><child>wheel</child>
           </joint>
           <frame name="tip" attached_to="in_child"/>"#,
        expect![[r#"
            model m (0 0 0) yaw 0
              link base (0 0 0) yaw 0
              link wheel (1 2 3) yaw 0
              joint axle base -> wheel (0 0 0) yaw 0
              joint in_child base -> wheel (0 0 1) yaw 0
              frame tip on in_child (1 2 4) yaw 0
        "#]],
    );
}

#[test]
fn names_reach_into_nested_models() {
    check(
        r#"<link name="a"><pose relative_to="arm::hand::grip">1 0 0 0 0 0</pose></link>
           <model name="arm"><pose>0 0 1 0 0 0</pose><link name="l"/>
             <model name="hand"><pose>0 0 10 0 0 0</pose><link name="l"/>
               <frame name="grip"><pose>0 0 100 0 0 0</pose></frame>
             </model>
           </model>"#,
        expect![[r#"
            model m (0 0 0) yaw 0
              link a (1 0 111) yaw 0
              model arm (0 0 1) yaw 0
                link l (0 0 0) yaw 0
                model hand (0 0 10) yaw 0
                  link l (0 0 0) yaw 0
                  frame grip on __model__ (0 0 100) yaw 0
        "#]],
    );
}

#[test]
fn the_placement_frame_is_what_the_pose_places() {
    check(
        r#"<link name="a"/>
           <model name="cup" placement_frame="handle"><pose>5 0 0 0 0 0</pose><link name="l"/>
             <frame name="handle"><pose>1 0 0 0 0 0</pose></frame>
           </model>"#,
        expect![[r#"
            model m (0 0 0) yaw 0
              link a (0 0 0) yaw 0
              model cup (4 0 0) yaw 0
                link l (0 0 0) yaw 0
                frame handle on __model__ (1 0 0) yaw 0
        "#]],
    );
}

#[test]
fn parts_of_links_may_lie_in_other_frames() {
    let scene = read(&model(
        r#"<link name="a"><pose>0 0 1 0 0 0</pose>
             <sensor name="s" type="camera"><pose relative_to="f"/>
               <camera name="c"><horizontal_fov>1</horizontal_fov>
             <pose relative_to="a">0 0 7 0 0 0</pose></camera></sensor>
             <light name="l"><pose relative_to="__model__"/></light>
           </link>
           <frame name="f"><pose>2 0 0 0 0 0</pose></frame>"#,
    ));
    let link = &scene.models[0].links[0];
    assert_eq!(link.sensors[0].parent_from_sensor.translation, DVec3::new(2.0, 0.0, -1.0));
    assert_eq!(link.lights[0].parent_from_light.translation, DVec3::new(0.0, 0.0, -1.0));
    let periplus_scene::SensorKind::Camera(camera) = &link.sensors[0].kind else { panic!() };
    assert_eq!(camera.sensor_from_camera.translation, DVec3::new(-2.0, 0.0, 8.0));
}

#[test]
fn axes_turn_into_the_frame_of_their_joint() {
    let scene = read(&model(
        r#"<link name="a"/><link name="b"><pose degrees="true">0 0 0 0 0 90</pose></link>
           <joint name="j" type="revolute"><parent>a</parent><child>b</child>
             <axis><xyz expressed_in="__model__">2 0 0</xyz></axis></joint>"#,
    ));
    let axis = scene.models[0].joints[0].axis.as_ref().unwrap();
    assert!(axis.direction_in_joint.distance(DVec3::NEG_Y) < 1e-12);
}

#[test]
fn the_canonical_link_is_the_first_own_link_or_else_the_first_nested_one() {
    let canonical = |content: &str| read(&model(content)).models[0].canonical_link.clone();
    let nested = r#"<model name="n"><link name="inner"/></model>"#;
    let own = r#"<link name="own"/>"#;
    assert_eq!(canonical(&format!("{nested}{own}")).as_deref(), Some("own"));
    assert_eq!(canonical(nested).as_deref(), Some("n::inner"));
    assert_eq!(canonical("<static>true</static>"), None);
}

#[test]
fn frames_in_a_circle_are_told() {
    check_findings(
        r#"<link name="a"/>
<frame name="f"><pose relative_to="g"/></frame>
<frame name="g" attached_to="f"/>"#,
        expect![[r#"
            error[frame-cycle]: these frames form a cycle
             --> test.sdf:3:30
              |
            2 | <frame name="f"><pose relative_to="g"/></frame>
              |                                    - `f` depends on this
            3 | <frame name="g" attached_to="f"/></model></sdf>
              |                              ^
              |
              = note: `f` -> `g` -> `f` depends on itself
        "#]],
    );
}

#[test]
fn attachments_in_a_circle_are_told_though_poses_are_fine() {
    check_findings(
        r#"<link name="a"/>
<frame name="f" attached_to="f"><pose relative_to="a"/></frame>"#,
        expect![[r#"
            error[frame-cycle]: these frames form a cycle
             --> test.sdf:2:30
              |
            2 | <frame name="f" attached_to="f"><pose relative_to="a"/></frame></model></sdf>
              |                              ^
              |
              = note: `f` -> `f` depends on itself
        "#]],
    );
}

#[test]
fn unknown_frames_are_told_with_the_known_ones() {
    check_findings(
        r#"<link name="chassis"/><frame name="lidar_frame"/>
<link name="lidar"><pose relative_to="lidar_fram">0 0 0 0 0 0</pose></link>"#,
        expect![[r#"
            error[unknown-frame]: there is no frame `lidar_fram` here
             --> test.sdf:2:39
              |
            2 | <link name="lidar"><pose relative_to="lidar_fram">0 0 0 0 0 0</pose></link></model></sdf>
              |                                       ^^^^^^^^^^
              |
              = note: frames here are `__model__`, `chassis`, `lidar`, `lidar_frame`
            help: did you mean `lidar_frame`?
              |
            2 | <link name="lidar"><pose relative_to="lidar_frame">0 0 0 0 0 0</pose></link></model></sdf>
              |                                                 +
        "#]],
    );
}

#[test]
fn long_chains_need_no_deep_stack() {
    let mut content = String::from(r#"<link name="l"/><frame name="f0"/>"#);
    for index in 1..20_000 {
        let pose = format!(r#"<pose relative_to="f{}">1 0 0 0 0 0</pose>"#, index - 1);
        content.push_str(&format!(r#"<frame name="f{index}">{pose}</frame>"#));
    }
    // The last one first, so that the whole chain is open at once.
    content.push_str(r#"<frame name="a"><pose relative_to="f19999"/></frame>"#);
    let scene = read(&model(&content));
    let last = scene.models[0].frames.last().unwrap();
    assert_eq!(last.parent_from_frame.translation.x, 19_999.0);
}
