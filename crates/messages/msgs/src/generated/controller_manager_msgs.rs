//! `controller_manager_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/controller_manager_msgs`
//! instead.

crate::message! {
    /// Connection of a controller to those that it commands.
    "controller_manager_msgs/msg/ChainConnection" "RIHS01_2daecd1da4b171f48b291c79747657a651eb1ab8821b68e38b1c88c736bba91c"
    ChainConnection {
        /// name
        name: std::string::String,
        /// reference_interfaces
        reference_interfaces: Vec<std::string::String>,
    }
}

crate::message! {
    /// States of all controllers and hardware components.
    "controller_manager_msgs/msg/ControllerManagerActivity" "RIHS01_35b7de5d611b6780e89732de325f2f765eacdb8a7adfe5821a27af4a03a7c244"
    ControllerManagerActivity {
        /// header
        header: crate::std_msgs::Header,
        /// controllers
        controllers: Vec<NamedLifecycleState>,
        /// hardware_components
        hardware_components: Vec<NamedLifecycleState>,
    }
}

crate::message! {
    /// State and interfaces of a controller.
    "controller_manager_msgs/msg/ControllerState" "RIHS01_9a8780ab9814b6032978a07c6c7033cf1a7894ac8d948a6fb72afea07b04cc83"
    ControllerState {
        /// name
        name: std::string::String,
        /// state
        state: std::string::String,
        /// type
        r#type: std::string::String,
        /// is_async
        is_async: bool,
        /// Hz.
        update_rate: u16,
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
        /// exported_state_interfaces
        exported_state_interfaces: Vec<std::string::String>,
        /// reference_interfaces
        reference_interfaces: Vec<std::string::String>,
        /// chain_connections
        chain_connections: Vec<ChainConnection>,
    }
}

crate::message! {
    /// State and interfaces of a hardware component.
    "controller_manager_msgs/msg/HardwareComponentState" "RIHS01_8723f76b60e3ea54920065e3e777d93c68b76fc12839ad6a6ca4e0a6439b384c"
    HardwareComponentState {
        /// name
        name: std::string::String,
        /// type
        r#type: std::string::String,
        /// is_async
        is_async: bool,
        /// Hz.
        rw_rate: u16,
        /// class_type
        class_type: std::string::String,
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
    /// Interface of a hardware component.
    "controller_manager_msgs/msg/HardwareInterface" "RIHS01_b4c556991db81ca56a49338b5e8f0675a6707faee54fba161d2bbd4d963d418a"
    HardwareInterface {
        /// name
        name: std::string::String,
        /// data_type
        data_type: std::string::String,
        /// is_available
        is_available: bool,
        /// is_claimed
        is_claimed: bool,
    }
}

crate::message! {
    /// Name and lifecycle state of a component.
    "controller_manager_msgs/msg/NamedLifecycleState" "RIHS01_b7947b6f8df8f7e93d1cb8d115842fb0eeddfa6fb5c7b86cc0f3cafd55be4c1f"
    NamedLifecycleState {
        /// name
        name: std::string::String,
        /// state
        state: crate::lifecycle_msgs::State,
    }
}

crate::message! {
    /// Returns a controller to the unconfigured state.
    "controller_manager_msgs/srv/CleanupController_Request" "RIHS01_a741f98a6de71f691fb4828428ff134d5fc2d4dedee351a3f102b4bacf39975d"
    CleanupControllerRequest {
        /// name
        name: std::string::String,
    }
}

crate::message! {
    /// `controller_manager_msgs/srv/CleanupController_Response`.
    "controller_manager_msgs/srv/CleanupController_Response" "RIHS01_2d36519f4ef8b8f26ea56c266c6a5d179c046eb8f80a56a7c2b1cf002202f8b7"
    CleanupControllerResponse {
        /// ok
        ok: bool,
    }
}

crate::service! {
    /// Returns a controller to the unconfigured state.
    "controller_manager_msgs/srv/CleanupController" "RIHS01_0e5e0da84cf97150abbb3a4e2249c67e6f43dba01ed9b7228b4deaab8838ec4b"
    CleanupController, CleanupControllerRequest, CleanupControllerResponse
}

crate::message! {
    /// Configures a controller.
    "controller_manager_msgs/srv/ConfigureController_Request" "RIHS01_027c272c6b945317d5e057515c83c747725ccaf9d345be6f6941383f6472d3a9"
    ConfigureControllerRequest {
        /// name
        name: std::string::String,
    }
}

crate::message! {
    /// `controller_manager_msgs/srv/ConfigureController_Response`.
    "controller_manager_msgs/srv/ConfigureController_Response" "RIHS01_f22a10e36403ebf6e9a54f5fa76dddb7c0af2e5417f4ff098bb0525bf89a726d"
    ConfigureControllerResponse {
        /// ok
        ok: bool,
    }
}

crate::service! {
    /// Configures a controller.
    "controller_manager_msgs/srv/ConfigureController" "RIHS01_b5de498113f4eabc7b932e019ca0498d67304b1ca465fe8a426ea89644865ff9"
    ConfigureController, ConfigureControllerRequest, ConfigureControllerResponse
}

crate::message! {
    /// Types of controllers that can be loaded.
    "controller_manager_msgs/srv/ListControllerTypes_Request" "RIHS01_b6cda89b7e31f5525f7a328119f64f6bf5710db263cecb00f91e59aa9b5d41de"
    ListControllerTypesRequest {
    }
}

crate::message! {
    /// `controller_manager_msgs/srv/ListControllerTypes_Response`.
    "controller_manager_msgs/srv/ListControllerTypes_Response" "RIHS01_4e924ba35dac47257de06fabd757aaf7bd05f47da99dc878864c9c3f9a3f721e"
    ListControllerTypesResponse {
        /// types
        types: Vec<std::string::String>,
        /// base_classes
        base_classes: Vec<std::string::String>,
    }
}

crate::service! {
    /// Types of controllers that can be loaded.
    "controller_manager_msgs/srv/ListControllerTypes" "RIHS01_873e8d2bb81b8b5903ca736d299ba959f929efec4b4a18d17354b8b322822e05"
    ListControllerTypes, ListControllerTypesRequest, ListControllerTypesResponse
}

crate::message! {
    /// Controllers that are loaded.
    "controller_manager_msgs/srv/ListControllers_Request" "RIHS01_fb985bc3dcc9b07c7d3af4b46787afa5a09ac79da6465ea42b5696f9355c1f70"
    ListControllersRequest {
    }
}

crate::message! {
    /// `controller_manager_msgs/srv/ListControllers_Response`.
    "controller_manager_msgs/srv/ListControllers_Response" "RIHS01_445459f6b387bda67942d8bea4dfee82dedf12388317e68d5bc4513993799b86"
    ListControllersResponse {
        /// controller
        controller: Vec<ControllerState>,
    }
}

crate::service! {
    /// Controllers that are loaded.
    "controller_manager_msgs/srv/ListControllers" "RIHS01_4f8e36bb1fa5afdeba45c2d56ae6a2097b1493a253f961dd6290c085033bd189"
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
    "controller_manager_msgs/srv/ListHardwareComponents_Response" "RIHS01_9607f3bd43ebcfaa25ca4f506701fb2697186a986364f58649b43182d9dd1556"
    ListHardwareComponentsResponse {
        /// component
        component: Vec<HardwareComponentState>,
    }
}

crate::service! {
    /// Hardware components of a robot.
    "controller_manager_msgs/srv/ListHardwareComponents" "RIHS01_2ff105e609928671af16413362c0fdd089e1dd50c5a49d830db603ba8e4439c8"
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
    "controller_manager_msgs/srv/ListHardwareInterfaces_Response" "RIHS01_32da0652393586234856a1f44a039ff1487bdc1905fbf5068d026b77d4252e63"
    ListHardwareInterfacesResponse {
        /// command_interfaces
        command_interfaces: Vec<HardwareInterface>,
        /// state_interfaces
        state_interfaces: Vec<HardwareInterface>,
    }
}

crate::service! {
    /// Command and state interfaces of a robot.
    "controller_manager_msgs/srv/ListHardwareInterfaces" "RIHS01_c3e561a6e8cc7b9d577d8065c783038e51f6950cbe9bed67fb117a3e2e04d8f1"
    ListHardwareInterfaces, ListHardwareInterfacesRequest, ListHardwareInterfacesResponse
}

crate::message! {
    /// Loads a controller by its name.
    "controller_manager_msgs/srv/LoadController_Request" "RIHS01_7a6624df1a6c972c13c9c5b71f13eda236226b7c08f118feccbbc60ad1829216"
    LoadControllerRequest {
        /// name
        name: std::string::String,
    }
}

crate::message! {
    /// `controller_manager_msgs/srv/LoadController_Response`.
    "controller_manager_msgs/srv/LoadController_Response" "RIHS01_8ce86b422a67d8150b4a2885fcce601670c39a7fddb8601df8609ed0b931ad76"
    LoadControllerResponse {
        /// ok
        ok: bool,
    }
}

crate::service! {
    /// Loads a controller by its name.
    "controller_manager_msgs/srv/LoadController" "RIHS01_e37f7596c50c88cf8cb7a10cd376ff7579850cc63b5e787e9c8f11981f9ab4d2"
    LoadController, LoadControllerRequest, LoadControllerResponse
}

crate::message! {
    /// Reloads the libraries of controllers.
    "controller_manager_msgs/srv/ReloadControllerLibraries_Request" "RIHS01_c5ae8813adda2aed0e5e5558031e6f4c7834b941aa871746e86adc1cb745cda8"
    ReloadControllerLibrariesRequest {
        /// force_kill
        force_kill: bool,
    }
}

crate::message! {
    /// `controller_manager_msgs/srv/ReloadControllerLibraries_Response`.
    "controller_manager_msgs/srv/ReloadControllerLibraries_Response" "RIHS01_bea69bb80ebbb4a00023758c51fd0e3eaf308c1ae6640fdf4bbad6793bb967d4"
    ReloadControllerLibrariesResponse {
        /// ok
        ok: bool,
    }
}

crate::service! {
    /// Reloads the libraries of controllers.
    "controller_manager_msgs/srv/ReloadControllerLibraries" "RIHS01_485cd0040f8a343a9596155b967363e1bc715f034bbb111f795c73d9d8056a9b"
    ReloadControllerLibraries, ReloadControllerLibrariesRequest, ReloadControllerLibrariesResponse
}

crate::message! {
    /// Moves a hardware component to a lifecycle state.
    "controller_manager_msgs/srv/SetHardwareComponentState_Request" "RIHS01_22c9b3e32a02221d411a47dab1fda921003a96ac41e8de7d4d805e2cfd0de21d"
    SetHardwareComponentStateRequest {
        /// name
        name: std::string::String,
        /// target_state
        target_state: crate::lifecycle_msgs::State,
    }
}

crate::message! {
    /// `controller_manager_msgs/srv/SetHardwareComponentState_Response`.
    "controller_manager_msgs/srv/SetHardwareComponentState_Response" "RIHS01_c230aa244dd97d761e27ccde7b5056ec4e28e0bb804da283e42cd37944c46592"
    SetHardwareComponentStateResponse {
        /// ok
        ok: bool,
        /// state
        state: crate::lifecycle_msgs::State,
    }
}

crate::service! {
    /// Moves a hardware component to a lifecycle state.
    "controller_manager_msgs/srv/SetHardwareComponentState" "RIHS01_940b15846ed3e1fb561ab45edf77a992b811fd59c574f45d5205a84a0deb2f65"
    SetHardwareComponentState, SetHardwareComponentStateRequest, SetHardwareComponentStateResponse
}

crate::message! {
    /// Activates and deactivates controllers at one time.
    "controller_manager_msgs/srv/SwitchController_Request" "RIHS01_d258d35c1ce6d7469e0155900202519be21f82c2641393540babd728a09cfa50"
    SwitchControllerRequest {
        /// activate_controllers
        activate_controllers: Vec<std::string::String>,
        /// deactivate_controllers
        deactivate_controllers: Vec<std::string::String>,
        /// One of the values above.
        strictness: i32,
        /// activate_asap
        activate_asap: bool,
        /// Maximum time to wait.
        timeout: crate::builtin_interfaces::Duration,
    }
    /// BEST_EFFORT
    BEST_EFFORT: i32 = 1;
    /// STRICT
    STRICT: i32 = 2;
    /// AUTO
    AUTO: i32 = 3;
    /// FORCE_AUTO
    FORCE_AUTO: i32 = 4;
}

crate::message! {
    /// `controller_manager_msgs/srv/SwitchController_Response`.
    "controller_manager_msgs/srv/SwitchController_Response" "RIHS01_b7e90d1a67a2e4e3da7064ffb328cfe3111147a1a55cafaafd73b1d66681a251"
    SwitchControllerResponse {
        /// ok
        ok: bool,
        /// message
        message: std::string::String,
    }
}

crate::service! {
    /// Activates and deactivates controllers at one time.
    "controller_manager_msgs/srv/SwitchController" "RIHS01_d4ad10aa5da7808bc522d55d4123d8ef79de73d049d165639d7663ac37cc9895"
    SwitchController, SwitchControllerRequest, SwitchControllerResponse
}

crate::message! {
    /// Unloads a controller.
    "controller_manager_msgs/srv/UnloadController_Request" "RIHS01_90f14a0b402791210988f4931be46a62edc7f6c90d0551c54c9a7cbce1b56ea1"
    UnloadControllerRequest {
        /// name
        name: std::string::String,
    }
}

crate::message! {
    /// `controller_manager_msgs/srv/UnloadController_Response`.
    "controller_manager_msgs/srv/UnloadController_Response" "RIHS01_4636099a7eaa6a9f3b299504878d58d580123f738e235c9df7bc46ef7b8f3461"
    UnloadControllerResponse {
        /// ok
        ok: bool,
    }
}

crate::service! {
    /// Unloads a controller.
    "controller_manager_msgs/srv/UnloadController" "RIHS01_4055728e84c041348648d7f808c6681562000e3a9ce9fbb42c3350df25773f16"
    UnloadController, UnloadControllerRequest, UnloadControllerResponse
}
