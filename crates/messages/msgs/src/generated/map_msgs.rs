//! `map_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/map_msgs`
//! instead.

crate::message! {
    /// A rectangle of an occupancy grid that changed.
    "map_msgs/msg/OccupancyGridUpdate" "RIHS01_c4095b0be2e4363f8978a1570e0293ee093436f1e1c61d99b48502ac317025e8"
    OccupancyGridUpdate {
        /// header
        header: crate::std_msgs::Header,
        /// First column; cells.
        x: i32,
        /// First row; cells.
        y: i32,
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
        /// Row by row: 0 free to 100 occupied, -1 unknown.
        data: Vec<i8>,
    }
}

crate::message! {
    /// Points to add to or remove from a cloud.
    "map_msgs/msg/PointCloud2Update" "RIHS01_dc9ec6ad32c09174112325b72bef1b6c76b80abd842de43c66909215e521487c"
    PointCloud2Update {
        /// header
        header: crate::std_msgs::Header,
        /// ADD or DELETE.
        r#type: u32,
        /// points
        points: crate::sensor_msgs::PointCloud2,
    }
    /// ADD
    ADD: u32 = 0;
    /// DELETE
    DELETE: u32 = 1;
}

crate::message! {
    /// A slice of a three-dimensional map, projected onto the ground.
    "map_msgs/msg/ProjectedMap" "RIHS01_97cc11d08fa5ccf35fa540abb50d9c415b8c3c3f1cefe5ac1198aa416749b563"
    ProjectedMap {
        /// map
        map: crate::nav_msgs::OccupancyGrid,
        /// Lowest height of the slice; m.
        min_z: f64,
        /// Greatest height of the slice; m.
        max_z: f64,
    }
}

crate::message! {
    /// Which slice of a three-dimensional map to project.
    "map_msgs/msg/ProjectedMapInfo" "RIHS01_99f95792a7ed7a784566add925ce2ac13e61cdb14e1e6804ca8e3fe0a5baaf13"
    ProjectedMapInfo {
        /// frame_id
        frame_id: std::string::String,
        /// m.
        x: f64,
        /// m.
        y: f64,
        /// m.
        width: f64,
        /// m.
        height: f64,
        /// m.
        min_z: f64,
        /// m.
        max_z: f64,
    }
}

crate::message! {
    /// A rectangle of a map.
    "map_msgs/srv/GetMapROI_Request" "RIHS01_29d1d618abcf6b88af1168e63584fe3419f3ec2c49a48eada9c73a13410e8ca9"
    GetMapROIRequest {
        /// m.
        x: f64,
        /// m.
        y: f64,
        /// Length along x; m.
        l_x: f64,
        /// Length along y; m.
        l_y: f64,
    }
}

crate::message! {
    /// `map_msgs/srv/GetMapROI_Response`.
    "map_msgs/srv/GetMapROI_Response" "RIHS01_62f9199aa9db821390a97c8c8d31947662a231c0a3ed6be5fc0b5f2f6cebb424"
    GetMapROIResponse {
        /// sub_map
        sub_map: crate::nav_msgs::OccupancyGrid,
    }
}

crate::service! {
    /// A rectangle of a map.
    "map_msgs/srv/GetMapROI" "RIHS01_22e41ac30f96dc8d053cccee57fc45f9f43da197ee0c0f056a1ac192419e535f"
    GetMapROI, GetMapROIRequest, GetMapROIResponse
}

crate::message! {
    /// The whole map as points.
    "map_msgs/srv/GetPointMap_Request" "RIHS01_3ad35e3dcc5400d299308682625c1c119e9acfb03f71a1cb0836b981fabcc8a8"
    GetPointMapRequest {
    }
}

crate::message! {
    /// `map_msgs/srv/GetPointMap_Response`.
    "map_msgs/srv/GetPointMap_Response" "RIHS01_b5655e37bb261512e1cc9211116ee33ee6ca5d7001b16d246802fb65e29e49b1"
    GetPointMapResponse {
        /// map
        map: crate::sensor_msgs::PointCloud2,
    }
}

crate::service! {
    /// The whole map as points.
    "map_msgs/srv/GetPointMap" "RIHS01_0328e4cefc6fde45480d52791ce6f0229025cb763e8e291e9781f5c718f27f08"
    GetPointMap, GetPointMapRequest, GetPointMapResponse
}

crate::message! {
    /// The points of a map in a ball or in a box.
    "map_msgs/srv/GetPointMapROI_Request" "RIHS01_b755a5eea90628494df638dbc84ab73704c84f76c584a2c60fdd7eac2862c6bc"
    GetPointMapROIRequest {
        /// m.
        x: f64,
        /// m.
        y: f64,
        /// m.
        z: f64,
        /// Radius of the ball, or 0 for the box; m.
        r: f64,
        /// m.
        l_x: f64,
        /// m.
        l_y: f64,
        /// m.
        l_z: f64,
    }
}

crate::message! {
    /// `map_msgs/srv/GetPointMapROI_Response`.
    "map_msgs/srv/GetPointMapROI_Response" "RIHS01_f63da41174115aad7cdef699372edc966d027d99abc6062ee06a6ee0066e0cff"
    GetPointMapROIResponse {
        /// sub_map
        sub_map: crate::sensor_msgs::PointCloud2,
    }
}

crate::service! {
    /// The points of a map in a ball or in a box.
    "map_msgs/srv/GetPointMapROI" "RIHS01_c854569c8db605132dc382a4c1c33cd8235be5078317c442bf58168e3eb5841c"
    GetPointMapROI, GetPointMapROIRequest, GetPointMapROIResponse
}

crate::message! {
    /// Which slices to project.
    "map_msgs/srv/ProjectedMapsInfo_Request" "RIHS01_deaea19584a3e5d0a5b46c6e195b8c87466050cd4ed776bf8c2b5da803aa1bdc"
    ProjectedMapsInfoRequest {
        /// projected_maps_info
        projected_maps_info: Vec<ProjectedMapInfo>,
    }
}

crate::message! {
    /// `map_msgs/srv/ProjectedMapsInfo_Response`.
    "map_msgs/srv/ProjectedMapsInfo_Response" "RIHS01_f5e4169865543c3b905e05807015b55b7c1cc9109bd428a0e5a7c0b5659eb32e"
    ProjectedMapsInfoResponse {
    }
}

crate::service! {
    /// Which slices to project.
    "map_msgs/srv/ProjectedMapsInfo" "RIHS01_3a44fc9f8314d0b70d757f7f176a914b85132bf5172b142706aaaebd83bb438b"
    ProjectedMapsInfo, ProjectedMapsInfoRequest, ProjectedMapsInfoResponse
}

crate::message! {
    /// Writes the map to a file.
    "map_msgs/srv/SaveMap_Request" "RIHS01_aa613ab7c696191c189febb0b32cdf90a46579296c4eb058b1cbabac6b093b73"
    SaveMapRequest {
        /// filename
        filename: crate::std_msgs::String,
    }
}

crate::message! {
    /// `map_msgs/srv/SaveMap_Response`.
    "map_msgs/srv/SaveMap_Response" "RIHS01_2bf07728df5f47e5f0efffc71c57e01c60de9497c51f6dd41e69ced3e9e95dd1"
    SaveMapResponse {
    }
}

crate::service! {
    /// Writes the map to a file.
    "map_msgs/srv/SaveMap" "RIHS01_d4e7869dcd47387bf6a5a0bba4c6b1baf384ef713fdf419a01e78dc19a2d47c5"
    SaveMap, SaveMapRequest, SaveMapResponse
}

crate::message! {
    /// Asks which slices are projected.
    "map_msgs/srv/SetMapProjections_Request" "RIHS01_0d1947442638c0d7657dad61143cca5d4e86dbaa05a04e831b82bae99a56b15e"
    SetMapProjectionsRequest {
    }
}

crate::message! {
    /// `map_msgs/srv/SetMapProjections_Response`.
    "map_msgs/srv/SetMapProjections_Response" "RIHS01_50d50aa14207960b137a3d7cec578442ad103dc5bc622d5275f3457e2591827a"
    SetMapProjectionsResponse {
        /// projected_maps_info
        projected_maps_info: Vec<ProjectedMapInfo>,
    }
}

crate::service! {
    /// Asks which slices are projected.
    "map_msgs/srv/SetMapProjections" "RIHS01_85bd7e1f80ef0b8790e087cc38c7ebfb31bb472dcb2f9ed84f80ba6910b2b000"
    SetMapProjections, SetMapProjectionsRequest, SetMapProjectionsResponse
}
