//! `rmf_lift_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/rmf_lift_msgs`
//! instead.

crate::message! {
    /// Request to a lift.
    "rmf_lift_msgs/msg/LiftRequest" "RIHS01_e8f1e0aa4d172703d0d7840c1876448c6c5d75ab58955faf7de7dddc17c096ac"
    LiftRequest {
        /// lift_name
        lift_name: std::string::String,
        /// request_time
        request_time: crate::builtin_interfaces::Time,
        /// Name of the sender, who keeps the lift until the session ends.
        session_id: std::string::String,
        /// One of the values above.
        request_type: u8,
        /// One of the floors of the state.
        destination_floor: std::string::String,
        /// Doors at the destination.
        door_state: u8,
    }
    /// REQUEST_END_SESSION
    REQUEST_END_SESSION: u8 = 0;
    /// REQUEST_AGV_MODE
    REQUEST_AGV_MODE: u8 = 1;
    /// REQUEST_HUMAN_MODE
    REQUEST_HUMAN_MODE: u8 = 2;
    /// DOOR_CLOSED
    DOOR_CLOSED: u8 = 0;
    /// DOOR_OPEN
    DOOR_OPEN: u8 = 2;
}

crate::message! {
    /// State of a lift at a time.
    "rmf_lift_msgs/msg/LiftState" "RIHS01_ce0553cd08eeeb321bdae554efdb6d2ebb2be9755df2e34895cbef55b51f4c06"
    LiftState {
        /// lift_time
        lift_time: crate::builtin_interfaces::Time,
        /// lift_name
        lift_name: std::string::String,
        /// available_floors
        available_floors: Vec<std::string::String>,
        /// The nearest one.
        current_floor: std::string::String,
        /// destination_floor
        destination_floor: std::string::String,
        /// door_state
        door_state: u8,
        /// motion_state
        motion_state: u8,
        /// available_modes
        available_modes: Vec<u8>,
        /// current_mode
        current_mode: u8,
        /// Sender that has the lift; empty if it is free.
        session_id: std::string::String,
    }
    /// DOOR_CLOSED
    DOOR_CLOSED: u8 = 0;
    /// DOOR_MOVING
    DOOR_MOVING: u8 = 1;
    /// DOOR_OPEN
    DOOR_OPEN: u8 = 2;
    /// MOTION_STOPPED
    MOTION_STOPPED: u8 = 0;
    /// MOTION_UP
    MOTION_UP: u8 = 1;
    /// MOTION_DOWN
    MOTION_DOWN: u8 = 2;
    /// MOTION_UNKNOWN
    MOTION_UNKNOWN: u8 = 3;
    /// MODE_UNKNOWN
    MODE_UNKNOWN: u8 = 0;
    /// MODE_HUMAN
    MODE_HUMAN: u8 = 1;
    /// MODE_AGV
    MODE_AGV: u8 = 2;
    /// MODE_FIRE
    MODE_FIRE: u8 = 3;
    /// MODE_OFFLINE
    MODE_OFFLINE: u8 = 4;
    /// MODE_EMERGENCY
    MODE_EMERGENCY: u8 = 5;
}
