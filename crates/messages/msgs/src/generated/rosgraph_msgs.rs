//! `rosgraph_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/rosgraph_msgs`
//! instead.

crate::message! {
    /// The time of a simulation.
    "rosgraph_msgs/msg/Clock" "RIHS01_692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564"
    Clock {
        /// clock
        clock: crate::builtin_interfaces::Time,
    }
}
