//! `nav_2d_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/nav_2d_msgs`
//! instead.

crate::message! {
    /// Path in the plane.
    "nav_2d_msgs/msg/Path2D" "RIHS01_fbf42efc1feafb28b0bed42bafccce7bd410bd10a7354d298f36e10f9c34a7cf"
    Path2D {
        /// header
        header: crate::std_msgs::Header,
        /// poses
        poses: Vec<crate::geometry_msgs::Pose2D>,
    }
}

crate::message! {
    /// Pose in the plane, single precision.
    "nav_2d_msgs/msg/Pose2D32" "RIHS01_83e76addcccb7a3ad7801fe067252e38a90d54f540ad4474a96d5bacd569fdf3"
    Pose2D32 {
        /// x
        x: f32,
        /// y
        y: f32,
        /// rad, anticlockwise.
        theta: f32,
    }
}

crate::message! {
    /// Pose in the plane at a time.
    "nav_2d_msgs/msg/Pose2DStamped" "RIHS01_06b749e5c48aa634428962247eeff9de8d8393b2183dafa96742174871bbb32e"
    Pose2DStamped {
        /// header
        header: crate::std_msgs::Header,
        /// pose
        pose: crate::geometry_msgs::Pose2D,
    }
}

crate::message! {
    /// Velocity in the plane.
    "nav_2d_msgs/msg/Twist2D" "RIHS01_33a3a47d7b3aaad5376a48250597093feb4b92ab8706c96dca69f47d9a9807d0"
    Twist2D {
        /// x
        x: f64,
        /// y
        y: f64,
        /// rad, anticlockwise.
        theta: f64,
    }
}

crate::message! {
    /// Velocity in the plane, single precision.
    "nav_2d_msgs/msg/Twist2D32" "RIHS01_0127ccf52893e468fc73541e6ed2cc2f9f98920bac988a2735a45b8fa753dc64"
    Twist2D32 {
        /// x
        x: f32,
        /// y
        y: f32,
        /// rad, anticlockwise.
        theta: f32,
    }
}

crate::message! {
    /// Velocity in the plane at a time.
    "nav_2d_msgs/msg/Twist2DStamped" "RIHS01_51c3493e1af4e3b90ed78024c9dc2b1555497ea7a45dc9264a78690cce7d5380"
    Twist2DStamped {
        /// header
        header: crate::std_msgs::Header,
        /// velocity
        velocity: Twist2D,
    }
}
