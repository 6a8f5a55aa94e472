//! Conversions of whole files, with answers that can be read.

use expect_test::{Expect, expect};
use periplus_resources::{MemoryHost, Resolver};

use crate::{Migrated, MigrationContext, MigrationOutcome, bridge_yaml, migrate};

fn migrated_at(path: &str, text: &str, host: &MemoryHost) -> Migrated {
    let resolver = Resolver::new(host, &[]);
    let context = MigrationContext {
        has_ros_control: true,
        ..MigrationContext::new(path.as_ref(), host, &resolver)
    };
    migrate(text, &context).expect("XML")
}

fn migrated(text: &str) -> Migrated {
    migrated_at("/robot.urdf.xacro", text, &MemoryHost::new())
}

fn check(text: &str, expected: &Expect) {
    expected.assert_eq(&migrated(text).text);
}

#[test]
fn expressions_of_a_macro_survive() {
    check(
        r#"<robot xmlns:xacro="http://ros.org/wiki/xacro">
  <!-- Kept. -->
  <xacro:macro name="drive" params="separation radius prefix">
    <gazebo>
      <plugin name="drive" filename="libgazebo_ros_diff_drive.so">
        <left_joint>${prefix}left</left_joint>
        <right_joint>${prefix}right</right_joint>
        <wheel_separation>${separation}</wheel_separation>
        <wheel_diameter>${2 * radius}</wheel_diameter>
        <odometry_source>0</odometry_source>
        <publish_odom>true</publish_odom>
        <publish_odom_tf>true</publish_odom_tf>
      </plugin>
    </gazebo>
  </xacro:macro>
</robot>"#,
        &expect![[r#"
            <robot xmlns:xacro="http://ros.org/wiki/xacro">
              <!-- Kept. -->
              <xacro:macro name="drive" params="separation radius prefix">
                <gazebo>
                  <plugin filename="gz-sim-diff-drive-system" name="gz::sim::systems::DiffDrive">
                    <left_joint>${prefix}left</left_joint>
                    <right_joint>${prefix}right</right_joint>
                    <wheel_separation>${separation}</wheel_separation>
                    <wheel_radius>${radius}</wheel_radius>
                    <topic>/cmd_vel</topic>
                    <odom_publish_frequency>100</odom_publish_frequency>
                    <odom_topic>/odom</odom_topic>
                    <tf_topic>/tf</tf_topic>
                    <frame_id>odom</frame_id>
                    <child_frame_id>base_footprint</child_frame_id>
                  </plugin>
                </gazebo>
              </xacro:macro>
            </robot>"#]],
    );
}

#[test]
fn a_lidar_publishes_its_topic_in_the_frame_of_its_link() {
    check(
        r#"<robot name="r">
  <gazebo reference="laser">
    <material>Gazebo/Red</material>
    <sensor type="ray" name="lidar">
      <update_rate>40</update_rate>
      <ray><range><max>5</max></range></ray>
      <plugin name="p" filename="libgazebo_ros_laser.so">
        <topicName>scan</topicName>
        <robotNamespace>/bot</robotNamespace>
        <updateRate>10</updateRate>
      </plugin>
    </sensor>
  </gazebo>
</robot>"#,
        &expect![[r#"
            <robot name="r">
              <gazebo reference="laser">
                <visual>
                  <material>
                    <ambient>1 0 0 1</ambient>
                    <diffuse>1 0 0 1</diffuse>
                    <specular>0.1 0.1 0.1 1</specular>
                  </material>
                </visual>
                <sensor type="gpu_lidar" name="lidar">
                  <update_rate>10</update_rate>
                  <lidar><range><max>5</max></range></lidar>
                  <topic>/bot/scan</topic>
                  <gz_frame_id>laser</gz_frame_id>
                  <always_on>true</always_on>
                </sensor>
              </gazebo>
            </robot>"#]],
    );
}

#[test]
fn a_plugin_that_measures_a_link_becomes_a_sensor_of_it() {
    check(
        r#"<robot name="r">
  <gazebo>
    <plugin name="imu" filename="libgazebo_ros_imu.so">
      <bodyName>imu_link</bodyName>
      <topicName>imu</topicName>
      <updateRate>50</updateRate>
    </plugin>
  </gazebo>
  <transmission name="t">
    <joint name="j"><hardwareInterface>hardware_interface/VelocityJointInterface</hardwareInterface></joint>
  </transmission>
</robot>"#,
        &expect![[r#"
            <robot name="r">
              <gazebo reference="imu_link">
                <sensor name="imu" type="imu">
                  <topic>/imu</topic>
                  <gz_frame_id>imu_link</gz_frame_id>
                  <always_on>true</always_on>
                  <update_rate>50</update_rate>
                  <imu>
                    <orientation_reference_frame>
                      <localization>ENU</localization>
                    </orientation_reference_frame>
                  </imu>
                </sensor>
              </gazebo>
              <ros2_control name="t" type="system">
                <hardware>
                  <plugin>gz_ros2_control/GazeboSimSystem</plugin>
                </hardware>
                <joint name="j">
                  <command_interface name="velocity"/>
                  <state_interface name="position"/>
                  <state_interface name="velocity"/>
                </joint>
              </ros2_control>
            </robot>"#]],
    );
}

#[test]
fn a_world_runs_systems_and_has_its_saved_poses() {
    let text = r#"<sdf version="1.6">
  <world name="w">
    <include><uri>model://sun</uri></include>
    <model name="box"><pose>0 0 0 0 0 0</pose><link name="l"/></model>
    <population name="p"><model_count>2</model_count>
      <box><size>2 1 1</size></box><distribution><type>linear-x</type></distribution>
      <model name="can"><link name="l"/></model></population>
    <state world_name="w"><model name="box"><pose>1 2 3 0 0 0</pose></model></state>
  </world>
</sdf>"#;
    let migrated = migrated_at("/w.world", text, &MemoryHost::new());
    let new = &migrated.text;
    for part in [
        "gz::sim::systems::Physics",
        "<render_engine>ogre2</render_engine>",
        "<light name=\"sun\" type=\"directional\">",
        "<pose>1 2 3 0 0 0</pose>",
        "<model name=\"can_clone_0\">",
        "<pose>-1 0 0 0 0 0</pose>",
        "<model name=\"can_clone_1\">",
    ] {
        assert!(new.contains(part), "{part} is missing in\n{new}");
    }
    for part in ["model://sun", "<state", "<population"] {
        assert!(!new.contains(part), "{part} is left in\n{new}");
    }
    // A converted world has nothing left to convert.
    let again = migrated_at("/w.world", new, &MemoryHost::new());
    assert_eq!(again.text, *new);
}

#[test]
fn a_texture_of_a_script_becomes_an_albedo_map() {
    let host = MemoryHost::new()
        .with_file("/ws/wall/model.config", "<model><name>wall</name></model>")
        .with_file(
            "/ws/wall/materials/scripts/wall.material",
            "material Wall/Brick\n{\n technique\n {\n pass\n {\n texture_unit\n {\n texture b.png\n }\n }\n }\n}",
        )
        .with_file("/ws/wall/materials/textures/b.png", "");
    let text =
        "<sdf version='1.6'><model name='wall'><link name='l'><visual name='v'><material><script>
        <uri>model://wall/materials/scripts</uri><uri>model://wall/materials/textures</uri>
        <name>Wall/Brick</name></script></material></visual></link></model></sdf>";
    let migrated = migrated_at("/ws/wall/model.sdf", text, &host);
    let map = "<albedo_map>model://wall/materials/textures/b.png</albedo_map>";
    assert!(migrated.text.contains(map), "{}", migrated.text);
}

#[test]
fn files_for_harmonic_stay_as_they_are() {
    let text = "<sdf version='1.9'><world name='w'>
        <plugin filename='gz-sim-physics-system' name='gz::sim::systems::Physics'/>
        <gui><plugin filename='MinimalScene' name='3D View'/></gui>
        <model name='m'><link name='l'><sensor name='s' type='gpu_lidar'><topic>scan</topic></sensor></link>
        <plugin filename='gz-sim-diff-drive-system' name='gz::sim::systems::DiffDrive'/></model>
        </world></sdf>";
    let migrated = migrated_at("/w.sdf", text, &MemoryHost::new());
    assert_eq!(migrated.text, text);
    assert!(migrated.entries.is_empty(), "{:?}", migrated.entries);
}

#[test]
fn what_has_no_counterpart_is_named_with_a_reason() {
    let migrated = migrated(
        "<robot name='r'><gazebo><plugin name='p' filename='libmine.so'/></gazebo></robot>",
    );
    assert_eq!(migrated.entries[0].outcome, MigrationOutcome::NoCounterpart);
    assert!(migrated.text.contains("<!-- Removed: plugin libmine.so;"), "{}", migrated.text);
}

#[test]
fn names_of_a_depth_camera_are_kept_by_the_bridge() {
    let migrated = migrated(
        "<robot name='r'><gazebo reference='camera'><sensor name='kinect' type='depth'><camera/>
         <plugin name='p' filename='libgazebo_ros_openni_kinect.so'><cameraName>head</cameraName>
         <depthImageTopicName>depth/raw</depthImageTopicName><frameName>optical</frameName>
         </plugin></sensor></gazebo></robot>",
    );
    let yaml = bridge_yaml(&migrated.bridge);
    for pair in [
        "\"/head/depth/raw\"\n  gz_topic_name: \"/head/depth_image\"",
        "\"/head/points\"\n  gz_topic_name: \"/head/points\"",
    ] {
        assert!(yaml.contains(pair), "{pair} is missing in\n{yaml}");
    }
    assert!(
        migrated.text.contains("<optical_frame_id>optical</optical_frame_id>"),
        "{}",
        migrated.text
    );
    assert!(migrated.text.contains("type='rgbd_camera'"), "{}", migrated.text);
}

/// Files that are cut off anywhere: many are no XML any more, and none may cause a panic.
#[test]
fn cut_off_files_are_refused_or_converted() {
    let sdf = "<?xml version='1.0'?><sdf version='1.4'><world name='wörld'><include>
        <uri>model://sun</uri></include><state world_name='wörld'><model name='m'><pose>1 2</pose>
        <link name='l'><pose/></link></model></state><model name='m'><pose/><link name='l'>
        <inertial/><sensor type='ray' name='é'><ray/><topic>~/x</topic>
        <plugin filename='libgazebo_ros_laser.so'/></sensor></link></model></world></sdf>";
    let launch = "<launch><arg name='é' default='$(find p)/x'/><node pkg='gazebo_ros' name='n'
        type='spawn_model' args='-model $(arg é) -J a'/><group if='$(eval é == (1)'>
        <include file='$(find gazebo_ros)/launch/x'/></group></launch>";
    let python = "import os\nx = [Node(package='gazebo_ros', executable='spawn_entity.py',
        arguments=['-entity', \"é\"]), IncludeLaunchDescription('gazebo.launch.py',
        launch_arguments={'world': 'é'}.items()),  # é
        ExecuteProcess(cmd=['gzserver', '''é'''])]";
    let script = "material Wall/é { technique { pass { ambient 1 1 1 diffuse é } } }";
    for text in [sdf, launch, python, script] {
        for (at, _) in text.char_indices() {
            let cut = &text[..at];
            let host = MemoryHost::new();
            let resolver = Resolver::new(&host, &[]);
            let context = MigrationContext::new("/w.world".as_ref(), &host, &resolver);
            let _ = migrate(cut, &context);
            let _ = crate::migrate_launch(cut, "a.launch");
            let _ = crate::migrate_python_launch(cut, "a.launch.py");
            let _ = crate::ogre::find_material(cut, "Wall/é");
        }
    }
}
