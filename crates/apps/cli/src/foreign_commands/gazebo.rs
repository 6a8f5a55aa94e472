//! `gz ...`, `ign ...`, `gazebo ...`.

use super::answers::{elsewhere, lacking, needless, unknown};
use super::ros2::without;
use super::{Reading, become_words};

/// Subcommands of `gz` that are translated.
const WORDS: [&str; 7] = ["sim", "topic", "service", "model", "sdf", "launch", "gui"];

const RUNNING_NOTE: &str = "it starts running; pause and step it on the page";

pub(super) fn read(program: &str, words: &[String]) -> Reading {
    let Some((verb, rest)) = words.split_first() else {
        return elsewhere(format!("`{program}` needs a subcommand, such as `{program} sim`"));
    };
    match verb.as_str() {
        "sim" | "gazebo" => simulate(program, rest),
        "topic" => topic(program, rest),
        "service" => service(program, rest),
        "model" => model(program, rest),
        "sdf" => description(program, rest),
        "launch" => become_words(&["launch"], rest.to_vec()),
        "log" => become_words(&["bag"], vec!["--help".into()])
            .noting("recordings are bags: `periplus sim WORLD --record FILE.mcap`"),
        "stats" => lacking(
            &format!("{program} stats"),
            "subscribe to the statistics of the world: `periplus topic echo /world/NAME/stats`",
        ),
        "param" => become_words(&["param"], vec!["list".into()]),
        "joint" | "physics" | "camera" => lacking(
            &format!("{program} {verb}"),
            "use the services of the world: `periplus service list`",
        ),
        "msg" => lacking(
            &format!("{program} msg"),
            "message types are those of ROS: `periplus interface show sensor_msgs/msg/LaserScan`",
        ),
        "fuel" => lacking(
            &format!("{program} fuel"),
            "nothing is downloaded: put the folder of the model on GZ_SIM_RESOURCE_PATH or beside the world",
        ),
        "gui" => become_words(&["view"], Vec::new()),
        "world" => lacking(
            &format!("{program} world"),
            "the page pauses, steps and resets; so do `/pause_physics`, `/unpause_physics` and \
             `/reset_simulation` (`periplus service list`)",
        ),
        "plugin" => lacking(
            &format!("{program} plugin"),
            "plugins are built in: `periplus check WORLD` reports unknown ones",
        ),
        "--help" | "-h" => {
            needless(format!("`{program}` takes {}; see `periplus --help`", WORDS.join(", ")))
        }
        other => unknown(program, other, &WORDS),
    }
}

/// `gz sim` and `ign gazebo`.
fn simulate(program: &str, rest: &[String]) -> Reading {
    let (mut words, mut dropped) = (Vec::new(), Vec::new());
    let (mut has_page, mut has_world, mut runs) = (true, false, false);
    let mut has_own_page = false;
    let mut rest = rest.iter();
    while let Some(word) = rest.next() {
        match word.as_str() {
            "-g" => return become_words(&["view"], Vec::new()),
            "-s" => has_page = false,
            "-r" => runs = true,
            "-rs" | "-sr" => (has_page, runs) = (false, true),
            "--headless-rendering" => has_page = false,
            // Periplus options are accepted here too: messages of a run suggest them.
            "--no-browser" => words.push(word.clone()),
            _ if word == "--page" || word.starts_with("--page=") => {
                has_own_page = true;
                words.push(word.clone());
            }
            "--seed" => words.extend(["--seed".to_owned()].into_iter().chain(rest.next().cloned())),
            "--record" => words.extend(["--record".to_owned(), "recording.mcap".to_owned()]),
            "--record-path"
            | "--record-topic"
            | "--playback"
            | "--iterations"
            | "-v"
            | "-z"
            | "--verbose"
            | "--render-engine"
            | "--physics-engine"
            | "--gui-config"
            | "--network-role"
            | "--render-engine-gui"
            | "--render-engine-server" => {
                dropped.push(word.clone());
                dropped.extend(rest.next().cloned());
            }
            _ if word.starts_with('-') => dropped.push(word.clone()),
            _ => {
                has_world = true;
                words.push(word.clone());
            }
        }
    }
    if !has_world {
        return elsewhere(
            "give a world: `periplus sim WORLD.sdf --page`; for a first look, `periplus demo`",
        );
    }
    if has_page && !has_own_page {
        words.push("--page".into());
    }
    // As in Gazebo, Gazebo programs and bridges can connect to the run.
    words.push("--gz".into());
    if program == "ign" {
        words.extend(["--gz-types".into(), "ignition".into()]);
    }
    let reading = without(become_words(&["sim"], words), &dropped);
    if runs { reading } else { reading.noting(RUNNING_NOTE) }
}

/// `gazebo`, `gzserver` and `gzclient` of Gazebo Classic.
pub(super) fn classic(program: &str, rest: &[String]) -> Reading {
    if program == "gzclient" {
        return become_words(&["view"], Vec::new());
    }
    let (mut words, mut dropped) = (Vec::new(), Vec::new());
    let mut has_world = false;
    let mut page = "--page".to_owned();
    let mut rest = rest.iter();
    while let Some(word) = rest.next() {
        match word.as_str() {
            "--seed" => words.extend(["--seed".to_owned()].into_iter().chain(rest.next().cloned())),
            // ROS plugins are built in.
            "-s" | "--server-plugin" | "-g" | "--gui-plugin" => {
                rest.next();
            }
            "-e" | "--physics" | "-p" | "--play" | "--record_path" | "--iters" | "--profile"
            | "-o" | "--record_period" | "--record_filter" => {
                dropped.push(word.clone());
                dropped.extend(rest.next().cloned());
            }
            _ if word.starts_with("--page") => page.clone_from(word),
            "--verbose" | "-u" | "--pause" => dropped.push(word.clone()),
            _ if word.starts_with('-') => dropped.push(word.clone()),
            _ => {
                has_world = true;
                words.push(word.clone());
            }
        }
    }
    if !has_world {
        return elsewhere(
            "give a world: `periplus sim FILE.world --page`; for a first look, `periplus demo`",
        );
    }
    if program == "gazebo" {
        words.push(page);
    }
    without(become_words(&["sim"], words), &dropped)
}

/// Value of a flag.
fn value<'w>(words: &'w [String], flags: &[&str]) -> Option<&'w str> {
    words.iter().enumerate().find_map(|(at, word)| {
        if flags.contains(&word.as_str()) {
            return Some(words.get(at + 1).map_or("", String::as_str));
        }
        flags.iter().find_map(|flag| word.strip_prefix(flag)?.strip_prefix('='))
    })
}

fn has(words: &[String], flags: &[&str]) -> bool {
    words.iter().any(|word| flags.contains(&word.as_str()))
}

fn topic(program: &str, words: &[String]) -> Reading {
    let name = value(words, &["-t", "--topic"]).unwrap_or_default().to_owned();
    if has(words, &["-l", "--list"]) {
        return become_words(&["topic", "list", "--gz"], Vec::new());
    }
    if name.is_empty() {
        return elsewhere(format!(
            "`{program} topic` takes `-l`, or `-t TOPIC` with `-e`, `-i` or `-p`"
        ));
    }
    if has(words, &["-i", "--info"]) {
        return become_words(&["topic", "info"], vec![name]);
    }
    if has(words, &["-f", "--freq", "--frequency"]) {
        return become_words(&["topic", "hz"], vec![name]);
    }
    if let Some(text) = value(words, &["-p", "--pub"]) {
        let wanted = value(words, &["-m", "--msgtype"]).unwrap_or_default();
        return match type_of(wanted) {
            Some(type_name) => {
                let values = if text.is_empty() { "{}".to_owned() } else { yaml(text) };
                let words = vec![name, type_name.to_owned(), values, "--once".to_owned()];
                become_words(&["topic", "pub"], words)
            }
            None => lacking(
                &format!("{program} topic -m {wanted}"),
                "give the ROS type: `periplus topic pub TOPIC geometry_msgs/msg/Twist VALUES`",
            ),
        };
    }
    let once = value(words, &["-n", "--num"]) == Some("1");
    let mut ours = vec![name];
    ours.extend(once.then(|| "--once".to_owned()));
    ours.extend(has(words, &["--json-output"]).then(|| "--json".to_owned()));
    become_words(&["topic", "echo"], ours)
}

/// Gazebo types and the equivalent ROS types.
/// Source: the table in `ros_gz_bridge/README.md`.
const TYPES: [(&str, &str); 19] = [
    ("Boolean", "std_msgs/msg/Bool"),
    ("Clock", "rosgraph_msgs/msg/Clock"),
    ("Color", "std_msgs/msg/ColorRGBA"),
    ("Double", "std_msgs/msg/Float64"),
    ("Empty", "std_msgs/msg/Empty"),
    ("Float", "std_msgs/msg/Float32"),
    ("IMU", "sensor_msgs/msg/Imu"),
    ("Image", "sensor_msgs/msg/Image"),
    ("Int32", "std_msgs/msg/Int32"),
    ("Joy", "sensor_msgs/msg/Joy"),
    ("LaserScan", "sensor_msgs/msg/LaserScan"),
    ("Model", "sensor_msgs/msg/JointState"),
    ("Odometry", "nav_msgs/msg/Odometry"),
    ("PointCloudPacked", "sensor_msgs/msg/PointCloud2"),
    ("Pose", "geometry_msgs/msg/Pose"),
    ("StringMsg", "std_msgs/msg/String"),
    ("Twist", "geometry_msgs/msg/Twist"),
    ("UInt32", "std_msgs/msg/UInt32"),
    ("Vector3d", "geometry_msgs/msg/Vector3"),
];

fn type_of(name: &str) -> Option<&'static str> {
    let short = name.rsplit(['.', '/']).next().unwrap_or(name);
    TYPES.iter().find(|(gz, _)| *gz == short).map(|(_, ros)| *ros)
}

/// A message in text form, as YAML: `linear: {x: 1}, angular: {z: 2}` lacks the outer braces only.
fn yaml(text: &str) -> String {
    let text = text.trim();
    if text.starts_with('{') { text.to_owned() } else { format!("{{{text}}}") }
}

fn service(program: &str, words: &[String]) -> Reading {
    if has(words, &["-l", "--list"]) {
        return become_words(&["service", "list", "--gz"], Vec::new());
    }
    let Some(name) = value(words, &["-s", "--service"]) else {
        return elsewhere(format!("`{program} service` takes `-l`, or `-s SERVICE`"));
    };
    if has(words, &["-i", "--info"]) {
        return become_words(&["service", "info"], vec![name.to_owned()]);
    }
    let request = yaml(value(words, &["-r", "--req"]).unwrap_or_default());
    // Services of a world by the last part of their name, with the types of `ros_gz_interfaces`.
    let (type_name, request) = match name.rsplit('/').next().unwrap_or_default() {
        "control" => ("ControlWorld", format!("{{world_control: {request}}}")),
        "create" => ("SpawnEntity", format!("{{entity_factory: {request}}}")),
        "remove" => ("DeleteEntity", format!("{{entity: {request}}}")),
        other => {
            return lacking(
                &format!("{program} service -s .../{other}"),
                "see `periplus service list -t`, then `periplus service call SERVICE TYPE VALUES`",
            );
        }
    };
    let type_name = format!("ros_gz_interfaces/srv/{type_name}");
    become_words(&["service", "call"], vec![name.to_owned(), type_name, request])
}

fn model(program: &str, words: &[String]) -> Reading {
    if has(words, &["--list", "-l"]) {
        let call = ["/get_model_list", "gazebo_msgs/srv/GetModelList"];
        return become_words(&["service", "call"], call.map(str::to_owned).to_vec());
    }
    match value(words, &["-m", "--model", "--model-name"]) {
        Some(name) => {
            let request = format!("{{name: {name}}}");
            let call = ["/get_entity_state", "gazebo_msgs/srv/GetEntityState", request.as_str()];
            become_words(&["service", "call"], call.map(str::to_owned).to_vec())
        }
        None => elsewhere(format!("`{program} model` takes `--list` or `-m MODEL`")),
    }
}

fn description(program: &str, words: &[String]) -> Reading {
    if let Some(file) = value(words, &["-p", "--print"]) {
        return become_words(&["convert"], vec![file.to_owned(), "--to".into(), "sdf".into()]);
    }
    if let Some(file) = value(words, &["-k", "--check"]) {
        return become_words(&["check"], vec![file.to_owned()]);
    }
    lacking(&format!("{program} sdf"), "other than `-p FILE` (print as SDF) and `-k FILE` (check)")
}
