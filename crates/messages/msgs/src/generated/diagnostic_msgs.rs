//! `diagnostic_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/diagnostic_msgs`
//! instead.

crate::message! {
    /// The health of parts of a robot.
    "diagnostic_msgs/msg/DiagnosticArray" "RIHS01_5a8a36efb05fb25070fa0fb3810290c0e6cd4862b54a8fb975a1ee8dc55a333e"
    DiagnosticArray {
        /// header
        header: crate::std_msgs::Header,
        /// status
        status: Vec<DiagnosticStatus>,
    }
}

crate::message! {
    /// The health of one part.
    "diagnostic_msgs/msg/DiagnosticStatus" "RIHS01_b0e3e692ea2d54a8af2f4ef1930e81556a2db55216b771f8a7d2724ed47bf0e4"
    DiagnosticStatus {
        /// level
        level: u8,
        /// name
        name: std::string::String,
        /// message
        message: std::string::String,
        /// hardware_id
        hardware_id: std::string::String,
        /// values
        values: Vec<KeyValue>,
    }
    /// OK
    OK: u8 = 0;
    /// WARN
    WARN: u8 = 1;
    /// ERROR
    ERROR: u8 = 2;
    /// STALE
    STALE: u8 = 3;
}

crate::message! {
    /// A named text.
    "diagnostic_msgs/msg/KeyValue" "RIHS01_d68081eaa540288c5440753baecef0c4e16e81a5f78ad68902ded5100413bb42"
    KeyValue {
        /// key
        key: std::string::String,
        /// value
        value: std::string::String,
    }
}

crate::message! {
    /// Adds analyzers to a running aggregator.
    "diagnostic_msgs/srv/AddDiagnostics_Request" "RIHS01_e0b6572a07c2b3ca2c4f2acf742297661f6ceb50f5baa4f9305b6094cf950146"
    AddDiagnosticsRequest {
        /// load_namespace
        load_namespace: std::string::String,
    }
}

crate::message! {
    /// `diagnostic_msgs/srv/AddDiagnostics_Response`.
    "diagnostic_msgs/srv/AddDiagnostics_Response" "RIHS01_e7070a2373c892c4cf071dcd90405d7696187eb2ff0e40d8b6472a04a4b73d22"
    AddDiagnosticsResponse {
        /// success
        success: bool,
        /// message
        message: std::string::String,
    }
}

crate::service! {
    /// Adds analyzers to a running aggregator.
    "diagnostic_msgs/srv/AddDiagnostics" "RIHS01_6b91084c9f8bffd9b0c1f6883e0e8e491a831f4fc6c6aec77a4efaf3f1ea90b5"
    AddDiagnostics, AddDiagnosticsRequest, AddDiagnosticsResponse
}

crate::message! {
    /// Asks a device to test itself.
    "diagnostic_msgs/srv/SelfTest_Request" "RIHS01_3bb94b497e74e9beed2dddc7212d3ae596696d30413bd1550fe932fc20efb8a4"
    SelfTestRequest {
    }
}

crate::message! {
    /// `diagnostic_msgs/srv/SelfTest_Response`.
    "diagnostic_msgs/srv/SelfTest_Response" "RIHS01_489da82e00dce6671cb0ff423a0f0939b546336fbfe49d6c7e64c9b89f898f57"
    SelfTestResponse {
        /// id
        id: std::string::String,
        /// passed
        passed: u8,
        /// status
        status: Vec<DiagnosticStatus>,
    }
}

crate::service! {
    /// Asks a device to test itself.
    "diagnostic_msgs/srv/SelfTest" "RIHS01_df1e4e54a814a16ccc77471e9239618d46818e8d0e3b45ad6f8c34c6e2abfef6"
    SelfTest, SelfTestRequest, SelfTestResponse
}
