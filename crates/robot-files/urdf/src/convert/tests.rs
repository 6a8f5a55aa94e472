//! Conversion of Gazebo's settings and merged links.

use std::fmt::Write as _;

use expect_test::{Expect, expect};
use periplus_diagnostics::{Diagnostics, RenderStyle, SourceMap, render};
use periplus_geometry::format_number;
use periplus_scene::{Model, Pose, SensorKind};
use periplus_sdf::{NoIncludes, SdfContext};

use crate::{ConversionOptions, read, to_model};

/// A body of 1 kg.
const BODY: &str = "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' \
                    izz='1'/></inertial>";
const BALL: &str = "<collision><geometry><sphere radius='1'/></geometry></collision>";

fn convert(content: &str) -> (Model, Diagnostics, SourceMap) {
    let mut sources = SourceMap::new();
    let text = format!("<robot name='r'>{content}</robot>");
    let file = sources.add("r.urdf", text.replace("BODY", BODY).replace("BALL", BALL));
    let mut diagnostics = Diagnostics::new();
    let document = periplus_xml::parse(file, &sources, &mut diagnostics).unwrap();
    let robot = read(&document, &mut diagnostics).unwrap();
    let mut context = SdfContext {
        sources: &mut sources,
        diagnostics: &mut diagnostics,
        includes: &mut NoIncludes,
    };
    let model = to_model(&robot, ConversionOptions::default(), &mut context);
    (model, diagnostics, sources)
}

fn fixed(parent: &str, child: &str, xyz: &str) -> String {
    format!(
        "<joint name='{parent}_{child}' type='fixed'><origin xyz='{xyz}'/><parent \
         link='{parent}'/><child link='{child}'/></joint>"
    )
}

fn at(pose: Pose) -> String {
    pose.translation.to_array().map(format_number).join(" ")
}

/// Bodies, joints and frames, one a line.
fn outline(model: &Model) -> String {
    let mut out = String::new();
    for link in &model.links {
        let mass = format_number(link.inertial.mass_kg);
        let centre = at(link.inertial.link_from_inertial);
        let place = at(link.model_from_link);
        let _ = writeln!(out, "link {} at {place}: {mass} kg at {centre}", link.name);
        for one in &link.collisions {
            let _ = writeln!(out, "  {} at {}", one.name, at(one.link_from_collision));
        }
        for one in &link.visuals {
            let _ = writeln!(out, "  {} at {}", one.name, at(one.link_from_visual));
        }
        for one in &link.sensors {
            let _ = writeln!(out, "  sensor {} at {}", one.name, at(one.parent_from_sensor));
        }
        for one in &link.lights {
            let _ = writeln!(out, "  light {} at {}", one.name, at(one.parent_from_light));
        }
    }
    for joint in &model.joints {
        let _ = writeln!(
            out,
            "joint {} {:?}: {} - {}",
            joint.name, joint.kind, joint.parent, joint.child
        );
    }
    for frame in &model.frames {
        let _ = writeln!(
            out,
            "frame {} {:?} on {} at {}",
            frame.name,
            frame.role,
            frame.attached_to,
            at(frame.parent_from_frame)
        );
    }
    out
}

fn check(content: &str, expected: Expect) {
    let (model, diagnostics, sources) = convert(content);
    let mut out = outline(&model);
    for one in diagnostics.iter() {
        let shown = render(one, &sources, RenderStyle::Plain);
        out.push_str(shown.lines().next().unwrap_or_default());
        out.push('\n');
    }
    expected.assert_eq(&out);
}

#[test]
fn a_fixed_link_is_merged_and_stays_a_frame() {
    check(
        &format!(
            "<link name='base'>BODY BALL</link><link name='mast'>BODY BALL</link>{}",
            fixed("base", "mast", "0 0 2")
        ),
        expect![[r#"
            link base at 0 0 0: 2 kg at 0 0 1
              base_collision at 0 0 0
              base_fixed_joint_lump__mast_collision_1 at 0 0 2
            frame base_mast MergedJoint on base at 0 0 2
            frame mast MergedLink on base_mast at 0 0 2
        "#]],
    );
}

#[test]
fn merged_twice_with_a_sensor_and_a_light() {
    check(
        &format!(
            "<link name='foot'/><link name='base'>BODY</link><link name='eye'>BALL</link>{}{}\
             <gazebo reference='eye'><sensor name='scan' type='imu'><pose>0 0 1 0 0 0</pose>\
             </sensor><sensor name='plain' type='imu'/><light name='lamp' type='point'/></gazebo>",
            fixed("foot", "base", "0 0 1"),
            fixed("base", "eye", "1 0 0")
        ),
        expect![[r#"
            link foot at 0 0 0: 1 kg at 0 0 1
              foot_fixed_joint_lump__eye_collision at 1 0 1
              sensor scan at 1 0 2
              sensor plain at 1 0 1
              light lamp at 1 0 1
            frame foot_base MergedJoint on foot at 0 0 1
            frame base MergedLink on foot_base at 0 0 1
            frame base_eye MergedJoint on base at 1 0 1
            frame eye MergedLink on base_eye at 1 0 1
        "#]],
    );
}

#[test]
fn a_wheel_hangs_on_the_link_that_the_file_names() {
    check(
        &format!(
            "<link name='foot'/><link name='base'>BODY</link><link name='wheel'>BODY</link>{}\
             <joint name='spin' type='continuous'><origin xyz='0 1 0'/><parent link='base'/>\
             <child link='wheel'/><axis xyz='0 2 0'/></joint>",
            fixed("foot", "base", "0 0 1"),
        ),
        expect![[r#"
            link foot at 0 0 0: 1 kg at 0 0 1
            link wheel at 0 1 1: 1 kg at 0 0 0
            joint spin Continuous: base - wheel
            frame foot_base MergedJoint on foot at 0 0 1
            frame base MergedLink on foot_base at 0 0 1
        "#]],
    );
}

#[test]
fn a_robot_on_the_world_keeps_its_joint() {
    check(
        &format!(
            "<link name='world'/><link name='base'>BODY</link><link name='tool'/>{}{}",
            fixed("world", "base", "0 0 1"),
            fixed("base", "tool", "1 0 0")
        ),
        expect![[r#"
            link base at 0 0 1: 1 kg at 0 0 0
            joint world_base Fixed: world - base
            frame base_tool MergedJoint on base at 1 0 1
            frame tool MergedLink on base_tool at 1 0 1
        "#]],
    );
}

#[test]
fn preserved_and_disabled() {
    check(
        &format!(
            "<link name='a'>BODY</link><link name='b'>BODY</link><link name='c'>BODY</link>{}{}\
             <gazebo reference='a_b'><preserveFixedJoint>true</preserveFixedJoint></gazebo>\
             <gazebo reference='a_c'><disableFixedJointLumping>1</disableFixedJointLumping></gazebo>",
            fixed("a", "b", "1 0 0"),
            fixed("a", "c", "2 0 0")
        ),
        expect![[r#"
            link a at 0 0 0: 1 kg at 0 0 0
            link b at 1 0 0: 1 kg at 0 0 0
            link c at 2 0 0: 1 kg at 0 0 0
            joint a_b Fixed: a - b
            joint a_c Revolute: a - c
        "#]],
    );
}

#[test]
fn a_link_without_mass_is_lost_only_behind_a_joint_that_moves() {
    check(
        &format!(
            "<link name='a'>BODY</link><link name='b'>BALL</link><link name='c'>BODY</link>\
             <joint name='spin' type='continuous'><origin xyz='0 0 1'/><parent link='a'/>\
             <child link='b'/></joint>{}\
             <link name='d'>BALL</link>{}\
             <gazebo reference='a_d'><preserveFixedJoint>true</preserveFixedJoint></gazebo>\
             <link name='e'/><joint name='turn' type='continuous'><parent link='a'/>\
             <child link='e'/></joint>",
            fixed("b", "c", "1 0 0").replace("fixed", "continuous"),
            fixed("a", "d", "2 0 0"),
        ),
        expect![[r#"
            link a at 0 0 0: 1 kg at 0 0 0
              a_fixed_joint_lump__d_collision at 2 0 0
            frame a_d MergedJoint on a at 2 0 0
            frame d MergedLink on a_d at 2 0 0
            frame spin MergedJoint on a at 0 0 1
            frame b MergedLink on spin at 0 0 1
            frame b_c MergedJoint on b at 1 0 1
            frame c MergedLink on b_c at 1 0 1
            frame turn MergedJoint on a at 0 0 0
            frame e MergedLink on turn at 0 0 0
            warning[massless-link]: the link `d` has no mass, so its fixed joint is not kept
            warning[massless-link]: the link `b` has no mass, and its joint `spin` does not merge it into another
            warning[massless-link]: the link `e` has no mass, and its joint `turn` does not merge it into another
        "#]],
    );
}

#[test]
fn a_robot_without_mass_can_only_be_shown() {
    check(
        "<link name='a'>BALL</link>",
        expect![[r#"
        frame a MergedLink on __model__ at 0 0 0
        warning[massless-link]: the root link `a` has no mass, and nothing merges into it
    "#]],
    );
}

#[test]
fn settings_of_a_merged_link_stay_with_its_shapes() {
    let (model, diagnostics, _) = convert(&format!(
        "<link name='base'>BODY BALL<visual><geometry><sphere radius='1'/></geometry></visual>\
         </link><link name='base_pad'>BALL<visual><geometry><sphere radius='1'/></geometry>\
         </visual></link>{}\
         <gazebo reference='base'><mu1>0.1</mu1><mu2>0.2</mu2><material>Gazebo/Red</material>\
         <turnGravityOff>true</turnGravityOff><selfCollide>yes</selfCollide></gazebo>\
         <gazebo reference='base_pad'><mu1 value='0.5'/><kp>1e5</kp><kd>2</kd><maxVel>3</maxVel>\
         <minDepth>0.004</minDepth><fdir1>1 0 0</fdir1><maxContacts>7</maxContacts>\
         <laserRetro>9</laserRetro><collision><surface><friction><ode><slip1>6</slip1></ode>\
         </friction></surface></collision><visual><transparency>0.5</transparency></visual>\
         </gazebo>",
        fixed("base", "base_pad", "0 0 1")
    ));
    assert!(diagnostics.is_empty(), "{diagnostics:?}");
    let base = &model.links[0];
    assert!(!base.gravity && base.self_collide);
    let [own, pad] = [0, 1].map(|index| &base.collisions[index]);
    assert_eq!((own.surface.friction.mu, own.surface.friction.mu2), (0.1, 0.2));
    assert_eq!((own.max_contacts, own.laser_retro), (10, 0.0));
    let (friction, contact) = (&pad.surface.friction, &pad.surface.contact);
    assert_eq!((friction.mu, friction.slip1, friction.fdir1.x), (0.5, 6.0, 1.0));
    assert_eq!((contact.kp, contact.kd), (1e5, 2.0));
    assert_eq!((contact.max_vel_m_s, contact.min_depth_m), (3.0, 0.004));
    assert_eq!((pad.max_contacts, pad.laser_retro), (7, 9.0));
    let red = base.visuals[0].material.as_ref().and_then(|look| look.script.as_ref()).unwrap();
    assert_eq!(red.name, "Gazebo/Red");
    assert_eq!(base.visuals[1].material, None);
    assert_eq!(base.visuals[1].transparency, 0.5);
}

#[test]
fn settings_of_joints_and_robot() {
    let (model, diagnostics, _) = convert(
        "<link name='a'>BODY</link><link name='b'>BODY</link><link name='c'>BODY</link>\
         <joint name='lead' type='prismatic'><parent link='a'/><child link='b'/>\
         <limit lower='1' upper='-1' effort='3' velocity='4'/>\
         <dynamics damping='0.5' friction='0.25'/></joint>\
         <joint name='follow' type='continuous'><parent link='a'/><child link='c'/>\
         <mimic joint='lead' multiplier='2' offset='3'/><safety_controller k_velocity='5'/></joint>\
         <gazebo reference='lead'><springStiffness>7</springStiffness>\
         <springReference>8</springReference><stopCfm>0.1</stopCfm><provideFeedback>1\
         </provideFeedback><sensor name='force' type='force_torque'/></gazebo>\
         <gazebo><static>true</static><plugin name='p' filename='libp.so'><x>1</x></plugin>\
         </gazebo><transmission name='t'/><ros2_control name='c'/>",
    );
    let codes: Vec<_> = diagnostics.iter().map(|one| one.code).collect();
    assert_eq!(codes, ["swapped-limits"]);
    assert!(model.is_static);
    assert_eq!(model.plugins[0].value("x").as_deref(), Some("1"));
    let kept: Vec<&str> = model.extra.iter().map(|extra| &*extra.name).collect();
    assert_eq!(kept, ["transmission", "ros2_control"]);
    let lead = model.joint("lead").unwrap();
    let axis = lead.axis.as_ref().unwrap();
    assert_eq!((axis.lower, axis.upper, axis.effort, axis.velocity), (-1.0, 1.0, 3.0, 4.0));
    assert_eq!((axis.damping, axis.friction), (0.5, 0.25));
    assert_eq!((axis.spring_stiffness, axis.spring_reference), (7.0, 8.0));
    assert_eq!(axis.direction_in_joint.to_array(), [1.0, 0.0, 0.0]);
    assert_eq!(lead.sensors[0].name, "force");
    assert_eq!(lead.extra[0].name, "physics");
    let follow = model.joint("follow").unwrap();
    let mimic = follow.axis.as_ref().unwrap().mimic.as_ref().unwrap();
    assert_eq!((&*mimic.joint, mimic.multiplier, mimic.offset), ("lead", 2.0, 3.0));
    assert_eq!(follow.extra[0].name, "safety_controller");
}

#[test]
fn misplaced_settings_are_told() {
    let codes = |content: &str| {
        let (_, diagnostics, _) = convert(content);
        diagnostics.iter().map(|one| one.code).collect::<Vec<_>>()
    };
    let robot = |block: &str| {
        format!(
            "<link name='a'>BODY BALL</link><link name='b'/>{}{block}",
            fixed("a", "b", "0 0 0")
        )
    };
    assert_eq!(codes(&robot("<gazebo><mu1>1</mu1></gazebo>")), ["misplaced-setting"]);
    assert_eq!(codes(&robot("<gazebo reference='a'><mu>1</mu></gazebo>")), ["misplaced-setting"]);
    assert_eq!(
        codes(&robot("<gazebo reference='a'><static>1</static></gazebo>")),
        ["misplaced-setting"]
    );
    assert_eq!(
        codes(&robot("<gazebo reference='a_b'><provideFeedback>1</provideFeedback></gazebo>")),
        ["merged-joint"]
    );
    assert_eq!(codes(&robot("<gazebo reference='c'><mu1>1</mu1></gazebo>")), ["unknown-reference"]);
    assert_eq!(codes(&robot("<gazebo reference='a'><mu1>slippy</mu1></gazebo>")).len(), 1);
    assert_eq!(
        codes(&robot(
            "<gazebo reference='a'><turnGravityOff>0</turnGravityOff></gazebo>\
             <gazebo reference='b'><turnGravityOff>1</turnGravityOff></gazebo>"
        )),
        ["lumped-setting"]
    );
}

#[test]
fn colours_are_brightened_and_named_and_textures_kept() {
    let (model, diagnostics, _) = convert(
        "<material name='dim'><color rgba='0.4 0 1 0.5'/></material>\
         <material name='wood'><texture filename='package://p/wood.png'/></material>\
         <link name='a'>BODY<visual><geometry><sphere radius='1'/></geometry>\
         <material name='dim'/></visual><visual><geometry><sphere radius='1'/></geometry>\
         <material name='wood'/></visual></link>",
    );
    assert!(diagnostics.is_empty(), "{diagnostics:?}");
    let look = |index: usize| model.links[0].visuals[index].material.as_ref().unwrap();
    assert_eq!(look(0).name.as_deref(), Some("dim"));
    assert_eq!(look(0).diffuse.unwrap().0, [0.5, 0.0, 1.0, 0.5]);
    assert_eq!(look(0).ambient, look(0).diffuse);
    let map = look(1).pbr.as_ref().and_then(|pbr| pbr.albedo_map.as_deref());
    assert_eq!(map, Some("package://p/wood.png"));
}

#[test]
fn contact_sensors_find_merged_collisions() {
    let (model, _, _) = convert(&format!(
        "<link name='base'>BODY BALL</link><link name='bumper'>BALL</link>{}\
         <gazebo reference='bumper'><sensor name='touch' type='contact'><contact>\
         <collision>bumper_collision</collision></contact></sensor></gazebo>",
        fixed("base", "bumper", "1 0 0")
    ));
    let SensorKind::Contact { collisions, .. } = &model.links[0].sensors[0].kind else {
        panic!("{:?}", model.links[0].sensors)
    };
    assert_eq!(collisions, &["base_fixed_joint_lump__bumper_collision_1"]);
}

#[test]
fn a_joint_named_like_a_link_is_renamed() {
    check(
        "<link name='a'>BODY</link><link name='arm'>BODY</link>\
         <joint name='arm' type='continuous'><parent link='a'/><child link='arm'/></joint>",
        expect![[r#"
            link a at 0 0 0: 1 kg at 0 0 0
            link arm at 0 0 0: 1 kg at 0 0 0
            joint arm_joint Continuous: a - arm
            warning[shared-name]: a link and a joint are both named `arm`
        "#]],
    );
}

#[test]
fn floating_joints_are_kept_though_gazebo_has_none() {
    check(
        "<link name='a'>BODY</link><link name='b'>BODY</link>\
         <joint name='free' type='floating'><origin xyz='1 0 0'/><parent link='a'/>\
         <child link='b'/></joint>",
        expect![[r#"
            link a at 0 0 0: 1 kg at 0 0 0
            link b at 1 0 0: 1 kg at 0 0 0
            joint free Floating: a - b
            warning[not-in-gazebo]: Gazebo has no joint of the kind of `free`, and refuses the robot
        "#]],
    );
}

#[test]
fn settings_are_merged_once_per_link() {
    let block = "<gazebo reference='a'><mu1>0.1</mu1><kp>1e5</kp><mu1>0.2</mu1><collision>\
                 <surface><friction><ode><slip1>6</slip1></ode></friction></surface></collision>\
                 <maxContacts>3</maxContacts><material>Gazebo/Red</material></gazebo>";
    let visual = "<visual><geometry><sphere radius='1'/></geometry></visual>";
    let body = format!("<link name='a'>BODY {}{}</link>", "BALL".repeat(3000), visual.repeat(3000));
    let (model, diagnostics, _) = convert(&format!("{body}{}", block.repeat(3000)));
    assert!(diagnostics.is_empty(), "{diagnostics:?}");
    let link = &model.links[0];
    assert_eq!((link.collisions.len(), link.visuals.len()), (3000, 3000));
    for one in &link.collisions {
        let (friction, contact) = (&one.surface.friction, &one.surface.contact);
        assert_eq!((friction.mu, friction.slip1, contact.kp), (0.2, 6.0, 1e5));
        assert_eq!(one.max_contacts, 3);
    }
    let robot = {
        let mut sources = SourceMap::new();
        let text = format!("<robot name='r'>{body}{}</robot>", block.repeat(3000));
        let file = sources.add("r.urdf", text.replace("BODY", BODY).replace("BALL", BALL));
        let mut diagnostics = Diagnostics::new();
        let document = periplus_xml::parse(file, &sources, &mut diagnostics).unwrap();
        read(&document, &mut diagnostics).unwrap()
    };
    // The settings of each shape are as short as those of one block: `surface` and `max_contacts`.
    let situation = super::ConversionState::new(&robot, ConversionOptions::default());
    let settings = situation.shape_settings(&robot.links[0]).unwrap();
    assert_eq!((settings.collision.len(), settings.visual.len()), (2, 1));
    let red = |look: &periplus_scene::Material| look.script.as_ref().unwrap().name == "Gazebo/Red";
    assert!(link.visuals.iter().all(|one| one.material.as_ref().is_some_and(red)));
}

#[test]
fn too_many_copies_of_settings_are_refused() {
    let plugins = "<plugin name='p' filename='p'/>".repeat(1000);
    let content = format!(
        "<link name='a'>BODY {}</link><gazebo reference='a'><collision>{plugins}</collision></gazebo>",
        "BALL".repeat(1000)
    );
    let (model, diagnostics, _) = convert(&content);
    assert_eq!(model.links[0].collisions.len(), 1000);
    let codes: Vec<_> = diagnostics.iter().map(|one| one.code).collect();
    assert_eq!(codes, ["too-many-settings"]);
}
