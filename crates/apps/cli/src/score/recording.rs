//! A run from a recording.

use std::collections::BTreeMap;
use std::path::Path;

use periplus_bags::files::Bag;
use periplus_diagnostics::SourceMap;
use periplus_evaluation::{EstimateWithCovariance, PosePair, StampedPose, Trajectory};
use periplus_geometry::{DQuat, Pose, Pose2};
use periplus_maps::from_message;
use periplus_msgs::action_msgs::GoalStatusArray;
use periplus_msgs::gazebo_msgs::ModelStates;
use periplus_msgs::geometry_msgs::{self, PoseWithCovarianceStamped};
use periplus_msgs::nav_msgs::{OccupancyGrid, Odometry};
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_sim::TRUTH_TOPIC;

use super::options::ScoreSettings;
use super::run::{Estimate, Goal, Run, truth_file};
use crate::error::CliError;
use crate::{paths, terminal};
use periplus_session::recorded::{RecordedFrames, each, each_at, has_type};

/// Maximum time between two true poses that are interpolated \[s\].
const MAX_GAP_S: f64 = 1.0;

/// Names of topics of estimates with covariance, in order of preference.
const COVARIANCE_TOPICS: [&str; 2] = ["amcl_pose", "pose"];

/// Value of `action_msgs/msg/GoalStatus` of a goal that was reached.
const STATUS_SUCCEEDED: i8 = 4;

/// Reads a recording with its truth, and prints its findings.
pub(super) fn read(path: &Path, settings: &ScoreSettings) -> Result<Run, CliError> {
    let bag = paths::bag(path)?;
    terminal::diagnostics(&mut anstream::stderr().lock(), bag.findings(), &SourceMap::new())?;
    let (truth_source, truth) = truth(&bag, path, settings)?;
    let frames = RecordedFrames::read(&bag)?;
    frames.faults.iter().for_each(|fault| terminal::complain(fault));
    let base = settings.base_frame.clone().or_else(|| frames.base(&settings.odom_frame, None));
    let mut estimates = Vec::new();
    if let Some(base) = &base {
        let wanted = [("localization", &settings.map_frame), ("odometry", &settings.odom_frame)];
        for (name, frame) in wanted {
            let pairs = pairs(&frames, frame, base, &truth);
            if !pairs.is_empty() {
                estimates.push(Estimate { name, pairs });
            }
        }
    }
    if estimates.is_empty() {
        let base = base.as_deref().unwrap_or("base_link");
        return Err(CliError::failed(format!(
            "{} has no transforms from `{}` or `{}` to `{base}` at the stamps of the truth ({truth_source}); see \
             `--map-frame`, `--odom-frame` and `--base-frame`",
            path.display(),
            settings.map_frame,
            settings.odom_frame
        )));
    }
    let (covariance_topic, with_covariance) = covariances(&bag, &truth, settings)?;
    Ok(Run {
        truth_source,
        truth,
        estimates,
        with_covariance,
        covariance_topic,
        map: map(&bag)?,
        goals: goals(&bag)?,
        ..Run::default()
    })
}

/// Transforms at the stamps of the truth.
fn pairs(frames: &RecordedFrames, frame: &str, base: &str, truth: &Trajectory) -> Vec<PosePair> {
    if frames.buffer.chain(frame, base).is_none() {
        return Vec::new();
    }
    let pair = |it: &StampedPose| {
        let time_ns = (it.stamp_s * 1e9).round() as i64;
        // A lookup at zero is the latest transform.
        let found = frames.buffer.lookup(frame, base, time_ns).ok().filter(|_| time_ns != 0)?;
        let estimate = found.target_from_source;
        Some(PosePair { stamp_s: it.stamp_s, reference: it.pose, estimate })
    };
    truth.poses().iter().filter_map(pair).collect()
}

/// The truth with its source: a file, the requested topic, or a topic with true poses.
fn truth(
    bag: &Bag,
    path: &Path,
    settings: &ScoreSettings,
) -> Result<(String, Trajectory), CliError> {
    let has_topic = |name: &str| bag.topics().iter().any(|topic| topic.name == name);
    if let Some(wanted) = settings.truth.as_deref().filter(|wanted| !has_topic(wanted)) {
        return Ok((wanted.to_owned(), truth_file(wanted)?));
    }
    let is_truth = |name: &str| match &settings.truth {
        Some(wanted) => name == wanted,
        None => {
            name == TRUTH_TOPIC
                || name.ends_with("/model_states")
                || name.contains("ground_truth")
                || name.starts_with("/world/") && name.contains("pose")
        }
    };
    let topics = bag.topics().iter().filter(|topic| is_truth(&topic.name));
    for topic in topics {
        let models = poses_by_model(bag, &topic.name)?;
        if let Some((model, trajectory)) = robot(models, settings.model.as_deref()) {
            return Ok((format!("{} {model}", topic.name), trajectory));
        }
    }
    let model = settings.model.as_deref().map(|it| format!(" of the model `{it}`"));
    Err(CliError::failed(format!(
        "{} has no true poses{}; record with `--record-truth`, or name a file or topic with `--truth`",
        path.display(),
        model.unwrap_or_default()
    )))
}

/// True poses of all models on a topic.
fn poses_by_model(bag: &Bag, topic: &str) -> Result<BTreeMap<String, Vec<StampedPose>>, CliError> {
    let mut models: BTreeMap<String, Vec<StampedPose>> = BTreeMap::new();
    let mut add = |model: &str, time_ns: i64, pose: Pose| {
        let one = StampedPose { stamp_s: time_ns as f64 * 1e-9, pose };
        match models.get_mut(model) {
            Some(poses) => poses.push(one),
            None => drop(models.insert(model.to_owned(), vec![one])),
        }
    };
    let of_type = |name: &str| bag.topics().iter().any(|it| it.name == topic && has_type(it, name));
    let faults = if of_type("ModelStates") {
        each_at::<ModelStates>(bag, &[topic], |_, log_ns, message| {
            for (name, pose) in message.name.iter().zip(&message.pose) {
                add(name, log_ns, pose_of(pose));
            }
        })?
    } else if of_type("Odometry") {
        each::<Odometry>(bag, &[topic], |_, message| {
            add(&message.child_frame_id, message.header.stamp.ns(), pose_of(&message.pose.pose));
        })?
    } else if of_type("TFMessage") {
        each::<TFMessage>(bag, &[topic], |_, message| {
            for it in message.transforms {
                let (t, q) = (it.transform.translation, it.transform.rotation);
                let rotation = DQuat::from_xyzw(q.x, q.y, q.z, q.w);
                let pose = Pose::from_xyz_quaternion([t.x, t.y, t.z], rotation);
                add(&it.child_frame_id, it.header.stamp.ns(), pose);
            }
        })?
    } else {
        Vec::new()
    };
    faults.iter().for_each(|fault| terminal::complain(fault));
    Ok(models)
}

/// The named model, or the one with the longest path.
fn robot(
    models: BTreeMap<String, Vec<StampedPose>>,
    name: Option<&str>,
) -> Option<(String, Trajectory)> {
    let all = models.into_iter().map(|(model, poses)| (model, Trajectory::new(poses)));
    match name {
        Some(name) => all.into_iter().find(|(model, _)| model == name),
        None => {
            let length_m = |it: &(String, Trajectory)| it.1.length_m().unwrap_or(0.0);
            all.max_by(|a, b| length_m(a).total_cmp(&length_m(b)))
        }
    }
}

fn pose_of(message: &geometry_msgs::Pose) -> Pose {
    let (p, q) = (&message.position, &message.orientation);
    Pose::from_xyz_quaternion([p.x, p.y, p.z], DQuat::from_xyzw(q.x, q.y, q.z, q.w))
}

/// Estimates with covariance, with the true poses at their stamps.
fn covariances(
    bag: &Bag,
    truth: &Trajectory,
    settings: &ScoreSettings,
) -> Result<(Option<String>, Vec<EstimateWithCovariance>), CliError> {
    let is_named = |name: &str, wanted: &str| name.rsplit('/').next() == Some(wanted);
    let topic = COVARIANCE_TOPICS.iter().find_map(|wanted| {
        bag.topics()
            .iter()
            .find(|it| is_named(&it.name, wanted) && has_type(it, "PoseWithCovarianceStamped"))
    });
    let Some(topic) = topic else { return Ok((None, Vec::new())) };
    let mut found = Vec::new();
    let faults = each::<PoseWithCovarianceStamped>(bag, &[topic.name.as_str()], |_, message| {
        if message.header.frame_id.trim_start_matches('/') != settings.map_frame {
            return;
        }
        let stamp_s = message.header.stamp.ns() as f64 * 1e-9;
        let Some(pose) = truth.pose_at(stamp_s, MAX_GAP_S) else { return };
        let c = &message.pose.covariance;
        let row = |row: usize| [c[6 * row], c[6 * row + 1], c[6 * row + 5]];
        found.push(EstimateWithCovariance {
            stamp_s,
            truth: Pose2::from(pose),
            estimate: Pose2::from(pose_of(&message.pose.pose)),
            covariance: [row(0), row(1), row(5)],
        });
    })?;
    faults.iter().for_each(|fault| terminal::complain(fault));
    Ok((Some(topic.name.clone()), found))
}

/// Last map of the topic `map`.
fn map(bag: &Bag) -> Result<Option<periplus_grid::OccupancyGrid>, CliError> {
    let is_map = |name: &str| name.rsplit('/').next() == Some("map");
    let topic = bag.topics().iter().find(|it| is_map(&it.name) && has_type(it, "OccupancyGrid"));
    let Some(topic) = topic else { return Ok(None) };
    let mut last = None;
    each::<OccupancyGrid>(bag, &[topic.name.as_str()], |_, message| last = Some(message))?;
    Ok(last.and_then(|message| from_message(&message).ok()))
}

/// Goals of `navigate_to_pose`.
fn goals(bag: &Bag) -> Result<Vec<Goal>, CliError> {
    let is_status = |name: &str| name.ends_with("/navigate_to_pose/_action/status");
    let topics: Vec<&str> =
        bag.topics().iter().map(|it| it.name.as_str()).filter(|name| is_status(name)).collect();
    let mut goals: BTreeMap<[u8; 16], Goal> = BTreeMap::new();
    each_at::<GoalStatusArray>(bag, &topics, |_, log_ns, message| {
        let now_s = log_ns as f64 * 1e-9;
        for status in &message.status_list {
            let id = status.goal_info.goal_id.uuid;
            let goal = goals.entry(id).or_insert(Goal { start_s: now_s, reached_s: None });
            if status.status == STATUS_SUCCEEDED && goal.reached_s.is_none() {
                goal.reached_s = Some(now_s);
            }
        }
    })?;
    let mut goals: Vec<Goal> = goals.into_values().collect();
    goals.sort_by(|a, b| a.start_s.total_cmp(&b.start_s));
    Ok(goals)
}
