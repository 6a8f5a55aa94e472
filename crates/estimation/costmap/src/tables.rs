//! The parameters of a costmap, its layers and its filters, by the names and with the defaults that
//! Nav2 has for them.
//!
//! Sources: `nav2_costmap_2d/src/costmap_2d_ros.cpp` and `plugins/*.cpp` (main, 2026-08).

use periplus_params::{NamedEntity, Parameter, Table, choice, flag, integer, number, text, texts};

// What several layers or filters have.
const LAYER_ENABLED: Parameter = flag("enabled", "Whether the layer takes part.").or("true");
const FILTER_ENABLED: Parameter = flag("enabled", "Whether the filter takes part.").or("true");
const FILTER_INFO_TOPIC: Parameter =
    text("filter_info_topic", "Topic that tells where the mask is.")
        .required()
        .naming(NamedEntity::Topic);
const MASK_TOLERANCE: Parameter =
    number("transform_tolerance", "s", "How old the transform of the mask may be.")
        .or("0.1")
        .min(0.0);
const COMBINATION_METHOD: Parameter =
    integer("combination_method", "0 overwrite, 1 maximum, 2 maximum of what is known.").or("1");
const FOOTPRINT_CLEARING: Parameter =
    flag("footprint_clearing_enabled", "Whether cells under the robot are free.").or("true");
const MIN_HEIGHT: Parameter =
    number("min_obstacle_height", "m", "Lower points do not mark.").or("0");
const MAX_HEIGHT: Parameter =
    number("max_obstacle_height", "m", "Higher points do not mark.").or("2");
const OBSERVATION_SOURCES: Parameter =
    text("observation_sources", "Names of the sources, separated by blanks.").or("");
const TF_FILTER_TOLERANCE: Parameter =
    number("tf_filter_tolerance", "s", "How far transforms may lag behind.").or("0.05");

/// Of the node.
pub static COSTMAP: Table = Table {
    name: "the costmap",
    doc: "A costmap of layers.",
    parameters: &[
        flag("always_send_full_costmap", "Whether each publication is the whole grid.").or("false"),
        number("map_vis_z", "m", "Height at which the grid is shown.").or("0"),
        number("footprint_padding", "m", "How much the outline of the robot is enlarged.")
            .or("0.01")
            .min(0.0),
        text("footprint", "Corners of the robot, `[[x, y], ...]`; goes before `robot_radius`.")
            .or("[]"),
        number("robot_radius", "m", "Radius of a round robot.").or("0.1").min(0.0),
        text("global_frame", "The frame of the costmap.").or("map").naming(NamedEntity::Frame),
        text("robot_base_frame", "The frame of the robot.").or("base_link").naming(NamedEntity::Frame),
        integer("width", "Length along x, in whole metres.").or("5").within(1.0, 1_000_000.0),
        integer("height", "Length along y, in whole metres.").or("5").within(1.0, 1_000_000.0),
        number("resolution", "m", "Length of a side of a cell.").or("0.1").above(0.0),
        number("origin_x", "m", "Lower left corner.").or("0"),
        number("origin_y", "m", "Lower left corner.").or("0"),
        flag("rolling_window", "Whether the costmap moves with the robot.").or("false"),
        flag("track_unknown_space", "Whether unseen cells are unknown instead of free.")
            .or("false"),
        number("update_frequency", "Hz", "How often costs are made anew; 0 for never.")
            .or("5")
            .min(0.0),
        number("publish_frequency", "Hz", "How often costs are published; 0 or less for never.")
            .or("1"),
        number("transform_tolerance", "s", "How old the pose of the robot may be.")
            .or("0.3")
            .min(0.0),
        number("initial_transform_timeout", "s", "How long activation waits for the robot's pose.")
            .or("60")
            .min(0.0),
        texts("plugins", "Names of the layers, lowest first.")
            .or("static_layer obstacle_layer inflation_layer"),
        texts("filters", "Names of the filters, lowest first.").or(""),
        flag("subscribe_to_stamped_footprint", "Whether topic `footprint` is a PolygonStamped.")
            .or("false"),
        integer("lethal_cost_threshold", "From which number on a map's cell is lethal.").or("100"),
        integer("unknown_cost_value", "Which number in a map is unknown; 255 stands for -1.")
            .or("255"),
        flag("trinary_costmap", "Whether a map's cells are free, lethal or unknown only.")
            .or("true"),
        integer("inscribed_obstacle_cost_value", "Which number in a map is inscribed.").or("99"),
        flag("use_maximum", "Whether a map only raises costs.").or("false"),
        flag("allow_parameter_qos_overrides", "Whether parameters may set QoS.").or("true"),
        text("observation_sources", "Unused; layers have their own.").or(""),
        text("map_topic", "Topic of the map for layers that name none.").or(""),
        flag("use_sim_time", "Whether time comes from `/clock`.").or("false"),
        number(
            "bond_heartbeat_period",
            "s",
            "Period of the heartbeats to a lifecycle manager; no bond if not positive.",
        )
        .or("0.1"),
        text("service_introspection_mode", "Unused; services are not recorded.").or("disabled"),
        choice(
            "compat",
            &crate::Compat::NAMES,
            "Release of Nav2 whose behaviour is kept where releases differ; `jazzy-1.3.10` is Jazzy up to \
             Nav2 1.3.10.",
        )
        .or("main"),
    ],
};

/// Of a static layer.
pub static STATIC: Table = Table {
    name: "a static layer",
    doc: "A map.",
    parameters: &[
        LAYER_ENABLED,
        flag("subscribe_to_updates", "Whether to listen to `<map_topic>_updates`.").or("false"),
        flag("map_subscribe_transient_local", "Whether to get a map published earlier.").or("true"),
        text("map_topic", "Topic of the map.").or("").naming(NamedEntity::Topic),
        flag("footprint_clearing_enabled", "Whether cells under the robot are free.").or("false"),
        flag("restore_cleared_footprint", "Whether they get their cost back when it has left.")
            .or("true"),
        number("transform_tolerance", "s", "How old the transform of the map may be.")
            .or("0")
            .min(0.0),
    ],
};

/// Of an obstacle layer.
pub static OBSTACLE: Table = Table {
    name: "an obstacle layer",
    doc: "What sensors see, on the ground.",
    parameters: &[
        LAYER_ENABLED,
        FOOTPRINT_CLEARING,
        MIN_HEIGHT,
        MAX_HEIGHT,
        COMBINATION_METHOD,
        OBSERVATION_SOURCES,
        TF_FILTER_TOLERANCE,
    ],
};

/// Of a voxel layer.
pub static VOXEL: Table = Table {
    name: "a voxel layer",
    doc: "What sensors see, in columns of voxels.",
    parameters: &[
        LAYER_ENABLED,
        FOOTPRINT_CLEARING,
        MIN_HEIGHT,
        MAX_HEIGHT,
        COMBINATION_METHOD,
        OBSERVATION_SOURCES,
        TF_FILTER_TOLERANCE,
        number("origin_z", "m", "Height of the lowest voxels.").or("0"),
        number("z_resolution", "m", "Height of a voxel.").or("0.2").above(0.0),
        integer("z_voxels", "Voxels in a column; 16 at most.").or("10").within(0.0, 1000.0),
        integer("unknown_threshold", "A column with more unknown voxels is unknown.")
            .or("15")
            .min(0.0),
        integer("mark_threshold", "A column with more marked voxels is an obstacle.")
            .or("0")
            .min(0.0),
        flag("publish_voxel_map", "Whether voxels are published.").or("false"),
    ],
};

/// Of a source of an obstacle or voxel layer.
pub static SOURCE: Table = Table {
    name: "an observation source",
    doc: "A sensor that marks and clears.",
    parameters: &[
        text("topic", "Its topic; the name of the source if it is not set.")
            .or("")
            .naming(NamedEntity::Topic),
        text("sensor_frame", "Where rays begin; the frame of the message if it is not set.")
            .or("")
            .naming(NamedEntity::Frame),
        number("observation_persistence", "s", "How long readings count; 0 for the newest only.")
            .or("0")
            .min(0.0),
        number("expected_update_rate", "s", "A longer silence is an error; 0 for any.")
            .or("0")
            .min(0.0),
        choice("data_type", &["LaserScan", "PointCloud2"], "What comes.").or("LaserScan"),
        number("min_obstacle_height", "m", "Lower points are dropped, for rays as well.").or("0"),
        number("max_obstacle_height", "m", "Higher points are dropped, for rays as well.").or("0"),
        flag("inf_is_valid", "Whether infinite ranges clear up to the largest range.").or("false"),
        flag("marking", "Whether it marks obstacles.").or("true"),
        flag("clearing", "Whether it clears what it sees through.").or("false"),
        number("obstacle_max_range", "m", "Points further away do not mark.")
            .or("2.5")
            .also(&["obstacle_range"]),
        number("obstacle_min_range", "m", "Points nearer do not mark.").or("0"),
        number("raytrace_max_range", "m", "Rays clear as far.").or("3").also(&["raytrace_range"]),
        number("raytrace_min_range", "m", "Rays clear from here on.").or("0"),
        text("transport_type", "How clouds are packed; only `raw` is read.").or("raw"),
    ],
};

/// Of a range layer.
pub static RANGE: Table = Table {
    name: "a range layer",
    doc: "Sonars and other sensors with one wide beam.",
    parameters: &[
        LAYER_ENABLED,
        number("phi", "m", "Distance at which a reading counts half.").or("1.2"),
        number("inflate_cone", "", "How far beyond the cone cells are touched, in parts of it.")
            .or("1")
            .within(0.0, 1.0),
        number("no_readings_timeout", "s", "A longer silence is an error; 0 for any.")
            .or("0")
            .min(0.0),
        number("clear_threshold", "", "Less probable cells are free.").or("0.2").within(0.0, 1.0),
        number("mark_threshold", "", "More probable cells are lethal.").or("0.8").within(0.0, 1.0),
        flag("clear_on_max_reading", "Whether a reading at the largest range clears.").or("false"),
        texts("topics", "Topics of the sensors.").or(""),
        text("input_sensor_type", "VARIABLE, FIXED or ALL.").or("ALL"),
    ],
};

/// Of an inflation layer.
pub static INFLATION: Table = Table {
    name: "an inflation layer",
    doc: "Costs that fall with the distance from obstacles.",
    parameters: &[
        LAYER_ENABLED,
        number("inflation_radius", "m", "How far costs reach; 0 for not at all.")
            .or("0.55")
            .min(0.0),
        number("cost_scaling_factor", "", "How steeply they fall.").or("10").min(0.0),
        flag("inflate_unknown", "Whether unknown cells get costs.").or("false"),
        flag("inflate_around_unknown", "Whether unknown cells are obstacles here.").or("false"),
        integer("num_threads", "Taken in and not needed: one is fast enough.").or("-1"),
        number("custom_inscribed_radius", "m", "In the place of the footprint's, if not negative.")
            .or("-1"),
    ],
};

/// Of a denoise layer.
pub static DENOISE: Table = Table {
    name: "a denoise layer",
    doc: "Takes out obstacles that are too small.",
    parameters: &[
        LAYER_ENABLED,
        integer("minimal_group_size", "Smaller groups go; 1 keeps all.").or("2"),
        integer("group_connectivity_type", "Whether 4 or 8 neighbours make a group.").or("8"),
    ],
};

/// Of a container of layers.
pub static CONTAINER: Table = Table {
    name: "a container of layers",
    doc: "Layers with a grid of their own.",
    parameters: &[
        LAYER_ENABLED,
        texts("plugins", "Names of the layers within, lowest first.").or(""),
        COMBINATION_METHOD,
    ],
};

/// Of a keepout filter.
pub static KEEPOUT: Table = Table {
    name: "a keepout filter",
    doc: "Where a robot must not go.",
    parameters: &[
        FILTER_ENABLED,
        FILTER_INFO_TOPIC,
        MASK_TOLERANCE,
        flag("override_lethal_cost", "Whether a robot in a zone may leave it.").or("false"),
        integer("lethal_override_cost", "The cost of zones then, 252 at most.").or("252"),
    ],
};

/// Of a speed filter.
pub static SPEED: Table = Table {
    name: "a speed filter",
    doc: "Where a robot must go slowly.",
    parameters: &[
        FILTER_ENABLED,
        FILTER_INFO_TOPIC,
        MASK_TOLERANCE,
        text("speed_limit_topic", "Where limits are published.").or("speed_limit"),
        flag("enable_path_lookahead", "Whether limits ahead on the path count.").or("false"),
        number("max_decel", "m/s2", "How hard the robot brakes; negative.").or("-0.5"),
        number("min_lookahead", "m", "How far to look at least.").or("0.3"),
        number("max_lookahead", "m", "How far to look at most.").or("5"),
        text("path_topic", "The path.").or("plan").naming(NamedEntity::Topic),
        text("odom_topic", "The robot's speed.").or("odom").naming(NamedEntity::Topic),
    ],
};

/// Of a binary filter.
pub static BINARY: Table = Table {
    name: "a binary filter",
    doc: "Where something is to be switched.",
    parameters: &[
        FILTER_ENABLED,
        FILTER_INFO_TOPIC,
        MASK_TOLERANCE,
        flag("default_state", "The state outside of all zones.").or("false"),
        text("binary_state_topic", "Where the state is published.").or("binary_state"),
        number("flip_threshold", "", "Above this the state is the other one.").or("50"),
    ],
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_table_has_slips() {
        for table in [
            &COSTMAP, &STATIC, &OBSTACLE, &VOXEL, &SOURCE, &RANGE, &INFLATION, &DENOISE,
            &CONTAINER, &KEEPOUT, &SPEED, &BINARY,
        ] {
            assert_eq!(table.faults(), [""; 0]);
        }
    }
}
