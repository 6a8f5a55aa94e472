//! What goes beyond Nav2: several places followed, poses refined, the lost looked for.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{Pose2, normalize_angle};
use periplus_scan_matching::{Peak, Symmetric3};

use super::astray::{ENOUGH, Followed, TRUSTED_M, Way};
use super::trust::{ByOdometry, RIVALLING};
use super::{Amcl, Estimate, has_moved};
use crate::anywhere::Everywhere;
use crate::bins::Cluster;
use crate::evidence::{agreement, evidence};
use crate::guess::scatter;
use crate::hunt::Completeness;
use crate::known_map::KnownMap;
use crate::models::Model;
use crate::particles::{Covariance2, Particles};
use crate::polish::{Known, loosely, loosened, moved, polish};
use crate::rivals::Rivals;
use crate::scan::{BeamLimits, Beams, Scan};
use crate::settings::Settings;
use crate::status::State;

/// So many beams refine poses, about: more tell nothing more.
const BEAMS: usize = 180;
/// Particles around a place are spread at least by this: \[m\], \[rad\].
const LEAST_SPREAD: (f64, f64) = (0.05, 0.02);
/// A refined pose is not farther from the particles than this, and twice their spread \[m\], \[rad\].
const NEAR: (f64, f64) = (0.4, 0.25);
/// One particle of so many is put where the refined pose is.
const EVERY: usize = 20;
/// Without so much motion no pose is refined again \[m\], \[rad\].
const STILL: (f64, f64) = (0.02, 0.01);
/// Farther from where odometry has the robot a scan contradicts it: \[m\], \[rad\], and this share of
/// the motion.
const JUMP: (f64, f64) = (0.1, 0.2);
const SLIP: f64 = 0.25;
/// Steps of odometry that differ more from the one before may be wrong \[m\], \[rad\].
const UNEVEN: (f64, f64) = (0.05, 0.05);
/// They are where the one before fits better by this, and as well as scans usually do.
const EVEN: f64 = 0.005;
/// Without so much motion the lost are not looked for again \[m\], \[rad\].
const AGAIN: (f64, f64) = (0.5, 0.5);
/// Of all of the map so much is searched with a scan, in lookups of points: some milliseconds; more
/// with the very first one, when nothing is known yet.
const SLICE: u64 = 3_000_000;
const FIRST_SLICE: u64 = 11_000_000;
/// A scan of which such a part of the beams is longer or shorter than this is another one \[m\].
const CHANGED: (f64, f64) = (0.3, 0.3);
/// After so much way with several places it is looked for others, too \[m\].
const STUCK_M: f64 = 4.0;
/// Who was looked for in vain is looked for less often: after so many times the way at most.
const SELDOM: u32 = 3;
/// With a larger share of particles that should be anywhere, the robot is looked for.
const CARRIED: f64 = 0.1;
/// How much more likely (as a logarithm) it is that a robot was not carried away.
const STAYS: f64 = 5.0;
/// What follows from a better start has to fit better by this.
const BETTER: f64 = 0.03;
/// With a smaller part of what is usual on walls the robot has left the map, or the map is of old:
/// odometry alone goes on.
pub(super) const STRAY: f64 = 0.5;
/// Another place is believed when such a part of what is usual is on walls there, and at least so much
/// of the scan.
pub(super) const CONVINCING: (f64, f64) = (0.8, 0.6);
/// Clusters so much less likely than the best (as a logarithm) are left over from before.
pub(super) const REFUTED: f64 = 4.6;

/// Lighter clusters are no rivals.
const LEAST_WEIGHT: f64 = 0.05;
/// Clusters that end up nearer to the best are the same place \[m\], \[rad\].
const SAME: (f64, f64) = (0.3, 0.2);

/// A scan with more beams than the filter takes.
pub(super) struct Seen {
    pub(super) beams: Beams,
    pub(super) ends: Vec<[f32; 2]>,
}

impl Seen {
    pub(super) fn new(scan: &Scan, settings: &Settings) -> Result<Self, Box<Diagnostic>> {
        let limits = BeamLimits { most: BEAMS.max(settings.beams.most), ..settings.beams };
        let beams = Beams::new(scan, &limits, Model::LikelihoodField.thinning())?;
        Ok(Self { ends: beams.ends(), beams })
    }
}

impl Amcl {
    /// Where on all of the map the scan fits.
    pub(super) fn look_everywhere(&mut self, seen: &Seen) -> Vec<Peak> {
        let Some(map) = &self.map else { return Vec::new() };
        self.everywhere.get_or_insert_with(|| Everywhere::new(map)).peaks(&seen.ends)
    }

    /// Begins to look for a scan on all of the map, for what fits more than `least`.
    pub(super) fn begin_search(&mut self, seen: &Seen, odom_from_base: Pose2, least: f64) {
        let Some(map) = &self.map else { return };
        let everywhere = self.everywhere.get_or_insert_with(|| Everywhere::new(map));
        let hunt = everywhere.hunt(&seen.ends, least);
        self.search = Some((hunt, odom_from_base));
        let ranges_m = seen.beams.beams.iter().map(|beam| beam.range_m as f32).collect();
        self.sought = Some((odom_from_base, super::no_pose()));
        self.sought_m = ranges_m;
        self.go_on();
    }

    /// Goes on with a search that was begun. Its scan may be of some time ago.
    pub(super) fn go_on(&mut self) {
        let Some((mut hunt, place)) = self.search.take() else { return };
        let Some(everywhere) = &self.everywhere else { return };
        let most = if self.searches == 0 { FIRST_SLICE } else { SLICE };
        self.searches += 1;
        let before = hunt.work();
        everywhere.go_on(&mut hunt, most);
        self.searched += hunt.work() - before;
        if hunt.is_done() {
            let (peaks, completeness) = hunt.into_peaks();
            self.found = Some((peaks, completeness, place));
        } else {
            self.search = Some((hunt, place));
        }
    }

    /// What a search has found, where odometry has led to since.
    pub(super) fn take_found(
        &mut self,
        odom_from_base: Pose2,
    ) -> Option<(Vec<Peak>, Completeness)> {
        let (mut peaks, completeness, place) = self.found.take()?;
        let step = place.inverse() * odom_from_base;
        for peak in &mut peaks {
            peak.pose = (peak.pose * step).normalized();
        }
        Some((peaks, completeness))
    }

    /// Whether a scan is unlike the one with which it was looked for last.
    pub(super) fn is_other(&self, seen: &Seen) -> bool {
        let beams = &seen.beams.beams;
        let (share, far_m) = CHANGED;
        let differ = beams
            .iter()
            .zip(&self.sought_m)
            .filter(|(beam, old)| (beam.range_m - f64::from(**old)).abs() > far_m)
            .count();
        beams.len() != self.sought_m.len() || differ as f64 > share * beams.len() as f64
    }

    /// Particles for places, more where the robot is more likely.
    pub(super) fn drawn_from(&mut self, rivals: &Rivals) -> Particles {
        let mut stream = self.stream("rivals");
        let mut particles = Particles::default();
        let most = self.settings.size.most;
        for cluster in rivals.clusters(most) {
            let spread = widened(cluster.covariance);
            scatter(&mut particles, cluster.count.max(1), cluster.mean, spread, &mut stream);
        }
        particles.level();
        particles
    }

    /// Follows the places of which one is the right one.
    pub(super) fn follow(
        &mut self,
        estimate: &mut Estimate,
        seen: &Seen,
        old_from_new: Option<Pose2>,
        odom_from_base: Pose2,
    ) {
        let (Some(mut rivals), Some(map)) = (self.rivals.take(), &self.map) else { return };
        if let Some(old_from_new) = old_from_new {
            rivals.follow(map, &seen.beams, &seen.ends, old_from_new);
        }
        let fit = agreement(map, &seen.beams, rivals.best().known.pose).map_or(1.0, |it| it.all);
        if let Some((known, old)) = self.home {
            let step = old.inverse() * odom_from_base;
            let Followed { known, fit: at_home } =
                self.followed(seen, moved(&known, step), length_m(step), Way::Gone);
            let is_home = at_home.is_some_and(|it| it >= self.convincing().max(fit - BETTER));
            let is_home = is_home && !self.trust.is_carried();
            if is_home || fit < STRAY * self.watch.usual() {
                // None of them was it.
                self.stay(estimate, known, odom_from_base);
                return;
            }
            self.home = Some((known, odom_from_base));
        }
        self.believe(estimate, rivals, fit, seen);
    }

    /// Makes places what is estimated; `fit` is that of the best.
    pub(super) fn believe(
        &mut self,
        estimate: &mut Estimate,
        rivals: Rivals,
        fit: f64,
        seen: &Seen,
    ) {
        self.particles = self.drawn_from(&rivals);
        let best = rivals.best().known;
        *estimate = self.sum_up();
        estimate.pose = best.pose;
        estimate.clusters = rivals.clusters(self.particles.len());
        self.fine = None;
        self.ahead = None;
        self.stride = None;
        // With nothing known before there is nothing to lose.
        let is_decided = rivals.is_decided() || self.home.is_none() && rivals.is_only();
        if is_decided
            && let Some((known, odom_from_base)) = self.home
            && self.by_odometry(best.pose) == ByOdometry::Elsewhere
        {
            self.trust.open(0);
            self.stay(estimate, known, odom_from_base);
            return;
        }
        if is_decided && fit >= self.convincing() {
            let is_home = self.home.is_some_and(|(known, _)| is_same(known.pose, best.pose));
            if !is_home || self.trust.is_open() {
                self.found_at(best.pose, seen, &rivals);
            }
            self.home = None;
            // A place that is new has to fit as a whole before it is followed beyond the map.
            self.astray_m = TRUSTED_M;
            return;
        }
        if rivals.are_hopeless() {
            // It is at none of them.
            self.trust.open(0);
            if let Some((known, odom_from_base)) = self.home {
                self.stay(estimate, known, odom_from_base);
            }
            return;
        }
        // Nobody is told to be elsewhere before it is certain.
        if let Some((known, _)) = self.home {
            estimate.pose = known.pose;
        }
        self.rivals = Some(rivals);
    }

    /// Which part of a scan has to be on walls at another place.
    fn convincing(&self) -> f64 {
        (CONVINCING.0 * self.watch.usual()).max(CONVINCING.1)
    }

    /// All particles around one place.
    fn stay(&mut self, estimate: &mut Estimate, known: Known, odom_from_base: Pose2) {
        let mut stream = self.stream("stray");
        let mut particles = Particles::default();
        let spread = widened(spread_of(&known));
        scatter(&mut particles, self.settings.size.least, known.pose, spread, &mut stream);
        particles.level();
        self.particles = particles;
        *estimate = self.sum_up();
        estimate.pose = known.pose;
        self.fine = Some((known, odom_from_base));
        self.home = None;
    }

    /// Refines the estimate, and puts some of the particles there.
    pub(super) fn polish(&mut self, estimate: &mut Estimate, seen: &Seen, odom_from_base: Pose2) {
        let is_wanted = self.settings.polishes && self.rivals.is_none();
        let (Some(_), true, Some(cluster)) =
            (&self.map, is_wanted && !seen.ends.is_empty(), estimate.clusters.first())
        else {
            self.fine = None;
            self.ahead = None;
            self.stride = None;
            return;
        };
        let mean = estimate.pose;
        let spread = widened(cluster.covariance);
        let covariance = Symmetric3 {
            xx: spread.xx,
            xy: spread.xy,
            yy: spread.yy,
            tt: spread.yaw,
            ..Symmetric3::ZERO
        };
        let information = covariance.inverse().unwrap_or_else(|| loosely(0.5, 0.2));
        let (near_m, near_rad) =
            (NEAR.0 + 2.0 * spread.radius_m(), NEAR.1 + 2.0 * libm::sqrt(spread.yaw));
        let is_near = |pose: Pose2| {
            libm::hypot(pose.x_m - mean.x_m, pose.y_m - mean.y_m) < near_m
                && normalize_angle(pose.yaw_rad - mean.yaw_rad).abs() < near_rad
        };
        let fine = self.fine.take().map(|(known, old)| (known, old.inverse() * odom_from_base));
        let carried = fine.map(|(known, step)| self.carried(seen, &known, step));
        let (carried, way) = (carried.map(|it| it.0), carried.map_or(Way::Gone, |it| it.1));
        let Some(map) = &self.map else { return };
        let followed = carried.map(|known| polish(map, &seen.ends, &known));
        let fresh = polish(map, &seen.ends, &Known { pose: mean, information });
        let best = followed
            .filter(|it| is_near(it.known.pose) && it.fit >= fresh.fit - BETTER)
            .unwrap_or(fresh);
        let pose = best.known.pose;
        let fit = self.fit(pose, &seen.beams);
        if let (Some(known), Some((Known { pose: before, .. }, step))) = (&carried, fine) {
            self.astray_m += length_m(step);
            let found = self.nearby(seen, known, fit, way);
            let at = found.map_or(pose, |found| found.known.pose);
            self.jump = jump((before * step).normalized(), at, step);
            self.stride = Some(before.inverse() * at);
            if let Some(found) = found {
                self.stay(estimate, found.known, odom_from_base);
                return;
            }
        }
        let fit = fit.unwrap_or(1.0);
        let Some(map) = &self.map else { return };
        if let Some(known) = carried
            && fit < STRAY * self.watch.usual()
        {
            self.stay(estimate, known, odom_from_base);
            return;
        }
        if !is_near(pose) {
            self.stride = None;
            return;
        }
        let spread = spread_of(&best.known);
        estimate.pose = pose;
        estimate.clusters = still_possible(map, seen, &estimate.clusters, pose, spread);
        self.fine = Some((best.known, odom_from_base));
        let mut stream = self.stream("polish");
        let mut drawn = Particles::default();
        let count = self.particles.len() / EVERY;
        scatter(&mut drawn, count, pose, spread, &mut stream);
        for index in 0..count {
            self.particles.x_m[index] = drawn.x_m[index];
            self.particles.y_m[index] = drawn.y_m[index];
            self.particles.yaw_rad[index] = drawn.yaw_rad[index];
        }
    }

    /// Refines the pose by a scan that the filter does not use.
    pub(super) fn refine(&mut self, odom_from_base: Pose2, scan: &Scan) {
        let Some((known, old)) = self.fine else { return };
        let Ok(seen) = Seen::new(scan, &self.settings) else { return };
        if seen.ends.is_empty() {
            return;
        }
        let step = old.inverse() * odom_from_base;
        let has_gone = has_moved(old, odom_from_base, STILL);
        let fit = if has_gone {
            let (carried, way) = self.carried(&seen, &known, step);
            let before = known.pose;
            let Followed { known, fit } = self.followed(&seen, carried, length_m(step), way);
            self.fine = Some((known, odom_from_base));
            self.told_at(known.pose, odom_from_base);
            self.stride = Some(before.inverse() * known.pose);
            self.jump = jump((before * step).normalized(), known.pose, step);
            fit
        } else {
            let here = self.ahead.unwrap_or(known);
            let fit = self.fit(here.pose, &seen.beams);
            let found = self.nearby(&seen, &here, fit, Way::Turned);
            if let Some(Followed { known, .. }) = found {
                self.ahead = Some(known);
                self.told_at(known.pose, odom_from_base);
                self.jump = jump(here.pose, known.pose, Pose2::IDENTITY);
            }
            found.map_or(fit, |found| found.fit)
        };
        if let Some(map_from_odom) = self.map_from_odom {
            self.see_at(&seen, (map_from_odom * odom_from_base).normalized(), odom_from_base);
        }
        self.doubt();
        // What may be the sign of a robot that was carried away is worth the work at once; not so
        // where it has been lost for some time, nor for whoever stands before one that waits.
        self.is_forced |=
            has_gone && self.base_state() == State::Tracking && self.watch.suspects(fit);
    }

    fn told_at(&mut self, map_from_base: Pose2, odom_from_base: Pose2) {
        self.map_from_odom = Some((map_from_base * odom_from_base.inverse()).normalized());
    }

    /// Where the refined pose is after a motion. Odometry that stood still while the robot went on may
    /// come back with all of the way at once, or without what it missed: what the scan fits best counts.
    fn carried(&mut self, seen: &Seen, known: &Known, step: Pose2) -> (Known, Way) {
        let usual = moved(known, step);
        let (ahead, stride) = (self.ahead.take(), self.stride.take());
        let Some(map) = &self.map else { return (usual, Way::Gone) };
        let Some(ahead) = ahead else {
            // A robot goes on as it went, for the moment; its odometry may say otherwise.
            let Some(stride) = stride.filter(|it| has_moved(*it, step, UNEVEN)) else {
                return (usual, Way::Gone);
            };
            let even = moved(known, stride);
            let there = polish(map, &seen.ends, &even);
            let is_better = there.fit > polish(map, &seen.ends, &usual).fit + EVEN;
            let fit = self.fit(there.known.pose, &seen.beams);
            let is_even = is_better && fit.is_some_and(|fit| fit >= ENOUGH * self.watch.usual());
            return (if is_even { even } else { usual }, Way::Gone);
        };
        let mut best = (usual, f64::NEG_INFINITY);
        for place in [usual, moved(&ahead, step), loosened(&ahead)] {
            let fit = polish(map, &seen.ends, &place).fit;
            if fit > best.1 {
                best = (place, fit);
            }
        }
        (best.0, Way::Turned)
    }

    /// A robot of which odometry and the scan say something different is not sure, for the moment; nor
    /// is one whose place is not proven.
    pub(super) fn doubt(&mut self) {
        if let Some(before) = self.undoubted.take() {
            self.status = before;
        }
        let jump = self.jump.take().map(|(off_m, off_rad)| {
            format!(
                "the scan has the robot {off_m:.2} m and {:.0} degrees from where odometry has it",
                off_rad.to_degrees(),
            )
        });
        let Some(reason) = jump.or_else(|| self.distrust()) else { return };
        if self.status.state == State::Tracking {
            self.undoubted = Some(self.status.clone());
            self.status.state = State::Ambiguous;
            self.status.reason = reason;
        }
    }

    /// Whether the robot has moved since it was looked for, the further the more often that was in vain,
    /// or sees something else.
    pub(super) fn is_elsewhere(&self, seen: &Seen, odom_from_base: Pose2) -> bool {
        let times = f64::from(1 + self.vain.min(SELDOM - 1));
        let again = (times * AGAIN.0, times * AGAIN.1);
        self.sought.as_ref().is_none_or(|(place, _)| {
            has_moved(*place, odom_from_base, again) || self.is_other(seen)
        })
    }

    /// Whether the robot is to be looked for on all of the map.
    fn seeks(&self, seen: &Seen, random_share: f64, odom_from_base: Pose2) -> bool {
        if !self.settings.seeks_when_lost || self.search.is_some() {
            return false;
        }
        let is_stuck = self.rivals.as_ref().is_none_or(|rivals| rivals.way_m() > STUCK_M);
        if self.rivals.is_some() && !is_stuck {
            return false;
        }
        let is_lost = self.status.state == State::Lost
            || random_share > CARRIED
            || self.watch.suspects(self.status.fit)
            || self.rivals.is_some();
        is_lost && self.is_elsewhere(seen, odom_from_base) || self.is_proof_due(odom_from_base)
    }

    /// Looks for a robot that is lost, or whose place is not proven; whether it may be elsewhere.
    pub(super) fn look_out(
        &mut self,
        estimate: &mut Estimate,
        seen: &Seen,
        random_share: f64,
        odom_from_base: Pose2,
    ) -> bool {
        if self.status.state == State::Lost && !self.trust.is_open() {
            self.trust.open(0);
        }
        if self.found.is_none() && self.seeks(seen, random_share, odom_from_base) {
            // Where the place fits, only what fits nearly as well could be it.
            let fits = self.status.fit.is_some_and(|fit| fit >= self.convincing());
            let is_only_proof = self.is_proof_due(odom_from_base) && fits && self.rivals.is_none();
            let own =
                self.everywhere.as_ref().map_or(0.0, |it| it.score(&seen.ends, estimate.pose));
            let least = if is_only_proof { RIVALLING * own } else { 0.0 };
            self.begin_search(seen, odom_from_base, least);
        }
        let Some((peaks, completeness)) = self.take_found(odom_from_base) else { return false };
        let poses: Vec<Pose2> = peaks.iter().map(|peak| peak.pose).collect();
        if self.is_unproven()
            && self.rivals.is_none()
            && self.prove(seen, estimate.pose, &poses, completeness)
        {
            self.vain = 0;
            return false;
        }
        self.vain += 1;
        self.weigh_found(estimate, seen, odom_from_base, &poses, completeness)
    }

    /// Whether one of the places that were found may be the right one, rather than where the robot seems
    /// to be.
    fn weigh_found(
        &mut self,
        estimate: &mut Estimate,
        seen: &Seen,
        odom_from_base: Pose2,
        poses: &[Pose2],
        completeness: Completeness,
    ) -> bool {
        let Some(map) = &self.map else { return false };
        let all = poses.iter().copied();
        let Some(mut rivals) = Rivals::new(map, &seen.beams, &seen.ends, all, completeness) else {
            return false;
        };
        let least = STRAY * self.watch.usual();
        let all_at = |place: Pose2| agreement(map, &seen.beams, place).map(|it| it.all);
        let fits = |place: Pose2| all_at(place).is_some_and(|it| it >= least);
        if !rivals.keep(|place| fits(place.known.pose)) {
            return false;
        }
        let stays = Rivals::new(map, &seen.beams, &seen.ends, [estimate.pose], completeness);
        // Who never knew cannot have gone off the map from there.
        let knew = self.watch.was_sure();
        if let Some(stays) = stays.filter(|_| knew) {
            rivals.add(stays.best(), if self.trust.is_carried() { 0.0 } else { STAYS });
        }
        let best = rivals.best().known.pose;
        let fit = all_at(best).unwrap_or(0.0);
        if fit < self.convincing() {
            return false;
        }
        let is_here = libm::hypot(best.x_m - estimate.pose.x_m, best.y_m - estimate.pose.y_m) < 0.5;
        if is_here && (rivals.is_decided() || rivals.is_alone()) {
            self.open_account(&rivals);
            return false;
        }
        let here = Known { pose: estimate.pose, information: loosely(0.2, 0.1) };
        self.home = knew.then(|| self.fine.unwrap_or((here, odom_from_base)));
        self.believe(estimate, rivals, fit, seen);
        true
    }
}

/// How far a scan has the robot from where odometry has it, where that is a contradiction:
/// \[m\], \[rad\].
fn jump(carried: Pose2, found: Pose2, step: Pose2) -> Option<(f64, f64)> {
    let off = carried.inverse() * found;
    let (off_m, off_rad) = (length_m(off), normalize_angle(off.yaw_rad).abs());
    let most_m = JUMP.0 + SLIP * length_m(step);
    let most_rad = JUMP.1 + SLIP * normalize_angle(step.yaw_rad).abs();
    (off_m > most_m || off_rad > most_rad).then_some((off_m, off_rad))
}

fn length_m(step: Pose2) -> f64 {
    libm::hypot(step.x_m, step.y_m)
}

fn spread_of(known: &Known) -> Covariance2 {
    let inverse = known.information.inverse().unwrap_or_default();
    Covariance2 { xx: inverse.xx, xy: inverse.xy, yy: inverse.yy, yaw: inverse.tt }
}

/// The best cluster, where the scan has put it, and those others that the scan does not refute.
fn still_possible(
    map: &KnownMap,
    seen: &Seen,
    clusters: &[Cluster],
    pose: Pose2,
    spread: Covariance2,
) -> Vec<Cluster> {
    let Some((first, others)) = clusters.split_first() else { return Vec::new() };
    let mut kept = vec![Cluster { mean: pose, covariance: spread, ..*first }];
    let least = evidence(map, &seen.beams, pose) - REFUTED;
    for other in others.iter().filter(|it| it.weight >= LEAST_WEIGHT) {
        let known = Known { pose: other.mean, information: loosely(0.3, 0.2) };
        let there = polish(map, &seen.ends, &known).known.pose;
        if !is_same(there, pose) && evidence(map, &seen.beams, there) >= least {
            kept.push(*other);
        }
    }
    kept
}

pub(super) fn is_same(a: Pose2, b: Pose2) -> bool {
    libm::hypot(a.x_m - b.x_m, a.y_m - b.y_m) < SAME.0
        && normalize_angle(a.yaw_rad - b.yaw_rad).abs() < SAME.1
}

/// Spread at least as far as particles should be.
fn widened(covariance: Covariance2) -> Covariance2 {
    let (place, turn) = LEAST_SPREAD;
    Covariance2 {
        xx: covariance.xx + place * place,
        yy: covariance.yy + place * place,
        yaw: covariance.yaw + turn * turn,
        ..covariance
    }
}
