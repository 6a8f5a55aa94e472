//! What a graph has of its own, without what stands in it for others.

use periplus_graph::{Graph, GraphError, Node, NodeSettings, ServiceInfo, TopicInfo};

/// What the name of each node begins with that stands in a graph for others.
const FRONT: &str = "/_wire_";

/// Whether a node stands in a graph for others: of any wire. What one wire brings does not go out by
/// another, or a message would go round between two programs for ever.
#[must_use]
pub fn is_stand_in(node: &str) -> bool {
    node.starts_with(FRONT)
}

/// The node that stands in a graph for all others on a wire. `id` tells wires apart.
///
/// # Errors
/// When the graph has one of this name.
pub fn stand_in(graph: &Graph, id: &[u8]) -> Result<Node, GraphError> {
    let name: String = id.iter().map(|byte| format!("{byte:02x}")).collect();
    graph.node(NodeSettings::new(format!("{}{name}", &FRONT[1..])).bare().keep_names())
}

/// What belongs to a graph itself.
#[derive(Clone, Debug, Default)]
pub struct Own {
    /// Full names of its nodes.
    pub nodes: Vec<String>,
    /// Its topics, with its own ends only; some have none.
    pub topics: Vec<TopicInfo>,
    /// Its services, with its own ends only.
    pub services: Vec<ServiceInfo>,
}

impl Own {
    /// What the graph has now, without what stands in it for others.
    #[must_use]
    pub fn of(graph: &Graph) -> Self {
        let names = graph.nodes().into_iter().map(|node| node.name);
        let nodes = names.filter(|name| !is_stand_in(name)).collect();
        let mut topics = graph.topics();
        for topic in &mut topics {
            topic.publishers.retain(|end| !is_stand_in(&end.node));
            topic.subscriptions.retain(|end| !is_stand_in(&end.node));
        }
        let mut services = graph.services();
        for service in &mut services {
            service.clients.retain(|node| !is_stand_in(node));
            service.server = service.server.take().filter(|node| !is_stand_in(node));
        }
        Self { nodes, topics, services }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use periplus_graph::Qos;

    #[test]
    fn what_stands_for_others_is_not_ones_own() {
        let graph = Graph::new();
        let other = stand_in(&graph, &[0xab, 1]).expect("a name");
        assert_eq!(other.full_name(), "/_wire_ab01");
        let lidar = graph.node(NodeSettings::new("lidar").bare()).expect("a name");
        let (name, of) = ("/scan", "sensor_msgs/msg/LaserScan");
        let _own = lidar.raw_publisher(name, of, None, Qos::reliable(1)).expect("a topic");
        let _theirs = other.raw_publisher(name, of, None, Qos::reliable(1)).expect("a topic");
        let own = Own::of(&graph);
        assert_eq!(own.nodes, ["/lidar"]);
        let topic = own.topics.iter().find(|topic| topic.name == name).expect("the topic");
        assert_eq!(topic.publishers.len(), 1);
        assert_eq!(topic.publishers[0].node, "/lidar");
    }
}
