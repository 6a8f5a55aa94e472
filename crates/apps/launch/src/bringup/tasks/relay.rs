//! Relay between topics.

use periplus_graph::{Graph, Node, NodeSettings, RawMailbox, RawPublisher};

use super::{Done, Task, TaskContext};

/// Relay between two names of a topic.
pub(crate) struct Relay {
    node: Node,
    /// For names that remappings of the node would change.
    plain: Node,
    /// Possible source topics by full name, in order of preference, each with its destination.
    ways: Vec<(String, String)>,
    open: Option<(RawMailbox, RawPublisher)>,
}

impl Relay {
    /// Relays from one full name to another; the first direction whose source has a publisher is
    /// used.
    /// # Errors
    /// A message when it cannot be created.
    pub(crate) fn new(
        graph: &Graph,
        node: Node,
        ways: Vec<(String, String)>,
    ) -> Result<Self, String> {
        let beside = format!("{}_names", node.names().name());
        let namespace = node.names().namespace().to_owned();
        let mut number = 1;
        let plain = loop {
            // A bridge has many relays.
            let name = format!("{beside}_{number}");
            let settings = NodeSettings::new(name).namespace(&namespace).bare().keep_names();
            match graph.node(settings) {
                Ok(plain) => break plain,
                Err(error) if number > 1000 => return Err(error.to_string()),
                Err(_) => number += 1,
            }
        };
        Ok(Self { node, plain, ways, open: None })
    }

    /// Node that resolves this name unchanged.
    fn meaning(&self, name: &str) -> &Node {
        let is_kept = self.node.names().topic(name).is_ok_and(|meant| meant == name);
        if is_kept { &self.node } else { &self.plain }
    }

    /// Detects the source; its publisher determines type and QoS.
    fn look(&mut self, stage: &TaskContext<'_>) {
        let topics = stage.graph.topics();
        for (from, to) in &self.ways {
            let Some(topic) = topics.iter().find(|topic| topic.name == *from) else { continue };
            let own = [self.node.full_name(), self.plain.full_name()];
            let is_other = |node: &str| !own.contains(&node);
            let Some(source) = topic.publishers.iter().find(|end| is_other(&end.node)) else {
                continue;
            };
            let (name, hash) = (topic.type_name.as_str(), topic.type_hash.as_deref());
            let mailbox = self.meaning(from).raw_mailbox(from, name, hash, source.qos);
            let publisher = self.meaning(to).raw_publisher(to, name, hash, source.qos);
            self.open = mailbox.ok().zip(publisher.ok());
            return;
        }
    }
}

impl Task for Relay {
    fn work(&mut self, stage: &mut TaskContext<'_>) -> Done {
        if self.open.is_none() {
            self.look(stage);
        }
        if let Some((mailbox, publisher)) = &self.open {
            for sample in mailbox.drain() {
                if let Ok(bytes) = sample.cdr() {
                    publisher.publish(bytes.to_vec());
                }
            }
        }
        Done::No
    }
}
