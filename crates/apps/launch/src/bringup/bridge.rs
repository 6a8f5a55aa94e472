//! Configuration of `parameter_bridge`: pairs of Gazebo and ROS topics.
//!
//! Source of the grammar: `ros_gz_bridge/src/parameter_bridge.cpp` and `bridge_config.cpp` (jazzy).

use std::path::Path;

use periplus_diagnostics::SourceMap;
use periplus_os::Machine;
use periplus_resources::Host as _;
use periplus_yaml::{YamlNode, YamlValue};

/// Bridged topic.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Pair {
    /// Gazebo name.
    pub(crate) gz: String,
    /// ROS name, before remapping.
    pub(crate) ros: String,
    pub(crate) direction: Direction,
    /// True if the ROS type is `TwistStamped`, which Gazebo has as a plain `Twist`.
    pub(crate) is_stamped_velocity: bool,
}

/// ROS type whose stamp and frame Gazebo lacks.
const STAMPED_VELOCITY: &str = "geometry_msgs/msg/TwistStamped";

/// Direction of messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Direction {
    Both,
    GzToRos,
    RosToGz,
}

/// Parses arguments `topic@ros_type[gz_type`; services, `name@package/srv/Type`, are ignored.
///
/// # Errors
/// The invalid argument.
pub(crate) fn of_words(words: &[String]) -> Result<Vec<Pair>, String> {
    let mut pairs = Vec::new();
    for word in words {
        let wrong = || {
            format!(
                "`{word}` is none of `/topic@ros_type@gz_type`, with `[` from Gazebo, `]` to it"
            )
        };
        let (topic, types) = word.split_once('@').ok_or_else(wrong)?;
        if types.contains("/srv/") {
            continue;
        }
        let between = ['@', '[', ']'].into_iter().find(|sign| types.contains(*sign));
        let direction = match between.ok_or_else(wrong)? {
            '[' => Direction::GzToRos,
            ']' => Direction::RosToGz,
            _ => Direction::Both,
        };
        pairs.push(Pair {
            gz: topic.to_owned(),
            ros: topic.to_owned(),
            direction,
            is_stamped_velocity: types.starts_with(STAMPED_VELOCITY),
        });
    }
    Ok(pairs)
}

/// Reads the pairs of a file.
///
/// # Errors
/// A message when it cannot be read.
pub(crate) fn of_file(path: &Path) -> Result<Vec<Pair>, String> {
    let bytes = Machine.read(path);
    let bytes = bytes.map_err(|error| format!("{} cannot be read: {error}", path.display()))?;
    let text =
        String::from_utf8(bytes).map_err(|_| format!("{} is not a text file", path.display()))?;
    let mut sources = SourceMap::new();
    let file = sources.add(path.display().to_string(), text);
    let tree = periplus_yaml::parse(file, &sources).map_err(|error| error.message)?;
    let items: &[YamlNode] = match tree.as_ref().map(|tree| &tree.value) {
        Some(YamlValue::List(items)) => items,
        _ => return Err(format!("{} is not a list of topics", path.display())),
    };
    let text =
        |item: &YamlNode, name: &str| item.get(name).and_then(YamlNode::text).map(str::to_owned);
    let pair = |item: &YamlNode| {
        let both = text(item, "topic_name");
        let ros = text(item, "ros_topic_name").or(both.clone());
        let gz = text(item, "gz_topic_name").or(both);
        let ros_or_gz = ros.clone().or(gz.clone())?;
        let direction = match text(item, "direction").as_deref() {
            Some("GZ_TO_ROS") => Direction::GzToRos,
            Some("ROS_TO_GZ") => Direction::RosToGz,
            _ => Direction::Both,
        };
        Some(Pair {
            gz: gz.unwrap_or(ros_or_gz.clone()),
            ros: ros.unwrap_or(ros_or_gz),
            direction,
            is_stamped_velocity: text(item, "ros_type_name").as_deref() == Some(STAMPED_VELOCITY),
        })
    };
    Ok(items.iter().filter_map(pair).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_sign_behind_the_type_says_which_way() {
        let words = [
            "/a@std_msgs/msg/Int32@gz.msgs.Int32",
            "/lidar@sensor_msgs/msg/LaserScan[gz.msgs.LaserScan",
            "/c@x]y",
            "/w/control@ros_gz_interfaces/srv/ControlWorld",
        ];
        let pairs = of_words(&words.map(str::to_owned)).unwrap();
        let told: Vec<_> = pairs.iter().map(|pair| (pair.gz.as_str(), pair.direction)).collect();
        assert_eq!(
            told,
            [("/a", Direction::Both), ("/lidar", Direction::GzToRos), ("/c", Direction::RosToGz)]
        );
        assert!(of_words(&["/a".to_owned()]).unwrap_err().contains("/a"));
    }
}
