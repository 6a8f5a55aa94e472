//! Robot of a recording: the topics and frames that its estimators need.

use periplus_bags::files::Bag;

use super::error::RerunError;
use super::parameters::{RerunKind, RerunParameters};
use crate::recorded::{RecordedFrames, has_type, scan_topic};

/// Topics and frames of a recorded robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct RecordedRobot {
    pub(super) scan_topic: String,
    pub(super) odom_frame: String,
    pub(super) base_frame: String,
    /// True if no transform leads from the odometry frame to the robot, so that odometry messages have to give it.
    pub(super) needs_odometry: bool,
    /// Topic of the map; none without one.
    pub(super) map_topic: Option<String>,
}

impl RecordedRobot {
    /// Detects topics and frames as `periplus slam` does; parameters that are set take precedence.
    pub(super) fn of(bag: &Bag, parameters: &RerunParameters) -> Result<Self, RerunError> {
        let scan_topic = match scan_topic(bag, parameters.given_text("scan_topic").as_deref(), None)
        {
            Ok(topic) => topic,
            // Costmaps may have other sensors.
            Err(_) if parameters.kind() == RerunKind::Costmap => "/scan".to_owned(),
            Err(why) => return Err(RerunError::Missing(why.to_string())),
        };
        let frames = RecordedFrames::read(bag).map_err(RerunError::Recording)?;
        let given = parameters.given_text(parameters.kind().odom_frame_parameter());
        let given_base = parameters.given_text(parameters.kind().base_frame_parameter());
        let base_below = |odom: &str| {
            if let Some(base) = &given_base {
                return frames.buffer.chain(odom, base).map(|_| base.clone());
            }
            let child = frames.buffer.frames().find(|it| frames.buffer.parent_of(it) == Some(odom));
            frames.base(odom, None).or_else(|| child.map(str::to_owned))
        };
        let named_odom = frames.buffer.frames().filter(|frame| frame.contains("odom"));
        let candidates: Vec<&str> = match &given {
            Some(odom) => vec![odom.as_str()],
            None => std::iter::once("odom").chain(named_odom).collect(),
        };
        let found = candidates
            .iter()
            .find_map(|odom| base_below(odom).map(|base| ((*odom).to_owned(), base)));
        let Some((odom_frame, base_frame)) = found else {
            return Err(RerunError::Missing(format!(
                "no transform or odometry leads from `{}` to the robot; set `{}` and `{}` to frames of the \
                 recording (it has {})",
                candidates.first().unwrap_or(&"odom"),
                parameters.kind().odom_frame_parameter(),
                parameters.kind().base_frame_parameter(),
                listed(frames.buffer.frames()),
            )));
        };
        let chain = frames.buffer.chain(&odom_frame, &base_frame).unwrap_or_default();
        let needs_odometry = chain.iter().any(|frame| frames.from_odometry.contains(*frame));
        let maps = || {
            let topics = bag.topics().iter().filter(|topic| has_type(topic, "OccupancyGrid"));
            topics.map(|topic| topic.name.as_str())
        };
        let wanted = parameters.given_text("map_topic");
        let map_topic = maps()
            .find(|name| {
                let plain = |name: &str| name.trim_start_matches('/').to_owned();
                wanted.as_ref().is_some_and(|wanted| plain(wanted) == plain(name))
            })
            .or_else(|| maps().find(|name| *name == "/map"))
            .or_else(|| maps().find(|name| name.ends_with("/map")))
            .map(str::to_owned);
        Ok(Self { scan_topic, odom_frame, base_frame, needs_odometry, map_topic })
    }
}

/// Maximum number of frames in a message.
const MAX_NAME_COUNT: usize = 12;

fn listed<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let mut names: Vec<&str> = names.collect();
    names.sort_unstable();
    let count = names.len();
    names.truncate(MAX_NAME_COUNT);
    match count {
        0 => "no frames".to_owned(),
        _ if count > MAX_NAME_COUNT => {
            format!("{} and {} more", names.join(", "), count - MAX_NAME_COUNT)
        }
        _ => names.join(", "),
    }
}
