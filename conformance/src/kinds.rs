//! Checks of the kinds of cases. A kind is one module with a `check`, and one line in
//! [`KINDS`].

use std::path::{Path, PathBuf};

use periplus_resources::{EntryKind, Host};

use crate::{Case, Differences, Unreadable};

mod amcl;
mod behavior_tree;
mod controllers;
mod costmap;
mod grid_coords;
mod map_load;
mod map_pixel;
mod map_save;
mod motion;
mod mppi;
mod path_expand;
mod planning;
mod raytrace_2d;
mod ros2_control;
mod rsp;
mod rviz_palette;
mod speed_limit;
mod teleop_keys;
mod tf2;

/// Runs the inputs of a case as a user of a distribution would, and records every difference.
pub type Check = fn(&Case, distro: &str, &Setting<'_>, &mut Differences) -> Result<(), Unreadable>;

/// Environment of a case.
#[derive(Clone, Copy)]
pub struct Setting<'a> {
    /// The folder of the cases.
    pub folder: &'a Path,
    /// The machine.
    pub host: &'a dyn Host,
}

impl Setting<'_> {
    /// A file that cases name, such as `nav2_maps/nav2_map_server/testmap.pgm`: in the folder of the
    /// cases, beside it, or in a folder `maps` beside it.
    #[must_use]
    pub fn file(&self, name: &str) -> Option<PathBuf> {
        let beside = self.folder.join("..");
        let in_maps = name.split_once('/').map(|(_, rest)| beside.join("maps").join(rest));
        let places = [Some(self.folder.join(name)), Some(beside.join(name)), in_maps];
        let mut places = places.into_iter().flatten();
        places.find(|place| self.host.kind(place) == Some(EntryKind::File))
    }
}

/// All kinds that are checked, in the order of their names.
pub const KINDS: &[(&str, Check)] = &[
    ("amcl_beam", amcl::check_beam),
    ("amcl_beams", amcl::check_beams),
    ("amcl_kld", amcl::check_kld),
    ("amcl_likelihood", amcl::check_likelihood),
    ("amcl_map", amcl::check_map),
    ("amcl_motion", amcl::check_motion),
    ("amcl_pose_file", amcl::check_pose_file),
    ("amcl_update", amcl::check_update),
    ("behavior_velocity", motion::check_behavior),
    ("binary_filter", costmap::check_binary),
    ("bt_control", behavior_tree::check_control),
    ("clear_area", costmap::check_clear_area),
    ("clear_service", costmap::check_clear_service),
    ("collision_checker_topic", costmap::check_footprint_cost),
    ("collision_monitor", motion::check_monitor),
    ("costmap_publisher", costmap::check_publisher),
    ("costmap_to_occgrid", costmap::check_to_occupancy),
    ("declare_params", costmap::check_parameters),
    ("denoise", costmap::check_denoise),
    ("diff_drive_odometry", ros2_control::check_odometry),
    ("dwb_critic", controllers::check_critic),
    ("dwb_trajectory", controllers::check_trajectory),
    ("dwb_velocity_samples", controllers::check_samples),
    ("footprint", costmap::check_footprint),
    ("footprint_cost", costmap::check_footprint_cost),
    ("goal_checker", controllers::check_goal),
    ("graceful_control_law", controllers::check_law),
    ("grid_coords", grid_coords::check),
    ("inflation_cost", costmap::check_inflation),
    ("keepout_filter", costmap::check_keepout),
    ("laser_projection", costmap::check_projection),
    ("layered_costmap", costmap::check_layered),
    ("lifecycle_order", motion::check_lifecycle),
    ("map_load", map_load::check),
    ("map_pixel", map_pixel::check),
    ("map_save", map_save::check),
    ("map_save_pixel", map_save::check_pixels),
    ("mask_cost", costmap::check_to_cost),
    ("mppi_critic", mppi::check_critic),
    ("mppi_filter", mppi::check_filter),
    ("mppi_rollout", mppi::check_rollout),
    ("mppi_update", mppi::check_update),
    ("navfn", planning::check_navfn),
    ("observation_buffer", costmap::check_buffer),
    ("obstacle_layer", costmap::check_obstacle),
    ("occgrid_to_costmap", costmap::check_to_cost),
    ("path_expand", path_expand::check),
    ("path_smoother", planning::check_smoother),
    ("planner_grid_coords", planning::check_grid_coords),
    ("progress_checker", controllers::check_progress),
    ("range_sensor_layer", costmap::check_layered),
    ("range_sensor_model", costmap::check_range_model),
    ("raytrace_2d", raytrace_2d::check),
    ("recovery_helps", behavior_tree::check_recovery),
    ("rotate_to_heading", controllers::check_rotation),
    ("rpp_lookahead", controllers::check_lookahead),
    ("rpp_regulation", controllers::check_regulation),
    ("rsp", rsp::check),
    ("rviz_palette", rviz_palette::check),
    ("smac_primitives", planning::check_primitives),
    ("smac_traversal_cost", planning::check_traversal_cost),
    ("speed_filter", costmap::check_speed),
    ("speed_limit", speed_limit::check),
    ("static_layer_value", costmap::check_static),
    ("teleop_keys", teleop_keys::check),
    ("tf2_advanced", tf2::check_lookup),
    ("tf2_cache", tf2::check_cache),
    ("tf2_frames_yaml", tf2::check_frames_yaml),
    ("tf2_lookup", tf2::check_lookup),
    ("tf2_set", tf2::check_set),
    ("tf2_static", tf2::check_lookup),
    ("velocity_smoother", motion::check_smoother),
    ("voxel_grid", costmap::check_voxels),
    ("wheel_commands", ros2_control::check_commands),
];
