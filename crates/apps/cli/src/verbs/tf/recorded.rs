//! Tree of frames of a recording.

use std::path::Path;
use std::process::ExitCode;

use periplus_diagnostics::SourceMap;
use periplus_msgs::tf2_msgs::TFMessage;
use periplus_ros2cli::Failure;
use periplus_ros2cli::frames::Forest;
use periplus_ros2cli::tf::{Pictures, put_tree, stamped};
use periplus_tf::{TransformKind, TransformMonitor};

use crate::error::CliError;
use crate::terminal;
use crate::verbs::{Common, without_network};
use periplus_session::recorded::{each, has_type};

/// Builds the tree of all frames of a recording.
pub(super) fn tree(
    path: &Path,
    pictures: &Pictures,
    common: &Common,
) -> Result<ExitCode, CliError> {
    let bag = crate::paths::bag(path)?;
    let mut err = anstream::stderr().lock();
    terminal::diagnostics(&mut err, bag.findings(), &SourceMap::new())?;
    drop(err);
    let is_told = |topic: &&periplus_bags::BagTopic| {
        has_type(topic, "TFMessage") || has_type(topic, "tfMessage")
    };
    let topics: Vec<&str> =
        bag.topics().iter().filter(is_told).map(|topic| topic.name.as_str()).collect();
    without_network(common, |session| {
        if topics.is_empty() {
            return Err(Failure::failed(format!(
                "{} has no transforms: no topic of type tf2_msgs/msg/TFMessage",
                path.display()
            )));
        }
        let mut survey = TransformMonitor::with_cache_ns(i64::MAX);
        let mut newest_ns = 0;
        let read = each::<TFMessage>(&bag, &topics, |topic, message| {
            let kind = if topic.ends_with("tf_static") {
                TransformKind::Fixed
            } else {
                TransformKind::Moving
            };
            for transform in &message.transforms {
                let it = stamped(transform);
                newest_ns = newest_ns.max(it.stamp_ns);
                // Refused transforms are counted, and reported below.
                let _ = survey.insert(&it, topic, kind);
            }
        });
        for fault in read.map_err(|why| Failure::failed(why.to_string()))? {
            session.say(&format!("WARNING: {fault}"));
        }
        let refused: Vec<String> = survey
            .refused()
            .map(|(child, why, count)| format!("WARNING: {why}: `{child}`, {count} times"))
            .collect();
        for words in refused {
            session.say(&words);
        }
        put_tree(session, &Forest::new(&survey), &survey, newest_ns, pictures)
    })
}
