//! `trajectory_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/trajectory_msgs`
//! instead.

crate::message! {
    /// How joints move over time.
    "trajectory_msgs/msg/JointTrajectory" "RIHS01_179b33eba59d676f6d967ac71fe35e7ca2f64b2f3928f4a018cec115e213796e"
    JointTrajectory {
        /// header
        header: crate::std_msgs::Header,
        /// joint_names
        joint_names: Vec<std::string::String>,
        /// points
        points: Vec<JointTrajectoryPoint>,
    }
}

crate::message! {
    /// How joints stand at one moment.
    "trajectory_msgs/msg/JointTrajectoryPoint" "RIHS01_de8907036d8bd45aac6f30cc9044a3d4a329c42cbf719aff7d95a584cfa532d7"
    JointTrajectoryPoint {
        /// positions
        positions: Vec<f64>,
        /// velocities
        velocities: Vec<f64>,
        /// accelerations
        accelerations: Vec<f64>,
        /// effort
        effort: Vec<f64>,
        /// time_from_start
        time_from_start: crate::builtin_interfaces::Duration,
    }
}

crate::message! {
    /// How joints with several axes move over time.
    "trajectory_msgs/msg/MultiDOFJointTrajectory" "RIHS01_3a18fd095292a65cfde8833c72985a30af981f3ec44494655c6267262b443a4a"
    MultiDOFJointTrajectory {
        /// header
        header: crate::std_msgs::Header,
        /// joint_names
        joint_names: Vec<std::string::String>,
        /// points
        points: Vec<MultiDOFJointTrajectoryPoint>,
    }
}

crate::message! {
    /// How joints with several axes stand at one moment.
    "trajectory_msgs/msg/MultiDOFJointTrajectoryPoint" "RIHS01_6ada1085b5ee64eaa069b074968e69f0e27c8c5e6f5bb0586dd1c834ef0e32b8"
    MultiDOFJointTrajectoryPoint {
        /// transforms
        transforms: Vec<crate::geometry_msgs::Transform>,
        /// velocities
        velocities: Vec<crate::geometry_msgs::Twist>,
        /// accelerations
        accelerations: Vec<crate::geometry_msgs::Twist>,
        /// time_from_start
        time_from_start: crate::builtin_interfaces::Duration,
    }
}
