//! The same absolute and relative pose errors as PyPI's `evo`, on ten generated pairs of trajectories. Skipped
//! with a message where `evo` is missing.
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]
#![allow(clippy::disallowed_methods, reason = "a test with another program looks for it")]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use periplus_evaluation::{
    AlignmentMethod, ErrorStatistics, PairSelection, PoseRelation, RelativeDelta, StampedPose,
    Trajectory, align, ape, associate, rpe,
};
use periplus_geometry::{Pose, Rpy, Stream};

/// Maximum difference of a statistic, relative to values above 1.
const MAX_DIFFERENCE: f64 = 1e-6;

/// Number of pairs of trajectories.
const PAIR_COUNT: u64 = 10;

/// A Python with `evo`: `PERIPLUS_PYTHON`, or `python3`.
fn python() -> Option<PathBuf> {
    let given = std::env::var_os("PERIPLUS_PYTHON").map(PathBuf::from);
    let python = given.unwrap_or_else(|| "python3".into());
    let asked = Command::new(&python).args(["-c", "import evo"]).output();
    if asked.is_ok_and(|it| it.status.success()) {
        return Some(python);
    }
    eprintln!("SKIPPED: no evo to compare with; `pip install evo`, and set PERIPLUS_PYTHON");
    None
}

/// A random walk in space and a drifting, moved, scaled and thinned estimate of it, at stamps that are a
/// few milliseconds apart.
fn trajectories(number: u64) -> [Trajectory; 2] {
    let mut stream = Stream::keyed(7, "evo", number);
    let mut truth = Pose::IDENTITY;
    let mut estimate =
        Pose::from_xyz_rpy([3.0, -2.0, 1.0], Rpy { roll: 0.1, pitch: -0.2, yaw: 2.0 });
    let scale = 1.0 + 0.1 * number as f64;
    let planar = if number.is_multiple_of(2) { 1.0 } else { 0.1 };
    let mut poses = [Vec::new(), Vec::new()];
    for tick in 0..250_u32 {
        let stamp_s = 1.7e9 + 0.1 * f64::from(tick);
        poses[0].push(StampedPose { stamp_s, pose: truth });
        // Of the odd pairs the estimate has more poses than a reference, which is thinned below.
        if number % 2 == 1 || tick % 3 != 0 {
            let stamp_s = stamp_s + 0.004 * (stream.unit() - 0.5);
            poses[1].push(StampedPose { stamp_s, pose: estimate });
        }
        let mut turn = || 0.15 * planar * (stream.unit() - 0.5);
        let (roll, pitch) = (turn(), turn());
        let yaw = 0.2 * stream.normal();
        let step = Pose::from_xyz_rpy([0.2 * stream.unit(), 0.0, 0.0], Rpy { roll, pitch, yaw });
        let noise = Rpy { roll: 0.0, pitch: 0.002 * stream.normal(), yaw: 0.01 * stream.normal() };
        let drift =
            Pose::from_xyz_rpy([0.01 * stream.normal(), 0.01 * stream.normal(), 0.0], noise);
        truth = truth * step;
        let scaled = Pose { translation: step.translation * scale, ..step };
        estimate = estimate * scaled * drift;
    }
    if number % 2 == 1 {
        poses[0] = poses[0].iter().step_by(2).copied().collect();
    }
    poses.map(Trajectory::new)
}

const ALIGNMENTS: [(&str, AlignmentMethod); 5] = [
    ("none", AlignmentMethod::None),
    ("origin", AlignmentMethod::Origin),
    ("se3", AlignmentMethod::Se3),
    ("sim3", AlignmentMethod::Sim3),
    ("scale", AlignmentMethod::Scale),
];

const DELTAS: [(&str, RelativeDelta); 3] = [
    ("frames", RelativeDelta::Frames(3)),
    ("metres", RelativeDelta::Metres(1.5)),
    ("radians", RelativeDelta::Radians(0.4)),
];

/// Statistics by the names of `evo/scores.py`.
fn scores([truth, estimate]: &[Trajectory; 2]) -> BTreeMap<String, ErrorStatistics> {
    let pairs = associate(truth, estimate, 0.01);
    let mut scores = BTreeMap::new();
    for relation in PoseRelation::ALL {
        let name = relation.evo_name();
        for (method, alignment) in ALIGNMENTS {
            let aligned = align(&pairs, alignment).unwrap().apply_to(&pairs);
            let errors = ErrorStatistics::of(&ape(&aligned, relation)).unwrap();
            scores.insert(format!("ape {name} {method}"), errors);
        }
        for (unit, delta) in DELTAS {
            for all_pairs in [false, true] {
                let selection = PairSelection { delta, all_pairs, ..PairSelection::default() };
                let errors = ErrorStatistics::of(&rpe(&pairs, relation, selection)).unwrap();
                scores.insert(format!("rpe {name} {unit} {all_pairs}"), errors);
            }
        }
    }
    scores
}

#[test]
fn errors_are_those_of_evo() {
    let Some(python) = python() else { return };
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("evo");
    let mut ours = BTreeMap::new();
    for number in 0..PAIR_COUNT {
        let folder = folder.join(number.to_string());
        std::fs::create_dir_all(&folder).unwrap();
        let pair = trajectories(number);
        for (name, trajectory) in ["truth.tum", "estimate.tum"].iter().zip(&pair) {
            std::fs::write(folder.join(name), trajectory.to_tum()).unwrap();
        }
        ours.insert(folder.display().to_string(), scores(&pair));
    }
    let mut program = Command::new(python);
    program.arg(here.join("tests/evo/scores.py")).args(ours.keys());
    // Settings of evo are written to the home folder.
    let output = program.env("HOME", &folder).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let mut compared = 0;
    for line in String::from_utf8(output.stdout).unwrap().lines() {
        // The progress of evo comes before, without the end of a line.
        let Some((_, theirs)) = line.split_once('{') else { continue };
        let theirs: serde_json::Value = serde_json::from_str(&format!("{{{theirs}")).unwrap();
        let ours = &ours[theirs["folder"].as_str().unwrap()];
        for (name, errors) in ours {
            for (statistic, value) in errors.numbers() {
                let expected = theirs["scores"][name][statistic].as_f64().unwrap();
                let difference = (value - expected).abs() / expected.abs().max(1.0);
                assert!(difference < MAX_DIFFERENCE, "{name} {statistic}: {value}, evo {expected}");
                compared += 1;
            }
        }
    }
    assert_eq!(compared, PAIR_COUNT * 5 * (5 + 6) * 7, "statistics of all pairs");
}
