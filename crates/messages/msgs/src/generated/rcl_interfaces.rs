//! `rcl_interfaces`. Made by `cargo xtask codegen`; edit the texts in `interfaces/rcl_interfaces`
//! instead.

crate::message! {
    /// Which numbers a parameter may have.
    "rcl_interfaces/msg/FloatingPointRange" "RIHS01_e6af23a23c177fee5f3075c8b1e435162a9b63c863d78c06017460b49684262d"
    FloatingPointRange {
        /// from_value
        from_value: f64,
        /// to_value
        to_value: f64,
        /// Distance between allowed values; 0 for any.
        step: f64,
    }
}

crate::message! {
    /// Which whole numbers a parameter may have.
    "rcl_interfaces/msg/IntegerRange" "RIHS01_f7b7fdc0f65f07702e099218e13288c3963bcb9345bde78b560e6cd19800fc5a"
    IntegerRange {
        /// from_value
        from_value: i64,
        /// to_value
        to_value: i64,
        /// Distance between allowed values; 0 for any.
        step: u64,
    }
}

crate::message! {
    /// Names of parameters, and of their groups.
    "rcl_interfaces/msg/ListParametersResult" "RIHS01_237ae3428413dcbcfb452b510c42355f3a2b021dc091afa3e18526d57022f1cd"
    ListParametersResult {
        /// names
        names: Vec<std::string::String>,
        /// prefixes
        prefixes: Vec<std::string::String>,
    }
}

crate::message! {
    /// A line of a log.
    "rcl_interfaces/msg/Log" "RIHS01_e28ce254ca8abc06abf92773b74602cdbf116ed34fbaf294fb9f81da9f318eac"
    Log {
        /// stamp
        stamp: crate::builtin_interfaces::Time,
        /// level
        level: u8,
        /// name
        name: std::string::String,
        /// msg
        msg: std::string::String,
        /// file
        file: std::string::String,
        /// function
        function: std::string::String,
        /// line
        line: u32,
    }
    /// DEBUG
    DEBUG: u8 = 10;
    /// INFO
    INFO: u8 = 20;
    /// WARN
    WARN: u8 = 30;
    /// ERROR
    ERROR: u8 = 40;
    /// FATAL
    FATAL: u8 = 50;
}

crate::message! {
    /// From which severity on a logger speaks.
    "rcl_interfaces/msg/LoggerLevel" "RIHS01_95785cc42f048ab4f395af65035aeaf2181d8e1c7a44edb8ad4558445fdb43c0"
    LoggerLevel {
        /// name
        name: std::string::String,
        /// level
        level: u32,
    }
    /// LOG_LEVEL_UNKNOWN
    LOG_LEVEL_UNKNOWN: u8 = 0;
    /// LOG_LEVEL_DEBUG
    LOG_LEVEL_DEBUG: u8 = 10;
    /// LOG_LEVEL_INFO
    LOG_LEVEL_INFO: u8 = 20;
    /// LOG_LEVEL_WARN
    LOG_LEVEL_WARN: u8 = 30;
    /// LOG_LEVEL_ERROR
    LOG_LEVEL_ERROR: u8 = 40;
    /// LOG_LEVEL_FATAL
    LOG_LEVEL_FATAL: u8 = 50;
}

crate::message! {
    /// A named value.
    "rcl_interfaces/msg/Parameter" "RIHS01_ddfe6442cffc462317adb5c92536a7b6dd55858c5c3e1e328165a6b73c2831af"
    Parameter {
        /// name
        name: std::string::String,
        /// value
        value: ParameterValue,
    }
}

crate::message! {
    /// What a parameter is for and what it may be.
    "rcl_interfaces/msg/ParameterDescriptor" "RIHS01_52175dbfda6c51153101d33d2a9da05743f66f02d5ab2ca9ec4709b46b73d704"
    ParameterDescriptor {
        /// name
        name: std::string::String,
        /// One of the values of ParameterType.
        r#type: u8,
        /// description
        description: std::string::String,
        /// additional_constraints
        additional_constraints: std::string::String,
        /// read_only
        read_only: bool = false,
        /// dynamic_typing
        dynamic_typing: bool = false,
        /// floating_point_range
        floating_point_range: Vec<FloatingPointRange> | 1,
        /// integer_range
        integer_range: Vec<IntegerRange> | 1,
    }
}

crate::message! {
    /// Parameters of a node that changed.
    "rcl_interfaces/msg/ParameterEvent" "RIHS01_043e627780fcad87a22d225bc2a037361dba713fca6a6b9f4b869a5aa0393204"
    ParameterEvent {
        /// stamp
        stamp: crate::builtin_interfaces::Time,
        /// Full name of the node.
        node: std::string::String,
        /// new_parameters
        new_parameters: Vec<Parameter>,
        /// changed_parameters
        changed_parameters: Vec<Parameter>,
        /// deleted_parameters
        deleted_parameters: Vec<Parameter>,
    }
}

crate::message! {
    /// Descriptions of parameters that changed.
    "rcl_interfaces/msg/ParameterEventDescriptors" "RIHS01_456f90915d72ef69379e702ef3ba2a115098ff677eab9c0080fa11239c6b147e"
    ParameterEventDescriptors {
        /// new_parameters
        new_parameters: Vec<ParameterDescriptor>,
        /// changed_parameters
        changed_parameters: Vec<ParameterDescriptor>,
        /// deleted_parameters
        deleted_parameters: Vec<ParameterDescriptor>,
    }
}

crate::message! {
    /// The kinds of values that parameters have.
    "rcl_interfaces/msg/ParameterType" "RIHS01_df29ed057a834862187be24dd187d981790ff3ea6502f4cd27b432cbc42c6d46"
    ParameterType {
    }
    /// PARAMETER_NOT_SET
    PARAMETER_NOT_SET: u8 = 0;
    /// PARAMETER_BOOL
    PARAMETER_BOOL: u8 = 1;
    /// PARAMETER_INTEGER
    PARAMETER_INTEGER: u8 = 2;
    /// PARAMETER_DOUBLE
    PARAMETER_DOUBLE: u8 = 3;
    /// PARAMETER_STRING
    PARAMETER_STRING: u8 = 4;
    /// PARAMETER_BYTE_ARRAY
    PARAMETER_BYTE_ARRAY: u8 = 5;
    /// PARAMETER_BOOL_ARRAY
    PARAMETER_BOOL_ARRAY: u8 = 6;
    /// PARAMETER_INTEGER_ARRAY
    PARAMETER_INTEGER_ARRAY: u8 = 7;
    /// PARAMETER_DOUBLE_ARRAY
    PARAMETER_DOUBLE_ARRAY: u8 = 8;
    /// PARAMETER_STRING_ARRAY
    PARAMETER_STRING_ARRAY: u8 = 9;
}

crate::message! {
    /// A value of one of several kinds.
    "rcl_interfaces/msg/ParameterValue" "RIHS01_115fc089a387e23c7ecd3525c9189c379109119d6ab82e8dfbde0fdf6a7f9b68"
    ParameterValue {
        /// One of the values of ParameterType; says which of the others counts.
        r#type: u8,
        /// bool_value
        bool_value: bool,
        /// integer_value
        integer_value: i64,
        /// double_value
        double_value: f64,
        /// string_value
        string_value: std::string::String,
        /// byte_array_value
        byte_array_value: Vec<u8>,
        /// bool_array_value
        bool_array_value: Vec<bool>,
        /// integer_array_value
        integer_array_value: Vec<i64>,
        /// double_array_value
        double_array_value: Vec<f64>,
        /// string_array_value
        string_array_value: Vec<std::string::String>,
    }
}

crate::message! {
    /// Whether a level was set.
    "rcl_interfaces/msg/SetLoggerLevelsResult" "RIHS01_9316e5e679a5b72d2dd7fd80c539bae9e106fa0890a06dc5da3a8177a3ff6909"
    SetLoggerLevelsResult {
        /// successful
        successful: bool,
        /// reason
        reason: std::string::String,
    }
}

crate::message! {
    /// Whether parameters were set.
    "rcl_interfaces/msg/SetParametersResult" "RIHS01_cfcc0fb0371ee5159b403960ef4300f8f9d2f1fd6117c8666b7f9654d528a9b1"
    SetParametersResult {
        /// successful
        successful: bool,
        /// reason
        reason: std::string::String,
    }
}

crate::message! {
    /// Descriptions of parameters.
    "rcl_interfaces/srv/DescribeParameters_Request" "RIHS01_05dd1c2bc87dec2627105c8070d6f9725c781a4f2ab852975bf105462b82b644"
    DescribeParametersRequest {
        /// names
        names: Vec<std::string::String>,
    }
}

crate::message! {
    /// `rcl_interfaces/srv/DescribeParameters_Response`.
    "rcl_interfaces/srv/DescribeParameters_Response" "RIHS01_ad6747319613c6131589e062e095b469a46cc764f7d0f12a001a49e6cd893995"
    DescribeParametersResponse {
        /// descriptors
        descriptors: Vec<ParameterDescriptor>,
    }
}

crate::service! {
    /// Descriptions of parameters.
    "rcl_interfaces/srv/DescribeParameters" "RIHS01_845b484d71eb0673dae682f2e3ba3c4851a65a3dcfb97bddd82c5b57e91e4cff"
    DescribeParameters, DescribeParametersRequest, DescribeParametersResponse
}

crate::message! {
    /// Levels of loggers.
    "rcl_interfaces/srv/GetLoggerLevels_Request" "RIHS01_490ace424a5f5b14cb4e1e95030d7fe366d8df0fd9fe4d03b44d6009504fd2cc"
    GetLoggerLevelsRequest {
        /// names
        names: Vec<std::string::String>,
    }
}

crate::message! {
    /// `rcl_interfaces/srv/GetLoggerLevels_Response`.
    "rcl_interfaces/srv/GetLoggerLevels_Response" "RIHS01_228685d350911d213047abe756f5bf566d2f76b359c4e9fac16e5ef652aff910"
    GetLoggerLevelsResponse {
        /// levels
        levels: Vec<LoggerLevel>,
    }
}

crate::service! {
    /// Levels of loggers.
    "rcl_interfaces/srv/GetLoggerLevels" "RIHS01_03bf1bebd0d6514c7ed0ba7c5e08dc9f2f39c759fe99e1e30ea4157d7674f72d"
    GetLoggerLevels, GetLoggerLevelsRequest, GetLoggerLevelsResponse
}

crate::message! {
    /// Kinds of parameters.
    "rcl_interfaces/srv/GetParameterTypes_Request" "RIHS01_87d7ec5ef545d4daa289d500025d31fb2437bc8b8365ca367161c4dac4be33fd"
    GetParameterTypesRequest {
        /// names
        names: Vec<std::string::String>,
    }
}

crate::message! {
    /// `rcl_interfaces/srv/GetParameterTypes_Response`.
    "rcl_interfaces/srv/GetParameterTypes_Response" "RIHS01_ac1335dce67c478e669434f6ac2fbff34fcd529580f272d3006785ba8b54e47f"
    GetParameterTypesResponse {
        /// types
        types: Vec<u8>,
    }
}

crate::service! {
    /// Kinds of parameters.
    "rcl_interfaces/srv/GetParameterTypes" "RIHS01_da199c878688b3e530bdfe3ca8f74cb9fa0c303101e980a9e8f260e25e1c80ca"
    GetParameterTypes, GetParameterTypesRequest, GetParameterTypesResponse
}

crate::message! {
    /// Values of parameters.
    "rcl_interfaces/srv/GetParameters_Request" "RIHS01_135a9e1c3d7cebef792f6687d7ddf99949b21a0bd9a320d863a9110a3f5cf4d6"
    GetParametersRequest {
        /// names
        names: Vec<std::string::String>,
    }
}

crate::message! {
    /// `rcl_interfaces/srv/GetParameters_Response`.
    "rcl_interfaces/srv/GetParameters_Response" "RIHS01_9fa773b46e39cc5d02db6224d8fd520bb9caeeffc2b27c96c1e59431baba9f2a"
    GetParametersResponse {
        /// values
        values: Vec<ParameterValue>,
    }
}

crate::service! {
    /// Values of parameters.
    "rcl_interfaces/srv/GetParameters" "RIHS01_bf9803d5c74cf989a5de3e0c2e99444599a627c7ff75f97b8c05b01003675cbc"
    GetParameters, GetParametersRequest, GetParametersResponse
}

crate::message! {
    /// Names of parameters.
    "rcl_interfaces/srv/ListParameters_Request" "RIHS01_a1b0b5d6b967a5b8ac5bc8563c3ea678f349e312a6a4967227c5a96bc5ce38df"
    ListParametersRequest {
        /// prefixes
        prefixes: Vec<std::string::String>,
        /// depth
        depth: u64,
    }
    /// DEPTH_RECURSIVE
    DEPTH_RECURSIVE: u64 = 0;
}

crate::message! {
    /// `rcl_interfaces/srv/ListParameters_Response`.
    "rcl_interfaces/srv/ListParameters_Response" "RIHS01_31b937b82de3612426be79f231e386259f97e8dc843e3f2845288b4bfa296bdd"
    ListParametersResponse {
        /// result
        result: ListParametersResult,
    }
}

crate::service! {
    /// Names of parameters.
    "rcl_interfaces/srv/ListParameters" "RIHS01_3e6062bfbb27bfb8730d4cef2558221f51a11646d78e7bb30a1e83afac3aad9d"
    ListParameters, ListParametersRequest, ListParametersResponse
}

crate::message! {
    /// Sets levels of loggers.
    "rcl_interfaces/srv/SetLoggerLevels_Request" "RIHS01_4e7768e0f4c749205f35bc05449f83fad18c42de52c16b1934d66c2f68ffd862"
    SetLoggerLevelsRequest {
        /// levels
        levels: Vec<LoggerLevel>,
    }
}

crate::message! {
    /// `rcl_interfaces/srv/SetLoggerLevels_Response`.
    "rcl_interfaces/srv/SetLoggerLevels_Response" "RIHS01_ba51739027e57cb9120015737f4618579684047d862b2b16a76bc399d987d6d3"
    SetLoggerLevelsResponse {
        /// results
        results: Vec<SetLoggerLevelsResult>,
    }
}

crate::service! {
    /// Sets levels of loggers.
    "rcl_interfaces/srv/SetLoggerLevels" "RIHS01_3ff86cb4e91fbf9abae15c234ecc874448de6ece8e193401c077cf116e4f6d78"
    SetLoggerLevels, SetLoggerLevelsRequest, SetLoggerLevelsResponse
}

crate::message! {
    /// Sets parameters one by one.
    "rcl_interfaces/srv/SetParameters_Request" "RIHS01_130d46386b7e84ea9ecf60608a4d83cbe5e5cb7c6cc5b712b7a4e3a6c254e932"
    SetParametersRequest {
        /// parameters
        parameters: Vec<Parameter>,
    }
}

crate::message! {
    /// `rcl_interfaces/srv/SetParameters_Response`.
    "rcl_interfaces/srv/SetParameters_Response" "RIHS01_7a0e8140a0b8d98308fa81a5403a766e610af29a239caf54b7553227906fc266"
    SetParametersResponse {
        /// results
        results: Vec<SetParametersResult>,
    }
}

crate::service! {
    /// Sets parameters one by one.
    "rcl_interfaces/srv/SetParameters" "RIHS01_56eed9a67e169f9cb6c1f987bc88f868c14a8fc9f743a263bc734c154015d7e0"
    SetParameters, SetParametersRequest, SetParametersResponse
}

crate::message! {
    /// Sets all parameters or none.
    "rcl_interfaces/srv/SetParametersAtomically_Request" "RIHS01_db0bd950ed5ed867a0e90b225e44dea382d762c0762ff3e0ee842190042a59e5"
    SetParametersAtomicallyRequest {
        /// parameters
        parameters: Vec<Parameter>,
    }
}

crate::message! {
    /// `rcl_interfaces/srv/SetParametersAtomically_Response`.
    "rcl_interfaces/srv/SetParametersAtomically_Response" "RIHS01_31b1a38c5b0b9d893ee24da45f69638f4561c78461d82d52750f429b534502b8"
    SetParametersAtomicallyResponse {
        /// result
        result: SetParametersResult,
    }
}

crate::service! {
    /// Sets all parameters or none.
    "rcl_interfaces/srv/SetParametersAtomically" "RIHS01_0e192ef259c07fc3c07a13191d27002222e65e00ccec653ca05e856f79285fcd"
    SetParametersAtomically, SetParametersAtomicallyRequest, SetParametersAtomicallyResponse
}
