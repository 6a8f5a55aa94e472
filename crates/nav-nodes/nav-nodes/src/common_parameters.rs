//! Parameters that every node of ROS 2 may be given.

use periplus_params::{Given, Table};

/// Names, or the beginnings of names, of parameters of every node.
const COMMON: [&str; 5] = [
    "use_sim_time",
    "qos_overrides",
    "diagnostic_updater",
    "start_type_description_service",
    "bond_heartbeat_period",
];

/// Returns true if every node may be given a parameter or group of this name.
pub(crate) fn is_common(name: &str) -> bool {
    COMMON.iter().any(|common| name.starts_with(common))
}

/// Returns true unless a parameter is of every node and not in the table: then it has no effect here, and is no mistake.
pub(crate) fn is_for_table(one: &Given<'_>, table: &Table) -> bool {
    table.find(one.name).is_some() || !is_common(one.name)
}

#[cfg(test)]
mod tests {
    use periplus_motion::tables::VELOCITY_SMOOTHER;

    use super::*;
    use crate::bt_navigator::BT_NAVIGATOR;

    #[test]
    fn a_common_parameter_reaches_the_table_that_lists_it() {
        let time = Given::new("use_sim_time", "true");
        assert!(is_for_table(&time, &VELOCITY_SMOOTHER));
        assert!(!is_for_table(&time, &BT_NAVIGATOR));
        assert!(is_for_table(&Given::new("smothing_frequency", "20"), &VELOCITY_SMOOTHER));
    }
}
