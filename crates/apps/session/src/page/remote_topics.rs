//! Remote topics of the ROS 2 network, for the page.

use periplus_dds::{Remote, RemoteEndpoint};
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
