//! Unknown plugins, and classes that are not in their library.

use std::collections::BTreeSet;

use periplus_diagnostics::{Diagnostic, Diagnostics, closest};

use crate::library::{class_id, library_id};
use crate::{Family, PluginParent, PluginSite, Role, known, recognise};

/// Expected but wrong names, each with the library that provides the function. The first part is the result
/// of [`distinctive`].
const EXPECTED: [(u8, &str, &str); 22] = [
    (1, "lidar", "gazebo_ros_ray_sensor"),
    (1, "lidar_sensor", "gazebo_ros_ray_sensor"),
    (1, "laser_sensor", "gazebo_ros_ray_sensor"),
    (1, "laserscan", "gazebo_ros_ray_sensor"),
    (1, "gpu_lidar", "gazebo_ros_ray_sensor"),
    (1, "sonar", "gazebo_ros_ray_sensor"),
    (1, "ultrasonic", "gazebo_ros_ray_sensor"),
    (1, "velodyne_laser", "gazebo_ros_ray_sensor"),
    (1, "gps", "gazebo_ros_gps_sensor"),
    (1, "navsat", "gazebo_ros_gps_sensor"),
    (1, "rgbd_camera", "gazebo_ros_camera"),
    (1, "stereo_camera", "gazebo_ros_camera"),
    (1, "contact", "gazebo_ros_bumper"),
    (1, "contact_sensor", "gazebo_ros_bumper"),
    (1, "odometry", "gazebo_ros_p3d"),
    (1, "ground_truth", "gazebo_ros_p3d"),
    (1, "differential_drive", "gazebo_ros_diff_drive"),
    (1, "mecanum_drive", "gazebo_ros_planar_move"),
    (1, "omni_drive", "gazebo_ros_planar_move"),
    (2, "lidar", "gz-sim-sensors-system"),
    (2, "camera", "gz-sim-sensors-system"),
    (2, "odometry", "gz-sim-odometry-publisher-system"),
];

/// Maximum number of unknown plugins for which similar names are searched.
const MAX_SUGGESTIONS: usize = 200;

pub(super) fn check(sites: &[PluginSite<'_>], diagnostics: &mut Diagnostics) {
    let mut told = BTreeSet::new();
    for site in sites {
        let filename = site.plugin.filename.trim();
        // `__default__` is written by libsdformat if a file names no library.
        if filename.is_empty() || filename == "__default__" {
            continue;
        }
        match recognise(site.plugin, &site.context) {
            Some(known) if known.family == Family::Gz && known.role != Role::Gui => {
                check_class(site, known, diagnostics);
            }
            Some(_) => {}
            None if told.insert(filename) => {
                diagnostics.push(unknown(site, filename, told.len() <= MAX_SUGGESTIONS));
            }
            None => {}
        }
    }
}

fn unknown(site: &PluginSite<'_>, filename: &str, suggest: bool) -> Diagnostic {
    let message = format!("the plugin `{filename}` is unknown; it is kept, not run");
    let diagnostic = Diagnostic::warning("unknown-plugin", message).at(site.plugin.origin);
    let class = class_id(&site.plugin.name);
    let by_class = known()
        .find(|known| site.plugin.name.contains("::systems::") && known.classes.contains(&class));
    let meant = by_class.map(|known| known.id).or_else(|| {
        let id = library_id(filename);
        let (kind, core) = distinctive(&id);
        let alike = || known().map(|known| known.id).filter(|id| distinctive(id).0 == kind);
        if core.len() < 3 || !suggest {
            return None;
        }
        let expected = EXPECTED.iter().find(|(of, name, _)| *of == kind && *name == core);
        if let Some((_, _, library)) = expected {
            return Some(*library);
        }
        // The same core with other affixes: `gz-sim-imu` for `gz-sim-imu-system`.
        let same = alike().find(|id| distinctive(id).1 == core);
        same.or_else(|| {
            let near = closest(core, alike().map(|id| distinctive(id).1))?;
            alike().find(|id| distinctive(id).1 == near)
        })
    });
    match meant.and_then(|id| known().find(|known| known.id == id)) {
        Some(known) => diagnostic.help(format!("did you mean `{}`?", known.filename())),
        None => diagnostic,
    }
}

/// Type of a library name, and the part that distinguishes it from others of its type.
fn distinctive(id: &str) -> (u8, &str) {
    if let Some(core) = id.strip_prefix("gazebo_ros_") {
        return (1, core);
    }
    if id.starts_with("gz-sim-") || id.ends_with("-system") {
        let core = id.strip_prefix("gz-sim-").unwrap_or(id);
        return (2, core.strip_suffix("-system").unwrap_or(core));
    }
    (3, id.strip_suffix("Plugin").unwrap_or(id))
}

fn check_class(site: &PluginSite<'_>, known: &crate::PluginSpec, diagnostics: &mut Diagnostics) {
    let name = site.plugin.name.trim();
    let Some(usual) = known.classes.first() else { return };
    if name.is_empty()
        || site.context.place == PluginParent::Gui
        || known.classes.contains(&class_id(name))
    {
        return;
    }
    let namespace =
        if known.id.contains("ros2_control") { "gz_ros2_control" } else { "gz::sim::systems" };
    diagnostics.push(
        Diagnostic::warning(
            "plugin-class",
            format!("`{}` holds no class `{name}`; Gazebo would not load it", known.id),
        )
        .at(site.plugin.origin)
        .help(format!("write `name=\"{namespace}::{usual}\"`")),
    );
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use crate::fixture::check;

    #[test]
    fn an_unknown_plugin_is_told_once() {
        check(
            "<model name='m'>
  <plugin name='a' filename='libmy_robot.so'/>
  <plugin name='b' filename='libmy_robot.so'/>
</model>",
            expect![[r#"
                warning[unknown-plugin]: the plugin `libmy_robot.so` is unknown; it is kept, not run
                 --> test.sdf:2:3
                  |
                2 |   <plugin name='a' filename='libmy_robot.so'/>
                  |   ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
            "#]],
        );
    }

    #[test]
    fn a_slip_in_the_name_is_seen() {
        check(
            "<model name='m'>
  <plugin name='a' filename='libgazebo_ros_planer_move.so'/>
  <plugin name='gz::sim::systems::Imu' filename='gz-sim-imu'/>
  <plugin name='gz::sim::systems::Mine' filename='gz-sim-mine-system'/>
</model>",
            expect![[r#"
                warning[unknown-plugin]: the plugin `libgazebo_ros_planer_move.so` is unknown; it is kept, not run
                 --> test.sdf:2:3
                  |
                2 |   <plugin name='a' filename='libgazebo_ros_planer_move.so'/>
                  |   ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
                  |
                  = help: did you mean `libgazebo_ros_planar_move.so`?
                warning[unknown-plugin]: the plugin `gz-sim-imu` is unknown; it is kept, not run
                 --> test.sdf:3:3
                  |
                3 |   <plugin name='gz::sim::systems::Imu' filename='gz-sim-imu'/>
                  |   ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
                  |
                  = help: did you mean `gz-sim-imu-system`?
                warning[unknown-plugin]: the plugin `gz-sim-mine-system` is unknown; it is kept, not run
                 --> test.sdf:4:3
                  |
                4 |   <plugin name='gz::sim::systems::Mine' filename='gz-sim-mine-system'/>
                  |   ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
            "#]],
        );
    }

    #[test]
    fn a_name_that_people_expect_leads_to_the_library_that_does_it() {
        check(
            "<model name='m'>
  <plugin name='a' filename='libgazebo_ros_lidar.so'/>
  <plugin name='b' filename='libgazebo_ros_gps.so'/>
</model>",
            expect![[r#"
                warning[unknown-plugin]: the plugin `libgazebo_ros_lidar.so` is unknown; it is kept, not run
                 --> test.sdf:2:3
                  |
                2 |   <plugin name='a' filename='libgazebo_ros_lidar.so'/>
                  |   ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
                  |
                  = help: did you mean `libgazebo_ros_ray_sensor.so`?
                warning[unknown-plugin]: the plugin `libgazebo_ros_gps.so` is unknown; it is kept, not run
                 --> test.sdf:3:3
                  |
                3 |   <plugin name='b' filename='libgazebo_ros_gps.so'/>
                  |   ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
                  |
                  = help: did you mean `libgazebo_ros_gps_sensor.so`?
            "#]],
        );
    }

    #[test]
    fn every_expected_name_leads_to_a_known_library() {
        for (kind, name, library) in super::EXPECTED {
            let is_known = |id: &str| crate::known().any(|known| known.id == id);
            assert!(is_known(library), "{library}");
            let written = match kind {
                1 => format!("gazebo_ros_{name}"),
                _ => format!("gz-sim-{name}-system"),
            };
            assert!(!is_known(&written), "{written}");
        }
    }

    #[test]
    fn a_class_must_be_in_its_library() {
        check(
            "<world name='w'>
  <plugin name='gz::sim::systems::Phsics' filename='gz-sim-physics-system'/>
</world>",
            expect![[r#"
                warning[plugin-class]: `gz-sim-physics-system` holds no class `gz::sim::systems::Phsics`; Gazebo would not load it
                 --> test.sdf:2:3
                  |
                2 |   <plugin name='gz::sim::systems::Phsics' filename='gz-sim-physics-system'/>
                  |   ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
                  |
                  = help: write `name="gz::sim::systems::Physics"`
            "#]],
        );
    }
}
