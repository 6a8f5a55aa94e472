//! Parameters of `ekf_node`.

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_params::{Given, ParamValues, params};

use crate::state::{Covariance, STATE_DIMENSIONS, State};

params! {
    /// Extended Kalman filter that fuses odometry, IMU and poses.
    #[table(EKF, "ekf_node")]
    pub struct EkfParams {
        /// Publication rate of the estimate.
        #[param("frequency", unit("Hz"), above(0.0))]
        frequency_hz: f64 = 30,
        /// Time without measurements after which the state is predicted; 1 / frequency unless set.
        #[param("sensor_timeout", unit("s"), above(0.0))]
        sensor_timeout_s: Option<f64>,
        /// Estimates planar motion only: no height, roll or pitch.
        #[param("two_d_mode")]
        two_d_mode: bool = false,
        /// Offset added to the stamps of published transforms.
        #[param("transform_time_offset", unit("s"))]
        transform_time_offset_s: f64 = 0,
        /// Maximum time that a message waits for its transform.
        #[param("transform_timeout", unit("s"), min(0.0))]
        transform_timeout_s: f64 = 0,
        /// Publishes the health of the filter on /diagnostics.
        #[param("print_diagnostics")]
        print_diagnostics: bool = true,
        /// Publishes the transform of the estimate.
        #[param("publish_tf")]
        publish_tf: bool = true,
        /// Publishes the acceleration on accel/filtered.
        #[param("publish_acceleration")]
        publish_acceleration: bool = false,
        /// Publishes a stamp again after late measurements changed it.
        #[param("permit_corrected_publication")]
        _: bool = false,
        /// Predicts the published estimate to the current time.
        #[param("predict_to_current_time")]
        predict_to_current_time: bool = false,
        /// Map frame.
        #[param("map_frame")]
        map_frame: String = "map",
        /// Odometry frame.
        #[param("odom_frame")]
        odom_frame: String = "odom",
        /// Base frame of the robot.
        #[param("base_link_frame")]
        base_link_frame: String = "base_link",
        /// Base frame in published messages; base_link_frame unless set.
        #[param("base_link_frame_output")]
        base_link_frame_output: Option<String>,
        /// Frame of the estimate, map_frame or odom_frame; odom_frame unless set.
        #[param("world_frame")]
        world_frame: Option<String>,
        /// Gravity removed from IMU accelerations.
        #[param("gravitational_acceleration", unit("m/s^2"))]
        gravitational_acceleration_m_s2: f64 = 9.80665,
        /// Initial values of the 15 variables.
        #[param("initial_state")]
        initial_state: Vec<f64>,
        /// Process noise covariance: 225 numbers in row-major order, or the 15 of the diagonal.
        #[param("process_noise_covariance", unit("1/s"))]
        process_noise_covariance_per_s: Vec<f64>,
        /// Covariance of the initial state: 225 numbers in row-major order, or the 15 of the diagonal.
        #[param("initial_estimate_covariance")]
        initial_estimate_covariance: Vec<f64>,
        /// Scales the process noise of the pose by the speed of the robot.
        #[param("dynamic_process_noise_covariance")]
        dynamic_process_noise_covariance: bool = false,
        /// Waits for the service `enable`.
        #[param("disabled_at_startup")]
        disabled_at_startup: bool = false,
        /// Resets the filter after a jump back in time.
        #[param("reset_on_time_jump")]
        reset_on_time_jump: bool = false,
        /// Uses the time of /clock.
        #[param("use_sim_time")]
        use_sim_time: bool = false,
        /// Not supported: late measurements are used on arrival.
        #[param("smooth_lagged_data")]
        _: bool = false,
        /// Not supported, see smooth_lagged_data.
        #[param("history_length", unit("s"))]
        _: f64 = 0,
        /// Not supported: commands are not used.
        #[param("use_control")]
        _: bool = false,
        /// Not supported, see use_control.
        #[param("stamped_control")]
        _: bool = false,
        /// Not supported, see use_control.
        #[param("control_timeout", unit("s"))]
        _: f64 = 0,
        /// Not supported, see use_control.
        #[param("control_config")]
        _: Vec<String>,
        /// Not supported, see use_control.
        #[param("acceleration_limits")]
        _: Vec<f64>,
        /// Not supported, see use_control.
        #[param("deceleration_limits")]
        _: Vec<f64>,
        /// Not supported, see use_control.
        #[param("acceleration_gains")]
        _: Vec<f64>,
        /// Not supported, see use_control.
        #[param("deceleration_gains")]
        _: Vec<f64>,
        /// Not there.
        #[param("debug")]
        _: bool = false,
        /// Not there.
        #[param("debug_out_file")]
        _: Option<String>,
    }
}

params! {
    /// An input topic, and the variables used from it.
    #[table(SOURCE, "ekf_node input")]
    pub struct EkfSourceParams {
        /// Topic; set by the name of the input alone: odom0, pose0, twist0, imu0.
        #[param("topic", required())]
        topic: String,
        /// Variables used: x y z, roll pitch yaw, their velocities, and accelerations along x y z.
        #[param("config")]
        config: Vec<String>,
        /// Maximum number of queued messages.
        #[param("queue_size", min(1.0))]
        queue_size: usize = 10,
        /// Converts poses to the velocities between them.
        #[param("differential")]
        differential: bool = false,
        /// Poses are relative to the first one.
        #[param("relative")]
        relative: bool = false,
        /// Maximum Mahalanobis distance of poses.
        #[param("pose_rejection_threshold", above(0.0), also(&["rejection_threshold"]))]
        pose_rejection_threshold: Option<f64>,
        /// Maximum Mahalanobis distance of velocities.
        #[param("twist_rejection_threshold", above(0.0))]
        twist_rejection_threshold: Option<f64>,
        /// Maximum Mahalanobis distance of accelerations.
        #[param("linear_acceleration_rejection_threshold", above(0.0))]
        linear_acceleration_rejection_threshold: Option<f64>,
        /// Removes gravity from IMU accelerations.
        #[param("remove_gravitational_acceleration")]
        remove_gravitational_acceleration: bool = false,
        /// Option of TCPROS; no effect.
        #[param("nodelay")]
        _: bool = false,
        /// Not supported: poses are of base_link.
        #[param("pose_use_child_frame")]
        _: bool = false,
    }
}

/// Parameters without effect, with the behaviour instead.
const IDLE: [(&str, &str); 4] = [
    ("smooth_lagged_data", "late measurements are used on arrival, with their covariance"),
    ("use_control", "commands are not used, only the velocity of the wheels"),
    ("debug", "watch /odometry/filtered and /diagnostics instead"),
    ("permit_corrected_publication", "each stamp is published once"),
];

/// Message type of an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// `nav_msgs/Odometry`.
    Odometry,
    /// `geometry_msgs/PoseWithCovarianceStamped`.
    Pose,
    /// `geometry_msgs/TwistWithCovarianceStamped`.
    Twist,
    /// `sensor_msgs/Imu`.
    Imu,
}

impl Kind {
    const ALL: [(Self, &str); 4] = [
        (Self::Odometry, "odom"),
        (Self::Pose, "pose"),
        (Self::Twist, "twist"),
        (Self::Imu, "imu"),
    ];
}

/// An input.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// Name, such as `odom0`.
    pub name: String,
    /// Message type.
    pub kind: Kind,
    /// Topic.
    pub topic: String,
    /// Variables used.
    pub mask: [bool; STATE_DIMENSIONS],
    /// Maximum number of queued messages.
    pub queue: usize,
    /// True to convert poses to velocities.
    pub is_differential: bool,
    /// True for poses relative to the first one.
    pub is_relative: bool,
    /// True to remove gravity.
    pub removes_gravity: bool,
    /// Maximum Mahalanobis distance of poses, velocities and accelerations.
    pub most_deviations: [f64; 3],
}

/// Settings of the filter.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Publication rate \[Hz\].
    pub frequency_hz: f64,
    /// Time without measurements after which the state is predicted \[s\].
    pub sensor_timeout_s: f64,
    /// True for two-dimensional mode.
    pub is_flat: bool,
    /// Process noise covariance per second.
    pub noise_per_s: Covariance,
    /// True to scale the process noise of the pose by the speed.
    pub scales_noise: bool,
    /// Initial state, if configured.
    pub start: Option<State>,
    /// Covariance of the initial state.
    pub start_covariance: Covariance,
    /// Upward acceleration that an IMU measures at rest \[m/s²\].
    pub gravity_mps2: f64,
    /// Inputs.
    pub sources: Vec<Source>,
}

impl Default for Settings {
    fn default() -> Self {
        Self::of(&ParamValues::defaults(&EKF), Vec::new(), &mut Diagnostics::new())
    }
}

impl Settings {
    /// Reads the parameters of the filter and of its inputs. Of a repeated parameter the last value
    /// applies. Errors are reported, and the default is used.
    pub fn read<'a>(
        given: impl IntoIterator<Item = Given<'a>>,
        diagnostics: &mut Diagnostics,
    ) -> (Self, ParamValues) {
        let mut own = Vec::new();
        let mut inputs: BTreeMap<(Kind, u32), Vec<Given<'a>>> = BTreeMap::new();
        let given: Vec<Given<'a>> = given.into_iter().collect();
        let names: Vec<&str> = given.iter().map(|it| it.name).collect();
        let is_last = |(at, one): &(usize, Given<'a>)| !names[at + 1..].contains(&one.name);
        for (_, one) in given.into_iter().enumerate().filter(is_last) {
            match input(one.name) {
                Some((key, rest)) => {
                    inputs.entry(key).or_default().push(Given { name: rest, ..one });
                }
                None => own.push(one),
            }
        }
        let values = EKF.check(own, None, diagnostics);
        let sources = inputs
            .into_iter()
            .filter_map(|((kind, number), given)| source(kind, number, given, diagnostics))
            .collect();
        for (name, instead) in IDLE.iter().filter(|(name, _)| values.flag(name) == Some(true)) {
            let idle = Diagnostic::warning("idle-parameter", format!("`{name}` has no effect"))
                .at(values.origin(name))
                .help(*instead);
            diagnostics.push(idle);
        }
        (Self::of(&values, sources, diagnostics), values)
    }

    /// Converts parameters of [`EKF`] with these inputs.
    pub fn of(values: &ParamValues, sources: Vec<Source>, diagnostics: &mut Diagnostics) -> Self {
        let params = EkfParams::from_values(values);
        let frequency_hz = params.frequency_hz;
        let start = numbers_of(values, "initial_state", &[STATE_DIMENSIONS], diagnostics);
        Self {
            frequency_hz,
            sensor_timeout_s: params.sensor_timeout_s.unwrap_or(1.0 / frequency_hz),
            is_flat: params.two_d_mode,
            noise_per_s: matrix(
                values,
                "process_noise_covariance",
                PROCESS_NOISE_PER_VARIABLE,
                diagnostics,
            ),
            scales_noise: params.dynamic_process_noise_covariance,
            start: start.map(|numbers| State::from_row_slice(&numbers)),
            start_covariance: matrix(
                values,
                "initial_estimate_covariance",
                [1e-9; STATE_DIMENSIONS],
                diagnostics,
            ),
            gravity_mps2: params.gravitational_acceleration_m_s2,
            sources,
        }
    }
}

/// Diagonal of the default `process_noise_covariance`.
const PROCESS_NOISE_PER_VARIABLE: [f64; STATE_DIMENSIONS] =
    [0.05, 0.05, 0.06, 0.03, 0.03, 0.06, 0.025, 0.025, 0.04, 0.01, 0.01, 0.02, 0.01, 0.01, 0.015];

/// Splits the name of an input parameter: `odom0_config` is `config` of `odom0`; `odom0` alone is
/// its topic.
fn input(name: &str) -> Option<((Kind, u32), &str)> {
    Kind::ALL.iter().find_map(|(kind, word)| {
        let rest = name.strip_prefix(word)?;
        let end = rest.find(|letter: char| !letter.is_ascii_digit()).unwrap_or(rest.len());
        let (number, rest) = rest.split_at(end);
        let rest = if rest.is_empty() { "topic" } else { rest.strip_prefix('_')? };
        Some(((*kind, number.parse().ok()?), rest))
    })
}

fn source(
    kind: Kind,
    number: u32,
    given: Vec<Given<'_>>,
    diagnostics: &mut Diagnostics,
) -> Option<Source> {
    let word = Kind::ALL.iter().find(|(it, _)| *it == kind).map_or("", |(_, word)| word);
    let name = format!("{word}{number}");
    let at = given.first().map(|it| it.name_origin).unwrap_or_default();
    let has_topic = given.iter().any(|it| it.name == "topic");
    if !has_topic {
        let lost = Diagnostic::error(
            "input-without-topic",
            format!("`{name}` has parameters, but no topic"),
        )
        .at(at)
        .help(format!("set `{name}: TOPIC`"));
        diagnostics.push(lost);
        return None;
    }
    let values = SOURCE.check(given, None, diagnostics);
    let params = EkfSourceParams::from_values(&values);
    let or_any = |threshold: Option<f64>| threshold.unwrap_or(f64::INFINITY);
    let mut mask = [false; STATE_DIMENSIONS];
    let truths: Option<Vec<bool>> = params.config.iter().map(|word| truth(word)).collect();
    match truths {
        Some(truths) if truths.len() == STATE_DIMENSIONS => mask.copy_from_slice(&truths),
        Some(truths) if truths.is_empty() => {
            let none = Diagnostic::warning(
                "input-without-config",
                format!("no variable of `{name}` is used: `{name}_config` is not set"),
            )
            .at(at)
            .help(
                "list for x y z, roll pitch yaw, their velocities and accelerations: true or false",
            );
            diagnostics.push(none);
        }
        found => {
            let count =
                found.map_or_else(|| "other words".to_owned(), |it| format!("{} values", it.len()));
            let bad = Diagnostic::error(
                "bad-config",
                format!("`{name}_config` has to be 15 times true or false, and has {count}"),
            )
            .at(values.origin("config"))
            .help("x y z, roll pitch yaw, vx vy vz, vroll vpitch vyaw, ax ay az");
            diagnostics.push(bad);
        }
    }
    let pose = or_any(params.pose_rejection_threshold);
    Some(Source {
        kind,
        topic: params.topic,
        mask,
        queue: params.queue_size,
        is_differential: params.differential,
        is_relative: params.relative,
        removes_gravity: params.remove_gravitational_acceleration,
        most_deviations: [
            pose,
            // `twist0_rejection_threshold` has no "twist" in its middle.
            if kind == Kind::Twist { pose } else { or_any(params.twist_rejection_threshold) },
            or_any(params.linear_acceleration_rejection_threshold),
        ],
        name,
    })
}

fn truth(word: &str) -> Option<bool> {
    match word.to_ascii_lowercase().as_str() {
        "true" | "1" => Some(true),
        "false" | "0" => Some(false),
        _ => None,
    }
}

fn numbers_of(
    values: &ParamValues,
    name: &str,
    counts: &[usize],
    diagnostics: &mut Diagnostics,
) -> Option<Vec<f64>> {
    let numbers = values.numbers(name);
    if numbers.is_empty() || counts.contains(&numbers.len()) {
        return (!numbers.is_empty()).then_some(numbers);
    }
    let counts: Vec<String> = counts.iter().map(usize::to_string).collect();
    let bad = Diagnostic::error(
        "bad-count",
        format!("`{name}` has {} numbers; it needs {}", numbers.len(), counts.join(" or ")),
    )
    .at(values.origin(name))
    .help("the default is used");
    diagnostics.push(bad);
    None
}

fn matrix(
    values: &ParamValues,
    name: &str,
    usual: [f64; STATE_DIMENSIONS],
    diagnostics: &mut Diagnostics,
) -> Covariance {
    match numbers_of(
        values,
        name,
        &[STATE_DIMENSIONS, STATE_DIMENSIONS * STATE_DIMENSIONS],
        diagnostics,
    ) {
        Some(numbers) if numbers.len() == STATE_DIMENSIONS => {
            Covariance::from_diagonal(&State::from_row_slice(&numbers))
        }
        Some(numbers) => Covariance::from_row_slice(&numbers),
        None => Covariance::from_diagonal(&State::from(usual)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(given: &[(&str, &str)]) -> (Settings, Vec<&'static str>) {
        let mut diagnostics = Diagnostics::new();
        let given = given.iter().map(|(name, text)| Given::new(name, *text));
        let (settings, _) = Settings::read(given, &mut diagnostics);
        (settings, diagnostics.iter().map(|it| it.code).collect())
    }

    #[test]
    fn default_settings_are_those_of_the_table() {
        let (settings, codes) = read(&[]);
        assert!(codes.is_empty(), "{codes:?}");
        assert_eq!(settings, Settings::default());
        assert_eq!([EKF.faults(), SOURCE.faults()], [vec![], vec![]] as [Vec<String>; 2]);
    }

    const YAW: &str = "0 0 0 0 0 0 0 0 0 0 0 true false false false";

    #[test]
    fn inputs_by_their_names() {
        let (settings, codes) = read(&[
            ("imu0", "demo/imu"),
            ("imu0_config", YAW),
            ("imu0_twist_rejection_threshold", "3"),
            ("odom0", "demo/odom"),
            ("odom0_config", YAW),
            ("odom0_queue_size", "2"),
            ("frequency", "50"),
        ]);
        assert!(codes.is_empty(), "{codes:?}");
        let names: Vec<&str> = settings.sources.iter().map(|it| it.name.as_str()).collect();
        assert_eq!(names, ["odom0", "imu0"]);
        let imu = &settings.sources[1];
        assert_eq!((imu.topic.as_str(), imu.most_deviations[1]), ("demo/imu", 3.0));
        assert_eq!((0..STATE_DIMENSIONS).filter(|at| imu.mask[*at]).collect::<Vec<_>>(), [11]);
        assert_eq!((settings.frequency_hz, settings.sensor_timeout_s), (50.0, 0.02));
    }

    #[test]
    fn what_is_wrong_is_told() {
        let code = |given: &[(&str, &str)]| read(given).1;
        assert_eq!(code(&[("odom0_config", YAW)]), ["input-without-topic"]);
        assert_eq!(code(&[("odom0", "odom")]), ["input-without-config"]);
        assert_eq!(code(&[("odom0", "odom"), ("odom0_config", "true false")]), ["bad-config"]);
        assert_eq!(code(&[("process_noise_covariance", "1 2 3")]), ["bad-count"]);
        assert_eq!(code(&[("use_control", "true")]), ["idle-parameter"]);
        assert_eq!(code(&[("frequenzy", "3")]), ["unknown-parameter"]);
    }
}
