//! `nav2_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces_nav2_main/nav2_msgs`
//! instead.

crate::message! {
    /// Clears a square about a pose.
    "nav2_msgs/srv/ClearCostmapAroundPose_Request" "RIHS01_8f1608d4367d30fad666f594e02740b32b2cb41175b732a4d948c5498cfc7fa7"
    ClearCostmapAroundPoseRequest {
        /// Its middle.
        pose: crate::geometry_msgs::PoseStamped,
        /// Side of the square; m.
        reset_distance: f64,
        /// Of these layers; of all that may be cleared if there is none.
        plugins: Vec<std::string::String>,
    }
}

crate::message! {
    /// `nav2_msgs/srv/ClearCostmapAroundPose_Response`.
    "nav2_msgs/srv/ClearCostmapAroundPose_Response" "RIHS01_93297a0135cf02c6e53b44572bedd560a326af74beb0e8756ef579deb433ff4b"
    ClearCostmapAroundPoseResponse {
        /// Whether it was done; if a name does not fit, nothing is.
        success: bool,
    }
}

crate::service! {
    /// Clears a square about a pose.
    "nav2_msgs/srv/ClearCostmapAroundPose" "RIHS01_3b092cbcc5d25708adc0db6f29bc9e5f6cb76c47a774ee097bf05a87f649fa37"
    ClearCostmapAroundPose, ClearCostmapAroundPoseRequest, ClearCostmapAroundPoseResponse
}

crate::message! {
    /// Clears a square about the robot.
    "nav2_msgs/srv/ClearCostmapAroundRobot_Request" "RIHS01_55e6b76115fd11b6fb8b12bac59e3b2293520461481f8ecdb55b7b3e7bfe18f0"
    ClearCostmapAroundRobotRequest {
        /// Side of the square; m.
        reset_distance: f32,
        /// Of these layers; of all that may be cleared if there is none.
        plugins: Vec<std::string::String>,
    }
}

crate::message! {
    /// `nav2_msgs/srv/ClearCostmapAroundRobot_Response`.
    "nav2_msgs/srv/ClearCostmapAroundRobot_Response" "RIHS01_81dca16a2b326650a3c70bc6a86b2d5ae4977a03472b0fae6e64b2f9b13d2c14"
    ClearCostmapAroundRobotResponse {
        /// Whether it was done; if a name does not fit, nothing is.
        success: bool,
    }
}

crate::service! {
    /// Clears a square about the robot.
    "nav2_msgs/srv/ClearCostmapAroundRobot" "RIHS01_44d2b7c7521a1d317d1008344d470413a604cb0f1d162cba80480490b5ce26a4"
    ClearCostmapAroundRobot, ClearCostmapAroundRobotRequest, ClearCostmapAroundRobotResponse
}

crate::message! {
    /// Clears all but a square about the robot.
    "nav2_msgs/srv/ClearCostmapExceptRegion_Request" "RIHS01_c2425e47f27b066291649a2a713f24eb58b970b6285181f1321700906513e0e1"
    ClearCostmapExceptRegionRequest {
        /// Side of the square; m.
        reset_distance: f32,
        /// Of these layers; of all that may be cleared if there is none.
        plugins: Vec<std::string::String>,
    }
}

crate::message! {
    /// `nav2_msgs/srv/ClearCostmapExceptRegion_Response`.
    "nav2_msgs/srv/ClearCostmapExceptRegion_Response" "RIHS01_7897989c8ec51534295d76ec315fe51cf7b8f07d1e743003b2c0e83ffd130601"
    ClearCostmapExceptRegionResponse {
        /// Whether it was done; if a name does not fit, nothing is.
        success: bool,
    }
}

crate::service! {
    /// Clears all but a square about the robot.
    "nav2_msgs/srv/ClearCostmapExceptRegion" "RIHS01_07ca78b82d39cf741a39c1f5dd1a679f415ccd4ec2ba054751e48a0d633adae8"
    ClearCostmapExceptRegion, ClearCostmapExceptRegionRequest, ClearCostmapExceptRegionResponse
}

crate::message! {
    /// Clears a costmap.
    "nav2_msgs/srv/ClearEntireCostmap_Request" "RIHS01_0c8f2f01895b3066de192dbc7683ea8f6a4d57be83cdc699d6d99f05fe95f6ff"
    ClearEntireCostmapRequest {
        /// request
        request: crate::std_msgs::Empty,
        /// Only these layers; everything if there is none.
        plugins: Vec<std::string::String>,
    }
}

crate::message! {
    /// `nav2_msgs/srv/ClearEntireCostmap_Response`.
    "nav2_msgs/srv/ClearEntireCostmap_Response" "RIHS01_abb68db9ff372188bf455ede0066044afb9f1827364e9f8e8ca6496253e84b55"
    ClearEntireCostmapResponse {
        /// Whether it was done; if a name does not fit, nothing is.
        success: bool,
    }
}

crate::service! {
    /// Clears a costmap.
    "nav2_msgs/srv/ClearEntireCostmap" "RIHS01_5d15e320a576ad12ee8332ad993588bc450a70311e6be013f43223f1edd42a3f"
    ClearEntireCostmap, ClearEntireCostmapRequest, ClearEntireCostmapResponse
}
