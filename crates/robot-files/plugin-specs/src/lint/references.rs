//! References to joints, links and frames.

use std::collections::BTreeSet;

use periplus_diagnostics::{Diagnostic, Diagnostics, Origin, Severity};
use periplus_params::{NamedEntity, ParamValue};
use periplus_scene::{FrameRole, Model};

use crate::{Family, InterpretedPlugin, PluginSite};

/// Frames that do not belong to a robot.
const GLOBAL: [&str; 5] = ["", "world", "map", "odom", "earth"];

/// Maximum number of names compared for suggestions in one scene. Further findings have no suggestion, so
/// that a hostile file with an error in every line does not take quadratic time.
const MAX_COMPARED_NAMES: usize = 1_000_000;

/// Names of the last model that was checked; plugins of one model are consecutive.
#[derive(Default)]
pub(super) struct Cache<'a> {
    root: Option<(&'a Model, Things)>,
    compared: usize,
}

pub(super) fn check<'a>(
    site: &PluginSite<'a>,
    plugin: &InterpretedPlugin,
    cache: &mut Cache<'a>,
    diagnostics: &mut Diagnostics,
) {
    let Some(root) = site.context.root else { return };
    if plugin.known.table.parameters.iter().all(|parameter| parameter.names.is_none()) {
        return;
    }
    if !cache.root.as_ref().is_some_and(|(known, _)| std::ptr::eq(*known, root)) {
        cache.root = Some((root, Things::of(root)));
    }
    let Some((_, things)) = &mut cache.root else { return };
    // A file that contains only a robot's plugins, for another file to include, has no links.
    if things.links.is_empty() {
        return;
    }
    things.suggest = cache.compared < MAX_COMPARED_NAMES;
    let before = findings(diagnostics);
    check_names(plugin, things, diagnostics);
    cache.compared += (findings(diagnostics) - before) * things.count();
}

fn check_names(plugin: &InterpretedPlugin, things: &Things, diagnostics: &mut Diagnostics) {
    for parameter in plugin.known.table.parameters {
        let Some(names) = parameter.names else { continue };
        if !plugin.values.is_given(parameter.name) {
            continue;
        }
        for (value, origin) in plugin.values.all(parameter.name) {
            let ParamValue::Text(name) = value else { continue };
            if name.contains('$') {
                continue;
            }
            let finding = match names {
                NamedEntity::Joint => joint(&name, origin, things, plugin),
                NamedEntity::Link => link(&name, origin, things, plugin),
                NamedEntity::Frame => frame(&name, origin, things),
                NamedEntity::Topic => None,
            };
            if let Some(finding) = finding {
                diagnostics.push(finding);
            }
        }
    }
}

fn findings(diagnostics: &Diagnostics) -> usize {
    [Severity::Error, Severity::Warning, Severity::Hint]
        .into_iter()
        .map(|severity| diagnostics.count(severity))
        .sum()
}

/// Names in a model and its nested models, plain and scoped.
#[derive(Default)]
struct Things {
    links: BTreeSet<String>,
    joints: BTreeSet<String>,
    frames: BTreeSet<String>,
    merged_links: BTreeSet<String>,
    merged_joints: BTreeSet<String>,
    suggest: bool,
}

impl Things {
    fn of(model: &Model) -> Self {
        let mut things = Self::default();
        things.add(model, "");
        things
    }

    fn count(&self) -> usize {
        self.links.len() + self.joints.len() + self.frames.len() + self.merged_links.len()
    }

    /// Candidates for suggestions.
    fn offered<'s>(&'s self, sets: &[&'s BTreeSet<String>]) -> Vec<&'s str> {
        if !self.suggest {
            return Vec::new();
        }
        sets.iter().copied().flatten().map(String::as_str).collect()
    }

    fn add(&mut self, model: &Model, scope: &str) {
        let both = |names: &mut BTreeSet<String>, name: &str| {
            names.insert(name.to_owned());
            if !scope.is_empty() {
                names.insert(format!("{scope}{name}"));
            }
        };
        for link in &model.links {
            both(&mut self.links, &link.name);
        }
        for joint in &model.joints {
            both(&mut self.joints, &joint.name);
        }
        for frame in &model.frames {
            match frame.role {
                FrameRole::Declared => both(&mut self.frames, &frame.name),
                FrameRole::MergedLink => both(&mut self.merged_links, &frame.name),
                FrameRole::MergedJoint => both(&mut self.merged_joints, &frame.name),
            }
        }
        for nested in &model.models {
            self.add(nested, &format!("{scope}{}::", nested.name));
        }
    }
}

fn has(names: &BTreeSet<String>, name: &str) -> bool {
    names.contains(name)
}

/// Most similar name: a typing error of the written one, or one that differs only in a suffix such as
/// `_link` or `_frame`.
fn meant<'a>(written: &str, known: &[&'a str]) -> Option<&'a str> {
    let near = periplus_diagnostics::closest(written, known.iter().copied());
    near.or_else(|| known.iter().copied().find(|name| core(name) == core(written)))
}

fn suggest(diagnostic: Diagnostic, origin: Origin, written: &str, known: &[&str]) -> Diagnostic {
    match meant(written, known) {
        Some(near) => diagnostic.replace(origin, near, format!("did you mean `{near}`?")),
        None => diagnostic,
    }
}

/// Name without the suffix for its type.
fn core(name: &str) -> &str {
    const KINDS: [&str; 6] = ["_link", "_frame", "_joint", "_sensor", "_optical", "_base"];
    let mut core = name;
    while let Some(shorter) = KINDS.iter().find_map(|kind| core.strip_suffix(kind)) {
        core = shorter;
    }
    core
}

fn joint(
    name: &str,
    origin: Origin,
    things: &Things,
    plugin: &InterpretedPlugin,
) -> Option<Diagnostic> {
    // The name of a joint may be prefixed by that of its model.
    let last = name.rsplit("::").next().unwrap_or(name);
    if has(&things.joints, name) || has(&things.joints, last) {
        return None;
    }
    // Before SDF 1.7 a joint could have the name of a link; then it is read as `<name>_joint`. Gazebo Classic keeps its
    // name for plugins.
    let is_classic = plugin.known.family != Family::Gz;
    if is_classic && has(&things.links, last) && has(&things.joints, &format!("{last}_joint")) {
        return None;
    }
    if has(&things.merged_joints, name) {
        return Some(
            Diagnostic::warning(
                "merged-joint",
                format!("the joint `{name}` is fixed; Gazebo merges its links and drops it"),
            )
            .at(origin)
            .help(format!(
                "add `<gazebo reference=\"{name}\"><preserveFixedJoint>true</preserveFixedJoint></gazebo>`"
            )),
        );
    }
    let error = Diagnostic::error("unknown-joint", format!("the model has no joint `{name}`"));
    Some(suggest(error.at(origin), origin, name, &things.offered(&[&things.joints])))
}

fn link(
    name: &str,
    origin: Origin,
    things: &Things,
    plugin: &InterpretedPlugin,
) -> Option<Diagnostic> {
    // The name of a link may be prefixed by that of its model.
    let last = name.rsplit("::").next().unwrap_or(name);
    if has(&things.links, name) || has(&things.links, last) || GLOBAL.contains(&name) {
        return None;
    }
    if has(&things.merged_links, name) {
        // For ROS 1 the conversion from URDF to SDF inserts the parent's name.
        return (plugin.known.family != Family::ClassicRos1).then(|| {
            Diagnostic::warning(
                "merged-link",
                format!("the link `{name}` is on a fixed joint; Gazebo merges it into its parent and does not find it"),
            )
            .at(origin)
            .help("name the parent link, or keep the joint with `<preserveFixedJoint>`")
        });
    }
    let links = things.offered(&[&things.links, &things.merged_links]);
    let error = Diagnostic::error("unknown-link", format!("the model has no link `{name}`"));
    Some(suggest(error.at(origin), origin, name, &links))
}

fn frame(name: &str, origin: Origin, things: &Things) -> Option<Diagnostic> {
    // The name may be prefixed by a namespace or tf prefix.
    let bare = name.rsplit('/').next().unwrap_or(name);
    let all = [
        &things.links,
        &things.merged_links,
        &things.frames,
        &things.merged_joints,
        &things.joints,
    ];
    if GLOBAL.contains(&bare) || all.iter().any(|names| has(names, bare)) {
        return None;
    }
    let frames = things.offered(&all[..3]);
    if meant(name, &frames).is_some() {
        let message = format!("the model has no link or frame `{name}`");
        let warning = Diagnostic::warning("unknown-frame", message).at(origin);
        return Some(suggest(warning, origin, name, &frames));
    }
    Some(
        Diagnostic::hint(
            "foreign-frame",
            format!("`{name}` is not a link or frame of the model; another node must publish it"),
        )
        .at(origin),
    )
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use crate::fixture::check;

    #[test]
    fn joints_must_exist() {
        check(
            "<model name='m'><link name='base'/><joint name='wheel_left_joint'/>
<merged_joint name='lid_joint'/>
<plugin name='p' filename='libgazebo_ros_joint_state_publisher.so'>
  <joint_name>wheel_left_joint</joint_name>
  <joint_name>wheel_lft_joint</joint_name>
  <joint_name>lid_joint</joint_name>
</plugin></model>",
            expect![[r#"
                error[unknown-joint]: the model has no joint `wheel_lft_joint`
                 --> test.sdf:5:15
                  |
                5 |   <joint_name>wheel_lft_joint</joint_name>
                  |               ^^^^^^^^^^^^^^^
                  |
                help: did you mean `wheel_left_joint`?
                  |
                5 |   <joint_name>wheel_left_joint</joint_name>
                  |                      +
                warning[merged-joint]: the joint `lid_joint` is fixed; Gazebo merges its links and drops it
                 --> test.sdf:6:15
                  |
                6 |   <joint_name>lid_joint</joint_name>
                  |               ^^^^^^^^^
                  |
                  = help: add `<gazebo reference="lid_joint"><preserveFixedJoint>true</preserveFixedJoint></gazebo>`
            "#]],
        );
    }

    #[test]
    fn links_and_frames_must_exist() {
        check(
            "<model name='m'><link name='base_link'/><merged_link name='imu_link'/>
<plugin name='p' filename='libgazebo_ros_p3d.so'>
  <body_name>imu_link</body_name>
  <frame_name>map</frame_name>
</plugin>
<plugin name='q' filename='libgazebo_ros_imu.so'>
  <bodyName>imu_link</bodyName>
</plugin>
<plugin name='r' filename='libgazebo_ros_ray_sensor.so'>
  <frame_name>imu_lnk</frame_name>
</plugin>
<plugin name='s' filename='libgazebo_ros_imu_sensor.so'>
  <ros/>
  <frame_name>tower</frame_name>
</plugin>
<plugin name='t' filename='libgazebo_ros_force.so'>
  <ros/>
  <link_name>tower</link_name>
</plugin></model>",
            expect![[r#"
                warning[merged-link]: the link `imu_link` is on a fixed joint; Gazebo merges it into its parent and does not find it
                 --> test.sdf:3:14
                  |
                3 |   <body_name>imu_link</body_name>
                  |              ^^^^^^^^
                  |
                  = help: name the parent link, or keep the joint with `<preserveFixedJoint>`
                warning[unknown-frame]: the model has no link or frame `imu_lnk`
                  --> test.sdf:10:15
                   |
                10 |   <frame_name>imu_lnk</frame_name>
                   |               ^^^^^^^
                   |
                help: did you mean `imu_link`?
                   |
                10 |   <frame_name>imu_link</frame_name>
                   |                    +
                hint[foreign-frame]: `tower` is not a link or frame of the model; another node must publish it
                  --> test.sdf:14:15
                   |
                14 |   <frame_name>tower</frame_name>
                   |               ^^^^^
                error[unknown-link]: the model has no link `tower`
                  --> test.sdf:18:14
                   |
                18 |   <link_name>tower</link_name>
                   |              ^^^^^
                hint[ros-version-mix]: this plugin is of ROS 1, others here are of ROS 2
                 --> test.sdf:6:1
                  |
                2 | <plugin name='p' filename='libgazebo_ros_p3d.so'>
                  | ------------------------------------------------- of ROS 2
                ...
                6 | <plugin name='q' filename='libgazebo_ros_imu.so'>
                  | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
                  |
                  = note: Gazebo runs with one of the two and fails to load the other's plugins
            "#]],
        );
    }

    #[test]
    fn a_name_with_another_word_at_its_end_is_suggested() {
        check(
            "<model name='m'><link name='base'/><link name='laser'/><joint name='left_wheel_joint'/>
<plugin name='p' filename='libgazebo_ros_ray_sensor.so'>
  <frame_name>laser_frame</frame_name>
</plugin>
<plugin name='q' filename='libgazebo_ros_joint_state_publisher.so'>
  <joint_name>left_wheel</joint_name>
</plugin></model>",
            expect![[r#"
                warning[unknown-frame]: the model has no link or frame `laser_frame`
                 --> test.sdf:3:15
                  |
                3 |   <frame_name>laser_frame</frame_name>
                  |               ^^^^^^^^^^^
                  |
                help: did you mean `laser`?
                  |
                3 -   <frame_name>laser_frame</frame_name>
                3 +   <frame_name>laser</frame_name>
                  |
                error[unknown-joint]: the model has no joint `left_wheel`
                 --> test.sdf:6:15
                  |
                6 |   <joint_name>left_wheel</joint_name>
                  |               ^^^^^^^^^^
                  |
                help: did you mean `left_wheel_joint`?
                  |
                6 |   <joint_name>left_wheel_joint</joint_name>
                  |                         ++++++
            "#]],
        );
    }

    #[test]
    fn a_joint_that_was_named_like_a_link_is_found() {
        check(
            "<model name='m'><link name='door'/><joint name='door_joint'/>
<plugin name='p' filename='libgazebo_ros_elevator.so'>
  <ros/><door_joint>elevator::door</door_joint>
</plugin></model>",
            expect![[""]],
        );
    }

    /// The simulation found no such joint, after a check without findings.
    #[test]
    fn a_link_is_not_a_joint_for_harmonic() {
        check(
            "<model name='m'><link name='left'/><joint name='left_joint'/>
<plugin name='gz::sim::systems::DiffDrive' filename='gz-sim-diff-drive-system'>
  <left_joint>left</left_joint><right_joint>left_joint</right_joint>
</plugin></model>",
            expect![[r#"
                error[unknown-joint]: the model has no joint `left`
                 --> test.sdf:3:15
                  |
                3 |   <left_joint>left</left_joint><right_joint>left_joint</right_joint>
                  |               ^^^^
                  |
                help: did you mean `left_joint`?
                  |
                3 |   <left_joint>left_joint</left_joint><right_joint>left_joint</right_joint>
                  |                   ++++++
            "#]],
        );
    }

    #[test]
    fn a_file_of_plugins_alone_is_left_alone() {
        check(
            "<model name='m'><plugin name='p' filename='libgazebo_ros_joint_state_publisher.so'>
  <joint_name>elsewhere</joint_name>
</plugin></model>",
            expect![[""]],
        );
    }
}
