//! Plugins that publish on the same topic, and nodes with the same name.

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostic, Diagnostics};

use crate::{Family, InterpretedPlugin, PluginSite, TopicDirection, topics};

pub(super) fn check(
    plugins: &[(PluginSite<'_>, InterpretedPlugin)],
    diagnostics: &mut Diagnostics,
) {
    let mut publishers: BTreeMap<(String, bool, String), &PluginSite<'_>> = BTreeMap::new();
    let mut nodes: BTreeMap<(String, String), &PluginSite<'_>> = BTreeMap::new();
    for (site, plugin) in plugins {
        let ros = plugin.known.family != Family::Gz;
        for topic in topics(plugin, &site.context) {
            // Every publisher of joint states has its own joints, and subscribers merge them.
            if topic.flow == TopicDirection::In || ros && topic.name.ends_with("/joint_states") {
                continue;
            }
            // A camera publishes depth images only as a `depth` sensor.
            if topic.inside.contains("depth/") || topic.inside.ends_with("/points") {
                continue;
            }
            let message = format!("two plugins publish on `{}`", topic.name);
            let key = (surroundings(site), ros, topic.name);
            if let Some(first) = publishers.get(&key) {
                let help = if ros {
                    "give one of them a namespace or remap it"
                } else {
                    "set another topic in one of them"
                };
                diagnostics.push(twice("same-topic", message, site, first).help(help));
            } else {
                publishers.insert(key, site);
            }
        }
        if plugin.known.family == Family::ClassicRos2 && !plugin.ros.node.is_empty() {
            let node = plugin.ros.resolve("~");
            let key = (surroundings(site), node.clone());
            if let Some(first) = nodes.get(&key) {
                let message =
                    format!("two plugins create the node `{node}`; the second does not start");
                let finding = twice("same-node", message, site, first);
                diagnostics.push(finding.help("give one of them another `name` or namespace"));
            } else {
                nodes.insert(key, site);
            }
        }
    }
}

fn twice(
    code: &'static str,
    message: String,
    site: &PluginSite<'_>,
    first: &PluginSite<'_>,
) -> Diagnostic {
    let diagnostic = Diagnostic::warning(code, message).at(site.plugin.origin);
    if site.plugin.origin.0 == first.plugin.origin.0 {
        return diagnostic.note("it is the same plugin in two copies of a model");
    }
    diagnostic.related(first.plugin.origin, "the first")
}

/// Plugins that run together: those of a world, or of a model outside any world.
fn surroundings(site: &PluginSite<'_>) -> String {
    match (site.context.world, site.context.root) {
        (Some(world), _) => format!("world {}", world.name),
        (None, root) => format!("model {}", root.map_or("", |model| &model.name)),
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use crate::fixture::check;

    #[test]
    fn a_topic_has_one_publisher() {
        check(
            "<model name='m'>
<plugin name='a' filename='libgazebo_ros_p3d.so'><ros/><body_name>b</body_name></plugin>
<plugin name='b' filename='libgazebo_ros_planar_move.so'><ros/></plugin>
<plugin name='gz::sim::systems::OdometryPublisher' filename='gz-sim-odometry-publisher-system'/>
<plugin name='gz::sim::systems::OdometryPublisher' filename='gz-sim-odometry-publisher-system'>
  <odom_topic>truth</odom_topic><odom_covariance_topic>c</odom_covariance_topic><tf_topic>t</tf_topic>
</plugin></model>",
            expect![[r#"
                warning[same-topic]: two plugins publish on `/odom`
                 --> test.sdf:3:1
                  |
                2 | <plugin name='a' filename='libgazebo_ros_p3d.so'><ros/><body_name>b</body_name></plugin>
                  | ------------------------------------------------- the first
                3 | <plugin name='b' filename='libgazebo_ros_planar_move.so'><ros/></plugin>
                  | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
                  |
                  = help: give one of them a namespace or remap it
            "#]],
        );
    }

    #[test]
    fn a_node_has_one_plugin() {
        check(
            "<model name='m'>
<plugin name='a' filename='libgazebo_ros_imu_sensor.so'>
  <ros><remapping>~/out:=x</remapping></ros></plugin>
<plugin name='a' filename='libgazebo_ros_ray_sensor.so'/>
<plugin name='a' filename='libgazebo_ros_ray_sensor.so'><ros><namespace>n</namespace></ros></plugin>
</model>",
            expect![[r#"
                warning[same-node]: two plugins create the node `/a`; the second does not start
                 --> test.sdf:4:1
                  |
                2 | <plugin name='a' filename='libgazebo_ros_imu_sensor.so'>
                  | -------------------------------------------------------- the first
                3 |   <ros><remapping>~/out:=x</remapping></ros></plugin>
                4 | <plugin name='a' filename='libgazebo_ros_ray_sensor.so'/>
                  | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
                  |
                  = help: give one of them another `name` or namespace
            "#]],
        );
    }
}
