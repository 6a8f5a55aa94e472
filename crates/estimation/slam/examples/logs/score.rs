//! One log, mapped once: errors, time, memory, and a verdict on the map.

use std::fs;
use std::path::Path;

use periplus_bags::CarmenLog;
use periplus_diagnostics::Diagnostics;
use periplus_geometry::{LaserScan2, Pose2};
use periplus_params::{Given, ParamValues};
use periplus_slam::{
    CorrectedInput, Counts, Gmapping, GmappingSettings, Mapper, Method, MountingCorrection,
    Relation, Score, Settings, Slam, Stamped, misses, score,
};

use crate::perturb::Copy;
use crate::why::why;

/// A map whose loops are off by more in the mean is wrong \[m\].
pub(crate) const WRONG_M: f64 = 0.12;
/// Maps of particles whose loops are off by more in the mean are wrong \[m\].
pub(crate) const WRONG_PARTICLES_M: f64 = 0.2;
/// Logs without relations whose last pose relative to the first is known.
///
/// `hospital`: the last scan matched to the first by an exhaustive search over 12 m by 12 m and all
/// headings, in steps of 0.05 m and 0.01 rad, independent of this program. The best pose explains 0.50 of
/// the points within 0.1 m, the best other one 0.18.
const KNOWN_ENDS: [(&str, Pose2); 1] = [("hospital", Pose2::new(-0.19, 1.99, 0.26))];
/// A trajectory is right where it ends no farther from there \[m\].
const END_M: f64 = 1.0;

/// A log of a folder.
pub(crate) struct Log {
    pub(crate) name: String,
    pub(crate) log: CarmenLog,
    pub(crate) relations: Vec<Relation>,
    /// True poses, of logs that have them.
    pub(crate) truth: Option<Vec<Pose2>>,
}

/// Verdict on a map by ground truth; the program's own warnings are only compared with it.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Verdict {
    Right,
    RightWarned,
    WrongWarned,
    SilentlyWrong,
    /// There is no ground truth.
    Unknown,
    UnknownWarned,
}

impl Verdict {
    fn new(is_right: Option<bool>, is_warned: bool) -> Self {
        match (is_right, is_warned) {
            (Some(true), false) => Self::Right,
            (Some(true), true) => Self::RightWarned,
            (Some(false), true) => Self::WrongWarned,
            (Some(false), false) => Self::SilentlyWrong,
            (None, false) => Self::Unknown,
            (None, true) => Self::UnknownWarned,
        }
    }

    pub(crate) const fn words(self) -> &'static str {
        match self {
            Self::Right => "right",
            Self::RightWarned => "right, warned",
            Self::WrongWarned => "wrong, warned",
            Self::SilentlyWrong => "SILENTLY WRONG",
            Self::Unknown => "not judged",
            Self::UnknownWarned => "not judged, warned",
        }
    }
}

/// Result of a run.
pub(crate) struct Outcome {
    pub(crate) log: String,
    pub(crate) run: &'static str,
    pub(crate) method: Method,
    pub(crate) seed: Option<u64>,
    pub(crate) score: Score,
    pub(crate) path_m: f64,
    /// From the first pose to the last \[m\].
    pub(crate) end_m: f64,
    /// From where the robot was at the end to where the trajectory has it, of logs of which that is known \[m\].
    pub(crate) end_error_m: Option<f64>,
    pub(crate) verdict: Verdict,
    /// The fault of the data that was undone, after which the log was mapped again.
    pub(crate) remedy: Option<String>,
    pub(crate) remarks: Vec<String>,
    /// Names of the kinds of remark, each once.
    pub(crate) kinds: Vec<String>,
    pub(crate) counts: Counts,
    /// Closures in the map, and all that were looked at.
    pub(crate) closures: (usize, usize),
    pub(crate) resamplings: usize,
    /// Bytes held at the end, about.
    pub(crate) size: usize,
    /// CPU of this thread \[ms\]: for a scan in the mean, in all but one of a hundred, at most; after the last.
    pub(crate) scan_ms: [f64; 3],
    pub(crate) finish_ms: f64,
    /// More lines for a person.
    pub(crate) notes: String,
}

/// Options of a run that do not change its map.
pub(crate) struct Show<'a> {
    pub(crate) why: bool,
    pub(crate) remarks: bool,
    /// Maps, trajectories and closures are written here.
    pub(crate) out: Option<&'a Path>,
}

/// Nanoseconds of this thread on a CPU. Others beside it do not count.
fn cpu_ns() -> u64 {
    let text = fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split_whitespace().next().and_then(|it| it.parse().ok()).unwrap_or(0)
}

/// The values that `name=value,name=value` sets.
pub(crate) fn values(method: Method, words: &str, seed: Option<u64>) -> ParamValues {
    let mut diagnostics = Diagnostics::new();
    let seed = seed.map(|it| it.to_string());
    let given = words.split(',').filter_map(|word| word.split_once('='));
    let given = given.chain(seed.as_deref().map(|it| ("random_seed", it)));
    let given: Vec<Given> = given.map(|(name, value)| Given::new(name, value)).collect();
    let values = method.table().check(given, None, &mut diagnostics);
    assert!(diagnostics.is_empty(), "{diagnostics:?}");
    values
}

fn mapper(method: Method, values: &ParamValues) -> Box<dyn Mapper> {
    match method {
        Method::Gmapping => Box::new(Gmapping::new(GmappingSettings::of(values))),
        Method::Graph => Box::new(Slam::new(Settings::of(values))),
    }
}

/// A drive through a log.
struct Drive {
    slam: Box<dyn Mapper>,
    /// Scans of the copy that have a pose in the trajectory.
    used: Vec<usize>,
    /// CPU for each scan, and for what follows the last \[ns\].
    spent: Vec<u64>,
    finish: u64,
}

fn drive(
    method: Method,
    values: &ParamValues,
    copy: &Copy,
    remedy: Option<MountingCorrection>,
) -> Drive {
    let mut slam = mapper(method, values);
    let mut spent: Vec<u64> = Vec::with_capacity(copy.scans.len());
    let mut used = Vec::with_capacity(copy.scans.len());
    let mut cure = remedy.map(CorrectedInput::new);
    for (index, scan) in copy.scans.iter().enumerate() {
        let begin = cpu_ns();
        let mut odometry = scan.odom_from_base;
        let mut scan = LaserScan2::from(scan.clone());
        if let Some(cure) = &mut cure {
            (scan, odometry) = cure.apply(&scan, odometry);
        }
        let ignored = slam.counts().ignored;
        let _ = slam.add_scan(&scan, odometry);
        if slam.counts().ignored == ignored {
            used.push(index);
        }
        spent.push(cpu_ns() - begin);
    }
    let begin = cpu_ns();
    slam.finish();
    Drive { slam, used, spent, finish: cpu_ns() - begin }
}

/// Maps a copy of a log, as `periplus slam` does, and judges the map.
pub(crate) fn race(
    log: &Log,
    (run, copy): (&'static str, &Copy),
    (method, values, seed): (Method, &ParamValues, Option<u64>),
    show: &Show<'_>,
) -> Outcome {
    let mut driven = drive(method, values, copy, None);
    let remedy = MountingCorrection::of(driven.slam.remarks());
    if let Some(remedy) = remedy {
        driven = drive(method, values, copy, Some(remedy));
    }
    let Drive { slam, used, mut spent, finish } = driven;
    let poses = slam.trajectory();
    assert_eq!(poses.len(), used.len(), "{} {run}: a pose for each scan that counts", log.name);
    let trajectory: Vec<Stamped> =
        used.iter().zip(&poses).map(|(&index, (_, pose))| (copy.stamps[index], *pose)).collect();
    let scans = &log.log.scans;
    let odometry: Vec<Stamped> =
        scans.iter().filter_map(|it| Some((it.time_s, it.odom_from_base?))).collect();
    let between: Vec<Stamped> =
        log.log.odometry.iter().map(|it| (it.time_s, it.odom_from_base)).collect();
    // What was cut out of the log is not judged.
    let stamps: Vec<f64> = scans.iter().map(|it| it.time_s).collect();
    let original = Copy { scans: Vec::new(), stamps };
    let is_there = |time_s: f64| copy.beside_s(time_s) < original.beside_s(time_s) + 0.5;
    let is_judged = |it: &&Relation| is_there(it.from_s) && is_there(it.to_s);
    let relations: Vec<Relation> = log.relations.iter().filter(is_judged).copied().collect();
    let score = score(&trajectory, &odometry, &between, &relations);

    let path_m = poses
        .windows(2)
        .map(|pair| libm::hypot(pair[1].1.x_m - pair[0].1.x_m, pair[1].1.y_m - pair[0].1.y_m))
        .sum();
    let begin_from_end = match (poses.first(), poses.last()) {
        (Some((_, first)), Some((_, last))) => first.inverse() * *last,
        _ => Pose2::IDENTITY,
    };
    let end_m = libm::hypot(begin_from_end.x_m, begin_from_end.y_m);
    let known_end = KNOWN_ENDS.iter().find(|(name, _)| *name == log.name);
    let end_error_m = known_end.map(|(_, known)| {
        libm::hypot(begin_from_end.x_m - known.x_m, begin_from_end.y_m - known.y_m)
    });
    let wrong_m = match method {
        Method::Graph => WRONG_M,
        Method::Gmapping => WRONG_PARTICLES_M,
    };
    let is_right = if score.loops.count > 0 {
        Some(score.loops.mean_m <= wrong_m)
    } else {
        end_error_m.map(|error_m| error_m <= END_M)
    };
    let remarks = slam.remarks();
    let is_warned = remarks.iter().any(|it| it.is_warning());
    let mut kinds: Vec<String> = Vec::new();
    for remark in remarks {
        let kind = format!("{:?}", remark.kind);
        let kind = kind.split('(').next().unwrap_or_default().to_owned();
        if !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }

    let mut notes = String::new();
    if show.why {
        let missed = misses(&trajectory, &odometry, &between, &relations);
        notes += &why(&missed, &odometry, &between);
    }
    if let Some(truth) = log.truth.as_deref().filter(|it| it.len() == poses.len()) {
        let (rms_m, most_m) = ate(truth, &poses);
        notes += &format!("    against the truth: {rms_m:.4} m rms, {most_m:.4} m at most\n");
    }
    if show.remarks {
        notes.extend(remarks.iter().map(|remark| format!("    {remark}\n")));
    }
    if let Some(out) = show.out {
        let seed = seed.map_or(String::new(), |it| format!("_{it}"));
        write(out, &format!("{}_{run}{seed}", log.name), &*slam, &trajectory);
    }

    let total: u64 = spent.iter().sum::<u64>() + finish;
    spent.sort_unstable();
    let ms = |ns: u64| ns as f64 * 1e-6;
    let worst = spent.len().saturating_sub(1);
    let at = |place: usize| spent.get(place).map_or(0.0, |&it| ms(it));
    let accepted = slam.closures().iter().filter(|it| it.is_accepted).count();
    Outcome {
        log: log.name.clone(),
        run,
        method,
        seed,
        score,
        path_m,
        end_m,
        end_error_m,
        verdict: Verdict::new(is_right, is_warned),
        remedy: remedy.map(|it| it.to_string()),
        remarks: remarks.iter().map(ToString::to_string).collect(),
        kinds,
        counts: slam.counts(),
        closures: (accepted, slam.closures().len()),
        resamplings: slam.resamplings(),
        size: slam.size(),
        scan_ms: [
            ms(total) / copy.scans.len().max(1) as f64,
            at((spent.len() * 99 / 100).min(worst)),
            at(worst),
        ],
        finish_ms: ms(finish),
        notes,
    }
}

/// Root mean square and largest error of position after the best rigid alignment.
fn ate(truth: &[Pose2], trajectory: &[(i64, Pose2)]) -> (f64, f64) {
    let pairs: Vec<(Pose2, Pose2)> =
        truth.iter().zip(trajectory).map(|(truth, (_, found))| (*truth, *found)).collect();
    let count = pairs.len() as f64;
    let mean = |of: fn(&(Pose2, Pose2)) -> f64| pairs.iter().map(of).sum::<f64>() / count;
    let (tx, ty) = (mean(|it| it.0.x_m), mean(|it| it.0.y_m));
    let (fx, fy) = (mean(|it| it.1.x_m), mean(|it| it.1.y_m));
    let (mut along, mut across) = (0.0, 0.0);
    for (truth, found) in &pairs {
        let (a, b, c, d) = (found.x_m - fx, found.y_m - fy, truth.x_m - tx, truth.y_m - ty);
        along += a * c + b * d;
        across += a * d - b * c;
    }
    let (s, c) = across.atan2(along).sin_cos();
    let squares = pairs.iter().map(|(truth, found)| {
        let (a, b) = (found.x_m - fx, found.y_m - fy);
        let (x, y) = (truth.x_m - tx - c * a + s * b, truth.y_m - ty - s * a - c * b);
        x * x + y * y
    });
    let squares: Vec<f64> = squares.collect();
    let most = squares.iter().copied().fold(0.0, f64::max).sqrt();
    ((squares.iter().sum::<f64>() / count).sqrt(), most)
}

fn write(out: &Path, name: &str, slam: &dyn Mapper, trajectory: &[Stamped]) {
    fs::create_dir_all(out).unwrap();
    if let Some(map) = slam.map() {
        let mut bytes = format!("P5\n{} {}\n255\n", map.info.width, map.info.height).into_bytes();
        for row in map.rows().rev() {
            bytes.extend(
                row.iter()
                    .map(|&it| if it < 0 { 205 } else { 254 - (i32::from(it) * 254 / 100) as u8 }),
            );
        }
        fs::write(out.join(format!("{name}.pgm")), bytes).unwrap();
    }
    let lines: String = trajectory
        .iter()
        .map(|(stamp, pose)| {
            format!("{stamp:.6} {:.6} {:.6} {:.6}\n", pose.x_m, pose.y_m, pose.yaw_rad)
        })
        .collect();
    fs::write(out.join(format!("{name}.txt")), lines).unwrap();
    let told: String = slam.closures().iter().map(|it| format!("{it:?}\n")).collect();
    fs::write(out.join(format!("{name}.closures")), told).unwrap();
}
