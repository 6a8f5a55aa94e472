//! Sensors of current Gazebo without a system that runs them.

use std::collections::BTreeSet;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_scene::{Model, Sensor, World};

use crate::library::library_id;
use crate::{Family, InterpretedPlugin, PluginSite};

/// System that runs a type of sensor, and its class.
fn system_for(sensor_type: &str) -> Option<(&'static str, &'static str)> {
    Some(match sensor_type {
        "camera"
        | "depth"
        | "depth_camera"
        | "rgbd"
        | "rgbd_camera"
        | "gpu_lidar"
        | "gpu_ray"
        | "thermal"
        | "thermal_camera"
        | "segmentation"
        | "segmentation_camera"
        | "boundingbox"
        | "boundingbox_camera"
        | "wideanglecamera"
        | "wide_angle_camera" => ("sensors", "Sensors"),
        "imu" => ("imu", "Imu"),
        "magnetometer" => ("magnetometer", "Magnetometer"),
        "altimeter" => ("altimeter", "Altimeter"),
        "air_pressure" => ("air-pressure", "AirPressure"),
        "air_speed" => ("air-speed", "AirSpeed"),
        "navsat" | "gps" => ("navsat", "NavSat"),
        "force_torque" => ("forcetorque", "ForceTorque"),
        "contact" => ("contact", "Contact"),
        "logical_camera" => ("logical-camera", "LogicalCamera"),
        _ => return None,
    })
}

/// Types that Gazebo Classic does not have: a world with them is for current Gazebo.
const NEW_TYPES: [&str; 11] = [
    "gpu_lidar",
    "rgbd_camera",
    "rgbd",
    "depth_camera",
    "thermal_camera",
    "thermal",
    "segmentation",
    "segmentation_camera",
    "boundingbox",
    "boundingbox_camera",
    "navsat",
];

pub(super) fn check(
    world: &World,
    plugins: &[(PluginSite<'_>, InterpretedPlugin)],
    diagnostics: &mut Diagnostics,
) {
    let here: Vec<&(PluginSite<'_>, InterpretedPlugin)> = plugins
        .iter()
        .filter(|(site, _)| site.context.world.is_some_and(|other| std::ptr::eq(other, world)))
        .collect();
    let mut sensors = Vec::new();
    for model in &world.models {
        gather(model, &mut sensors);
    }
    if !is_for_today(world, &here, &sensors) {
        return;
    }
    let running: BTreeSet<&str> = here.iter().map(|(_, plugin)| plugin.known.id).collect();
    let mut told = BTreeSet::new();
    for sensor in &sensors {
        let kind = sensor.type_name.as_str();
        if matches!(kind, "lidar" | "ray") {
            diagnostics.push(
                Diagnostic::hint(
                    "cpu-lidar",
                    format!("Gazebo ignores sensors of type `{kind}`; Periplus runs them"),
                )
                .at(sensor.origin)
                .help("for Gazebo write `type=\"gpu_lidar\"`"),
            );
        }
        if matches!(kind, "navsat" | "gps") && world.spherical_coordinates.is_none() {
            let message = format!("the sensor `{}` has no geographic position", sensor.name);
            diagnostics.push(
                Diagnostic::warning("no-place-on-earth", message)
                    .at(sensor.origin)
                    .related(world.origin, "this world has no `<spherical_coordinates>`")
                    .help(
                        "add `<spherical_coordinates>` with `<latitude_deg>` and \
                         `<longitude_deg>` to the world",
                    ),
            );
        }
        let Some((part, class)) = system_for(kind) else { continue };
        let id = format!("gz-sim-{part}-system");
        if !running.contains(&*id) && told.insert(part) {
            let others =
                sensors.iter().filter(|s| system_for(&s.type_name) == Some((part, class))).count()
                    - 1;
            diagnostics.push(silent(world, sensor, part, class, others));
        }
    }
}

fn silent(world: &World, sensor: &Sensor, part: &str, class: &str, others: usize) -> Diagnostic {
    let also = match others {
        0 => String::new(),
        1 => " (and another sensor)".to_owned(),
        more => format!(" (and {more} other sensors)"),
    };
    let message = format!(
        "in Gazebo the sensor `{}`{also} stays silent: the world does not load the system `{class}`",
        sensor.name
    );
    // Fortress has only the old names, which current Gazebo accepts too.
    let old = world.plugins.iter().any(|plugin| plugin.filename.contains("ignition-gazebo"));
    let (file, namespace) =
        if old { ("ignition-gazebo", "ignition::gazebo") } else { ("gz-sim", "gz::sim") };
    let start =
        format!("<plugin filename=\"{file}-{part}-system\" name=\"{namespace}::systems::{class}\"");
    let line = if part == "sensors" {
        format!("{start}><render_engine>ogre2</render_engine></plugin>")
    } else {
        format!("{start}/>")
    };
    let diagnostic = Diagnostic::warning("silent-sensor", message)
        .at(sensor.origin)
        .related(world.origin, "this world")
        .help(format!("add `{line}` to the world"));
    if world.plugins.is_empty() {
        diagnostic.note(
            "a world without any plugin gets Physics, UserCommands and SceneBroadcaster; once it \
             has one, it must list these too",
        )
    } else {
        diagnostic.note("Periplus runs the sensor all the same")
    }
}

fn is_for_today(
    world: &World,
    here: &[&(PluginSite<'_>, InterpretedPlugin)],
    sensors: &[&Sensor],
) -> bool {
    let system =
        |plugin: &periplus_scene::Plugin| library_id(&plugin.filename).starts_with("gz-sim-");
    if world.plugins.iter().any(system) {
        return true;
    }
    let classic = here.iter().any(|(_, plugin)| plugin.known.family != Family::Gz);
    let today = here.iter().any(|(_, plugin)| plugin.known.family == Family::Gz)
        || sensors.iter().any(|sensor| NEW_TYPES.contains(&sensor.type_name.as_str()));
    !classic && today
}

fn gather<'a>(model: &'a Model, sensors: &mut Vec<&'a Sensor>) {
    for link in &model.links {
        sensors.extend(&link.sensors);
    }
    for joint in &model.joints {
        sensors.extend(&joint.sensors);
    }
    for nested in &model.models {
        gather(nested, sensors);
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use crate::fixture::check;

    #[test]
    fn a_lidar_needs_the_sensors_system() {
        check(
            "<world name='w'>
<plugin filename='gz-sim-physics-system' name='gz::sim::systems::Physics'/>
<model name='m'><link name='l'>
  <sensor name='front' type='gpu_lidar'/>
  <sensor name='back' type='gpu_lidar'/>
  <sensor name='imu' type='imu'/>
</link></model></world>",
            expect![[r#"
                warning[silent-sensor]: in Gazebo the sensor `front` (and another sensor) stays silent: the world does not load the system `Sensors`
                 --> test.sdf:4:3
                  |
                1 | <world name='w'>
                  | ---------------- this world
                ...
                4 |   <sensor name='front' type='gpu_lidar'/>
                  |   ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
                  |
                  = note: Periplus runs the sensor all the same
                  = help: add `<plugin filename="gz-sim-sensors-system" name="gz::sim::systems::Sensors"><render_engine>ogre2</render_engine></plugin>` to the world
                warning[silent-sensor]: in Gazebo the sensor `imu` stays silent: the world does not load the system `Imu`
                 --> test.sdf:6:3
                  |
                1 | <world name='w'>
                  | ---------------- this world
                ...
                6 |   <sensor name='imu' type='imu'/>
                  |   ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
                  |
                  = note: Periplus runs the sensor all the same
                  = help: add `<plugin filename="gz-sim-imu-system" name="gz::sim::systems::Imu"/>` to the world
            "#]],
        );
    }

    #[test]
    fn old_names_are_answered_with_old_names() {
        check(
            "<world name='w'>
<plugin filename='libignition-gazebo-physics-system.so' name='ignition::gazebo::systems::Physics'/>
<model name='m'><link name='l'><sensor name='touch' type='contact'/></link></model></world>",
            expect![[r#"
                warning[silent-sensor]: in Gazebo the sensor `touch` stays silent: the world does not load the system `Contact`
                 --> test.sdf:3:32
                  |
                1 | <world name='w'>
                  | ---------------- this world
                2 | <plugin filename='libignition-gazebo-physics-system.so' name='ignition::gazebo::systems::Physics'/>
                3 | <model name='m'><link name='l'><sensor name='touch' type='contact'/></link></model></world>
                  |                                ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
                  |
                  = note: Periplus runs the sensor all the same
                  = help: add `<plugin filename="ignition-gazebo-contact-system" name="ignition::gazebo::systems::Contact"/>` to the world
            "#]],
        );
    }

    #[test]
    fn without_any_plugin_sensors_are_silent_too() {
        check(
            "<world name='w'><model name='m'><link name='l'>
<sensor name='eye' type='rgbd_camera'/></link></model></world>",
            expect![[r#"
                warning[silent-sensor]: in Gazebo the sensor `eye` stays silent: the world does not load the system `Sensors`
                 --> test.sdf:2:1
                  |
                1 | <world name='w'><model name='m'><link name='l'>
                  | ---------------- this world
                2 | <sensor name='eye' type='rgbd_camera'/></link></model></world>
                  | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
                  |
                  = note: a world without any plugin gets Physics, UserCommands and SceneBroadcaster; once it has one, it must list these too
                  = help: add `<plugin filename="gz-sim-sensors-system" name="gz::sim::systems::Sensors"><render_engine>ogre2</render_engine></plugin>` to the world
            "#]],
        );
    }

    #[test]
    fn classic_needs_no_systems() {
        check(
            "<world name='w'><model name='m'><link name='l'>
<sensor name='eye' type='camera'/><sensor name='imu' type='imu'/></link></model></world>",
            expect![[""]],
        );
    }

    #[test]
    fn satellites_need_an_earth() {
        check(
            "<world name='w'>
<plugin filename='gz-sim-navsat-system' name='gz::sim::systems::NavSat'/>
<model name='m'><link name='l'><sensor name='gps' type='navsat'/></link></model></world>",
            expect![[r#"
                warning[no-place-on-earth]: the sensor `gps` has no geographic position
                 --> test.sdf:3:32
                  |
                1 | <world name='w'>
                  | ---------------- this world has no `<spherical_coordinates>`
                2 | <plugin filename='gz-sim-navsat-system' name='gz::sim::systems::NavSat'/>
                3 | <model name='m'><link name='l'><sensor name='gps' type='navsat'/></link></model></world>
                  |                                ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
                  |
                  = help: add `<spherical_coordinates>` with `<latitude_deg>` and `<longitude_deg>` to the world
            "#]],
        );
    }

    #[test]
    fn a_cpu_lidar_is_ignored_by_gazebo() {
        check(
            "<world name='w'>
<plugin filename='gz-sim-sensors-system' name='gz::sim::systems::Sensors'/>
<model name='m'><link name='l'><sensor name='scan' type='lidar'/></link></model></world>",
            expect![[r#"
                hint[cpu-lidar]: Gazebo ignores sensors of type `lidar`; Periplus runs them
                 --> test.sdf:3:32
                  |
                3 | <model name='m'><link name='l'><sensor name='scan' type='lidar'/></link></model></world>
                  |                                ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
                  |
                  = help: for Gazebo write `type="gpu_lidar"`
            "#]],
        );
    }
}
