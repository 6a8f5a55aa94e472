//! Parameters of the node, from the table of its program.

use periplus_params::ParamValues;
use periplus_slam::tables::{GmappingParams, SlamToolboxParams};

use crate::slam_toolbox::Program;

/// Number of own scans kept in localization mode, unless `scan_buffer_size` is set.
const OWN_SCANS: usize = 3;

/// Parameters of the node. The engine reads the rest from the table.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct NodeParams {
    pub(crate) map_frame: String,
    pub(crate) odom_frame: String,
    pub(crate) base_frame: String,
    /// True if the base frame was set; otherwise the usual names are tried.
    pub(crate) is_base_frame_given: bool,
    pub(crate) scan_topic: String,
    pub(crate) map_topic: String,
    /// Maximum number of scans that wait for their transforms.
    pub(crate) scan_queue_size: usize,
    /// Every Nth scan is used.
    pub(crate) throttle_scans: usize,
    /// Minimum time between scans \[ns\]; 0 unless it was set.
    pub(crate) min_scan_interval_ns: i64,
    /// Period of the published map \[ns\].
    pub(crate) map_interval_ns: i64,
    /// Period of `map -> odom` \[ns\]; 0 for never.
    pub(crate) transform_period_ns: i64,
    /// Stamp of `map -> odom`.
    pub(crate) transform_stamp: TransformStamp,
    /// Duration of the transform buffer \[ns\], if it can be set.
    pub(crate) transform_buffer_ns: Option<i64>,
    pub(crate) corrects_mounting: bool,
    /// True to begin paused.
    pub(crate) is_paused: bool,
    pub(crate) offers_map_saver: bool,
    pub(crate) allows_interactive_mode: bool,
    /// Stored pose graph to load; empty for none.
    pub(crate) map_file_name: String,
    /// Pose on the stored graph, x \[m\], y \[m\], yaw \[rad\]; empty if it was not set.
    pub(crate) map_start_pose: Vec<f64>,
    /// True to begin at the first pose of the stored graph.
    pub(crate) map_start_at_dock: Option<bool>,
    /// Scale of the published position covariance.
    pub(crate) position_covariance_scale: f64,
    /// Scale of the published heading covariance.
    pub(crate) yaw_covariance_scale: f64,
    /// Number of own scans kept in localization mode.
    pub(crate) own_scans: usize,
}

/// Stamp of a published transform: a time, and how far it is ahead of that.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct TransformStamp {
    /// True for the time of publication, false for that of the last scan.
    pub(crate) is_of_publication: bool,
    /// Time by which the stamp is ahead \[ns\].
    pub(crate) ahead_ns: i64,
}

impl NodeParams {
    /// Converts values of the table of a program.
    pub(crate) fn new(program: Program, values: &ParamValues) -> Self {
        if program.is_toolbox() { Self::of_toolbox(values) } else { Self::of_gmapping(values) }
    }

    fn of_toolbox(values: &ParamValues) -> Self {
        let params = SlamToolboxParams::from_values(values);
        let is_given = |name: &str| values.is_given(name);
        Self {
            map_frame: params.map_frame,
            odom_frame: params.odom_frame,
            base_frame: params.base_frame,
            is_base_frame_given: is_given("base_frame"),
            scan_topic: params.scan_topic,
            map_topic: params.map_name,
            scan_queue_size: params.scan_queue_size,
            throttle_scans: params.throttle_scans,
            // By default the engine benefits from every scan.
            min_scan_interval_ns: if is_given("minimum_time_interval") {
                seconds_ns(params.minimum_time_interval_s)
            } else {
                0
            },
            map_interval_ns: seconds_ns(params.map_update_interval_s),
            transform_period_ns: seconds_ns(params.transform_publish_period_s),
            transform_stamp: TransformStamp {
                is_of_publication: params.restamp_tf,
                ahead_ns: seconds_ns(params.transform_timeout_s),
            },
            transform_buffer_ns: Some(seconds_ns(params.tf_buffer_duration_s)),
            corrects_mounting: params.mounting.correct_mounting,
            is_paused: params.paused_new_measurements,
            offers_map_saver: params.use_map_saver,
            allows_interactive_mode: params.enable_interactive_mode,
            map_file_name: params.map_file_name,
            map_start_pose: params.map_start_pose,
            map_start_at_dock: params.map_start_at_dock,
            position_covariance_scale: params.position_covariance_scale,
            yaw_covariance_scale: params.yaw_covariance_scale,
            own_scans: if is_given("scan_buffer_size") {
                params.scan_buffer_size
            } else {
                OWN_SCANS
            },
        }
    }

    /// `slam_gmapping` has fixed topics, and neither stored graphs nor states.
    fn of_gmapping(values: &ParamValues) -> Self {
        let params = GmappingParams::from_values(values);
        let period_s = params.transform_publish_period_s;
        Self {
            map_frame: params.map_frame,
            odom_frame: params.odom_frame,
            base_frame: params.base_frame,
            is_base_frame_given: values.is_given("base_frame"),
            scan_topic: "scan".to_owned(),
            map_topic: "map".to_owned(),
            scan_queue_size: 1,
            throttle_scans: params.throttle_scans,
            min_scan_interval_ns: 0,
            map_interval_ns: seconds_ns(params.map_update_interval_s),
            transform_period_ns: seconds_ns(period_s),
            transform_stamp: TransformStamp {
                is_of_publication: true,
                ahead_ns: seconds_ns(params.tf_delay_s.unwrap_or(period_s)),
            },
            transform_buffer_ns: None,
            corrects_mounting: params.mounting.correct_mounting,
            is_paused: false,
            offers_map_saver: false,
            allows_interactive_mode: false,
            map_file_name: String::new(),
            map_start_pose: Vec::new(),
            map_start_at_dock: None,
            position_covariance_scale: 1.0,
            yaw_covariance_scale: 1.0,
            own_scans: OWN_SCANS,
        }
    }
}

fn seconds_ns(seconds: f64) -> i64 {
    (seconds * 1e9) as i64
}
