//! `rmf_door_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/rmf_door_msgs`
//! instead.

crate::message! {
    /// State of a door.
    "rmf_door_msgs/msg/DoorMode" "RIHS01_02c834bb83aa3ca1fbd8cf4f61a1d1ae4dc8227111bde3820dda580f8c2c6429"
    DoorMode {
        /// One of the values above.
        value: u32,
    }
    /// MODE_CLOSED
    MODE_CLOSED: u32 = 0;
    /// MODE_MOVING
    MODE_MOVING: u32 = 1;
    /// MODE_OPEN
    MODE_OPEN: u32 = 2;
    /// MODE_OFFLINE
    MODE_OFFLINE: u32 = 3;
    /// MODE_UNKNOWN
    MODE_UNKNOWN: u32 = 4;
}

crate::message! {
    /// Request to open or close a door.
    "rmf_door_msgs/msg/DoorRequest" "RIHS01_3145b5d97064f89b0a0db953b8167ddeeefbc2914c24a603c3bdc51f122f143e"
    DoorRequest {
        /// request_time
        request_time: crate::builtin_interfaces::Time,
        /// Name of the sender.
        requester_id: std::string::String,
        /// door_name
        door_name: std::string::String,
        /// Open or closed.
        requested_mode: DoorMode,
    }
}

crate::message! {
    /// State of a door at a time.
    "rmf_door_msgs/msg/DoorState" "RIHS01_1cb9d98f19c66cbc1f9acb16faaa90c63a7b65021bd26c69958d96f0a0388bb2"
    DoorState {
        /// door_time
        door_time: crate::builtin_interfaces::Time,
        /// door_name
        door_name: std::string::String,
        /// current_mode
        current_mode: DoorMode,
    }
}
