//! The tree of frames, and frames that messages name.

use crate::frames::{Fault, Forest};
use periplus_diagnostics::{Diagnostic, Diagnostics, closest};
use periplus_tf::Kind;

use super::Picture;

/// Usual frames from the top down (REP 105).
const USUAL: [&str; 5] = ["earth", "map", "odom", "base_footprint", "base_link"];

/// A moving frame that is so far behind the others is told no more \[ns\].
const STALE_NS: i64 = 2_000_000_000;

pub(super) fn examine(picture: &Picture, found: &mut Diagnostics) {
    let forest = Forest::new(&picture.survey);
    for fault in forest.faults() {
        found.push(told(&fault, &forest));
    }
    for name in picture.survey.with_slash() {
        found.push(
            Diagnostic::warning("frame-slash", format!("the frame `{name}` has a slash in front"))
                .note("tf2 drops it where transforms are told, and refuses it where they are asked for")
                .help(format!("write `{}` where the frame is named", name.trim_start_matches('/'))),
        );
    }
    for (child, why, count) in picture.survey.refused() {
        found.push(
            Diagnostic::error(
                "frame-refused",
                format!("{count} transforms of `{child}` were not taken: {why}"),
            )
            .help("who broadcasts it computes with numbers that are none, or names no frame"),
        );
    }
    stale(&forest, found);
    named(picture, &forest, found);
}

fn told(fault: &Fault, forest: &Forest) -> Diagnostic {
    let finding = Diagnostic::error(
        match fault {
            Fault::Circle(_) => "frame-circle",
            Fault::SeveralTrees(_) => "frame-missing",
            Fault::SeveralParents { .. } => "frame-two-parents",
        },
        match fault {
            Fault::SeveralTrees(roots) => match missing(forest, roots) {
                Some((parent, child)) => {
                    format!("nobody tells where `{child}` is in `{parent}`: {fault}")
                }
                None => fault.to_string(),
            },
            _ => fault.to_string(),
        },
    );
    match fault {
        Fault::Circle(_) => finding.help("one of these transforms has parent and child exchanged"),
        Fault::SeveralParents { parents, .. } => finding.note(
            "the last one counts, so the frame jumps between them",
        ).help(format!(
            "let one node tell it: `publish_tf` of robot_localization, `publish_odom_tf` (Classic) or \
             `<tf_topic>` (Harmonic) of the drive, `tf_broadcast` of AMCL; or the joint to `{}` is in \
             the URDF besides",
            parents.first().map_or("", String::as_str)
        )),
        Fault::SeveralTrees(roots) => {
            let advice = match missing(forest, roots) {
                Some(("map", _)) => {
                    "start a mapper (`periplus slam --live`) or AMCL, and give AMCL an initial pose \
                     (`set_initial_pose`, or a pose on `/initialpose`)"
                }
                Some(("odom", _)) => {
                    "let the drive tell it: `publish_odom_tf` true (Classic), `<tf_topic>/tf</tf_topic>` \
                     (Harmonic), or `publish_tf` true of robot_localization; its `odom_frame` and \
                     `base_link_frame` must be these names"
                }
                _ => {
                    "let robot_state_publisher have a joint between them in its `robot_description`, \
                     or tell it with `periplus tf static`"
                }
            };
            finding.help(advice)
        }
    }
}

/// The transform that would connect trees: from the usual frame above to the root that stands alone.
fn missing<'f>(forest: &'f Forest, roots: &'f [String]) -> Option<(&'f str, &'f str)> {
    let rank = |name: &str| USUAL.iter().position(|usual| *usual == name);
    // The lowest root that is a usual frame, and of the rest whatever is highest.
    let child = roots
        .iter()
        .filter(|root| rank(root).is_some())
        .max_by_key(|root| rank(root))
        .or_else(|| roots.last())?;
    let below = rank(child).unwrap_or(USUAL.len());
    let parent = USUAL[..below].iter().rev().find(|usual| {
        forest.frames().any(|frame| frame.name == **usual && top(forest, &frame.name) != *child)
    });
    let parent = match parent {
        Some(parent) => parent,
        None => roots.iter().find(|root| *root != child)?.as_str(),
    };
    Some((parent, child))
}

/// The root above a frame.
fn top<'f>(forest: &'f Forest, frame: &'f str) -> &'f str {
    let mut at = frame;
    // No chain is longer than there are frames.
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
            let edge = frame.edge.as_ref().filter(|edge| edge.kind == Kind::Moving)?;
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
                        "`{}` in `{}` was told last {:.1} s before the newest transform",
                        frame.name,
                        edge.parent,
                        behind_ns as f64 * 1e-9
                    ),
                )
                .help(
                    "its broadcaster has stopped, hears nothing (its own topics), or lives by another \
                     clock (`use_sim_time`)",
                ),
            );
        }
    }
}

fn named(picture: &Picture, forest: &Forest, found: &mut Diagnostics) {
    if forest.frames().next().is_none() && picture.heard.values().any(|heard| heard.count > 0) {
        // One word for all: without transforms no frame has a place.
        found.push(
            Diagnostic::hint("no-frames", "nobody tells transforms on `/tf` or `/tf_static`")
                .note("sensors can be read as they are, but not put together, mapped or shown in a frame")
                .help(
                    "start robot_state_publisher with the robot's `robot_description`; of Harmonic's \
                     plugins `gz::sim::systems::PosePublisher` tells them",
                ),
        );
    }
    for (topic, heard) in &picture.heard {
        for frame in &heard.frames {
            let plain = frame.trim_start_matches('/');
            if frame.is_empty() {
                found.push(
                    Diagnostic::error("frame-empty", format!("messages on `{topic}` name no frame"))
                        .help("set the sensor's frame: `frame_name` (Classic), `<gz_frame_id>` (Harmonic)"),
                );
                continue;
            }
            if frame.starts_with('/') {
                found.push(
                    Diagnostic::error(
                        "frame-slash",
                        format!(
                            "messages on `{topic}` name the frame `{frame}`, with a slash in front"
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
                        format!("`{topic}` tells odometry in `{frame}`, which no transform places"),
                    )
                    .help(
                        "start robot_localization's `ekf_node` with this topic as `odom0`, or let the \
                         drive tell the transform itself: `publish_odom_tf` true (Classic), \
                         `<tf_topic>/tf</tf_topic>` (Harmonic)",
                    ),
                );
                continue;
            }
            let finding = Diagnostic::error(
                "frame-unknown",
                format!(
                    "messages on `{topic}` are in the frame `{frame}`, which no transform places"
                ),
            );
            let near = closest(plain, forest.frames().map(|frame| frame.name.as_str()));
            let tail = plain.rsplit('/').next().unwrap_or(plain);
            let parts = plain.split('/').rev().skip(1);
            let near = near.or_else(|| parts.into_iter().chain([tail]).find(|part| is_known(part)));
            found.push(match near {
                Some(near) => finding.help(format!(
                    "set the sensor's frame to `{near}`: `<frame_name>` (Classic), `<gz_frame_id>` \
                     (Harmonic); or tell where it is: `periplus tf static 0 0 0 0 0 0 {near} {plain}`"
                )),
                None => finding.help(
                    "start robot_state_publisher with the robot's `robot_description`, or tell where \
                     the frame is with `periplus tf static`",
                ),
            });
        }
    }
}
