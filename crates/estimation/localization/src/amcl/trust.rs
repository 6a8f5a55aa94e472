//! Whether the robot may say that it knows where it is.
//!
//! A place that somebody told, or that was followed without a gap, is trusted as long as scans fit
//! there. One that was found, or where the robot came to by odometry after scans had not fitted for
//! some way, is not: half of a scan of one room fits into many others, and what fits best on a map need
//! not be on it at all. Such a place has to be proven: searches on all of the map, some way apart, have
//! to find it again, each time better than every other place.

use periplus_geometry::{Pose2, normalize_angle};

use super::finer::{CONVINCING, REFUTED, Seen};
use super::{Amcl, has_moved};
use crate::evidence::{agreement, evidence};
use crate::hunt::Completeness;
use crate::polish::{Known, loosely, polish};
use crate::rivals::{HOPELESS, NOWHERE, PROVEN_M, Rivals, news};
use crate::status::State;

/// With a smaller part of a scan on walls of the map, the map does not say where the robot is.
const COVERED: f64 = 0.55;
/// A robot that is told where it is has to see such a part of its first scan on walls, or it is to be
/// proven.
const TOLD: f64 = 0.6;
/// A robot farther than this from all that is free is off the map \[m\].
const FREE_M: f64 = 0.3;
/// After so much more way without a fit than with one, a place has to be proven \[m\].
const LAPSE_M: f64 = 2.0;
/// Ways count so many times less where scans hit nothing at all: an open place is no contradiction.
const OPEN: f64 = 0.25;
/// And where scans are unlike those before.
const UNLIKE: f64 = 0.5;
/// So many searches have to agree.
const AGREEING: u32 = 2;
/// So many where odometry has the robot off the map, but not farther from it than odometry may err.
const AGREEING_OFF: u32 = 6;
/// Odometry errs by up to this and this share of the way since the place was trusted last \[m\], and in
/// heading by this and so much for each metre \[rad\].
const ERRS_M: (f64, f64) = (0.5, 0.1);
const ERRS_RAD: (f64, f64) = (0.35, 0.02);
/// A longer step of odometry from scan to scan is not known well enough \[m\].
const LONG_M: f64 = 2.5;
/// Where such a part of scans, besides the usual, contradicts the map for so much way \[m\], not farther
/// from where the place was trusted last \[m\], the robot was carried away: at the edge of a map nothing
/// contradicts it. Farther on it takes more way.
const CONTRADICTED: f64 = 0.4;
const CARRIED_M: f64 = 0.3;
const CARRIED_AT_M: f64 = 3.0;
const CARRIED_LONG_M: f64 = 10.0;
/// What usually contradicts the map is learned from so many scans, about.
const MEMORY: f64 = 0.02;
/// With a smaller part of scans usually on walls, too much of the place has changed for a search to find it
/// for certain.
const CHANGED: f64 = 0.75;
/// Over so much way \[m\] scans may draw the robot on or back, from where odometry has it, by this \[m\] and
/// this share of the way: at the edge of a map, or where the place has changed, two walls along the way and
/// the end of one that is known hold it.
const DRAWN_OVER_M: f64 = 4.0;
const DRAWN_M: f64 = 0.25;
const DRAWN_SHARE: f64 = 0.12;
/// One is enough where such a part of the scan is on walls, and it is so likely (as a logarithm), and
/// every other place on the map so much less.
const AT_ONCE: (f64, f64, f64) = (0.85, -3.0, 9.0);
/// By so much less (as a logarithm) a scan is likely at its place where nothing of it is on walls.
const UNUSUAL: f64 = 20.0;
/// A search is asked for again after so much more way or turn \[m\], \[rad\].
const APART: (f64, f64) = (0.8, 0.8);
const APART_OFF: (f64, f64) = (2.5, 9.0);
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
    /// Whether the robot was carried away, or odometry is wrong: then odometry says nothing of where it is.
    is_carried: bool,
    /// Way on which scans contradicted the map where odometry has the robot \[m\]; none where the last one
    /// did not.
    contradicted_m: Option<f64>,
    /// Which part of scans usually contradicts it.
    contradicted: f64,
    /// Whether odometry has the robot off the map.
    is_off: bool,
    /// Where odometry began on the map when the place was trusted last, and the way since \[m\].
    anchor: Option<(Pose2, f64)>,
    /// How far scans have drawn the robot on along its way of late, from where odometry had it, and how much
    /// way that was \[m\].
    drawn_m: (f64, f64),
    /// The last place that was told.
    map_from_base: Option<Pose2>,
    /// Way without a fit, less that with one \[m\].
    lapse_m: f64,
    /// Where odometry had the robot at the last scan.
    odom_from_base: Option<Pose2>,
    /// Which part of the last scan is on walls, where that is too little.
    uncovered: Option<f64>,
    /// The same of a scan that is unlike those before, and the least that is not.
    unusual: Option<(f64, f64)>,
    /// Whether the robot is where the map says that none can be.
    is_outside: bool,
    /// Scans that were seen.
    scans: u64,
}

/// What odometry says for a place, since one was trusted last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ByOdometry {
    /// The robot may be there.
    Possible,
    /// The same, but rather off the map.
    OffMap,
    /// It is not there.
    Elsewhere,
}

/// A scan at the place that is told.
struct Sight {
    /// Which part of it is on walls of the map, none when it hit nothing.
    on_walls: Option<f64>,
    /// Which part contradicts the map where odometry has the robot; none where that is off the map.
    contradicted: Option<f64>,
    /// Whether the robot is where the map says that none can be.
    is_outside: bool,
    /// Which part of what the map can judge is on walls where that is unusual, and the least that is not.
    unusual: Option<(f64, f64)>,
}

impl Trust {
    /// The place is to be proven.
    pub(super) fn open(&mut self, agreed: u32) {
        self.agreed = Some(agreed);
        self.is_off = false;
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
        if self.is_off { AGREEING_OFF } else { AGREEING }
    }

    pub(super) fn is_open(&self) -> bool {
        self.agreed.is_some()
    }

    pub(super) fn is_carried(&self) -> bool {
        self.is_carried
    }

    /// A search has found the place, and nothing like it.
    fn agree(&mut self, is_overwhelming: bool) {
        self.agreed = self.agreed.map(|agreed| agreed + 1);
        if is_overwhelming && !self.is_off || self.agreed.is_some_and(|it| it >= self.needed()) {
            self.agreed = None;
            self.account = None;
            self.lapse_m = 0.0;
        }
    }

    /// A scan at the place. Steady is a place that follows odometry.
    fn see(&mut self, odom_from_base: Pose2, map_from_base: Pose2, sight: &Sight, is_steady: bool) {
        let step =
            self.odom_from_base.replace(odom_from_base).map(|old| old.inverse() * odom_from_base);
        let way_m = step.map_or(0.0, |step| libm::hypot(step.x_m, step.y_m));
        let old = self.map_from_base.replace(map_from_base);
        if let (Some(step), Some(old)) = (step, old) {
            self.draw(step, old.inverse() * map_from_base);
        }
        let is_drawn = self.drawn() > 1.0;
        if way_m > LONG_M {
            self.open(0);
            self.is_carried = true;
        }
        let Sight { on_walls, is_outside, .. } = *sight;
        self.uncovered = on_walls.filter(|part| *part < COVERED);
        self.unusual = sight.unusual;
        self.is_outside = is_outside;
        let is_bad = self.uncovered.is_some() || self.unusual.is_some() || is_outside;
        if let Some((_, since_m)) = &mut self.anchor {
            *since_m += way_m;
        }
        self.lapse_m = match on_walls {
            None if !is_outside => self.lapse_m + OPEN * way_m,
            _ if self.uncovered.is_some() || is_outside => self.lapse_m + way_m,
            _ if is_bad => self.lapse_m + UNLIKE * way_m,
            _ => (self.lapse_m - way_m).max(0.0),
        };
        self.contradict(sight.contradicted, way_m);
        // At the edge of a map, half of a scan may draw the robot along.
        let fits = on_walls.is_some_and(|part| part >= TOLD) && !is_bad && self.drawn() < 0.5;
        if fits && is_steady && self.agreed.is_none() && self.lapse_m == 0.0 {
            let map_from_odom = (map_from_base * odom_from_base.inverse()).normalized();
            self.anchor = Some((map_from_odom, 0.0));
            self.is_carried = false;
        }
        self.scans += 1;
        let is_unlikely = self.scans == 1 && on_walls.is_some_and(|part| part < TOLD);
        if is_unlikely && self.agreed.is_none() {
            // At the edge of the map, rather than anywhere.
            self.anchor = Some(((map_from_base * odom_from_base.inverse()).normalized(), 0.0));
        }
        if (self.lapse_m > LAPSE_M || is_unlikely || is_drawn) && self.agreed.is_none() {
            self.open(0);
        }
    }

    /// A step of odometry, and of the place that is told.
    fn draw(&mut self, by_odometry: Pose2, by_scans: Pose2) {
        let way_m = libm::hypot(by_odometry.x_m, by_odometry.y_m);
        let kept = libm::exp(-way_m / DRAWN_OVER_M);
        let more = [by_scans.x_m - by_odometry.x_m, by_scans.y_m - by_odometry.y_m];
        // Across it odometry errs with the heading, and with what the mounting of the scanner is off.
        let along = (more[0] * by_odometry.x_m + more[1] * by_odometry.y_m) / way_m.max(0.01);
        self.drawn_m = (kept * self.drawn_m.0 + along, kept * self.drawn_m.1 + way_m);
    }

    /// How far scans have drawn the robot, as a part of what is too far.
    fn drawn(&self) -> f64 {
        let (drawn_m, way_m) = self.drawn_m;
        drawn_m.abs() / (DRAWN_M + DRAWN_SHARE * way_m)
    }

    /// Which part of a scan contradicts the map where odometry has the robot, none where that is off the
    /// map, after so much more of the way.
    fn contradict(&mut self, part: Option<f64>, way_m: f64) {
        let is_contradicted = part.is_some_and(|part| part >= CONTRADICTED + self.contradicted);
        self.contradicted_m =
            is_contradicted.then(|| self.contradicted_m.map_or(0.0, |before_m| before_m + way_m));
        let is_here = self.anchor.is_some_and(|(_, since_m)| since_m < CARRIED_AT_M);
        let most_m = if is_here { CARRIED_M } else { CARRIED_LONG_M };
        self.is_carried |= self.contradicted_m.is_some_and(|it| it > most_m);
        if let Some(part) = part
            && self.agreed.is_none()
        {
            self.contradicted += MEMORY * (part - self.contradicted);
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
        if let Some((part, least)) = self.unusual {
            let (percent, least) = (100.0 * part, 100.0 * least);
            return Some(format!(
                "only {percent:.0} % of the scan is on walls of the map, more than {least:.0} % used to \
                 be: the robot was carried away, or the place has changed"
            ));
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
        let agreement = agreement(map, &seen.beams, map_from_base);
        let least = self.watch.least_usual();
        let sight = Sight {
            on_walls: agreement.map(|it| it.all),
            contradicted: self.contradicted_by_odometry(seen, odom_from_base),
            is_outside: !map.is_free_near(map_from_base.x_m, map_from_base.y_m, FREE_M),
            unusual: self
                .fit(map_from_base, &seen.beams)
                .filter(|part| self.watch.was_sure() && *part < least)
                .map(|part| (part, least)),
        };
        if self.trust.account.is_some()
            && let Some(old) = self.trust.odom_from_base
        {
            let more = evidence(map, &seen.beams, map_from_base) - NOWHERE;
            self.trust.count(old.inverse() * odom_from_base, more);
        }
        let is_steady = self.jump.is_none() && self.base_state() == State::Tracking;
        self.trust.see(odom_from_base, map_from_base, &sight, is_steady);
    }

    /// Why a robot is not sure that the filter has at one place.
    pub(super) fn distrust(&self) -> Option<String> {
        self.trust.doubt(self.settings.seeks_when_lost)
    }

    /// Whether it is time for another search for a proof.
    pub(super) fn is_proof_due(&self, odom_from_base: Pose2) -> bool {
        let apart = if self.trust.is_off { APART_OFF } else { APART };
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
        // Those where odometry cannot have led to are no others, for a place where all is as usual.
        let is_usual = fit >= self.watch.least_usual();
        let is_other = |pose: &Pose2| {
            let is_possible = !is_usual || self.by_odometry(*pose) != ByOdometry::Elsewhere;
            is_possible && !super::finer::is_same(*pose, place)
        };
        let others = found.iter().map(refined).filter(is_other);
        let best =
            others.map(|it| evidence(map, &seen.beams, it)).fold(f64::NEG_INFINITY, f64::max);
        let least = (CONVINCING.0 * self.watch.usual()).max(CONVINCING.1);
        // Where scans usually fit less, less suffices.
        let usual = if self.watch.was_sure() { self.watch.usual() } else { 1.0 };
        let is_likely = own >= NOWHERE - UNUSUAL * (1.0 - usual).max(0.0);
        let is_alone = best <= own - REFUTED && completeness > Completeness::Part;
        let by_odometry = self.by_odometry(place);
        if fit < least || !is_likely || !is_alone || by_odometry == ByOdometry::Elsewhere {
            return false;
        }
        if by_odometry == ByOdometry::OffMap {
            (self.trust.is_off, self.trust.account) = (true, None);
        }
        let (sure, likely, margin) = AT_ONCE;
        let is_whole = completeness == Completeness::Whole;
        self.trust.agree(is_whole && fit >= sure && own >= likely && best < own - margin);
        true
    }

    /// Where odometry has the robot since its place was trusted last, and how far that may be wrong: \[m\],
    /// \[rad\]. None where that was never, or odometry says nothing.
    fn since_trusted(&self, odom_from_base: Pose2) -> Option<(Pose2, f64, f64)> {
        let (map_from_odom, since_m) = self.trust.anchor.filter(|_| !self.trust.is_carried)?;
        let by_odometry = (map_from_odom * odom_from_base).normalized();
        Some((by_odometry, ERRS_M.0 + ERRS_M.1 * since_m, ERRS_RAD.0 + ERRS_RAD.1 * since_m))
    }

    fn contradicted_by_odometry(&self, seen: &Seen, odom_from_base: Pose2) -> Option<f64> {
        let map = self.map.as_ref()?;
        let (by_odometry, ..) = self.since_trusted(odom_from_base)?;
        let is_on_map = map.is_free_near(by_odometry.x_m, by_odometry.y_m, FREE_M);
        agreement(map, &seen.beams, by_odometry).filter(|_| is_on_map).map(|it| it.contradicted)
    }

    /// What odometry says for a place. A robot that has left the map sees other places that are like those
    /// on it.
    pub(super) fn by_odometry(&self, place: Pose2) -> ByOdometry {
        let (Some(map), Some(odom_from_base)) = (&self.map, self.trust.odom_from_base) else {
            return ByOdometry::Possible;
        };
        let Some((by_odometry, errs_m, errs_rad)) = self.since_trusted(odom_from_base) else {
            return ByOdometry::Possible;
        };
        let off = by_odometry.inverse() * place;
        let is_far =
            libm::hypot(off.x_m, off.y_m) > errs_m || normalize_angle(off.yaw_rad).abs() > errs_rad;
        let is_free = |near_m| map.is_free_near(by_odometry.x_m, by_odometry.y_m, near_m);
        match () {
            () if is_far || !is_free(errs_m) => ByOdometry::Elsewhere,
            () if !is_free(FREE_M) => ByOdometry::OffMap,
            () => ByOdometry::Possible,
        }
    }

    /// After one of several places was left over, or another believed.
    pub(super) fn found_at(&mut self, place: Pose2, seen: &Seen, rivals: &Rivals) {
        let Some(map) = &self.map else { return };
        let fit = agreement(map, &seen.beams, place).map_or(0.0, |it| it.all);
        let (sure, likely, _) = AT_ONCE;
        let is_overwhelming =
            rivals.is_only() && fit >= sure && evidence(map, &seen.beams, place) >= likely;
        let by_odometry = self.by_odometry(place);
        self.trust.open(1);
        // It is another place, not one to which scans have drawn the robot.
        (self.trust.drawn_m, self.trust.map_from_base) = (Default::default(), None);
        if by_odometry != ByOdometry::Possible {
            self.trust.is_off = true;
            return;
        }
        if is_overwhelming || rivals.is_proven() && self.is_among() {
            self.trust.agree(true);
        } else {
            self.open_account(rivals);
        }
    }

    /// Whether the right place was among all places that a search has found. Who was not carried away may
    /// have been off the map; then another search has to agree.
    fn is_among(&self) -> bool {
        let knew = self.watch.was_sure() || self.trust.anchor.is_some();
        !knew || self.trust.is_carried && self.watch.usual() >= CHANGED
    }

    /// From now on scans on the way are proof as well.
    pub(super) fn open_account(&mut self, rivals: &Rivals) {
        if self.trust.is_open() && self.trust.account.is_none() && self.is_among() {
            self.trust.account = rivals.account();
        }
    }

    /// What the filter says, whatever else is doubted.
    pub(super) fn base_state(&self) -> State {
        self.undoubted.as_ref().unwrap_or(&self.status).state
    }
}
