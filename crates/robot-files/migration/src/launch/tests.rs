//! Conversions of launch files.

use expect_test::expect;

use super::{migrate_launch, migrate_python_launch};

#[test]
fn a_simulation_is_started_filled_and_bridged() {
    let launch = migrate_launch(
        r#"<launch>
  <arg name="gui" default="true"/>
  <arg name="model" default="$(find my_robot)/urdf/robot.urdf.xacro"/>
  <include file="$(find gazebo_ros)/launch/empty_world.launch">
    <arg name="world_name" value="$(find my_robot)/worlds/room.world"/>
    <arg name="gui" value="$(arg gui)"/>
  </include>
  <param name="robot_description" command="$(find xacro)/xacro --inorder $(arg model)"/>
  <node name="spawn" pkg="gazebo_ros" type="spawn_model" args="-urdf -model bot -param robot_description -z 0.1"/>
  <node name="rsp" pkg="robot_state_publisher" type="robot_state_publisher">
    <param name="publish_frequency" type="double" value="30"/>
  </node>
  <node name="base" pkg="tf" type="static_transform_publisher" args="0 0 0 0 0 0 map odom 100"/>
</launch>"#,
        "robot.launch",
    )
    .unwrap();
    expect![[r#"
        from launch import LaunchDescription
        from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
        from launch.launch_description_sources import PythonLaunchDescriptionSource
        from launch.substitutions import Command, LaunchConfiguration, PythonExpression, ThisLaunchFileDir
        from launch_ros.actions import Node
        from launch_ros.parameter_descriptions import ParameterValue
        from launch_ros.substitutions import FindPackageShare


        def generate_launch_description():
            return LaunchDescription([
                DeclareLaunchArgument(
                    'bridge_config',
                    default_value=[ThisLaunchFileDir(), '/ros_gz_bridge.yaml'],
                    description='Topics between Gazebo and ROS',
                ),
                DeclareLaunchArgument('gui', default_value='true'),
                DeclareLaunchArgument(
                    'model',
                    default_value=[FindPackageShare('my_robot'), '/urdf/robot.urdf.xacro'],
                ),
                IncludeLaunchDescription(
                    PythonLaunchDescriptionSource([FindPackageShare('ros_gz_sim'), '/launch/gz_sim.launch.py']),
                    launch_arguments={'gz_args': ['-r ', PythonExpression(["'' if '", LaunchConfiguration('gui'), "'.lower() in ('true', '1') else '-s '"]), FindPackageShare('my_robot'), '/worlds/room.world']}.items(),
                ),
                Node(
                    package='ros_gz_sim',
                    executable='create',
                    name='spawn',
                    arguments=['-name', 'bot', '-topic', 'robot_description', '-z', '0.1'],
                ),
                Node(
                    package='robot_state_publisher',
                    executable='robot_state_publisher',
                    name='rsp',
                    parameters=[{'publish_frequency': 30.0}, {'robot_description': ParameterValue(Command(['xacro ', LaunchConfiguration('model')]), value_type=str)}],
                ),
                Node(
                    package='tf2_ros',
                    executable='static_transform_publisher',
                    name='base',
                    arguments=['0', '0', '0', '0', '0', '0', 'map', 'odom'],
                ),
                Node(
                    package='ros_gz_bridge',
                    executable='parameter_bridge',
                    parameters=[{'config_file': LaunchConfiguration('bridge_config')}],
                    output='screen',
                ),
            ])
    "#]]
    .assert_eq(&launch.text);
    assert_eq!(
        launch.references,
        ["package://my_robot/worlds/room.world", "package://my_robot/urdf/robot.urdf.xacro"]
    );
}

#[test]
fn arguments_with_several_words_are_split_when_they_are_known() {
    let launch = migrate_launch(
        r#"<launch><arg name="at" default="-x 1 -y 2"/>
        <node name="s" pkg="gazebo_ros" type="spawn_model" args="-model m -param d $(arg at)"/></launch>"#,
        "a.launch",
    )
    .unwrap();
    let call = "arguments=words(context, ['-name m -topic d ', LaunchConfiguration('at')])";
    assert!(launch.text.contains(call), "{}", launch.text);
    assert!(launch.text.contains("import shlex"), "{}", launch.text);
}

#[test]
fn conditions_and_expressions_are_kept() {
    let launch = migrate_launch(
        r#"<launch><arg name="kind" default="a"/>
        <group ns="robot" if="$(eval arg('kind') == 'a')"><node name="n" pkg="p" type="t"/></group></launch>"#,
        "a.launch",
    )
    .unwrap();
    let condition =
        r#"IfCondition(PythonExpression(["'", LaunchConfiguration('kind'), "' == 'a'"]))"#;
    assert!(launch.text.contains(condition), "{}", launch.text);
    assert!(launch.text.contains("PushRosNamespace('robot')"), "{}", launch.text);
    // roslaunch also knows arguments by their bare names, but not in quotes.
    let bare = migrate_launch(
        "<launch><arg name='map' default=''/><node name='n' pkg='p' type='t' unless=\"$(eval map == 'map')\"/></launch>",
        "a.launch",
    )
    .unwrap();
    let condition =
        r#"UnlessCondition(PythonExpression(["'", LaunchConfiguration('map'), "' == 'map'"]))"#;
    assert!(bare.text.contains(condition), "{}", bare.text);
}

#[test]
fn a_python_file_keeps_all_but_the_calls_of_gazebo() {
    let launch = migrate_python_launch(
        r#"import os
from launch.actions import IncludeLaunchDescription

def generate_launch_description():
    share = get_package_share_directory('gazebo_ros')
    gzserver = IncludeLaunchDescription(  # the server
        PythonLaunchDescriptionSource(os.path.join(share, 'launch', 'gzserver.launch.py')),
        launch_arguments={'world': world, 'verbose': 'true'}.items())
    spawn = Node(package='gazebo_ros', executable='spawn_entity.py',
                 arguments=['-entity', 'bot', '-topic', 'robot_description', '-timeout', '30'])
"#,
        "a.launch.py",
    )
    .unwrap();
    for part in [
        "share = get_package_share_directory('ros_gz_sim')",
        "gzserver = _GroupAction([IncludeLaunchDescription(  # the server",
        "'launch', 'gz_sim.launch.py')",
        "launch_arguments={'gz_args': ['-r -s ', world]}.items()), _Node(",
        "package='ros_gz_sim', executable='create'",
        "arguments=['-name', 'bot', '-topic', 'robot_description'])",
    ] {
        assert!(launch.text.contains(part), "{part} is missing in\n{}", launch.text);
    }
    assert_eq!(launch.entries.len(), 2);
    assert!(launch.entries[0].remarks[0].contains("`verbose`"), "{:?}", launch.entries);
}

#[test]
fn a_process_of_gazebo_becomes_gz_sim() {
    let launch = migrate_python_launch(
        "import os\nx = [ExecuteProcess(cmd=['gazebo', '--verbose', '-s', 'libgazebo_ros_init.so', world])]\n",
        "a.launch.py",
    )
    .unwrap();
    let call = "ExecuteProcess(cmd=['gz', 'sim', '-r', '-v', '4', world])";
    assert!(launch.text.contains(call), "{}", launch.text);
    assert!(migrate_python_launch("x = Node(package='a')\n", "a.launch.py").is_none());
}
