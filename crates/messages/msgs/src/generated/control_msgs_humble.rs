//! `control_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces_humble/control_msgs`
//! instead.

pub use super::control_msgs::*;

crate::message! {
    /// State of a joint trajectory controller.
    "control_msgs/msg/JointTrajectoryControllerState" "RIHS01_5e2fe5a025630ec82b5cc080e78b927ed0b230407fadee455a00cd59361bc573"
    JointTrajectoryControllerState {
        /// header
        header: crate::std_msgs::Header,
        /// joint_names
        joint_names: Vec<std::string::String>,
        /// reference
        reference: crate::trajectory_msgs::JointTrajectoryPoint,
        /// feedback
        feedback: crate::trajectory_msgs::JointTrajectoryPoint,
        /// error
        error: crate::trajectory_msgs::JointTrajectoryPoint,
        /// output
        output: crate::trajectory_msgs::JointTrajectoryPoint,
        /// desired
        desired: crate::trajectory_msgs::JointTrajectoryPoint,
        /// actual
        actual: crate::trajectory_msgs::JointTrajectoryPoint,
        /// multi_dof_joint_names
        multi_dof_joint_names: Vec<std::string::String>,
        /// multi_dof_reference
        multi_dof_reference: crate::trajectory_msgs::MultiDOFJointTrajectoryPoint,
        /// multi_dof_feedback
        multi_dof_feedback: crate::trajectory_msgs::MultiDOFJointTrajectoryPoint,
        /// multi_dof_error
        multi_dof_error: crate::trajectory_msgs::MultiDOFJointTrajectoryPoint,
        /// multi_dof_output
        multi_dof_output: crate::trajectory_msgs::MultiDOFJointTrajectoryPoint,
        /// multi_dof_desired
        multi_dof_desired: crate::trajectory_msgs::MultiDOFJointTrajectoryPoint,
        /// multi_dof_actual
        multi_dof_actual: crate::trajectory_msgs::MultiDOFJointTrajectoryPoint,
    }
}
