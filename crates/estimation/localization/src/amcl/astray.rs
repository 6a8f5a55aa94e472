//! One place, followed where odometry errs and the map ends.

use periplus_geometry::Pose2;
use periplus_scan_matching::Peak;

use super::finer::{CONVINCING, REFUTED, STRAY, Seen, is_same};
use super::{Amcl, Estimate};
use crate::anywhere::Everywhere;
use crate::evidence::{agreement, evidence};
use crate::polish::{Known, loosely, polish};
use crate::scan::Beams;

/// With a smaller part of what is usual on walls a place is looked for nearby.
pub(super) const ENOUGH: f64 = 0.85;
/// So far after a scan that fitted it is known where the robot is, whatever the map does not \[m\].
pub(super) const TRUSTED_M: f64 = 3.0;
/// So much more of the scan has to be on walls there.
const CLEARLY: f64 = 0.1;
/// How far around it is looked: at least, more for each metre since a scan fitted, at most \[m\],
/// \[rad\].
const AROUND_M: (f64, f64, f64) = (0.25, 0.1, 4.0);
const AROUND_RAD: (f64, f64, f64) = (0.35, 0.02, 0.8);

/// What a robot may have done where odometry errs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// It is somewhere around.
    Gone,
    /// It turned, and hardly went anywhere: so a scan of two walls suffices that do not tell how far
    /// along them it is.
    Turned,
}

/// A place that was followed.
#[derive(Clone, Copy)]
pub(super) struct Followed {
    pub(super) known: Known,
    /// Which part of the scan is on walls there.
    pub(super) fit: Option<f64>,
}

impl Amcl {
    /// Follows a place where odometry has led to: refined where the scan fits, found again where it
    /// fits nearby, and by odometry alone where it has little to do with the map.
    pub(super) fn followed(
        &mut self,
        seen: &Seen,
        carried: Known,
        way_m: f64,
        way: Way,
    ) -> Followed {
        let Some(map) = &self.map else { return Followed { known: carried, fit: None } };
        let polished = polish(map, &seen.ends, &carried).known;
        let fit = self.fit(polished.pose, &seen.beams);
        self.astray_m += way_m;
        if let Some(found) = self.nearby(seen, &carried, fit, way) {
            return found;
        }
        let is_stray = fit.is_some_and(|fit| fit < STRAY * self.watch.usual());
        Followed { known: if is_stray { carried } else { polished }, fit }
    }

    /// Which part of a scan is on walls at the likeliest place.
    pub(super) fn fit_of_best(&self, estimate: &Estimate, beams: &Beams) -> Option<f64> {
        match (&self.rivals, &self.map) {
            (Some(rivals), Some(map)) => {
                agreement(map, beams, rivals.best().known.pose).map(|it| it.all)
            }
            _ => self.fit(estimate.pose, beams),
        }
    }

    /// Which part of a scan is on walls at a place where the robot came to by odometry.
    pub(super) fn fit(&self, map_from_base: Pose2, beams: &Beams) -> Option<f64> {
        let agreement = agreement(self.map.as_ref()?, beams, map_from_base)?;
        Some(if self.is_near_by() { agreement.judged } else { agreement.all })
    }

    /// Whether scans fitted a moment ago: then the robot may look beyond the edge of the map.
    fn is_near_by(&self) -> bool {
        self.astray_m < TRUSTED_M
    }

    /// Where around a place the scan fits when it does not at the place itself. Odometry has its bad
    /// moments, and drawing a scan to walls leads to the wrong ones then.
    pub(super) fn nearby(
        &mut self,
        seen: &Seen,
        place: &Known,
        fit: Option<f64>,
        way: Way,
    ) -> Option<Followed> {
        let fit = fit.filter(|fit| *fit < ENOUGH * self.watch.usual());
        let Some(fit) = fit else {
            self.astray_m = 0.0;
            return None;
        };
        let least = (ENOUGH * self.watch.usual()).max(CONVINCING.1).max(fit + CLEARLY);
        let is_near = self.is_near_by();
        let map = self.map.as_ref()?;
        let everywhere = self.everywhere.get_or_insert_with(|| Everywhere::new(map));
        let reach = |(least, each, most): (f64, f64, f64)| (least + each * self.astray_m).min(most);
        let reach = (reach(AROUND_M), reach(AROUND_RAD));
        let peaks = everywhere.peaks_near(&seen.ends, place.pose, reach);
        let seen_at = |peak: &Peak| {
            let known = match way {
                Way::Gone => Known { pose: peak.pose, information: loosely(0.3, 0.15) },
                Way::Turned => Known {
                    pose: Pose2 { yaw_rad: peak.pose.yaw_rad, ..place.pose },
                    information: loosely(0.1, 0.15),
                },
            };
            let known = polish(map, &seen.ends, &known).known;
            let agreement = agreement(map, &seen.beams, known.pose)?;
            let fit = if is_near { agreement.judged } else { agreement.all };
            if fit < least {
                return None;
            }
            Some((evidence(map, &seen.beams, known.pose), Followed { known, fit: Some(fit) }))
        };
        let mut found: Vec<(f64, Followed)> = peaks.iter().filter_map(seen_at).collect();
        found.sort_by(|a, b| b.0.total_cmp(&a.0));
        let (most, best) = *found.first()?;
        let rivals = found.iter().filter(|it| !is_same(it.1.known.pose, best.known.pose));
        rivals.into_iter().all(|it| it.0 < most - REFUTED).then_some(best)
    }
}
