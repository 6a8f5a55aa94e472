//! `static_transform_publisher`.
//!
//! Source: `tf2_ros/src/static_transform_broadcaster_program.cpp` (jazzy), `tf/src/static_transform_publisher.cpp`
//! (noetic).

use periplus_geometry::{DQuat, Pose, Rpy};
use periplus_graph::{Actor, Node, Publisher, Qos};
use periplus_msgs::geometry_msgs::{Quaternion, Transform, TransformStamped, Vector3};
use periplus_msgs::std_msgs::Header;
use periplus_msgs::tf2_msgs::TFMessage;

use crate::bringup::parameters::{NamedParameters, number_of, text_of};
use crate::bringup::words;

/// Static transform from arguments or parameters.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FixedFrame {
    pub(crate) parent: String,
    pub(crate) child: String,
    pub(crate) parent_from_child: Pose,
    /// Period of the messages, for ROS 1's `tf` \[ns\].
    pub(crate) period_ns: Option<i64>,
}

impl FixedFrame {
    /// Parses the arguments of the program.
    ///
    /// # Errors
    /// A message with the syntax.
    pub(crate) fn read(words: &[String], named: &NamedParameters) -> Result<Self, String> {
        let positions: Vec<&String> = words.iter().take_while(|word| !is_flag(word)).collect();
        match positions.len() {
            0 if words.is_empty() => Self::of_parameters(named),
            0 => Self::of_flags(words),
            8..=10 => Self::of_positions(&positions),
            _ => Err(format!(
                "`{}` is not a transform; write `--x X --y Y --z Z --roll R --pitch P --yaw Y --frame-id \
                 PARENT --child-frame-id CHILD`, or `X Y Z YAW PITCH ROLL PARENT CHILD`",
                words.join(" ")
            )),
        }
    }

    fn of_flags(words: &[String]) -> Result<Self, String> {
        let number = |name: &str| match words::option(words, name) {
            None => Ok(None),
            Some(word) => number(word).map(Some),
        };
        let or_zero = |name: &str| number(name).map(Option::unwrap_or_default);
        let xyz = [or_zero("x")?, or_zero("y")?, or_zero("z")?];
        let quaternion = [number("qx")?, number("qy")?, number("qz")?, number("qw")?];
        let parent_from_child = if quaternion.iter().any(Option::is_some) {
            let [x, y, z, w] = quaternion.map(Option::unwrap_or_default);
            turned(xyz, [x, y, z, w])?
        } else {
            let rpy =
                Rpy { roll: or_zero("roll")?, pitch: or_zero("pitch")?, yaw: or_zero("yaw")? };
            Pose::from_xyz_rpy(xyz, rpy)
        };
        let frame = |name: &str| {
            words::option(words, name)
                .map(str::to_owned)
                .ok_or_else(|| format!("`--{name}` is missing"))
        };
        let (parent, child) = (frame("frame-id")?, frame("child-frame-id")?);
        Self::checked(parent, child, parent_from_child, None)
    }

    /// `x y z yaw pitch roll parent child`, or with a quaternion; ROS 1's `tf` adds a period in
    /// milliseconds.
    fn of_positions(words: &[&String]) -> Result<Self, String> {
        // With a quaternion the eighth word is a frame, and with a period the last one is a number.
        let has_quaternion =
            words.len() == 10 || words.len() == 9 && words[6].parse::<f64>().is_ok();
        let angles = if has_quaternion { 7 } else { 6 };
        let numbers: Vec<f64> =
            words[..angles].iter().map(|word| number(word)).collect::<Result<_, _>>()?;
        let xyz = [numbers[0], numbers[1], numbers[2]];
        let parent_from_child = if has_quaternion {
            turned(xyz, [numbers[3], numbers[4], numbers[5], numbers[6]])?
        } else {
            Pose::from_xyz_rpy(xyz, Rpy { yaw: numbers[3], pitch: numbers[4], roll: numbers[5] })
        };
        let period_ns = match words.get(angles + 2) {
            None => None,
            #[expect(clippy::cast_possible_truncation, reason = "it saturates")]
            Some(word) => Some(((number(word)? * 1e6) as i64).max(1_000_000)),
        };
        let (parent, child) = (words[angles].clone(), words[angles + 1].clone());
        Self::checked(parent, child, parent_from_child, period_ns)
    }

    fn of_parameters(named: &NamedParameters) -> Result<Self, String> {
        let number = |name: &str| number_of(named, name).unwrap_or_default();
        let xyz = ["x", "y", "z"].map(|axis| number(&format!("translation.{axis}")));
        let [x, y, z] = ["x", "y", "z"].map(|axis| number(&format!("rotation.{axis}")));
        let w = number_of(named, "rotation.w").unwrap_or(1.0);
        let frame = |name: &str| {
            text_of(named, name).ok_or_else(|| format!("the parameter `{name}` is missing"))
        };
        let (parent, child) = (frame("frame_id")?, frame("child_frame_id")?);
        Self::checked(parent, child, turned(xyz, [x, y, z, w])?, None)
    }

    fn checked(
        parent: String,
        child: String,
        parent_from_child: Pose,
        period_ns: Option<i64>,
    ) -> Result<Self, String> {
        let bare = |name: &str| name.trim_start_matches('/').to_owned();
        let (parent, child) = (bare(&parent), bare(&child));
        if parent == child {
            return Err(format!("the frame `{child}` cannot be its own parent"));
        }
        Ok(Self { parent, child, parent_from_child, period_ns })
    }

    /// Publishes the transform as long as the result is kept.
    ///
    /// # Errors
    /// A message when it cannot be published.
    pub(crate) fn tell(self, node: &Node) -> Result<Actor<Publisher<TFMessage>>, String> {
        let failed = |error: periplus_graph::GraphError| error.to_string();
        let Some(period_ns) = self.period_ns else {
            let frames = node.publisher("/tf_static", Qos::latched(1)).map_err(failed)?;
            frames.publish(self.message(node.now_ns()));
            return Ok(node.actor(frames));
        };
        let frames = node.publisher("/tf", Qos::reliable(100)).map_err(failed)?;
        let mut actor = node.actor(frames);
        // Stamped with the time of the next message.
        let tell = move |frames: &mut Publisher<TFMessage>, now_ns: i64| {
            frames.publish(self.message(now_ns + period_ns));
        };
        actor.timer(period_ns, move |frames, io| tell(frames, io.now_ns())).map_err(failed)?;
        Ok(actor)
    }

    fn message(&self, time_ns: i64) -> TFMessage {
        let Pose { translation: at, rotation: turn, .. } = self.parent_from_child;
        let transform = Transform {
            translation: Vector3 { x: at.x, y: at.y, z: at.z },
            rotation: Quaternion { x: turn.x, y: turn.y, z: turn.z, w: turn.w },
        };
        let header = Header::at(time_ns, &self.parent);
        let child_frame_id = self.child.clone();
        TFMessage { transforms: vec![TransformStamped { header, child_frame_id, transform }] }
    }
}

/// Returns true for an option; a negative number is none.
fn is_flag(word: &str) -> bool {
    word.starts_with('-') && word.parse::<f64>().is_err()
}

fn number(word: &str) -> Result<f64, String> {
    let number: Option<f64> = word.trim().parse().ok();
    number.filter(|number| number.is_finite()).ok_or_else(|| format!("`{word}` is not a number"))
}

fn turned(xyz: [f64; 3], [x, y, z, w]: [f64; 4]) -> Result<Pose, String> {
    let turn = DQuat::from_xyzw(x, y, z, w);
    let length = turn.length();
    if !(length.is_finite() && length > 1e-9) {
        return Err(format!("({x}, {y}, {z}, {w}) is not a rotation"));
    }
    Ok(Pose::from_xyz_quaternion(xyz, turn))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(line: &str) -> Result<FixedFrame, String> {
        let words: Vec<String> = line.split_whitespace().map(str::to_owned).collect();
        FixedFrame::read(&words, &NamedParameters::new())
    }

    #[test]
    fn all_spellings_mean_the_same() {
        let new =
            read("--x 1 --y -2 --z 0.5 --yaw 0 --frame-id map --child-frame-id odom").unwrap();
        let old = read("1 -2 0.5 0 0 0 map odom").unwrap();
        let turned = read("1 -2 0.5 0 0 0 1 /map /odom").unwrap();
        let quaternion =
            read("--x 1 --y -2 --z .5 --qw 1 --frame-id map --child-frame-id odom").unwrap();
        assert_eq!(new, old);
        assert_eq!(old, turned);
        assert_eq!(old, quaternion);
        assert_eq!((old.parent.as_str(), old.child.as_str()), ("map", "odom"));
        let with_period = read("1 -2 0.5 0 0 0 map odom 100").unwrap();
        assert_eq!(with_period.period_ns, Some(100_000_000));
        assert_eq!(FixedFrame { period_ns: None, ..with_period }, old);
    }

    #[test]
    fn yaw_stands_before_pitch_and_roll() {
        let frame = read("0 0 0 0.3 0 0 a b").unwrap();
        assert!((frame.parent_from_child.rpy().yaw - 0.3).abs() < 1e-12);
    }

    #[test]
    fn slips_are_told() {
        assert!(read("1 2 3 a b").unwrap_err().contains("not a transform"));
        assert!(read("0 0 0 0 0 0 a a").unwrap_err().contains("its own parent"));
        assert!(read("--x 1 --frame-id a").unwrap_err().contains("child-frame-id"));
        assert!(read("0 0 0 0 0 0 0 a b").unwrap_err().contains("not a rotation"));
    }
}
