//! Warnings and errors of built-in nodes, which a terminal shows like those of programs.

use periplus_graph::{Graph, Level, Mailbox, Node, NodeSettings, Qos};
use periplus_msgs::rcl_interfaces::Log;

use crate::bringup::report::{LaunchLog, PartOutcomeKind, PartReport};

/// Costmaps are nodes of the servers that own them.
const COSTMAPS: [&str; 2] = ["local_costmap.local_costmap", "global_costmap.global_costmap"];

/// Subscription to `/rosout`.
#[derive(Default)]
pub(crate) struct NodeLogs(Option<(Node, Mailbox<Log>)>);

impl NodeLogs {
    /// Returns the new warnings and errors of the built-in nodes among `lines`. Programs print their own.
    pub(crate) fn take(&mut self, graph: &Graph, lines: &[PartReport]) -> Vec<LaunchLog> {
        if self.0.is_none() {
            let node = graph.node(NodeSettings::new("_launch_log").bare().keep_names());
            let heard = node.and_then(|node| {
                let mailbox = node.mailbox("/rosout", Qos::latched(100))?;
                Ok((node, mailbox))
            });
            self.0 = heard.ok();
        }
        let Some((_, mailbox)) = &self.0 else { return Vec::new() };
        let is_ours = |logger: &str| {
            let built_in =
                lines.iter().filter(|line| line.outcome.kind == PartOutcomeKind::BuiltIn);
            let mut nodes = built_in.filter_map(|line| line.outcome.node.as_deref());
            COSTMAPS.iter().any(|name| logger.ends_with(name))
                || nodes.any(|node| node.trim_matches('/').replace('/', ".") == logger)
        };
        let log = |entry: &Log| {
            let level = Level::of_number(entry.level);
            let is_wanted = level >= Level::Warn && is_ours(&entry.name);
            is_wanted.then(|| LaunchLog::of_node(level, entry))
        };
        mailbox.drain().iter().filter_map(|entry| log(entry)).collect()
    }
}

#[cfg(test)]
mod tests {
    use periplus_msgs::builtin_interfaces::Time;

    use super::*;
    use crate::bringup::report::PartOutcome;

    #[test]
    fn warnings_of_built_in_nodes_are_shown_and_those_of_programs_are_not() {
        let graph = Graph::new();
        let line = |node: &str, kind: PartOutcomeKind| {
            let outcome = PartOutcome { kind, node: Some(node.to_owned()), told: String::new() };
            PartReport { step: 0, asked: node.to_owned(), outcome }
        };
        let lines =
            [line("/r1/amcl", PartOutcomeKind::BuiltIn), line("/mine", PartOutcomeKind::Python)];
        let mut logs = NodeLogs::default();
        assert!(logs.take(&graph, &lines).is_empty());
        let writer = graph.node(NodeSettings::new("writer").bare()).unwrap();
        let rosout = writer.publisher::<Log>("/rosout", Qos::latched(10)).unwrap();
        for (name, level) in [("r1.amcl", 30), ("r1.amcl", 20), ("mine", 40)] {
            let stamp = Time { sec: 2, nanosec: 500_000_000 };
            let (name, msg) = (name.to_owned(), "no map".to_owned());
            rosout.publish(Log { stamp, level, name, msg, ..Log::default() });
        }
        graph.settle();
        let shown = logs.take(&graph, &lines);
        let texts: Vec<&str> = shown.iter().map(|log| log.text.as_str()).collect();
        assert_eq!(texts, ["[r1.amcl] [WARN] [2.500000000]: no map"]);
    }
}
