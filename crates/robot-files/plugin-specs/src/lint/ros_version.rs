//! Plugins of ROS 1 and ROS 2 in one file.

use periplus_diagnostics::{Diagnostic, Diagnostics};

use crate::recognise::{Sign, ros_sign};
use crate::{InterpretedPlugin, PluginSite};

pub(super) fn check(
    plugins: &[(PluginSite<'_>, InterpretedPlugin)],
    diagnostics: &mut Diagnostics,
) {
    let with = |sign: Sign| -> Vec<&PluginSite<'_>> {
        plugins.iter().map(|(site, _)| site).filter(|site| ros_sign(site.plugin) == sign).collect()
    };
    let (ros1, ros2) = (with(Sign::Ros1), with(Sign::Ros2));
    let (Some(first1), Some(first2)) = (ros1.first(), ros2.first()) else { return };
    let (odd, odd_version, usual, usual_version) =
        if ros1.len() > ros2.len() { (first2, 2, first1, 1) } else { (first1, 1, first2, 2) };
    diagnostics.push(
        Diagnostic::hint(
            "ros-version-mix",
            format!("this plugin is of ROS {odd_version}, others here are of ROS {usual_version}"),
        )
        .at(odd.plugin.origin)
        .related(usual.plugin.origin, format!("of ROS {usual_version}"))
        .note("Gazebo runs with one of the two and fails to load the other's plugins"),
    );
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use crate::fixture::check;

    #[test]
    fn old_parameters_in_a_ros2_file_are_not_ros1() {
        check(
            "<model name='m'>
<plugin name='a' filename='libgazebo_ros_ray_sensor.so'/>
<plugin name='b' filename='libgazebo_ros_camera.so'><hackBaseline>0.2</hackBaseline></plugin>
</model>",
            expect![[r#"
                warning[ros1-parameter]: `hackBaseline` is a parameter of ROS 1; libgazebo_ros_camera.so of ROS 2 does not read it
                 --> test.sdf:3:54
                  |
                3 | <plugin name='b' filename='libgazebo_ros_camera.so'><hackBaseline>0.2</hackBaseline></plugin>
                  |                                                      ^^^^^^^^^^^^ this is ignored
                  |
                help: ROS 2 calls it `hack_baseline`
                  |
                3 - <plugin name='b' filename='libgazebo_ros_camera.so'><hackBaseline>0.2</hackBaseline></plugin>
                3 + <plugin name='b' filename='libgazebo_ros_camera.so'><hack_baseline>0.2</hack_baseline></plugin>
                  |
            "#]],
        );
    }

    #[test]
    fn one_file_one_ros() {
        check(
            "<model name='m'>
<plugin name='a' filename='libgazebo_ros_ray_sensor.so'/>
<plugin name='b' filename='libgazebo_ros_laser.so'><topicName>scan</topicName></plugin>
</model>",
            expect![[r#"
                hint[ros-version-mix]: this plugin is of ROS 1, others here are of ROS 2
                 --> test.sdf:3:1
                  |
                2 | <plugin name='a' filename='libgazebo_ros_ray_sensor.so'/>
                  | --------------------------------------------------------- of ROS 2
                3 | <plugin name='b' filename='libgazebo_ros_laser.so'><topicName>scan</topicName></plugin>
                  | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
                  |
                  = note: Gazebo runs with one of the two and fails to load the other's plugins
            "#]],
        );
    }
}
