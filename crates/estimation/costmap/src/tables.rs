//! Parameters of a costmap, its layers and its filters, with the names and defaults of Nav2.
//!
//! Sources: `nav2_costmap_2d/src/costmap_2d_ros.cpp` and `plugins/*.cpp` (main, 2026-08).

use periplus_params::{NamedEntity, Parameter, Table, choice, flag, integer, number, text, texts};

// Parameters shared by several layers or filters.
const LAYER_ENABLED: Parameter = flag("enabled", "Enables the layer.").or("true");
const FILTER_ENABLED: Parameter = flag("enabled", "Enables the filter.").or("true");
const FILTER_INFO_TOPIC: Parameter =
    text("filter_info_topic", "Topic of the filter info, which contains the topic of the mask.")
        .required()
        .naming(NamedEntity::Topic);
const MASK_TOLERANCE: Parameter =
    number("transform_tolerance", "s", "Maximum age of the transform of the mask.")
        .or("0.1")
        .min(0.0);
const COMBINATION_METHOD: Parameter =
    integer("combination_method", "0 overwrite, 1 maximum, 2 maximum of known costs.").or("1");
const FOOTPRINT_CLEARING: Parameter =
    flag("footprint_clearing_enabled", "Sets cells under the robot to free.").or("true");
const MIN_HEIGHT: Parameter =
    number("min_obstacle_height", "m", "Minimum height of points that mark.").or("0");
const MAX_HEIGHT: Parameter =
    number("max_obstacle_height", "m", "Maximum height of points that mark.").or("2");
const OBSERVATION_SOURCES: Parameter =
    text("observation_sources", "Names of the sources, separated by blanks.").or("");
const TF_FILTER_TOLERANCE: Parameter =
    number("tf_filter_tolerance", "s", "Maximum delay of transforms.").or("0.05");

/// Parameters of the node.
pub static COSTMAP: Table = Table {
    name: "the costmap",
    doc: "A costmap of layers.",
    parameters: &[
        flag("always_send_full_costmap", "Publishes the whole grid each time, instead of updates.").or("false"),
        number("map_vis_z", "m", "Height of the published grid.").or("0"),
        number("footprint_padding", "m", "Padding added to the footprint.")
            .or("0.01")
            .min(0.0),
        text("footprint", "Corners of the robot, `[[x, y], ...]`; overrides `robot_radius`.")
            .or("[]"),
        number("robot_radius", "m", "Radius of a round robot.").or("0.1").min(0.0),
        text("global_frame", "Frame of the costmap.").or("map").naming(NamedEntity::Frame),
        text("robot_base_frame", "Base frame of the robot.").or("base_link").naming(NamedEntity::Frame),
        integer("width", "Length along x, in whole metres.").or("5").within(1.0, 1_000_000.0),
        integer("height", "Length along y, in whole metres.").or("5").within(1.0, 1_000_000.0),
        number("resolution", "m", "Side length of a cell.").or("0.1").above(0.0),
        number("origin_x", "m", "Lower left corner, x.").or("0"),
        number("origin_y", "m", "Lower left corner, y.").or("0"),
        flag("rolling_window", "Centres the costmap on the robot.").or("false"),
        flag("track_unknown_space", "Keeps unobserved cells unknown instead of free.")
            .or("false"),
        number("update_frequency", "Hz", "Rate of updates; 0 for none.")
            .or("5")
            .min(0.0),
        number("publish_frequency", "Hz", "Rate of publication; 0 or less for none.")
            .or("1"),
        number("transform_tolerance", "s", "Maximum age of the pose of the robot.")
            .or("0.3")
            .min(0.0),
        number("initial_transform_timeout", "s", "Maximum time that activation waits for the pose of the robot.")
            .or("60")
            .min(0.0),
        texts("plugins", "Names of the layers, lowest first.")
            .or("static_layer obstacle_layer inflation_layer"),
        texts("filters", "Names of the filters, lowest first.").or(""),
        flag("subscribe_to_stamped_footprint", "Subscribes to `footprint` as PolygonStamped instead of Polygon.")
            .or("false"),
        integer("lethal_cost_threshold", "Minimum map value of lethal cells.").or("100"),
        integer("unknown_cost_value", "Map value of unknown cells; 255 represents -1.")
            .or("255"),
        flag("trinary_costmap", "Converts a map to free, lethal and unknown cells only.")
            .or("true"),
        integer("inscribed_obstacle_cost_value", "Map value of inscribed cells.").or("99"),
        flag("use_maximum", "Combines maps by maximum, so that they only raise costs.").or("false"),
        flag("allow_parameter_qos_overrides", "Allows parameters to set QoS.").or("true"),
        text("observation_sources", "Unused; each layer has this parameter.").or(""),
        text("map_topic", "Default topic of the map for static layers.").or(""),
        flag("use_sim_time", "Uses the time of `/clock`.").or("false"),
        number(
            "bond_heartbeat_period",
            "s",
            "Period of the heartbeats to a lifecycle manager; no bond if not positive.",
        )
        .or("0.1"),
        text("service_introspection_mode", "Unused; service introspection is not supported.").or("disabled"),
        choice(
            "compat",
            &crate::Nav2Release::NAMES,
            "Release of Nav2 whose behaviour is used where releases differ; `jazzy-1.3.10` is Jazzy up to \
             Nav2 1.3.10.",
        )
        .or("main"),
    ],
};

/// Parameters of a static layer.
pub static STATIC: Table = Table {
    name: "a static layer",
    doc: "A layer with a map.",
    parameters: &[
        LAYER_ENABLED,
        flag("subscribe_to_updates", "Subscribes to `<map_topic>_updates`.").or("false"),
        flag(
            "map_subscribe_transient_local",
            "Subscribes with transient-local durability, which delivers a map published earlier.",
        )
        .or("true"),
        text("map_topic", "Topic of the map.").or("").naming(NamedEntity::Topic),
        flag("footprint_clearing_enabled", "Sets cells under the robot to free.").or("false"),
        flag("restore_cleared_footprint", "Restores the cleared costs after the robot has left.")
            .or("true"),
        number("transform_tolerance", "s", "Maximum age of the transform of the map.")
            .or("0")
            .min(0.0),
    ],
};

/// Parameters of an obstacle layer.
pub static OBSTACLE: Table = Table {
    name: "an obstacle layer",
    doc: "Obstacles seen by sensors, in the plane.",
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

/// Parameters of a voxel layer.
pub static VOXEL: Table = Table {
    name: "a voxel layer",
    doc: "Obstacles seen by sensors, in columns of voxels.",
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
        integer("z_voxels", "Number of voxels in a column, at most 16.")
            .or("10")
            .within(0.0, 1000.0),
        integer("unknown_threshold", "Maximum number of unknown voxels in a known column.")
            .or("15")
            .min(0.0),
        integer("mark_threshold", "Maximum number of marked voxels in a free column.")
            .or("0")
            .min(0.0),
        flag("publish_voxel_map", "Publishes the voxels.").or("false"),
    ],
};

/// Parameters of a source of an obstacle or voxel layer.
pub static SOURCE: Table = Table {
    name: "an observation source",
    doc: "A sensor that marks and clears obstacles.",
    parameters: &[
        text("topic", "Topic; default: the name of the source.").or("").naming(NamedEntity::Topic),
        text("sensor_frame", "Frame of the sensor origin; default: the frame of the message.")
            .or("")
            .naming(NamedEntity::Frame),
        number(
            "observation_persistence",
            "s",
            "Duration for which readings are kept; 0 for the newest only.",
        )
        .or("0")
        .min(0.0),
        number("expected_update_rate", "s", "Maximum interval between messages; 0 for no limit.")
            .or("0")
            .min(0.0),
        choice("data_type", &["LaserScan", "PointCloud2"], "Message type.").or("LaserScan"),
        number("min_obstacle_height", "m", "Minimum height of points, for marking and clearing.")
            .or("0"),
        number("max_obstacle_height", "m", "Maximum height of points, for marking and clearing.")
            .or("0"),
        flag("inf_is_valid", "Clears up to the maximum range for infinite ranges.").or("false"),
        flag("marking", "Marks obstacles.").or("true"),
        flag("clearing", "Clears cells along rays.").or("false"),
        number("obstacle_max_range", "m", "Maximum distance of points that mark.")
            .or("2.5")
            .also(&["obstacle_range"]),
        number("obstacle_min_range", "m", "Minimum distance of points that mark.").or("0"),
        number("raytrace_max_range", "m", "Maximum distance at which rays clear.")
            .or("3")
            .also(&["raytrace_range"]),
        number("raytrace_min_range", "m", "Minimum distance at which rays clear.").or("0"),
        text("transport_type", "Transport of clouds; only `raw` is supported.").or("raw"),
    ],
};

/// Parameters of a range sensor layer.
pub static RANGE: Table = Table {
    name: "a range layer",
    doc: "Sonars and other sensors with one wide beam.",
    parameters: &[
        LAYER_ENABLED,
        number("phi", "m", "Distance at which the weight of a reading is one half.").or("1.2"),
        number(
            "inflate_cone",
            "",
            "Width of the margin around the cone that is updated, as a fraction of the cone.",
        )
        .or("1")
        .within(0.0, 1.0),
        number("no_readings_timeout", "s", "Maximum interval between messages; 0 for no limit.")
            .or("0")
            .min(0.0),
        number("clear_threshold", "", "Maximum probability of free cells.")
            .or("0.2")
            .within(0.0, 1.0),
        number("mark_threshold", "", "Minimum probability of lethal cells.")
            .or("0.8")
            .within(0.0, 1.0),
        flag("clear_on_max_reading", "Clears the cone of a reading at the maximum range.")
            .or("false"),
        texts("topics", "Topics of the sensors.").or(""),
        text("input_sensor_type", "Accepted sensors: VARIABLE, FIXED or ALL.").or("ALL"),
    ],
};

/// Parameters of an inflation layer.
pub static INFLATION: Table = Table {
    name: "an inflation layer",
    doc: "Costs that decrease with the distance from obstacles.",
    parameters: &[
        LAYER_ENABLED,
        number("inflation_radius", "m", "Distance up to which costs are set; 0 for none.")
            .or("0.55")
            .min(0.0),
        number("cost_scaling_factor", "", "Exponential decay rate of the cost, in 1/m.")
            .or("10")
            .min(0.0),
        flag("inflate_unknown", "Sets costs in unknown cells.").or("false"),
        flag("inflate_around_unknown", "Inflates unknown cells like obstacles.").or("false"),
        integer("num_threads", "Unused; a single thread is used.").or("-1"),
        number(
            "custom_inscribed_radius",
            "m",
            "Overrides the inscribed radius of the footprint, if not negative.",
        )
        .or("-1"),
    ],
};

/// Parameters of a denoise layer.
pub static DENOISE: Table = Table {
    name: "a denoise layer",
    doc: "Removes small obstacles.",
    parameters: &[
        LAYER_ENABLED,
        integer("minimal_group_size", "Minimum number of cells of a group; 1 keeps all.").or("2"),
        integer("group_connectivity_type", "Number of neighbours of a cell: 4 or 8.").or("8"),
    ],
};

/// Parameters of a container of layers.
pub static CONTAINER: Table = Table {
    name: "a container of layers",
    doc: "Layers with a separate grid.",
    parameters: &[
        LAYER_ENABLED,
        texts("plugins", "Names of the contained layers, lowest first.").or(""),
        COMBINATION_METHOD,
    ],
};

/// Parameters of a keepout filter.
pub static KEEPOUT: Table = Table {
    name: "a keepout filter",
    doc: "Zones that a robot must not enter.",
    parameters: &[
        FILTER_ENABLED,
        FILTER_INFO_TOPIC,
        MASK_TOLERANCE,
        flag("override_lethal_cost", "Lets a robot inside a zone leave it.").or("false"),
        integer("lethal_override_cost", "Cost of the zone in that case, at most 252.").or("252"),
    ],
};

/// Parameters of a speed filter.
pub static SPEED: Table = Table {
    name: "a speed filter",
    doc: "Zones with speed limits.",
    parameters: &[
        FILTER_ENABLED,
        FILTER_INFO_TOPIC,
        MASK_TOLERANCE,
        text("speed_limit_topic", "Topic of the limits.").or("speed_limit"),
        flag("enable_path_lookahead", "Applies limits ahead on the path.").or("false"),
        number("max_decel", "m/s2", "Deceleration of the robot; negative.").or("-0.5"),
        number("min_lookahead", "m", "Minimum lookahead distance.").or("0.3"),
        number("max_lookahead", "m", "Maximum lookahead distance.").or("5"),
        text("path_topic", "Topic of the path.").or("plan").naming(NamedEntity::Topic),
        text("odom_topic", "Topic of the odometry, for the speed.")
            .or("odom")
            .naming(NamedEntity::Topic),
    ],
};

/// Parameters of a binary filter.
pub static BINARY: Table = Table {
    name: "a binary filter",
    doc: "Zones that switch a state.",
    parameters: &[
        FILTER_ENABLED,
        FILTER_INFO_TOPIC,
        MASK_TOLERANCE,
        flag("default_state", "State outside all zones.").or("false"),
        text("binary_state_topic", "Topic of the state.").or("binary_state"),
        number("flip_threshold", "", "Mask value above which the state is flipped.").or("50"),
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
