//! Kinds of hostile inputs: seeds, what is done to them, and the commands that read them.

use super::crafted::{self, Input};
use super::mutate::mutated;
use super::random::Random;
use crate::step::root;

/// Arguments that pass a file. `{}` stands for the input, or for all inputs of a batch.
pub(super) type Words = &'static [&'static str];

/// A kind of input.
pub(super) struct Kind {
    pub(super) name: &'static str,
    /// Files under the root of the tree that are changed; their own names end the names of inputs.
    seeds: &'static [&'static str],
    is_text: bool,
    /// Changed seeds.
    changed: usize,
    crafted: fn() -> Vec<Input>,
    /// Name of the input in its folder, where a command looks for it; else a number.
    pub(super) called: Option<&'static str>,
    /// Sound files beside the input: name there, file in the tree.
    pub(super) beside: &'static [(&'static str, &'static str)],
    pub(super) words: Words,
    /// Inputs for one process.
    pub(super) batch: usize,
}

const fn nothing() -> Vec<Input> {
    Vec::new()
}

const KIND: Kind = Kind {
    name: "",
    seeds: &[],
    is_text: true,
    changed: 0,
    crafted: nothing,
    called: None,
    beside: &[],
    words: &["check", "--color", "never", "{}"],
    batch: 20,
};

const CONVERT: Words = &["convert", "{}", "--to", "sdf"];
const LAUNCH: Words = &["launch", "--print", "{}"];
const SIMULATE: Words = &["sim", "{}", "--duration", "0.02", "--ros2", "off", "--quiet"];
const DRIVE: (&str, &str) = ("drive.clf", "xtask/src/attack/seeds/drive.clf");

fn urdf() -> Vec<Input> {
    [crafted::xml("urdf", "robot"), crafted::urdf()].concat()
}

fn xacro() -> Vec<Input> {
    [crafted::xml("xacro", "robot"), crafted::xacro()].concat()
}

fn sdf() -> Vec<Input> {
    [crafted::xml("sdf", "sdf"), crafted::sdf()].concat()
}

fn launch_files() -> Vec<Input> {
    [crafted::xml("launch", "launch"), crafted::launch_xml()].concat()
}

const ROBOTS: &[&str] = &[
    "fuzz/seeds/urdf/*",
    "crates/apps/cli/templates/robot.urdf.xacro",
    "robots/kbot/urdf/kbot.urdf.xacro",
];
const WORLDS: &[&str] =
    &["fuzz/seeds/sdf/*", "crates/apps/cli/templates/world.sdf", "worlds/pong.sdf"];
const PARAMETERS: &[&str] = &[
    "robots/sam_bot/config/nav2_params.yaml",
    "crates/apps/cli/templates/package/nav2_params.yaml",
    "crates/apps/cli/templates/package/slam.yaml",
    "crates/apps/cli/templates/package/ekf.yaml",
];
const MAPS: &[(&str, &str)] = &[("room.pgm", "xtask/src/attack/seeds/room.pgm")];

/// All kinds.
pub(super) const KINDS: &[Kind] = &[
    Kind { name: "urdf", seeds: ROBOTS, changed: 260, crafted: urdf, ..KIND },
    Kind { name: "urdf-to-sdf", seeds: ROBOTS, changed: 60, words: CONVERT, batch: 1, ..KIND },
    Kind {
        name: "xacro",
        seeds: &["fuzz/seeds/xacro/*", "crates/apps/cli/templates/robot.urdf.xacro"],
        changed: 260,
        crafted: xacro,
        ..KIND
    },
    Kind { name: "sdf", seeds: WORLDS, changed: 300, crafted: sdf, ..KIND },
    Kind {
        name: "world-run",
        seeds: WORLDS,
        changed: 60,
        crafted: crafted::sdf,
        words: SIMULATE,
        batch: 1,
        ..KIND
    },
    Kind {
        name: "robot-run",
        seeds: &["crates/apps/cli/templates/robot.urdf.xacro"],
        changed: 40,
        words: SIMULATE,
        batch: 1,
        ..KIND
    },
    Kind {
        name: "stl",
        seeds: &["fuzz/seeds/stl/*"],
        is_text: false,
        changed: 150,
        crafted: crafted::mesh,
        ..KIND
    },
    Kind { name: "obj", seeds: &["fuzz/seeds/obj/*"], changed: 120, ..KIND },
    Kind { name: "collada", seeds: &["fuzz/seeds/collada/*"], changed: 150, ..KIND },
    Kind { name: "gltf", seeds: &["fuzz/seeds/gltf/*"], is_text: false, changed: 150, ..KIND },
    Kind {
        name: "launch",
        seeds: &[
            "crates/apps/cli/tests/launch/tutorials/launch/kbot_maps.launch",
            "robots/kbot/launch/kbot.launch",
        ],
        changed: 120,
        crafted: launch_files,
        ..KIND
    },
    Kind {
        name: "launch-plan",
        seeds: &[
            "crates/apps/cli/tests/launch/tutorials/launch/kbot_maps.launch",
            "robots/kbot/launch/kbot.launch",
        ],
        changed: 40,
        crafted: crafted::launch_xml,
        words: LAUNCH,
        batch: 1,
        ..KIND
    },
    Kind {
        name: "launch-python",
        seeds: &[
            "robots/sam_bot/launch/display.launch.py",
            "crates/apps/cli/templates/package/simulation.launch.py",
        ],
        changed: 40,
        crafted: crafted::launch_python,
        words: LAUNCH,
        batch: 1,
        ..KIND
    },
    Kind {
        name: "map",
        seeds: &["xtask/src/attack/seeds/room.yaml"],
        changed: 100,
        crafted: crafted::map,
        beside: MAPS,
        words: &["map", "info", "{}"],
        batch: 1,
        ..KIND
    },
    Kind {
        name: "map-picture",
        seeds: &["xtask/src/attack/seeds/room.pgm", "fuzz/seeds/map/*"],
        is_text: false,
        changed: 120,
        crafted: crafted::pictures,
        called: Some("room.pgm"),
        beside: &[("room.yaml", "xtask/src/attack/seeds/room.yaml")],
        words: &["map", "info", "room.yaml"],
        batch: 1,
    },
    Kind {
        name: "map-diff",
        seeds: &["xtask/src/attack/seeds/room.yaml"],
        changed: 30,
        crafted: crafted::map,
        beside: &[
            ("room.pgm", "xtask/src/attack/seeds/room.pgm"),
            ("sound.yaml", "xtask/src/attack/seeds/room.yaml"),
        ],
        words: &["map", "diff", "sound.yaml", "{}"],
        batch: 1,
        ..KIND
    },
    Kind {
        name: "parameters",
        seeds: PARAMETERS,
        changed: 200,
        crafted: crafted::yaml,
        words: &["doctor", "{}"],
        ..KIND
    },
    Kind {
        name: "costmap",
        seeds: PARAMETERS,
        changed: 60,
        words: &["doctor", "costmap", "{}"],
        batch: 1,
        ..KIND
    },
    Kind {
        name: "mcap",
        seeds: &["fuzz/seeds/bag/*"],
        is_text: false,
        changed: 200,
        crafted: crafted::bag,
        words: &["bag", "check", "{}"],
        ..KIND
    },
    Kind {
        name: "mcap-info",
        seeds: &["fuzz/seeds/bag/*"],
        is_text: false,
        changed: 80,
        crafted: crafted::bag,
        words: &["bag", "info", "{}"],
        ..KIND
    },
    Kind {
        name: "ros1-bag",
        seeds: &["fuzz/seeds/ros1_bag/*"],
        is_text: false,
        changed: 120,
        words: &["bag", "check", "{}"],
        ..KIND
    },
    Kind {
        name: "database",
        seeds: &["fuzz/seeds/bag_database/*"],
        is_text: false,
        changed: 80,
        words: &["bag", "check", "{}"],
        ..KIND
    },
    Kind {
        name: "metadata",
        seeds: &["fuzz/seeds/bag_metadata/*"],
        changed: 40,
        crafted: crafted::yaml,
        called: Some("metadata.yaml"),
        words: &["bag", "info", "."],
        batch: 1,
        ..KIND
    },
    Kind {
        name: "carmen",
        seeds: &["xtask/src/attack/seeds/drive.clf"],
        changed: 100,
        crafted: crafted::carmen,
        words: &["slam", "{}", "--out", "out", "--quiet"],
        batch: 1,
        ..KIND
    },
    Kind {
        name: "session",
        seeds: &["fuzz/seeds/session/*"],
        is_text: false,
        changed: 60,
        beside: &[DRIVE],
        words: &["slam", "drive.clf", "--session", "{}", "--out", "out", "--quiet"],
        batch: 1,
        ..KIND
    },
    Kind {
        name: "slam-parameters",
        seeds: &["crates/apps/cli/templates/package/slam.yaml"],
        changed: 60,
        crafted: crafted::yaml,
        beside: &[DRIVE],
        words: &["slam", "drive.clf", "--params-file", "{}", "--out", "out", "--quiet"],
        batch: 1,
        ..KIND
    },
    Kind {
        name: "script",
        seeds: &["fuzz/seeds/script/*", "worlds/drives/circle.yaml"],
        changed: 40,
        crafted: crafted::yaml,
        beside: &[("robot.urdf.xacro", "robots/kbot/urdf/drive.xacro")],
        words: &[
            "sim",
            "robot.urdf.xacro",
            "--cmd",
            "{}",
            "--duration",
            "0.02",
            "--ros2",
            "off",
            "--quiet",
        ],
        batch: 1,
        ..KIND
    },
    Kind {
        name: "interface",
        seeds: &["fuzz/seeds/msg_text/*"],
        changed: 60,
        called: Some("msg/A.msg"),
        beside: &[("package.xml", "robots/kbot/package.xml")],
        words: &["interface", "show", "kbot/msg/A", "--interfaces", "."],
        batch: 1,
        ..KIND
    },
    Kind {
        name: "rviz",
        seeds: &[
            "robots/sam_bot/rviz/sam_bot.rviz",
            "crates/apps/cli/templates/package/robot.rviz",
        ],
        changed: 40,
        ..KIND
    },
];

impl Kind {
    /// All inputs, the same for the same seed: end of the name, and bytes.
    pub(super) fn inputs(&self, seed: u64) -> Vec<(String, Vec<u8>)> {
        let crafted = (self.crafted)().into_iter().map(|(end, bytes)| (end.to_owned(), bytes));
        let seeds = seed_files(self.seeds);
        let changed = (0..self.changed).map(|number| {
            let mut random = Random::of(seed, self.name, number);
            let (end, bytes) = random.pick(&seeds).clone();
            (end, mutated(&bytes, self.is_text, &mut random))
        });
        crafted.chain(changed).collect()
    }
}

/// Ends of names and contents; `folder/*` stands for all files of a folder.
fn seed_files(patterns: &[&str]) -> Vec<(String, Vec<u8>)> {
    let mut paths = Vec::new();
    for pattern in patterns {
        match pattern.strip_suffix("/*") {
            Some(folder) => {
                let entries = std::fs::read_dir(root().join(folder)).into_iter().flatten();
                let mut files: Vec<_> = entries.filter_map(|it| Some(it.ok()?.path())).collect();
                files.sort();
                paths.extend(files);
            }
            None => paths.push(root().join(pattern)),
        }
    }
    let file = |path: std::path::PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        // Seeds of fuzz targets may have no extension: the folder gives their kind.
        let folder = path.parent().and_then(|it| it.file_name()).unwrap_or_default();
        let end = match name.split_once('.') {
            Some((_, end)) => end.to_owned(),
            None => match folder.to_string_lossy().as_ref() {
                "collada" => "dae".to_owned(),
                "ros1_bag" => "bag".to_owned(),
                folder => folder.to_owned(),
            },
        };
        (end, std::fs::read(&path).unwrap_or_default())
    };
    paths.into_iter().map(file).filter(|(_, bytes)| !bytes.is_empty()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inputs_are_many_and_always_the_same() {
        let mut all = 0;
        for kind in KINDS {
            let (first, again) = (kind.inputs(1), kind.inputs(1));
            assert!(first == again, "{}", kind.name);
            assert!(!first.is_empty(), "{}", kind.name);
            assert!(kind.changed == 0 || first != kind.inputs(2), "{}", kind.name);
            if kind.batch == 1 || kind.called.is_none() {
                assert!(kind.words.contains(&"{}") || kind.called.is_some(), "{}", kind.name);
            }
            all += first.len();
        }
        assert!(all >= 3000, "{all} inputs");
    }

    #[test]
    fn no_seed_is_missing() {
        for kind in KINDS {
            for pattern in kind.seeds {
                assert!(!seed_files(&[pattern]).is_empty(), "{}: {pattern}", kind.name);
            }
            for (_, file) in kind.beside {
                assert!(root().join(file).is_file(), "{}: {file}", kind.name);
            }
        }
    }
}
