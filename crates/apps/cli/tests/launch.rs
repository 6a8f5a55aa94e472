//! `periplus launch` on Python files, and on all launch files of other projects on this machine.
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "these tests look at files and the environment")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use expect_test::{ExpectFile, expect, expect_file};

fn periplus(resource_path: &Path, words: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_periplus"));
    command.arg("launch").arg("--resource-path").arg(resource_path).args(words);
    command.env("NO_COLOR", "1").env_remove("AMENT_PREFIX_PATH").env_remove("ROS_PACKAGE_PATH");
    command.output().unwrap()
}

fn own() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/launch")
}

fn has_python() -> bool {
    let has = Command::new("python3").arg("--version").output().is_ok();
    if !has {
        eprintln!("SKIPPED: launch files in Python need a python3");
    }
    has
}

/// Text without parts that differ between machines.
fn neutral(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes).replace(&own().display().to_string(), "OWN");
    let mut out = String::new();
    let mut rest = text.as_str();
    // Generated files of a launch are in a separate folder.
    while let Some(at) = rest.find("/periplus_launch_") {
        let from = rest[..at].rfind('"').map_or(at, |quote| quote + 1);
        out += &rest[..from];
        out += "SCRATCH";
        let name = at + 1 + rest[at + 1..].find('/').unwrap();
        rest = &rest[name..];
    }
    out + rest
}

fn check(file: &str, expected: ExpectFile) {
    if !has_python() {
        return;
    }
    let output = periplus(&own(), &["launch_bot", file, "--print"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    expected.assert_eq(&neutral(&output.stdout));
}

#[test]
fn a_robot_in_a_simulator() {
    check("display.launch.py", expect_file!["launch/bot/plans/display.json"]);
}

#[test]
fn a_managed_node_that_activates_itself() {
    check("slam.launch.py", expect_file!["launch/bot/plans/slam.json"]);
}

#[test]
fn navigation_with_scopes_events_and_rewritten_parameters() {
    check("navigation.launch.py", expect_file!["launch/bot/plans/navigation.json"]);
}

#[test]
fn what_is_wrong_in_python_is_told_with_its_line() {
    if !has_python() {
        return;
    }
    let output = periplus(&own(), &["launch_bot", "broken.launch.py", "--print"]);
    assert_eq!(output.status.code(), Some(1));
    expect![[r#"
        error[launch-python]: OWN/bot/launch/broken.launch.py:7: TypeError: `parameters` of a node is a list

    "#]].assert_eq(&neutral(&output.stderr));
}

#[test]
fn arguments_are_listed() {
    if !has_python() {
        return;
    }
    let output = periplus(&own(), &["launch_bot", "display.launch.py", "-s"]);
    expect![[r#"
        Arguments (pass arguments as '<name>:=<value>'):

            'gui':
                With sliders
                (default: 'True')

            'model':
                The robot
                (default: 'OWN/bot/config/bot.urdf.xacro')

            'use_sim_time':
                no description given
                (default: 'True')
    "#]]
    .assert_eq(&neutral(&output.stdout));
    let output = periplus(&own(), &["launch_bot", "dispaly.launch.py", "-s"]);
    expect![[r#"
        error[launch-file]: the package `launch_bot` (OWN/bot) has no file `dispaly.launch.py`
         │
         ╰ help: did you mean `display.launch.py`?

    "#]]
    .assert_eq(&neutral(&output.stderr));
}

/// Misspelt names of packages and files are corrected: with packages of the same robot, with launch files of
/// the package, and with built-in files of ROS packages.
#[test]
fn names_that_lead_nowhere_lead_to_near_ones() {
    let complaint = |words: &[&str]| {
        let output = periplus(&own(), words);
        assert_eq!(output.status.code(), Some(1), "{words:?}");
        neutral(&output.stderr)
    };
    let proposes = |words: &[&str], wanted: &[&str]| {
        let told = complaint(words);
        for text in wanted {
            assert!(told.contains(text), "{words:?} does not say {text:?}:\n{told}");
        }
    };
    proposes(
        &["launch_bt"],
        &[
            "file launch_bt does not exist",
            "package `launch_bot`",
            "its launch files are ",
            "display.launch.py",
        ],
    );
    proposes(
        &["launch_bot"],
        &[
            "is a package",
            "its launch files are ",
            "display.launch.py",
            "`periplus launch launch_bot FILE`",
        ],
    );
    let file = "display.launch.py";
    let whole = "did you mean `periplus launch launch_bot display.launch.py`?";
    proposes(&["launch_bt", file], &["package `launch_bt` was not found", whole]);
    proposes(&["launch_bot_description", file], &["was not found", whole]);
    proposes(&["launch_bot_bringup", "dispaly.launch.py"], &[whole]);
    // Packages of this repository, around the working folder, without a path.
    proposes(
        &["sam_bot_description", file],
        &["did you mean `periplus launch sam_bot display.launch.py`?"],
    );
    proposes(&["kbot_description"], &["did you mean the package `kbot`?", "kbot.launch"]);
    proposes(&["nav2_bringup"], &["not on this machine", "bringup_launch.py", "built in"]);
    proposes(
        &["nav2_bringup", "tb3_simulation_launch.py"],
        &["`tb3_simulation_launch.py` is not built in", "navigation_launch.py", "--resource-path"],
    );
    proposes(
        &["slam_toolbox", "online_asnc_launch.py"],
        &["did you mean `online_async_launch.py`?"],
    );
    let stranger = complaint(&["entirely_different"]);
    assert!(!stranger.contains("did you mean"), "{stranger}");
}

/// Launch files of other projects, in XML of ROS 1 and in XML, YAML and Python of ROS 2: each has a plan, and
/// arguments without a value are reported by name.
#[test]
fn all_files_of_the_corpus_have_a_plan() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared/corpus");
    if !corpus.exists() {
        eprintln!("SKIPPED: the corpus of launch files is not here ({})", corpus.display());
        return;
    }
    let corpus = corpus.canonicalize().unwrap();
    let mut files = Vec::new();
    collect(&corpus, &mut files);
    if !has_python() {
        files.retain(|file| file.extension().is_none_or(|extension| extension != "py"));
    }
    let mut wrong = String::new();
    for file in &files {
        let mut given: Vec<String> = vec![file.display().to_string(), "--print".into()];
        loop {
            let words: Vec<&str> = given.iter().map(String::as_str).collect();
            let output = periplus(&corpus, &words);
            let told = String::from_utf8_lossy(&output.stderr).into_owned();
            if output.status.success() {
                serde_json::from_slice::<serde_json::Value>(&output.stdout).unwrap();
                break;
            }
            let missing =
                told.split("the argument `").nth(1).and_then(|rest| rest.split('`').next());
            let is_missing = told.contains("not given");
            match missing.filter(|name| is_missing && !given.iter().any(|g| g.starts_with(*name))) {
                Some(name) => given.push(format!("{name}:=something")),
                None => {
                    wrong += &format!("{}\n{told}\n", file.display());
                    break;
                }
            }
        }
    }
    assert!(files.len() >= 50, "{} files", files.len());
    assert!(wrong.is_empty(), "{wrong}");
}

/// Usual extensions of launch files.
const ENDINGS: [&str; 5] = [".launch", "launch.xml", "launch.py", "launch.yaml", "launch.yml"];

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() {
            collect(&path, files);
        } else if ENDINGS.iter().any(|ending| name.ends_with(ending)) {
            files.push(path);
        }
    }
}
