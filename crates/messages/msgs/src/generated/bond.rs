//! `bond`. Made by `cargo xtask codegen`; edit the texts in `interfaces/bond`
//! instead.

crate::message! {
    /// Times of a bond in seconds, and the name of the parameter that turns its timeout off.
    "bond/msg/Constants" "RIHS01_347874ac7a49af69eb313fc911d72cd59152a5a157b6577cafad31ad43a8d63e"
    Constants {
    }
    /// DEAD_PUBLISH_PERIOD
    DEAD_PUBLISH_PERIOD: f32 = 0.05;
    /// DEFAULT_CONNECT_TIMEOUT
    DEFAULT_CONNECT_TIMEOUT: f32 = 10.0;
    /// DEFAULT_HEARTBEAT_TIMEOUT
    DEFAULT_HEARTBEAT_TIMEOUT: f32 = 4.0;
    /// DEFAULT_DISCONNECT_TIMEOUT
    DEFAULT_DISCONNECT_TIMEOUT: f32 = 2.0;
    /// DEFAULT_HEARTBEAT_PERIOD
    DEFAULT_HEARTBEAT_PERIOD: f32 = 1.0;
    /// DISABLE_HEARTBEAT_TIMEOUT_PARAM
    DISABLE_HEARTBEAT_TIMEOUT_PARAM: &str = "/bond_disable_heartbeat_timeout";
}

crate::message! {
    /// A heartbeat of one end of a bond.
    "bond/msg/Status" "RIHS01_87eaccffa254ffffadc0b61600452e8251740f06c25659a2dbda4927fdb1f70a"
    Status {
        /// header
        header: crate::std_msgs::Header,
        /// Of the bond; both ends have the same.
        id: std::string::String,
        /// Of this end; no other end has it.
        instance_id: std::string::String,
        /// False when this end breaks the bond.
        active: bool,
        /// s; without a heartbeat for so long the bond is broken.
        heartbeat_timeout: f32,
        /// s between heartbeats.
        heartbeat_period: f32,
    }
}
