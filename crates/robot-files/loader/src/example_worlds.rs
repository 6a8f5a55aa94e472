//! Built-in worlds with the names of Gazebo's examples. Demos and tutorials that start `gz sim shapes.sdf`
//! or `gz_args: -r sensors_demo.sdf` get a world with the expected models, sensors, plugins and topics.

mod parts;
mod robots;
mod worlds;

use std::path::Path;

use periplus_diagnostics::closest;

/// Meaning of the name of a world without a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Example {
    /// The text of a built-in world.
    BuiltIn(String),
    /// World of Gazebo that is not built in.
    OfGazebo,
    /// Not an example; with the most similar name.
    Unknown(Option<&'static str>),
}

/// Examples of Gazebo that are not built in: they need actors, water, comms, models of Fuel, or buildings.
const OF_GAZEBO: [&str; 44] = [
    "3k_shapes",
    "actor",
    "actor_crowd",
    "apply_joint_force",
    "apply_link_wrench",
    "auv_controls",
    "boundingbox_camera",
    "breadcrumbs",
    "buoyancy",
    "cafe",
    "conveyor",
    "default_with_actor",
    "detachable_joint",
    "dem_monterey_bay",
    "dem_moon",
    "dvl_world",
    "elevator",
    "fuel",
    "grid",
    "heightmap",
    "joint_trajectory_controller",
    "kinetic_energy_monitor",
    "levels",
    "lift_drag",
    "logical_camera_sensor",
    "lrauv_control_demo",
    "minimal_scene",
    "model_photo_shoot",
    "multicopter_velocity_control",
    "mud",
    "particle_emitter",
    "performer_detector",
    "plot_3d",
    "quadcopter",
    "robocup14_spl_field",
    "rubble",
    "segmentation_camera",
    "thermal_camera",
    "track_drive",
    "tunnel",
    "video_record_dbl_pendulum",
    "wide_angle_camera",
    "willowgarage",
    "wind",
];

/// Example named by a path without a file: a bare name, or one in `worlds/`, as Gazebo searches its own
/// folder of worlds.
pub(crate) fn find(path: &Path) -> Option<Example> {
    let folder = path.parent().and_then(Path::to_str).unwrap_or_default();
    if !["", "worlds", "."].contains(&folder) {
        return None;
    }
    let extension = path.extension()?.to_str()?;
    if !["sdf", "world"].contains(&extension) {
        return None;
    }
    let stem = path.file_stem()?.to_str()?;
    Some(match worlds::text(stem) {
        Some(text) => Example::BuiltIn(text),
        None if OF_GAZEBO.contains(&stem) => Example::OfGazebo,
        None => Example::Unknown(closest(stem, names())),
    })
}

/// Names of the built-in worlds, without `.sdf`.
pub fn names() -> impl Iterator<Item = &'static str> {
    worlds::WORLDS.iter().map(|(name, _)| *name)
}

#[cfg(test)]
mod tests {
    use periplus_resources::{MemoryHost, Resolver};

    use super::*;
    use crate::{LoadContext, load};

    #[test]
    fn every_world_is_found_by_its_bare_name_and_has_no_finding_but_its_origin() {
        let host = MemoryHost::new();
        let setting = LoadContext {
            host: &host,
            resolver: &Resolver::new(&host, &[]),
            working_folder: "/home".into(),
            arguments: Vec::new(),
            open_meshes: true,
        };
        for name in names() {
            let loaded = load(Path::new(&format!("{name}.sdf")), &setting);
            let codes: Vec<&str> = loaded.diagnostics.iter().map(|one| one.code).collect();
            assert_eq!(codes, ["example-world"], "{name}: {:?}", loaded.diagnostics);
            let scene = loaded.scene.expect("a scene");
            assert_eq!(scene.worlds.len(), 1, "{name}");
            assert!(!scene.worlds[0].models.is_empty(), "{name}");
        }
    }

    #[test]
    fn a_file_of_that_name_counts_more() {
        let own = "<sdf version='1.9'><world name='mine'><model name='m'><static>1</static>\
                   <link name='l'/></model></world></sdf>";
        let host = MemoryHost::new().with_file("/home/shapes.sdf", own);
        let setting = LoadContext {
            host: &host,
            resolver: &Resolver::new(&host, &[]),
            working_folder: "/home".into(),
            arguments: Vec::new(),
            open_meshes: true,
        };
        let loaded = load(Path::new("shapes.sdf"), &setting);
        assert_eq!(loaded.scene.expect("a scene").worlds[0].name, "mine");
        let codes = |path: &str| {
            let loaded = load(Path::new(path), &setting);
            let found = loaded.diagnostics.iter().next().expect("a finding").clone();
            (found.code, found.help.join(" "))
        };
        assert_eq!(codes("worlds/empty.world").0, "example-world");
        assert_eq!(codes("elsewhere/empty.sdf").0, "unreadable-file");
        assert!(codes("willowgarage.world").1.contains("GZ_SIM_RESOURCE_PATH"));
        assert!(codes("shaps.sdf").1.contains("`shapes.sdf`"));
    }
}
