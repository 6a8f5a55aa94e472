//! TF listener: transforms from `/tf` and `/tf_static`, with diagnosis of missing ones.

use periplus_geometry::{DQuat, DVec3, Pose, Pose2};
use periplus_msgs::{geometry_msgs, tf2_msgs};
use periplus_tf::{Buffer, LookupError, StampedTransform, TransformKind};

/// Maximum depth of a frame tree.
const MAX_DEPTH: usize = 1000;

/// Buffer of transforms between frames.
#[derive(Default)]
pub struct Frames {
    buffer: Buffer,
}

impl Frames {
    /// Creates a buffer with a cache time \[ns\] (default 10 s).
    #[must_use]
    pub fn kept_for(span_ns: i64) -> Self {
        Self { buffer: Buffer::new(span_ns) }
    }

    /// Inserts the transforms of a message.
    pub fn take(&mut self, message: &tf2_msgs::TFMessage, kind: TransformKind) {
        for transform in &message.transforms {
            // Malformed transforms are dropped, as in tf2.
            let _refused = self.buffer.set(&stamped(transform), "tf", kind);
        }
    }

    /// Clears the buffer after a jump of time.
    pub fn forget(&mut self) {
        self.buffer.clear();
    }

    /// Looks up `target_from_source` at a time \[ns\], or the latest with 0; returns it with its
    /// time \[ns\].
    ///
    /// # Errors
    /// When the transform is not available.
    pub fn at(&self, target: &str, source: &str, time_ns: i64) -> Result<(Pose, i64), LookupError> {
        let found = self.buffer.lookup(plain(target), plain(source), time_ns)?;
        Ok((found.target_from_source, found.time_ns))
    }

    /// Motion of the robot between a time and now by odometry: `then_from_now`.
    #[must_use]
    pub fn moved_since(&self, odom: &str, base: &str, time_ns: i64) -> Option<Pose2> {
        let (odom_from_now, newest_ns) = self.at(odom, base, 0).ok()?;
        if newest_ns != 0 && newest_ns <= time_ns {
            return Some(Pose2::IDENTITY);
        }
        let (odom_from_then, _) = self.at(odom, base, time_ns).ok()?;
        Some(Pose2::from(odom_from_then.inverse() * odom_from_now))
    }

    /// True if a transform of the frame was received.
    #[must_use]
    pub fn has(&self, frame: &str) -> bool {
        self.buffer.has_frame(frame)
    }

    /// Describes the missing transform between two frames and its likely publisher.
    #[must_use]
    pub fn missing(&self, target: &str, source: &str) -> String {
        let (target, source) = (plain(target), plain(source));
        let unpublished = |frame: &str| format!("the frame `{frame}` is not published on /tf");
        match (self.buffer.has_frame(target), self.buffer.has_frame(source)) {
            (false, false) => {
                return format!("the frames `{target}` and `{source}` are not published on /tf");
            }
            (false, true) => return unpublished(target),
            (true, false) => return unpublished(source),
            (true, true) => {}
        }
        let (root_of_target, root_of_source) = (self.root(target), self.root(source));
        if root_of_target == root_of_source {
            return "both exist, but not at the same time: check that all nodes use the same \
                    clock (`use_sim_time`)"
                .to_owned();
        }
        let describe = |frame: &str, root: &str| {
            if frame == root {
                format!("`{frame}` has no parent")
            } else {
                format!("the root of `{frame}` is `{root}`")
            }
        };
        format!(
            "{}, {}: a transform between these two trees is missing",
            describe(target, &root_of_target),
            describe(source, &root_of_source)
        )
    }

    /// The root of the tree of a frame.
    fn root(&self, frame: &str) -> String {
        let mut top = frame;
        // A cycle has no root.
        for _ in 0..MAX_DEPTH {
            match self.buffer.parent_of(top) {
                Some(parent) => top = parent,
                None => break,
            }
        }
        top.to_owned()
    }
}

/// Removes the leading slash of ROS 1 frame names.
#[must_use]
pub fn plain(frame: &str) -> &str {
    frame.trim_start_matches('/')
}

fn stamped(transform: &geometry_msgs::TransformStamped) -> StampedTransform {
    let geometry_msgs::Transform { translation, rotation } = &transform.transform;
    StampedTransform {
        parent: transform.header.frame_id.clone(),
        child: transform.child_frame_id.clone(),
        stamp_ns: transform.header.stamp.ns(),
        translation: DVec3::new(translation.x, translation.y, translation.z),
        rotation: DQuat::from_xyzw(rotation.x, rotation.y, rotation.z, rotation.w),
    }
}

#[cfg(test)]
mod tests {
    use periplus_msgs::builtin_interfaces::Time;
    use periplus_msgs::std_msgs::Header;

    use super::*;

    #[test]
    fn frames_are_remembered_for_as_long_as_they_should() {
        const SECOND_NS: i64 = 1_000_000_000;
        let remembers = |mut frames: Frames| {
            for time_s in 0..=20 {
                let mut transform = geometry_msgs::TransformStamped {
                    header: Header {
                        stamp: Time::of_ns(time_s * SECOND_NS),
                        frame_id: "odom".into(),
                    },
                    child_frame_id: "base_link".into(),
                    ..geometry_msgs::TransformStamped::default()
                };
                transform.transform.rotation.w = 1.0;
                frames.take(
                    &tf2_msgs::TFMessage { transforms: vec![transform] },
                    TransformKind::Moving,
                );
            }
            frames.at("odom", "base_link", 5 * SECOND_NS).is_ok()
        };
        assert!(!remembers(Frames::default()));
        assert!(remembers(Frames::kept_for(30 * SECOND_NS)));
    }
}
