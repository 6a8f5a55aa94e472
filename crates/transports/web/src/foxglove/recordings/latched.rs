//! Topics whose earlier messages stay valid.

use periplus_bags::{BagTopic, Durability};
use periplus_msgs::Message as _;
use periplus_msgs::map_msgs::OccupancyGridUpdate;

/// Maximum number of valid messages of a latched topic: static transforms of many publishers.
const MAX_DEPTH: usize = 1000;

/// Number of messages of topics that are latched although the recording does not contain it.
const STATIC_TRANSFORMS_DEPTH: usize = 1000;

/// Names of topics that are latched in every system, by their last part.
const LATCHED_NAMES: [(&str, usize); 3] =
    [("tf_static", STATIC_TRANSFORMS_DEPTH), ("map", 1), ("robot_description", 1)];

/// Number of messages of a topic that late subscribers get; none if it is not latched.
pub(super) fn latched_depth(topic: &BagTopic) -> Option<usize> {
    let last_part = topic.name.rsplit('/').next().unwrap_or_default();
    let by_name = LATCHED_NAMES.iter().find(|(name, _)| *name == last_part);
    let offered = topic.offered_qos();
    let latched = offered.iter().filter(|qos| qos.durability == Durability::TransientLocal);
    // Each publisher keeps its own; a depth of 0 is unknown.
    let depths = latched.map(|qos| usize::try_from(qos.depth).unwrap_or(MAX_DEPTH).max(1));
    let depth = depths.reduce(usize::saturating_add).max(by_name.map(|(_, depth)| *depth))?;
    // The log is latched for late subscribers, but old lines are not the state of the system.
    let is_log = topic.type_name == "rcl_interfaces/msg/Log";
    (!is_log).then_some(depth.min(MAX_DEPTH))
}

/// Index of the grid to which the updates on a topic belong.
pub(super) fn grid_of_updates(topic: &BagTopic, topics: &[BagTopic]) -> Option<usize> {
    let grid = topic.name.strip_suffix("_updates")?;
    let is_grid =
        |other: &BagTopic| other.name == grid && other.type_name == "nav_msgs/msg/OccupancyGrid";
    let position = topics.iter().position(is_grid);
    position.filter(|_| topic.type_name == OccupancyGridUpdate::TYPE_NAME)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn topic(name: &str, durability: &str, depth: u32) -> BagTopic {
        let qos = format!(
            "- history: keep_last\n  depth: {depth}\n  reliability: reliable\n  durability: {durability}\n"
        );
        BagTopic {
            name: name.into(),
            type_name: "nav_msgs/msg/OccupancyGrid".into(),
            encoding: "cdr".into(),
            schema_encoding: String::new(),
            schema: Vec::new(),
            metadata: [("offered_qos_profiles".to_owned(), qos)].into(),
        }
    }

    #[test]
    fn the_recorded_qos_and_a_few_names_say_what_is_latched() {
        let check = |name, durability, depth, expected| {
            assert_eq!(latched_depth(&topic(name, durability, depth)), expected, "{name}");
        };
        check("/scan", "volatile", 10, None);
        check("/costmap", "transient_local", 3, Some(3));
        check("/costmap", "transient_local", 0, Some(1));
        check("/robot/map", "volatile", 1, Some(1));
        check("/tf_static", "volatile", 1, Some(1000));
        check("/costmap", "transient_local", 1_000_000, Some(1000));
    }

    #[test]
    fn updates_belong_to_the_grid_of_their_name() {
        let grid = topic("/map", "volatile", 1);
        let mut updates = topic("/map_updates", "volatile", 1);
        updates.type_name = OccupancyGridUpdate::TYPE_NAME.into();
        assert_eq!(grid_of_updates(&updates, &[updates.clone(), grid.clone()]), Some(1));
        assert_eq!(grid_of_updates(&updates, &[updates.clone()]), None);
        assert_eq!(grid_of_updates(&grid, std::slice::from_ref(&grid)), None);
    }
}
