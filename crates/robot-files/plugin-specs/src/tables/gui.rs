//! GUI plugins of current Gazebo.

use periplus_params::{NamedEntity, Parameter, choice, flag, group, number, numbers, text};

use super::panel;
use crate::PluginSpec;
use crate::known::{listens, publishes};

const TOPIC: Parameter = text("topic", "The topic.").naming(NamedEntity::Topic);

const TOPIC_PICKER: Parameter =
    flag("topic_picker", "If true, the topic can be chosen.").or("true");

/// Parameters of both 3D views.
macro_rules! view {
    ($id:literal, $doc:literal) => {
        panel!(
            $id,
            Viewer,
            $doc,
            [
                choice("engine", &["ogre", "ogre2", "optix"], "Rendering engine.").or("ogre2"),
                text("scene", "Name of the scene.").or("scene"),
                numbers("ambient_light", "", "Red, green, blue.").or("0.3 0.3 0.3"),
                numbers("background_color", "", "Red, green, blue of the sky.").or("0.3 0.3 0.3"),
                numbers("camera_pose", "m", "Initial pose of the view.").or("0 0 5 0 0 0"),
                group("camera_clip", "Minimum and maximum distance."),
                group("camera_follow", "Mode in which the view follows a model."),
                number("horizontal_fov", "deg", "Horizontal field of view.").above(0.0),
                text("view_controller", "`orbit` or `ortho`."),
                group("sky", "If true, a sky is drawn."),
                text("graphics_api", "`opengl`, `vulkan` or `metal`."),
                flag("fullscreen", "If true, it fills the screen.").or("false"),
                flag("visible", "If true, it is shown."),
            ]
        )
        .open()
    };
}

pub(super) static PLUGINS: &[PluginSpec] = &[
    view!("MinimalScene", "The 3D view."),
    view!("GzScene3D", "The 3D view of Fortress and before."),
    view!("Scene3D", "The 3D view of the first releases."),
    panel!("GzSceneManager", Viewer, "Fills the 3D view.", []),
    panel!("TransportSceneManager", Viewer, "Fills the 3D view over topics.", []).open(),
    panel!("InteractiveViewControl", Viewer, "Turns the view by mouse.", []),
    panel!(
        "CameraTracking",
        Viewer,
        "Follows models with the view.",
        [
            text("follow_target", "Followed from the start."),
            numbers("follow_offset", "m", "Offset of the view from the model."),
            number("follow_pgain", "", "Gain of the motion that follows."),
        ]
    )
    .open(),
    panel!("CameraTrackingConfig", Viewer, "Sets how the view follows.", []).open(),
    panel!("CameraFps", Viewer, "Shows images per second.", []),
    panel!("EntityContextMenuPlugin", Viewer, "The menu on a right click.", []),
    panel!("EntityContextMenu", Viewer, "The menu on a right click.", []),
    panel!("EntityTree", Viewer, "The tree of models.", []),
    panel!("ComponentInspector", Viewer, "Properties of a model.", []),
    panel!("ComponentInspectorEditor", Viewer, "Edits a model.", []),
    panel!("ModelEditor", Viewer, "Edits a model.", []).open(),
    panel!("SelectEntities", Viewer, "Selects by click.", []),
    panel!("Spawn", Viewer, "Adds new models at the clicked position.", []),
    panel!("Shapes", Viewer, "Adds shapes.", []),
    panel!("Lights", Viewer, "Adds lights.", []),
    panel!("TransformControl", Viewer, "Moves and turns models.", []).open(),
    panel!("MarkerManager", Viewer, "Draws markers.", []).open(),
    panel!("Screenshot", Viewer, "Saves a picture.", []).open(),
    panel!(
        "VideoRecorder",
        Viewer,
        "Records a video.",
        [group("record_video", "Format and bit rate of the video.")]
    )
    .open(),
    panel!("VisualizationCapabilities", Viewer, "Draws collisions, joints, masses.", []),
    panel!("VisualizeContacts", Viewer, "Draws contacts.", []).open(),
    panel!("VisualizeFrustum", Viewer, "Draws the view of a camera.", []).open(),
    panel!("VisualizeLidar", Viewer, "Draws the rays of a lidar.", []).open(),
    panel!("GlobalIlluminationVct", Viewer, "Indirect light.", []).open(),
    panel!("GlobalIlluminationCiVct", Viewer, "Indirect light.", []).open(),
    panel!("ViewAngle", Viewer, "Views from the sides.", []).open(),
    panel!("ViewControl", Viewer, "Mode in which the view rotates.", []).open(),
    panel!("AlignTool", Viewer, "Aligns models.", []),
    panel!("Grid3D", Viewer, "Draws a grid.", [group("insert", "A grid.").repeated()]).open(),
    panel!("GridConfig", Viewer, "Draws a grid.", [group("insert", "A grid.").repeated()]).open(),
    panel!("CopyPaste", Viewer, "Copies models.", []),
    panel!("TapeMeasure", Viewer, "Measures distances.", []),
    panel!("MouseDrag", Viewer, "Drags models by mouse.", []).open(),
    panel!("ApplyForceTorque", Viewer, "Pushes models.", []),
    panel!("BananaForScale", Viewer, "A banana as a size reference.", []),
    panel!("DropFromFuel", Viewer, "Drops models from Fuel.", []),
    panel!("ResourceSpawner", Viewer, "Adds models from disk and Fuel.", []),
    panel!(
        "JointPositionController",
        Viewer,
        "Moves joints by sliders.",
        [text("model_name", "The model."), text("joint_name", "A joint that is shown.").repeated(),]
    )
    .open(),
    panel!("PlaybackScrubber", Viewer, "Moves through a record.", []),
    panel!("LogPlaybackStatistics", Viewer, "Publishes the state of a playback.", []).open(),
    panel!("Plotting", Viewer, "Plots over time.", []).open(),
    panel!("TransportPlotting", Viewer, "Plots topics over time.", []).open(),
    panel!(
        "Plot3D",
        Viewer,
        "Draws the path of a model.",
        [
            text("entity_name", "The model or link."),
            numbers("color", "", "Red, green, blue."),
            numbers("offset", "m", "Offset of the pen from the model."),
            number("minimum_distance", "m", "Minimum distance between points.").min(0.0),
            number("maximum_points", "", "Points that are kept.").min(0.0),
        ]
    ),
    panel!(
        "KeyPublisher",
        Viewer,
        "Publishes keys.",
        [text("topic", "Topic of the keys.").or("keyboard/keypress").naming(NamedEntity::Topic)]
    )
    .topics(&[publishes("/keyboard/keypress").set_by("topic")]),
    panel!(
        "KeyboardPlugin",
        Kept,
        "Drives by keys.",
        [
            text("twist_arrows", "Topic that the arrows drive.").naming(NamedEntity::Topic),
            text("twist_wasd", "Topic that letters drive.").naming(NamedEntity::Topic),
            group("scale_linear", "Scale of the speed."),
            group("scale_angular", "Turn rates."),
        ]
    )
    .open(),
    panel!(
        "JoyPlugin",
        Kept,
        "Publishes a joystick.",
        [
            text("dev", "The device.").or("/dev/input/js0"),
            flag("sticky_buttons", "If true, the button is a toggle.").or("false"),
            number("dead_zone", "", "Deflections below this value are ignored.")
                .or("0.05")
                .min(0.0),
            number("rate", "Hz", "Messages per second.").or("1").min(0.0),
            number("accumulation_rate", "Hz", "Rate at which deflections are read.")
                .or("1000")
                .min(0.0),
        ]
    ),
    panel!("Teleop", Viewer, "Drives by buttons and keys.", [TOPIC]).open(),
    panel!("ImageDisplay", Viewer, "Shows images.", [TOPIC, TOPIC_PICKER])
        .topics(&[listens("/image").set_by("topic")]),
    panel!("PointCloud", Viewer, "Draws points.", [TOPIC]).open(),
    panel!("NavSatMap", Viewer, "Shows a map of the Earth.", [TOPIC, TOPIC_PICKER]).open(),
    panel!("Publisher", Viewer, "Publishes a message.", []).open(),
    panel!("TopicEcho", Viewer, "Shows messages.", []).open(),
    panel!("TopicViewer", Viewer, "Lists topics.", []).open(),
    panel!("TopicsStats", Viewer, "Counts messages.", []).open(),
    panel!("EnvironmentLoader", Kept, "Loads environmental data.", []).open(),
    panel!("EnvironmentVisualization", Kept, "Draws environmental data.", []).open(),
    panel!("ExportOccupancy", Viewer, "Saves a map.", []).open(),
    panel!(
        "WorldControl",
        Viewer,
        "Plays, pauses, steps.",
        [
            flag("play_pause", "If true, a button is shown.").or("false"),
            flag("step", "If true, a button is shown.").or("false"),
            flag("reset", "If true, a button is shown."),
            flag("start_paused", "If true, it starts paused.").or("false"),
            flag("use_event", "If true, it informs the server in the same process.").or("false"),
            text("service", "Service of the world.").naming(NamedEntity::Topic),
            text("stats_topic", "Topic of statistics.").naming(NamedEntity::Topic),
        ]
    ),
    panel!(
        "WorldStats",
        Viewer,
        "Shows the time.",
        [
            flag("sim_time", "If true, it is shown.").or("false"),
            flag("real_time", "If true, it is shown.").or("false"),
            flag("real_time_factor", "If true, it is shown.").or("false"),
            flag("iterations", "If true, it is shown.").or("false"),
            TOPIC,
        ]
    ),
];
