//! `rmf_fleet_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/rmf_fleet_msgs`
//! instead.

crate::message! {
    /// Request to drive to a position.
    "rmf_fleet_msgs/msg/DestinationRequest" "RIHS01_568d7913e870ac8a048d7960dc7c05ce82fd6730c774bbf224ac128ed82c3193"
    DestinationRequest {
        /// fleet_name
        fleet_name: std::string::String,
        /// robot_name
        robot_name: std::string::String,
        /// destination
        destination: Location,
        /// Repeated in the states that follow.
        task_id: std::string::String,
    }
}

crate::message! {
    /// States of all robots of a fleet.
    "rmf_fleet_msgs/msg/FleetState" "RIHS01_9ea5bb9f2c076a587b20c04974581c8d8e2ec7d02300244f9e39e37d7d9192f4"
    FleetState {
        /// name
        name: std::string::String,
        /// robots
        robots: Vec<RobotState>,
    }
}

crate::message! {
    /// Position of a robot on a floor, or a point of a path.
    "rmf_fleet_msgs/msg/Location" "RIHS01_6136f1fc14b896b572c34746c55dbbfd8862e3c561ad5c957ee8b0c116a0e8df"
    Location {
        /// t
        t: crate::builtin_interfaces::Time,
        /// m.
        x: f32,
        /// m.
        y: f32,
        /// rad.
        yaw: f32,
        /// True if the limit below holds.
        obey_approach_speed_limit: bool = false,
        /// On the path to this point; m/s.
        approach_speed_limit: f32,
        /// Floor.
        level_name: std::string::String,
        /// Number of the point in the graph of the traffic lanes.
        index: u64,
    }
}

crate::message! {
    /// Parameter of a mode, such as the name of a dock.
    "rmf_fleet_msgs/msg/ModeParameter" "RIHS01_965e84b959f6ea451ab7d48a06eec49e9ccee97d141a361e641a55b586e02908"
    ModeParameter {
        /// name
        name: std::string::String,
        /// value
        value: std::string::String,
    }
}

crate::message! {
    /// Request to change the mode.
    "rmf_fleet_msgs/msg/ModeRequest" "RIHS01_47b07be607f821c3429e4e8e951cf1cec9fa89a03bc5bf70947cf4c85ea3d00d"
    ModeRequest {
        /// fleet_name
        fleet_name: std::string::String,
        /// robot_name
        robot_name: std::string::String,
        /// mode
        mode: RobotMode,
        /// Repeated in the states that follow.
        task_id: std::string::String,
        /// parameters
        parameters: Vec<ModeParameter>,
    }
}

crate::message! {
    /// Request to drive along a path, whose first point is where the robot is.
    "rmf_fleet_msgs/msg/PathRequest" "RIHS01_1a0615d545f950221bba18a948fa34a63bc55d62e10efe715b5ee04810e6a68b"
    PathRequest {
        /// fleet_name
        fleet_name: std::string::String,
        /// robot_name
        robot_name: std::string::String,
        /// path
        path: Vec<Location>,
        /// Repeated in the states that follow.
        task_id: std::string::String,
    }
}

crate::message! {
    /// Request to stop, or to go on.
    "rmf_fleet_msgs/msg/PauseRequest" "RIHS01_16d0fe233e1175224d28d0e8a35be33f92ea46e85f6a8556f8741c60b38bb815"
    PauseRequest {
        /// fleet_name
        fleet_name: std::string::String,
        /// robot_name
        robot_name: std::string::String,
        /// Number of the request, repeated in the states that follow.
        mode_request_id: u64,
        /// One of the values above.
        r#type: u32,
        /// Index of the point of the path at which it stops.
        at_checkpoint: u32,
    }
    /// TYPE_PAUSE_IMMEDIATELY
    TYPE_PAUSE_IMMEDIATELY: u32 = 0;
    /// TYPE_PAUSE_AT_CHECKPOINT
    TYPE_PAUSE_AT_CHECKPOINT: u32 = 1;
    /// TYPE_RESUME
    TYPE_RESUME: u32 = 2;
}

crate::message! {
    /// Activity of a robot.
    "rmf_fleet_msgs/msg/RobotMode" "RIHS01_9cd4cf773031229f5373fd1b942acf16d140664b79e2463b5e476c1ef6933b2d"
    RobotMode {
        /// One of the values above; 8: the last request is impossible.
        mode: u32,
        /// Number of the request that it follows.
        mode_request_id: u64,
        /// With mode 10.
        performing_action: std::string::String,
    }
    /// MODE_IDLE
    MODE_IDLE: u32 = 0;
    /// MODE_CHARGING
    MODE_CHARGING: u32 = 1;
    /// MODE_MOVING
    MODE_MOVING: u32 = 2;
    /// MODE_PAUSED
    MODE_PAUSED: u32 = 3;
    /// MODE_WAITING
    MODE_WAITING: u32 = 4;
    /// MODE_EMERGENCY
    MODE_EMERGENCY: u32 = 5;
    /// MODE_GOING_HOME
    MODE_GOING_HOME: u32 = 6;
    /// MODE_DOCKING
    MODE_DOCKING: u32 = 7;
    /// MODE_ADAPTER_ERROR
    MODE_ADAPTER_ERROR: u32 = 8;
    /// MODE_CLEANING
    MODE_CLEANING: u32 = 9;
    /// MODE_PERFORMING_ACTION
    MODE_PERFORMING_ACTION: u32 = 10;
    /// MODE_ACTION_COMPLETED
    MODE_ACTION_COMPLETED: u32 = 11;
}

crate::message! {
    /// State of a robot of a fleet.
    "rmf_fleet_msgs/msg/RobotState" "RIHS01_92afab7de71fff5ec992cb0e9809268335c358adefc4a503bf9c3ce075da0c9f"
    RobotState {
        /// name
        name: std::string::String,
        /// model
        model: std::string::String,
        /// That of the last request.
        task_id: std::string::String,
        /// Number of the message.
        seq: u64,
        /// mode
        mode: RobotMode,
        /// battery_percent
        battery_percent: f32,
        /// location
        location: Location,
        /// Points that are not reached yet.
        path: Vec<Location>,
    }
}
