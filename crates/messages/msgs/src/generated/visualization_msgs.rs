//! `visualization_msgs`. Made by `cargo xtask codegen`; edit the texts in `interfaces/visualization_msgs`
//! instead.

crate::message! {
    /// Something drawn into an image.
    "visualization_msgs/msg/ImageMarker" "RIHS01_603152491ef2331c200a5305230d31f6e8704875944b388da0f547c415d11836"
    ImageMarker {
        /// header
        header: crate::std_msgs::Header,
        /// ns
        ns: std::string::String,
        /// id
        id: i32,
        /// type
        r#type: i32,
        /// action
        action: i32,
        /// position
        position: crate::geometry_msgs::Point,
        /// scale
        scale: f32,
        /// outline_color
        outline_color: crate::std_msgs::ColorRGBA,
        /// filled
        filled: u8,
        /// fill_color
        fill_color: crate::std_msgs::ColorRGBA,
        /// lifetime
        lifetime: crate::builtin_interfaces::Duration,
        /// points
        points: Vec<crate::geometry_msgs::Point>,
        /// outline_colors
        outline_colors: Vec<crate::std_msgs::ColorRGBA>,
    }
    /// CIRCLE
    CIRCLE: i32 = 0;
    /// LINE_STRIP
    LINE_STRIP: i32 = 1;
    /// LINE_LIST
    LINE_LIST: i32 = 2;
    /// POLYGON
    POLYGON: i32 = 3;
    /// POINTS
    POINTS: i32 = 4;
    /// ADD
    ADD: i32 = 0;
    /// REMOVE
    REMOVE: i32 = 1;
}

crate::message! {
    /// Something to be moved with the mouse.
    "visualization_msgs/msg/InteractiveMarker" "RIHS01_3d5b51448b51d73b0f395b94d259edd3a5d269ae9f7d9fd5cceb9ae4b72be346"
    InteractiveMarker {
        /// header
        header: crate::std_msgs::Header,
        /// pose
        pose: crate::geometry_msgs::Pose,
        /// name
        name: std::string::String,
        /// description
        description: std::string::String,
        /// scale
        scale: f32,
        /// menu_entries
        menu_entries: Vec<MenuEntry>,
        /// controls
        controls: Vec<InteractiveMarkerControl>,
    }
}

crate::message! {
    /// One handle of an interactive marker.
    "visualization_msgs/msg/InteractiveMarkerControl" "RIHS01_60e2fa36344f5f4791b24a809542a18bffd555f563550d4b22b3bbfc31ec0ed5"
    InteractiveMarkerControl {
        /// name
        name: std::string::String,
        /// orientation
        orientation: crate::geometry_msgs::Quaternion,
        /// orientation_mode
        orientation_mode: u8,
        /// interaction_mode
        interaction_mode: u8,
        /// always_visible
        always_visible: bool,
        /// markers
        markers: Vec<Marker>,
        /// independent_marker_orientation
        independent_marker_orientation: bool,
        /// description
        description: std::string::String,
    }
    /// INHERIT
    INHERIT: u8 = 0;
    /// FIXED
    FIXED: u8 = 1;
    /// VIEW_FACING
    VIEW_FACING: u8 = 2;
    /// NONE
    NONE: u8 = 0;
    /// MENU
    MENU: u8 = 1;
    /// BUTTON
    BUTTON: u8 = 2;
    /// MOVE_AXIS
    MOVE_AXIS: u8 = 3;
    /// MOVE_PLANE
    MOVE_PLANE: u8 = 4;
    /// ROTATE_AXIS
    ROTATE_AXIS: u8 = 5;
    /// MOVE_ROTATE
    MOVE_ROTATE: u8 = 6;
    /// MOVE_3D
    MOVE_3D: u8 = 7;
    /// ROTATE_3D
    ROTATE_3D: u8 = 8;
    /// MOVE_ROTATE_3D
    MOVE_ROTATE_3D: u8 = 9;
}

crate::message! {
    /// What a user does with an interactive marker.
    "visualization_msgs/msg/InteractiveMarkerFeedback" "RIHS01_6cc48741df9f05d19ba7d9ea3101e9fcd1309c9d6bda3c55668ba607492f725e"
    InteractiveMarkerFeedback {
        /// header
        header: crate::std_msgs::Header,
        /// client_id
        client_id: std::string::String,
        /// marker_name
        marker_name: std::string::String,
        /// control_name
        control_name: std::string::String,
        /// event_type
        event_type: u8,
        /// pose
        pose: crate::geometry_msgs::Pose,
        /// menu_entry_id
        menu_entry_id: u32,
        /// mouse_point
        mouse_point: crate::geometry_msgs::Point,
        /// mouse_point_valid
        mouse_point_valid: bool,
    }
    /// KEEP_ALIVE
    KEEP_ALIVE: u8 = 0;
    /// POSE_UPDATE
    POSE_UPDATE: u8 = 1;
    /// MENU_SELECT
    MENU_SELECT: u8 = 2;
    /// BUTTON_CLICK
    BUTTON_CLICK: u8 = 3;
    /// MOUSE_DOWN
    MOUSE_DOWN: u8 = 4;
    /// MOUSE_UP
    MOUSE_UP: u8 = 5;
}

crate::message! {
    /// All interactive markers of a server.
    "visualization_msgs/msg/InteractiveMarkerInit" "RIHS01_23fda1b3373b154d9d6408dd7b9f8129b2a2b76b905ee421e8c4109d8bf71f78"
    InteractiveMarkerInit {
        /// server_id
        server_id: std::string::String,
        /// seq_num
        seq_num: u64,
        /// markers
        markers: Vec<InteractiveMarker>,
    }
}

crate::message! {
    /// A new pose of an interactive marker.
    "visualization_msgs/msg/InteractiveMarkerPose" "RIHS01_c60e9a4407d5f709a63e0fe9caea324aee08fe717cd090209ebe35012ce7cb66"
    InteractiveMarkerPose {
        /// header
        header: crate::std_msgs::Header,
        /// pose
        pose: crate::geometry_msgs::Pose,
        /// name
        name: std::string::String,
    }
}

crate::message! {
    /// What changed among interactive markers.
    "visualization_msgs/msg/InteractiveMarkerUpdate" "RIHS01_0a8b000c4fd4d50876ac716a7de018911599a2f015795388e956a2ca8b0c54f0"
    InteractiveMarkerUpdate {
        /// server_id
        server_id: std::string::String,
        /// seq_num
        seq_num: u64,
        /// type
        r#type: u8,
        /// markers
        markers: Vec<InteractiveMarker>,
        /// poses
        poses: Vec<InteractiveMarkerPose>,
        /// erases
        erases: Vec<std::string::String>,
    }
    /// KEEP_ALIVE
    KEEP_ALIVE: u8 = 0;
    /// UPDATE
    UPDATE: u8 = 1;
}

crate::message! {
    /// Something drawn in space.
    "visualization_msgs/msg/Marker" "RIHS01_45b13ccf791f225962bf74e746f9644518855d783a6f42ba0cc14fde2b4f3ce0"
    Marker {
        /// header
        header: crate::std_msgs::Header,
        /// Together with the id this names the marker.
        ns: std::string::String,
        /// id
        id: i32,
        /// ARROW to ARROW_STRIP.
        r#type: i32,
        /// ADD, DELETE or DELETEALL.
        action: i32,
        /// pose
        pose: crate::geometry_msgs::Pose,
        /// m.
        scale: crate::geometry_msgs::Vector3,
        /// color
        color: crate::std_msgs::ColorRGBA,
        /// 0 for ever.
        lifetime: crate::builtin_interfaces::Duration,
        /// Whether it moves with its frame.
        frame_locked: bool,
        /// m.
        points: Vec<crate::geometry_msgs::Point>,
        /// colors
        colors: Vec<crate::std_msgs::ColorRGBA>,
        /// texture_resource
        texture_resource: std::string::String,
        /// texture
        texture: crate::sensor_msgs::CompressedImage,
        /// uv_coordinates
        uv_coordinates: Vec<UVCoordinate>,
        /// text
        text: std::string::String,
        /// mesh_resource
        mesh_resource: std::string::String,
        /// mesh_file
        mesh_file: MeshFile,
        /// mesh_use_embedded_materials
        mesh_use_embedded_materials: bool,
    }
    /// ARROW
    ARROW: i32 = 0;
    /// CUBE
    CUBE: i32 = 1;
    /// SPHERE
    SPHERE: i32 = 2;
    /// CYLINDER
    CYLINDER: i32 = 3;
    /// LINE_STRIP
    LINE_STRIP: i32 = 4;
    /// LINE_LIST
    LINE_LIST: i32 = 5;
    /// CUBE_LIST
    CUBE_LIST: i32 = 6;
    /// SPHERE_LIST
    SPHERE_LIST: i32 = 7;
    /// POINTS
    POINTS: i32 = 8;
    /// TEXT_VIEW_FACING
    TEXT_VIEW_FACING: i32 = 9;
    /// MESH_RESOURCE
    MESH_RESOURCE: i32 = 10;
    /// TRIANGLE_LIST
    TRIANGLE_LIST: i32 = 11;
    /// ARROW_STRIP
    ARROW_STRIP: i32 = 12;
    /// ADD
    ADD: i32 = 0;
    /// MODIFY
    MODIFY: i32 = 0;
    /// DELETE
    DELETE: i32 = 2;
    /// DELETEALL
    DELETEALL: i32 = 3;
}

crate::message! {
    /// Many things drawn in space.
    "visualization_msgs/msg/MarkerArray" "RIHS01_86cb8800b6fb05b5eff1abd7a56f62a5641d3ae9a1c29e78e67e704f1d067dcf"
    MarkerArray {
        /// markers
        markers: Vec<Marker>,
    }
}

crate::message! {
    /// A line of the menu of an interactive marker.
    "visualization_msgs/msg/MenuEntry" "RIHS01_22170c387c70fd4236232ec902de8604e72ff027342c7c0f28ad9f68c64c51d6"
    MenuEntry {
        /// id
        id: u32,
        /// parent_id
        parent_id: u32,
        /// title
        title: std::string::String,
        /// command
        command: std::string::String,
        /// command_type
        command_type: u8,
    }
    /// FEEDBACK
    FEEDBACK: u8 = 0;
    /// ROSRUN
    ROSRUN: u8 = 1;
    /// ROSLAUNCH
    ROSLAUNCH: u8 = 2;
}

crate::message! {
    /// A mesh sent along.
    "visualization_msgs/msg/MeshFile" "RIHS01_7710ece15a148fb7c9b546364cfb215bb06098087bd6394fe5b73a493508f8c4"
    MeshFile {
        /// filename
        filename: std::string::String,
        /// data
        data: Vec<u8>,
    }
}

crate::message! {
    /// A place in a texture; 0 to 1.
    "visualization_msgs/msg/UVCoordinate" "RIHS01_f27f7ed21fe360c6066944f856b801a0c0d1e94e815b6886444b42d90b196a26"
    UVCoordinate {
        /// u
        u: f32,
        /// v
        v: f32,
    }
}

crate::message! {
    /// Asks for all interactive markers.
    "visualization_msgs/srv/GetInteractiveMarkers_Request" "RIHS01_7fa7e0830e3cbe9c15927a29fdc09fedcd9a86757e375f29ce6b0744cb0b6905"
    GetInteractiveMarkersRequest {
    }
}

crate::message! {
    /// `visualization_msgs/srv/GetInteractiveMarkers_Response`.
    "visualization_msgs/srv/GetInteractiveMarkers_Response" "RIHS01_414620cf7471b5469b159989af34edd1ed9276be592e43d1b7544204f4177302"
    GetInteractiveMarkersResponse {
        /// sequence_number
        sequence_number: u64,
        /// markers
        markers: Vec<InteractiveMarker>,
    }
}

crate::service! {
    /// Asks for all interactive markers.
    "visualization_msgs/srv/GetInteractiveMarkers" "RIHS01_bfdfaa861f4a8422b4ec3bd02c6681e4a45a83bdc2913d8facdf923d8ad1376a"
    GetInteractiveMarkers, GetInteractiveMarkersRequest, GetInteractiveMarkersResponse
}
