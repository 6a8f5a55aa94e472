//! `nav_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/nav_msgs`
//! instead.

crate::message! {
    /// Places to go to, in order.
    "nav_msgs/msg/Goals" "RIHS01_02305a51633b5c04d8979b878a7577cafd422f8a07465c878b17a920af3759e9"
    Goals {
        /// header
        header: crate::std_msgs::Header,
        /// goals
        goals: Vec<crate::geometry_msgs::PoseStamped>,
    }
}

crate::message! {
    /// Some cells of a grid.
    "nav_msgs/msg/GridCells" "RIHS01_bb99c2f5d0a04750745a81ec6a8147aa373cce5bd17c8cd6507f2413354a6933"
    GridCells {
        /// header
        header: crate::std_msgs::Header,
        /// m.
        cell_width: f32,
        /// m.
        cell_height: f32,
        /// Their centres; m.
        cells: Vec<crate::geometry_msgs::Point>,
    }
}

crate::message! {
    /// Size and place of a map.
    "nav_msgs/msg/MapMetaData" "RIHS01_2772d4b2000ef2b35dbaeb80fd3946c1369f817fb4f75677d916d27c17d763c8"
    MapMetaData {
        /// map_load_time
        map_load_time: crate::builtin_interfaces::Time,
        /// Side of a cell; m.
        resolution: f32,
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
        /// Pose of the outer corner of the first cell.
        origin: crate::geometry_msgs::Pose,
    }
}

crate::message! {
    /// A map of what is free and what is not.
    "nav_msgs/msg/OccupancyGrid" "RIHS01_8d348150c12913a31ee0ec170fbf25089e4745d17035792a1ba94d6f0bc0cfc7"
    OccupancyGrid {
        /// header
        header: crate::std_msgs::Header,
        /// info
        info: MapMetaData,
        /// Row by row from the origin: 0 free to 100 occupied, -1 unknown.
        data: Vec<i8>,
    }
}

crate::message! {
    /// Where a robot thinks it has moved to, and how fast it moves.
    "nav_msgs/msg/Odometry" "RIHS01_3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0"
    Odometry {
        /// Time, and the frame of the pose.
        header: crate::std_msgs::Header,
        /// The frame that moves, and that of the twist.
        child_frame_id: std::string::String,
        /// pose
        pose: crate::geometry_msgs::PoseWithCovariance,
        /// twist
        twist: crate::geometry_msgs::TwistWithCovariance,
    }
}

crate::message! {
    /// A way to go.
    "nav_msgs/msg/Path" "RIHS01_1957a5bb3cee5da65c4e52e52b65a93df227efce4c20f8458b36e73066ca334b"
    Path {
        /// header
        header: crate::std_msgs::Header,
        /// poses
        poses: Vec<crate::geometry_msgs::PoseStamped>,
    }
}

crate::message! {
    /// Asks for the map.
    "nav_msgs/srv/GetMap_Request" "RIHS01_b531e302f1bd6a81f8a5e03453266c378b1f711b4296000c1c0f53a40e00a7c4"
    GetMapRequest {
    }
}

crate::message! {
    /// `nav_msgs/srv/GetMap_Response`.
    "nav_msgs/srv/GetMap_Response" "RIHS01_45246f7a2ff0cbfa46e13865d4b95929ebb6d2846d1b85a20ad51030f4690dc2"
    GetMapResponse {
        /// map
        map: OccupancyGrid,
    }
}

crate::service! {
    /// Asks for the map.
    "nav_msgs/srv/GetMap" "RIHS01_c8ae77c9995b3554b5ba80e4d4d443f970ac65143102a1d893ec24fc07b31147"
    GetMap, GetMapRequest, GetMapResponse
}

crate::message! {
    /// Asks for a way.
    "nav_msgs/srv/GetPlan_Request" "RIHS01_f1bb9fab287948b4432a4a7e4f529e7ea6269cd06269ee8fcb911fdb4acd23c3"
    GetPlanRequest {
        /// start
        start: crate::geometry_msgs::PoseStamped,
        /// goal
        goal: crate::geometry_msgs::PoseStamped,
        /// How far from the goal the way may end; m.
        tolerance: f32,
    }
}

crate::message! {
    /// `nav_msgs/srv/GetPlan_Response`.
    "nav_msgs/srv/GetPlan_Response" "RIHS01_30a947cd360777929073296c368c591dc2117a89c15b7a975a6faa0a901836fd"
    GetPlanResponse {
        /// plan
        plan: Path,
    }
}

crate::service! {
    /// Asks for a way.
    "nav_msgs/srv/GetPlan" "RIHS01_234f7aff100f5edb8150366601687b027bcdc253db47decb88fff846193fe5e8"
    GetPlan, GetPlanRequest, GetPlanResponse
}

crate::message! {
    /// Loads a map from a file.
    "nav_msgs/srv/LoadMap_Request" "RIHS01_0f8fe3aac433c977d7c2f8b57ab1c3a17677e24880d76919b69e4208e99f5132"
    LoadMapRequest {
        /// map_url
        map_url: std::string::String,
    }
}

crate::message! {
    /// `nav_msgs/srv/LoadMap_Response`.
    "nav_msgs/srv/LoadMap_Response" "RIHS01_e7970ddf9f58e10d34b5eae6d2baca31b2b3e2f2fe6d082b3aae2a5f92777b2a"
    LoadMapResponse {
        /// map
        map: OccupancyGrid,
        /// result
        result: u8,
    }
    /// RESULT_SUCCESS
    RESULT_SUCCESS: u8 = 0;
    /// RESULT_MAP_DOES_NOT_EXIST
    RESULT_MAP_DOES_NOT_EXIST: u8 = 1;
    /// RESULT_INVALID_MAP_DATA
    RESULT_INVALID_MAP_DATA: u8 = 2;
    /// RESULT_INVALID_MAP_METADATA
    RESULT_INVALID_MAP_METADATA: u8 = 3;
    /// RESULT_UNDEFINED_FAILURE
    RESULT_UNDEFINED_FAILURE: u8 = 255;
}

crate::service! {
    /// Loads a map from a file.
    "nav_msgs/srv/LoadMap" "RIHS01_1a192ac56c40fed2767dac26f0b371785372276bd465c902676d2dca135aae5a"
    LoadMap, LoadMapRequest, LoadMapResponse
}

crate::message! {
    /// Gives a new map and where the robot is in it.
    "nav_msgs/srv/SetMap_Request" "RIHS01_5a83a0c20af4d79248fc3287524bf358b603fb5a05818b5ec85b50fa6e5d0266"
    SetMapRequest {
        /// map
        map: OccupancyGrid,
        /// initial_pose
        initial_pose: crate::geometry_msgs::PoseWithCovarianceStamped,
    }
}

crate::message! {
    /// `nav_msgs/srv/SetMap_Response`.
    "nav_msgs/srv/SetMap_Response" "RIHS01_e7251879322c7b12285b9c191d68d27495b6dede051f3cd79b0bf334147b7375"
    SetMapResponse {
        /// success
        success: bool,
    }
}

crate::service! {
    /// Gives a new map and where the robot is in it.
    "nav_msgs/srv/SetMap" "RIHS01_5e11a5b2ca53d8ae85b666a019f16c9904ebc787828f1f566c4e048a1ddedfb4"
    SetMap, SetMapRequest, SetMapResponse
}
