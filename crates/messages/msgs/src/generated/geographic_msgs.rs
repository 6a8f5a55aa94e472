//! `geographic_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/geographic_msgs`
//! instead.

crate::message! {
    /// Point on the globe, WGS 84.
    "geographic_msgs/msg/GeoPoint" "RIHS01_602c647cf87bbe95a0231b459b5ac30051875d07c0c740b31ad7a8c4662b971e"
    GeoPoint {
        /// deg, positive to the north.
        latitude: f64,
        /// deg, positive to the east.
        longitude: f64,
        /// m above the ellipsoid; NaN if unknown.
        altitude: f64,
    }
}

crate::message! {
    /// Point on the globe at a time.
    "geographic_msgs/msg/GeoPointStamped" "RIHS01_ebe562b30db6fadf7b136d11c0c5bcccf393d24fa48874346bed64e58b6dedcf"
    GeoPointStamped {
        /// header
        header: crate::std_msgs::Header,
        /// position
        position: GeoPoint,
    }
}

crate::message! {
    /// Pose on the globe; x points to the east.
    "geographic_msgs/msg/GeoPose" "RIHS01_8052786d7663e225e38926f7d05716046c931572c25e557d4f70dca55b972626"
    GeoPose {
        /// position
        position: GeoPoint,
        /// orientation
        orientation: crate::geometry_msgs::Quaternion,
    }
}

crate::message! {
    /// Pose on the globe at a time.
    "geographic_msgs/msg/GeoPoseStamped" "RIHS01_a8e603c050fa992a74283bb462a96fe9d2b151b7a67b14d77250ed7cb4ed96b7"
    GeoPoseStamped {
        /// header
        header: crate::std_msgs::Header,
        /// pose
        pose: GeoPose,
    }
}
