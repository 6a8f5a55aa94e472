//! `vision_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/vision_msgs`
//! instead.

crate::message! {
    /// A rectangle in an image.
    "vision_msgs/msg/BoundingBox2D" "RIHS01_008eacbb0cf8f26e83795547bed013eec3675485ef386ec056d80eaaf1c1ce2f"
    BoundingBox2D {
        /// Its middle and its turn.
        center: Pose2D,
        /// Pixels, before the turn.
        size_x: f64,
        /// Pixels, before the turn.
        size_y: f64,
    }
}

crate::message! {
    /// Rectangles in an image.
    "vision_msgs/msg/BoundingBox2DArray" "RIHS01_2464e82838009386d371b523211c21c91d74d313fcdd6788223c531d621cf691"
    BoundingBox2DArray {
        /// header
        header: crate::std_msgs::Header,
        /// boxes
        boxes: Vec<BoundingBox2D>,
    }
}

crate::message! {
    /// A box in space.
    "vision_msgs/msg/BoundingBox3D" "RIHS01_bbb73a65c163d7f9bb29009c7bde9f7faa576bd2d23299c4511d19230dab4698"
    BoundingBox3D {
        /// Its middle and its turn.
        center: crate::geometry_msgs::Pose,
        /// Along its own axes; m.
        size: crate::geometry_msgs::Vector3,
    }
}

crate::message! {
    /// Boxes in space.
    "vision_msgs/msg/BoundingBox3DArray" "RIHS01_a81938db9576b10c2eecd7c5a5da3eac496efd00221b25ed051dfbc81fb56da6"
    BoundingBox3DArray {
        /// header
        header: crate::std_msgs::Header,
        /// boxes
        boxes: Vec<BoundingBox3D>,
    }
}

crate::message! {
    /// What a whole image may show.
    "vision_msgs/msg/Classification" "RIHS01_f74db28d0eaef3afb78f48bf2161cd709a1383a0309d3454383b25be11345143"
    Classification {
        /// header
        header: crate::std_msgs::Header,
        /// results
        results: Vec<ObjectHypothesis>,
    }
}

crate::message! {
    /// An object found in an image.
    "vision_msgs/msg/Detection2D" "RIHS01_0d12b69df5c593b3455b7346fac8205437a7d4bcb09b9e0e0b2dde787ded38ea"
    Detection2D {
        /// header
        header: crate::std_msgs::Header,
        /// What it may be.
        results: Vec<ObjectHypothesisWithPose>,
        /// Where it is.
        bbox: BoundingBox2D,
        /// The same for the same object over time, or empty.
        id: std::string::String,
    }
}

crate::message! {
    /// All objects found in an image.
    "vision_msgs/msg/Detection2DArray" "RIHS01_214274120007f4a683866481336b70310268cfa107aebe9d594a6acf75bda968"
    Detection2DArray {
        /// header
        header: crate::std_msgs::Header,
        /// detections
        detections: Vec<Detection2D>,
    }
}

crate::message! {
    /// An object found in space.
    "vision_msgs/msg/Detection3D" "RIHS01_ddd703be132ab0b69d33121f1bb034132bfbb3b0ac5f9fb1516005ba1c8a265b"
    Detection3D {
        /// header
        header: crate::std_msgs::Header,
        /// What it may be.
        results: Vec<ObjectHypothesisWithPose>,
        /// Where it is.
        bbox: BoundingBox3D,
        /// The same for the same object over time, or empty.
        id: std::string::String,
    }
}

crate::message! {
    /// All objects found in space.
    "vision_msgs/msg/Detection3DArray" "RIHS01_793f5eab9595ac1c0da07873cc859db42eae51f0ee76056db8562515d830e018"
    Detection3DArray {
        /// header
        header: crate::std_msgs::Header,
        /// detections
        detections: Vec<Detection3D>,
    }
}

crate::message! {
    /// The classes that a segmentation tells apart.
    "vision_msgs/msg/LabelInfo" "RIHS01_3d37df4015cdf660cc851c51897f2acd957e1ca6205ba0a99aebffb9406b0783"
    LabelInfo {
        /// header
        header: crate::std_msgs::Header,
        /// class_map
        class_map: Vec<VisionClass>,
        /// Least score that counts.
        threshold: f32,
    }
}

crate::message! {
    /// What something may be.
    "vision_msgs/msg/ObjectHypothesis" "RIHS01_51da43cec11c01957a64d1e05a24acd18aae7745ec30b74348ad5f6d634f7f90"
    ObjectHypothesis {
        /// Which class.
        class_id: std::string::String,
        /// How sure, more is surer.
        score: f64,
    }
}

crate::message! {
    /// What something may be, and where it would be then.
    "vision_msgs/msg/ObjectHypothesisWithPose" "RIHS01_41c12344c0396c48b81df12467c192d99b2a0eb1463c5c37194e4223251c80bc"
    ObjectHypothesisWithPose {
        /// hypothesis
        hypothesis: ObjectHypothesis,
        /// pose
        pose: crate::geometry_msgs::PoseWithCovariance,
    }
}

crate::message! {
    /// A point in an image; pixels.
    "vision_msgs/msg/Point2D" "RIHS01_eab0e83f44ab4de92ceaf76dd7d0e7638f2bdd1d16ffbe16c7a136c48e407247"
    Point2D {
        /// x
        x: f64,
        /// y
        y: f64,
    }
}

crate::message! {
    /// A place and a direction in an image.
    "vision_msgs/msg/Pose2D" "RIHS01_b0b5d1d7b4c20dd4fcde3ed1d4b289a919290572007d67a97043814db25d3648"
    Pose2D {
        /// position
        position: Point2D,
        /// rad, from x towards y.
        theta: f64,
    }
}

crate::message! {
    /// The name of a class.
    "vision_msgs/msg/VisionClass" "RIHS01_1e4a11f0fed50b5623cb8ff26ca0e37952a48a9c074d16f804b44e9164c2037a"
    VisionClass {
        /// class_id
        class_id: u16,
        /// class_name
        class_name: std::string::String,
    }
}

crate::message! {
    /// How a vision pipeline was made.
    "vision_msgs/msg/VisionInfo" "RIHS01_95d3116a17484ad91c9a2686e1d54890bbfc3ff6c6a2de137738c4950d45d284"
    VisionInfo {
        /// header
        header: crate::std_msgs::Header,
        /// The name of the method.
        method: std::string::String,
        /// Where its classes are described.
        database_location: std::string::String,
        /// Grows when they change.
        database_version: i32,
    }
}
