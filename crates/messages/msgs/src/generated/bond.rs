//! `bond`. Made by `cargo xtask codegen`; edit the texts in `interfaces/bond`
//! instead.

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
