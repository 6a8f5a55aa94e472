//! `sensor_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/sensor_msgs`
//! instead.

crate::message! {
    /// A battery; what is not measured is not a number.
    "sensor_msgs/msg/BatteryState" "RIHS01_4bee5dfce981c98faa6828b868307a0a73f992ed0789f374ee96c8f840e69741"
    BatteryState {
        /// header
        header: crate::std_msgs::Header,
        /// V.
        voltage: f32,
        /// Degrees Celsius.
        temperature: f32,
        /// A; negative while it empties.
        current: f32,
        /// A h.
        charge: f32,
        /// When last full; A h.
        capacity: f32,
        /// When new; A h.
        design_capacity: f32,
        /// 0 to 1.
        percentage: f32,
        /// power_supply_status
        power_supply_status: u8,
        /// power_supply_health
        power_supply_health: u8,
        /// power_supply_technology
        power_supply_technology: u8,
        /// present
        present: bool,
        /// V.
        cell_voltage: Vec<f32>,
        /// Degrees Celsius.
        cell_temperature: Vec<f32>,
        /// Where in the robot.
        location: std::string::String,
        /// serial_number
        serial_number: std::string::String,
    }
    /// POWER_SUPPLY_STATUS_UNKNOWN
    POWER_SUPPLY_STATUS_UNKNOWN: u8 = 0;
    /// POWER_SUPPLY_STATUS_CHARGING
    POWER_SUPPLY_STATUS_CHARGING: u8 = 1;
    /// POWER_SUPPLY_STATUS_DISCHARGING
    POWER_SUPPLY_STATUS_DISCHARGING: u8 = 2;
    /// POWER_SUPPLY_STATUS_NOT_CHARGING
    POWER_SUPPLY_STATUS_NOT_CHARGING: u8 = 3;
    /// POWER_SUPPLY_STATUS_FULL
    POWER_SUPPLY_STATUS_FULL: u8 = 4;
    /// POWER_SUPPLY_HEALTH_UNKNOWN
    POWER_SUPPLY_HEALTH_UNKNOWN: u8 = 0;
    /// POWER_SUPPLY_HEALTH_GOOD
    POWER_SUPPLY_HEALTH_GOOD: u8 = 1;
    /// POWER_SUPPLY_HEALTH_OVERHEAT
    POWER_SUPPLY_HEALTH_OVERHEAT: u8 = 2;
    /// POWER_SUPPLY_HEALTH_DEAD
    POWER_SUPPLY_HEALTH_DEAD: u8 = 3;
    /// POWER_SUPPLY_HEALTH_OVERVOLTAGE
    POWER_SUPPLY_HEALTH_OVERVOLTAGE: u8 = 4;
    /// POWER_SUPPLY_HEALTH_UNSPEC_FAILURE
    POWER_SUPPLY_HEALTH_UNSPEC_FAILURE: u8 = 5;
    /// POWER_SUPPLY_HEALTH_COLD
    POWER_SUPPLY_HEALTH_COLD: u8 = 6;
    /// POWER_SUPPLY_HEALTH_WATCHDOG_TIMER_EXPIRE
    POWER_SUPPLY_HEALTH_WATCHDOG_TIMER_EXPIRE: u8 = 7;
    /// POWER_SUPPLY_HEALTH_SAFETY_TIMER_EXPIRE
    POWER_SUPPLY_HEALTH_SAFETY_TIMER_EXPIRE: u8 = 8;
    /// POWER_SUPPLY_TECHNOLOGY_UNKNOWN
    POWER_SUPPLY_TECHNOLOGY_UNKNOWN: u8 = 0;
    /// POWER_SUPPLY_TECHNOLOGY_NIMH
    POWER_SUPPLY_TECHNOLOGY_NIMH: u8 = 1;
    /// POWER_SUPPLY_TECHNOLOGY_LION
    POWER_SUPPLY_TECHNOLOGY_LION: u8 = 2;
    /// POWER_SUPPLY_TECHNOLOGY_LIPO
    POWER_SUPPLY_TECHNOLOGY_LIPO: u8 = 3;
    /// POWER_SUPPLY_TECHNOLOGY_LIFE
    POWER_SUPPLY_TECHNOLOGY_LIFE: u8 = 4;
    /// POWER_SUPPLY_TECHNOLOGY_NICD
    POWER_SUPPLY_TECHNOLOGY_NICD: u8 = 5;
    /// POWER_SUPPLY_TECHNOLOGY_LIMN
    POWER_SUPPLY_TECHNOLOGY_LIMN: u8 = 6;
    /// POWER_SUPPLY_TECHNOLOGY_TERNARY
    POWER_SUPPLY_TECHNOLOGY_TERNARY: u8 = 7;
    /// POWER_SUPPLY_TECHNOLOGY_VRLA
    POWER_SUPPLY_TECHNOLOGY_VRLA: u8 = 8;
}

crate::message! {
    /// How a camera maps space to its image.
    "sensor_msgs/msg/CameraInfo" "RIHS01_b3dfd68ff46c9d56c80fd3bd4ed22c7a4ddce8c8348f2f59c299e73118e7e275"
    CameraInfo {
        /// Of the image; the frame is the optical one: z ahead, x right, y down.
        header: crate::std_msgs::Header,
        /// Pixels.
        height: u32,
        /// Pixels.
        width: u32,
        /// Such as plumb_bob, rational_polynomial or equidistant.
        distortion_model: std::string::String,
        /// Numbers of the distortion model.
        d: Vec<f64>,
        /// Row by row: fx 0 cx, 0 fy cy, 0 0 1; pixels.
        k: [f64; 9],
        /// Row by row: rotation that makes the rows of a stereo pair level.
        r: [f64; 9],
        /// Row by row: projection of the rectified image, with -fx times the baseline at the right.
        p: [f64; 12],
        /// Pixels joined to one; 0 means 1.
        binning_x: u32,
        /// Pixels joined to one; 0 means 1.
        binning_y: u32,
        /// roi
        roi: RegionOfInterest,
    }
}

crate::message! {
    /// One more number for each point of a PointCloud.
    "sensor_msgs/msg/ChannelFloat32" "RIHS01_92665437ddf39346f4ba39ee32e648390605b633cc077d40f4bd4d7b58af6cd4"
    ChannelFloat32 {
        /// name
        name: std::string::String,
        /// values
        values: Vec<f32>,
    }
}

crate::message! {
    /// An image in the form of a picture file.
    "sensor_msgs/msg/CompressedImage" "RIHS01_15640771531571185e2efc8a100baf923961a4d15d5569652e6cb6691e8e371a"
    CompressedImage {
        /// header
        header: crate::std_msgs::Header,
        /// Such as jpeg or png.
        format: std::string::String,
        /// data
        data: Vec<u8>,
    }
}

crate::message! {
    /// Pressure of air or water.
    "sensor_msgs/msg/FluidPressure" "RIHS01_22dfb2b145a0bd5a31a1ac3882a1b32148b51d9b2f3bab250290d66f3595bc32"
    FluidPressure {
        /// header
        header: crate::std_msgs::Header,
        /// Pa.
        fluid_pressure: f64,
        /// Pa2; 0 when unknown.
        variance: f64,
    }
}

crate::message! {
    /// Brightness.
    "sensor_msgs/msg/Illuminance" "RIHS01_b954b25f452fcf81a91c9c2a7e3b3fd85c4c873d452aecb3cfd8fd1da732a22d"
    Illuminance {
        /// header
        header: crate::std_msgs::Header,
        /// lx.
        illuminance: f64,
        /// variance
        variance: f64,
    }
}

crate::message! {
    /// An image without compression.
    "sensor_msgs/msg/Image" "RIHS01_d31d41a9a4c4bc8eae9be757b0beed306564f7526c88ea6a4588fb9582527d47"
    Image {
        /// Time of exposure, and the optical frame: z ahead, x right, y down.
        header: crate::std_msgs::Header,
        /// Rows.
        height: u32,
        /// Columns.
        width: u32,
        /// Such as rgb8, bgr8, mono8, 16UC1 or 32FC1.
        encoding: std::string::String,
        /// is_bigendian
        is_bigendian: u8,
        /// Bytes of a row.
        step: u32,
        /// Row by row.
        data: Vec<u8>,
    }
}

crate::message! {
    /// Orientation, turning and acceleration.
    "sensor_msgs/msg/Imu" "RIHS01_7d9a00ff131080897a5ec7e26e315954b8eae3353c3f995c55faf71574000b5b"
    Imu {
        /// header
        header: crate::std_msgs::Header,
        /// orientation
        orientation: crate::geometry_msgs::Quaternion,
        /// Row by row, rad2; -1 at first when there is no orientation.
        orientation_covariance: [f64; 9],
        /// rad/s.
        angular_velocity: crate::geometry_msgs::Vector3,
        /// Row by row; -1 at first when there is none.
        angular_velocity_covariance: [f64; 9],
        /// m/s2, with gravity: at rest it points up.
        linear_acceleration: crate::geometry_msgs::Vector3,
        /// Row by row; -1 at first when there is none.
        linear_acceleration_covariance: [f64; 9],
    }
}

crate::message! {
    /// How joints stand; lists that are not known are empty.
    "sensor_msgs/msg/JointState" "RIHS01_a13ee3a330e346c9d87b5aa18d24e11690752bd33a0350f11c5882bc9179260e"
    JointState {
        /// header
        header: crate::std_msgs::Header,
        /// name
        name: Vec<std::string::String>,
        /// rad or m.
        position: Vec<f64>,
        /// rad/s or m/s.
        velocity: Vec<f64>,
        /// N m or N.
        effort: Vec<f64>,
    }
}

crate::message! {
    /// Axes and buttons of a joystick.
    "sensor_msgs/msg/Joy" "RIHS01_0d356c79cad3401e35ffeb75a96a96e08be3ef896b8b83841d73e890989372c5"
    Joy {
        /// header
        header: crate::std_msgs::Header,
        /// -1 to 1.
        axes: Vec<f32>,
        /// buttons
        buttons: Vec<i32>,
    }
}

crate::message! {
    /// Light, rumble or sound of a joystick.
    "sensor_msgs/msg/JoyFeedback" "RIHS01_231dd362f71d6fc08272770d07120ad5fe5874ce2dbac70109b28986834290cd"
    JoyFeedback {
        /// type
        r#type: u8,
        /// id
        id: u8,
        /// 0 to 1.
        intensity: f32,
    }
    /// TYPE_LED
    TYPE_LED: u8 = 0;
    /// TYPE_RUMBLE
    TYPE_RUMBLE: u8 = 1;
    /// TYPE_BUZZER
    TYPE_BUZZER: u8 = 2;
}

crate::message! {
    /// Several feedbacks for a joystick.
    "sensor_msgs/msg/JoyFeedbackArray" "RIHS01_3287c32e1b688cae04555e465443df3cca7dae76ee4ebf85c4658d585037bcaa"
    JoyFeedbackArray {
        /// array
        array: Vec<JoyFeedback>,
    }
}

crate::message! {
    /// The echoes of one beam.
    "sensor_msgs/msg/LaserEcho" "RIHS01_0fbc05a0db7d37fe52c0f0375356db55da0046f7ef5bd27ca6b34bd0582bc952"
    LaserEcho {
        /// echoes
        echoes: Vec<f32>,
    }
}

crate::message! {
    /// One turn of a laser that looks in a plane.
    "sensor_msgs/msg/LaserScan" "RIHS01_64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828"
    LaserScan {
        /// Time of the first beam; angles are about the frame's z, 0 along its x.
        header: crate::std_msgs::Header,
        /// Of the first beam; rad.
        angle_min: f32,
        /// Of the last beam; rad.
        angle_max: f32,
        /// Between beams; rad.
        angle_increment: f32,
        /// Between beams; s.
        time_increment: f32,
        /// Between scans; s.
        scan_time: f32,
        /// m.
        range_min: f32,
        /// m.
        range_max: f32,
        /// m; infinite when nothing was hit, -infinite when too near.
        ranges: Vec<f32>,
        /// As the device gives them, or empty.
        intensities: Vec<f32>,
    }
}

crate::message! {
    /// The magnetic field.
    "sensor_msgs/msg/MagneticField" "RIHS01_e80f32f56a20486c9923008fc1a1db07bbb273cbbf6a5b3bfa00835ee00e4dff"
    MagneticField {
        /// header
        header: crate::std_msgs::Header,
        /// T.
        magnetic_field: crate::geometry_msgs::Vector3,
        /// magnetic_field_covariance
        magnetic_field_covariance: [f64; 9],
    }
}

crate::message! {
    /// How joints with several axes stand.
    "sensor_msgs/msg/MultiDOFJointState" "RIHS01_4d4ded702cfba7ff3ec783835c1a1425f75e53939a430ff355d1fee4b3bbc40b"
    MultiDOFJointState {
        /// header
        header: crate::std_msgs::Header,
        /// joint_names
        joint_names: Vec<std::string::String>,
        /// transforms
        transforms: Vec<crate::geometry_msgs::Transform>,
        /// twist
        twist: Vec<crate::geometry_msgs::Twist>,
        /// wrench
        wrench: Vec<crate::geometry_msgs::Wrench>,
    }
}

crate::message! {
    /// One turn of a laser with several echoes for each beam.
    "sensor_msgs/msg/MultiEchoLaserScan" "RIHS01_ba5eac341cd5bbb2701527aa4568e8baec172b69cadb9a1945d6f149d087ee48"
    MultiEchoLaserScan {
        /// header
        header: crate::std_msgs::Header,
        /// angle_min
        angle_min: f32,
        /// angle_max
        angle_max: f32,
        /// angle_increment
        angle_increment: f32,
        /// time_increment
        time_increment: f32,
        /// scan_time
        scan_time: f32,
        /// range_min
        range_min: f32,
        /// range_max
        range_max: f32,
        /// ranges
        ranges: Vec<LaserEcho>,
        /// intensities
        intensities: Vec<LaserEcho>,
    }
}

crate::message! {
    /// A place on Earth.
    "sensor_msgs/msg/NavSatFix" "RIHS01_62223ab3fe210a15976021da7afddc9e200dc9ec75231c1b6a557fc598a65404"
    NavSatFix {
        /// header
        header: crate::std_msgs::Header,
        /// status
        status: NavSatStatus,
        /// Degrees, north.
        latitude: f64,
        /// Degrees, east.
        longitude: f64,
        /// Above the WGS 84 ellipsoid; m.
        altitude: f64,
        /// Row by row; east, north, up; m2.
        position_covariance: [f64; 9],
        /// position_covariance_type
        position_covariance_type: u8,
    }
    /// COVARIANCE_TYPE_UNKNOWN
    COVARIANCE_TYPE_UNKNOWN: u8 = 0;
    /// COVARIANCE_TYPE_APPROXIMATED
    COVARIANCE_TYPE_APPROXIMATED: u8 = 1;
    /// COVARIANCE_TYPE_DIAGONAL_KNOWN
    COVARIANCE_TYPE_DIAGONAL_KNOWN: u8 = 2;
    /// COVARIANCE_TYPE_KNOWN
    COVARIANCE_TYPE_KNOWN: u8 = 3;
}

crate::message! {
    /// How a place on Earth was found.
    "sensor_msgs/msg/NavSatStatus" "RIHS01_d1ed3befa628e09571bd273b888ba1c1fd187c9a5e0006b385d7e5e9095a3204"
    NavSatStatus {
        /// status
        status: i8 = -2,
        /// service
        service: u16,
    }
    /// STATUS_UNKNOWN
    STATUS_UNKNOWN: i8 = -2;
    /// STATUS_NO_FIX
    STATUS_NO_FIX: i8 = -1;
    /// STATUS_FIX
    STATUS_FIX: i8 = 0;
    /// STATUS_SBAS_FIX
    STATUS_SBAS_FIX: i8 = 1;
    /// STATUS_GBAS_FIX
    STATUS_GBAS_FIX: i8 = 2;
    /// SERVICE_UNKNOWN
    SERVICE_UNKNOWN: u16 = 0;
    /// SERVICE_GPS
    SERVICE_GPS: u16 = 1;
    /// SERVICE_GLONASS
    SERVICE_GLONASS: u16 = 2;
    /// SERVICE_COMPASS
    SERVICE_COMPASS: u16 = 4;
    /// SERVICE_GALILEO
    SERVICE_GALILEO: u16 = 8;
}

crate::message! {
    /// Points with channels; PointCloud2 has taken its place.
    "sensor_msgs/msg/PointCloud" "RIHS01_614593df71d3c2b9bd4604a71b750fd218f0d65c045ea988b713719455a65b3b"
    PointCloud {
        /// header
        header: crate::std_msgs::Header,
        /// points
        points: Vec<crate::geometry_msgs::Point32>,
        /// channels
        channels: Vec<ChannelFloat32>,
    }
}

crate::message! {
    /// Points with any fields, as the sensor's memory holds them.
    "sensor_msgs/msg/PointCloud2" "RIHS01_9198cabf7da3796ae6fe19c4cb3bdd3525492988c70522628af5daa124bae2b5"
    PointCloud2 {
        /// header
        header: crate::std_msgs::Header,
        /// Rows; 1 when the points have no order.
        height: u32,
        /// Points in a row.
        width: u32,
        /// What a point consists of.
        fields: Vec<PointField>,
        /// is_bigendian
        is_bigendian: bool,
        /// Bytes of a point.
        point_step: u32,
        /// Bytes of a row.
        row_step: u32,
        /// data
        data: Vec<u8>,
        /// Whether all points are valid.
        is_dense: bool,
    }
}

crate::message! {
    /// One field of a point.
    "sensor_msgs/msg/PointField" "RIHS01_5c6a4750728c2bcfbbf7037225b20b02d4429634732146b742dee1726637ef01"
    PointField {
        /// name
        name: std::string::String,
        /// Bytes from the start of the point.
        offset: u32,
        /// One of the values above.
        datatype: u8,
        /// How many of them.
        count: u32,
    }
    /// INT8
    INT8: u8 = 1;
    /// UINT8
    UINT8: u8 = 2;
    /// INT16
    INT16: u8 = 3;
    /// UINT16
    UINT16: u8 = 4;
    /// INT32
    INT32: u8 = 5;
    /// UINT32
    UINT32: u8 = 6;
    /// FLOAT32
    FLOAT32: u8 = 7;
    /// FLOAT64
    FLOAT64: u8 = 8;
}

crate::message! {
    /// One distance, of an ultrasonic or infrared sensor.
    "sensor_msgs/msg/Range" "RIHS01_b42b62562e93cbfe9d42b82fe5994dfa3d63d7d5c90a317981703f7388adff3a"
    Range {
        /// header
        header: crate::std_msgs::Header,
        /// radiation_type
        radiation_type: u8,
        /// Width of the cone; rad.
        field_of_view: f32,
        /// m.
        min_range: f32,
        /// m.
        max_range: f32,
        /// m; infinite when nothing was seen, -infinite when too near.
        range: f32,
        /// m2; 0 when unknown.
        variance: f32,
    }
    /// ULTRASOUND
    ULTRASOUND: u8 = 0;
    /// INFRARED
    INFRARED: u8 = 1;
}

crate::message! {
    /// A part of an image; pixels.
    "sensor_msgs/msg/RegionOfInterest" "RIHS01_ad16bcba5f9131dcdba6fbded19f726f5440e3c513b4fb586dd3027eeed8abb1"
    RegionOfInterest {
        /// x_offset
        x_offset: u32,
        /// y_offset
        y_offset: u32,
        /// height
        height: u32,
        /// width
        width: u32,
        /// do_rectify
        do_rectify: bool,
    }
}

crate::message! {
    /// Humidity of air.
    "sensor_msgs/msg/RelativeHumidity" "RIHS01_8687c99b4fb393cb2e545e407b5ea7fd0b5d8960bcd849a0f86c544740138839"
    RelativeHumidity {
        /// header
        header: crate::std_msgs::Header,
        /// 0 to 1.
        relative_humidity: f64,
        /// variance
        variance: f64,
    }
}

crate::message! {
    /// Temperature.
    "sensor_msgs/msg/Temperature" "RIHS01_72514a14126ab9f8a9abec974c78e5610a367b59db5da355ff1fb982d5bad4b8"
    Temperature {
        /// header
        header: crate::std_msgs::Header,
        /// Degrees Celsius.
        temperature: f64,
        /// variance
        variance: f64,
    }
}

crate::message! {
    /// The time of another clock.
    "sensor_msgs/msg/TimeReference" "RIHS01_dd66e84cf40bbb5d5a40472e6ecf2675a031334d4c426abdb2ad41801a8efc99"
    TimeReference {
        /// header
        header: crate::std_msgs::Header,
        /// time_ref
        time_ref: crate::builtin_interfaces::Time,
        /// source
        source: std::string::String,
    }
}

crate::message! {
    /// Gives a camera its calibration.
    "sensor_msgs/srv/SetCameraInfo_Request" "RIHS01_27dc5497730fdb6930e66cb879c210e31a83022acc5bbc999f24f55286029f87"
    SetCameraInfoRequest {
        /// camera_info
        camera_info: CameraInfo,
    }
}

crate::message! {
    /// `sensor_msgs/srv/SetCameraInfo_Response`.
    "sensor_msgs/srv/SetCameraInfo_Response" "RIHS01_4db6d7df20cdcdc05430945e76fa58e1eab1285c15f31d26fad76e2c1b10299c"
    SetCameraInfoResponse {
        /// success
        success: bool,
        /// status_message
        status_message: std::string::String,
    }
}

crate::service! {
    /// Gives a camera its calibration.
    "sensor_msgs/srv/SetCameraInfo" "RIHS01_a10cca5d33dc637c8d49db50ab288701a3592bb9cd854f2f16a0659613b68984"
    SetCameraInfo, SetCameraInfoRequest, SetCameraInfoResponse
}
