//! `robot_localization`. Made by `cargo xtask codegen`; edit the texts in `interfaces/robot_localization`
//! instead.

crate::message! {
    /// Converts a point on the globe to the map.
    "robot_localization/srv/FromLL_Request" "RIHS01_aefc4587e56302ec5641bb38d58f83435fd5d3caed08430dc0f07c5fa446b507"
    FromLLRequest {
        /// ll_point
        ll_point: crate::geographic_msgs::GeoPoint,
    }
}

crate::message! {
    /// `robot_localization/srv/FromLL_Response`.
    "robot_localization/srv/FromLL_Response" "RIHS01_79531b63de18690c401c0c1a03c78a57f9ac99ffd49635db7e52f771512d866e"
    FromLLResponse {
        /// m.
        map_point: crate::geometry_msgs::Point,
    }
}

crate::service! {
    /// Converts a point on the globe to the map.
    "robot_localization/srv/FromLL" "RIHS01_db39e47b5738d4c5ba6c5907d334ada35899262fba4bd415aa06eefb4733840e"
    FromLL, FromLLRequest, FromLLResponse
}

crate::message! {
    /// Converts points on the globe to the map.
    "robot_localization/srv/FromLLArray_Request" "RIHS01_ca4a2a633024fc2751c2658d477a711a4687a7c180eb164887d2f1e3b86cc0b5"
    FromLLArrayRequest {
        /// ll_points
        ll_points: Vec<crate::geographic_msgs::GeoPoint>,
    }
}

crate::message! {
    /// `robot_localization/srv/FromLLArray_Response`.
    "robot_localization/srv/FromLLArray_Response" "RIHS01_0c091be5e170bd3199decfbc606a0d500902ea0ff49d3e169e88e8693380c6d1"
    FromLLArrayResponse {
        /// m.
        map_points: Vec<crate::geometry_msgs::Point>,
    }
}

crate::service! {
    /// Converts points on the globe to the map.
    "robot_localization/srv/FromLLArray" "RIHS01_b69619fe078f3b742eaab5923cc4a789c470c4483b7987f010a0566440c0cca1"
    FromLLArray, FromLLArrayRequest, FromLLArrayResponse
}

crate::message! {
    /// Sets the origin of the map on the globe.
    "robot_localization/srv/SetDatum_Request" "RIHS01_c9e760ea181efb634de6f7f2b2bed262dce15cb72b17f9ac63bc460a30bfd788"
    SetDatumRequest {
        /// geo_pose
        geo_pose: crate::geographic_msgs::GeoPose,
    }
}

crate::message! {
    /// `robot_localization/srv/SetDatum_Response`.
    "robot_localization/srv/SetDatum_Response" "RIHS01_637718396ab01452e72b155e9c6d6cb18230619a2b9deb46358fd78d0f7fa298"
    SetDatumResponse {
    }
}

crate::service! {
    /// Sets the origin of the map on the globe.
    "robot_localization/srv/SetDatum" "RIHS01_dbb26d6fa555491d14d1de3fd0308f10bc139801b80ccb71511425ffc336c573"
    SetDatum, SetDatumRequest, SetDatumResponse
}

crate::message! {
    /// Converts a point of the map to the globe.
    "robot_localization/srv/ToLL_Request" "RIHS01_67007bc444bc9d6210794255dc0679d69dec06970fa345355f4350699e54bb90"
    ToLLRequest {
        /// m.
        map_point: crate::geometry_msgs::Point,
    }
}

crate::message! {
    /// `robot_localization/srv/ToLL_Response`.
    "robot_localization/srv/ToLL_Response" "RIHS01_ebb3fd03c276b661d94edab3b8162329f4c5143d2076db96deceb3f25e8ea51d"
    ToLLResponse {
        /// ll_point
        ll_point: crate::geographic_msgs::GeoPoint,
    }
}

crate::service! {
    /// Converts a point of the map to the globe.
    "robot_localization/srv/ToLL" "RIHS01_ea9806b70e690a6727aa5e360606e4e569d33ae0a8bdf62f66fcbdc8ea1945ce"
    ToLL, ToLLRequest, ToLLResponse
}
