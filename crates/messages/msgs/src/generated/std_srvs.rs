//! `std_srvs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/std_srvs`
//! instead.

crate::message! {
    /// Asks to act.
    "std_srvs/srv/Empty_Request" "RIHS01_458eaf200a3f63d9cc53d19436edebc0c140ef4c93ca75d5bd4ce19fd7759e35"
    EmptyRequest {
    }
}

crate::message! {
    /// `std_srvs/srv/Empty_Response`.
    "std_srvs/srv/Empty_Response" "RIHS01_0a2858b3f60df644a61d0fa44cfc923a3d3628e0ad9c8ad8534b1a2c92a413dc"
    EmptyResponse {
    }
}

crate::service! {
    /// Asks to act.
    "std_srvs/srv/Empty" "RIHS01_5888399dedec5ccc85ea6451949fd2c9f97bfdf963f9a588821639fcd31b5d19"
    Empty, EmptyRequest, EmptyResponse
}

crate::message! {
    /// Switches something on or off.
    "std_srvs/srv/SetBool_Request" "RIHS01_c62fbb99d94e1b25e8ef9e109f9581956bb1b3361a45a4e5810c36a90d29932e"
    SetBoolRequest {
        /// data
        data: bool,
    }
}

crate::message! {
    /// `std_srvs/srv/SetBool_Response`.
    "std_srvs/srv/SetBool_Response" "RIHS01_d0814e7f7b4880ab77e9c57426c7aa1562ab69f11eef8e2e968812f9cbd0b059"
    SetBoolResponse {
        /// success
        success: bool,
        /// message
        message: std::string::String,
    }
}

crate::service! {
    /// Switches something on or off.
    "std_srvs/srv/SetBool" "RIHS01_abe9e4bb6b41b40e6789712c00ec8871923e089af3f667a79992a428cff2da0a"
    SetBool, SetBoolRequest, SetBoolResponse
}

crate::message! {
    /// Asks to act and says whether it worked.
    "std_srvs/srv/Trigger_Request" "RIHS01_d010825374ce8918e72bfd826c82603e60f45419e932ea976f807b74a863a199"
    TriggerRequest {
    }
}

crate::message! {
    /// `std_srvs/srv/Trigger_Response`.
    "std_srvs/srv/Trigger_Response" "RIHS01_2d946c21e2fc3f1e9ca6986a8191d85fcc70097a8bb7771a053564bc47009cdf"
    TriggerResponse {
        /// success
        success: bool,
        /// message
        message: std::string::String,
    }
}

crate::service! {
    /// Asks to act and says whether it worked.
    "std_srvs/srv/Trigger" "RIHS01_eeff2cd6fa5ad9d27cdf4dec64818317839b62f212a91e6b5304b634b2062c5f"
    Trigger, TriggerRequest, TriggerResponse
}
