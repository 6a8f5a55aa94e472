//! `ros_gz_interfaces`. Made by `cargo xtask codegen`; edit the texts in `interfaces/ros_gz_interfaces`
//! instead.

crate::message! {
    /// What a pitot tube measures.
    "ros_gz_interfaces/msg/AirSpeed" "RIHS01_f370b0d7cc13a385870d7c465fc87998dd37b7f5719e00087fa572058fda2aba"
    AirSpeed {
        /// header
        header: crate::std_msgs::Header,
        /// hPa.
        diff_pressure: f64,
        /// K.
        temperature: f64,
    }
}

crate::message! {
    /// Height and climbing speed.
    "ros_gz_interfaces/msg/Altimeter" "RIHS01_c1e452c867a0dd147e2a612d1f78e5da9675ae5ef75c0950ad1520f004101703"
    Altimeter {
        /// header
        header: crate::std_msgs::Header,
        /// Above the reference; m.
        vertical_position: f64,
        /// m/s.
        vertical_velocity: f64,
        /// m.
        vertical_reference: f64,
    }
}

crate::message! {
    /// What time it is, by three clocks.
    "ros_gz_interfaces/msg/Clock" "RIHS01_ef3e2c08386c13a09d14d8013fa05ee41baeda3a46b1a453f7b257572d236a36"
    Clock {
        /// header
        header: crate::std_msgs::Header,
        /// Of the computer.
        system: crate::builtin_interfaces::Time,
        /// Since the start, on the wall's clock.
        real: crate::builtin_interfaces::Time,
        /// Simulated.
        sim: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// Two shapes that touch.
    "ros_gz_interfaces/msg/Contact" "RIHS01_ba5acbac280b8650f9ad7caf995888ff8aca861742e0159d8d36efe8460d0db3"
    Contact {
        /// collision1
        collision1: Entity,
        /// collision2
        collision2: Entity,
        /// m.
        positions: Vec<crate::geometry_msgs::Vector3>,
        /// normals
        normals: Vec<crate::geometry_msgs::Vector3>,
        /// m.
        depths: Vec<f64>,
        /// wrenches
        wrenches: Vec<JointWrench>,
    }
}

crate::message! {
    /// All that touches.
    "ros_gz_interfaces/msg/Contacts" "RIHS01_2cf36dd51e105580839fb7d6c028846a6342a8dfd62fde733d05f3e0c9ec4b5b"
    Contacts {
        /// header
        header: crate::std_msgs::Header,
        /// contacts
        contacts: Vec<Contact>,
    }
}

crate::message! {
    /// A message over simulated radio.
    "ros_gz_interfaces/msg/Dataframe" "RIHS01_287d299a18c22ef9793bc9f9e72ef6c4c5d4582073043ebfa354aadc37c244a2"
    Dataframe {
        /// header
        header: crate::std_msgs::Header,
        /// src_address
        src_address: std::string::String,
        /// dst_address
        dst_address: std::string::String,
        /// data
        data: Vec<u8>,
        /// Strength of the signal; dBm.
        rssi: f64,
    }
}

crate::message! {
    /// Something in a world.
    "ros_gz_interfaces/msg/Entity" "RIHS01_266a26f377057ebb0a1f08f7fb9dc435a841d9ec4fa3ab8fa0085e66e653504e"
    Entity {
        /// Unique in the world, or 0.
        id: u64,
        /// Full name, where the id is not known.
        name: std::string::String,
        /// One of the values above.
        r#type: u8,
    }
    /// NONE
    NONE: u8 = 0;
    /// LIGHT
    LIGHT: u8 = 1;
    /// MODEL
    MODEL: u8 = 2;
    /// LINK
    LINK: u8 = 3;
    /// VISUAL
    VISUAL: u8 = 4;
    /// COLLISION
    COLLISION: u8 = 5;
    /// SENSOR
    SENSOR: u8 = 6;
    /// JOINT
    JOINT: u8 = 7;
}

crate::message! {
    /// What to put into a world.
    "ros_gz_interfaces/msg/EntityFactory" "RIHS01_30d015e26a60c37f44fcfb19b52b27957020705b0ba314e6ca37a5e0d2f6091d"
    EntityFactory {
        /// name
        name: std::string::String,
        /// Whether another name may be found when this one is taken.
        allow_renaming: bool = false,
        /// The model as text ...
        sdf: std::string::String,
        /// ... or its file ...
        sdf_filename: std::string::String,
        /// ... or which model to copy.
        clone_name: std::string::String,
        /// pose
        pose: crate::geometry_msgs::Pose,
        /// The frame of the pose.
        relative_to: std::string::String = "world".into(),
    }
}

crate::message! {
    /// A force on something.
    "ros_gz_interfaces/msg/EntityWrench" "RIHS01_e5ae40a0b9b52ab05c611ab561b24b9c2f9a24f6296951f0f03442d0cc351221"
    EntityWrench {
        /// header
        header: crate::std_msgs::Header,
        /// entity
        entity: Entity,
        /// wrench
        wrench: crate::geometry_msgs::Wrench,
    }
}

crate::message! {
    /// Numbers.
    "ros_gz_interfaces/msg/Float32Array" "RIHS01_8114db062e00379eb805879d9440d10beb7000352ad92bdc4e1385d988bd6cd9"
    Float32Array {
        /// data
        data: Vec<f32>,
    }
}

crate::message! {
    /// The camera of the window.
    "ros_gz_interfaces/msg/GuiCamera" "RIHS01_517316a3df653203b2172b52a24aa541f569d88d69f77a1994e41635c0b8ce6b"
    GuiCamera {
        /// header
        header: crate::std_msgs::Header,
        /// name
        name: std::string::String,
        /// view_controller
        view_controller: std::string::String,
        /// pose
        pose: crate::geometry_msgs::Pose,
        /// track
        track: TrackVisual,
        /// perspective or orthographic.
        projection_type: std::string::String,
    }
}

crate::message! {
    /// The forces between two bodies.
    "ros_gz_interfaces/msg/JointWrench" "RIHS01_aa50610f0bc1a9f1f42a04e6d76da729968d0f91b62f48b2040c4dc866c02686"
    JointWrench {
        /// header
        header: crate::std_msgs::Header,
        /// body_1_name
        body_1_name: crate::std_msgs::String,
        /// body_1_id
        body_1_id: crate::std_msgs::UInt32,
        /// body_2_name
        body_2_name: crate::std_msgs::String,
        /// body_2_id
        body_2_id: crate::std_msgs::UInt32,
        /// body_1_wrench
        body_1_wrench: crate::geometry_msgs::Wrench,
        /// body_2_wrench
        body_2_wrench: crate::geometry_msgs::Wrench,
    }
}

crate::message! {
    /// A lamp.
    "ros_gz_interfaces/msg/Light" "RIHS01_8efb44b207981d0c23827eae2490a4c4700c5e872f0151f0e6dd09aab4919f93"
    Light {
        /// header
        header: crate::std_msgs::Header,
        /// name
        name: std::string::String,
        /// One of the values above.
        r#type: u8,
        /// pose
        pose: crate::geometry_msgs::Pose,
        /// diffuse
        diffuse: crate::std_msgs::ColorRGBA,
        /// specular
        specular: crate::std_msgs::ColorRGBA,
        /// attenuation_constant
        attenuation_constant: f32,
        /// attenuation_linear
        attenuation_linear: f32,
        /// attenuation_quadratic
        attenuation_quadratic: f32,
        /// direction
        direction: crate::geometry_msgs::Vector3,
        /// m.
        range: f32,
        /// cast_shadows
        cast_shadows: bool,
        /// rad.
        spot_inner_angle: f32,
        /// rad.
        spot_outer_angle: f32,
        /// spot_falloff
        spot_falloff: f32,
        /// id
        id: u32,
        /// parent_id
        parent_id: u32,
        /// intensity
        intensity: f32,
    }
    /// POINT
    POINT: u8 = 0;
    /// SPOT
    SPOT: u8 = 1;
    /// DIRECTIONAL
    DIRECTIONAL: u8 = 2;
}

crate::message! {
    /// From when to when a log goes that is played.
    "ros_gz_interfaces/msg/LogPlaybackStatistics" "RIHS01_f5614a5b25cf3729762dcf099fee128c43004c656369254979a63e30e230730c"
    LogPlaybackStatistics {
        /// header
        header: crate::std_msgs::Header,
        /// start_time
        start_time: crate::builtin_interfaces::Time,
        /// end_time
        end_time: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// Which models a logical camera sees.
    "ros_gz_interfaces/msg/LogicalCameraImage" "RIHS01_182c20bcbe04e080e79b496c6a2d1dcdd1773ad64048b245e2a21f7d46bd0d70"
    LogicalCameraImage {
        /// header
        header: crate::std_msgs::Header,
        /// Of the camera.
        pose: crate::geometry_msgs::Pose,
        /// model
        model: Vec<LogicalCameraImageModel>,
    }
}

crate::message! {
    /// A model that a logical camera sees.
    "ros_gz_interfaces/msg/LogicalCameraImageModel" "RIHS01_2e52e5ada28f48848f9c94471af5076d2a8b59d716531fa679ce6f42b3546834"
    LogicalCameraImageModel {
        /// name
        name: std::string::String,
        /// In the frame of the camera.
        pose: crate::geometry_msgs::Pose,
    }
}

crate::message! {
    /// New colours for something.
    "ros_gz_interfaces/msg/MaterialColor" "RIHS01_54b65af3b212e12850320fb8720cd067cb74d961cab813918fa0c94617db3913"
    MaterialColor {
        /// header
        header: crate::std_msgs::Header,
        /// entity
        entity: Entity,
        /// ambient
        ambient: crate::std_msgs::ColorRGBA,
        /// diffuse
        diffuse: crate::std_msgs::ColorRGBA,
        /// specular
        specular: crate::std_msgs::ColorRGBA,
        /// emissive
        emissive: crate::std_msgs::ColorRGBA,
        /// shininess
        shininess: f64,
        /// FIRST or ALL of those with that name.
        entity_match: u8,
    }
    /// FIRST
    FIRST: u8 = 0;
    /// ALL
    ALL: u8 = 1;
}

crate::message! {
    /// Named values.
    "ros_gz_interfaces/msg/ParamVec" "RIHS01_e178b08d6f1698eb6231c68e41f510de8de525d842d08ddc7e2022bb8b7d4049"
    ParamVec {
        /// header
        header: crate::std_msgs::Header,
        /// params
        params: Vec<crate::rcl_interfaces::Parameter>,
    }
}

crate::message! {
    /// New noise for a sensor.
    "ros_gz_interfaces/msg/SensorNoise" "RIHS01_caf76df5c8960d6c28ebf8318dd750d94e3871f2ce15b088b5e9f6d99a6cf089"
    SensorNoise {
        /// header
        header: crate::std_msgs::Header,
        /// One of the values above.
        r#type: u8,
        /// mean
        mean: f64,
        /// stddev
        stddev: f64,
        /// bias_mean
        bias_mean: f64,
        /// bias_stddev
        bias_stddev: f64,
        /// precision
        precision: f64,
        /// dynamic_bias_stddev
        dynamic_bias_stddev: f64,
        /// s.
        dynamic_bias_correlation_time: f64,
    }
    /// NONE
    NONE: u8 = 0;
    /// GAUSSIAN
    GAUSSIAN: u8 = 2;
    /// GAUSSIAN_QUANTIZED
    GAUSSIAN_QUANTIZED: u8 = 3;
}

crate::message! {
    /// Texts.
    "ros_gz_interfaces/msg/StringVec" "RIHS01_5f2bf8ca5da2ee2c29754944d8adef28e1ceb3ac6f1f05528fcda79573b8c141"
    StringVec {
        /// header
        header: crate::std_msgs::Header,
        /// data
        data: Vec<std::string::String>,
    }
}

crate::message! {
    /// How a camera of the window follows something.
    "ros_gz_interfaces/msg/TrackVisual" "RIHS01_ae5d68f113b35256f39620458d80e631509bd71ac66fc0d5a62b754af23ae2a3"
    TrackVisual {
        /// header
        header: crate::std_msgs::Header,
        /// name
        name: std::string::String,
        /// id
        id: u32,
        /// inherit_orientation
        inherit_orientation: bool,
        /// m.
        min_dist: f64,
        /// m.
        max_dist: f64,
        /// is_static
        is_static: bool,
        /// use_model_frame
        use_model_frame: bool,
        /// m.
        xyz: crate::geometry_msgs::Vector3,
        /// inherit_yaw
        inherit_yaw: bool,
    }
}

crate::message! {
    /// Starts or stops a video.
    "ros_gz_interfaces/msg/VideoRecord" "RIHS01_2fb8561d04087009ab48b71e47157827292c9a2f0e5e89ea7e4b29839708df59"
    VideoRecord {
        /// header
        header: crate::std_msgs::Header,
        /// start
        start: bool,
        /// stop
        stop: bool,
        /// format
        format: std::string::String,
        /// save_filename
        save_filename: std::string::String,
    }
}

crate::message! {
    /// Pauses, steps and resets a world.
    "ros_gz_interfaces/msg/WorldControl" "RIHS01_5ab5d57c81967008a869636e532ec8b8a1afb1a7ddb38a38e92053d032dd2145"
    WorldControl {
        /// pause
        pause: bool,
        /// step
        step: bool,
        /// How many steps.
        multi_step: u32 = 0,
        /// reset
        reset: WorldReset,
        /// seed
        seed: u32,
        /// run_to_sim_time
        run_to_sim_time: crate::builtin_interfaces::Time,
    }
}

crate::message! {
    /// What to set back.
    "ros_gz_interfaces/msg/WorldReset" "RIHS01_3c89a38589db6e493cc132aa44b69ac7f49c9ffc0770f51883500da1f5b4275e"
    WorldReset {
        /// all
        all: bool = false,
        /// time_only
        time_only: bool = false,
        /// model_only
        model_only: bool = false,
    }
}

crate::message! {
    /// How a simulation runs.
    "ros_gz_interfaces/msg/WorldStatistics" "RIHS01_5335d33b3320a2559cf0c3fc7648af056139c9626e5d0a768ba47477d3b81a94"
    WorldStatistics {
        /// header
        header: crate::std_msgs::Header,
        /// sim_time
        sim_time: crate::builtin_interfaces::Time,
        /// How long it stood still, on the wall's clock.
        pause_time: crate::builtin_interfaces::Time,
        /// How long it ran, on the wall's clock.
        real_time: crate::builtin_interfaces::Time,
        /// paused
        paused: bool,
        /// Steps since the start.
        iterations: u64,
        /// model_count
        model_count: i32,
        /// log_playback_statistics
        log_playback_statistics: LogPlaybackStatistics,
        /// Simulated seconds in a second of the wall.
        real_time_factor: f64,
        /// step_size
        step_size: crate::builtin_interfaces::Time,
        /// Whether it goes only the steps that were asked for.
        stepping: bool,
    }
}

crate::message! {
    /// Joins a model to another, or frees it.
    "ros_gz_interfaces/srv/AttachDetach_Request" "RIHS01_084c48b3e495c954d68fd43df4af956dc11ff58e25bc6e6e6a98f8fe868ff907"
    AttachDetachRequest {
        /// child_model_name
        child_model_name: std::string::String,
        /// child_link_name
        child_link_name: std::string::String,
        /// One of the values above.
        command: u8,
    }
    /// COMMAND_UNSPECIFIED
    COMMAND_UNSPECIFIED: u8 = 0;
    /// ATTACH
    ATTACH: u8 = 1;
    /// DETACH
    DETACH: u8 = 2;
}

crate::message! {
    /// `ros_gz_interfaces/srv/AttachDetach_Response`.
    "ros_gz_interfaces/srv/AttachDetach_Response" "RIHS01_839bf71e4e7b4ed7955422c713a6308eb0d8c9a9ef6e3463256d88876d977aad"
    AttachDetachResponse {
        /// error_code
        error_code: i32,
        /// message
        message: std::string::String,
    }
}

crate::service! {
    /// Joins a model to another, or frees it.
    "ros_gz_interfaces/srv/AttachDetach" "RIHS01_da6eb644f97fe3f50270f4b2d4520abb760289077ec1232ceed03c9276eff137"
    AttachDetach, AttachDetachRequest, AttachDetachResponse
}

crate::message! {
    /// Pauses, steps and resets a world.
    "ros_gz_interfaces/srv/ControlWorld_Request" "RIHS01_966e36121ac784a9f0bbab683a4bff9a1d502682d1e781e4381b7d7b29699c34"
    ControlWorldRequest {
        /// world_control
        world_control: WorldControl,
    }
}

crate::message! {
    /// `ros_gz_interfaces/srv/ControlWorld_Response`.
    "ros_gz_interfaces/srv/ControlWorld_Response" "RIHS01_7e58bff99e11cf382aec95a108ff43097b8196a3747c6fd8e2485245ee1aeeb8"
    ControlWorldResponse {
        /// success
        success: bool,
    }
}

crate::service! {
    /// Pauses, steps and resets a world.
    "ros_gz_interfaces/srv/ControlWorld" "RIHS01_057cd1cd69ccd13a18dd304595e3cd31d57af3bbb69186c3e21577a6e5d5d282"
    ControlWorld, ControlWorldRequest, ControlWorldResponse
}

crate::message! {
    /// Takes something out of a world.
    "ros_gz_interfaces/srv/DeleteEntity_Request" "RIHS01_ea205b62f7792b2b51b1430035ee0d744226a8c684cdc72e49a6346735c35cc3"
    DeleteEntityRequest {
        /// entity
        entity: Entity,
    }
}

crate::message! {
    /// `ros_gz_interfaces/srv/DeleteEntity_Response`.
    "ros_gz_interfaces/srv/DeleteEntity_Response" "RIHS01_49f2d1e3ca6b915ffb9953fd0d0dfa9195ce6142f9907d8f8ba5ca3dff1eccc9"
    DeleteEntityResponse {
        /// success
        success: bool,
    }
}

crate::service! {
    /// Takes something out of a world.
    "ros_gz_interfaces/srv/DeleteEntity" "RIHS01_81761ca6f55a4234530e8b82da89b57c9400ee8b5a9b747766aec8e921d9d820"
    DeleteEntity, DeleteEntityRequest, DeleteEntityResponse
}

crate::message! {
    /// Puts something elsewhere.
    "ros_gz_interfaces/srv/SetEntityPose_Request" "RIHS01_320033faa965d51aa4c0afb2b672d9646787398081bbcdf511e4658ce2320a19"
    SetEntityPoseRequest {
        /// entity
        entity: Entity,
        /// pose
        pose: crate::geometry_msgs::Pose,
    }
}

crate::message! {
    /// `ros_gz_interfaces/srv/SetEntityPose_Response`.
    "ros_gz_interfaces/srv/SetEntityPose_Response" "RIHS01_8aeff2587ea63b93264a5309a80888b0e5360d92786e4862e026d16dd07ebea0"
    SetEntityPoseResponse {
        /// success
        success: bool,
    }
}

crate::service! {
    /// Puts something elsewhere.
    "ros_gz_interfaces/srv/SetEntityPose" "RIHS01_abe4bc11c7e7955ec1b4ea7f9456b4928b629b12071b911d48745c071483498f"
    SetEntityPose, SetEntityPoseRequest, SetEntityPoseResponse
}

crate::message! {
    /// Puts something into a world.
    "ros_gz_interfaces/srv/SpawnEntity_Request" "RIHS01_2ea1b7a0ee75a4357620c6a55981a09380fda7f04b5b3acada61dd9e98aaa758"
    SpawnEntityRequest {
        /// entity_factory
        entity_factory: EntityFactory,
    }
}

crate::message! {
    /// `ros_gz_interfaces/srv/SpawnEntity_Response`.
    "ros_gz_interfaces/srv/SpawnEntity_Response" "RIHS01_1240305e6f4a99678706284e1d569bf60f0f8b3beac180fda8c1af5df4f50d0f"
    SpawnEntityResponse {
        /// success
        success: bool,
    }
}

crate::service! {
    /// Puts something into a world.
    "ros_gz_interfaces/srv/SpawnEntity" "RIHS01_5723a17a5fd50febee91c2f668058fbcbf3c91b66473196f16190f469e9a4e92"
    SpawnEntity, SpawnEntityRequest, SpawnEntityResponse
}
