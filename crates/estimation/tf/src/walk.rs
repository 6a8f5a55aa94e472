//! Transform chains between two frames.
//!
//! Source: `BufferCore::walkToTopParent` and `getLatestCommonTime`.

use periplus_geometry::Pose;

use crate::buffer::{Buffer, FrameId, ResolvedTransform};
use crate::error::{LookupError, LookupErrorKind};

/// Longest chain; a longer one is a loop (`MAX_GRAPH_DEPTH` of tf2).
const MAX_GRAPH_DEPTH: usize = 1000;

/// Walks up from the source to the root of its tree, then up from the target until both chains
/// meet. If the source has no sample at that time its chain ends there, which is not an error when the
/// target is on it.
pub(crate) fn walk(
    buffer: &Buffer,
    target: FrameId,
    source: FrameId,
    time_ns: i64,
) -> Result<ResolvedTransform, LookupError> {
    let time_ns = if time_ns == 0 { common_time_ns(buffer, target, source)? } else { time_ns };
    let mut top_from_source = Pose::IDENTITY;
    let mut top = source;
    let mut outside = None;
    for depth in 0.. {
        if depth > MAX_GRAPH_DEPTH {
            return Err(circle(buffer));
        }
        let Some(cache) = buffer.cache(top) else { break };
        let sample = match cache.at(time_ns) {
            Ok(sample) => sample,
            Err(error) => {
                outside = Some(error);
                break;
            }
        };
        if top == target {
            return Ok(ResolvedTransform { time_ns, target_from_source: top_from_source });
        }
        top_from_source = sample.pose() * top_from_source;
        top = sample.parent;
    }

    let mut top_from_target = Pose::IDENTITY;
    let mut frame = target;
    for depth in 0.. {
        if depth > MAX_GRAPH_DEPTH {
            return Err(circle(buffer));
        }
        if frame == top {
            let target_from_source = top_from_target.inverse() * top_from_source;
            return Ok(ResolvedTransform { time_ns, target_from_source });
        }
        let Some(cache) = buffer.cache(frame) else { break };
        let sample =
            cache.at(time_ns).map_err(|error| looking_up(buffer, error, target, source))?;
        if frame == source {
            return Ok(ResolvedTransform {
                time_ns,
                target_from_source: top_from_target.inverse(),
            });
        }
        top_from_target = sample.pose() * top_from_target;
        frame = sample.parent;
    }
    Err(match outside {
        Some(error) => looking_up(buffer, error, target, source),
        None => unconnected(buffer, target, source),
    })
}

/// Returns the latest common time of all dynamic frames between two frames; 0 when all are static.
fn common_time_ns(buffer: &Buffer, target: FrameId, source: FrameId) -> Result<i64, LookupError> {
    let earlier = |time_ns: i64, newest_ns: i64| {
        if newest_ns == 0 { time_ns } else { time_ns.min(newest_ns) }
    };
    let or_none = |time_ns: i64| if time_ns == i64::MAX { 0 } else { time_ns };
    let mut rise: Vec<(i64, FrameId)> = Vec::new();
    let mut time_ns = i64::MAX;
    let mut frame = source;
    while let Some((newest_ns, parent)) = step(buffer, frame) {
        time_ns = earlier(time_ns, newest_ns);
        rise.push((newest_ns, parent));
        frame = parent;
        if frame == target {
            return Ok(or_none(time_ns));
        }
        if rise.len() > MAX_GRAPH_DEPTH {
            return Err(circle(buffer));
        }
    }
    let mut time_ns = i64::MAX;
    let mut frame = target;
    for depth in 0.. {
        if depth > MAX_GRAPH_DEPTH {
            return Err(circle(buffer));
        }
        let Some((newest_ns, parent)) = step(buffer, frame) else { break };
        time_ns = earlier(time_ns, newest_ns);
        if let Some(meeting) = rise.iter().position(|&(_, met)| met == parent) {
            let shared = rise[..=meeting].iter();
            return Ok(or_none(shared.fold(time_ns, |time_ns, &(ns, _)| earlier(time_ns, ns))));
        }
        frame = parent;
        if frame == source {
            return Ok(or_none(time_ns));
        }
    }
    Err(unconnected(buffer, target, source))
}

/// Returns the newest stamp and the parent of a frame that has one.
fn step(buffer: &Buffer, frame: FrameId) -> Option<(i64, FrameId)> {
    let (newest_ns, parent) = buffer.cache(frame)?.newest();
    (parent != 0).then_some((newest_ns, parent))
}

fn looking_up(
    buffer: &Buffer,
    error: LookupError,
    target: FrameId,
    source: FrameId,
) -> LookupError {
    let message = format!(
        "{}, when looking up transform from frame [{}] to frame [{}]",
        error.message,
        buffer.name(source),
        buffer.name(target)
    );
    LookupError::new(error.kind, message)
}

fn unconnected(buffer: &Buffer, target: FrameId, source: FrameId) -> LookupError {
    let message = format!(
        "Could not find a connection between '{}' and '{}' because they are not part of the same \
         tree.Tf has two or more unconnected trees.",
        buffer.name(target),
        buffer.name(source)
    );
    LookupError::new(LookupErrorKind::Connectivity, message)
}

fn circle(buffer: &Buffer) -> LookupError {
    let frames = buffer.frames_text();
    let message = format!("The tf tree is invalid because it contains a loop.\n{frames}\n");
    LookupError::new(LookupErrorKind::Lookup, message)
}
