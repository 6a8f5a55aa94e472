//! Old spellings.

mod common;

use common::{Files, read, read_with, show, told};
use expect_test::expect;
use periplus_geometry::DVec3;
use periplus_scene::{SensorKind, Shape};

#[test]
fn the_attributes_of_1_0_are_read() {
    let scene = read(
        r#"<gazebo version="1.0"><model name="m" static="true"><origin pose="1 2 3 0 0 0"/>
          <link name="l" gravity="false"><damping><linear>0.1</linear></damping>
            <inertial mass="5"><inertia ixx="1" ixy="0" ixz="0" iyy="2" iyz="0" izz="2.5"/></inertial>
            <collision name="c"><geometry><box size="1 2 3"/></geometry>
              <surface><friction><ode mu="0.5" mu2="0.25"/></friction></surface></collision>
            <visual name="v"><geometry><mesh filename="a.dae" scale="2 2 2"/></geometry>
              <material script="Gazebo/Red"/></visual>
            <sensor name="s" type="ray" update_rate="10"><ray>
              <scan><horizontal samples="180" resolution="1" min_angle="-1" max_angle="1"/></scan>
              <range min="0.1" max="8"/></ray></sensor>
          </link></model></gazebo>"#,
    );
    let model = &scene.models[0];
    let link = &model.links[0];
    assert!(model.is_static && !link.gravity);
    assert_eq!(model.parent_from_model.translation, DVec3::new(1.0, 2.0, 3.0));
    assert_eq!(link.velocity_decay, [0.1, 0.0]);
    assert_eq!((link.inertial.mass_kg, link.inertial.inertia_kg_m2[3]), (5.0, 2.0));
    assert_eq!(link.collisions[0].shape, Shape::Box { size_m: DVec3::new(1.0, 2.0, 3.0) });
    assert_eq!(link.collisions[0].surface.friction.mu2, 0.25);
    let Shape::Mesh(mesh) = &link.visuals[0].shape else { panic!() };
    assert_eq!((mesh.uri.as_str(), mesh.scale.x), ("a.dae", 2.0));
    let script = link.visuals[0].material.as_ref().unwrap().script.as_ref().unwrap();
    assert_eq!(script.name, "Gazebo/Red");
    let SensorKind::Lidar(lidar) = &link.sensors[0].kind else { panic!() };
    assert_eq!((lidar.horizontal.samples, lidar.range_max_m), (180, 8.0));
}

#[test]
fn step_sizes_of_1_3_and_gravity_of_1_5_are_found() {
    let scene = read(
        r#"<sdf version="1.3"><world name="w"><physics type="ode">
          <update_rate>250</update_rate><gravity>0 0 -1.6</gravity>
          <ode><solver><type>quick</type><dt>0.004</dt></solver></ode>
        </physics></world></sdf>"#,
    );
    let world = &scene.worlds[0];
    assert_eq!(world.gravity_m_s2.z, -1.6);
    assert_eq!(world.physics[0].max_step_size_s, 0.004);
    assert_eq!(world.physics[0].real_time_update_rate_hz, 250.0);
}

fn axis_of(version: &str, flag: &str) -> DVec3 {
    let scene = read(&format!(
        r#"<sdf version="{version}"><model name="m"><link name="a"/>
          <link name="b"><pose>0 0 0 0 0 1.5707963267948966</pose></link>
          <joint name="j" type="revolute"><parent>a</parent><child>b</child>
            <axis><xyz>1 0 0</xyz>{flag}</axis></joint></model></sdf>"#
    ));
    scene.models[0].joints[0].axis.as_ref().expect("an axis").direction_in_joint
}

#[test]
fn axes_were_expressed_in_the_model_until_1_4() {
    let flag = "<use_parent_model_frame>true</use_parent_model_frame>";
    assert!(axis_of("1.4", "").distance(DVec3::NEG_Y) < 1e-12);
    assert!(axis_of("1.5", "").distance(DVec3::X) < 1e-12);
    assert!(axis_of("1.6", flag).distance(DVec3::NEG_Y) < 1e-12);
    assert!(axis_of("1.7", "").distance(DVec3::X) < 1e-12);
}

#[test]
fn the_frame_of_a_pose_was_an_attribute_of_that_name() {
    let scene = read(
        r#"<sdf version="1.6"><model name="m"><link name="a"><pose frame="">1 0 0 0 0 0</pose></link>
          <link name="b"><pose frame="a">1 0 0 0 0 0</pose></link></model></sdf>"#,
    );
    assert_eq!(scene.models[0].links[1].model_from_link.translation.x, 2.0);
}

#[test]
fn the_noise_of_an_imu_was_one_for_all_axes() {
    let scene = read(
        r#"<sdf version="1.5"><model name="m"><link name="l"><sensor name="s" type="imu"><imu>
          <noise><type>gaussian</type><rate><mean>0</mean><stddev>0.1</stddev></rate>
          <accel><mean>0</mean><stddev>0.2</stddev></accel></noise>
        </imu></sensor></link></model></sdf>"#,
    );
    let SensorKind::Imu(imu) = &scene.models[0].links[0].sensors[0].kind else { panic!() };
    assert!(imu.angular_velocity.iter().all(|noise| noise.stddev == 0.1));
    assert!(imu.linear_acceleration.iter().all(|noise| noise.stddev == 0.2));
}

#[test]
fn flattened_models_of_1_7_are_nested_again() {
    let scene = read(
        r#"<sdf version="1.7"><world name="w"><model name="m"><link name="base"/>
          <frame name="arm::__model__" attached_to="arm::upper"><pose>1 0 0 0 0 0</pose></frame>
          <link name="arm::upper"><pose relative_to="arm::__model__">0 0 1 0 0 0</pose></link>
          <link name="arm::lower"><pose relative_to="arm::upper">0 0 1 0 0 0</pose></link>
          <joint name="arm::elbow" type="fixed">
            <parent>arm::upper</parent><child>arm::lower</child></joint>
          <joint name="shoulder" type="fixed"><parent>base</parent><child>arm::upper</child></joint>
        </model></world></sdf>"#,
    );
    expect![[r#"
        model m (0 0 0) yaw 0
          link base (0 0 0) yaw 0
          joint shoulder base -> arm::upper (0 0 0) yaw 0
          model arm (1 0 0) yaw 0
            link upper (0 0 1) yaw 0
            link lower (0 0 2) yaw 0
            joint elbow upper -> lower (0 0 0) yaw 0
    "#]]
    .assert_eq(&show(&scene));
}

#[test]
fn numbers_that_mean_no_limit_are_infinite() {
    let scene = read(
        r#"<sdf version="1.6"><model name="m"><link name="a"/><link name="b"/>
          <joint name="j" type="revolute"><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz>
          <limit><lower>-1e+16</lower><upper>1e16</upper><effort>-1</effort>
          <velocity>-1</velocity></limit></axis></joint></model></sdf>"#,
    );
    let axis = scene.models[0].joints[0].axis.clone().unwrap();
    assert_eq!(axis, periplus_scene::Axis::default());
}

#[test]
fn a_saved_state_overrides_poses_inserts_and_deletes() {
    let (scene, diagnostics, sources) = read_with(
        r#"<sdf version="1.6"><world name="w">
          <model name="box"><pose>1 0 0 0 0 0</pose><link name="l"><pose>0 0 1 0 0 0</pose></link>
          </model>
          <model name="gone"><link name="l"/></model>
          <state world_name="w"><sim_time>1 0</sim_time>
            <insertions><model name="new"><link name="l"/></model></insertions>
            <deletions><name>gone</name></deletions>
            <model name="box"><pose>5 0 0 0 0 1.5707963267948966</pose><scale>1 1 1</scale>
              <link name="l"><pose>5 0 1 0 0 1.5707963267948966</pose>
                <velocity>0 0 0 0 0 0</velocity></link></model>
            <model name="boxx"><pose>5 0 0 0 0 0</pose></model>
          </state></world></sdf>"#,
        &mut Files::default(),
    );
    expect![[r#"
        model box (5 0 0) yaw 90
          link l (0 0 1) yaw 0
        model new (0 0 0) yaw 0
          link l (0 0 0) yaw 0
        warning[unknown-model]: the saved state names a model `boxx` that does not exist
          --> test.sdf:11:26
           |
        11 |             <model name="boxx"><pose>5 0 0 0 0 0</pose></model>
           |                          ^^^^
           |
        help: did you mean `box`?
           |
        11 -             <model name="boxx"><pose>5 0 0 0 0 0</pose></model>
        11 +             <model name="box"><pose>5 0 0 0 0 0</pose></model>
           |
    "#]]
    .assert_eq(&format!("{}{}", show(&scene), told(&diagnostics, &sources)));
}

#[test]
fn a_population_stands_in_rows() {
    let scene = read(
        r#"<sdf version="1.6"><world name="w"><population name="p"><pose>10 0 0 0 0 0</pose>
          <model name="can"><link name="l"/></model>
          <distribution><type>grid</type><rows>2</rows><cols>2</cols><step>1 2 0</step></distribution>
        </population></world></sdf>"#,
    );
    let places: Vec<_> = scene.worlds[0]
        .models
        .iter()
        .map(|it| (it.name.as_str(), it.parent_from_model.translation.to_array()))
        .collect();
    assert_eq!(
        places,
        [
            ("can_clone_0", [9.5, -1.0, 0.0]),
            ("can_clone_1", [10.5, -1.0, 0.0]),
            ("can_clone_2", [9.5, 1.0, 0.0]),
            ("can_clone_3", [10.5, 1.0, 0.0]),
        ]
    );
}

#[test]
fn a_random_population_is_the_same_at_every_reading() {
    let text = r#"<sdf version="1.6"><world name="w"><population name="p">
      <model name="can"><link name="l"/></model><model_count>50</model_count>
      <cylinder><radius>2</radius><length>1</length></cylinder>
      <distribution><type>random</type></distribution></population></world></sdf>"#;
    let scene = read(text);
    assert_eq!(scene, read(text));
    let models = &scene.worlds[0].models;
    assert_eq!(models.len(), 50);
    assert!(models.iter().all(|it| it.parent_from_model.translation.truncate().length() <= 2.0));
}
