//! Tables of all known plugins.
//!
//! Names, defaults and meanings are those of the plugins' own sources: `gazebo_ros_pkgs` (branches
//! `ros2` and `noetic-devel`), `gazebo-classic` 11, `gz-sim` 8, `gz-gui` 8 and `rmf_simulation` 2.4, and their
//! documentation. A parameter without default either has none or takes it from elsewhere, as its
//! description states.

mod classic;
mod gui;
mod gz;
mod gz_drive;
mod gz_effect;
mod gz_world;
mod open_rmf;
mod ros1;
mod ros1_camera;
mod ros1_drive;
mod ros1_sensor;
mod ros2;
mod ros2_drive;

use crate::PluginSpec;

/// Returns all known plugins, ROS 2 before ROS 1.
pub fn known() -> impl Iterator<Item = &'static PluginSpec> {
    [
        ros2::PLUGINS,
        ros2_drive::PLUGINS,
        ros1::PLUGINS,
        ros1_camera::PLUGINS,
        ros1_drive::PLUGINS,
        ros1_sensor::PLUGINS,
        classic::PLUGINS,
        gz::PLUGINS,
        gz_drive::PLUGINS,
        gz_effect::PLUGINS,
        gz_world::PLUGINS,
        gui::PLUGINS,
        open_rmf::PLUGINS,
    ]
    .into_iter()
    .flatten()
}

/// Plugin of Gazebo Classic and ROS 2: all read `<ros>`.
macro_rules! of_ros2 {
    ($id:literal, $role:ident, $support:ident, $doc:literal, [$($parameter:expr),* $(,)?]) => {
        crate::PluginSpec::new(
            crate::Family::ClassicRos2,
            $id,
            crate::Role::$role,
            crate::Support::$support,
            periplus_params::Table {
                name: concat!("lib", $id, ".so"),
                doc: $doc,
                parameters: &[
                    periplus_params::group(
                        "ros",
                        "Namespace, remappings, parameters and QoS of the plugin's node.",
                    ),
                    $($parameter),*
                ],
            },
        )
    };
}

/// Plugin of Gazebo Classic and ROS 1: all have a namespace and two obsolete parameters.
macro_rules! of_ros1 {
    ($id:literal, $role:ident, $support:ident, $doc:literal, [$($parameter:expr),* $(,)?]) => {
        crate::PluginSpec::new(
            crate::Family::ClassicRos1,
            $id,
            crate::Role::$role,
            crate::Support::$support,
            periplus_params::Table {
                name: concat!("lib", $id, ".so"),
                doc: $doc,
                parameters: &[
                    periplus_params::text("robotNamespace", "Prefix of every topic and service."),
                    periplus_params::text("alwaysOn", "Unused since Gazebo 1."),
                    $($parameter),*
                ],
            },
        )
    };
}

/// System of current Gazebo.
macro_rules! system {
    ($id:literal, [$($class:literal),*], $role:ident, $support:ident, $doc:literal,
     [$($parameter:expr),* $(,)?]) => {
        crate::PluginSpec::new(
            crate::Family::Gz,
            $id,
            crate::Role::$role,
            crate::Support::$support,
            periplus_params::Table { name: $id, doc: $doc, parameters: &[$($parameter),*] },
        )
        .classes(&[$($class),*])
    };
}

/// GUI plugin of current Gazebo.
macro_rules! panel {
    ($id:literal, $support:ident, $doc:literal, [$($parameter:expr),* $(,)?]) => {
        crate::PluginSpec::new(
            crate::Family::Gz,
            $id,
            crate::Role::Gui,
            crate::Support::$support,
            periplus_params::Table {
                name: $id,
                doc: $doc,
                parameters: &[
                    periplus_params::group("gz-gui", "Title, position and style of the panel.")
                        .also(&["ignition-gui"]),
                    $($parameter),*
                ],
            },
        )
    };
}

pub(crate) use {of_ros1, of_ros2, panel, system};

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use expect_test::expect;

    use super::known;
    use crate::{Family, library_id};

    #[test]
    fn no_table_has_slips() {
        let slips: Vec<String> = known().flat_map(|known| known.table.faults()).collect();
        assert_eq!(slips, [""; 0]);
    }

    #[test]
    fn no_plugin_is_listed_twice() {
        let mut seen = BTreeSet::new();
        for known in known() {
            assert!(seen.insert((known.id, known.family)), "{} of {}", known.id, known.family);
        }
    }

    #[test]
    fn only_ros_plugins_share_a_name() {
        for one in known() {
            for other in known().filter(|other| other.id == one.id && other.family != one.family) {
                assert!(
                    one.family != Family::Gz && other.family != Family::Gz,
                    "{} is of {} and of {}",
                    one.id,
                    one.family,
                    other.family
                );
            }
        }
    }

    #[test]
    fn every_file_name_leads_back_to_its_plugin() {
        for known in known() {
            assert_eq!(library_id(&known.filename()), known.id);
        }
    }

    #[test]
    fn every_parameter_is_explained() {
        for known in known() {
            assert!(known.table.doc.ends_with('.'), "{}", known.id);
            for parameter in known.table.parameters {
                assert!(parameter.doc.ends_with('.'), "{}: {}", known.id, parameter.name);
            }
        }
    }

    #[test]
    fn topics_name_parameters_of_their_table() {
        for known in known() {
            for topic in known.topics {
                for parameter in topic.set_by.into_iter().chain(topic.when) {
                    assert!(known.table.find(parameter).is_some(), "{}: {parameter}", known.id);
                }
            }
        }
    }

    #[test]
    fn the_diff_drives_as_yaml() {
        let yaml: String = known()
            .filter(|known| known.id.contains("diff_drive") || known.id.contains("diff-drive"))
            .map(|known| known.table.to_yaml())
            .collect();
        expect![[r#"
            # Drives wheels on the left and on the right.
            libgazebo_ros_diff_drive.so:
              # Namespace, remappings, parameters and QoS of the plugin's node.
              # ros:
              # Number of pairs of left and right wheels. (at least 1)
              num_wheel_pairs: 1
              # The joint of a left wheel, once for each pair. (required)
              # left_joint:
              # The joint of a right wheel, once for each pair. (required)
              # right_joint:
              # Distance between the wheels of a pair. [m] (above 0)
              wheel_separation: [0.34]
              # Diameter of the wheels of a pair. [m] (above 0)
              wheel_diameter: [0.15]
              # Maximum torque of a wheel. [N m] (at least 0)
              max_wheel_torque: 5.0
              # Maximum acceleration at the rim; 0: unlimited. [m/s^2] (at least 0)
              max_wheel_acceleration: 0.0
              # Steps of the controller per second; 0: each step. [Hz] (at least 0)
              update_rate: 100.0
              # 0 counts wheel turns, 1 is the true pose. (0 to 1)
              odometry_source: 1
              # Frame of the odometry.
              odometry_frame: odom
              # Child frame of the odometry.
              robot_base_frame: base_footprint
              # If true, odometry is published.
              publish_odom: false
              # If true, the transform from odometry to base is published.
              publish_odom_tf: false
              # If true, the transforms of the wheels are published.
              publish_wheel_tf: false
              # Entry of the covariance of pose and velocity. [m^2] (at least 0)
              covariance_x: 1e-5
              # Entry of the covariance of pose and velocity. [m^2] (at least 0)
              covariance_y: 1e-5
              # Entry of the covariance of pose and velocity. [rad^2] (at least 0)
              covariance_yaw: 0.001
            # Drives a wheel on the left and one on the right.
            libgazebo_ros_diff_drive.so:
              # Prefix of every topic and service.
              # robotNamespace:
              # Unused since Gazebo 1.
              # alwaysOn:
              # The joint of the left wheel.
              leftJoint: left_joint
              # The joint of the right wheel.
              rightJoint: right_joint
              # Distance between the wheels. [m] (above 0)
              wheelSeparation: 0.34
              # Diameter of the wheels. [m] (above 0)
              wheelDiameter: 0.15
              # Maximum torque of a wheel. [N m] (at least 0)
              wheelTorque: 5.0
              # Maximum acceleration at the rim; 0: unlimited. [m/s^2] (at least 0)
              wheelAcceleration: 0.0
              # Steps of the controller per second; 0: each step. [Hz] (at least 0)
              updateRate: 100.0
              # Topic of velocity commands.
              commandTopic: cmd_vel
              # Topic of the odometry.
              odometryTopic: odom
              # Frame of the odometry.
              odometryFrame: odom
              # Wheel turns, or the true pose. One of encoder, world.
              odometrySource: world
              # Child frame of the odometry.
              robotBaseFrame: base_footprint
              # If true, the transforms of the wheels are published.
              publishWheelTF: false
              # If true, the wheels' joint states are published.
              publishWheelJointState: false
              # If true, the transform from odometry to base is published.
              publishOdomTF: true
              # If true, transforms are published at all.
              publishTf: true
              # If true, left and right are swapped, as before Indigo.
              # legacyMode:
              # Verbosity of the log.
              rosDebugLevel: na
            # Drives wheels on the left and on the right.
            gz-sim-diff-drive-system:
              # The joint of a left wheel. (required)
              # left_joint:
              # The joint of a right wheel. (required)
              # right_joint:
              # Distance between left and right wheels. [m] (above 0)
              wheel_separation: 1.0
              # Radius of the wheels. [m] (above 0)
              wheel_radius: 0.2
              # Odometry messages per second; 0: one per step. [Hz] (at least 0)
              odom_publish_frequency: 50.0
              # Topic of commands.
              # topic:
              # Topic of the odometry.
              # odom_topic:
              # Topic of the transform from odometry to base.
              # tf_topic:
              # Frame of the odometry (default: `<model>/odom`).
              # frame_id:
              # Child frame of the odometry (default: `<model>/<link>`).
              # child_frame_id:
              # Limit of commands (default: none). [m/s]
              # min_velocity:
              # Limit of commands (default: none). [m/s]
              # max_velocity:
              # Limit of commands (default: none). [m/s^2]
              # min_acceleration:
              # Limit of commands (default: none). [m/s^2]
              # max_acceleration:
              # Limit of commands (default: none). [m/s^3]
              # min_jerk:
              # Limit of commands (default: none). [m/s^3]
              # max_jerk:
              # Limit of commands (default: none). [m/s]
              # min_linear_velocity:
              # Limit of commands (default: none). [m/s]
              # max_linear_velocity:
              # Limit of commands (default: none). [rad/s]
              # min_angular_velocity:
              # Limit of commands (default: none). [rad/s]
              # max_angular_velocity:
              # Limit of commands (default: none). [m/s^2]
              # min_linear_acceleration:
              # Limit of commands (default: none). [m/s^2]
              # max_linear_acceleration:
              # Limit of commands (default: none). [rad/s^2]
              # min_angular_acceleration:
              # Limit of commands (default: none). [rad/s^2]
              # max_angular_acceleration:
              # Limit of commands (default: none). [m/s^3]
              # min_linear_jerk:
              # Limit of commands (default: none). [m/s^3]
              # max_linear_jerk:
              # Limit of commands (default: none). [rad/s^3]
              # min_angular_jerk:
              # Limit of commands (default: none). [rad/s^3]
              # max_angular_jerk:
        "#]]
        .assert_eq(&yaml);
    }
}
