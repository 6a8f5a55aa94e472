//! Deviations of Gazebo that can be reproduced.

/// Deviations that a run can reproduce (`--gz-quirks`). Every field is one behaviour of Gazebo.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "a list of switches")]
pub struct Quirks {
    /// Periods are truncated to whole milliseconds (gz-sensors, `Sensor.cc`): 60 Hz measures every
    /// 16 ms.
    pub whole_millisecond_periods: bool,
    /// Point clouds of Classic's cameras swap red and blue (`gazebo_ros_camera`).
    pub swapped_cloud_colours: bool,
    /// A `Range` message of Classic without a hit contains 3.4e38 m (`gazebo_ros_ray_sensor`).
    pub greatest_float_for_no_range: bool,
    /// One row of beams has a vertical step of 0/0 = NaN.
    pub nan_vertical_step: bool,
    /// The second camera of a link is treated as the right one of a stereo pair (gz-sim,
    /// `Sensors.cc`).
    pub second_camera_is_stereo: bool,
}

impl Quirks {
    /// None.
    pub const NONE: Self = Self {
        whole_millisecond_periods: false,
        swapped_cloud_colours: false,
        greatest_float_for_no_range: false,
        nan_vertical_step: false,
        second_camera_is_stereo: false,
    };
    /// All.
    pub const GAZEBO: Self = Self {
        whole_millisecond_periods: true,
        swapped_cloud_colours: true,
        greatest_float_for_no_range: true,
        nan_vertical_step: true,
        second_camera_is_stereo: true,
    };
}
