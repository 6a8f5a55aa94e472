//! Checks of the transform tree, and of frames in messages.

use crate::frames::{Forest, TreeFault};
use periplus_diagnostics::{Diagnostic, Diagnostics, closest};
use periplus_tf::TransformKind;

use super::SystemObservation;

/// Standard frames from root to leaf (REP 105).
const STANDARD_FRAMES: [&str; 5] = ["earth", "map", "odom", "base_footprint", "base_link"];

/// Delay behind the newest transform after which a dynamic frame is stale \[ns\].
const STALE_NS: i64 = 2_000_000_000;

pub(super) fn examine(observation: &SystemObservation, found: &mut Diagnostics) {
    let forest = Forest::new(&observation.survey);
    for fault in forest.faults() {
        found.push(told(&fault, &forest));
    }
    for name in observation.survey.with_slash() {
        found.push(
            Diagnostic::warning("frame-slash", format!("the frame `{name}` has a leading slash"))
                .note("tf2 strips it when transforms are published, and refuses it in lookups")
                .help(format!("write `{}`", name.trim_start_matches('/'))),
        );
    }
    for (child, why, count) in observation.survey.refused() {
        found.push(
            Diagnostic::error(
                "frame-refused",
                format!("{count} transforms of `{child}` were refused: {why}"),
            )
            .help("its broadcaster publishes NaN, or an empty frame name"),
        );
    }
    stale(&forest, found);
    named(observation, &forest, found);
}

fn told(fault: &TreeFault, forest: &Forest) -> Diagnostic {
    let finding = Diagnostic::error(
        match fault {
            TreeFault::Circle(_) => "frame-circle",
            TreeFault::SeveralTrees(_) => "frame-missing",
            TreeFault::SeveralParents { .. } => "frame-two-parents",
        },
        match fault {
            TreeFault::SeveralTrees(roots) => match missing(forest, roots) {
                Some((parent, child)) => {
                    format!("no transform from `{parent}` to `{child}` is published: {fault}")
                }
                None => fault.to_string(),
            },
            _ => fault.to_string(),
        },
    );
    match fault {
        TreeFault::Circle(_) => finding.help("one of these transforms has parent and child exchanged"),
        TreeFault::SeveralParents { parents, .. } => finding.note(
            "the latest one applies, so the frame jumps between them",
        ).help(format!(
            "let only one node publish it: `publish_tf` of robot_localization, `publish_odom_tf` (Classic) or \
             `<tf_topic>` (Harmonic) of the drive, `tf_broadcast` of AMCL; or the joint to `{}` is in \
             the URDF besides",
            parents.first().map_or("", String::as_str)
        )),
        TreeFault::SeveralTrees(roots) => {
            let advice = match missing(forest, roots) {
                Some(("map", _)) => {
                    "start a mapper (`periplus slam --live`) or AMCL, and give AMCL an initial pose \
                     (`set_initial_pose`, or a pose on `/initialpose`)"
                }
                Some(("odom", _)) => {
                    "let the drive publish it: `publish_odom_tf` true (Classic), `<tf_topic>/tf</tf_topic>` \
                     (Harmonic), or `publish_tf` true of robot_localization; its `odom_frame` and \
                     `base_link_frame` must be these names"
                }
                _ => {
                    "add a joint between them to robot_state_publisher's `robot_description`, \
                     or publish it with `periplus tf static`"
                }
            };
            finding.help(advice)
        }
    }
}

/// Transform that would connect the trees: from the standard parent frame to the disconnected root.
fn missing<'f>(forest: &'f Forest, roots: &'f [String]) -> Option<(&'f str, &'f str)> {
    let rank = |name: &str| STANDARD_FRAMES.iter().position(|usual| *usual == name);
    // The lowest root that is a standard frame; otherwise the first root.
    let child = roots
        .iter()
        .filter(|root| rank(root).is_some())
        .max_by_key(|root| rank(root))
        .or_else(|| roots.last())?;
    let below = rank(child).unwrap_or(STANDARD_FRAMES.len());
    let parent = STANDARD_FRAMES[..below].iter().rev().find(|usual| {
        forest.frames().any(|frame| frame.name == **usual && top(forest, &frame.name) != *child)
    });
    let parent = match parent {
        Some(parent) => parent,
        None => roots.iter().find(|root| *root != child)?.as_str(),
    };
    Some((parent, child))
}

/// Root of a frame.
fn top<'f>(forest: &'f Forest, frame: &'f str) -> &'f str {
    let mut at = frame;
    // No chain is longer than the number of frames.
    for _ in forest.frames() {
        let up = forest.frames().find(|frame| frame.name == at).and_then(|it| it.edge.as_ref());
        match up {
            Some(edge) => at = &edge.parent,
            None => break,
        }
    }
    at
}

fn stale(forest: &Forest, found: &mut Diagnostics) {
    let moving = || {
        forest.frames().filter_map(|frame| {
            let edge = frame.edge.as_ref().filter(|edge| edge.kind == TransformKind::Moving)?;
            Some((frame, edge))
        })
    };
    let newest_ns = moving().map(|(_, edge)| edge.newest_ns).max().unwrap_or(0);
    for (frame, edge) in moving() {
        let behind_ns = newest_ns - edge.newest_ns;
        if behind_ns > STALE_NS {
            found.push(
                Diagnostic::warning(
                    "frame-stale",
                    format!(
                        "`{}` in `{}` was last published {:.1} s before the newest transform",
                        frame.name,
                        edge.parent,
                        behind_ns as f64 * 1e-9
                    ),
                )
                .help(
                    "its broadcaster has stopped, receives no input, or uses another \
                     clock (`use_sim_time`)",
                ),
            );
        }
    }
}

fn named(observation: &SystemObservation, forest: &Forest, found: &mut Diagnostics) {
    if forest.frames().next().is_none() && observation.heard.values().any(|heard| heard.count > 0) {
        // One finding for all: without transforms no frame has a pose.
        found.push(
            Diagnostic::hint("no-frames", "no transforms are published on `/tf` or `/tf_static`")
                .note("sensor data cannot be fused, mapped or displayed in a common frame")
                .help(
                    "start robot_state_publisher with the robot's `robot_description`; in Gazebo Harmonic \
                     `gz::sim::systems::PosePublisher` publishes them",
                ),
        );
    }
    for (topic, heard) in &observation.heard {
        for frame in &heard.frames {
            let plain = frame.trim_start_matches('/');
            if frame.is_empty() {
                found.push(
                    Diagnostic::error("frame-empty", format!("messages on `{topic}` have an empty frame_id"))
                        .help("set the sensor's frame: `frame_name` (Classic), `<gz_frame_id>` (Harmonic)"),
                );
                continue;
            }
            if frame.starts_with('/') {
                found.push(
                    Diagnostic::error(
                        "frame-slash",
                        format!(
                            "messages on `{topic}` have the frame_id `{frame}` with a leading slash"
                        ),
                    )
                    .note("tf2 refuses such names")
                    .help(format!(
                        "set the sensor's frame to `{plain}` (`frame_name`, `frame_id`)"
                    )),
                );
            }
            let is_known = |name: &str| forest.frames().any(|frame| frame.name == name);
            if is_known(plain) || forest.frames().next().is_none() {
                continue;
            }
            if heard.type_name.ends_with("/Odometry") {
                found.push(
                    Diagnostic::warning(
                        "frame-unknown",
                        format!("`{topic}` has odometry in `{frame}`, which no transform connects to the robot"),
                    )
                    .help(
                        "start robot_localization's `ekf_node` with this topic as `odom0`, or let the \
                         drive publish the transform itself: `publish_odom_tf` true (Classic), \
                         `<tf_topic>/tf</tf_topic>` (Harmonic)",
                    ),
                );
                continue;
            }
            let finding = Diagnostic::error(
                "frame-unknown",
                format!("messages on `{topic}` are in the frame `{frame}`, which has no transform"),
            );
            let near = closest(plain, forest.frames().map(|frame| frame.name.as_str()));
            let tail = plain.rsplit('/').next().unwrap_or(plain);
            let parts = plain.split('/').rev().skip(1);
            let near = near.or_else(|| parts.into_iter().chain([tail]).find(|part| is_known(part)));
            found.push(match near {
                Some(near) => finding.help(format!(
                    "set the sensor's frame to `{near}`: `<frame_name>` (Classic), `<gz_frame_id>` \
                     (Harmonic); or publish its pose: `periplus tf static 0 0 0 0 0 0 {near} {plain}`"
                )),
                None => finding.help(
                    "start robot_state_publisher with the robot's `robot_description`, or publish \
                     its pose with `periplus tf static`",
                ),
            });
        }
    }
}
