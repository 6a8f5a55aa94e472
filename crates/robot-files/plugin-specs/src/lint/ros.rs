//! Checks of the `<ros>` element and of topic names.

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_scene::Element;

use crate::{InterpretedPlugin, PluginSite, TopicDirection, topics};

const CHILDREN: [&str; 5] = ["namespace", "remapping", "argument", "parameter", "qos"];

pub(super) fn check(
    site: &PluginSite<'_>,
    plugin: &InterpretedPlugin,
    diagnostics: &mut Diagnostics,
) {
    let has_node = plugin.known.table.find("ros").is_some();
    if has_node {
        for ros in site.plugin.content.iter().filter(|element| element.name == "ros") {
            for child in ros.elements() {
                check_child(child, site, plugin, diagnostics);
            }
        }
    }
    check_laser(site, plugin, diagnostics);
}

fn check_child(
    child: &Element,
    site: &PluginSite<'_>,
    plugin: &InterpretedPlugin,
    diagnostics: &mut Diagnostics,
) {
    match &*child.name {
        "remapping" => check_remapping(child, site, plugin, diagnostics),
        "remap" => diagnostics.push(remap(child, site, plugin)),
        "argument" if child.text().contains(":=") && !child.text().contains(' ') => {
            let text = child.text();
            diagnostics.push(
                Diagnostic::hint(
                    "ros-argument",
                    format!("`{text}` as an argument remaps nothing since ROS 2 Eloquent"),
                )
                .at(child.text_origin())
                .help(format!("write `<remapping>{text}</remapping>`")),
            );
        }
        name if CHILDREN.contains(&name) || name.contains(':') => {}
        name => {
            let message = format!("`<ros>` has no element `{name}`");
            diagnostics.push(
                Diagnostic::warning("unknown-parameter", message)
                    .at(child.name_origin())
                    .label("this is ignored")
                    .did_you_mean(child.name_origin(), name, CHILDREN),
            );
        }
    }
}

fn remap(element: &Element, site: &PluginSite<'_>, plugin: &InterpretedPlugin) -> Diagnostic {
    let (from, to) = (element.value("from"), element.value("to"));
    let mut message = "`<remap>` inside `<ros>` is never read".to_owned();
    if let Some(from) = from {
        let stays = plugin.ros.resolve(from);
        let topic = topics(plugin, &site.context).into_iter().find(|topic| topic.name == stays);
        let does = match topic.map(|topic| topic.flow) {
            Some(TopicDirection::In) => "the plugin subscribes to",
            Some(TopicDirection::Out) => "the plugin publishes on",
            None => "the topic stays",
        };
        message = format!("{message}: {does} `{stays}`");
    }
    let diagnostic = Diagnostic::warning("remap-in-ros", message).at(element.origin);
    match (from, to) {
        (Some(from), Some(to)) => diagnostic.replace(
            element.origin,
            format!("<remapping>{from}:={to}</remapping>"),
            "only `<remapping>` is read",
        ),
        _ => diagnostic.help("only `<remapping>from:=to</remapping>` is read"),
    }
}

fn check_remapping(
    element: &Element,
    site: &PluginSite<'_>,
    plugin: &InterpretedPlugin,
    diagnostics: &mut Diagnostics,
) {
    let text = element.text();
    let Some((from, to)) = text.split_once(":=") else {
        let message = format!("`{text}` is not a remapping");
        diagnostics.push(
            Diagnostic::error("bad-remapping", message)
                .at(element.text_origin())
                .help("write `<remapping>from:=to</remapping>`"),
        );
        return;
    };
    // `image_raw:=...` matches nothing if the plugin's own name is `camera/image_raw`.
    let own = topics(plugin, &site.context);
    let matches = own.iter().any(|topic| topic.inside == from.trim());
    let meant = own.iter().find(|topic| {
        !matches && topic.inside.rsplit_once('/').is_some_and(|(_, last)| last == from.trim())
    });
    if let Some(topic) = meant {
        let inside = &topic.inside;
        diagnostics.push(
            Diagnostic::warning(
                "remapping-matches-nothing",
                format!("the plugin has no topic `{}`; it has `{inside}`", from.trim()),
            )
            .at(element.text_origin())
            .replace(
                element.text_origin(),
                format!("{inside}:={}", to.trim()),
                format!("did you mean `{inside}`?"),
            ),
        );
    }
}

fn check_laser(site: &PluginSite<'_>, plugin: &InterpretedPlugin, diagnostics: &mut Diagnostics) {
    let by_default = plugin.known.topics.iter().any(|topic| topic.name == "/world");
    if by_default && !plugin.values.is_given("topicName") {
        diagnostics.push(
            Diagnostic::hint(
                "laser-topic",
                "without `<topicName>` this laser publishes on `/world`",
            )
            .at(site.plugin.origin)
            .help("add `<topicName>scan</topicName>`"),
        );
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use crate::fixture::check;

    #[test]
    fn remap_is_not_remapping() {
        check(
            "<model name='m'><plugin name='drive' filename='libgazebo_ros_planar_move.so'>
  <ros>
    <namespace>/demo</namespace>
    <remap from='cmd_vel' to='/cmd_vel'/>
    <remap from='odom' to='/odom'/>
  </ros>
</plugin></model>",
            expect![[r#"
                warning[remap-in-ros]: `<remap>` inside `<ros>` is never read: the plugin subscribes to `/demo/cmd_vel`
                 --> test.sdf:4:5
                  |
                4 |     <remap from='cmd_vel' to='/cmd_vel'/>
                  |     ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
                  |
                help: only `<remapping>` is read
                  |
                4 -     <remap from='cmd_vel' to='/cmd_vel'/>
                4 +     <remapping>cmd_vel:=/cmd_vel</remapping>
                  |
                warning[remap-in-ros]: `<remap>` inside `<ros>` is never read: the plugin publishes on `/demo/odom`
                 --> test.sdf:5:5
                  |
                5 |     <remap from='odom' to='/odom'/>
                  |     ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
                  |
                help: only `<remapping>` is read
                  |
                5 -     <remap from='odom' to='/odom'/>
                5 +     <remapping>odom:=/odom</remapping>
                  |
            "#]],
        );
    }

    #[test]
    fn slips_in_ros_are_seen() {
        check(
            "<model name='m'><plugin name='drive' filename='libgazebo_ros_planar_move.so'>
  <ros>
    <namspace>demo</namspace>
    <remapping>odom=/odom</remapping>
    <argument>cmd_vel:=cmd</argument>
  </ros>
</plugin></model>",
            expect![[r#"
                warning[unknown-parameter]: `<ros>` has no element `namspace`
                 --> test.sdf:3:6
                  |
                3 |     <namspace>demo</namspace>
                  |      ^^^^^^^^ this is ignored
                  |
                help: did you mean `namespace`?
                  |
                3 |     <namespace>demo</namspace>
                  |         +
                error[bad-remapping]: `odom=/odom` is not a remapping
                 --> test.sdf:4:16
                  |
                4 |     <remapping>odom=/odom</remapping>
                  |                ^^^^^^^^^^
                  |
                  = help: write `<remapping>from:=to</remapping>`
                hint[ros-argument]: `cmd_vel:=cmd` as an argument remaps nothing since ROS 2 Eloquent
                 --> test.sdf:5:15
                  |
                5 |     <argument>cmd_vel:=cmd</argument>
                  |               ^^^^^^^^^^^^
                  |
                  = help: write `<remapping>cmd_vel:=cmd</remapping>`
            "#]],
        );
    }

    #[test]
    fn a_remapping_must_name_the_whole_topic() {
        check(
            "<model name='m'><link name='l'><sensor name='eye' type='camera'>
<plugin name='p' filename='libgazebo_ros_camera.so'><ros>
  <remapping>image_raw:=picture</remapping>
  <remapping>eye/camera_info:=info</remapping>
</ros></plugin></sensor></link></model>",
            expect![[r#"
                warning[remapping-matches-nothing]: the plugin has no topic `image_raw`; it has `eye/image_raw`
                 --> test.sdf:3:14
                  |
                3 |   <remapping>image_raw:=picture</remapping>
                  |              ^^^^^^^^^^^^^^^^^^
                  |
                help: did you mean `eye/image_raw`?
                  |
                3 |   <remapping>eye/image_raw:=picture</remapping>
                  |              ++++
            "#]],
        );
    }

    #[test]
    fn a_laser_needs_a_topic() {
        check(
            "<model name='m'><plugin name='p' filename='libgazebo_ros_laser.so'/></model>",
            expect![[r#"
                hint[laser-topic]: without `<topicName>` this laser publishes on `/world`
                 --> test.sdf:1:17
                  |
                1 | <model name='m'><plugin name='p' filename='libgazebo_ros_laser.so'/></model>
                  |                 ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
                  |
                  = help: add `<topicName>scan</topicName>`
            "#]],
        );
    }
}
