//! `controller_manager_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces_main/controller_manager_msgs`
//! instead.

pub use super::controller_manager_msgs::*;

crate::message! {
    /// State and interfaces of a hardware component.
    "controller_manager_msgs/msg/HardwareComponentState" "RIHS01_42dd5e6ce049005558e2e8d12cbb0003087fb3b7914b69148a915d7267ec7618"
    HardwareComponentState {
        /// name
        name: std::string::String,
        /// type
        r#type: std::string::String,
        /// is_async
        is_async: bool,
        /// Hz.
        rw_rate: u16,
        /// plugin_name
        plugin_name: std::string::String,
        /// state
        state: crate::lifecycle_msgs::State,
        /// command_interfaces
        command_interfaces: Vec<HardwareInterface>,
        /// state_interfaces
        state_interfaces: Vec<HardwareInterface>,
    }
}

crate::message! {
    /// Hardware components of a robot.
    "controller_manager_msgs/srv/ListHardwareComponents_Request" "RIHS01_4d528f3bba24425b73c788ebcb6462bf77d40eb194b77682138f079f821faeab"
    ListHardwareComponentsRequest {
    }
}

crate::message! {
    /// `controller_manager_msgs/srv/ListHardwareComponents_Response`.
    "controller_manager_msgs/srv/ListHardwareComponents_Response" "RIHS01_ca10b868824b289215982698f35e4d0839b267083697014aa65b6428ae38f7c0"
    ListHardwareComponentsResponse {
        /// component
        component: Vec<HardwareComponentState>,
    }
}

crate::service! {
    /// Hardware components of a robot.
    "controller_manager_msgs/srv/ListHardwareComponents" "RIHS01_da29c2bbff9ec4f28d2815b9906ff51e419cebb6e79e216d4350110459b5164f"
    ListHardwareComponents, ListHardwareComponentsRequest, ListHardwareComponentsResponse
}
