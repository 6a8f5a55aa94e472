//! All logs of a folder, as they are and perturbed, in one table: `logs FOLDER [--out DIR] [--only
//! NAME] [--runs plain,rotate,..] [--why] [--method graph|gmapping] [--set
//! particles=30,random_seed=2]`. With `--why` it tells which relations carry the error.
#![allow(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "a tool that reads logs, measures time and says how it went"
)]

#[path = "../../tests/carmen/mod.rs"]
mod carmen;
mod perturb;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use periplus_bags::{CarmenLog, read_carmen};
use periplus_base::Pose2;
use periplus_diagnostics::Diagnostics;
use periplus_params::{Given, Values};
use periplus_slam::{
    Cure, Gmapping, GmappingSettings, Mapper, Method, Miss, Relation, Remedy, Score, Settings,
    Slam, Stamped, misses, read_relations, score,
};

use carmen::scan_of;
use perturb::{Copy, RUNS, perturbed};

/// A map whose loops are off by more in the mean is wrong \[m\].
const WRONG_M: f64 = 0.12;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let after = |name: &str| {
        arguments.iter().position(|it| it == name).and_then(|at| arguments.get(at + 1)).cloned()
    };
    let folder = PathBuf::from(arguments.first().cloned().unwrap_or("../shared/datasets".into()));
    let out = after("--out").map(PathBuf::from);
    let only = after("--only");
    let runs = after("--runs");
    let method: Method = after("--method").map_or(Method::Graph, |it| it.parse().unwrap());
    let values = values(method, &after("--set").unwrap_or_default());
    println!(
        "{:<22} {:>6} {:>7} {:>7} {:>7} {:>7} {:>6} | {:>6} {:>6} {:>6} | {:>5} {:>5} {:>4} {:>6} {:>6}",
        "log",
        "scans",
        "all m",
        "local",
        "loop",
        "max",
        "rot",
        "ms",
        "p99",
        "worst",
        "kept",
        "ties",
        "lost",
        "loops",
        "kB"
    );
    let mut folders: Vec<PathBuf> =
        fs::read_dir(&folder).unwrap().map(|it| it.unwrap().path()).collect();
    folders.sort();
    let only: Option<Vec<String>> = only.map(|it| it.split(',').map(str::to_owned).collect());
    for folder in folders {
        let name = folder.file_name().unwrap().to_string_lossy().into_owned();
        let is_wanted = only.as_ref().is_none_or(|only| only.contains(&name));
        let Ok(text) = fs::read(folder.join("raw.clf")) else { continue };
        if !is_wanted {
            continue;
        }
        let relations = relations(&folder);
        let log = read_carmen(&text);
        let truth = fs::read_to_string(folder.join("truth.txt")).ok().map(|text| poses(&text));
        let mut loops: BTreeMap<&str, Vec<Score>> = BTreeMap::new();
        for run in RUNS {
            if runs.as_ref().is_some_and(|runs| !runs.split(',').any(|it| it == run)) {
                continue;
            }
            let score = race(
                &values,
                &format!("{name} {run}"),
                &perturbed(&log, run),
                &log,
                &relations,
                truth.as_deref().filter(|_| run != "drop"),
                out.as_deref(),
            );
            if run != "plain" {
                loops.entry("perturbed").or_default().push(score);
            }
        }
        if let Some(scores) = loops.get("perturbed").filter(|it| it.len() > 1) {
            let median = |value: fn(&Score) -> f64| {
                let mut values: Vec<f64> = scores.iter().map(value).collect();
                values.sort_by(f64::total_cmp);
                values[values.len() / 2]
            };
            println!(
                "{:<22} {:>6} {:>7.4} {:>7.4} {:>7.4} {:>7.3} {:>6.3}",
                format!("{name} median"),
                "",
                median(|it| it.all.mean_m),
                median(|it| it.local.mean_m),
                median(|it| it.loops.mean_m),
                median(|it| it.all.most_m),
                median(|it| it.all.mean_deg)
            );
        }
    }
}

fn relations(folder: &Path) -> Vec<Relation> {
    let names = ["intel.clean.relations", "aces.relations", "agreement.relations"];
    let text = names.iter().find_map(|name| fs::read_to_string(folder.join(name)).ok());
    read_relations(&text.unwrap_or_default()).unwrap()
}

/// Nanoseconds of this thread on a CPU.
fn cpu_ns() -> u64 {
    let text = fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split_whitespace().next().and_then(|it| it.parse().ok()).unwrap_or(0)
}

/// What `name=value,name=value` says.
fn values(method: Method, words: &str) -> Values {
    let mut diagnostics = Diagnostics::new();
    let given = words.split(',').filter_map(|word| word.split_once('='));
    let given = given.map(|(name, value)| Given::new(name, value));
    let values = method.table().check(given, None, &mut diagnostics);
    assert!(diagnostics.is_empty(), "{diagnostics:?}");
    values
}

fn mapper(values: &Values) -> Box<dyn Mapper> {
    if values.table() == Method::Gmapping.table() {
        Box::new(Gmapping::new(GmappingSettings::of(values)))
    } else {
        Box::new(Slam::new(Settings::of(values)))
    }
}

/// Maps a log; gives CPU for each scan and for what follows the last \[ns\].
fn drive(slam: &mut dyn Mapper, copy: &Copy, remedy: Option<Remedy>) -> (Vec<u64>, u64) {
    let mut spent: Vec<u64> = Vec::with_capacity(copy.scans.len());
    let mut cure = remedy.map(Cure::new);
    for scan in &copy.scans {
        let begin = cpu_ns();
        let mut odometry = scan.odom_from_base;
        let mut scan = scan_of(scan);
        if let Some(cure) = &mut cure {
            (scan, odometry) = cure.apply(&scan, odometry);
        }
        let _ = slam.add_scan(&scan, odometry);
        spent.push(cpu_ns() - begin);
    }
    let begin = cpu_ns();
    slam.finish();
    (spent, cpu_ns() - begin)
}

fn race(
    values: &Values,
    name: &str,
    copy: &Copy,
    log: &CarmenLog,
    relations: &[Relation],
    truth: Option<&[Pose2]>,
    out: Option<&Path>,
) -> Score {
    let mut slam = mapper(values);
    let (mut spent, mut finish) = drive(&mut *slam, copy, None);
    let remedy = Remedy::of(slam.remarks());
    if let Some(remedy) = remedy {
        slam = mapper(values);
        (spent, finish) = drive(&mut *slam, copy, Some(remedy));
        println!("    made again: {remedy}");
    }
    let ate = truth.map(|truth| ate(truth, &slam.trajectory()));
    let trajectory: Vec<Stamped> = copy
        .stamps
        .iter()
        .zip(slam.trajectory())
        .map(|(stamp, (_, pose))| (*stamp, pose))
        .collect();
    let scans: Vec<Stamped> =
        log.scans.iter().filter_map(|it| Some((it.time_s, it.odom_from_base?))).collect();
    let between: Vec<Stamped> =
        log.odometry.iter().map(|it| (it.time_s, it.odom_from_base)).collect();
    // What was cut out of the log is not judged.
    let original_s: Vec<f64> = log.scans.iter().map(|it| it.time_s).collect();
    let original = Copy { scans: Vec::new(), stamps: original_s };
    let is_there = |time_s: f64| copy.beside_s(time_s) < original.beside_s(time_s) + 0.5;
    let relations: Vec<Relation> =
        relations.iter().filter(|it| is_there(it.from_s) && is_there(it.to_s)).copied().collect();
    let score = score(&trajectory, &scans, &between, &relations);
    let missed = misses(&trajectory, &scans, &between, &relations);
    let total: u64 = spent.iter().sum::<u64>() + finish;
    spent.sort_unstable();
    let ms = |ns: u64| ns as f64 * 1e-6;
    let counts = slam.counts();
    let accepted = slam.closures().iter().filter(|it| it.is_accepted).count();
    println!(
        "{:<22} {:>6} {:>7.4} {:>7.4} {:>7.4} {:>7.3} {:>6.3} | {:>6.2} {:>6.2} {:>6.1} | {:>5} {:>5} {:>4} {:>6} {:>6}  finish {:.0} ms",
        name,
        counts.scans,
        score.all.mean_m,
        score.local.mean_m,
        score.loops.mean_m,
        score.all.most_m,
        score.all.mean_deg,
        ms(total) / copy.scans.len().max(1) as f64,
        ms(spent[spent.len() * 99 / 100]),
        ms(spent[spent.len() - 1]),
        counts.kept,
        counts.ties,
        counts.lost,
        match slam.method() {
            Method::Graph => format!("{accepted}/{}", slam.closures().len()),
            Method::Gmapping => slam.resamplings().to_string(),
        },
        slam.size() / 1000,
        ms(finish)
    );
    if std::env::args().any(|it| it == "--why") {
        why(&missed, &scans, &between);
    }
    if let Some((rms_m, most_m)) = ate {
        println!("    against the truth: {rms_m:.4} m rms, {most_m:.4} m at most");
    }
    if std::env::args().any(|it| it == "--remarks") {
        for remark in slam.remarks() {
            println!("    {remark}");
        }
    }
    let told: Vec<String> = slam.remarks().iter().map(|it| format!("{:?}", it.doubt)).collect();
    let is_wrong = score.loops.mean_m > WRONG_M;
    if is_wrong && slam.remarks().iter().all(|it| !it.is_warning()) {
        println!("    SILENTLY WRONG {told:?}");
    } else if is_wrong {
        println!("    wrong, told: {told:?}");
    } else if slam.remarks().iter().any(|it| it.is_warning()) {
        println!("    right, yet: {told:?}");
    }
    if let Some(out) = out {
        write(out, &name.replace(' ', "_"), &*slam, copy);
    }
    score
}

/// Which relations carry the error.
fn why(missed: &[Miss], scans: &[Stamped], between: &[Stamped]) {
    let whole: f64 = missed.iter().map(|it| it.shift_m).sum();
    let count = missed.len().max(1) as f64;
    println!("    the mean is {:.4} m; of it come, from relations", whole / count);
    let part = |name: &str, takes: &dyn Fn(&Miss) -> bool| {
        let taken: Vec<&Miss> = missed.iter().filter(|it| takes(it)).collect();
        let sum: f64 = taken.iter().map(|it| it.shift_m).sum();
        println!(
            "      {name:<34} {:.4} m: {:>5} of mean {:.4} m, {:.2} deg",
            sum / count,
            taken.len(),
            sum / taken.len().max(1) as f64,
            taken.iter().map(|it| it.turn_rad.to_degrees()).sum::<f64>()
                / taken.len().max(1) as f64
        );
    };
    let turn = |it: &Miss| it.relation.from_from_to.yaw_rad.abs();
    part("off by less than 0.05 m", &|it| it.shift_m < 0.05);
    part("off by 0.05 to 0.15 m", &|it| (0.05..0.15).contains(&it.shift_m));
    part("off by more than 0.15 m", &|it| it.shift_m >= 0.15);
    part("local, turning less than 10 deg", &|it| it.is_local && turn(it) < 0.1745);
    part("local, turning more", &|it| it.is_local && turn(it) >= 0.1745);
    part("loops", &|it| !it.is_local);
    part("both ends at scans", &|it| it.beside_s <= 0.005);
    part("an end up to 0.5 s beside a scan", &|it| (0.005..0.5).contains(&it.beside_s));
    part("an end farther from any scan", &|it| it.beside_s >= 0.5);
    // Lines that were held up are stamped when they were written, many at once: which of them a
    // stamp means, nobody knows.
    let mut lines: Vec<f64> = between.iter().chain(scans).map(|it| it.0).collect();
    lines.sort_by(f64::total_cmp);
    let is_held_up = |time_s: f64| {
        let (first, last) = (
            lines.partition_point(|it| *it < time_s - 0.02),
            lines.partition_point(|it| *it <= time_s + 0.02),
        );
        let gap_s = |a: usize, b: usize| match (lines.get(a), lines.get(b)) {
            (Some(a), Some(b)) => b - a,
            _ => 0.0,
        };
        last - first >= 4
            || gap_s(first.wrapping_sub(1), first) > 1.5
            || gap_s(last.wrapping_sub(1), last) > 1.5
    };
    let ends = |it: &Miss| [it.relation.from_s, it.relation.to_s];
    part("an end where the logger was held up", &|it| ends(it).into_iter().any(is_held_up));
    part("none there", &|it| !ends(it).into_iter().any(is_held_up));
    part("asking for more than 2 m/s", &|it| {
        let way = it.relation.from_from_to;
        let seconds = (it.relation.to_s - it.relation.from_s).abs();
        libm::hypot(way.x_m, way.y_m) > 0.1 + 2.0 * seconds
    });
    // One bad stamp spoils all relations at it.
    let mut stamps: BTreeMap<i64, (f64, usize)> = BTreeMap::new();
    for it in missed {
        for stamp in [it.relation.from_s, it.relation.to_s] {
            let sum = stamps.entry((stamp * 1e3) as i64).or_default();
            *sum = (sum.0 + it.shift_m, sum.1 + 1);
        }
    }
    let mut worst: Vec<(i64, f64, usize)> = stamps
        .into_iter()
        .map(|(stamp, (sum, count))| (stamp, sum / count as f64, count))
        .collect();
    worst.retain(|it| it.2 >= 3);
    worst.sort_by(|a, b| b.1.total_cmp(&a.1));
    let bad: Vec<i64> = worst.iter().take(20).map(|it| it.0).collect();
    for (stamp, mean_m, count) in worst.iter().take(5) {
        println!(
            "      at {:.3} s {count} relations are off by {mean_m:.3} m",
            *stamp as f64 * 1e-3
        );
    }
    part("at the 20 worst stamps", &|it| {
        [it.relation.from_s, it.relation.to_s].iter().any(|it| bad.contains(&((it * 1e3) as i64)))
    });
}

/// Poses of lines `stamp x y yaw`.
fn poses(text: &str) -> Vec<Pose2> {
    let numbers =
        |line: &str| -> Vec<f64> { line.split(' ').map(|it| it.parse().unwrap()).collect() };
    text.lines().map(numbers).map(|it| Pose2::new(it[1], it[2], it[3])).collect()
}

/// Root mean square and largest error of place after the best rigid alignment.
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

fn write(out: &Path, name: &str, slam: &dyn Mapper, copy: &Copy) {
    fs::create_dir_all(out).unwrap();
    if let Some(map) = slam.map() {
        let mut bytes =
            format!("P5\n{} {}\n255\n", map.lattice.width, map.lattice.height).into_bytes();
        for row in map.rows().rev() {
            bytes.extend(
                row.iter()
                    .map(|&it| if it < 0 { 205 } else { 254 - (i32::from(it) * 254 / 100) as u8 }),
            );
        }
        fs::write(out.join(format!("{name}.pgm")), bytes).unwrap();
    }
    let lines: String = copy
        .stamps
        .iter()
        .zip(slam.trajectory())
        .map(|(stamp, (_, pose))| {
            format!("{stamp:.6} {:.6} {:.6} {:.6}\n", pose.x_m, pose.y_m, pose.yaw_rad)
        })
        .collect();
    fs::write(out.join(format!("{name}.txt")), lines).unwrap();
    let told: String = slam.closures().iter().map(|it| format!("{it:?}\n")).collect();
    fs::write(out.join(format!("{name}.closures")), told).unwrap();
}
