//! `geometry_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/geometry_msgs`
//! instead.

crate::message! {
    /// Acceleration along and about the axes.
    "geometry_msgs/msg/Accel" "RIHS01_dc448243ded9b1fcbcca24aba0c22f013dae06c354ba2d849571c0a2a3f57ca0"
    Accel {
        /// m/s2.
        linear: Vector3,
        /// rad/s2.
        angular: Vector3,
    }
}

crate::message! {
    /// Accel with a time and a frame.
    "geometry_msgs/msg/AccelStamped" "RIHS01_ef1df9eabae0a708cc049a061ebcddc4e2a5f745730100ba680e086a9698b165"
    AccelStamped {
        /// header
        header: crate::std_msgs::Header,
        /// accel
        accel: Accel,
    }
}

crate::message! {
    /// An acceleration and how sure it is.
    "geometry_msgs/msg/AccelWithCovariance" "RIHS01_230d51bd53bc36f260574e73b42941cefe44684753480b6fc330c032c5db5997"
    AccelWithCovariance {
        /// accel
        accel: Accel,
        /// Row by row; x, y, z, then about x, y, z.
        covariance: [f64; 36],
    }
}

crate::message! {
    /// AccelWithCovariance with a time and a frame.
    "geometry_msgs/msg/AccelWithCovarianceStamped" "RIHS01_61c9ad8928e71dd95ce791b2f02809ee2a0bbcc42cd0e4047fd00a822a08e444"
    AccelWithCovarianceStamped {
        /// header
        header: crate::std_msgs::Header,
        /// accel
        accel: AccelWithCovariance,
    }
}

crate::message! {
    /// Mass and how it is spread.
    "geometry_msgs/msg/Inertia" "RIHS01_2ddd5dab5c347825ba2e56c895ddccfd0b8efe53ae931bf67f905529930b4bd7"
    Inertia {
        /// kg.
        m: f64,
        /// Centre of mass; m.
        com: Vector3,
        /// kg m2, about the centre of mass; so the other five.
        ixx: f64,
        /// ixy
        ixy: f64,
        /// ixz
        ixz: f64,
        /// iyy
        iyy: f64,
        /// iyz
        iyz: f64,
        /// izz
        izz: f64,
    }
}

crate::message! {
    /// Inertia with a time and a frame.
    "geometry_msgs/msg/InertiaStamped" "RIHS01_766be45976252babf7f9d8ac4ae7c912a7ceccf71035622529f27518b695aa09"
    InertiaStamped {
        /// header
        header: crate::std_msgs::Header,
        /// inertia
        inertia: Inertia,
    }
}

crate::message! {
    /// A place in space.
    "geometry_msgs/msg/Point" "RIHS01_6963084842a9b04494d6b2941d11444708d892da2f4b09843b9c43f42a7f6881"
    Point {
        /// m.
        x: f64,
        /// m.
        y: f64,
        /// m.
        z: f64,
    }
}

crate::message! {
    /// A place in space, in half the bytes; for large amounts only.
    "geometry_msgs/msg/Point32" "RIHS01_2fc4db7cae16a4582c79a56b66173a8d48d52c7dc520ddc55a0d4bcf2a4bfdbc"
    Point32 {
        /// m.
        x: f32,
        /// m.
        y: f32,
        /// m.
        z: f32,
    }
}

crate::message! {
    /// Point with a time and a frame.
    "geometry_msgs/msg/PointStamped" "RIHS01_4c0296af86e01e562e9e0405d138a01537247580076c58ea38d7923ac1045897"
    PointStamped {
        /// header
        header: crate::std_msgs::Header,
        /// point
        point: Point,
    }
}

crate::message! {
    /// A closed outline; the last point is joined to the first.
    "geometry_msgs/msg/Polygon" "RIHS01_3782f9f0bf044964d692d6c017d705e37611afb1f0bf6a9dee248a7dda0f784a"
    Polygon {
        /// points
        points: Vec<Point32>,
    }
}

crate::message! {
    /// An outline with a number.
    "geometry_msgs/msg/PolygonInstance" "RIHS01_fa1cb3dc774329865258afef74f65b0553d487510c6d0f93ba38cc32d62ac0e5"
    PolygonInstance {
        /// polygon
        polygon: Polygon,
        /// id
        id: i64,
    }
}

crate::message! {
    /// PolygonInstance with a time and a frame.
    "geometry_msgs/msg/PolygonInstanceStamped" "RIHS01_802f37ea4398d7ce547936aab1fd278923716a13c63373887cd896957434ce2f"
    PolygonInstanceStamped {
        /// header
        header: crate::std_msgs::Header,
        /// polygon
        polygon: PolygonInstance,
    }
}

crate::message! {
    /// Polygon with a time and a frame.
    "geometry_msgs/msg/PolygonStamped" "RIHS01_b7cf07932f1523d4b4088075945c1a0141f7cd21da87cc940fc61652e9138b46"
    PolygonStamped {
        /// header
        header: crate::std_msgs::Header,
        /// polygon
        polygon: Polygon,
    }
}

crate::message! {
    /// A place and an orientation.
    "geometry_msgs/msg/Pose" "RIHS01_d501954e9476cea2996984e812054b68026ae0bfae789d9a10b23daf35cc90fa"
    Pose {
        /// position
        position: Point,
        /// orientation
        orientation: Quaternion,
    }
}

crate::message! {
    /// A place and a direction in the plane.
    "geometry_msgs/msg/Pose2D" "RIHS01_d68efa5b46e70f7b16ca23085474fdac5a44b638783ec42f661da64da4724ccc"
    Pose2D {
        /// m.
        x: f64,
        /// m.
        y: f64,
        /// rad, anticlockwise.
        theta: f64,
    }
}

crate::message! {
    /// Many poses in one frame.
    "geometry_msgs/msg/PoseArray" "RIHS01_af0cc36d190e104d546d168d6b39df04fa4b4ccecf59cb4c9ed328d3d5004aa0"
    PoseArray {
        /// header
        header: crate::std_msgs::Header,
        /// poses
        poses: Vec<Pose>,
    }
}

crate::message! {
    /// Pose with a time and a frame.
    "geometry_msgs/msg/PoseStamped" "RIHS01_10f3786d7d40fd2b54367835614bff85d4ad3b5dab62bf8bca0cc232d73b4cd8"
    PoseStamped {
        /// header
        header: crate::std_msgs::Header,
        /// pose
        pose: Pose,
    }
}

crate::message! {
    /// A pose and how sure it is.
    "geometry_msgs/msg/PoseWithCovariance" "RIHS01_9a7c0fd234b7f45c6098745ecccd773ca1085670e64107135397aee31c02e1bb"
    PoseWithCovariance {
        /// pose
        pose: Pose,
        /// Row by row; x, y, z in m, then about fixed x, y, z in rad.
        covariance: [f64; 36],
    }
}

crate::message! {
    /// PoseWithCovariance with a time and a frame.
    "geometry_msgs/msg/PoseWithCovarianceStamped" "RIHS01_26432f9803e43727d3c8f668d1fdb3c630f548af631e2f4e31382371bfea3b6e"
    PoseWithCovarianceStamped {
        /// header
        header: crate::std_msgs::Header,
        /// pose
        pose: PoseWithCovariance,
    }
}

crate::message! {
    /// A rotation, as a quaternion of length 1.
    "geometry_msgs/msg/Quaternion" "RIHS01_8a765f66778c8ff7c8ab94afcc590a2ed5325a1d9a076ffff38fbce36f458684"
    Quaternion {
        /// x
        x: f64 = 0.0,
        /// y
        y: f64 = 0.0,
        /// z
        z: f64 = 0.0,
        /// w
        w: f64 = 1.0,
    }
}

crate::message! {
    /// Quaternion with a time and a frame.
    "geometry_msgs/msg/QuaternionStamped" "RIHS01_381add86c6c3160644d228ca342182c7fd6c7fab11c7a85ad817a9cc22dbac6e"
    QuaternionStamped {
        /// header
        header: crate::std_msgs::Header,
        /// quaternion
        quaternion: Quaternion,
    }
}

crate::message! {
    /// From the child frame's coordinates to those of the parent.
    "geometry_msgs/msg/Transform" "RIHS01_beb83fbe698636351461f6f35d1abb20010c43d55374d81bd041f1ba2581fddc"
    Transform {
        /// m.
        translation: Vector3,
        /// rotation
        rotation: Quaternion,
    }
}

crate::message! {
    /// Where one frame is in another.
    "geometry_msgs/msg/TransformStamped" "RIHS01_0a241f87d04668d94099cbb5ba11691d5ad32c2f29682e4eb5653424bd275206"
    TransformStamped {
        /// Time, and the parent frame.
        header: crate::std_msgs::Header,
        /// The frame whose place is told.
        child_frame_id: std::string::String,
        /// transform
        transform: Transform,
    }
}

crate::message! {
    /// Velocity along and about the axes.
    "geometry_msgs/msg/Twist" "RIHS01_9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a"
    Twist {
        /// m/s.
        linear: Vector3,
        /// rad/s.
        angular: Vector3,
    }
}

crate::message! {
    /// Twist with a time and a frame.
    "geometry_msgs/msg/TwistStamped" "RIHS01_5f0fcd4f81d5d06ad9b4c4c63e3ea51b82d6ae4d0558f1d475229b1121db6f64"
    TwistStamped {
        /// header
        header: crate::std_msgs::Header,
        /// twist
        twist: Twist,
    }
}

crate::message! {
    /// A velocity and how sure it is.
    "geometry_msgs/msg/TwistWithCovariance" "RIHS01_49f574f033f095d8b6cd1beaca5ca7925e296e84af1716d16c89d38b059c8c18"
    TwistWithCovariance {
        /// twist
        twist: Twist,
        /// Row by row; x, y, z, then about x, y, z.
        covariance: [f64; 36],
    }
}

crate::message! {
    /// TwistWithCovariance with a time and a frame.
    "geometry_msgs/msg/TwistWithCovarianceStamped" "RIHS01_77b67434531e6529b7a0091357b186b6ebdb17fd9ffd3e0c7ce9d3fb11a44563"
    TwistWithCovarianceStamped {
        /// header
        header: crate::std_msgs::Header,
        /// twist
        twist: TwistWithCovariance,
    }
}

crate::message! {
    /// A direction with a length; unlike a point it is never moved, only turned.
    "geometry_msgs/msg/Vector3" "RIHS01_cc12fe83e4c02719f1ce8070bfd14aecd40f75a96696a67a2a1f37f7dbb0765d"
    Vector3 {
        /// x
        x: f64,
        /// y
        y: f64,
        /// z
        z: f64,
    }
}

crate::message! {
    /// Vector3 with a time and a frame.
    "geometry_msgs/msg/Vector3Stamped" "RIHS01_d4829622288cbb443886e7ea94ea5671a3b1be6bab4ad04224432a65f7d7887a"
    Vector3Stamped {
        /// header
        header: crate::std_msgs::Header,
        /// vector
        vector: Vector3,
    }
}

crate::message! {
    /// The velocity of a body relative to a frame, seen from a third.
    "geometry_msgs/msg/VelocityStamped" "RIHS01_55e7196186c8dbe4375278d7f1ac050dd8c9bacade1cf3eef8460fa667bd2457"
    VelocityStamped {
        /// header
        header: crate::std_msgs::Header,
        /// body_frame_id
        body_frame_id: std::string::String,
        /// reference_frame_id
        reference_frame_id: std::string::String,
        /// velocity
        velocity: Twist,
    }
}

crate::message! {
    /// Force and torque.
    "geometry_msgs/msg/Wrench" "RIHS01_018e8519d57c16adbe97c9fe1460ef21fec7e31bc541de3d653a35895677ce52"
    Wrench {
        /// N.
        force: Vector3,
        /// N m.
        torque: Vector3,
    }
}

crate::message! {
    /// Wrench with a time and a frame.
    "geometry_msgs/msg/WrenchStamped" "RIHS01_8dc3deaf06b2ab281f9f9a742a8961c328ca7cec16e3fd6586d3a5c83fa78f77"
    WrenchStamped {
        /// header
        header: crate::std_msgs::Header,
        /// wrench
        wrench: Wrench,
    }
}
