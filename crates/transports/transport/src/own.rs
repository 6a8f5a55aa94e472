//! Endpoints of a graph without those that represent remote programs.

use periplus_graph::{Graph, GraphError, Node, NodeSettings, ServiceInfo, TopicInfo};

/// Prefix of the names of nodes that represent remote programs.
const FRONT: &str = "/_wire_";

/// True if a node represents remote programs, of any transport. Messages from one transport are not
/// forwarded to another one; otherwise they would circulate between two programs.
#[must_use]
pub fn is_stand_in(node: &str) -> bool {
    node.starts_with(FRONT)
}

/// Creates the node that represents all remote programs of a transport. `id` distinguishes
/// transports.
///
/// # Errors
/// When the graph already has a node of this name.
pub fn stand_in(graph: &Graph, id: &[u8]) -> Result<Node, GraphError> {
    let name: String = id.iter().map(|byte| format!("{byte:02x}")).collect();
    graph.node(NodeSettings::new(format!("{}{name}", &FRONT[1..])).bare().keep_names())
}

/// Endpoints of a graph itself.
#[derive(Clone, Debug, Default)]
pub struct Own {
    /// Full names of its nodes.
    pub nodes: Vec<String>,
    /// Topics with local endpoints only; some have none.
    pub topics: Vec<TopicInfo>,
    /// Services with local endpoints only.
    pub services: Vec<ServiceInfo>,
}

impl Own {
    /// Returns the current endpoints of a graph, without those that represent remote programs.
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
