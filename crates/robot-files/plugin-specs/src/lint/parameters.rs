//! Unknown parameters.

use periplus_diagnostics::{Diagnostic, Diagnostics, Span};
use periplus_params::{Default, ParamValue};
use periplus_scene::Element;

use crate::interpret::given_by;
use crate::renamed::{Instead, renamed};
use crate::{Family, PluginSite, PluginSpec, known};

pub(super) fn check(
    site: &PluginSite<'_>,
    known: &'static PluginSpec,
    diagnostics: &mut Diagnostics,
) {
    for element in &site.plugin.content {
        let name = element.name.as_str();
        if known.open || known.table.find(name).is_some() || name.contains(':') {
            continue;
        }
        let diagnostic = match known.family {
            Family::ClassicRos2 => ros2(site, known, element),
            Family::ClassicRos1 => ros1(known, element),
            Family::Classic | Family::Gz => unknown(known, element),
        };
        diagnostics.push(diagnostic);
    }
}

/// Returns true if any plugin of a family reads a parameter of this name.
fn is_read_by(family: Family, name: &str) -> bool {
    known().any(|known| known.family == family && known.table.find(name).is_some())
}

/// Finding for an unknown name; if the end of the element is known, the correction includes the end tag.
fn unknown(known: &'static PluginSpec, element: &Element) -> Diagnostic {
    let mut diagnostic = known.table.unknown(&given_by(element));
    if let (Some(replacement), Some(span)) = (&mut diagnostic.replacement, whole(element)) {
        let name = replacement.text.clone();
        replacement.text = format!("<{name}>{}</{name}>", inner(element));
        replacement.span = span;
    }
    diagnostic
}

fn inner(element: &Element) -> &str {
    match &element.children[..] {
        [periplus_xml::XmlNode::Text(text)] => &text.text,
        _ => "",
    }
}

fn ros1(known: &'static PluginSpec, element: &Element) -> Diagnostic {
    let mut diagnostic = unknown(known, element);
    if element.name == "ros" || is_read_by(Family::ClassicRos2, &element.name) {
        diagnostic.code = "ros2-parameter";
        diagnostic.message =
            format!("`{}` is a parameter of ROS 2; {} is of ROS 1", element.name, known.table.name);
    }
    diagnostic
}

fn ros2(site: &PluginSite<'_>, known: &'static PluginSpec, element: &Element) -> Diagnostic {
    let name = element.name.as_str();
    let mut diagnostic = unknown(known, element);
    if is_read_by(Family::ClassicRos1, name) {
        diagnostic.code = "ros1-parameter";
        diagnostic.message = format!(
            "`{name}` is a parameter of ROS 1; {} of ROS 2 does not read it",
            known.table.name
        );
    }
    let value = element.text();
    let Some(instead) = renamed(known, name, &value) else { return diagnostic };
    diagnostic.replacement = None;
    match instead {
        Instead::Parameter(parameter) if is_default(known, parameter, &value) => diagnostic
            .help(format!("delete it: ROS 2 calls it `{parameter}`, and {value} is its default")),
        Instead::Parameter(parameter) => rename(diagnostic, element, parameter, &value),
        Instead::Translated(parameter, words) => {
            let value = words.iter().find(|(old, _)| old.eq_ignore_ascii_case(&value));
            rename(diagnostic, element, parameter, value.map_or("1", |(_, new)| *new))
        }
        Instead::Sensor("noise") => {
            diagnostic.help("give the sensor a `<noise>`; its standard deviation is `<stddev>`")
        }
        Instead::Sensor("always_on") if site.context.sensor.is_some_and(|it| it.always_on) => {
            diagnostic.help("delete it: the sensor's `<always_on>` sets it")
        }
        Instead::Sensor(path) => {
            let open: Vec<&str> = path.split("><").collect();
            let close: Vec<&str> = open.iter().rev().copied().collect();
            let inside = format!("<{path}>{value}</{}>", close.join("></"));
            diagnostic.help(format!("set `{inside}` in the `<sensor>`"))
        }
        Instead::Remapping(topic) => {
            let camera = site.plugin.value("camera_name").map(std::borrow::Cow::into_owned);
            let camera = camera.or_else(|| site.context.sensor.map(|sensor| sensor.name.clone()));
            let topic = topic.replace("{camera_name}", &camera.unwrap_or("camera".into()));
            if name.contains("_topic") {
                diagnostic = diagnostic
                    .note("old documentation mentions it, but no version of the plugin reads it");
            }
            if value == topic {
                return diagnostic.help(format!("delete it: the topic is `{topic}` anyway"));
            }
            diagnostic.help(format!("write `<remapping>{topic}:={value}</remapping>` in `<ros>`"))
        }
        Instead::Namespace => {
            diagnostic.help(format!("write `<ros><namespace>{value}</namespace></ros>`"))
        }
        Instead::Nothing(because) => diagnostic.help(format!("delete it: {because}")),
    }
}

fn is_default(known: &PluginSpec, parameter: &str, value: &str) -> bool {
    let Some(parameter) = known.table.find(parameter) else { return false };
    let read = |text: &str| ParamValue::read(parameter, text).ok();
    match parameter.default {
        Default::Value(default) => read(value).is_some_and(|value| read(default) == Some(value)),
        Default::Required | Default::None => false,
    }
}

fn rename(diagnostic: Diagnostic, element: &Element, parameter: &str, value: &str) -> Diagnostic {
    let text = format!("<{parameter}>{value}</{parameter}>");
    match whole(element) {
        Some(span) => diagnostic.replace(span, text, format!("ROS 2 calls it `{parameter}`")),
        None => diagnostic.help(format!("ROS 2 calls it `{parameter}`: write `{text}`")),
    }
}

/// Span from the start tag to the end tag of an element with plain text only. Only the position of the
/// start tag is known; the end tag follows the text.
fn whole(element: &Element) -> Option<Span> {
    let [periplus_xml::XmlNode::Text(text)] = &element.children[..] else { return None };
    let (start, inside) = (element.origin.0?, text.origin.0?);
    let written_as_is = inside.start == start.end
        && (inside.end - inside.start) as usize == text.text.len()
        && inside.file == start.file;
    let end_tag = u32::try_from(element.name.len() + 3).ok()?;
    written_as_is.then_some(Span { end: inside.end + end_tag, ..start })
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use crate::fixture::check;

    #[test]
    fn a_slip_in_a_parameter_is_seen() {
        check(
            "<model name='m'>
  <plugin name='gz::sim::systems::OdometryPublisher' filename='gz-sim-odometry-publisher-system'>
    <odom_publisher_frequency>20</odom_publisher_frequency>
  </plugin>
</model>",
            expect![[r#"
                warning[unknown-parameter]: gz-sim-odometry-publisher-system has no parameter `odom_publisher_frequency`
                 --> test.sdf:3:6
                  |
                3 |     <odom_publisher_frequency>20</odom_publisher_frequency>
                  |      ^^^^^^^^^^^^^^^^^^^^^^^^ this is ignored
                  |
                help: did you mean `odom_publish_frequency`?
                  |
                3 -     <odom_publisher_frequency>20</odom_publisher_frequency>
                3 +     <odom_publish_frequency>20</odom_publish_frequency>
                  |
            "#]],
        );
    }

    #[test]
    fn ros1_names_in_a_ros2_camera_are_corrected() {
        check(
            "<model name='m'><link name='l'><sensor name='s' type='depth'>
<plugin name='camera' filename='libgazebo_ros_camera.so'>
  <frame_name>l</frame_name>
  <alwaysOn>true</alwaysOn>
  <updateRate>30</updateRate>
  <pointCloudCutoff>0.5</pointCloudCutoff>
  <CxPrime>0</CxPrime>
  <Cx>0</Cx>
  <Cy>240.5</Cy>
  <distortionK1>0.1</distortionK1>
  <imageTopicName>rgb</imageTopicName>
</plugin></sensor></link></model>",
            expect![[r#"
                warning[ros1-parameter]: `alwaysOn` is a parameter of ROS 1; libgazebo_ros_camera.so of ROS 2 does not read it
                 --> test.sdf:4:4
                  |
                4 |   <alwaysOn>true</alwaysOn>
                  |    ^^^^^^^^ this is ignored
                  |
                  = help: set `<always_on>true</always_on>` in the `<sensor>`
                warning[ros1-parameter]: `updateRate` is a parameter of ROS 1; libgazebo_ros_camera.so of ROS 2 does not read it
                 --> test.sdf:5:4
                  |
                5 |   <updateRate>30</updateRate>
                  |    ^^^^^^^^^^ this is ignored
                  |
                  = help: set `<update_rate>30</update_rate>` in the `<sensor>`
                warning[ros1-parameter]: `pointCloudCutoff` is a parameter of ROS 1; libgazebo_ros_camera.so of ROS 2 does not read it
                 --> test.sdf:6:4
                  |
                6 |   <pointCloudCutoff>0.5</pointCloudCutoff>
                  |    ^^^^^^^^^^^^^^^^ this is ignored
                  |
                help: ROS 2 calls it `min_depth`
                  |
                6 -   <pointCloudCutoff>0.5</pointCloudCutoff>
                6 +   <min_depth>0.5</min_depth>
                  |
                warning[ros1-parameter]: `CxPrime` is a parameter of ROS 1; libgazebo_ros_camera.so of ROS 2 does not read it
                 --> test.sdf:7:4
                  |
                7 |   <CxPrime>0</CxPrime>
                  |    ^^^^^^^ this is ignored
                  |
                  = help: delete it: ROS 2 has no such parameter
                warning[ros1-parameter]: `Cx` is a parameter of ROS 1; libgazebo_ros_camera.so of ROS 2 does not read it
                 --> test.sdf:8:4
                  |
                8 |   <Cx>0</Cx>
                  |    ^^ this is ignored
                  |
                  = help: delete it: 0 meant to compute it from the image, which is the default
                warning[ros1-parameter]: `Cy` is a parameter of ROS 1; libgazebo_ros_camera.so of ROS 2 does not read it
                 --> test.sdf:9:4
                  |
                9 |   <Cy>240.5</Cy>
                  |    ^^ this is ignored
                  |
                help: did you mean `cy`?
                  |
                9 -   <Cy>240.5</Cy>
                9 +   <cy>240.5</cy>
                  |
                warning[ros1-parameter]: `distortionK1` is a parameter of ROS 1; libgazebo_ros_camera.so of ROS 2 does not read it
                  --> test.sdf:10:4
                   |
                10 |   <distortionK1>0.1</distortionK1>
                   |    ^^^^^^^^^^^^ this is ignored
                   |
                   = help: set `<camera><distortion><k1>0.1</k1></distortion></camera>` in the `<sensor>`
                warning[ros1-parameter]: `imageTopicName` is a parameter of ROS 1; libgazebo_ros_camera.so of ROS 2 does not read it
                  --> test.sdf:11:4
                   |
                11 |   <imageTopicName>rgb</imageTopicName>
                   |    ^^^^^^^^^^^^^^ this is ignored
                   |
                   = help: write `<remapping>s/image_raw:=rgb</remapping>` in `<ros>`
            "#]],
        );
    }

    #[test]
    fn topics_of_a_ros2_drive_are_remapped_not_set() {
        check(
            "<model name='m'><plugin name='drive' filename='libgazebo_ros_planar_move.so'>
  <ros/>
  <command_topic>cmd</command_topic>
  <robotNamespace>demo</robotNamespace>
</plugin></model>",
            expect![[r#"
                warning[unknown-parameter]: libgazebo_ros_planar_move.so has no parameter `command_topic`
                 --> test.sdf:3:4
                  |
                3 |   <command_topic>cmd</command_topic>
                  |    ^^^^^^^^^^^^^ this is ignored
                  |
                  = note: old documentation mentions it, but no version of the plugin reads it
                  = help: write `<remapping>cmd_vel:=cmd</remapping>` in `<ros>`
                warning[ros1-parameter]: `robotNamespace` is a parameter of ROS 1; libgazebo_ros_planar_move.so of ROS 2 does not read it
                 --> test.sdf:4:4
                  |
                4 |   <robotNamespace>demo</robotNamespace>
                  |    ^^^^^^^^^^^^^^ this is ignored
                  |
                  = help: write `<ros><namespace>demo</namespace></ros>`
            "#]],
        );
    }

    #[test]
    fn what_only_the_documentation_names_is_told() {
        check(
            "<model name='m'><plugin name='car' filename='libgazebo_ros_ackermann_drive.so'>
  <wheel_base>2</wheel_base>
</plugin></model>",
            expect![[r#"
                warning[unknown-parameter]: libgazebo_ros_ackermann_drive.so has no parameter `wheel_base`
                 --> test.sdf:2:4
                  |
                2 |   <wheel_base>2</wheel_base>
                  |    ^^^^^^^^^^ this is ignored
                  |
                  = help: delete it: the plugin measures it in the model
            "#]],
        );
    }

    #[test]
    fn ros2_names_in_a_ros1_plugin_are_seen() {
        check(
            "<model name='m'><plugin name='scan' filename='libgazebo_ros_laser.so'>
  <ros/>
  <topicName>/scan</topicName>
  <frame_name>world</frame_name>
</plugin></model>",
            expect![[r#"
                warning[ros2-parameter]: `ros` is a parameter of ROS 2; libgazebo_ros_laser.so is of ROS 1
                 --> test.sdf:2:4
                  |
                2 |   <ros/>
                  |    ^^^ this is ignored
                warning[ros2-parameter]: `frame_name` is a parameter of ROS 2; libgazebo_ros_laser.so is of ROS 1
                 --> test.sdf:4:4
                  |
                4 |   <frame_name>world</frame_name>
                  |    ^^^^^^^^^^ this is ignored
                  |
                help: did you mean `frameName`?
                  |
                4 -   <frame_name>world</frame_name>
                4 +   <frameName>world</frameName>
                  |
            "#]],
        );
    }

    #[test]
    fn values_are_checked() {
        check(
            "<model name='m'><plugin name='scan' filename='libgazebo_ros_ray_sensor.so'>
  <output_type>sensor_msgs/LaserScn</output_type>
  <min_intensity>low</min_intensity>
</plugin></model>",
            expect![[r#"
                error[bad-value]: `output_type`: the value `sensor_msgs/LaserScn` is none of `sensor_msgs/LaserScan`, `sensor_msgs/PointCloud`, `sensor_msgs/PointCloud2`, `sensor_msgs/Range`
                 --> test.sdf:2:16
                  |
                2 |   <output_type>sensor_msgs/LaserScn</output_type>
                  |                ^^^^^^^^^^^^^^^^^^^^
                  |
                  = note: the default is used: sensor_msgs/PointCloud2
                help: did you mean `sensor_msgs/LaserScan`?
                  |
                2 |   <output_type>sensor_msgs/LaserScan</output_type>
                  |                                   +
                error[bad-value]: `min_intensity`: the value `low` is not a number
                 --> test.sdf:3:18
                  |
                3 |   <min_intensity>low</min_intensity>
                  |                  ^^^
                  |
                  = note: the default is used: 0
            "#]],
        );
    }
}
