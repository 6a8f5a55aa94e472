//! Topic names of layers.

use periplus_costmap::Nav2Release;

/// Resolves the topic parameter of a layer of a node in a namespace. On main a relative name is
/// resolved in the parent namespace: `scan` of `/local_costmap` is `/scan`. Before main it is
/// resolved in the namespace of the costmap.
pub(crate) fn resolve(topic: &str, namespace: &str, compat: Nav2Release) -> String {
    if topic.starts_with('/') || topic.starts_with('~') || !compat.joins_parent_namespace() {
        return topic.to_owned();
    }
    let parent = namespace.rfind('/').map_or("", |end| &namespace[..end]);
    format!("{parent}/{topic}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn relative_topics_are_beside_the_costmap_on_main() {
        let resolve = |topic, compat| resolve(topic, "/robot/local_costmap", compat);
        assert_eq!(resolve("scan", Nav2Release::Main), "/robot/scan");
        assert_eq!(resolve("/scan", Nav2Release::Main), "/scan");
        assert_eq!(resolve("scan", Nav2Release::Humble), "scan");
        assert_eq!(super::resolve("scan", "/", Nav2Release::Main), "/scan");
    }
}
