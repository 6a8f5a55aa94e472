//! Whether the robot may say that it knows where it is.
//!
//! A place that somebody told, or that was followed without a gap, is trusted as long as scans fit
//! there. One that was found, or where the robot came to by odometry after scans had not fitted for
//! some way, is not: half of a scan of one room fits into many others, and what fits best on a map need
//! not be on it at all. Such a place has to be proven: searches on all of the map, some way apart, have
//! to find it again, each time better than every other place.

use periplus_base::{Pose2, normalize_angle};

use super::finer::{CONVINCING, REFUTED, Seen};
use super::{Amcl, has_moved};
use crate::evidence::{agreement, evidence};
use crate::hunt::Completeness;
use crate::polish::{Known, loosely, polish};
use crate::rivals::{HOPELESS, NOWHERE, PROVEN_M, Rivals, news};
use crate::status::State;

/// With a smaller part of a scan on walls of the map, the map does not say where the robot is.
const COVERED: f64 = 0.5;
/// A robot that is told where it is has to see such a part of its first scan on walls, or it is to be
/// proven.
const TOLD: f64 = 0.6;
/// A robot farther than this from all that is free is off the map \[m\].
const FREE_M: f64 = 0.3;
/// After so much more way without a fit than with one, a place has to be proven \[m\].
const LAPSE_M: f64 = 2.0;
/// Ways count so many times less where scans hit nothing at all: an open place is no contradiction.
const OPEN: f64 = 0.25;
/// So many searches have to agree.
const AGREEING: u32 = 2;
/// So many where odometry has the robot far from there and off the map, which is where it may well be:
/// one corridor is like another.
const AGREEING_FAR: u32 = 6;
/// Places are far from where odometry has the robot beyond this, and this share of the way since its
/// place was trusted last; or turned further \[m\], \[rad\].
const FAR: (f64, f64, f64) = (1.5, 0.1, 0.6);
const LONG_AGO_M: f64 = 10.0;
/// A longer step of odometry from scan to scan is not known well enough \[m\].
const LONG_M: f64 = 2.5;
/// One is enough where such a part of the scan is on walls, and it is so likely (as a logarithm), and
/// every other place on the map so much less.
const AT_ONCE: (f64, f64, f64) = (0.85, -3.0, 9.0);
/// By so much less (as a logarithm) a scan is likely at its place where nothing of it is on walls.
const UNUSUAL: f64 = 20.0;
/// A search is asked for again after so much more way or turn \[m\], \[rad\].
const APART: (f64, f64) = (0.8, 0.8);
const APART_FAR: (f64, f64) = (2.5, 9.0);
/// For a proof nothing is looked for that fits so much worse than the place itself.
pub(super) const RIVALLING: f64 = 0.85;

/// What speaks for the place that is told.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Trust {
    /// How many searches have agreed; none when nothing has to be proven.
    agreed: Option<u32>,
    /// How much likelier (as a logarithm) scans have made it since it was found, all others being left
    /// out, than to be nowhere on the map, and on how much way \[m\].
    account: Option<(f64, f64)>,
    /// Whether the place is far from where odometry has the robot.
    is_far: bool,
    /// Where odometry began on the map when the place was trusted last, and the way since \[m\].
    anchor: Option<(Pose2, f64)>,
    /// Way without a fit, less that with one \[m\].
    lapse_m: f64,
    /// Where odometry had the robot at the last scan.
    odom_from_base: Option<Pose2>,
    /// Which part of the last scan is on walls, where that is too little.
    uncovered: Option<f64>,
    /// Whether the robot is where the map says that none can be.
    is_outside: bool,
    /// Scans that were seen.
    scans: u64,
}

impl Trust {
    /// The place is to be proven.
    pub(super) fn open(&mut self, agreed: u32) {
        self.agreed = Some(agreed);
        self.is_far = false;
        self.account = None;
    }

    /// A scan at the place that is to be proven, after so much more of the way; `more` is how much
    /// likelier it is there than nowhere on the map.
    fn count(&mut self, step: Pose2, more: f64) {
        let Some((sum, way_m)) = self.account else { return };
        let step_m = libm::hypot(step.x_m, step.y_m);
        let (sum, way_m) = (sum + news(step) * more, way_m + step_m);
        self.account = Some((sum, way_m));
        if sum >= HOPELESS && way_m >= PROVEN_M {
            self.agree(true);
        }
    }

    /// How many searches have to agree.
    fn needed(&self) -> u32 {
        if self.is_far { AGREEING_FAR } else { AGREEING }
    }

    pub(super) fn is_open(&self) -> bool {
        self.agreed.is_some()
    }

    /// A search has found the place, and nothing like it.
    fn agree(&mut self, is_overwhelming: bool) {
        self.agreed = self.agreed.map(|agreed| agreed + 1);
        if is_overwhelming && !self.is_far || self.agreed.is_some_and(|it| it >= self.needed()) {
            self.agreed = None;
            self.account = None;
            self.lapse_m = 0.0;
        }
    }

    /// A scan at the place; `on_walls` is the part of it on walls of the map, none when it hit nothing.
    /// Steady is a place that follows odometry.
    fn see(
        &mut self,
        odom_from_base: Pose2,
        map_from_base: Pose2,
        on_walls: Option<f64>,
        is_outside: bool,
        is_steady: bool,
    ) {
        let old = self.odom_from_base.replace(odom_from_base);
        let way_m = old.map_or(0.0, |old| {
            let step = old.inverse() * odom_from_base;
            libm::hypot(step.x_m, step.y_m)
        });
        if way_m > LONG_M {
            self.open(0);
        }
        self.uncovered = on_walls.filter(|part| *part < COVERED);
        self.is_outside = is_outside;
        let is_bad = self.uncovered.is_some() || is_outside;
        if let Some((_, since_m)) = &mut self.anchor {
            *since_m += way_m;
        }
        self.lapse_m = match on_walls {
            None if !is_outside => self.lapse_m + OPEN * way_m,
            _ if is_bad => self.lapse_m + way_m,
            _ => (self.lapse_m - way_m).max(0.0),
        };
        // At the edge of a map, half of a scan may draw the robot along.
        let fits = on_walls.is_some_and(|part| part >= TOLD) && !is_outside;
        if fits && is_steady && self.agreed.is_none() && self.lapse_m == 0.0 {
            let map_from_odom = (map_from_base * odom_from_base.inverse()).normalized();
            self.anchor = Some((map_from_odom, 0.0));
        }
        self.scans += 1;
        let is_unlikely = self.scans == 1 && on_walls.is_some_and(|part| part < TOLD);
        if (self.lapse_m > LAPSE_M || is_unlikely) && self.agreed.is_none() {
            self.open(0);
        }
    }

    /// Why the robot is not sure, though scans fit well enough to follow the place.
    fn doubt(&self, needs_proof: bool) -> Option<String> {
        if let Some(part) = self.uncovered {
            let percent = 100.0 * part;
            return Some(format!(
                "only {percent:.0} % of the scan is on walls of the map: the robot is off the map, or \
                 the place has changed"
            ));
        }
        if self.is_outside {
            return Some("the robot is where the map has no free place".into());
        }
        let agreed = self.agreed.filter(|_| needs_proof)?;
        Some(format!(
            "the place fits, but so may another: {agreed} of {} searches on all of the map \
             have it alone; it is known after some more way",
            self.needed()
        ))
    }
}

impl Amcl {
    /// Whether the place that is told has to be proven. Where nobody may look on all of the map, it
    /// cannot.
    pub(super) fn is_unproven(&self) -> bool {
        self.trust.is_open() && self.settings.seeks_when_lost
    }

    /// Looks at how much of a scan the map has at the place that is told.
    pub(super) fn see_at(&mut self, seen: &Seen, map_from_base: Pose2, odom_from_base: Pose2) {
        let Some(map) = &self.map else { return };
        let on_walls = agreement(map, &seen.beams, map_from_base).map(|it| it.all);
        let is_outside = !map.is_free_near(map_from_base.x_m, map_from_base.y_m, FREE_M);
        if self.trust.account.is_some()
            && let Some(old) = self.trust.odom_from_base
        {
            let more = evidence(map, &seen.beams, map_from_base) - NOWHERE;
            self.trust.count(old.inverse() * odom_from_base, more);
        }
        let is_steady = self.jump.is_none() && self.base_state() == State::Tracking;
        self.trust.see(odom_from_base, map_from_base, on_walls, is_outside, is_steady);
    }

    /// Why a robot is not sure that the filter has at one place.
    pub(super) fn distrust(&self) -> Option<String> {
        self.trust.doubt(self.settings.seeks_when_lost)
    }

    /// Whether it is time for another search for a proof.
    pub(super) fn is_proof_due(&self, odom_from_base: Pose2) -> bool {
        let apart = if self.trust.is_far { APART_FAR } else { APART };
        self.is_unproven()
            && self.rivals.is_none()
            && self
                .sought
                .as_ref()
                .is_none_or(|(place, _)| has_moved(*place, odom_from_base, apart))
    }

    /// What a search says for the place that is told: `found` are all places where the scan fits about as
    /// well. Whether the place is the one; then it is that much more trusted.
    pub(super) fn prove(
        &mut self,
        seen: &Seen,
        place: Pose2,
        found: &[Pose2],
        completeness: Completeness,
    ) -> bool {
        let Some(map) = &self.map else { return false };
        let own = evidence(map, &seen.beams, place);
        let Some(fit) = agreement(map, &seen.beams, place).map(|it| it.all) else { return false };
        let refined = |pose: &Pose2| {
            let known = Known { pose: *pose, information: loosely(0.3, 0.15) };
            polish(map, &seen.ends, &known).known.pose
        };
        let others = found.iter().map(refined).filter(|pose| !super::finer::is_same(*pose, place));
        let best =
            others.map(|it| evidence(map, &seen.beams, it)).fold(f64::NEG_INFINITY, f64::max);
        let least = (CONVINCING.0 * self.watch.usual()).max(CONVINCING.1);
        // Where scans usually fit less, less suffices.
        let usual = if self.watch.was_sure() { self.watch.usual() } else { 1.0 };
        let is_likely = own >= NOWHERE - UNUSUAL * (1.0 - usual).max(0.0);
        let is_alone = best <= own - REFUTED && completeness > Completeness::Part;
        if fit < least || !is_likely || !is_alone {
            return false;
        }
        let (sure, likely, margin) = AT_ONCE;
        let is_whole = completeness == Completeness::Whole;
        if self.is_far(place) {
            (self.trust.is_far, self.trust.account) = (true, None);
        }
        self.trust.agree(is_whole && fit >= sure && own >= likely && best < own - margin);
        true
    }

    /// Whether a place is far from where odometry has the robot since its place was trusted, and that is
    /// off the map: there it may well be. Or that was long ago: who was carried away would have been
    /// found, for the map has the place.
    fn is_far(&self, place: Pose2) -> bool {
        let (Some(map), Some((map_from_odom, since_m))) = (&self.map, self.trust.anchor) else {
            return false;
        };
        let Some(odom_from_base) = self.trust.odom_from_base else { return false };
        let by_odometry = map_from_odom * odom_from_base;
        let off = by_odometry.inverse() * place;
        let (least_m, share, most_rad) = FAR;
        let is_far = libm::hypot(off.x_m, off.y_m) > least_m + share * since_m
            || normalize_angle(off.yaw_rad).abs() > most_rad;
        is_far
            && (since_m > LONG_AGO_M || !map.is_free_near(by_odometry.x_m, by_odometry.y_m, FREE_M))
    }

    /// After one of several places was left over, or another believed.
    pub(super) fn found_at(&mut self, place: Pose2, seen: &Seen, rivals: &Rivals) {
        let Some(map) = &self.map else { return };
        let fit = agreement(map, &seen.beams, place).map_or(0.0, |it| it.all);
        let (sure, likely, _) = AT_ONCE;
        let is_overwhelming =
            rivals.is_only() && fit >= sure && evidence(map, &seen.beams, place) >= likely;
        let is_far = self.is_far(place);
        self.trust.open(1);
        self.trust.is_far = is_far;
        if is_far {
            return;
        }
        if is_overwhelming || rivals.is_proven() && !self.watch.was_sure() {
            self.trust.agree(true);
        } else if !self.watch.was_sure() {
            // Who was lost may have been off the map when these were found, and the right place none of
            // them: then another search has to agree.
            self.trust.account = rivals.account();
        }
    }

    /// What the filter says, whatever else is doubted.
    pub(super) fn base_state(&self) -> State {
        self.undoubted.as_ref().unwrap_or(&self.status).state
    }
}
