//! Trials and their results.

use periplus_geometry::{Pose2, Stream, normalize_angle};
use periplus_grid::OccupancyGrid;
use periplus_localization::{Amcl, LocalizationState, Settings};

use crate::courses::{Course, Cover, Sight, erased, rearranged};
use crate::worlds::{cpu_s, initial_pose_at};

/// Maximum error of a right pose \[m\], \[rad\].
const MAX_RIGHT_ERROR_M: f64 = 1.0;
const MAX_RIGHT_ERROR_RAD: f64 = std::f64::consts::FRAC_PI_6;
/// Distance driven after a start \[m\].
const WAY_M: f64 = 5.0;
/// Minimum and maximum fraction of a log that is cut out.
const CUT_MIN_RATIO: f64 = 0.05;
const CUT_MAX_RATIO: f64 = 0.3;
/// Maximum number of scans on a wrong map.
const MAX_FOREIGN_SCANS: usize = 1000;

pub(crate) struct Tests {
    pub(crate) settings: Settings,
    pub(crate) runs: usize,
    pub(crate) seed: u64,
}

/// Result of trials.
#[derive(Clone, Default)]
pub(crate) struct Tally {
    course: String,
    test: String,
    runs: usize,
    /// Runs that end sure and right, sure and wrong, not sure.
    right: usize,
    wrong: usize,
    unsure: usize,
    scans: usize,
    sure: usize,
    /// Scans that are sure and wrong.
    sure_wrong: usize,
    /// Consecutive scans of those, and their maximum.
    worst_wrong: usize,
    off_map: usize,
    /// Scans that are sure although the map does not cover them, and their maximum in a run.
    sure_off_map: usize,
    worst_off_map: usize,
    /// Distance from the start to a sure and right pose \[m\].
    ways_m: Vec<f64>,
    squares: f64,
    spent_s: f64,
    worst_s: f64,
    lookups: u64,
    /// Scans from the start to a sure and right pose, summed over runs.
    scans_to_right: usize,
}

impl Tally {
    pub(crate) const HEAD: &str = "| map | test | runs | right | **wrong and sure** | not sure | scans | sure % | wrong while sure | most in a run | off map | sure there | most in a run | m to right | worst | RMS m | ms a scan | worst | lookups a scan | scans to right |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|";

    fn new(course: &str, test: &str) -> Self {
        Self { course: course.to_owned(), test: test.to_owned(), ..Self::default() }
    }

    pub(crate) fn add(&mut self, other: &Self) {
        self.course = "all".into();
        self.runs += other.runs;
        self.right += other.right;
        self.wrong += other.wrong;
        self.unsure += other.unsure;
        self.scans += other.scans;
        self.sure += other.sure;
        self.sure_wrong += other.sure_wrong;
        self.worst_wrong = self.worst_wrong.max(other.worst_wrong);
        self.off_map += other.off_map;
        self.sure_off_map += other.sure_off_map;
        self.worst_off_map = self.worst_off_map.max(other.worst_off_map);
        self.ways_m.extend(&other.ways_m);
        self.squares += other.squares;
        self.spent_s += other.spent_s;
        self.lookups += other.lookups;
        self.scans_to_right += other.scans_to_right;
        self.worst_s = self.worst_s.max(other.worst_s);
    }

    pub(crate) fn line(&self) -> String {
        let count = self.scans.max(1) as f64;
        let right = (self.sure - self.sure_wrong).max(1) as f64;
        let mean = self.ways_m.iter().sum::<f64>() / self.ways_m.len().max(1) as f64;
        let most = self.ways_m.iter().copied().fold(0.0, f64::max);
        format!(
            "| {} | {} | {} | {} | {} | {} | {} | {:.1} | {} | {} | {} | {} | {} | {mean:.2} | {most:.1} | {:.3} | {:.2} | {:.1} | {} | {} |",
            self.course,
            self.test,
            self.runs,
            self.right,
            self.wrong,
            self.unsure,
            self.scans,
            100.0 * self.sure as f64 / count,
            self.sure_wrong,
            self.worst_wrong,
            self.off_map,
            self.sure_off_map,
            self.worst_off_map,
            (self.squares / right).sqrt(),
            1e3 * self.spent_s / count,
            1e3 * self.worst_s,
            self.lookups / self.scans.max(1) as u64,
            self.scans_to_right / self.ways_m.len().max(1),
        )
    }
}

/// Robot in a trial.
struct Robot {
    amcl: Amcl,
    /// Distance since the start \[m\].
    way_m: f64,
    last: Option<Pose2>,
    is_found: bool,
    /// Scans since the start.
    scans: usize,
    wrong: usize,
    off_map: usize,
    state: (bool, bool),
}

impl Robot {
    fn new(amcl: Amcl) -> Self {
        let (last, state) = (None, (false, false));
        Self { amcl, way_m: 0.0, last, is_found: false, scans: 0, wrong: 0, off_map: 0, state }
    }

    /// Processes a sight, with the given odometry; `truth` is none off the map.
    fn see(
        &mut self,
        sight: &Sight,
        odom_from_base: Pose2,
        truth: Option<Pose2>,
        is_covered: bool,
        tally: &mut Tally,
    ) {
        if let Some(last) = self.last {
            self.way_m += apart(last, sight.map_from_base).0;
        }
        self.last = Some(sight.map_from_base);
        self.scans += 1;
        let begin = cpu_s();
        let _ = self.amcl.update(odom_from_base, &sight.scan);
        let spent_s = cpu_s() - begin;
        tally.scans += 1;
        tally.spent_s += spent_s;
        tally.lookups += self.amcl.search_lookup_count();
        tally.worst_s = tally.worst_s.max(spent_s);
        let found = self.amcl.map_from_odom().map(|it| it * odom_from_base);
        let is_sure = self.amcl.status().state == LocalizationState::Tracking;
        let off = found.zip(truth).map(|(found, truth)| apart(truth, found));
        let is_right =
            off.is_some_and(|off| off.0 < MAX_RIGHT_ERROR_M && off.1 < MAX_RIGHT_ERROR_RAD);
        self.state = (is_sure, is_right);
        tally.off_map += usize::from(!is_covered);
        if !is_sure {
            return;
        }
        tally.sure += 1;
        if !is_covered {
            tally.sure_off_map += 1;
            self.off_map += 1;
        }
        if is_right {
            tally.squares += off.map_or(0.0, |off| off.0 * off.0);
            if !self.is_found {
                self.is_found = true;
                tally.ways_m.push(self.way_m);
                tally.scans_to_right += self.scans;
            }
        } else {
            tally.sure_wrong += 1;
            self.wrong += 1;
            if std::env::var("VERBOSE").is_ok() {
                println!(
                    "  {} {} run {}: {:.1} m on, off by {off:.2?} covered {is_covered}: {}",
                    tally.course,
                    tally.test,
                    tally.runs,
                    self.way_m,
                    self.amcl.status().reason
                );
            }
        }
    }

    fn end(self, tally: &mut Tally) {
        if !self.state.0 && std::env::var("VERBOSE").is_ok() {
            let (course, test, status) = (&tally.course, &tally.test, self.amcl.status());
            println!("  {course} {test} run {}: not sure: {}", tally.runs, status.reason);
        }
        tally.runs += 1;
        match self.state {
            (true, true) => tally.right += 1,
            (true, false) => tally.wrong += 1,
            (false, _) => tally.unsure += 1,
        }
        tally.worst_wrong = tally.worst_wrong.max(self.wrong);
        tally.worst_off_map = tally.worst_off_map.max(self.off_map);
    }
}

impl Tests {
    /// Prepares a map once for all runs.
    fn amcl(&self, map: &OccupancyGrid, course: &Course) -> Amcl {
        let mut amcl = Amcl::new(self.settings.clone());
        amcl.set_map("map", map).unwrap();
        let _ = amcl.likelihoods(&course.sights[0].scan);
        amcl
    }

    fn seeded(&self, amcl: &Amcl, run: usize) -> Amcl {
        let mut amcl = amcl.clone();
        let seed = 1000 * self.seed + run as u64;
        amcl.set_settings(Settings { seed, ..self.settings.clone() }).unwrap();
        amcl
    }

    /// The whole drive with a known initial pose.
    pub(crate) fn tracking(&self, course: &Course) -> Tally {
        let mut tally = Tally::new(&course.name, "tracking");
        let cover = Cover::new(&course.map);
        let mut robot = Robot::new(self.amcl(&course.map, course));
        robot.amcl.set_pose(&initial_pose_at(course.sights[0].map_from_base)).unwrap();
        for sight in &course.sights {
            let truth = Some(sight.map_from_base);
            robot.see(sight, sight.odom_from_base, truth, cover.covers(sight), &mut tally);
        }
        robot.end(&mut tally);
        tally
    }

    /// Global localization.
    pub(crate) fn starts(&self, course: &Course) -> Tally {
        let mut tally = Tally::new(&course.name, "starts");
        let mut stream = Stream::keyed(self.seed, "starts", 0);
        let amcl = self.amcl(&course.map, course);
        for run in 0..self.runs {
            let mut robot = Robot::new(self.seeded(&amcl, run));
            let begin = course.anywhere(WAY_M, &mut stream);
            let end = course.after_m(begin, WAY_M).unwrap_or(course.sights.len() - 1);
            for sight in &course.sights[begin..=end] {
                robot.see(sight, sight.odom_from_base, Some(sight.map_from_base), true, &mut tally);
            }
            robot.end(&mut tally);
        }
        tally
    }

    /// Half of the map is unknown; the drive starts in the known half and leads through both.
    pub(crate) fn erased(&self, course: &Course) -> Tally {
        let mut tally = Tally::new(&course.name, "erased");
        for quarter in 0..4 {
            let map = erased(course, std::f64::consts::FRAC_PI_2 * (0.3 + f64::from(quarter)));
            let cover = Cover::new(&map);
            let covered: Vec<bool> = course.sights.iter().map(|it| cover.covers(it)).collect();
            let Some(begin) = covered.iter().position(|it| *it) else { continue };
            let mut robot = Robot::new(self.amcl(&map, course));
            robot.amcl.set_pose(&initial_pose_at(course.sights[begin].map_from_base)).unwrap();
            for (sight, is_covered) in course.sights.iter().zip(covered).skip(begin) {
                let truth = Some(sight.map_from_base);
                robot.see(sight, sight.odom_from_base, truth, is_covered, &mut tally);
            }
            robot.end(&mut tally);
        }
        tally
    }

    /// A wrong map.
    pub(crate) fn foreign(&self, course: &Course, other: &Course) -> Tally {
        let mut tally = Tally::new(&course.name, &format!("on {}", other.name));
        let mut robot = Robot::new(self.amcl(&other.map, course));
        for sight in course.sights.iter().take(MAX_FOREIGN_SCANS) {
            robot.see(sight, sight.odom_from_base, None, false, &mut tally);
        }
        robot.end(&mut tally);
        tally
    }

    /// Part of the drive is cut out, with or without odometry for it.
    pub(crate) fn kidnapped(&self, course: &Course, knows: bool) -> Tally {
        let name = if knows { "cut out" } else { "kidnapped" };
        let mut tally = Tally::new(&course.name, name);
        let mut stream = Stream::keyed(self.seed, "kidnapped", 0);
        let amcl = self.amcl(&course.map, course);
        for run in 0..self.runs {
            let first = course.anywhere(2.0 * WAY_M, &mut stream);
            let gone = course.after_m(first, WAY_M).unwrap_or(first);
            let share = CUT_MIN_RATIO + (CUT_MAX_RATIO - CUT_MIN_RATIO) * stream.unit();
            let count = course.sights.len();
            let mut back = gone + (share * count as f64) as usize;
            if course.after_m(back.min(count - 1), WAY_M).is_none() {
                // Continues from the beginning.
                back = course.anywhere(WAY_M, &mut stream);
            }
            let mut robot = Robot::new(self.seeded(&amcl, run));
            robot.amcl.set_pose(&initial_pose_at(course.sights[first].map_from_base)).unwrap();
            let mut before = Tally::default();
            for sight in &course.sights[first..=gone] {
                let truth = Some(sight.map_from_base);
                robot.see(sight, sight.odom_from_base, truth, true, &mut before);
            }
            (robot.way_m, robot.last, robot.is_found) = (0.0, None, false);
            (robot.wrong, robot.off_map, robot.scans) = (0, 0, 0);
            let end = course.after_m(back, WAY_M).unwrap_or(count - 1);
            let there = course.sights[gone].odom_from_base;
            let jump = if knows {
                Pose2::IDENTITY
            } else {
                there * course.sights[back].odom_from_base.inverse()
            };
            for sight in &course.sights[back..=end] {
                let odom_from_base = (jump * sight.odom_from_base).normalized();
                robot.see(sight, odom_from_base, Some(sight.map_from_base), true, &mut tally);
            }
            robot.end(&mut tally);
        }
        tally
    }

    /// Moved furniture: a tenth, a quarter, two fifths of all.
    pub(crate) fn moved_furniture(&self, course: &Course) -> Tally {
        let mut tally = Tally::new(&course.name, "moved");
        for (number, share) in [0.1, 0.25, 0.4].into_iter().enumerate() {
            let mut stream = Stream::keyed(self.seed, "moved", number as u64);
            let map = rearranged(course, share, &mut stream);
            let mut robot = Robot::new(self.amcl(&map, course));
            robot.amcl.set_pose(&initial_pose_at(course.sights[0].map_from_base)).unwrap();
            for sight in &course.sights {
                let truth = Some(sight.map_from_base);
                robot.see(sight, sight.odom_from_base, truth, true, &mut tally);
            }
            robot.end(&mut tally);
        }
        tally
    }
}

/// Difference of two poses \[m\], \[rad\].
fn apart(a: Pose2, b: Pose2) -> (f64, f64) {
    ((a.x_m - b.x_m).hypot(a.y_m - b.y_m), normalize_angle(a.yaw_rad - b.yaw_rad).abs())
}
