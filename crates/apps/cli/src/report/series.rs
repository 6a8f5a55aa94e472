//! Plots over the time of a run.

use periplus_evaluation::{Degenerate, PoseRelation, align, ape};
use periplus_msgs::gazebo_msgs::PerformanceMetrics;
use periplus_msgs::nav_msgs::Odometry;
use periplus_msgs::ros_gz_interfaces::WorldStatistics;
use periplus_msgs::sensor_msgs::LaserScan;
use periplus_session::recorded::{each_at, has_type, scan_topic};

use super::OpenRun;
use super::html::Section;
use super::plot::{Curve, Plot};
use crate::error::CliError;
use crate::score::{Align, Run, ScoreSettings};

/// Number of poses from which speeds are computed if there is no odometry.
const MAX_POSE_COUNT: usize = 2000;

pub(super) fn section(
    run: &OpenRun,
    settings: &ScoreSettings,
) -> Result<Option<Section>, CliError> {
    let plots =
        [speed(run)?, errors(run, settings), distance_to_obstacles(run)?, real_time_factor(run)?];
    let figures: String = plots.into_iter().flatten().filter_map(|plot| plot.figure()).collect();
    let section = Section {
        title: run.heading("Plots"),
        body: format!("<div class=\"figures\">{figures}</div>\n"),
    };
    Ok((!figures.is_empty()).then_some(section))
}

/// Returns seconds since the start of the recording.
fn since_start(run: &OpenRun) -> impl Fn(i64) -> f64 + use<> {
    let start_ns = run.bag.span_ns().unwrap_or_default().0;
    move |time_ns| time_ns.saturating_sub(start_ns) as f64 * 1e-9
}

/// Speed of the odometry with the most messages, or else from the poses of the robot.
fn speed(run: &OpenRun) -> Result<Option<Plot>, CliError> {
    let seconds = since_start(run);
    let topics = run.bag.topics().iter().zip(run.bag.counts());
    let odometry = topics.filter(|(topic, _)| has_type(topic, "Odometry"));
    let is_truth = |name: &str| name.contains("ground_truth");
    let topic = odometry.max_by_key(|(topic, count)| (!is_truth(&topic.name), **count));
    let mut linear = Vec::new();
    let mut name = "from the transforms".to_owned();
    if let Some((topic, _)) = topic {
        name.clone_from(&topic.name);
        each_at::<Odometry>(&run.bag, &[topic.name.as_str()], |_, time_ns, message| {
            let twist = message.twist.twist.linear;
            linear.push((seconds(time_ns), libm::hypot(twist.x, twist.y)));
        })?;
    } else if let Some(base) = run.base() {
        let track = run.frames.track("odom", &base, MAX_POSE_COUNT);
        let first_ns = track.first().map_or(0, |it| it.0);
        for pair in track.windows(2) {
            let [(from_ns, from), (to_ns, to)] = [pair[0], pair[1]];
            let distance_m = libm::hypot(to.x_m - from.x_m, to.y_m - from.y_m);
            let span_s = (to_ns - from_ns) as f64 * 1e-9;
            linear.push(((to_ns - first_ns) as f64 * 1e-9, distance_m / span_s));
        }
    }
    let curves = vec![Curve { name, points: linear }];
    Ok(Some(Plot { title: "Speed".into(), unit: "m/s", curves }))
}

/// Distance of each estimate from the truth, after the alignment of the scores.
fn errors(run: &OpenRun, settings: &ScoreSettings) -> Option<Plot> {
    // The section with the scores has the reason for a missing truth.
    let read = Run::read(&run.path, settings).ok()?;
    let start_s = read.truth.poses().first()?.stamp_s;
    let curves = read
        .estimates
        .iter()
        .filter_map(|estimate| {
            let alignment = match align(&estimate.pairs, settings.align.into()) {
                Err(Degenerate { .. }) => align(&estimate.pairs, Align::Origin.into()).ok()?,
                Ok(found) => found,
            };
            let pairs = alignment.apply_to(&estimate.pairs);
            let values = ape(&pairs, PoseRelation::TranslationM);
            let times = pairs.iter().map(|pair| pair.stamp_s - start_s);
            Some(Curve { name: estimate.name.to_owned(), points: times.zip(values).collect() })
        })
        .collect();
    Some(Plot { title: "Error of the position against the truth".into(), unit: "m", curves })
}

/// Shortest range of each scan.
fn distance_to_obstacles(run: &OpenRun) -> Result<Option<Plot>, CliError> {
    let Ok(topic) = scan_topic(&run.bag, None, None) else { return Ok(None) };
    let seconds = since_start(run);
    let mut points = Vec::new();
    each_at::<LaserScan>(&run.bag, &[topic.as_str()], |_, time_ns, scan| {
        let is_valid = |range: &&f32| **range >= scan.range_min && **range <= scan.range_max;
        let shortest = scan.ranges.iter().filter(is_valid).copied().fold(f32::INFINITY, f32::min);
        points.push((seconds(time_ns), f64::from(shortest)));
    })?;
    let title = format!("Distance to the nearest obstacle ({topic})");
    Ok(Some(Plot { title, unit: "m", curves: vec![Curve { name: topic, points }] }))
}

/// Real-time factor of the simulation, if the recording has it.
fn real_time_factor(run: &OpenRun) -> Result<Option<Plot>, CliError> {
    let seconds = since_start(run);
    let of_type = |name: &str| {
        let topic = run.bag.topics().iter().find(|topic| has_type(topic, name));
        topic.map(|topic| topic.name.clone())
    };
    let mut points = Vec::new();
    if let Some(topic) = of_type("WorldStatistics") {
        each_at::<WorldStatistics>(&run.bag, &[topic.as_str()], |_, time_ns, message| {
            points.push((seconds(time_ns), message.real_time_factor));
        })?;
    } else if let Some(topic) = of_type("PerformanceMetrics") {
        each_at::<PerformanceMetrics>(&run.bag, &[topic.as_str()], |_, time_ns, message| {
            points.push((seconds(time_ns), message.real_time_factor));
        })?;
    }
    let curves = vec![Curve { name: "real-time factor".into(), points }];
    Ok(Some(Plot { title: "Real-time factor".into(), unit: "1", curves }))
}
