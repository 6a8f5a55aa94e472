//! `slam_toolbox`. Made by `cargo xtask codegen`; edit the texts in `interfaces/slam_toolbox`
//! instead.

crate::message! {
    /// Adds a saved graph to those to be merged.
    "slam_toolbox/srv/AddSubmap_Request" "RIHS01_4d7a0b0463a69301479497fc2134aa62f825aea53fa1e59e107ad3fe20f93404"
    AddSubmapRequest {
        /// Path of the files without ending.
        filename: std::string::String,
    }
}

crate::message! {
    /// `slam_toolbox/srv/AddSubmap_Response`.
    "slam_toolbox/srv/AddSubmap_Response" "RIHS01_ef502ff10123c40a8ca94ec8a70beae0d9bb1ad71edc959056e8cf665cec0207"
    AddSubmapResponse {
    }
}

crate::service! {
    /// Adds a saved graph to those to be merged.
    "slam_toolbox/srv/AddSubmap" "RIHS01_18ce16d68eaff84803ec06c46140474bb4e12097ca6ef1e5c84001290b9419a4"
    AddSubmap, AddSubmapRequest, AddSubmapResponse
}

crate::message! {
    /// Forgets changes made by hand.
    "slam_toolbox/srv/Clear_Request" "RIHS01_8d88cd695028b4055ae74a40ea182f6db605a077bea1d80ef0c8af851a0890e2"
    ClearRequest {
    }
}

crate::message! {
    /// `slam_toolbox/srv/Clear_Response`.
    "slam_toolbox/srv/Clear_Response" "RIHS01_75ed33859e1f13b4092b960eb98c961a274f49d88b215f1c0d1241ca477dbe13"
    ClearResponse {
    }
}

crate::service! {
    /// Forgets changes made by hand.
    "slam_toolbox/srv/Clear" "RIHS01_6594d558fe293c30bbf238cf28cd04267da8a11ab0e2cdab46a670fa4abf6546"
    Clear, ClearRequest, ClearResponse
}

crate::message! {
    /// Forgets scans that wait.
    "slam_toolbox/srv/ClearQueue_Request" "RIHS01_5be39ec92b1c3d67d72d9d332a5e5e84c12fbfe36efaf9311c7ecbe32340edb5"
    ClearQueueRequest {
    }
}

crate::message! {
    /// `slam_toolbox/srv/ClearQueue_Response`.
    "slam_toolbox/srv/ClearQueue_Response" "RIHS01_091b71de50c6325803533b815ec0a4d39a571c0d5641e5ea5cefffe4d70c1490"
    ClearQueueResponse {
        /// Whether it worked.
        status: bool,
    }
}

crate::service! {
    /// Forgets scans that wait.
    "slam_toolbox/srv/ClearQueue" "RIHS01_5ae7286887351a43cd6265cbd3ec3fdf0074fa6e9f39c17057351b6ab4415477"
    ClearQueue, ClearQueueRequest, ClearQueueResponse
}

crate::message! {
    /// Loads a graph of scans.
    "slam_toolbox/srv/DeserializePoseGraph_Request" "RIHS01_1bde65c133a93f94c09966a0206ce03946703695bc84e25aebf92fe61a0ae4b0"
    DeserializePoseGraphRequest {
        /// Path of the files without ending.
        filename: std::string::String,
        /// One of the values above.
        match_type: i8,
        /// In the map's frame; m, rad.
        initial_pose: crate::geometry_msgs::Pose2D,
    }
    /// UNSET
    UNSET: i8 = 0;
    /// START_AT_FIRST_NODE
    START_AT_FIRST_NODE: i8 = 1;
    /// START_AT_GIVEN_POSE
    START_AT_GIVEN_POSE: i8 = 2;
    /// LOCALIZE_AT_POSE
    LOCALIZE_AT_POSE: i8 = 3;
}

crate::message! {
    /// `slam_toolbox/srv/DeserializePoseGraph_Response`.
    "slam_toolbox/srv/DeserializePoseGraph_Response" "RIHS01_a613fd2146e43534730add3fb85b1ddc9ef56b82e543ccf6a099c28158fff059"
    DeserializePoseGraphResponse {
    }
}

crate::service! {
    /// Loads a graph of scans.
    "slam_toolbox/srv/DeserializePoseGraph" "RIHS01_ec7e27ad873d1c3961583c3288d7fe516bb0035fc9769078657f0377bd55547a"
    DeserializePoseGraph, DeserializePoseGraphRequest, DeserializePoseGraphResponse
}

crate::message! {
    /// Closes loops with what was changed by hand.
    "slam_toolbox/srv/LoopClosure_Request" "RIHS01_fcbfcb440d36d6a00be758c5e5d2a7d2269c1d14a052b7e94d2df5224561c663"
    LoopClosureRequest {
    }
}

crate::message! {
    /// `slam_toolbox/srv/LoopClosure_Response`.
    "slam_toolbox/srv/LoopClosure_Response" "RIHS01_cca962213dff423e3d75ab7ec13cd72caa2779531452fe8f4443f13b91ea30c3"
    LoopClosureResponse {
    }
}

crate::service! {
    /// Closes loops with what was changed by hand.
    "slam_toolbox/srv/LoopClosure" "RIHS01_ad4c3eab92dc44b7fac077e85e6dd79e0595aa64415bb3c8fdfdc2478cc6aa88"
    LoopClosure, LoopClosureRequest, LoopClosureResponse
}

crate::message! {
    /// Merges the graphs that were added.
    "slam_toolbox/srv/MergeMaps_Request" "RIHS01_1a2730d7fca4eff48279ad7b5fd4064eca2a9139935050117908b0f349f2f39e"
    MergeMapsRequest {
    }
}

crate::message! {
    /// `slam_toolbox/srv/MergeMaps_Response`.
    "slam_toolbox/srv/MergeMaps_Response" "RIHS01_1798ccfa121e2637203bf88e63e7966ab5f9a69512afdbc4599afba00743b3f0"
    MergeMapsResponse {
    }
}

crate::service! {
    /// Merges the graphs that were added.
    "slam_toolbox/srv/MergeMaps" "RIHS01_711e883fdb23ecf05272f8b9f553809cc994ec34785b1cbec02d29f38dcc13a6"
    MergeMaps, MergeMapsRequest, MergeMapsResponse
}

crate::message! {
    /// Stops or resumes taking new scans; each call changes it.
    "slam_toolbox/srv/Pause_Request" "RIHS01_bd94128b2476065d43caa26f43334ad5b688186e82ca73366f11e6459b7562a6"
    PauseRequest {
    }
}

crate::message! {
    /// `slam_toolbox/srv/Pause_Response`.
    "slam_toolbox/srv/Pause_Response" "RIHS01_72bc942536d6fb903377dbf48c7c2e0c965cb2b04f508477d9c8aced687d6d94"
    PauseResponse {
        /// Whether it worked.
        status: bool,
    }
}

crate::service! {
    /// Stops or resumes taking new scans; each call changes it.
    "slam_toolbox/srv/Pause" "RIHS01_70971da2d6da308b62b9ef6e4615202d9b3c6e945fcfce5ffded1b45423a236d"
    Pause, PauseRequest, PauseResponse
}

crate::message! {
    /// Begins a new map.
    "slam_toolbox/srv/Reset_Request" "RIHS01_e3eb332dcfed05e39e67aa244c229e5a4d1741969d26e0d8f9138425ee4f8856"
    ResetRequest {
        /// Whether to wait with new scans.
        pause_new_measurements: bool,
    }
}

crate::message! {
    /// `slam_toolbox/srv/Reset_Response`.
    "slam_toolbox/srv/Reset_Response" "RIHS01_46ca8b03f861d70ebb5a9be4d4eab4cd00119d209ad9ee01e93f4690140dceae"
    ResetResponse {
        /// result
        result: u8,
    }
    /// RESULT_SUCCESS
    RESULT_SUCCESS: u8 = 0;
}

crate::service! {
    /// Begins a new map.
    "slam_toolbox/srv/Reset" "RIHS01_add9db4656fcb5220b2d20b9f8f22a9094272dffc63bc4d4caf8df63c7079342"
    Reset, ResetRequest, ResetResponse
}

crate::message! {
    /// Saves the occupancy grid to a file.
    "slam_toolbox/srv/SaveMap_Request" "RIHS01_53030f29f705b5f868bf35ce8a5bdd5a9b17f670649396fdbbc4a8dbe7ad0973"
    SaveMapRequest {
        /// Path of the files without ending.
        name: crate::std_msgs::String,
    }
}

crate::message! {
    /// `slam_toolbox/srv/SaveMap_Response`.
    "slam_toolbox/srv/SaveMap_Response" "RIHS01_713758aaa982f631420bcd79707de16f6729ecd6ba855070267104bdcdee6b22"
    SaveMapResponse {
        /// One of the values above.
        result: u8,
    }
    /// RESULT_SUCCESS
    RESULT_SUCCESS: u8 = 0;
    /// RESULT_NO_MAP_RECEIEVD
    RESULT_NO_MAP_RECEIEVD: u8 = 1;
    /// RESULT_UNDEFINED_FAILURE
    RESULT_UNDEFINED_FAILURE: u8 = 255;
}

crate::service! {
    /// Saves the occupancy grid to a file.
    "slam_toolbox/srv/SaveMap" "RIHS01_fe7c2a4b4f985a83fa1a651ba83f19dd13417c6f3c6efa6ece887e79c23c3c09"
    SaveMap, SaveMapRequest, SaveMapResponse
}

crate::message! {
    /// Saves the graph of scans, so that mapping can go on later.
    "slam_toolbox/srv/SerializePoseGraph_Request" "RIHS01_723d3bfb9150b866fcbb26e447c8c7af3fb1e77e14d684037dc2baa0dbe80bd6"
    SerializePoseGraphRequest {
        /// Path of the files without ending.
        filename: std::string::String,
    }
}

crate::message! {
    /// `slam_toolbox/srv/SerializePoseGraph_Response`.
    "slam_toolbox/srv/SerializePoseGraph_Response" "RIHS01_89b3b7194fed12911fd6e44bdfac000ad6a5b3ef1dda9b11f71481388cde49ec"
    SerializePoseGraphResponse {
        /// One of the values above.
        result: u8,
    }
    /// RESULT_SUCCESS
    RESULT_SUCCESS: u8 = 0;
    /// RESULT_FAILED_TO_WRITE_FILE
    RESULT_FAILED_TO_WRITE_FILE: u8 = 255;
}

crate::service! {
    /// Saves the graph of scans, so that mapping can go on later.
    "slam_toolbox/srv/SerializePoseGraph" "RIHS01_d7adce484b2589d9e97a4179c1c3d1a8343fec6acb2715d5f98ac5b79609e46b"
    SerializePoseGraph, SerializePoseGraphRequest, SerializePoseGraphResponse
}

crate::message! {
    /// Switches changing by hand on or off.
    "slam_toolbox/srv/ToggleInteractive_Request" "RIHS01_7b39d752f49ba967d72bcc6e340de08073a8577a13f107ca0aea076e664cb911"
    ToggleInteractiveRequest {
    }
}

crate::message! {
    /// `slam_toolbox/srv/ToggleInteractive_Response`.
    "slam_toolbox/srv/ToggleInteractive_Response" "RIHS01_d470db82b95328c0094694dfb2d32e98df8aa33bcaee19df87c116a9f79a07ce"
    ToggleInteractiveResponse {
    }
}

crate::service! {
    /// Switches changing by hand on or off.
    "slam_toolbox/srv/ToggleInteractive" "RIHS01_b011a7d5bbf8208c2ccc0680cf75e381686279faea02a54aed6a2ff1e42192a1"
    ToggleInteractive, ToggleInteractiveRequest, ToggleInteractiveResponse
}
