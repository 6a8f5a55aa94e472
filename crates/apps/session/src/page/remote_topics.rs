//! Remote topics of ROS 2 and ROS 1, for the page.

use periplus_dds::{Remote, RemoteEndpoint};
use periplus_graph::Qos;
use periplus_ros1::{SystemState, ros2_type};
use periplus_web::foxglove::{NetworkEndpoint, NetworkEndpoints, NetworkService, NetworkTopic};

/// Converts remote topics; if types differ, the first one counts.
pub(super) fn remote_topics(remote: &Remote) -> NetworkEndpoints {
    let topics = remote.topics.iter().filter_map(|topic| {
        let type_name = topic.type_names.first()?.clone();
        let same = topic.publishers.iter().filter(|end| end.type_name == type_name);
        let publishers: Vec<_> = same.collect();
        let end = |end: &RemoteEndpoint| NetworkEndpoint {
            node: end.node.clone().unwrap_or_else(|| "(no node)".to_owned()),
            qos: end.qos,
        };
        let subscriptions = topic.subscriptions.iter().filter(|end| end.type_name == type_name);
        Some(NetworkTopic {
            name: topic.name.clone(),
            type_hash: publishers.iter().find_map(|end| end.type_hash.clone()),
            publishers: publishers.iter().map(|it| end(it)).collect(),
            subscriptions: subscriptions.map(end).collect(),
            type_name,
        })
    });
    let services = remote.services.iter().filter(|service| !service.servers.is_empty());
    let services = services.filter_map(|service| {
        Some(NetworkService {
            name: service.name.clone(),
            type_name: service.type_names.first()?.clone(),
            servers: service.servers.iter().cloned().collect(),
        })
    });
    NetworkEndpoints { topics: topics.collect(), services: services.collect() }
}

/// Adds the topics that only programs of ROS 1 have. ROS 1 does not state the types of services.
pub(super) fn add_ros1(endpoints: &mut NetworkEndpoints, state: &SystemState) {
    let end = |node: &String| NetworkEndpoint { node: node.clone(), qos: Qos::reliable(0) };
    for (name, publishers) in &state.publishers {
        if endpoints.topics.iter().any(|topic| topic.name == *name) {
            continue;
        }
        let Some(type_name) = state.topic_types.get(name).and_then(|of| ros2_type(of)) else {
            continue;
        };
        let subscribers = state.subscribers.iter().find(|(topic, _)| topic == name);
        endpoints.topics.push(NetworkTopic {
            name: name.clone(),
            type_name,
            type_hash: None,
            publishers: publishers.iter().map(end).collect(),
            subscriptions: subscribers.into_iter().flat_map(|(_, all)| all).map(end).collect(),
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_topic_of_ros_1_is_listed_with_its_type_in_ros_2() {
        let state = SystemState {
            publishers: vec![("/map".to_owned(), vec!["/slam_gmapping".to_owned()])],
            topic_types: [("/map".to_owned(), "nav_msgs/OccupancyGrid".to_owned())].into(),
            ..SystemState::default()
        };
        let mut endpoints = NetworkEndpoints::default();
        add_ros1(&mut endpoints, &state);
        add_ros1(&mut endpoints, &state);
        let [topic] = endpoints.topics.as_slice() else { panic!("{endpoints:?}") };
        assert_eq!(topic.type_name, "nav_msgs/msg/OccupancyGrid");
        assert_eq!(topic.publishers[0].node, "/slam_gmapping");
    }
}
