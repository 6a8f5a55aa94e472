//! `radar_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/radar_msgs`
//! instead.

crate::message! {
    /// One reflection.
    "radar_msgs/msg/RadarReturn" "RIHS01_d2faa185f22c2cf578cf2dfd69e05ce6262d1a716f2fd3ea219e9db31e1ed2f0"
    RadarReturn {
        /// Distance; m.
        range: f32,
        /// Angle to the left; rad.
        azimuth: f32,
        /// Angle upwards; rad.
        elevation: f32,
        /// Speed away from the sensor; m/s.
        doppler_velocity: f32,
        /// Strength; dB.
        amplitude: f32,
    }
}

crate::message! {
    /// All reflections of one scan.
    "radar_msgs/msg/RadarScan" "RIHS01_9d270e9c9d9e2509e93e7c688fd8a813d75e43a6a37ef982e63e24e80e535cdc"
    RadarScan {
        /// header
        header: crate::std_msgs::Header,
        /// returns
        returns: Vec<RadarReturn>,
    }
}

crate::message! {
    /// An object that a radar follows.
    "radar_msgs/msg/RadarTrack" "RIHS01_d86db60d39b58cd7422505ca7aa1609ada6d9701c3648f499ff0dc2a96801043"
    RadarTrack {
        /// Stays the same while the object is followed.
        uuid: crate::unique_identifier_msgs::UUID,
        /// m.
        position: crate::geometry_msgs::Point,
        /// m/s.
        velocity: crate::geometry_msgs::Vector3,
        /// m/s2.
        acceleration: crate::geometry_msgs::Vector3,
        /// Of the box around it; m.
        size: crate::geometry_msgs::Vector3,
        /// One of the values above, or one of the driver's own.
        classification: u16,
        /// Upper triangle; m2.
        position_covariance: [f32; 6],
        /// Upper triangle.
        velocity_covariance: [f32; 6],
        /// Upper triangle.
        acceleration_covariance: [f32; 6],
        /// Upper triangle.
        size_covariance: [f32; 6],
    }
    /// NO_CLASSIFICATION
    NO_CLASSIFICATION: u16 = 0;
    /// STATIC
    STATIC: u16 = 1;
    /// DYNAMIC
    DYNAMIC: u16 = 2;
}

crate::message! {
    /// All objects that a radar follows.
    "radar_msgs/msg/RadarTracks" "RIHS01_3bd7d07e46d13682e4d9fa9fdb2c5f4ed9b1c4ebb08a34b31dbfc2c3ff601889"
    RadarTracks {
        /// header
        header: crate::std_msgs::Header,
        /// tracks
        tracks: Vec<RadarTrack>,
    }
}
