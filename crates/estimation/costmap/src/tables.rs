//! Parameters of a costmap, its layers and its filters, with the names and defaults of Nav2.
//!
//! Sources: `nav2_costmap_2d/src/costmap_2d_ros.cpp` and `plugins/*.cpp` (main, 2026-08).

use periplus_params::{NamedEntity, params};

use crate::{DataType, Nav2Release};

params! {
    /// Parameters of every layer.
    pub struct LayerParams {
        /// Enables the layer.
        #[param("enabled")]
        is_enabled: bool = true,
    }
}

params! {
    /// Combination of a layer's costs with those of the layers below.
    pub struct CombinationParams {
        /// 0 overwrite, 1 maximum, 2 maximum of known costs.
        #[param("combination_method")]
        method: i64 = 1,
    }
}

params! {
    /// Parameters of obstacle and voxel layers.
    pub struct ObservationLayerParams {
        /// Parameters of every layer.
        #[shared]
        layer: LayerParams,
        /// Sets cells under the robot to free.
        #[param("footprint_clearing_enabled")]
        footprint_clearing_enabled: bool = true,
        /// Minimum height of points that mark.
        #[param("min_obstacle_height", unit("m"))]
        min_obstacle_height_m: f64 = 0,
        /// Maximum height of points that mark.
        #[param("max_obstacle_height", unit("m"))]
        max_obstacle_height_m: f64 = 2,
        /// Combination with the costs of the layers below.
        #[shared]
        combination: CombinationParams,
        /// Names of the sources, separated by blanks.
        #[param("observation_sources")]
        observation_sources: String = "",
        /// Maximum delay of transforms.
        #[param("tf_filter_tolerance", unit("s"))]
        tf_filter_tolerance_s: f64 = 0.05,
    }
}

params! {
    /// Parameters of every filter.
    pub struct FilterParams {
        /// Enables the filter.
        #[param("enabled")]
        is_enabled: bool = true,
        /// Topic of the filter info, which contains the topic of the mask.
        #[param("filter_info_topic", required(), naming(NamedEntity::Topic))]
        filter_info_topic: String,
        /// Maximum age of the transform of the mask.
        #[param("transform_tolerance", unit("s"), min(0.0))]
        transform_tolerance_s: f64 = 0.1,
    }
}

params! {
    /// A costmap of layers.
    #[table(COSTMAP, "the costmap")]
    pub struct CostmapParams {
        /// Publishes the whole grid each time, instead of updates.
        #[param("always_send_full_costmap")]
        always_send_full_costmap: bool = false,
        /// Height of the published grid.
        #[param("map_vis_z", unit("m"))]
        map_vis_z_m: f64 = 0,
        /// Padding added to the footprint.
        #[param("footprint_padding", unit("m"), min(0.0))]
        footprint_padding_m: f64 = 0.01,
        /// Corners of the robot, `[[x, y], ...]`; overrides `robot_radius`.
        #[param("footprint")]
        footprint: String = "[]",
        /// Radius of a round robot.
        #[param("robot_radius", unit("m"), min(0.0))]
        robot_radius_m: f64 = 0.1,
        /// Frame of the costmap.
        #[param("global_frame", naming(NamedEntity::Frame))]
        global_frame: String = "map",
        /// Base frame of the robot.
        #[param("robot_base_frame", naming(NamedEntity::Frame))]
        robot_base_frame: String = "base_link",
        /// Length along x, in whole metres.
        #[param("width", within(1.0, 1_000_000.0))]
        width: usize = 5,
        /// Length along y, in whole metres.
        #[param("height", within(1.0, 1_000_000.0))]
        height: usize = 5,
        /// Side length of a cell.
        #[param("resolution", unit("m"), above(0.0))]
        resolution_m: f64 = 0.1,
        /// Lower left corner, x.
        #[param("origin_x", unit("m"))]
        origin_x_m: f64 = 0,
        /// Lower left corner, y.
        #[param("origin_y", unit("m"))]
        origin_y_m: f64 = 0,
        /// Centres the costmap on the robot.
        #[param("rolling_window")]
        rolling_window: bool = false,
        /// Keeps unobserved cells unknown instead of free.
        #[param("track_unknown_space")]
        track_unknown_space: bool = false,
        /// Rate of updates; 0 for none.
        #[param("update_frequency", unit("Hz"), min(0.0))]
        update_frequency_hz: f64 = 5,
        /// Rate of publication; 0 or less for none.
        #[param("publish_frequency", unit("Hz"))]
        publish_frequency_hz: f64 = 1,
        /// Maximum age of the pose of the robot.
        #[param("transform_tolerance", unit("s"), min(0.0))]
        transform_tolerance_s: f64 = 0.3,
        /// Maximum time that activation waits for the pose of the robot.
        #[param("initial_transform_timeout", unit("s"), min(0.0))]
        initial_transform_timeout_s: f64 = 60,
        /// Names of the layers, lowest first.
        #[param("plugins")]
        plugins: Vec<String> = "static_layer obstacle_layer inflation_layer",
        /// Names of the filters, lowest first.
        #[param("filters")]
        filters: Vec<String> = "",
        /// Subscribes to `footprint` as PolygonStamped instead of Polygon.
        #[param("subscribe_to_stamped_footprint")]
        subscribe_to_stamped_footprint: bool = false,
        /// Minimum map value of lethal cells.
        #[param("lethal_cost_threshold")]
        lethal_cost_threshold: i64 = 100,
        /// Map value of unknown cells; 255 represents -1.
        #[param("unknown_cost_value")]
        unknown_cost_value: i64 = 255,
        /// Converts a map to free, lethal and unknown cells only.
        #[param("trinary_costmap")]
        trinary_costmap: bool = true,
        /// Map value of inscribed cells.
        #[param("inscribed_obstacle_cost_value")]
        inscribed_obstacle_cost_value: i64 = 99,
        /// Combines maps by maximum, so that they only raise costs.
        #[param("use_maximum")]
        use_maximum: bool = false,
        /// Allows parameters to set QoS.
        #[param("allow_parameter_qos_overrides")]
        _: bool = true,
        /// Unused; each layer has this parameter.
        #[param("observation_sources")]
        _: String = "",
        /// Default topic of the map for static layers.
        #[param("map_topic")]
        map_topic: String = "",
        /// Uses the time of `/clock`.
        #[param("use_sim_time")]
        use_sim_time: bool = false,
        /// Period of the heartbeats to a lifecycle manager; no bond if not positive.
        #[param("bond_heartbeat_period", unit("s"))]
        bond_heartbeat_period_s: f64 = 0.1,
        /// Unused; service introspection is not supported.
        #[param("service_introspection_mode")]
        _: String = "disabled",
        /// Release of Nav2 whose behaviour is used where releases differ; `jazzy-1.3.10` is Jazzy up to
        /// Nav2 1.3.10.
        #[param("compat")]
        compat: Nav2Release = "main",
    }
}

params! {
    /// A layer with a map.
    #[table(STATIC, "a static layer")]
    pub struct StaticLayerParams {
        /// Parameters of every layer.
        #[shared]
        layer: LayerParams,
        /// Subscribes to `<map_topic>_updates`.
        #[param("subscribe_to_updates")]
        subscribe_to_updates: bool = false,
        /// Subscribes with transient-local durability, which delivers a map published earlier.
        #[param("map_subscribe_transient_local")]
        map_subscribe_transient_local: bool = true,
        /// Topic of the map.
        #[param("map_topic", naming(NamedEntity::Topic))]
        map_topic: String = "",
        /// Sets cells under the robot to free.
        #[param("footprint_clearing_enabled")]
        footprint_clearing_enabled: bool = false,
        /// Restores the cleared costs after the robot has left.
        #[param("restore_cleared_footprint")]
        restore_cleared_footprint: bool = true,
        /// Maximum age of the transform of the map.
        #[param("transform_tolerance", unit("s"), min(0.0))]
        transform_tolerance_s: f64 = 0,
    }
}

params! {
    /// Obstacles seen by sensors, in the plane.
    #[table(OBSTACLE, "an obstacle layer")]
    pub struct ObstacleLayerParams {
        /// Parameters of obstacle and voxel layers.
        #[shared]
        observed: ObservationLayerParams,
    }
}

params! {
    /// Obstacles seen by sensors, in columns of voxels.
    #[table(VOXEL, "a voxel layer")]
    pub struct VoxelLayerParams {
        /// Parameters of obstacle and voxel layers.
        #[shared]
        observed: ObservationLayerParams,
        /// Height of the lowest voxels.
        #[param("origin_z", unit("m"))]
        origin_z_m: f64 = 0,
        /// Height of a voxel.
        #[param("z_resolution", unit("m"), above(0.0))]
        z_resolution_m: f64 = 0.2,
        /// Number of voxels in a column, at most 16.
        #[param("z_voxels", within(0.0, 1000.0))]
        z_voxels: usize = 10,
        /// Maximum number of unknown voxels in a known column.
        #[param("unknown_threshold", min(0.0))]
        unknown_threshold: usize = 15,
        /// Maximum number of marked voxels in a free column.
        #[param("mark_threshold", min(0.0))]
        mark_threshold: usize = 0,
        /// Publishes the voxels.
        #[param("publish_voxel_map")]
        publish_voxel_map: bool = false,
    }
}

params! {
    /// A sensor that marks and clears obstacles.
    #[table(SOURCE, "an observation source")]
    pub struct SourceParams {
        /// Topic; default: the name of the source.
        #[param("topic", naming(NamedEntity::Topic))]
        topic: String = "",
        /// Frame of the sensor origin; default: the frame of the message.
        #[param("sensor_frame", naming(NamedEntity::Frame))]
        sensor_frame: String = "",
        /// Duration for which readings are kept; 0 for the newest only.
        #[param("observation_persistence", unit("s"), min(0.0))]
        observation_persistence_s: f64 = 0,
        /// Maximum interval between messages; 0 for no limit.
        #[param("expected_update_rate", unit("s"), min(0.0))]
        expected_update_rate_s: f64 = 0,
        /// Message type.
        #[param("data_type")]
        data_type: DataType = "LaserScan",
        /// Minimum height of points, for marking and clearing.
        #[param("min_obstacle_height", unit("m"))]
        min_obstacle_height_m: f64 = 0,
        /// Maximum height of points, for marking and clearing.
        #[param("max_obstacle_height", unit("m"))]
        max_obstacle_height_m: f64 = 0,
        /// Clears up to the maximum range for infinite ranges.
        #[param("inf_is_valid")]
        inf_is_valid: bool = false,
        /// Marks obstacles.
        #[param("marking")]
        marking: bool = true,
        /// Clears cells along rays.
        #[param("clearing")]
        clearing: bool = false,
        /// Maximum distance of points that mark.
        #[param("obstacle_max_range", unit("m"), also(&["obstacle_range"]))]
        obstacle_max_range_m: f64 = 2.5,
        /// Minimum distance of points that mark.
        #[param("obstacle_min_range", unit("m"))]
        obstacle_min_range_m: f64 = 0,
        /// Maximum distance at which rays clear.
        #[param("raytrace_max_range", unit("m"), also(&["raytrace_range"]))]
        raytrace_max_range_m: f64 = 3,
        /// Minimum distance at which rays clear.
        #[param("raytrace_min_range", unit("m"))]
        raytrace_min_range_m: f64 = 0,
        /// Transport of clouds; only `raw` is supported.
        #[param("transport_type")]
        transport_type: String = "raw",
    }
}

params! {
    /// Sonars and other sensors with one wide beam.
    #[table(RANGE, "a range layer")]
    pub struct RangeLayerParams {
        /// Parameters of every layer.
        #[shared]
        layer: LayerParams,
        /// Distance at which the weight of a reading is one half.
        #[param("phi", unit("m"))]
        phi_m: f64 = 1.2,
        /// Width of the margin around the cone that is updated, as a fraction of the cone.
        #[param("inflate_cone", within(0.0, 1.0))]
        inflate_cone: f64 = 1,
        /// Maximum interval between messages; 0 for no limit.
        #[param("no_readings_timeout", unit("s"), min(0.0))]
        no_readings_timeout_s: f64 = 0,
        /// Maximum probability of free cells.
        #[param("clear_threshold", within(0.0, 1.0))]
        clear_threshold: f64 = 0.2,
        /// Minimum probability of lethal cells.
        #[param("mark_threshold", within(0.0, 1.0))]
        mark_threshold: f64 = 0.8,
        /// Clears the cone of a reading at the maximum range.
        #[param("clear_on_max_reading")]
        clear_on_max_reading: bool = false,
        /// Topics of the sensors.
        #[param("topics")]
        topics: Vec<String> = "",
        /// Accepted sensors: VARIABLE, FIXED or ALL.
        #[param("input_sensor_type")]
        input_sensor_type: String = "ALL",
    }
}

params! {
    /// Costs that decrease with the distance from obstacles.
    #[table(INFLATION, "an inflation layer")]
    pub struct InflationLayerParams {
        /// Parameters of every layer.
        #[shared]
        layer: LayerParams,
        /// Distance up to which costs are set; 0 for none.
        #[param("inflation_radius", unit("m"), min(0.0))]
        inflation_radius_m: f64 = 0.55,
        /// Exponential decay rate of the cost, in 1/m.
        #[param("cost_scaling_factor", min(0.0))]
        cost_scaling_factor: f64 = 10,
        /// Sets costs in unknown cells.
        #[param("inflate_unknown")]
        inflate_unknown: bool = false,
        /// Inflates unknown cells like obstacles.
        #[param("inflate_around_unknown")]
        inflate_around_unknown: bool = false,
        /// Unused; a single thread is used.
        #[param("num_threads")]
        _: i64 = -1,
        /// Overrides the inscribed radius of the footprint, if not negative.
        #[param("custom_inscribed_radius", unit("m"))]
        custom_inscribed_radius_m: f64 = -1,
    }
}

params! {
    /// Removes small obstacles.
    #[table(DENOISE, "a denoise layer")]
    pub struct DenoiseLayerParams {
        /// Parameters of every layer.
        #[shared]
        layer: LayerParams,
        /// Minimum number of cells of a group; 1 keeps all.
        #[param("minimal_group_size")]
        minimal_group_size: i64 = 2,
        /// Number of neighbours of a cell: 4 or 8.
        #[param("group_connectivity_type")]
        group_connectivity_type: i64 = 8,
    }
}

params! {
    /// Layers with a separate grid.
    #[table(CONTAINER, "a container of layers")]
    pub struct ContainerLayerParams {
        /// Parameters of every layer.
        #[shared]
        layer: LayerParams,
        /// Names of the contained layers, lowest first.
        #[param("plugins")]
        plugins: Vec<String> = "",
        /// Combination with the costs of the layers below.
        #[shared]
        combination: CombinationParams,
    }
}

params! {
    /// Zones that a robot must not enter.
    #[table(KEEPOUT, "a keepout filter")]
    pub struct KeepoutFilterParams {
        /// Parameters of every filter.
        #[shared]
        filter: FilterParams,
        /// Lets a robot inside a zone leave it.
        #[param("override_lethal_cost")]
        override_lethal_cost: bool = false,
        /// Cost of the zone in that case, at most 252.
        #[param("lethal_override_cost")]
        lethal_override_cost: i64 = 252,
    }
}

params! {
    /// Zones with speed limits.
    #[table(SPEED, "a speed filter")]
    pub struct SpeedFilterParams {
        /// Parameters of every filter.
        #[shared]
        filter: FilterParams,
        /// Topic of the limits.
        #[param("speed_limit_topic")]
        speed_limit_topic: String = "speed_limit",
        /// Applies limits ahead on the path.
        #[param("enable_path_lookahead")]
        enable_path_lookahead: bool = false,
        /// Deceleration of the robot; negative.
        #[param("max_decel", unit("m/s2"))]
        max_decel_m_s2: f64 = -0.5,
        /// Minimum lookahead distance.
        #[param("min_lookahead", unit("m"))]
        min_lookahead_m: f64 = 0.3,
        /// Maximum lookahead distance.
        #[param("max_lookahead", unit("m"))]
        max_lookahead_m: f64 = 5,
        /// Topic of the path.
        #[param("path_topic", naming(NamedEntity::Topic))]
        path_topic: String = "plan",
        /// Topic of the odometry, for the speed.
        #[param("odom_topic", naming(NamedEntity::Topic))]
        odom_topic: String = "odom",
    }
}

params! {
    /// Zones that switch a state.
    #[table(BINARY, "a binary filter")]
    pub struct BinaryFilterParams {
        /// Parameters of every filter.
        #[shared]
        filter: FilterParams,
        /// State outside all zones.
        #[param("default_state")]
        default_state: bool = false,
        /// Topic of the state.
        #[param("binary_state_topic")]
        binary_state_topic: String = "binary_state",
        /// Mask value above which the state is flipped.
        #[param("flip_threshold")]
        flip_threshold: f64 = 50,
    }
}

#[cfg(test)]
mod tests {
    use periplus_diagnostics::Diagnostics;

    use super::*;
    use crate::inflation::InflationSettings;
    use crate::{CostmapConfig, CostmapSettings};

    #[test]
    fn no_table_has_slips() {
        for table in [
            &COSTMAP, &STATIC, &OBSTACLE, &VOXEL, &SOURCE, &RANGE, &INFLATION, &DENOISE,
            &CONTAINER, &KEEPOUT, &SPEED, &BINARY,
        ] {
            assert_eq!(table.faults(), [""; 0]);
        }
    }

    #[test]
    fn default_settings_are_those_of_the_tables() {
        let config = CostmapConfig::read([], None, &mut Diagnostics::new());
        assert_eq!(CostmapSettings::default(), config.frame());
        let params = InflationLayerParams::default();
        let settings = InflationSettings {
            into_unknown: params.inflate_unknown,
            around_unknown: params.inflate_around_unknown,
        };
        assert_eq!(InflationSettings::default(), settings);
    }
}
