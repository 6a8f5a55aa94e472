//! Where frames are, as heard on `/tf` and `/tf_static`, and which edge is missing between two.

use periplus_geometry::{DQuat, DVec3, Pose, Pose2};
use periplus_msgs::{geometry_msgs, tf2_msgs};
use periplus_tf::{Buffer, Kind, LookupError, Stamped};

/// Trees of frames are no deeper.
const DEEPEST: usize = 1000;

/// Frames, and how they hang on each other.
#[derive(Default)]
pub struct Frames {
    buffer: Buffer,
}

impl Frames {
    /// Frames that are remembered for so long behind their newest \[ns\]; by default for ten seconds.
    #[must_use]
    pub fn kept_for(span_ns: i64) -> Self {
        Self { buffer: Buffer::new(span_ns) }
    }

    /// Takes in what was broadcast.
    pub fn take(&mut self, message: &tf2_msgs::TFMessage, kind: Kind) {
        for transform in &message.transforms {
            // What is malformed is dropped, as tf2 drops it.
            let _refused = self.buffer.set(&stamped(transform), "tf", kind);
        }
    }

    /// Time has jumped.
    pub fn forget(&mut self) {
        self.buffer.clear();
    }

    /// `target_from_source` at a time \[ns\]; 0 for the newest. With it, when that was \[ns\].
    ///
    /// # Errors
    /// When nobody knows.
    pub fn at(&self, target: &str, source: &str, time_ns: i64) -> Result<(Pose, i64), LookupError> {
        let found = self.buffer.lookup(plain(target), plain(source), time_ns)?;
        Ok((found.target_from_source, found.time_ns))
    }

    /// How the robot moved from one time to its newest place, by odometry: `then_from_now`.
    #[must_use]
    pub fn moved_since(&self, odom: &str, base: &str, time_ns: i64) -> Option<Pose2> {
        let (odom_from_now, newest_ns) = self.at(odom, base, 0).ok()?;
        if newest_ns != 0 && newest_ns <= time_ns {
            return Some(Pose2::IDENTITY);
        }
        let (odom_from_then, _) = self.at(odom, base, time_ns).ok()?;
        Some(Pose2::from(odom_from_then.inverse() * odom_from_now))
    }

    /// Whether anybody has spoken of a frame.
    #[must_use]
    pub fn has(&self, frame: &str) -> bool {
        self.buffer.has_frame(frame)
    }

    /// What is missing between two frames, and who would say it.
    #[must_use]
    pub fn missing(&self, target: &str, source: &str) -> String {
        let (target, source) = (plain(target), plain(source));
        let unheard = |frame: &str| format!("nobody has published the frame `{frame}` on /tf");
        match (self.buffer.has_frame(target), self.buffer.has_frame(source)) {
            (false, false) => {
                return format!("nobody has published the frames `{target}` and `{source}` on /tf");
            }
            (false, true) => return unheard(target),
            (true, false) => return unheard(source),
            (true, true) => {}
        }
        let (top_of_target, top_of_source) = (self.top(target), self.top(source));
        if top_of_target == top_of_source {
            return "both are there, but not at the same time: check that all nodes use the same \
                    clock (`use_sim_time`)"
                .to_owned();
        }
        let hangs = |frame: &str, top: &str| {
            if frame == top {
                format!("`{frame}` hangs on nothing")
            } else {
                format!("`{frame}` hangs on `{top}`")
            }
        };
        format!(
            "{}, {}: a transform between these two trees is missing",
            hangs(target, &top_of_target),
            hangs(source, &top_of_source)
        )
    }

    /// The frame on which another hangs in the end.
    fn top(&self, frame: &str) -> String {
        let mut top = frame;
        // A circle has no top.
        for _ in 0..DEEPEST {
            match self.buffer.parent_of(top) {
                Some(parent) => top = parent,
                None => break,
            }
        }
        top.to_owned()
    }
}

/// Without the slash that ROS 1 once wanted.
#[must_use]
pub fn plain(frame: &str) -> &str {
    frame.trim_start_matches('/')
}

fn stamped(transform: &geometry_msgs::TransformStamped) -> Stamped {
    let geometry_msgs::Transform { translation, rotation } = &transform.transform;
    Stamped {
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
                frames.take(&tf2_msgs::TFMessage { transforms: vec![transform] }, Kind::Moving);
            }
            frames.at("odom", "base_link", 5 * SECOND_NS).is_ok()
        };
        assert!(!remembers(Frames::default()));
        assert!(remembers(Frames::kept_for(30 * SECOND_NS)));
    }
}
