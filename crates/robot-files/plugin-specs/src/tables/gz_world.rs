//! World systems of current Gazebo.

use periplus_params::{NamedEntity, flag, group, integer, number, text};

use super::system;
use crate::PluginSpec;

pub(super) static PLUGINS: &[PluginSpec] = &[
    system!(
        "gz-sim-physics-system",
        ["Physics"],
        World,
        BuiltIn,
        "Moves bodies.",
        [
            group("engine", "Library of the engine: `<filename>`."),
            flag("include_entity_names", "If true, contacts contain entity names.").or("true"),
        ]
    ),
    system!(
        "gz-sim-user-commands-system",
        ["UserCommands"],
        World,
        BuiltIn,
        "Creates, moves and removes models by service.",
        []
    ),
    system!(
        "gz-sim-scene-broadcaster-system",
        ["SceneBroadcaster"],
        World,
        BuiltIn,
        "Publishes the content of the world to windows.",
        [
            number("dynamic_pose_hertz", "Hz", "Poses per second.").or("60").above(0.0),
            number("state_hertz", "Hz", "States per second.").or("60").above(0.0),
        ]
    ),
    system!(
        "gz-sim-log-system",
        ["LogRecord", "LogPlayback"],
        World,
        Kept,
        "Records or plays back the world.",
        [
            text("record_path", "Folder of the record.").also(&["path"]),
            flag("record_resources", "If true, meshes are recorded too.").or("false"),
            number("record_period", "s", "Time between states; 0: each step.").or("0"),
            flag("compress", "If true, the folder is packed.").or("false"),
            text("compress_path", "The packed file."),
            text("record_topic", "A topic that is recorded too.")
                .repeated()
                .naming(NamedEntity::Topic),
            text("playback_path", "Folder that is played back."),
        ]
    ),
    system!(
        "gz-sim-camera-video-recorder-system",
        ["CameraVideoRecorder"],
        World,
        Kept,
        "Records the video of a camera.",
        [
            text("service", "Service that starts and stops it.").naming(NamedEntity::Topic),
            flag("use_sim_time", "If true, it follows simulated time.").or("false"),
            integer("fps", "Images per second.").or("25"),
            integer("bitrate", "Bits per second.").or("2070000"),
        ]
    ),
    system!(
        "gz-sim-log-video-recorder-system",
        ["LogVideoRecorder"],
        World,
        Kept,
        "Records videos from a playback.",
        []
    )
    .open(),
    system!(
        "gz-sim-collada-world-exporter-system",
        ["ColladaWorldExporter"],
        World,
        Kept,
        "Writes the world as COLLADA.",
        []
    ),
    system!(
        "gz-sim-environment-preload-system",
        ["EnvironmentPreload"],
        World,
        Kept,
        "Loads a table of environmental data.",
        [
            text("data", "Path of the table.").required(),
            group("dimensions", "Columns of time and position."),
        ]
    ),
    system!(
        "gz-sim-python-system-loader-system",
        ["PythonSystemLoader"],
        World,
        Kept,
        "Runs a system written in Python.",
        [text("module_name", "The module.").required()]
    )
    .open(),
    system!(
        "gz-sim-acoustic-comms-system",
        ["AcousticComms"],
        World,
        Kept,
        "Carries messages by sound.",
        [
            number("max_range", "m", "Maximum range.").or("1000").above(0.0),
            number("speed_of_sound", "m/s", "Speed.").or("343").above(0.0),
            number("collision_time_per_byte", "s", "Silence after a byte.").or("0"),
            number("collision_time_packet_drop", "s", "Silence after a lost packet.").or("0"),
            group("propagation_model", "Power, noise and seed."),
        ]
    ),
    system!(
        "gz-sim-rf-comms-system",
        ["RFComms"],
        World,
        Kept,
        "Carries messages by radio.",
        [
            group("range_config", "Loss over distance."),
            group("radio_config", "Capacity, power and noise."),
        ]
    ),
    system!(
        "gz-sim-perfect-comms-system",
        ["PerfectComms"],
        World,
        Kept,
        "Carries every message.",
        []
    ),
    system!(
        "gz-sim-entity-semantics-system",
        ["EntitySemantics"],
        World,
        Kept,
        "Gives models categories and tags.",
        []
    )
    .open(),
    system!(
        "gz-sim-free-space-explorer-system",
        ["FreeSpaceExplorer"],
        World,
        Kept,
        "Maps free space by moving a lidar.",
        []
    )
    .open(),
];
