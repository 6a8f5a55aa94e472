//! Parameters of `ekf_node`.

use std::collections::BTreeMap;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_params::{Given, ParamValues, Table, flag, integer, number, numbers, text, texts};

use crate::state::{Covariance, STATE_DIMENSIONS, State};

/// Parameters of the filter.
pub static EKF: Table = Table {
    name: "ekf_node",
    doc: "Extended Kalman filter that fuses odometry, IMU and poses.",
    parameters: &[
        number("frequency", "Hz", "Publication rate of the estimate.").or("30").above(0.0),
        number("sensor_timeout", "s", "Time without measurements after which the state is predicted; 1 / frequency unless set.")
            .above(0.0),
        flag("two_d_mode", "Estimates planar motion only: no height, roll or pitch.").or("false"),
        number("transform_time_offset", "s", "Offset added to the stamps of published transforms.").or("0"),
        number("transform_timeout", "s", "Maximum time that a message waits for its transform.").or("0").min(0.0),
        flag("print_diagnostics", "Publishes the health of the filter on /diagnostics.").or("true"),
        flag("publish_tf", "Publishes the transform of the estimate.").or("true"),
        flag("publish_acceleration", "Publishes the acceleration on accel/filtered.").or("false"),
        flag("permit_corrected_publication", "Publishes a stamp again after late measurements changed it.").or("false"),
        flag("predict_to_current_time", "Predicts the published estimate to the current time.").or("false"),
        text("map_frame", "Map frame.").or("map"),
        text("odom_frame", "Odometry frame.").or("odom"),
        text("base_link_frame", "Base frame of the robot.").or("base_link"),
        text("base_link_frame_output", "Base frame in published messages; base_link_frame unless set."),
        text("world_frame", "Frame of the estimate, map_frame or odom_frame; odom_frame unless set."),
        number("gravitational_acceleration", "m/s^2", "Gravity removed from IMU accelerations.").or("9.80665"),
        numbers("initial_state", "", "Initial values of the 15 variables."),
        numbers("process_noise_covariance", "1/s", "Process noise covariance: 225 numbers in row-major order, or the 15 of the diagonal."),
        numbers("initial_estimate_covariance", "", "Covariance of the initial state: 225 numbers in row-major order, or the 15 of the diagonal."),
        flag("dynamic_process_noise_covariance", "Scales the process noise of the pose by the speed of the robot.").or("false"),
        flag("disabled_at_startup", "Waits for the service `enable`.").or("false"),
        flag("reset_on_time_jump", "Resets the filter after a jump back in time.").or("false"),
        flag("use_sim_time", "Uses the time of /clock.").or("false"),
        flag("smooth_lagged_data", "Not supported: late measurements are used on arrival.").or("false"),
        number("history_length", "s", "Not supported, see smooth_lagged_data.").or("0"),
        flag("use_control", "Not supported: commands are not used.").or("false"),
        flag("stamped_control", "Not supported, see use_control.").or("false"),
        number("control_timeout", "s", "Not supported, see use_control.").or("0"),
        texts("control_config", "Not supported, see use_control."),
        numbers("acceleration_limits", "", "Not supported, see use_control."),
        numbers("deceleration_limits", "", "Not supported, see use_control."),
        numbers("acceleration_gains", "", "Not supported, see use_control."),
        numbers("deceleration_gains", "", "Not supported, see use_control."),
        flag("debug", "Not there.").or("false"),
        text("debug_out_file", "Not there."),
    ],
};

/// Parameters of one input, prefixed with its name, as in `odom0_config`.
pub static SOURCE: Table = Table {
    name: "ekf_node input",
    doc: "An input topic, and the variables used from it.",
    parameters: &[
        text("topic", "Topic; set by the name of the input alone: odom0, pose0, twist0, imu0.")
            .required(),
        texts(
            "config",
            "Variables used: x y z, roll pitch yaw, their velocities, and accelerations along x y z.",
        ),
        integer("queue_size", "Maximum number of queued messages.").or("10").min(1.0),
        flag("differential", "Converts poses to the velocities between them.").or("false"),
        flag("relative", "Poses are relative to the first one.").or("false"),
        number("pose_rejection_threshold", "", "Maximum Mahalanobis distance of poses.")
            .above(0.0)
            .also(&["rejection_threshold"]),
        number("twist_rejection_threshold", "", "Maximum Mahalanobis distance of velocities.")
            .above(0.0),
        number(
            "linear_acceleration_rejection_threshold",
            "",
            "Maximum Mahalanobis distance of accelerations.",
        )
        .above(0.0),
        flag("remove_gravitational_acceleration", "Removes gravity from IMU accelerations.")
            .or("false"),
        flag("nodelay", "Option of TCPROS; no effect.").or("false"),
        flag("pose_use_child_frame", "Not supported: poses are of base_link.").or("false"),
    ],
};

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
        Self::of(&EKF.check([], None, &mut Diagnostics::new()), Vec::new(), &mut Diagnostics::new())
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
        let number = |name: &str| values.number(name).unwrap_or_default();
        let flag = |name: &str| values.flag(name).unwrap_or_default();
        let frequency_hz = number("frequency");
        let start = numbers_of(values, "initial_state", &[STATE_DIMENSIONS], diagnostics);
        Self {
            frequency_hz,
            sensor_timeout_s: values.number("sensor_timeout").unwrap_or(1.0 / frequency_hz),
            is_flat: flag("two_d_mode"),
            noise_per_s: matrix(
                values,
                "process_noise_covariance",
                PROCESS_NOISE_PER_VARIABLE,
                diagnostics,
            ),
            scales_noise: flag("dynamic_process_noise_covariance"),
            start: start.map(|numbers| State::from_row_slice(&numbers)),
            start_covariance: matrix(
                values,
                "initial_estimate_covariance",
                [1e-9; STATE_DIMENSIONS],
                diagnostics,
            ),
            gravity_mps2: number("gravitational_acceleration"),
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
    let flag = |name: &str| values.flag(name).unwrap_or_default();
    let threshold = |name: &str| values.number(name).unwrap_or(f64::INFINITY);
    let config = values.texts("config");
    let mut mask = [false; STATE_DIMENSIONS];
    let truths: Option<Vec<bool>> = config.iter().map(|word| truth(word)).collect();
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
    let pose = threshold("pose_rejection_threshold");
    Some(Source {
        kind,
        topic: values.text("topic").unwrap_or_default(),
        mask,
        queue: values.integer("queue_size").and_then(|it| usize::try_from(it).ok()).unwrap_or(10),
        is_differential: flag("differential"),
        is_relative: flag("relative"),
        removes_gravity: flag("remove_gravitational_acceleration"),
        most_deviations: [
            pose,
            // `twist0_rejection_threshold` has no "twist" in its middle.
            if kind == Kind::Twist { pose } else { threshold("twist_rejection_threshold") },
            threshold("linear_acceleration_rejection_threshold"),
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
