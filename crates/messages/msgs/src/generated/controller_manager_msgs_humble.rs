//! `controller_manager_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces_humble/controller_manager_msgs`
//! instead.

pub use super::controller_manager_msgs::*;

crate::message! {
    /// State and interfaces of a controller.
    "controller_manager_msgs/msg/ControllerState" "RIHS01_38fe2e791900d2bb9e35be49861e88943f11de93e2ec52eb16af7b037116dcd8"
    ControllerState {
        /// name
        name: std::string::String,
        /// state
        state: std::string::String,
        /// type
        r#type: std::string::String,
        /// claimed_interfaces
        claimed_interfaces: Vec<std::string::String>,
        /// required_command_interfaces
        required_command_interfaces: Vec<std::string::String>,
        /// required_state_interfaces
        required_state_interfaces: Vec<std::string::String>,
        /// is_chainable
        is_chainable: bool,
        /// is_chained
        is_chained: bool,
        /// reference_interfaces
        reference_interfaces: Vec<std::string::String>,
        /// chain_connections
        chain_connections: Vec<ChainConnection>,
    }
}

crate::message! {
    /// State and interfaces of a hardware component.
    "controller_manager_msgs/msg/HardwareComponentState" "RIHS01_8cfdf0d49c37047396dbaf856e2303f54eed955872591501aadaca7f3d8714ec"
    HardwareComponentState {
        /// name
        name: std::string::String,
        /// type
        r#type: std::string::String,
        /// class_type
        class_type: std::string::String,
        /// state
        state: crate::lifecycle_msgs::State,
        /// command_interfaces
        command_interfaces: Vec<HardwareInterface>,
        /// state_interfaces
        state_interfaces: Vec<HardwareInterface>,
    }
}

crate::message! {
    /// Interface of a hardware component.
    "controller_manager_msgs/msg/HardwareInterface" "RIHS01_c24ddd0364686a74c1cedc2d015b58a9b7eb107b8644c14a63cd5ed67818145f"
    HardwareInterface {
        /// name
        name: std::string::String,
        /// is_available
        is_available: bool,
        /// is_claimed
        is_claimed: bool,
    }
}

crate::message! {
    /// Controllers that are loaded.
    "controller_manager_msgs/srv/ListControllers_Request" "RIHS01_fb985bc3dcc9b07c7d3af4b46787afa5a09ac79da6465ea42b5696f9355c1f70"
    ListControllersRequest {
    }
}

crate::message! {
    /// `controller_manager_msgs/srv/ListControllers_Response`.
    "controller_manager_msgs/srv/ListControllers_Response" "RIHS01_86d11db2d7ea803150195087e36465709ddf0f2adae2696d55a33400bd5ffb87"
    ListControllersResponse {
        /// controller
        controller: Vec<ControllerState>,
    }
}

crate::service! {
    /// Controllers that are loaded.
    "controller_manager_msgs/srv/ListControllers" "RIHS01_b51c7f13c7e9652da7e5b7a66485b62215835723754e6f8ddfdb99141c1c586d"
    ListControllers, ListControllersRequest, ListControllersResponse
}

crate::message! {
    /// Hardware components of a robot.
    "controller_manager_msgs/srv/ListHardwareComponents_Request" "RIHS01_4d528f3bba24425b73c788ebcb6462bf77d40eb194b77682138f079f821faeab"
    ListHardwareComponentsRequest {
    }
}

crate::message! {
    /// `controller_manager_msgs/srv/ListHardwareComponents_Response`.
    "controller_manager_msgs/srv/ListHardwareComponents_Response" "RIHS01_cd00dcf53c98f48e238a1b8fb30022bb56a3cf86ea6b01bbb23188929d70ffb7"
    ListHardwareComponentsResponse {
        /// component
        component: Vec<HardwareComponentState>,
    }
}

crate::service! {
    /// Hardware components of a robot.
    "controller_manager_msgs/srv/ListHardwareComponents" "RIHS01_f60d158a7d7721a4d9caaefbf361d97eae0f4dcffd909c83b0d2aca4bbd58b9e"
    ListHardwareComponents, ListHardwareComponentsRequest, ListHardwareComponentsResponse
}

crate::message! {
    /// Command and state interfaces of a robot.
    "controller_manager_msgs/srv/ListHardwareInterfaces_Request" "RIHS01_419a204c74b85adb602848d0f288fc756d0216f70bd30ab889c1d9b154ed8098"
    ListHardwareInterfacesRequest {
    }
}

crate::message! {
    /// `controller_manager_msgs/srv/ListHardwareInterfaces_Response`.
    "controller_manager_msgs/srv/ListHardwareInterfaces_Response" "RIHS01_755061d6c273304c2508db653294aca09e66da79f1b5dd981e8141b111d4e19d"
    ListHardwareInterfacesResponse {
        /// command_interfaces
        command_interfaces: Vec<HardwareInterface>,
        /// state_interfaces
        state_interfaces: Vec<HardwareInterface>,
    }
}

crate::service! {
    /// Command and state interfaces of a robot.
    "controller_manager_msgs/srv/ListHardwareInterfaces" "RIHS01_d27beaadbd314c342147e41d30469c2068e621818bd9ff9dd256d3e7a9d60194"
    ListHardwareInterfaces, ListHardwareInterfacesRequest, ListHardwareInterfacesResponse
}

crate::message! {
    /// Activates and deactivates controllers at one time.
    "controller_manager_msgs/srv/SwitchController_Request" "RIHS01_fb9dcb895be12aaf1c37bf67ac82bb6724e2013803378f9dfae5e39cf32313df"
    SwitchControllerRequest {
        /// activate_controllers
        activate_controllers: Vec<std::string::String>,
        /// deactivate_controllers
        deactivate_controllers: Vec<std::string::String>,
        /// start_controllers
        start_controllers: Vec<std::string::String>,
        /// stop_controllers
        stop_controllers: Vec<std::string::String>,
        /// One of the values above.
        strictness: i32,
        /// start_asap
        start_asap: bool,
        /// activate_asap
        activate_asap: bool,
        /// Maximum time to wait.
        timeout: crate::builtin_interfaces::Duration,
    }
    /// BEST_EFFORT
    BEST_EFFORT: i32 = 1;
    /// STRICT
    STRICT: i32 = 2;
}

crate::message! {
    /// `controller_manager_msgs/srv/SwitchController_Response`.
    "controller_manager_msgs/srv/SwitchController_Response" "RIHS01_4cb5dbb40dd78417c048e0b5586d2274bd54e44322fcae555f5fdda6aa582424"
    SwitchControllerResponse {
        /// ok
        ok: bool,
    }
}

crate::service! {
    /// Activates and deactivates controllers at one time.
    "controller_manager_msgs/srv/SwitchController" "RIHS01_44cdc35b75f7ff30e62574dfbe2c14434ac0ba09d33a6a3361d6f71fe8c90f74"
    SwitchController, SwitchControllerRequest, SwitchControllerResponse
}
