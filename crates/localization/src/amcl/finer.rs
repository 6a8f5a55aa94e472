//! What goes beyond Nav2: several places followed, poses refined, the lost looked for.

use periplus_base::{Pose2, normalize_angle};
use periplus_diagnostics::Diagnostic;
use periplus_matching::{Peak, Symmetric3};

use super::{Amcl, Estimate, has_moved};
use crate::anywhere::Everywhere;
use crate::evidence::agreement;
use crate::guess::scatter;
use crate::models::Model;
use crate::particles::{Covariance2, Particles};
use crate::polish::{Known, loosely, moved, polish};
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
/// Without so much motion the lost are not looked for again \[m\], \[rad\].
const AGAIN: (f64, f64) = (0.5, 0.5);
/// With a larger share of particles that should be anywhere, the robot is looked for.
const CARRIED: f64 = 0.1;
/// How much more likely (as a logarithm) it is that a robot was not carried away.
const STAYS: f64 = 5.0;
/// What follows from a better start has to fit better by this.
const BETTER: f64 = 0.03;

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
    ) {
        let (Some(mut rivals), Some(map)) = (self.rivals.take(), &self.map) else { return };
        if let Some(old_from_new) = old_from_new {
            rivals.follow(map, &seen.beams, &seen.ends, old_from_new);
        }
        self.believe(estimate, rivals);
    }

    /// Makes places what is estimated.
    fn believe(&mut self, estimate: &mut Estimate, rivals: Rivals) {
        self.particles = self.drawn_from(&rivals);
        let best = rivals.best().known;
        *estimate = self.sum_up();
        estimate.pose = best.pose;
        estimate.clusters = rivals.clusters(self.particles.len());
        self.fine = None;
        if !rivals.is_decided() {
            self.rivals = Some(rivals);
        }
    }

    /// Refines the estimate, and puts some of the particles there.
    pub(super) fn polish(&mut self, estimate: &mut Estimate, seen: &Seen, odom_from_base: Pose2) {
        let is_wanted = self.settings.polishes && self.rivals.is_none();
        let (Some(map), true, Some(cluster)) =
            (&self.map, is_wanted && !seen.ends.is_empty(), estimate.clusters.first())
        else {
            self.fine = None;
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
        let followed = self.fine.take().map(|(known, old)| {
            let known = moved(&known, old.inverse() * odom_from_base);
            polish(map, &seen.ends, &known)
        });
        let fresh = polish(map, &seen.ends, &Known { pose: mean, information });
        let best = followed
            .filter(|it| is_near(it.known.pose) && it.fit >= fresh.fit - BETTER)
            .unwrap_or(fresh);
        if !is_near(best.known.pose) {
            return;
        }
        estimate.pose = best.known.pose;
        self.fine = Some((best.known, odom_from_base));
        let mut stream = self.stream("polish");
        let mut drawn = Particles::default();
        let count = self.particles.len() / EVERY;
        let inverse = best.known.information.inverse().unwrap_or_default();
        let spread =
            Covariance2 { xx: inverse.xx, xy: inverse.xy, yy: inverse.yy, yaw: inverse.tt };
        scatter(&mut drawn, count, best.known.pose, spread, &mut stream);
        for index in 0..count {
            self.particles.x_m[index] = drawn.x_m[index];
            self.particles.y_m[index] = drawn.y_m[index];
            self.particles.yaw_rad[index] = drawn.yaw_rad[index];
        }
    }

    /// Refines the pose by a scan that the filter does not use.
    pub(super) fn refine(&mut self, odom_from_base: Pose2, scan: &Scan) {
        let (Some(map), Some((known, old))) = (&self.map, &self.fine) else { return };
        if !has_moved(*old, odom_from_base, STILL) {
            return;
        }
        let Ok(seen) = Seen::new(scan, &self.settings) else { return };
        if seen.ends.is_empty() {
            return;
        }
        let known = moved(known, old.inverse() * odom_from_base);
        let polished = polish(map, &seen.ends, &known);
        self.fine = Some((polished.known, odom_from_base));
        let pose = polished.known.pose;
        // What may be the sign of a robot that was carried away is worth the work at once.
        self.is_forced |= self.watch.suspects(agreement(map, &seen.beams, pose));
        self.map_from_odom = Some((pose * odom_from_base.inverse()).normalized());
    }

    /// Whether the robot is to be looked for on all of the map.
    pub(super) fn seeks(&self, random_share: f64, odom_from_base: Pose2) -> bool {
        let is_lost = self.status.state == State::Lost
            || random_share > CARRIED
            || self.watch.suspects(self.status.fit);
        let is_new =
            self.sought.as_ref().is_none_or(|(place, _)| has_moved(*place, odom_from_base, AGAIN));
        self.settings.seeks_when_lost && is_lost && is_new
    }

    /// Looks for a robot that is lost; whether it may be elsewhere.
    pub(super) fn seek_again(
        &mut self,
        estimate: &mut Estimate,
        seen: &Seen,
        odom_from_base: Pose2,
    ) -> bool {
        self.sought = Some((odom_from_base, super::no_pose()));
        let peaks = self.look_everywhere(seen);
        let Some(map) = &self.map else { return false };
        let poses = peaks.iter().map(|peak| peak.pose);
        let Some(mut rivals) = Rivals::new(map, &seen.beams, &seen.ends, poses) else {
            return false;
        };
        let stays = Rivals::new(map, &seen.beams, &seen.ends, [estimate.pose]);
        if let Some(stays) = stays {
            rivals.add(stays.best(), STAYS);
        }
        let best = rivals.best().known.pose;
        let is_here = libm::hypot(best.x_m - estimate.pose.x_m, best.y_m - estimate.pose.y_m) < 0.5;
        if is_here && rivals.is_decided() {
            return false;
        }
        self.believe(estimate, rivals);
        true
    }
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
