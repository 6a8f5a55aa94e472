//! `gazebo_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/gazebo_msgs`
//! instead.

crate::message! {
    /// Two shapes that touch.
    "gazebo_msgs/msg/ContactState" "RIHS01_e8435200741f6b7b6f2d156d4a1d5d97d6869f6237ade6fe540b2e7a8516c358"
    ContactState {
        /// Free text.
        info: std::string::String,
        /// collision1_name
        collision1_name: std::string::String,
        /// collision2_name
        collision2_name: std::string::String,
        /// One for each point.
        wrenches: Vec<crate::geometry_msgs::Wrench>,
        /// total_wrench
        total_wrench: crate::geometry_msgs::Wrench,
        /// m.
        contact_positions: Vec<crate::geometry_msgs::Vector3>,
        /// Length 1.
        contact_normals: Vec<crate::geometry_msgs::Vector3>,
        /// How deep they overlap \[m].
        depths: Vec<f64>,
    }
}

crate::message! {
    /// All that touches, at one time.
    "gazebo_msgs/msg/ContactsState" "RIHS01_1dc585e627c16551e50102b983ec513212ef81bad3b9e9f2423f549df190a40c"
    ContactsState {
        /// header
        header: crate::std_msgs::Header,
        /// One for each pair of shapes.
        states: Vec<ContactState>,
    }
}

crate::message! {
    /// Where a model or link is and how it moves.
    "gazebo_msgs/msg/EntityState" "RIHS01_ac4d02452631059a6720613df2f318d13bf4a69e46cda3d311fabc4553d92e82"
    EntityState {
        /// With scope: model::link.
        name: std::string::String,
        /// pose
        pose: crate::geometry_msgs::Pose,
        /// twist
        twist: crate::geometry_msgs::Twist,
        /// Of pose and twist; none or "world" is the world.
        reference_frame: std::string::String,
    }
}

crate::message! {
    /// Where a link is and how it moves. EntityState took its place.
    "gazebo_msgs/msg/LinkState" "RIHS01_19f6b01a15249cb693f4150136bde433e7562685caf9b51dc18eb9452ce4d086"
    LinkState {
        /// With scope: model::link.
        link_name: std::string::String,
        /// pose
        pose: crate::geometry_msgs::Pose,
        /// twist
        twist: crate::geometry_msgs::Twist,
        /// Of pose and twist; none, "world" or "map" is the world.
        reference_frame: std::string::String,
    }
}

crate::message! {
    /// All links in the frame of the world.
    "gazebo_msgs/msg/LinkStates" "RIHS01_544efb5e5c0567697a9a97152a3d9d68c92bbcc5fd9d113f1473edb66a3d21dd"
    LinkStates {
        /// With scope: model::link.
        name: Vec<std::string::String>,
        /// pose
        pose: Vec<crate::geometry_msgs::Pose>,
        /// twist
        twist: Vec<crate::geometry_msgs::Twist>,
    }
}

crate::message! {
    /// Where a model is and how it moves. EntityState took its place.
    "gazebo_msgs/msg/ModelState" "RIHS01_25570c52ab49c528d9563a52691f1939870974c072dcc27cd8e17f61e759db62"
    ModelState {
        /// model_name
        model_name: std::string::String,
        /// pose
        pose: crate::geometry_msgs::Pose,
        /// twist
        twist: crate::geometry_msgs::Twist,
        /// Of pose and twist; none, "world" or "map" is the world.
        reference_frame: std::string::String,
    }
}

crate::message! {
    /// All models in the frame of the world.
    "gazebo_msgs/msg/ModelStates" "RIHS01_948fbd9d345a298588ea99742362d651a73bdc46637dea1158bcadce859cb6f5"
    ModelStates {
        /// name
        name: Vec<std::string::String>,
        /// pose
        pose: Vec<crate::geometry_msgs::Pose>,
        /// twist
        twist: Vec<crate::geometry_msgs::Twist>,
    }
}

crate::message! {
    /// What the ODE engine knows of a joint, one number for each axis. None keeps what is.
    "gazebo_msgs/msg/ODEJointProperties" "RIHS01_dfa26a3a153c0ec6b22b49d4bef17b492dd4c65611322c10ff10cf8b34ff16f7"
    ODEJointProperties {
        /// damping
        damping: Vec<f64>,
        /// Upper limit \[rad or m].
        hi_stop: Vec<f64>,
        /// Lower limit \[rad or m].
        lo_stop: Vec<f64>,
        /// erp
        erp: Vec<f64>,
        /// cfm
        cfm: Vec<f64>,
        /// stop_erp
        stop_erp: Vec<f64>,
        /// stop_cfm
        stop_cfm: Vec<f64>,
        /// fudge_factor
        fudge_factor: Vec<f64>,
        /// Largest force or torque of its motor \[N or N m].
        fmax: Vec<f64>,
        /// Speed of its motor \[rad/s or m/s].
        vel: Vec<f64>,
    }
}

crate::message! {
    /// Settings of the ODE engine.
    "gazebo_msgs/msg/ODEPhysics" "RIHS01_ac82f81db143d0eaae55db4c4445a1e02a768e473f2e7210a65ab5ba0a581714"
    ODEPhysics {
        /// Whether bodies at rest may sleep.
        auto_disable_bodies: bool,
        /// sor_pgs_precon_iters
        sor_pgs_precon_iters: u32,
        /// sor_pgs_iters
        sor_pgs_iters: u32,
        /// Successive over-relaxation.
        sor_pgs_w: f64,
        /// sor_pgs_rms_error_tol
        sor_pgs_rms_error_tol: f64,
        /// m.
        contact_surface_layer: f64,
        /// m/s.
        contact_max_correcting_vel: f64,
        /// cfm
        cfm: f64,
        /// erp
        erp: f64,
        /// For each pair of shapes.
        max_contacts: u32,
    }
}

crate::message! {
    /// How fast a simulation and its sensors are.
    "gazebo_msgs/msg/PerformanceMetrics" "RIHS01_78a23a97ca2832491a26a73da2397fe2a470892704574f1f930c8a4a8b2ce456"
    PerformanceMetrics {
        /// header
        header: crate::std_msgs::Header,
        /// Simulated seconds in a second of the wall.
        real_time_factor: f64,
        /// sensors
        sensors: Vec<SensorPerformanceMetric>,
    }
}

crate::message! {
    /// How fast a sensor is.
    "gazebo_msgs/msg/SensorPerformanceMetric" "RIHS01_2fb085a53ec05154b793411cc83d0120da95292c8f3b22ee1e402aa44d9846b6"
    SensorPerformanceMetric {
        /// name
        name: std::string::String,
        /// In simulated time \[Hz].
        sim_update_rate: f64,
        /// On the wall's clock \[Hz].
        real_update_rate: f64,
        /// Of a camera \[Hz].
        fps: f64,
    }
}

crate::message! {
    /// How wheels slip.
    "gazebo_msgs/msg/WheelSlip" "RIHS01_71875111e6e10937ba5cd6a6509bbcb5e2f8bc9c53b9aee9adbd0e407c94963d"
    WheelSlip {
        /// name
        name: Vec<std::string::String>,
        /// Angle between the wheel's plane and its way \[rad].
        lateral_slip: Vec<f64>,
        /// Against the speed of the wheel.
        longitudinal_slip: Vec<f64>,
    }
}

crate::message! {
    /// All bodies with the forces on them.
    "gazebo_msgs/msg/WorldState" "RIHS01_80348c0a5e54093582e74f96faec24103e26fcabbba6c36298dc37ede514db9f"
    WorldState {
        /// header
        header: crate::std_msgs::Header,
        /// name
        name: Vec<std::string::String>,
        /// pose
        pose: Vec<crate::geometry_msgs::Pose>,
        /// twist
        twist: Vec<crate::geometry_msgs::Twist>,
        /// wrench
        wrench: Vec<crate::geometry_msgs::Wrench>,
    }
}

crate::message! {
    /// Pushes a link. ApplyLinkWrench took its place.
    "gazebo_msgs/srv/ApplyBodyWrench_Request" "RIHS01_7d439549445047dad0d08d559f141afcd4931c32418d8a8c11f04c080cf1077c"
    ApplyBodyWrenchRequest {
        /// With scope: model::link.
        body_name: std::string::String,
        /// Of point and wrench; none is the world.
        reference_frame: std::string::String,
        /// reference_point
        reference_point: crate::geometry_msgs::Point,
        /// wrench
        wrench: crate::geometry_msgs::Wrench,
        /// Past: now.
        start_time: crate::builtin_interfaces::Time,
        /// Below zero: for ever.
        duration: crate::builtin_interfaces::Duration,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/ApplyBodyWrench_Response`.
    "gazebo_msgs/srv/ApplyBodyWrench_Response" "RIHS01_b11138d588539da951e458ad952c0a6bbceb45c95b6862de1afd962562f3025b"
    ApplyBodyWrenchResponse {
        /// success
        success: bool,
        /// status_message
        status_message: std::string::String,
    }
}

crate::service! {
    /// Pushes a link. ApplyLinkWrench took its place.
    "gazebo_msgs/srv/ApplyBodyWrench" "RIHS01_2ae002fcea8f307b9cc5affd19fc8d4e304510c4e238579303227ec21bd051ae"
    ApplyBodyWrench, ApplyBodyWrenchRequest, ApplyBodyWrenchResponse
}

crate::message! {
    /// Pushes a joint.
    "gazebo_msgs/srv/ApplyJointEffort_Request" "RIHS01_482f5335de2da22efe06ea7eca16ddd90aa438a85f14d1ce5e8398bed03618b8"
    ApplyJointEffortRequest {
        /// joint_name
        joint_name: std::string::String,
        /// N or N m.
        effort: f64,
        /// Past: now.
        start_time: crate::builtin_interfaces::Time,
        /// Below zero: for ever.
        duration: crate::builtin_interfaces::Duration,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/ApplyJointEffort_Response`.
    "gazebo_msgs/srv/ApplyJointEffort_Response" "RIHS01_4d6a0527bc6f8b1bf5bf27e6b8a9579d0539242e97b73751b5c0d1f52c125203"
    ApplyJointEffortResponse {
        /// success
        success: bool,
        /// status_message
        status_message: std::string::String,
    }
}

crate::service! {
    /// Pushes a joint.
    "gazebo_msgs/srv/ApplyJointEffort" "RIHS01_3e94edd0b2942718ab07ae1b6ca5caefd2d2948d756265ea142fe4244e5e706a"
    ApplyJointEffort, ApplyJointEffortRequest, ApplyJointEffortResponse
}

crate::message! {
    /// Pushes a link.
    "gazebo_msgs/srv/ApplyLinkWrench_Request" "RIHS01_48956fa54e0395c3e53798568d27a7a3d0621737058722791a4e16b6e20f9252"
    ApplyLinkWrenchRequest {
        /// With scope: model::link.
        link_name: std::string::String,
        /// Of point and wrench; none is the world.
        reference_frame: std::string::String,
        /// reference_point
        reference_point: crate::geometry_msgs::Point,
        /// wrench
        wrench: crate::geometry_msgs::Wrench,
        /// Past: now.
        start_time: crate::builtin_interfaces::Time,
        /// Below zero: for ever.
        duration: crate::builtin_interfaces::Duration,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/ApplyLinkWrench_Response`.
    "gazebo_msgs/srv/ApplyLinkWrench_Response" "RIHS01_37fb8fb8245020eef2a1dea46226ef7bdf2c06fe2bba432e3f7b1695b3dc2c11"
    ApplyLinkWrenchResponse {
        /// success
        success: bool,
        /// status_message
        status_message: std::string::String,
    }
}

crate::service! {
    /// Pushes a link.
    "gazebo_msgs/srv/ApplyLinkWrench" "RIHS01_726243c2279f825204c81c4416019a06cbf02c55996f8a1a4fb7123ecf38a0d2"
    ApplyLinkWrench, ApplyLinkWrenchRequest, ApplyLinkWrenchResponse
}

crate::message! {
    /// Names a link. LinkRequest took its place.
    "gazebo_msgs/srv/BodyRequest_Request" "RIHS01_6e0ea9be2e118d284c846b75fdbee4b128bb1f91fe82c879abe576ceacc4d2d2"
    BodyRequestRequest {
        /// With scope: model::link.
        body_name: std::string::String,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/BodyRequest_Response`.
    "gazebo_msgs/srv/BodyRequest_Response" "RIHS01_1bf50e6647d0d7aadd771e1773fe64f91009b57906d4e1933100df9173b2743e"
    BodyRequestResponse {
    }
}

crate::service! {
    /// Names a link. LinkRequest took its place.
    "gazebo_msgs/srv/BodyRequest" "RIHS01_c002b6c9051ae255d44bd75c1f745cce9f9f5eb239a650506a134c1ce4fdd54b"
    BodyRequest, BodyRequestRequest, BodyRequestResponse
}

crate::message! {
    /// Takes a model or a light out of the world.
    "gazebo_msgs/srv/DeleteEntity_Request" "RIHS01_837e03a50e7bce5c780defd18d8cba6bd6ca277720ad165adee8c83589bab131"
    DeleteEntityRequest {
        /// name
        name: std::string::String,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/DeleteEntity_Response`.
    "gazebo_msgs/srv/DeleteEntity_Response" "RIHS01_158bdd1d18873eb5601d64b499740871d4e7936c41f1f52dd72fae9a22d85227"
    DeleteEntityResponse {
        /// success
        success: bool,
        /// status_message
        status_message: std::string::String,
    }
}

crate::service! {
    /// Takes a model or a light out of the world.
    "gazebo_msgs/srv/DeleteEntity" "RIHS01_81b2eed68ee3a93de5a70a0915b57c51dbed9518da77ca5f0abc47222f1f44a2"
    DeleteEntity, DeleteEntityRequest, DeleteEntityResponse
}

crate::message! {
    /// Takes a light out of the world. DeleteEntity took its place.
    "gazebo_msgs/srv/DeleteLight_Request" "RIHS01_8161b96f274ae6fb9cc6c022ddbee2dbe82c32cdcf1fac55ccec74213ff17cdc"
    DeleteLightRequest {
        /// light_name
        light_name: std::string::String,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/DeleteLight_Response`.
    "gazebo_msgs/srv/DeleteLight_Response" "RIHS01_a5c8fad5a9ead7fb27e9caf2e3849d7336b6e34a355e021a68c1989ceb512c96"
    DeleteLightResponse {
        /// success
        success: bool,
        /// status_message
        status_message: std::string::String,
    }
}

crate::service! {
    /// Takes a light out of the world. DeleteEntity took its place.
    "gazebo_msgs/srv/DeleteLight" "RIHS01_bfa8291779696b74f42c72fee0cb40f2b88252ec8cf6203ae05e78532c3a6533"
    DeleteLight, DeleteLightRequest, DeleteLightResponse
}

crate::message! {
    /// Takes a model out of the world. DeleteEntity took its place.
    "gazebo_msgs/srv/DeleteModel_Request" "RIHS01_3a82c4a8f0097aa352378da8459f38933ca02142f8ed42acda9a2220c2372fff"
    DeleteModelRequest {
        /// model_name
        model_name: std::string::String,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/DeleteModel_Response`.
    "gazebo_msgs/srv/DeleteModel_Response" "RIHS01_862a8141eaf2816854fbe1a53210a99f14a137e87bd145b011c6850778324700"
    DeleteModelResponse {
        /// success
        success: bool,
        /// status_message
        status_message: std::string::String,
    }
}

crate::service! {
    /// Takes a model out of the world. DeleteEntity took its place.
    "gazebo_msgs/srv/DeleteModel" "RIHS01_cb5cfe8e226608046ebe3ccf4f3415e7934f94feb657c214b1d23546128fdb31"
    DeleteModel, DeleteModelRequest, DeleteModelResponse
}

crate::message! {
    /// Asks where a model or link is and how it moves.
    "gazebo_msgs/srv/GetEntityState_Request" "RIHS01_bc77b7016d9dbcafe72dde7411b1e6f8832bdeb5d1685ed376c3dced89e95e90"
    GetEntityStateRequest {
        /// With scope: model::link.
        name: std::string::String,
        /// Of the answer; none or "world" is the world.
        reference_frame: std::string::String,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/GetEntityState_Response`.
    "gazebo_msgs/srv/GetEntityState_Response" "RIHS01_d1243900ce4d6105ba670a6d85aef918565460d471ffe0e884313ef016f85276"
    GetEntityStateResponse {
        /// header
        header: crate::std_msgs::Header,
        /// state
        state: EntityState,
        /// success
        success: bool,
    }
}

crate::service! {
    /// Asks where a model or link is and how it moves.
    "gazebo_msgs/srv/GetEntityState" "RIHS01_d017d5e9708e99e2260a85bb9ef20d789ae7fb4d205862baea63ef98ac335006"
    GetEntityState, GetEntityStateRequest, GetEntityStateResponse
}

crate::message! {
    /// Asks what a joint is and where it stands.
    "gazebo_msgs/srv/GetJointProperties_Request" "RIHS01_bafda4dff05dc2a949c49a2722d2606e4d001448a9d5133c5cd08011331e174b"
    GetJointPropertiesRequest {
        /// joint_name
        joint_name: std::string::String,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/GetJointProperties_Response`.
    "gazebo_msgs/srv/GetJointProperties_Response" "RIHS01_38a18e73e399e118eb1965bfaf272007dc16ed5fdab747f67bfab703eb1ed431"
    GetJointPropertiesResponse {
        /// One of the values below.
        r#type: u8,
        /// damping
        damping: Vec<f64>,
        /// rad or m.
        position: Vec<f64>,
        /// rad/s or m/s.
        rate: Vec<f64>,
        /// success
        success: bool,
        /// status_message
        status_message: std::string::String,
    }
    /// REVOLUTE
    REVOLUTE: u8 = 0;
    /// CONTINUOUS
    CONTINUOUS: u8 = 1;
    /// PRISMATIC
    PRISMATIC: u8 = 2;
    /// FIXED
    FIXED: u8 = 3;
    /// BALL
    BALL: u8 = 4;
    /// UNIVERSAL
    UNIVERSAL: u8 = 5;
}

crate::service! {
    /// Asks what a joint is and where it stands.
    "gazebo_msgs/srv/GetJointProperties" "RIHS01_512b66bca20439a3110a83ac4ea7b2f5a97d3a3698dbbf58930fd0ac8b99e4e8"
    GetJointProperties, GetJointPropertiesRequest, GetJointPropertiesResponse
}

crate::message! {
    /// Asks how a light shines.
    "gazebo_msgs/srv/GetLightProperties_Request" "RIHS01_8d9955a66253919068fc34f22b4cb97fba2eb40dec0a051adba00a11f9f69107"
    GetLightPropertiesRequest {
        /// light_name
        light_name: std::string::String,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/GetLightProperties_Response`.
    "gazebo_msgs/srv/GetLightProperties_Response" "RIHS01_018fd2e224420c9e0926d1397b63e44398c7bd129eddea33f6c5fe045ee89ca1"
    GetLightPropertiesResponse {
        /// diffuse
        diffuse: crate::std_msgs::ColorRGBA,
        /// attenuation_constant
        attenuation_constant: f64,
        /// attenuation_linear
        attenuation_linear: f64,
        /// attenuation_quadratic
        attenuation_quadratic: f64,
        /// success
        success: bool,
        /// status_message
        status_message: std::string::String,
    }
}

crate::service! {
    /// Asks how a light shines.
    "gazebo_msgs/srv/GetLightProperties" "RIHS01_a91ed19680b3e792983c2c33b0dd066cef0667ee325d9bd2e41c8a268c84458a"
    GetLightProperties, GetLightPropertiesRequest, GetLightPropertiesResponse
}

crate::message! {
    /// Asks for the mass of a link.
    "gazebo_msgs/srv/GetLinkProperties_Request" "RIHS01_92d93ca819beab8f94228ac49e489a728ba0df0d0a46ee5363e85be85080273e"
    GetLinkPropertiesRequest {
        /// With scope: model::link.
        link_name: std::string::String,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/GetLinkProperties_Response`.
    "gazebo_msgs/srv/GetLinkProperties_Response" "RIHS01_455daabd199595563071f1bb6bda7b60697caa8c85299cf917bd34529ab6c136"
    GetLinkPropertiesResponse {
        /// Centre of mass in the frame of the link.
        com: crate::geometry_msgs::Pose,
        /// Whether it falls.
        gravity_mode: bool,
        /// kg.
        mass: f64,
        /// kg m^2.
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
        /// success
        success: bool,
        /// status_message
        status_message: std::string::String,
    }
}

crate::service! {
    /// Asks for the mass of a link.
    "gazebo_msgs/srv/GetLinkProperties" "RIHS01_26899ffb78ddb25e218ce08861962c17a46389effc2eb43032ab7ec11b848a21"
    GetLinkProperties, GetLinkPropertiesRequest, GetLinkPropertiesResponse
}

crate::message! {
    /// Asks where a link is. GetEntityState took its place.
    "gazebo_msgs/srv/GetLinkState_Request" "RIHS01_1107824d9591327063f6512638a3c2158fde832ffbb8ba8c5d2fd1f529d571a5"
    GetLinkStateRequest {
        /// With scope: model::link.
        link_name: std::string::String,
        /// Of the answer; none is the world.
        reference_frame: std::string::String,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/GetLinkState_Response`.
    "gazebo_msgs/srv/GetLinkState_Response" "RIHS01_a7a57f35ad541c7188dc7b0ab2a13e0c438001f213941c6d303a936936cfb554"
    GetLinkStateResponse {
        /// link_state
        link_state: LinkState,
        /// success
        success: bool,
        /// status_message
        status_message: std::string::String,
    }
}

crate::service! {
    /// Asks where a link is. GetEntityState took its place.
    "gazebo_msgs/srv/GetLinkState" "RIHS01_6d88fa6d9e8bca161fe66cf174621974edbb57b1a8eaccabd55a0e87876decb8"
    GetLinkState, GetLinkStateRequest, GetLinkStateResponse
}

crate::message! {
    /// Asks which models there are.
    "gazebo_msgs/srv/GetModelList_Request" "RIHS01_1eb490d15c64b10a36e6b0f1e06191c004f4e23f6d9703bd2dc9a7a47b655333"
    GetModelListRequest {
    }
}

crate::message! {
    /// `gazebo_msgs/srv/GetModelList_Response`.
    "gazebo_msgs/srv/GetModelList_Response" "RIHS01_3d808dbabd03c13c8f2973c97d99eb1076d791ad21f7e5ef73a6b4513162428c"
    GetModelListResponse {
        /// header
        header: crate::std_msgs::Header,
        /// model_names
        model_names: Vec<std::string::String>,
        /// success
        success: bool,
    }
}

crate::service! {
    /// Asks which models there are.
    "gazebo_msgs/srv/GetModelList" "RIHS01_7b19089b52e4e5b9db3fd84042f59e90becb14aa2e7bcd3db378994bcea42257"
    GetModelList, GetModelListRequest, GetModelListResponse
}

crate::message! {
    /// Asks what a model is made of.
    "gazebo_msgs/srv/GetModelProperties_Request" "RIHS01_ad18c002b84d335f82d9e1189b8d46f36b7da1b8dd2c4efe69bddfc9ae9a83a3"
    GetModelPropertiesRequest {
        /// model_name
        model_name: std::string::String,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/GetModelProperties_Response`.
    "gazebo_msgs/srv/GetModelProperties_Response" "RIHS01_b6046f6c1fd2fca24229f7f6351183af170d80808ea9810dd5b39e2d001bf1e2"
    GetModelPropertiesResponse {
        /// parent_model_name
        parent_model_name: std::string::String,
        /// canonical_body_name
        canonical_body_name: std::string::String,
        /// body_names
        body_names: Vec<std::string::String>,
        /// geom_names
        geom_names: Vec<std::string::String>,
        /// joint_names
        joint_names: Vec<std::string::String>,
        /// child_model_names
        child_model_names: Vec<std::string::String>,
        /// is_static
        is_static: bool,
        /// success
        success: bool,
        /// status_message
        status_message: std::string::String,
    }
}

crate::service! {
    /// Asks what a model is made of.
    "gazebo_msgs/srv/GetModelProperties" "RIHS01_49525097678f4c00f1d0b1f79649f4b212403225dce6e70b959ce52b7336a23f"
    GetModelProperties, GetModelPropertiesRequest, GetModelPropertiesResponse
}

crate::message! {
    /// Asks where a model is. GetEntityState took its place.
    "gazebo_msgs/srv/GetModelState_Request" "RIHS01_a978f3c825df5f68dc5c02b6902c40aecaa4011d5e7004628c30df815df18adb"
    GetModelStateRequest {
        /// model_name
        model_name: std::string::String,
        /// Frame of the answer; none or "world" is the world.
        relative_entity_name: std::string::String,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/GetModelState_Response`.
    "gazebo_msgs/srv/GetModelState_Response" "RIHS01_595ce2391f7dcc2f8532999a03f0e2fedbf7a78dacb9d00ab88282de7f268825"
    GetModelStateResponse {
        /// header
        header: crate::std_msgs::Header,
        /// pose
        pose: crate::geometry_msgs::Pose,
        /// twist
        twist: crate::geometry_msgs::Twist,
        /// success
        success: bool,
        /// status_message
        status_message: std::string::String,
    }
}

crate::service! {
    /// Asks where a model is. GetEntityState took its place.
    "gazebo_msgs/srv/GetModelState" "RIHS01_5ca09340037d6856548fd2d277f783afff306854aefe710f39bfb322458dfefd"
    GetModelState, GetModelStateRequest, GetModelStateResponse
}

crate::message! {
    /// Asks how the world is stepped.
    "gazebo_msgs/srv/GetPhysicsProperties_Request" "RIHS01_f5f624293c626dc75b3f7162c7fa287e93dc8443671f6c7b0c20f66d301003fd"
    GetPhysicsPropertiesRequest {
    }
}

crate::message! {
    /// `gazebo_msgs/srv/GetPhysicsProperties_Response`.
    "gazebo_msgs/srv/GetPhysicsProperties_Response" "RIHS01_6c527747a9058ee062cb15e9f6bb5150d6d473a05d13eb186e58abea9728e6a7"
    GetPhysicsPropertiesResponse {
        /// s.
        time_step: f64,
        /// Whether time stands still.
        pause: bool,
        /// Steps in a second of the wall; 0: as fast as can be.
        max_update_rate: f64,
        /// m/s^2.
        gravity: crate::geometry_msgs::Vector3,
        /// ode_config
        ode_config: ODEPhysics,
        /// success
        success: bool,
        /// status_message
        status_message: std::string::String,
    }
}

crate::service! {
    /// Asks how the world is stepped.
    "gazebo_msgs/srv/GetPhysicsProperties" "RIHS01_209d805dac6540877d312c21b6b3594913bdb97e337728e82581b6f7eb9c65ae"
    GetPhysicsProperties, GetPhysicsPropertiesRequest, GetPhysicsPropertiesResponse
}

crate::message! {
    /// Asks for time and models. GetModelList took its place.
    "gazebo_msgs/srv/GetWorldProperties_Request" "RIHS01_516d51bfa0e7f7336f5495555020d4fbc5f58550d1d6898fe6a55f658f9956ac"
    GetWorldPropertiesRequest {
    }
}

crate::message! {
    /// `gazebo_msgs/srv/GetWorldProperties_Response`.
    "gazebo_msgs/srv/GetWorldProperties_Response" "RIHS01_86e62c6972cbf6348905a1d302a54bb08ccb2020754d3d93e8c971789814362f"
    GetWorldPropertiesResponse {
        /// s.
        sim_time: f64,
        /// model_names
        model_names: Vec<std::string::String>,
        /// Whether cameras work.
        rendering_enabled: bool,
        /// success
        success: bool,
        /// status_message
        status_message: std::string::String,
    }
}

crate::service! {
    /// Asks for time and models. GetModelList took its place.
    "gazebo_msgs/srv/GetWorldProperties" "RIHS01_3df254eed0cb032c48c431d0b9faabd2e04098da15213638ca4e9fa1a7f21569"
    GetWorldProperties, GetWorldPropertiesRequest, GetWorldPropertiesResponse
}

crate::message! {
    /// Names a joint.
    "gazebo_msgs/srv/JointRequest_Request" "RIHS01_d75a9b08ae3ca4208e46c43787da1f869f9dd560cbb141a95d27e531a3bbccc6"
    JointRequestRequest {
        /// joint_name
        joint_name: std::string::String,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/JointRequest_Response`.
    "gazebo_msgs/srv/JointRequest_Response" "RIHS01_212f87ac57b8974b01c3de86164d40d1a79231eff260d41df3780d5e02b9d8c9"
    JointRequestResponse {
    }
}

crate::service! {
    /// Names a joint.
    "gazebo_msgs/srv/JointRequest" "RIHS01_4d05b05dc0795a90eb94ac31bb829a01bd0e0f6a52636fbacf4e87ff90c4943d"
    JointRequest, JointRequestRequest, JointRequestResponse
}

crate::message! {
    /// Names a link.
    "gazebo_msgs/srv/LinkRequest_Request" "RIHS01_64a19130f48c558653d13de90d52131a7881feda7e27f9592200f8f3616f9185"
    LinkRequestRequest {
        /// With scope: model::link.
        link_name: std::string::String,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/LinkRequest_Response`.
    "gazebo_msgs/srv/LinkRequest_Response" "RIHS01_a7e19f1569b077ec9144d46d9a3af83e574e52ef3fe9df9d24f3c45b7f275d6f"
    LinkRequestResponse {
    }
}

crate::service! {
    /// Names a link.
    "gazebo_msgs/srv/LinkRequest" "RIHS01_1689997aa04715635db3c9adcc1e140d16ed1ab86d28b09ba194833b67f008b8"
    LinkRequest, LinkRequestRequest, LinkRequestResponse
}

crate::message! {
    /// Puts a model or link somewhere and sets it moving.
    "gazebo_msgs/srv/SetEntityState_Request" "RIHS01_aabf608dea423b76425a0dcc0ebaac373be41d5040dc415b8169835abbd2be4e"
    SetEntityStateRequest {
        /// state
        state: EntityState,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/SetEntityState_Response`.
    "gazebo_msgs/srv/SetEntityState_Response" "RIHS01_58cb44c3cc936f8eb0bc0a6c3ebd1e1111cace83658077c9e7775d2726e8f869"
    SetEntityStateResponse {
        /// success
        success: bool,
    }
}

crate::service! {
    /// Puts a model or link somewhere and sets it moving.
    "gazebo_msgs/srv/SetEntityState" "RIHS01_a7ec3c56a44484ff2b7fbf0449c4bc39366a93d940f335b891f7851b1c46fdc5"
    SetEntityState, SetEntityStateRequest, SetEntityStateResponse
}

crate::message! {
    /// Changes a joint.
    "gazebo_msgs/srv/SetJointProperties_Request" "RIHS01_16db2a769d6083de0402221a61d54a9c142553e9f345cf06286f7043a0ea63ff"
    SetJointPropertiesRequest {
        /// joint_name
        joint_name: std::string::String,
        /// ode_joint_config
        ode_joint_config: ODEJointProperties,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/SetJointProperties_Response`.
    "gazebo_msgs/srv/SetJointProperties_Response" "RIHS01_7cc2ff10cbf1d8b4229f7c1b7fb4b7de70f6af10fe65d82b22d26efda338bf27"
    SetJointPropertiesResponse {
        /// success
        success: bool,
        /// status_message
        status_message: std::string::String,
    }
}

crate::service! {
    /// Changes a joint.
    "gazebo_msgs/srv/SetJointProperties" "RIHS01_7a8f5721f145da5e51e724d8584bbaf2cec821128ef8ce3fa19cd1d36a5f0656"
    SetJointProperties, SetJointPropertiesRequest, SetJointPropertiesResponse
}

crate::message! {
    /// Moves the joints of a model.
    "gazebo_msgs/srv/SetJointTrajectory_Request" "RIHS01_50a23245d08d13e04e94b0954ec49b2307ac9c26efd9d7d09ad024c555576957"
    SetJointTrajectoryRequest {
        /// model_name
        model_name: std::string::String,
        /// joint_trajectory
        joint_trajectory: crate::trajectory_msgs::JointTrajectory,
        /// model_pose
        model_pose: crate::geometry_msgs::Pose,
        /// Whether model_pose counts.
        set_model_pose: bool,
        /// disable_physics_updates
        disable_physics_updates: bool,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/SetJointTrajectory_Response`.
    "gazebo_msgs/srv/SetJointTrajectory_Response" "RIHS01_f1e624b8bdc881e143eb25becefc38991d5bf5b45de4ac7f874a0cd3f5d83002"
    SetJointTrajectoryResponse {
        /// success
        success: bool,
        /// status_message
        status_message: std::string::String,
    }
}

crate::service! {
    /// Moves the joints of a model.
    "gazebo_msgs/srv/SetJointTrajectory" "RIHS01_d897a6bec711a7f40d6a153ca5a99c4366572790a30a5ad8f87af6997bf70ba7"
    SetJointTrajectory, SetJointTrajectoryRequest, SetJointTrajectoryResponse
}

crate::message! {
    /// Changes how a light shines.
    "gazebo_msgs/srv/SetLightProperties_Request" "RIHS01_8852897a14eba575de1c73fb566be98f060702c38b5690b6a3993ce03a5a5678"
    SetLightPropertiesRequest {
        /// light_name
        light_name: std::string::String,
        /// diffuse
        diffuse: crate::std_msgs::ColorRGBA,
        /// attenuation_constant
        attenuation_constant: f64,
        /// attenuation_linear
        attenuation_linear: f64,
        /// attenuation_quadratic
        attenuation_quadratic: f64,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/SetLightProperties_Response`.
    "gazebo_msgs/srv/SetLightProperties_Response" "RIHS01_5fd1ca1e090b13f13128d759f9e1e8983fd282cc8e27205f2c2f519af7bfa011"
    SetLightPropertiesResponse {
        /// success
        success: bool,
        /// status_message
        status_message: std::string::String,
    }
}

crate::service! {
    /// Changes how a light shines.
    "gazebo_msgs/srv/SetLightProperties" "RIHS01_0f9f2e73a54e9e372274608c302437a4a044c6d489712b1f71af88e8ac9bb529"
    SetLightProperties, SetLightPropertiesRequest, SetLightPropertiesResponse
}

crate::message! {
    /// Gives a link another mass.
    "gazebo_msgs/srv/SetLinkProperties_Request" "RIHS01_c7efc28936dcffdd0515e5122cefc4f187a79208e81c6ffdb473949906a95ad8"
    SetLinkPropertiesRequest {
        /// With scope: model::link.
        link_name: std::string::String,
        /// Centre of mass in the frame of the link.
        com: crate::geometry_msgs::Pose,
        /// Whether it falls.
        gravity_mode: bool,
        /// kg.
        mass: f64,
        /// kg m^2.
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
    /// `gazebo_msgs/srv/SetLinkProperties_Response`.
    "gazebo_msgs/srv/SetLinkProperties_Response" "RIHS01_6dae7168384c978565959dd8da3fc29410ef39101661cda49c3b40207ce8ee49"
    SetLinkPropertiesResponse {
        /// success
        success: bool,
        /// status_message
        status_message: std::string::String,
    }
}

crate::service! {
    /// Gives a link another mass.
    "gazebo_msgs/srv/SetLinkProperties" "RIHS01_a45f545231e53014dc0297f7663c5042796306b9100489a6b13d1012e774a3fc"
    SetLinkProperties, SetLinkPropertiesRequest, SetLinkPropertiesResponse
}

crate::message! {
    /// Puts a link somewhere. SetEntityState took its place.
    "gazebo_msgs/srv/SetLinkState_Request" "RIHS01_a7abd57b7c19005111760ca124bef27d3a28be86da18124e075bef1a5221de9a"
    SetLinkStateRequest {
        /// link_state
        link_state: LinkState,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/SetLinkState_Response`.
    "gazebo_msgs/srv/SetLinkState_Response" "RIHS01_7dc60135664fbcb0b043ef856d501ca9a9dadcf1b145c70ad6c54088f5d47214"
    SetLinkStateResponse {
        /// success
        success: bool,
        /// status_message
        status_message: std::string::String,
    }
}

crate::service! {
    /// Puts a link somewhere. SetEntityState took its place.
    "gazebo_msgs/srv/SetLinkState" "RIHS01_f6899c152b79fdf15a69c42be51e0afe1e7f1c14ff4e36355533a532035ba4cd"
    SetLinkState, SetLinkStateRequest, SetLinkStateResponse
}

crate::message! {
    /// Sets joints of a model.
    "gazebo_msgs/srv/SetModelConfiguration_Request" "RIHS01_c6a7dd7f9d7e227ebf15559a5c7675f456e23ecf339878c7a094cf370ebc49ed"
    SetModelConfigurationRequest {
        /// model_name
        model_name: std::string::String,
        /// No longer used.
        urdf_param_name: std::string::String,
        /// joint_names
        joint_names: Vec<std::string::String>,
        /// rad or m.
        joint_positions: Vec<f64>,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/SetModelConfiguration_Response`.
    "gazebo_msgs/srv/SetModelConfiguration_Response" "RIHS01_fd458145825645c1230ebaf7d146cf7627e954cfe62b2068f966e36a4cab239e"
    SetModelConfigurationResponse {
        /// success
        success: bool,
        /// status_message
        status_message: std::string::String,
    }
}

crate::service! {
    /// Sets joints of a model.
    "gazebo_msgs/srv/SetModelConfiguration" "RIHS01_bce01736373da06cc4795d5146131d75b63651e090d01db89f7bea6f5ec5eaa7"
    SetModelConfiguration, SetModelConfigurationRequest, SetModelConfigurationResponse
}

crate::message! {
    /// Puts a model somewhere. SetEntityState took its place.
    "gazebo_msgs/srv/SetModelState_Request" "RIHS01_a95eb1f405eeec3b2b6f90c1726e00bf7b28a19102dea365d84190376ac8ccb5"
    SetModelStateRequest {
        /// model_state
        model_state: ModelState,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/SetModelState_Response`.
    "gazebo_msgs/srv/SetModelState_Response" "RIHS01_e32cb467d929a08066cc50b36d2ea508c1b231e8b69e4349c5205e6595968194"
    SetModelStateResponse {
        /// success
        success: bool,
        /// status_message
        status_message: std::string::String,
    }
}

crate::service! {
    /// Puts a model somewhere. SetEntityState took its place.
    "gazebo_msgs/srv/SetModelState" "RIHS01_9389ef393c28f5fd4c9550daa48f155543edd8f5ff7de78c65fc909554178c0c"
    SetModelState, SetModelStateRequest, SetModelStateResponse
}

crate::message! {
    /// Says how the world is stepped.
    "gazebo_msgs/srv/SetPhysicsProperties_Request" "RIHS01_cd47d308c82f71d8cff8a9f5ae67b7b65fbb7822adcc5fbfe05574a5619cf4d7"
    SetPhysicsPropertiesRequest {
        /// s.
        time_step: f64,
        /// Steps in a second of the wall; 0: as fast as can be.
        max_update_rate: f64,
        /// m/s^2.
        gravity: crate::geometry_msgs::Vector3,
        /// ode_config
        ode_config: ODEPhysics,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/SetPhysicsProperties_Response`.
    "gazebo_msgs/srv/SetPhysicsProperties_Response" "RIHS01_7e72be9b11e2b83604a51d4532ec0ec1a79b89c6481f8778e0de0880675b85ab"
    SetPhysicsPropertiesResponse {
        /// success
        success: bool,
        /// status_message
        status_message: std::string::String,
    }
}

crate::service! {
    /// Says how the world is stepped.
    "gazebo_msgs/srv/SetPhysicsProperties" "RIHS01_116ec8100c5ea11fae2cf4354ac9d396afae545cef9dcdd071b76836e878e5cf"
    SetPhysicsProperties, SetPhysicsPropertiesRequest, SetPhysicsPropertiesResponse
}

crate::message! {
    /// Puts a model or a light into the world.
    "gazebo_msgs/srv/SpawnEntity_Request" "RIHS01_e4234dfa30bbc73f1888e0791c2bef535b71bbc7fc85f63b27a9a6df86ec1572"
    SpawnEntityRequest {
        /// None: as in the text.
        name: std::string::String,
        /// URDF or SDF.
        xml: std::string::String,
        /// For all its topics.
        robot_namespace: std::string::String,
        /// initial_pose
        initial_pose: crate::geometry_msgs::Pose,
        /// Of initial_pose; none, "world" or "map" is the world.
        reference_frame: std::string::String,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/SpawnEntity_Response`.
    "gazebo_msgs/srv/SpawnEntity_Response" "RIHS01_c6b2fe21707fc02c3a62954046cf16709bdcc9ef02d6a12a57fba9b8d8cb173b"
    SpawnEntityResponse {
        /// success
        success: bool,
        /// status_message
        status_message: std::string::String,
    }
}

crate::service! {
    /// Puts a model or a light into the world.
    "gazebo_msgs/srv/SpawnEntity" "RIHS01_a01b6c5a00d47ced8923b43e9e24764fcaa176d2eac6d88163cdb50a02f6cfb5"
    SpawnEntity, SpawnEntityRequest, SpawnEntityResponse
}

crate::message! {
    /// Puts a model into the world. SpawnEntity took its place.
    "gazebo_msgs/srv/SpawnModel_Request" "RIHS01_0bc8ba40f64986f8582156653522bfa02cc5e747c32a254cc653f958150d75b0"
    SpawnModelRequest {
        /// model_name
        model_name: std::string::String,
        /// URDF or SDF.
        model_xml: std::string::String,
        /// For all its topics.
        model_namespace: std::string::String,
        /// initial_pose
        initial_pose: crate::geometry_msgs::Pose,
        /// Of initial_pose; none, "world" or "map" is the world.
        reference_frame: std::string::String,
    }
}

crate::message! {
    /// `gazebo_msgs/srv/SpawnModel_Response`.
    "gazebo_msgs/srv/SpawnModel_Response" "RIHS01_157fbbfdcd6b395f26cedb61302c75dc9433b57ad16c1bc8b18a95894b111131"
    SpawnModelResponse {
        /// success
        success: bool,
        /// status_message
        status_message: std::string::String,
    }
}

crate::service! {
    /// Puts a model into the world. SpawnEntity took its place.
    "gazebo_msgs/srv/SpawnModel" "RIHS01_644aec98b53fdfc78222bd051d8d1ef1cec3f66715c65f96d2e54e26a8a8d16d"
    SpawnModel, SpawnModelRequest, SpawnModelResponse
}
