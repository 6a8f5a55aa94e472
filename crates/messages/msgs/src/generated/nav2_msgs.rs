//! `nav2_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/nav2_msgs`
//! instead.

crate::message! {
    /// What changed in a behaviour tree during one tick.
    "nav2_msgs/msg/BehaviorTreeLog" "RIHS01_9335ecb688a4f61b7eb82a7c10f23eea5f4e8bbdb7edfa048e3539aa928f51b7"
    BehaviorTreeLog {
        /// timestamp
        timestamp: crate::builtin_interfaces::Time,
        /// event_log
        event_log: Vec<BehaviorTreeStatusChange>,
    }
}

crate::message! {
    /// A node of a behaviour tree changed its state.
    "nav2_msgs/msg/BehaviorTreeStatusChange" "RIHS01_54c5a8cc559e5eefc90b9c23a9f81c1b326c97c036d10baa556bac3ef07113c6"
    BehaviorTreeStatusChange {
        /// timestamp
        timestamp: crate::builtin_interfaces::Time,
        /// node_name
        node_name: std::string::String,
        /// uid
        uid: u16,
        /// IDLE, RUNNING, SUCCESS or FAILURE.
        previous_status: std::string::String,
        /// IDLE, RUNNING, SUCCESS or FAILURE.
        current_status: std::string::String,
    }
}

crate::message! {
    /// Which polygons of the collision detector have something in them.
    "nav2_msgs/msg/CollisionDetectorState" "RIHS01_f3e8aba67135e9dd5fddd3d9d5c80a47a9798cc69c8f0620696338a120d2f5a5"
    CollisionDetectorState {
        /// polygons
        polygons: Vec<std::string::String>,
        /// detections
        detections: Vec<bool>,
    }
}

crate::message! {
    /// What the collision monitor does, and because of which polygon.
    "nav2_msgs/msg/CollisionMonitorState" "RIHS01_848f43f40716d6b3ac12a698cc3974a7eb2bf00158c5fca7bb93a128850d5a1e"
    CollisionMonitorState {
        /// action_type
        action_type: u8,
        /// polygon_name
        polygon_name: std::string::String,
    }
    /// DO_NOTHING
    DO_NOTHING: u8 = 0;
    /// STOP
    STOP: u8 = 1;
    /// SLOWDOWN
    SLOWDOWN: u8 = 2;
    /// APPROACH
    APPROACH: u8 = 3;
    /// LIMIT
    LIMIT: u8 = 4;
}

crate::message! {
    /// The costs of a costmap, unscaled.
    "nav2_msgs/msg/Costmap" "RIHS01_d51bf7aecafdbb3f8f98215de648abe6d53f8db69156d6e143125d2ad2bf0027"
    Costmap {
        /// header
        header: crate::std_msgs::Header,
        /// metadata
        metadata: CostmapMetaData,
        /// Row by row: 0 free, 253 inscribed, 254 lethal, 255 unknown.
        data: Vec<u8>,
    }
}

crate::message! {
    /// How to read the mask of a costmap filter.
    "nav2_msgs/msg/CostmapFilterInfo" "RIHS01_61ce391bf7690f76a331c01c9d5ce8ca71e6c99273b9fb75e48380f05c6dfdc8"
    CostmapFilterInfo {
        /// header
        header: crate::std_msgs::Header,
        /// 0 keep-out, 1 speed limit in percent, 2 speed limit in m/s, 3 binary.
        r#type: u8,
        /// filter_mask_topic
        filter_mask_topic: std::string::String,
        /// Added to every value of the mask, times the multiplier.
        base: f32,
        /// multiplier
        multiplier: f32,
    }
}

crate::message! {
    /// Size and place of a costmap.
    "nav2_msgs/msg/CostmapMetaData" "RIHS01_1a41ec8428d50c3b4cd3f9055e1adb0eaec72fb39ae11686b59218f6e0884cbd"
    CostmapMetaData {
        /// When its static map was loaded.
        map_load_time: crate::builtin_interfaces::Time,
        /// When it last changed.
        update_time: crate::builtin_interfaces::Time,
        /// Which layer it shows.
        layer: std::string::String,
        /// Side of a cell; m.
        resolution: f32,
        /// Columns.
        size_x: u32,
        /// Rows.
        size_y: u32,
        /// Of the outer corner of the first cell.
        origin: crate::geometry_msgs::Pose,
    }
}

crate::message! {
    /// A rectangle of a costmap that changed.
    "nav2_msgs/msg/CostmapUpdate" "RIHS01_b44706e1f0906a3f72a1640bc2153e85576ff8e8ad203ec48b78c187669168a2"
    CostmapUpdate {
        /// header
        header: crate::std_msgs::Header,
        /// First column.
        x: u32,
        /// First row.
        y: u32,
        /// Columns.
        size_x: u32,
        /// Rows.
        size_y: u32,
        /// Row by row.
        data: Vec<u8>,
    }
}

crate::message! {
    /// A waypoint that was not reached.
    "nav2_msgs/msg/MissedWaypoint" "RIHS01_cc79d1e3a1b86cd6a80788b16c844c396932462560936293011f062c21b82ed1"
    MissedWaypoint {
        /// index
        index: u32,
        /// goal
        goal: crate::geometry_msgs::PoseStamped,
        /// error_code
        error_code: u16,
    }
}

crate::message! {
    /// One guess of where the robot is.
    "nav2_msgs/msg/Particle" "RIHS01_c4c61cd1468c7253cc6cc483ebec0c07d8d7d76e5e6c2bcef15c1c77cf70534c"
    Particle {
        /// pose
        pose: crate::geometry_msgs::Pose,
        /// weight
        weight: f64,
    }
}

crate::message! {
    /// All guesses of where the robot is.
    "nav2_msgs/msg/ParticleCloud" "RIHS01_193d8cb88ca2b98cd81ece15342744f054bb398ebfa8f6369914432303f42b11"
    ParticleCloud {
        /// header
        header: crate::std_msgs::Header,
        /// particles
        particles: Vec<Particle>,
    }
}

crate::message! {
    /// The speed that a robot must not exceed.
    "nav2_msgs/msg/SpeedLimit" "RIHS01_83d8e4e842559f4d9a988b19d31b162216ec738536389f98438d1a166f91845a"
    SpeedLimit {
        /// header
        header: crate::std_msgs::Header,
        /// Whether the limit is in percent of the greatest speed.
        percentage: bool,
        /// Percent or m/s; 0 lifts the limit.
        speed_limit: f64,
    }
}

crate::message! {
    /// The columns of a voxel layer.
    "nav2_msgs/msg/VoxelGrid" "RIHS01_346c2682d6ffd0293e6bc91ae87f60de4a6f7b97cf9339cc4ab4d0d207125a0d"
    VoxelGrid {
        /// header
        header: crate::std_msgs::Header,
        /// One number for each column: upper 16 bits known, lower 16 bits occupied.
        data: Vec<u32>,
        /// m.
        origin: crate::geometry_msgs::Point32,
        /// Sides of a voxel; m.
        resolutions: crate::geometry_msgs::Vector3,
        /// size_x
        size_x: u32,
        /// size_y
        size_y: u32,
        /// size_z
        size_z: u32,
    }
}

crate::message! {
    /// Clears a square about a pose.
    "nav2_msgs/srv/ClearCostmapAroundPose_Request" "RIHS01_9bea29e25c85350413bc5109e26117ff2b76596d73dfedf37290e2d5c7f4ec00"
    ClearCostmapAroundPoseRequest {
        /// Its middle.
        pose: crate::geometry_msgs::PoseStamped,
        /// Side of the square; m.
        reset_distance: f64,
    }
}

crate::message! {
    /// `nav2_msgs/srv/ClearCostmapAroundPose_Response`.
    "nav2_msgs/srv/ClearCostmapAroundPose_Response" "RIHS01_48fb9182164724f0585e5d7a362e0cb9e41834d37b785dea1cee9b0a9b7003de"
    ClearCostmapAroundPoseResponse {
        /// response
        response: crate::std_msgs::Empty,
    }
}

crate::service! {
    /// Clears a square about a pose.
    "nav2_msgs/srv/ClearCostmapAroundPose" "RIHS01_cd006590d0a7b5a357138518c1ac6f733782a0317f5d8fc92f46158e5438138c"
    ClearCostmapAroundPose, ClearCostmapAroundPoseRequest, ClearCostmapAroundPoseResponse
}

crate::message! {
    /// Clears a square about the robot.
    "nav2_msgs/srv/ClearCostmapAroundRobot_Request" "RIHS01_2734faf8fd07b3dc5ece2dc426177d51039a11b2ebbfb03a8696579aa02c9ee8"
    ClearCostmapAroundRobotRequest {
        /// Side of the square; m.
        reset_distance: f32,
    }
}

crate::message! {
    /// `nav2_msgs/srv/ClearCostmapAroundRobot_Response`.
    "nav2_msgs/srv/ClearCostmapAroundRobot_Response" "RIHS01_d5396ec0bd1653042a9437c7f2cb3e093aada3ab8a67327f30ee235833f57897"
    ClearCostmapAroundRobotResponse {
        /// response
        response: crate::std_msgs::Empty,
    }
}

crate::service! {
    /// Clears a square about the robot.
    "nav2_msgs/srv/ClearCostmapAroundRobot" "RIHS01_24973b6e8b3e7ec70c37d6b411f1e32cef44051dfe7f34ad0ee7d6d9055cd6ea"
    ClearCostmapAroundRobot, ClearCostmapAroundRobotRequest, ClearCostmapAroundRobotResponse
}

crate::message! {
    /// Clears all but a square about the robot.
    "nav2_msgs/srv/ClearCostmapExceptRegion_Request" "RIHS01_3d5617401dcf2164725713597bc9eb24f1df8d8a7b0e2c6bb1e5185e64bf66db"
    ClearCostmapExceptRegionRequest {
        /// Side of the square; m.
        reset_distance: f32,
    }
}

crate::message! {
    /// `nav2_msgs/srv/ClearCostmapExceptRegion_Response`.
    "nav2_msgs/srv/ClearCostmapExceptRegion_Response" "RIHS01_afa858c4f3968740aa98507a9141510e5561e970b37cd5380746ae796c1c238d"
    ClearCostmapExceptRegionResponse {
        /// response
        response: crate::std_msgs::Empty,
    }
}

crate::service! {
    /// Clears all but a square about the robot.
    "nav2_msgs/srv/ClearCostmapExceptRegion" "RIHS01_66032323269ef923ab356273a7b7fc1c5acd9ccd46cd14bdcd265642a4012b05"
    ClearCostmapExceptRegion, ClearCostmapExceptRegionRequest, ClearCostmapExceptRegionResponse
}

crate::message! {
    /// Clears a costmap.
    "nav2_msgs/srv/ClearEntireCostmap_Request" "RIHS01_365687a69e15ff9f199447a047ab6fdd264272e6b4d12de0b71bd4a6e4137e99"
    ClearEntireCostmapRequest {
        /// request
        request: crate::std_msgs::Empty,
    }
}

crate::message! {
    /// `nav2_msgs/srv/ClearEntireCostmap_Response`.
    "nav2_msgs/srv/ClearEntireCostmap_Response" "RIHS01_a0aeab7debb4b503bf8d5edcadb896864aa3dda700452d8c9cfa6c4755956665"
    ClearEntireCostmapResponse {
        /// response
        response: crate::std_msgs::Empty,
    }
}

crate::service! {
    /// Clears a costmap.
    "nav2_msgs/srv/ClearEntireCostmap" "RIHS01_553f54f9cadab44553fdf5627433fcb6701f71c1fc2eb55a7b4a004fdeeab952"
    ClearEntireCostmap, ClearEntireCostmapRequest, ClearEntireCostmapResponse
}

crate::message! {
    /// The cost at a place.
    "nav2_msgs/srv/GetCost_Request" "RIHS01_86158e1b6692ed888f2039f5ecc7c914b3484715e1fdc45f4ee7c3b467522293"
    GetCostRequest {
        /// Whether to take the greatest cost below the robot's outline.
        use_footprint: bool,
        /// m.
        x: f32,
        /// m.
        y: f32,
        /// rad.
        theta: f32,
    }
}

crate::message! {
    /// `nav2_msgs/srv/GetCost_Response`.
    "nav2_msgs/srv/GetCost_Response" "RIHS01_3fa6cbc521203b88bf455a704d4d943ec025e2bb0be5cf72df7e4edf40a1f790"
    GetCostResponse {
        /// 0 to 255.
        cost: f32,
    }
}

crate::service! {
    /// The cost at a place.
    "nav2_msgs/srv/GetCost" "RIHS01_be1bfe25180a915c2eb184172eccf9ea00420732e5f2c3f9e6d60754c41f499a"
    GetCost, GetCostRequest, GetCostResponse
}

crate::message! {
    /// The whole costmap.
    "nav2_msgs/srv/GetCostmap_Request" "RIHS01_8dec28d41023635b3a019512467e7685f364e26527cf696c9c9b9e559e1c455b"
    GetCostmapRequest {
        /// specs
        specs: CostmapMetaData,
    }
}

crate::message! {
    /// `nav2_msgs/srv/GetCostmap_Response`.
    "nav2_msgs/srv/GetCostmap_Response" "RIHS01_94dab1729b7a92f0a85542effc41b8acdacbad9d672a86c729d45746dbb6d9e9"
    GetCostmapResponse {
        /// map
        map: Costmap,
    }
}

crate::service! {
    /// The whole costmap.
    "nav2_msgs/srv/GetCostmap" "RIHS01_1c3d7c36488ea60fb6ddf76482faf36cee004e29433fea60b8cee011fcd8ad73"
    GetCostmap, GetCostmapRequest, GetCostmapResponse
}

crate::message! {
    /// The costs at many places, as from Kilted on.
    "nav2_msgs/srv/GetCosts_Request" "RIHS01_ebc7fb72d8164a080b23734eeac6af70ec7a68b22edc4a395a7f9f1e801b1235"
    GetCostsRequest {
        /// Whether to take the greatest cost below the robot's outline.
        use_footprint: bool,
        /// poses
        poses: Vec<crate::geometry_msgs::PoseStamped>,
    }
}

crate::message! {
    /// `nav2_msgs/srv/GetCosts_Response`.
    "nav2_msgs/srv/GetCosts_Response" "RIHS01_b4d443c480924b7a3f71ab0f20721d5306d936416c1554e191e204e14488295a"
    GetCostsResponse {
        /// 0 to 255, or -1 outside of the map.
        costs: Vec<f32>,
        /// success
        success: bool,
    }
}

crate::service! {
    /// The costs at many places, as from Kilted on.
    "nav2_msgs/srv/GetCosts" "RIHS01_b71b396977d0c31ff23dc4fc277980502126e80138eca8ed803a2111afd9c108"
    GetCosts, GetCostsRequest, GetCostsResponse
}

crate::message! {
    /// Whether a path is free of obstacles.
    "nav2_msgs/srv/IsPathValid_Request" "RIHS01_2581491c3b0e2c7caf695a54ae0f7006e420c495abd5b0355d2e79b5b2168888"
    IsPathValidRequest {
        /// path
        path: crate::nav_msgs::Path,
    }
}

crate::message! {
    /// `nav2_msgs/srv/IsPathValid_Response`.
    "nav2_msgs/srv/IsPathValid_Response" "RIHS01_78b00a94704f89bf991a34b153b18c2a80b3ef2138ce89113e13e1de9c2b22c7"
    IsPathValidResponse {
        /// is_valid
        is_valid: bool,
        /// invalid_pose_indices
        invalid_pose_indices: Vec<i32>,
    }
}

crate::service! {
    /// Whether a path is free of obstacles.
    "nav2_msgs/srv/IsPathValid" "RIHS01_0949cf401a29b88bd6e2a8cd8c1df0ccd9374ca4e51557266eaab2b0a9db5778"
    IsPathValid, IsPathValidRequest, IsPathValidResponse
}

crate::message! {
    /// Loads a map from a file.
    "nav2_msgs/srv/LoadMap_Request" "RIHS01_31a494b051e07df8361b6af3c313a550abe7134e158835ce3563e5a126ef3f2b"
    LoadMapRequest {
        /// Path of the map's YAML file, or a URL.
        map_url: std::string::String,
    }
}

crate::message! {
    /// `nav2_msgs/srv/LoadMap_Response`.
    "nav2_msgs/srv/LoadMap_Response" "RIHS01_65d8d760c5a0a14cee1a761372ad99d0b163e6d5400a0c55c20fe8d7e38a05c0"
    LoadMapResponse {
        /// map
        map: crate::nav_msgs::OccupancyGrid,
        /// One of the values above.
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
    "nav2_msgs/srv/LoadMap" "RIHS01_eb875de5ea9bb394573effc3f239015b19869dd7a8988136768372c6ef907ec1"
    LoadMap, LoadMapRequest, LoadMapResponse
}

crate::message! {
    /// Moves all nodes of a lifecycle manager.
    "nav2_msgs/srv/ManageLifecycleNodes_Request" "RIHS01_927841759575a5565b3d879a58fd035a5a69e9fdf3365c02b33cc9ad03a7a227"
    ManageLifecycleNodesRequest {
        /// One of the values above.
        command: u8,
    }
    /// STARTUP
    STARTUP: u8 = 0;
    /// PAUSE
    PAUSE: u8 = 1;
    /// RESUME
    RESUME: u8 = 2;
    /// RESET
    RESET: u8 = 3;
    /// SHUTDOWN
    SHUTDOWN: u8 = 4;
    /// CONFIGURE
    CONFIGURE: u8 = 5;
    /// CLEANUP
    CLEANUP: u8 = 6;
}

crate::message! {
    /// `nav2_msgs/srv/ManageLifecycleNodes_Response`.
    "nav2_msgs/srv/ManageLifecycleNodes_Response" "RIHS01_3ab0ddcbe7307ad89c089d1a8749030929efc63c22ec506faf11440ec2f5c159"
    ManageLifecycleNodesResponse {
        /// success
        success: bool,
    }
}

crate::service! {
    /// Moves all nodes of a lifecycle manager.
    "nav2_msgs/srv/ManageLifecycleNodes" "RIHS01_1850f4f677251bb8f7744e3c0a87ef4f66c205e2f8740a8330251af7d1804460"
    ManageLifecycleNodes, ManageLifecycleNodesRequest, ManageLifecycleNodesResponse
}

crate::message! {
    /// Loads the docks again.
    "nav2_msgs/srv/ReloadDockDatabase_Request" "RIHS01_bb663832b1ffb4deeb0451077ef71a7049d86f0819d21f031c2cb75696a8b75e"
    ReloadDockDatabaseRequest {
        /// filepath
        filepath: std::string::String,
    }
}

crate::message! {
    /// `nav2_msgs/srv/ReloadDockDatabase_Response`.
    "nav2_msgs/srv/ReloadDockDatabase_Response" "RIHS01_cdbc3dcb8f31faefe8b862c6f24dadf763d93d58ccfdacc1b0ee06ac0a6a7310"
    ReloadDockDatabaseResponse {
        /// success
        success: bool,
    }
}

crate::service! {
    /// Loads the docks again.
    "nav2_msgs/srv/ReloadDockDatabase" "RIHS01_3fa9aa056bcc0dfcd10dbd1f61a215f600c82db832dccfdd98e55cf27ad502e6"
    ReloadDockDatabase, ReloadDockDatabaseRequest, ReloadDockDatabaseResponse
}

crate::message! {
    /// Saves a map to a file.
    "nav2_msgs/srv/SaveMap_Request" "RIHS01_fe1a2f779cded53a2557c79c7071c7c5660ecc1b28c376269828a51341f71fe5"
    SaveMapRequest {
        /// Where the map is heard.
        map_topic: std::string::String,
        /// Path of the files without ending.
        map_url: std::string::String,
        /// pgm, png or bmp.
        image_format: std::string::String,
        /// trinary, scale or raw.
        map_mode: std::string::String,
        /// Below: free; 0 to 1.
        free_thresh: f32,
        /// Above: occupied; 0 to 1.
        occupied_thresh: f32,
    }
}

crate::message! {
    /// `nav2_msgs/srv/SaveMap_Response`.
    "nav2_msgs/srv/SaveMap_Response" "RIHS01_bdd0b25c769f096bcde88c98b23ae612c8f70ab770f57014884412ff41fe0f88"
    SaveMapResponse {
        /// result
        result: bool,
    }
}

crate::service! {
    /// Saves a map to a file.
    "nav2_msgs/srv/SaveMap" "RIHS01_fd31bfe2c69b4e15bf86155148940d27d762296b058bda8d450a7f38b6c557e7"
    SaveMap, SaveMapRequest, SaveMapResponse
}

crate::message! {
    /// Tells AMCL where the robot is.
    "nav2_msgs/srv/SetInitialPose_Request" "RIHS01_a1e5b4edfd483c6156bfc7f529da1e60e21b6ca6def1d607b3d0097ccd4c307e"
    SetInitialPoseRequest {
        /// pose
        pose: crate::geometry_msgs::PoseWithCovarianceStamped,
    }
}

crate::message! {
    /// `nav2_msgs/srv/SetInitialPose_Response`.
    "nav2_msgs/srv/SetInitialPose_Response" "RIHS01_f6ef1209a86ec59107b4000c03860ef4c4ba3e60d6be0c66140a3c4373b6203a"
    SetInitialPoseResponse {
    }
}

crate::service! {
    /// Tells AMCL where the robot is.
    "nav2_msgs/srv/SetInitialPose" "RIHS01_1f818551d505d16d89c8bf9b07121a6408de4408b7889dfda9a0db326c296153"
    SetInitialPose, SetInitialPoseRequest, SetInitialPoseResponse
}
