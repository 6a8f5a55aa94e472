//! Scans in, poses out.

mod live_audit;
mod look;
mod piece;
mod place;
mod state;
mod thin;
mod trial;
mod work;

use periplus_geometry::Pose2;
use periplus_grid::OccupancyGrid;
use periplus_scan_matching::{Cloud, PackedPlaces, Symmetric3};

use crate::audit::audit;
use crate::doubts::{Doubt, Doubts, Remark, Step};
use crate::graph::{Edge, Graph, Kind};
use crate::key::{Key, Track};
use crate::local::{apart, floored};
use crate::loops::{Closure, Loops};
use crate::map::Sketch;
use crate::odometry::Trust;
use crate::offsets::compare;
use crate::refine::refine;
use crate::scan::{Ends, Scan};
use crate::settings::Settings;
use crate::wheels::{Belief, Wheels};

pub use live_audit::MapContradiction;

use live_audit::LiveAudit;
use look::{Look, per_second};
use piece::Strange;
use trial::Undecided;
use work::Work;

/// What was done with a scan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Taken {
    /// It is part of the map.
    Kept,
    /// The robot has moved too little for it to be kept.
    Passed,
    /// It did not fit to what was seen before; only odometry tells where it is.
    Lost,
    /// It says nothing, for this reason.
    Ignored(&'static str),
}

/// Where the robot is after a scan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Update {
    /// What was done with the scan.
    pub taken: Taken,
    /// Where the robot is.
    pub map_from_base: Pose2,
    /// What corrects odometry; the identity without odometry.
    pub map_from_odom: Pose2,
    /// Whether poses of earlier scans have moved.
    pub is_map_bent: bool,
}

/// Counts of what happened.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Scans that came in.
    pub scans: usize,
    /// Scans that are part of the map.
    pub kept: usize,
    /// Scans that did not fit.
    pub lost: usize,
    /// Scans that said nothing.
    pub ignored: usize,
    /// Direct ties to old scans.
    pub ties: usize,
    /// Searches for loops.
    pub searches: usize,
    /// Slices of work in the background.
    pub slices: usize,
}

/// What holds two kept scans together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Link {
    /// One came after the other.
    Chain,
    /// They were compared directly: their places were known well enough.
    Tie,
    /// A loop that was closed.
    Closure,
}

/// What is known between two kept scans, and how far the map is off from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Held {
    /// From which kept scan to which.
    pub keys: (usize, usize),
    /// By what.
    pub link: Link,
    /// Distance between where it has the later scan and where the map has it \[m\].
    pub residual_m: f64,
    /// The same for the heading \[rad\].
    pub residual_rad: f64,
}

/// The scan before.
struct Last {
    time_ns: i64,
    odom_from_base: Option<Pose2>,
    key: usize,
    key_from_base: Pose2,
    /// Motion in a second, when it is known.
    motion: Option<Pose2>,
    /// Of its place, along the axes of the key.
    covariance: Symmetric3,
}

/// A map that grows with every scan.
pub struct Slam {
    settings: Settings,
    keys: Vec<Key>,
    tracks: Vec<Track>,
    graph: Graph,
    trust: Trust,
    last: Option<Last>,
    loops: Loops,
    work: Work,
    counts: Counts,
    doubts: Doubts,
    wheels: Wheels,
    strange: Strange,
    live_audit: LiveAudit,
    /// Whether no scan came since [`Slam::finish`].
    is_finished: bool,
    /// The first kept scan of the newest piece of map: what was seen before lies elsewhere.
    piece: usize,
    /// Part of the points that usually find partners.
    usual: f64,
    /// Where somebody says that the robot is, and how sure: for the next scan.
    start: Option<(Pose2, Symmetric3)>,
}

/// Clouds of fewer points cannot be laid onto others.
const LEAST_POINTS: usize = 12;
/// Without odometry the robot is thought to go on as it did, when it was not faster than this.
const STEADY_M_S: f64 = 2.0;
const STEADY_RAD_S: f64 = 2.5;
/// Ends of beams this part of a cell apart are drawn.
const DRAWN: f32 = 0.6;
/// How fast it is learnt what is usual.
const USUAL: f64 = 0.05;
/// When more scans than these, and a larger share, fit nothing, a map is not to be relied on.
const FEW_LOST: usize = 5;
const MOST_LOST: f64 = 0.1;
/// When nothing confirms more than so much way through places that were passed before \[m\], and so large a
/// part of it, a map may be off there.
const MOST_OPEN: [(f64, f64); 2] = [(25.0, 0.3), (5.0, 0.4)];
/// A turn of a radian counts as so much way \[m\].
const TURN_WAY_M: f64 = 0.3;

impl Slam {
    /// An empty map.
    #[must_use]
    pub fn new(settings: Settings) -> Self {
        Self {
            settings,
            keys: Vec::new(),
            tracks: Vec::new(),
            graph: Graph::default(),
            trust: Trust::default(),
            last: None,
            loops: Loops::default(),
            work: Work::default(),
            counts: Counts::default(),
            doubts: Doubts::default(),
            wheels: Wheels::default(),
            strange: Strange::default(),
            live_audit: LiveAudit::default(),
            is_finished: false,
            piece: 0,
            usual: 0.7,
            start: None,
        }
    }

    /// Takes a scan, and where odometry has the robot at its time, if it does. Work in the background
    /// (ties, loops, bending of the map) goes on for as many slices as the settings allow.
    pub fn add_scan(&mut self, scan: &Scan, odom_from_base: Option<Pose2>) -> Update {
        self.counts.scans += 1;
        if std::mem::take(&mut self.is_finished) && !self.settings.audits_live {
            self.live_audit = LiveAudit::default();
        }
        let odom_from_base = odom_from_base.filter(|pose| pose.is_finite());
        let bends = self.work.bends;
        let taken = match scan.fault() {
            Some(reason) => Taken::Ignored(reason),
            None => self.take(scan, odom_from_base),
        };
        match taken {
            Taken::Kept => self.counts.kept += 1,
            Taken::Lost => self.counts.lost += 1,
            Taken::Ignored(_) => self.counts.ignored += 1,
            Taken::Passed => {}
        }
        self.work_slices(self.settings.slices_per_scan);
        let map_from_base = self.map_from_base();
        Update {
            taken,
            map_from_base,
            map_from_odom: odom_from_base
                .map_or(Pose2::IDENTITY, |odom| (map_from_base * odom.inverse()).normalized()),
            is_map_bent: self.work.bends != bends,
        }
    }

    /// Where the robot was at the last scan.
    #[must_use]
    pub fn map_from_base(&self) -> Pose2 {
        self.last.as_ref().map_or(Pose2::IDENTITY, |last| {
            (self.graph.poses[last.key] * last.key_from_base).normalized()
        })
    }

    fn take(&mut self, scan: &Scan, odom_from_base: Option<Pose2>) -> Taken {
        if let Some((pose, covariance)) = self.start.take() {
            return self.take_at(scan, odom_from_base, pose, covariance);
        }
        let Some(last) = &self.last else {
            let start = odom_from_base.unwrap_or(Pose2::IDENTITY);
            return self.begin(scan, odom_from_base, start);
        };
        let seconds = (scan.time_ns.saturating_sub(last.time_ns)) as f64 * 1e-9;
        let told = match (last.odom_from_base, odom_from_base) {
            (Some(before), Some(now)) => Some((before.inverse() * now).normalized()),
            _ => None,
        };
        // Odometry that was set back, or is lost for a while, tells nothing of this step.
        let believed = told.filter(|step| self.trust.is_possible(*step, seconds));
        let jumped = told.filter(|_| believed.is_none());
        let belief = self.wheels.take(odom_from_base);
        let believed = believed.filter(|_| belief != Belief::None);
        let (key, before) = (last.key, last.key_from_base);
        let mut look = self.look(scan, last, believed, seconds);
        let moved_to = |look: &Look| (before.inverse() * look.key_from_base).normalized();
        if belief == Belief::Unproved
            && believed.is_some()
            && !look.is_blank
            && Wheels::is_suspect(moved_to(&look), look.is_matched)
        {
            look = self.look(scan, last, None, seconds);
        }
        if let Some(step) = jumped {
            let metres = libm::hypot(step.x_m, step.y_m);
            self.doubts.remark(scan.time_ns, Doubt::OdometryJumped(metres));
        }
        if self.is_carried(&look, seconds, jumped.is_some()) {
            return self.begin_piece(scan, odom_from_base, &look);
        }
        let moved = moved_to(&look);
        let Look {
            ends,
            cloud,
            told,
            motion,
            covariance,
            key_from_base,
            information,
            doubted,
            is_blank,
            is_still,
            is_matched,
            is_doubted,
            firmness,
            matched,
            ..
        } = look;
        let per_second = |motion| per_second(motion, seconds);
        if is_matched {
            self.usual += USUAL * (matched - self.usual);
            let doubt = self.wheels.found(moved);
            doubt.into_iter().for_each(|it| self.doubts.remark(scan.time_ns, it));
        }
        if told.is_some() && is_matched && !is_still {
            self.trust.learn(motion, moved, is_doubted);
        }
        let (shift_m, turn_rad) = apart(key_from_base, Pose2::IDENTITY);
        // Where neither scans nor odometry tell where it is, a scan would only spoil the map.
        let is_kept = !is_blank
            && (is_matched || told.is_some())
            && (shift_m > self.settings.key_shift_m || turn_rad > self.settings.key_turn_rad);
        let way_m = {
            let (metres, radians) = apart(key_from_base, Pose2::IDENTITY);
            metres + TURN_WAY_M * radians
        };
        let mut next = Last {
            time_ns: scan.time_ns,
            odom_from_base,
            key,
            key_from_base,
            covariance: information.inverse().unwrap_or(covariance),
            motion: per_second(moved).filter(|it| {
                is_matched
                    && libm::hypot(it.x_m, it.y_m) < STEADY_M_S
                    && it.yaw_rad.abs() < STEADY_RAD_S
            }),
        };
        if is_kept {
            let travel_m = self.keys[key].travel_m + way_m;
            let heading_rad = self.graph.poses[key].yaw_rad;
            self.doubts.take(&Step {
                time_ns: scan.time_ns,
                // What is not believed is no witness against scans.
                odom_from_base: odom_from_base.filter(|_| told.is_some()),
                key_from_base,
                heading_rad,
                is_matched,
                firmness,
            });
            let pose = (self.graph.poses[key] * key_from_base).normalized();
            let new = self.graph.add_pose(pose);
            let ends = drawn(&ends, &self.settings);
            self.keys.push(Key::new(&cloud, ends, travel_m));
            let information = floored(&information);
            let edge = Edge::new((key, new), key_from_base, information, Kind::Chain);
            self.graph.add_edge(edge.doubting(&floored(&doubted)));
            next.key = new;
            next.key_from_base = Pose2::IDENTITY;
            self.work.ties.push_back(new);
            if self.settings.closes_loops {
                let is_torn = self.piece > 0 && !self.unjoined().is_empty();
                self.loops.notice(&self.keys, &self.graph, self.work.tied_m, is_torn);
            }
        }
        self.push_track(Track {
            time_ns: scan.time_ns,
            key: next.key,
            key_from_base: next.key_from_base,
        });
        self.last = Some(next);
        match (is_matched, is_kept) {
            (false, _) => Taken::Lost,
            (true, true) => Taken::Kept,
            (true, false) => Taken::Passed,
        }
    }

    /// Keeps the pose of a scan, in the place of the one before where only the newest is asked for.
    fn push_track(&mut self, track: Track) {
        if let [.., before, last] = self.tracks.as_mut_slice()
            && !self.settings.keeps_each_pose
            && before.key == last.key
            && last.key == track.key
        {
            *last = track;
            return;
        }
        self.tracks.push(track);
    }

    /// The first scan: the map begins where odometry has the robot, or where it is said to be.
    fn begin(&mut self, scan: &Scan, odom_from_base: Option<Pose2>, start: Pose2) -> Taken {
        let ends = scan.ends(None, self.settings.used_m());
        let cloud = ends.cloud(&self.settings.cloud);
        self.graph.add_pose(start.normalized());
        self.doubts.begin(odom_from_base);
        self.keys.push(Key::new(&cloud, drawn(&ends, &self.settings), 0.0));
        let track = Track { time_ns: scan.time_ns, key: 0, key_from_base: Pose2::IDENTITY };
        self.tracks.push(track);
        self.last = Some(Last {
            time_ns: scan.time_ns,
            odom_from_base,
            key: 0,
            key_from_base: Pose2::IDENTITY,
            motion: None,
            covariance: Symmetric3::ZERO,
        });
        Taken::Kept
    }

    /// Finishes all work in the background, then refines all poses together. More scans may follow.
    pub fn finish(&mut self) {
        self.work_slices(usize::MAX);
        let end_ns = self.tracks.last().map_or(0, |it| it.time_ns);
        self.doubts.leave_corridor(end_ns);
        self.settle();
        let mut undecided = Vec::new();
        if self.settings.closes_loops && self.keys.len() > 1 {
            undecided = self.try_waiting();
            self.doubt_closures();
            self.join_offsets();
        }
        if self.keys.len() > 1 {
            refine(&self.keys, &mut self.graph, &self.settings);
        }
        self.conclude(end_ns, &undecided);
    }

    /// Tells what a person should know of the map as a whole.
    fn conclude(&mut self, end_ns: i64, undecided: &[Undecided]) {
        if self.counts.scans > 1 && self.last.as_ref().is_some_and(|it| it.odom_from_base.is_none())
        {
            self.doubts.remark(end_ns, Doubt::NoOdometry);
        }
        let share = self.counts.lost as f64 / self.counts.scans.max(1) as f64;
        if self.counts.lost > FEW_LOST && share > MOST_LOST {
            self.doubts.remark(end_ns, Doubt::Unfitting(share));
        }
        match self.unjoined().len() {
            0 => {}
            pieces => self.doubts.remark(end_ns, Doubt::Unjoined(pieces)),
        }
        self.live_audit = LiveAudit::concluded(audit(&self.keys, &self.graph));
        self.is_finished = true;
        for Remark { time_ns, doubt } in self.contradictions().iter().map(MapContradiction::remark)
        {
            self.doubts.remark(time_ns, doubt);
        }
        for it in undecided {
            let (time_ns, here) =
                (self.time_of(it.key).unwrap_or(end_ns), self.graph.poses[it.key]);
            self.doubts.remark(time_ns, Doubt::Undecided(here.x_m, here.y_m, it.apart_m));
        }
        if self.settings.closes_loops {
            let passes = compare(&self.keys, &self.graph, &self.settings);
            let open_m = passes.whole_m - passes.confirmed_m;
            let is_open = |way_m: f64, part: f64| open_m > way_m && open_m > part * passes.whole_m;
            if MOST_OPEN.iter().any(|&(way_m, part)| is_open(way_m, part)) {
                self.doubts.remark(end_ns, Doubt::Unconfirmed(open_m, passes.whole_m));
            }
            for it in passes.offsets {
                let time_ns = self.time_of(it.edge.to).unwrap_or(end_ns);
                let doubt = Doubt::Offset(it.map_from_base.x_m, it.map_from_base.y_m, it.shift_m);
                self.doubts.remark(time_ns, doubt);
            }
        }
    }

    /// When a kept scan came \[ns\].
    fn time_of(&self, key: usize) -> Option<i64> {
        let first = self.tracks.partition_point(|track| track.key < key);
        self.tracks.get(first).map(|track| track.time_ns)
    }

    /// Where the robot was at each scan, in the order in which they came \[ns\].
    #[must_use]
    pub fn trajectory(&self) -> Vec<(i64, Pose2)> {
        self.tracks.iter().map(|track| (track.time_ns, self.on_the_way(track))).collect()
    }

    /// Where the robot was at a scan that may not be one of those kept.
    ///
    /// Such a scan was laid onto those before it. What the map says since of the way from the kept scan
    /// before it to the one after is shared out along that way, so that the scan next to the one after
    /// moves with it.
    pub(crate) fn on_the_way(&self, track: &Track) -> Pose2 {
        let pose =
            |key_from_base: Pose2| (self.graph.poses[track.key] * key_from_base).normalized();
        let next = track.key + 1;
        let edges = self.graph.at.get(next).into_iter().flatten();
        let step = edges
            .map(|&edge| &self.graph.edges[edge as usize])
            .find(|edge| edge.kind == Kind::Chain && edge.from == track.key && edge.to == next);
        let Some(step) = step else { return pose(track.key_from_base) };
        let way = |pose: Pose2| {
            let (metres, radians) = apart(pose, Pose2::IDENTITY);
            metres + TURN_WAY_M * radians
        };
        let (done, whole) = (way(track.key_from_base), way(step.from_from_to));
        let part = if whole > 0.0 { (done / whole).min(1.0) } else { 0.0 };
        let [x_m, y_m, yaw_rad] = step.error(&self.graph.poses);
        let here = track.key_from_base;
        // The error is a shift along the axes of the kept scan before, and a turn about the one after.
        let turn = part * yaw_rad;
        pose(Pose2::new(here.x_m + part * x_m, here.y_m + part * y_m, here.yaw_rad + turn))
    }

    /// The last scan relative to a kept one: where it was is asked by [`Slam::on_the_way`] at any time later.
    pub(crate) fn newest(&self) -> Option<Track> {
        let last = self.last.as_ref()?;
        Some(Track { time_ns: last.time_ns, key: last.key, key_from_base: last.key_from_base })
    }

    /// How uncertain the way from a scan to the newest one is, along the axes of the former: what scans and
    /// odometry leave open together from one kept scan to the next. None where they are not in a row.
    pub(crate) fn scatter_since(&self, from: &Track) -> Option<Symmetric3> {
        const LONGEST: usize = 64;
        let last = self.last.as_ref()?;
        if last.key < from.key || last.key - from.key > LONGEST {
            return None;
        }
        let mut way = Pose2::IDENTITY;
        let mut sum = Symmetric3::ZERO;
        for next in from.key + 1..=last.key {
            let edges = self.graph.at[next].iter().map(|&edge| &self.graph.edges[edge as usize]);
            let step = edges.into_iter().find(|edge| {
                edge.kind == Kind::Chain && edge.from + 1 == next && edge.to == next
            })?;
            let covariance = step.information.inverse()?;
            sum = sum.compounded(way, step.from_from_to, &covariance);
            way = way * step.from_from_to;
        }
        if last.key_from_base != Pose2::IDENTITY {
            sum = sum.compounded(way, last.key_from_base, &last.covariance.turned(0.0));
        }
        Some(sum.turned(-from.key_from_base.yaw_rad))
    }

    /// Which of the scans of [`Slam::trajectory`] are kept; closures name them by their place here.
    #[must_use]
    pub fn kept(&self) -> Vec<usize> {
        let mut kept = Vec::with_capacity(self.keys.len());
        for (index, track) in self.tracks.iter().enumerate() {
            if track.key == kept.len() {
                kept.push(index);
            }
        }
        kept
    }

    /// The map as it is now; none when it would be too large to hold.
    #[must_use]
    pub fn map(&self) -> Option<OccupancyGrid> {
        self.sketch().draw()
    }

    /// What the map is drawn of as it is now, to be drawn by somebody else.
    #[must_use]
    pub fn sketch(&self) -> Sketch {
        Sketch::new(&self.keys, &self.graph.poses, self.settings.resolution_m)
    }

    /// How uncertain the last scan left the place of the robot among the scans around it, along the
    /// axes of the map \[m, rad\].
    #[must_use]
    pub fn covariance(&self) -> Symmetric3 {
        self.last.as_ref().map_or(Symmetric3::ZERO, |last| {
            last.covariance.turned(self.graph.poses[last.key].yaw_rad)
        })
    }

    /// Places of the kept scans in the map.
    #[must_use]
    pub fn poses(&self) -> &[Pose2] {
        &self.graph.poses
    }

    /// What is known between kept scans, where it counts: from which to which, and by what.
    pub fn links(&self) -> impl Iterator<Item = (usize, usize, Link)> {
        let counts = |edge: &&Edge| edge.weight > 0.0;
        self.graph.edges.iter().filter(counts).map(|edge| {
            let link = match edge.kind {
                Kind::Chain => Link::Chain,
                Kind::Near => Link::Tie,
                Kind::Loop => Link::Closure,
            };
            (edge.from, edge.to, link)
        })
    }

    /// Everything that is known between kept scans and counts, with how far the map is off from it.
    pub fn edges(&self) -> impl Iterator<Item = Held> {
        self.links().zip(self.graph.edges.iter().filter(|edge| edge.weight > 0.0)).map(
            |((from, to, link), edge)| {
                let [x_m, y_m, yaw_rad] = edge.error(&self.graph.poses);
                let (residual_m, residual_rad) = (libm::hypot(x_m, y_m), yaw_rad.abs());
                Held { keys: (from, to), link, residual_m, residual_rad }
            },
        )
    }

    /// Grows with every bend of the map: who keeps places of scans looks whether it has changed.
    #[must_use]
    pub fn bends(&self) -> usize {
        self.work.bends
    }

    /// What became of every closure that was looked at in earnest.
    #[must_use]
    pub fn closures(&self) -> &[Closure] {
        &self.loops.told
    }

    pub(crate) fn settings(&self) -> &Settings {
        &self.settings
    }

    pub(crate) fn cloud(&self, key: usize) -> Cloud {
        self.keys[key].cloud()
    }

    pub(crate) fn graph(&self) -> &Graph {
        &self.graph
    }

    /// What a person should know of the drive, in the order in which it was noticed; grows only.
    #[must_use]
    pub fn remarks(&self) -> &[Remark] {
        &self.doubts.remarks
    }

    /// Counts of what happened.
    #[must_use]
    pub fn counts(&self) -> Counts {
        Counts {
            slices: self.work.slices,
            ties: self.work.tied,
            searches: self.work.searches,
            ..self.counts
        }
    }

    /// Forgets what was seen before the last few kept scans, and where, and closes no more loops: for those
    /// who only ask how the robot moves.
    pub(crate) fn forget(&mut self, kept: usize) {
        let old = self.keys.len().saturating_sub(kept);
        let nothing = Cloud::new([], [0.0; 2], 0.0, &self.settings.cloud);
        let is_known = |key: &&mut Key| !key.cloud.places().is_empty();
        for key in self.keys[..old].iter_mut().rev().take_while(is_known) {
            *key = Key::new(&nothing, None, key.travel_m);
        }
        self.work.ties.clear();
        self.tracks.clear();
        self.settings.closes_loops = false;
    }

    /// Bytes held, about.
    #[must_use]
    pub fn size(&self) -> usize {
        let keys: usize = self.keys.iter().map(Key::size).sum();
        keys + self.graph.edges.len() * (size_of::<Edge>() + 8)
            + self.tracks.len() * size_of::<Track>()
            + self.loops.size()
    }
}

/// Ends of beams that are kept for drawing: one for a good part of a cell. None where the cloud, whose
/// points are as near to each other, has all of them.
fn drawn(ends: &Ends, settings: &Settings) -> Option<PackedPlaces> {
    let spacing_m = DRAWN * settings.resolution_m as f32;
    let count = ends.ends.iter().flatten().count();
    if count <= settings.cloud.most_points && settings.cloud.spacing_m <= spacing_m {
        return None;
    }
    let every = count.div_ceil(settings.drawn_beams.max(1)).max(1);
    let mut drawn: Vec<[f32; 2]> = Vec::new();
    for end in ends.ends.iter().flatten().step_by(every) {
        let is_near = |last: &[f32; 2]| (end[0] - last[0]).hypot(end[1] - last[1]) < spacing_m;
        if !drawn.last().is_some_and(is_near) {
            drawn.push(*end);
        }
    }
    Some(PackedPlaces::new(&drawn, ends.origin))
}
