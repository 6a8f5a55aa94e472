//! `dwb_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces_main/dwb_msgs`
//! instead.

pub use super::dwb_msgs::*;

crate::message! {
    /// Trajectories that DWB has scored in one cycle.
    "dwb_msgs/msg/LocalPlanEvaluation" "RIHS01_08afdb790ba422cfa245678d03da3d8d3b75a34037ba85e0004f7ff9e9251b78"
    LocalPlanEvaluation {
        /// header
        header: crate::std_msgs::Header,
        /// twists
        twists: Vec<TrajectoryScore>,
        /// best_index
        best_index: u16,
        /// worst_index
        worst_index: u16,
    }
}

crate::message! {
    /// Velocity command with the poses it leads to.
    "dwb_msgs/msg/Trajectory2D" "RIHS01_29b0be7166dff91ec4c2c003fa49f12fae03516b46b7c8230e130aa7c805e8de"
    Trajectory2D {
        /// velocity
        velocity: crate::nav_2d_msgs::Twist2D,
        /// time_offsets
        time_offsets: Vec<crate::builtin_interfaces::Duration>,
        /// poses
        poses: Vec<crate::geometry_msgs::Pose>,
    }
}

crate::message! {
    /// Trajectory with the scores of all critics.
    "dwb_msgs/msg/TrajectoryScore" "RIHS01_eee5f096ccc5f8378565b460b204082dc71a59fd62a974b9a42eb9d5bdd5fd37"
    TrajectoryScore {
        /// traj
        traj: Trajectory2D,
        /// scores
        scores: Vec<CriticScore>,
        /// total
        total: f32,
    }
}
