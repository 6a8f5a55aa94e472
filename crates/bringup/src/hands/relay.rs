//! Passes on what comes on one topic under another name.

use periplus_graph::{Node, RawMailbox, RawPublisher};

use super::{Done, Hand, Stage};

/// Two names of which one is to say what the other says.
pub(crate) struct Relay {
    node: Node,
    /// Full names that may be the source, the likelier first, each with the other end.
    ways: Vec<(String, String)>,
    open: Option<(RawMailbox, RawPublisher)>,
}

impl Relay {
    /// From one name to another; the first of these ways on which somebody publishes is taken.
    pub(crate) fn new(node: Node, ways: Vec<(String, String)>) -> Self {
        Self { node, ways, open: None }
    }

    /// Finds out what there is to pass on: who publishes says of which type it is and how it is kept.
    fn look(&mut self, stage: &Stage<'_>) {
        let topics = stage.graph.topics();
        for (from, to) in &self.ways {
            let Some(topic) = topics.iter().find(|topic| topic.name == *from) else { continue };
            let own = self.node.full_name();
            let Some(source) = topic.publishers.iter().find(|end| end.node != own) else {
                continue;
            };
            let (name, hash) = (topic.type_name.as_str(), topic.type_hash.as_deref());
            let mailbox = self.node.raw_mailbox(from, name, hash, source.qos);
            let publisher = self.node.raw_publisher(to, name, hash, source.qos);
            self.open = mailbox.ok().zip(publisher.ok());
            return;
        }
    }
}

impl Hand for Relay {
    fn work(&mut self, stage: &mut Stage<'_>) -> Done {
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
