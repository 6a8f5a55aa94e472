//! Every robot with a drive is spawned in its world, or on a plane in the sun, driven along a
//! circle: it must move, and publish only finite numbers.
//!
//! `cargo xtask drive` runs it and shows the table.
#![allow(clippy::disallowed_methods, clippy::print_stdout, reason = "a test at the edge")]
#![allow(missing_docs, clippy::unwrap_used, reason = "tests")]

mod ears;
mod known;
mod sound;
mod trial;

use std::collections::{BTreeMap, BTreeSet};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::Instant;

use periplus_loader::LoadContext;
use periplus_os::Machine;
use periplus_resources::Resolver;
use periplus_sim::{PhysicsMode, RobotPlacement};

use trial::{Report, Trial, drive};

/// The robots of a file, or why there are none.
fn tried(
    path: &Path,
    robots: &[RobotPlacement],
    name: &str,
    seconds: i64,
    mode: PhysicsMode,
    setting: &LoadContext<'_>,
) -> Report {
    let run = || drive(path, robots, name, seconds, mode, setting);
    catch_unwind(AssertUnwindSafe(run)).unwrap_or_else(|panic| {
        let why = panic.downcast_ref::<String>().cloned();
        let why = why.or_else(|| panic.downcast_ref::<&str>().map(|&text| text.to_owned()));
        let fault = format!("PANIC: {}", why.unwrap_or_default());
        Report { trials: vec![Trial::failed(name, fault)], ..Report::default() }
    })
}

fn with_setting<T>(
    folder: &Path,
    search: &[PathBuf],
    run: impl FnOnce(&LoadContext<'_>) -> T,
) -> T {
    let host = Machine;
    let resolver = Resolver::new(&host, search);
    let working_folder = folder.to_owned();
    let arguments = Vec::new();
    run(&LoadContext {
        host: &host,
        resolver: &resolver,
        working_folder,
        arguments,
        open_meshes: false,
    })
}

#[test]
fn our_robots_drive_and_measure() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..");
    let sam_bot = root.join("robots/sam_bot/urdf/sam_bot.urdf.xacro");
    let kbot = root.join("robots/kbot/urdf/kbot.urdf.xacro");
    let in_room = RobotPlacement { file: sam_bot.clone(), ..RobotPlacement::default() };
    let runs: [(&str, PathBuf, &[RobotPlacement]); 4] = [
        ("sam_bot", sam_bot, &[]),
        ("sam_bot in the room", root.join("worlds/closed_room.world"), &[in_room]),
        ("kbot", kbot, &[]),
        ("pong", root.join("worlds/pong.sdf"), &[]),
    ];
    with_setting(&root, &[], |setting| {
        for (name, path, robots) in runs {
            let report = tried(&path, robots, name, 2, PhysicsMode::Rigid, setting);
            assert!(!report.trials.is_empty(), "{name}: no robot with a drive");
            for trial in report.trials {
                assert!(trial.faults.is_empty(), "{trial:?}");
                assert!(trial.sensors > 0 && trial.messages > 100, "{trial:?}");
                assert!((0.3..0.7).contains(&trial.moved_m), "{trial:?}");
                assert!((0.3..0.7).contains(&trial.turned_rad), "{trial:?}");
            }
        }
    });
}

#[test]
fn every_robot_of_the_corpus_drives_and_measures() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared/corpus");
    let corpus = std::env::var_os("PERIPLUS_DRIVE_FOLDER").map_or(corpus, PathBuf::from);
    let Ok(corpus) = corpus.canonicalize() else {
        println!("SKIPPED: there is no ../shared/corpus to drive");
        return;
    };
    let mut paths = Vec::new();
    collect(&corpus, &mut paths);
    paths.sort();
    // To look into some of them.
    let only = std::env::var("PERIPLUS_DRIVE_ONLY").ok();
    if let Some(only) = &only {
        paths.retain(|path| path.display().to_string().contains(only));
    }
    let search = [corpus.join("gazebo_models")];
    let mut table = Table::default();
    with_setting(&corpus, &search, |setting| {
        for path in &paths {
            let name = path.strip_prefix(&corpus).unwrap_or(path).display().to_string();
            for mode in [PhysicsMode::Rigid, PhysicsMode::Kinematic] {
                let started = Instant::now();
                let report = tried(path, &[], &name, 5, mode, setting);
                table.add(report, started.elapsed().as_secs_f64());
            }
        }
    });
    table.tell(paths.len());
    assert!(table.unexplained.is_empty(), "not explained: {:#?}", table.unexplained);
    let idle: Vec<_> = known::KNOWN.iter().filter(|known| !table.used.contains(known)).collect();
    assert!(only.is_some() || idle.is_empty(), "explained, but seen no more: {idle:#?}");
}

/// Final report.
#[derive(Default)]
struct Table {
    verdicts: BTreeMap<&'static str, usize>,
    unexplained: Vec<String>,
    used: BTreeSet<known::Known>,
    findings: BTreeMap<&'static str, (usize, String)>,
}

impl Table {
    fn add(&mut self, report: Report, wall_s: f64) {
        for (index, trial) in report.trials.iter().enumerate() {
            let reasons: Vec<(&String, Option<known::Known>)> = trial
                .faults
                .iter()
                .map(|fault| (fault, known::reason(&trial.robot, fault)))
                .collect();
            let verdict = match (reasons.is_empty(), reasons.iter().all(|(_, why)| why.is_some())) {
                (true, _) => "drives",
                (_, true) => "explained",
                _ => "FAILS",
            };
            *self.verdicts.entry(verdict).or_default() += 1;
            let wall = if index == 0 { format!("{wall_s:.1} s") } else { "-".into() };
            println!(
                "{verdict:9} {:5.2} m {:5.2} rad {:2} topics {:2} sensors {:6} messages {wall:>7} {} [{}]",
                trial.moved_m,
                trial.turned_rad,
                trial.commands,
                trial.sensors,
                trial.messages,
                trial.robot,
                trial.drives.join(", "),
            );
            for (fault, why) in reasons {
                println!("{:10}{fault}: {}", "", why.map_or("NOT EXPLAINED", |(_, _, why)| why));
                self.used.extend(why);
                if why.is_none() {
                    self.unexplained.push(format!("{}: {fault}", trial.robot));
                }
            }
        }
        let robot = report.trials.first().map(|trial| trial.robot.clone()).unwrap_or_default();
        let mut told = BTreeSet::new();
        for (severity, code, message) in report.findings {
            if told.insert(code) {
                let (count, _) = self
                    .findings
                    .entry(code)
                    .or_insert_with(|| (0, format!("{severity:?}: {message} ({robot})")));
                *count += 1;
            }
        }
    }

    fn tell(&self, files: usize) {
        println!("\n{files} files: {:?}", self.verdicts);
        println!("findings, in how many runs, and the first of each:");
        for (code, (count, first)) in &self.findings {
            println!("{count:4} {code}: {first}");
        }
    }
}

fn collect(folder: &Path, into: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("the corpus can be listed").flatten() {
        let path = entry.path();
        let extension = path.extension().and_then(|it| it.to_str()).unwrap_or_default();
        if path.is_dir() {
            collect(&path, into);
        } else if ["xacro", "urdf", "sdf", "world"].contains(&extension) {
            into.push(path);
        }
    }
}
