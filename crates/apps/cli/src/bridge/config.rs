//! Topics as YAML, in the format of `parameter_bridge`: a list with `topic_name`, or
//! `ros_topic_name` and `gz_topic_name`, `ros_type_name`, `gz_type_name`, and more. An invalid
//! entry is skipped.

use std::path::Path;

use periplus_diagnostics::{Diagnostic, Diagnostics, SourceMap};
use periplus_gz_transport::{BridgeDirection, TopicPair};
use periplus_session::files::FileError;
use periplus_yaml::YamlNode;

use super::spec::QUEUE_DEPTH;

/// Keys of an entry.
const KEYS: [&str; 9] = [
    "topic_name",
    "ros_topic_name",
    "gz_topic_name",
    "ros_type_name",
    "gz_type_name",
    "direction",
    "publisher_queue",
    "subscriber_queue",
    "lazy",
];

/// # Errors
/// When the file cannot be read.
pub(super) fn read(
    path: &Path,
    is_lazy: bool,
) -> Result<(Vec<TopicPair>, Diagnostics, SourceMap), FileError> {
    let text = crate::paths::text(path)?;
    Ok(read_text(&path.display().to_string(), text, is_lazy))
}

fn read_text(name: &str, text: String, is_lazy: bool) -> (Vec<TopicPair>, Diagnostics, SourceMap) {
    let (mut sources, mut findings) = (SourceMap::new(), Diagnostics::new());
    let file = sources.add(name.to_owned(), text);
    let mut pairs = Vec::new();
    match periplus_yaml::parse(file, &sources) {
        Err(error) => findings.push(*error),
        Ok(None) => {}
        Ok(Some(tree)) => match tree.list() {
            Some(entries) => {
                pairs.extend(entries.iter().filter_map(|it| entry(it, is_lazy, &mut findings)));
            }
            None if tree.is_null() => {}
            None => {
                let message = format!("expected a list of topics, not {}", tree.kind());
                findings.push(Diagnostic::error("bridge-config", message).at(tree.span));
            }
        },
    }
    (pairs, findings, sources)
}

fn entry(node: &YamlNode, is_lazy: bool, findings: &mut Diagnostics) -> Option<TopicPair> {
    let wrong = |message: &str, findings: &mut Diagnostics| {
        let finding = Diagnostic::error("bridge-config", message).at(node.span);
        findings.push(finding.help("the topic is left out"));
        None
    };
    let Some(entries) = node.entries() else {
        return wrong("expected a mapping with names and types of a topic", findings);
    };
    for (key, _) in entries {
        if !key.text().is_some_and(|key| KEYS.contains(&key)) {
            let told = format!("unknown key `{}` in a topic", key.text().unwrap_or("?"));
            let finding = Diagnostic::warning("bridge-config", told).at(key.span);
            findings.push(finding.help(format!("known keys: {}", KEYS.join(", "))));
        }
    }
    let text = |name: &str| node.get(name).and_then(YamlNode::text).map(str::to_owned);
    let both = text("topic_name");
    let (ros, gazebo) = (text("ros_topic_name"), text("gz_topic_name"));
    if both.is_some() && (ros.is_some() || gazebo.is_some()) {
        return wrong(
            "`topic_name` sets both names; remove it, or remove `ros_topic_name` and `gz_topic_name`",
            findings,
        );
    }
    let ros_topic = both.clone().or_else(|| ros.clone()).or_else(|| gazebo.clone());
    let gz_topic = both.or(gazebo).or(ros);
    let (Some(ros_topic), Some(gz_topic)) = (ros_topic, gz_topic) else {
        return wrong("the topic has no name; add `topic_name`", findings);
    };
    let (Some(ros_type), Some(gz_type)) = (text("ros_type_name"), text("gz_type_name")) else {
        return wrong("`ros_type_name` and `gz_type_name` are required", findings);
    };
    let direction = match text("direction").as_deref() {
        None | Some("BIDIRECTIONAL") => BridgeDirection::Both,
        Some("GZ_TO_ROS") => BridgeDirection::ToRos,
        Some("ROS_TO_GZ") => BridgeDirection::ToGazebo,
        Some(_) => {
            let told = "`direction` must be BIDIRECTIONAL, GZ_TO_ROS or ROS_TO_GZ";
            return wrong(told, findings);
        }
    };
    let queue = |name: &str| {
        let count = node.get(name).and_then(YamlNode::integer);
        count.and_then(|count| usize::try_from(count).ok()).unwrap_or(QUEUE_DEPTH)
    };
    Some(TopicPair {
        ros_topic,
        gz_topic,
        ros_type,
        gz_type,
        direction,
        is_lazy: node.get("lazy").and_then(YamlNode::truth).unwrap_or(is_lazy),
        publisher_queue: queue("publisher_queue"),
        subscriber_queue: queue("subscriber_queue"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_are_read_and_broken_ones_left_out() {
        let text = "\
- ros_topic_name: scan
  gz_topic_name: /lidar
  ros_type_name: sensor_msgs/msg/LaserScan
  gz_type_name: gz.msgs.LaserScan
  direction: GZ_TO_ROS
  lazy: true
  publisher_queue: 3
- topic_name: /cmd_vel
  ros_type_name: geometry_msgs/msg/Twist
  gz_type_name: gz.msgs.Twist
- topic_name: /a
  ros_topic_name: /b
  ros_type_name: std_msgs/msg/Bool
  gz_type_name: gz.msgs.Boolean
- topic_name: /c
  ros_type_name: std_msgs/msg/Bool
- {gz_topic_name: /d, ros_type_name: std_msgs/msg/Bool, gz_type_name: gz.msgs.Boolean, direction: UP}
- {gz_topic_name: /e, ros_type_name: std_msgs/msg/Bool, gz_type_name: gz.msgs.Boolean, lasy: true}
- 7
";
        let (pairs, findings, _) = read_text("bridge.yaml", text.to_owned(), false);
        assert_eq!(pairs.len(), 3);
        assert_eq!((pairs[0].ros_topic.as_str(), pairs[0].gz_topic.as_str()), ("scan", "/lidar"));
        assert_eq!((pairs[0].direction, pairs[0].is_lazy), (BridgeDirection::ToRos, true));
        assert_eq!((pairs[0].publisher_queue, pairs[0].subscriber_queue), (3, 10));
        assert_eq!((pairs[1].direction, pairs[1].is_lazy), (BridgeDirection::Both, false));
        assert_eq!((pairs[2].ros_topic.as_str(), pairs[2].gz_topic.as_str()), ("/e", "/e"));
        assert_eq!(findings.iter().count(), 5);
    }

    #[test]
    fn an_empty_file_has_no_topics() {
        for text in ["", "[]", "# nothing\n"] {
            let (pairs, findings, _) = read_text("empty.yaml", text.to_owned(), false);
            assert_eq!((pairs.len(), findings.iter().count()), (0, 0), "{text}");
        }
    }
}
