//! Whether the robot knows where it is.

use std::f64::consts::FRAC_PI_6;

use periplus_geometry::normalize_angle;

use crate::bins::Cluster;
use crate::recovery::Recovery;

/// Whether the robot knows where it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// Nobody has said where it is, or no scan was used since.
    Unset,
    /// It knows.
    Tracking,
    /// It may be in several places, or anywhere in a large one.
    Ambiguous,
    /// Scans do not fit to where it seems to be.
    Lost,
}

/// Whether the robot knows where it is, and why so.
#[derive(Clone, Debug, PartialEq)]
pub struct Status {
    /// In a word.
    pub state: State,
    /// Why, in a sentence.
    pub reason: String,
    /// Other places where it may be, the likeliest first.
    pub rivals: Vec<Cluster>,
    /// Which part of the last scan is on walls of the map, 0 to 1; none when nothing was seen.
    pub fit: Option<f64>,
}

impl Default for Status {
    fn default() -> Self {
        Self {
            state: State::Unset,
            reason: "nobody has said where the robot is".into(),
            rivals: Vec::new(),
            fit: None,
        }
    }
}

/// Clusters that count less are no rivals.
const LEAST_RIVAL: f64 = 0.1;
/// More rivals are not told.
const MOST_RIVALS: usize = 20;
/// Clusters nearer to the best are the same place \[m\], \[rad\].
const SAME_PLACE: (f64, f64) = (1.0, FRAC_PI_6);
/// A spread that is no place any more: one standard deviation \[m\], \[rad\].
const LARGE_SPREAD: (f64, f64) = (1.0, FRAC_PI_6);
/// With a smaller part of scans on walls the robot is lost: half may be people and furniture.
const LEAST_FIT: f64 = 0.35;
/// So much less than it used to be, and it may be worth a look elsewhere.
const SUSPECT: f64 = 0.85;
/// So much less than it used to be is a sudden misfit.
const SUDDEN: f64 = 0.6;
/// So much less than it used to be is not usual: at least, as a share, and in mean deviations.
const UNUSUAL: (f64, f64) = (0.12, 4.0);
/// Memories of how well scans fit, long and short.
const MEMORY: [f64; 2] = [0.02, 0.4];

/// Watches how well scans fit.
#[derive(Clone, Debug, Default)]
pub(crate) struct Watch {
    fits: Recovery,
    /// How far scans fit better or worse than usual, in the mean.
    deviation: f64,
    /// Whether the robot was not sure after the last scan: then nothing is learned of what is usual.
    is_unsure: bool,
    /// Whether it ever was.
    was_sure: bool,
}

impl Watch {
    /// Whether a scan fits so much worse than others did that the robot may be elsewhere.
    pub(crate) fn suspects(&self, fit: Option<f64>) -> bool {
        fit.is_some_and(|fit| fit.min(self.fits.fast) < SUSPECT * self.fits.slow)
    }

    /// How sure it is, by where particles are and which part of the scan is on walls; undecided when
    /// there are several places and none is to be believed yet.
    pub(crate) fn judge(
        &mut self,
        clusters: &[Cluster],
        fit: Option<f64>,
        is_undecided: bool,
    ) -> Status {
        if let Some(fit) = fit {
            let [slow, fast] = MEMORY;
            let slow = if self.is_unsure { 0.0 } else { slow };
            self.fits.take(fit, [slow, fast]);
            self.deviation += slow * ((fit - self.fits.slow).abs() - self.deviation);
        }
        let Recovery { slow, fast } = self.fits;
        let Some(best) = clusters.first() else { return Status::default() };
        let rivals: Vec<Cluster> = clusters[1..]
            .iter()
            .filter(|it| is_undecided || is_rival(it, best))
            .take(MOST_RIVALS)
            .copied()
            .collect();
        let (state, reason) = if fit.is_some() && fast < LEAST_FIT {
            (
                State::Lost,
                format!("only {:.0} % of the scans are on walls of the map", 100.0 * fast),
            )
        } else if fit.is_some() && fast < SUDDEN * slow {
            let (fast, slow) = (100.0 * fast, 100.0 * slow);
            let words = format!(
                "scans fit much worse than before: {fast:.0} % are on walls of the map, \
                 {slow:.0} % used to be; the robot may have been carried away"
            );
            (State::Lost, words)
        } else if let Some(rival) = rivals.first() {
            let words = format!(
                "{} places are possible: ({:.2}, {:.2}) by {:.0} %, ({:.2}, {:.2}) by {:.0} %",
                rivals.len() + 1,
                best.mean.x_m,
                best.mean.y_m,
                100.0 * best.weight,
                rival.mean.x_m,
                rival.mean.y_m,
                100.0 * rival.weight,
            );
            (State::Ambiguous, words)
        } else if is_undecided {
            (State::Ambiguous, "one place is likely, but too little has been seen yet".into())
        } else {
            let (radius_m, turn_rad) =
                (best.covariance.radius_m(), libm::sqrt(best.covariance.yaw));
            if radius_m > LARGE_SPREAD.0 || turn_rad > LARGE_SPREAD.1 {
                let degrees = turn_rad.to_degrees();
                let words =
                    format!("the place is known to {radius_m:.1} m and {degrees:.0} degrees");
                (State::Ambiguous, words)
            } else if fit.is_none() {
                (State::Tracking, "by odometry alone: no beam of the scan hit anything".into())
            } else {
                let words = format!("{:.0} % of the scans are on walls of the map", 100.0 * fast);
                (State::Tracking, words)
            }
        };
        self.is_unsure = state != State::Tracking;
        self.was_sure |= !self.is_unsure;
        Status { state, reason, rivals, fit }
    }

    /// Whether the robot ever knew where it was.
    pub(crate) fn was_sure(&self) -> bool {
        self.was_sure
    }

    /// Which part of scans is usually on walls; 0 before the first.
    pub(crate) fn usual(&self) -> f64 {
        self.fits.slow
    }

    /// With a smaller part of a scan on walls than this it is unlike scans before.
    pub(crate) fn least_usual(&self) -> f64 {
        let (share, deviations) = UNUSUAL;
        self.fits.slow - (share * self.fits.slow).max(deviations * self.deviation)
    }

    /// The robot is elsewhere; what was bad a moment ago counts no longer.
    pub(crate) fn forgive(&mut self) {
        self.fits.fast = self.fits.slow;
    }
}

fn is_rival(other: &Cluster, best: &Cluster) -> bool {
    let (dx, dy) = (other.mean.x_m - best.mean.x_m, other.mean.y_m - best.mean.y_m);
    let turn = normalize_angle(other.mean.yaw_rad - best.mean.yaw_rad).abs();
    let is_elsewhere = libm::hypot(dx, dy) > SAME_PLACE.0 || turn > SAME_PLACE.1;
    other.weight >= LEAST_RIVAL && is_elsewhere
}

#[cfg(test)]
mod tests {
    use periplus_geometry::Pose2;

    use super::*;
    use crate::particles::Covariance2;

    fn at(x_m: f64, weight: f64) -> Cluster {
        let mean = Pose2::new(x_m, 0.0, 0.0);
        Cluster { weight, count: 10, mean, covariance: Covariance2::default() }
    }

    #[test]
    fn states_are_told_apart() {
        let state = |clusters: &[Cluster], fit| Watch::default().judge(clusters, fit, false).state;
        assert_eq!(state(&[], Some(1.0)), State::Unset);
        assert_eq!(state(&[at(0.0, 1.0)], Some(0.8)), State::Tracking);
        assert_eq!(state(&[at(0.0, 1.0)], Some(0.2)), State::Lost);
        assert_eq!(state(&[at(0.0, 1.0)], None), State::Tracking);
        assert_eq!(state(&[at(0.0, 0.7), at(5.0, 0.3)], Some(0.8)), State::Ambiguous);
        assert_eq!(state(&[at(0.0, 0.95), at(5.0, 0.05)], Some(0.8)), State::Tracking);
        assert_eq!(state(&[at(0.0, 0.7), at(0.6, 0.3)], Some(0.8)), State::Tracking);
        let undecided = |clusters: &[Cluster]| Watch::default().judge(clusters, Some(0.8), true);
        assert_eq!(undecided(&[at(0.0, 1.0)]).state, State::Ambiguous);
        assert_eq!(undecided(&[at(0.0, 0.95), at(5.0, 0.05)]).rivals.len(), 1);
    }

    #[test]
    fn a_robot_that_is_carried_away_is_lost() {
        let mut watch = Watch::default();
        for _ in 0..20 {
            assert_eq!(watch.judge(&[at(0.0, 1.0)], Some(0.95), false).state, State::Tracking);
        }
        let states: Vec<State> =
            (0..5).map(|_| watch.judge(&[at(0.0, 1.0)], Some(0.45), false).state).collect();
        assert_eq!(states.last(), Some(&State::Lost));
    }

    #[test]
    fn a_scan_is_unlike_others_where_they_agree_with_each_other() {
        let least_of = |fits: &[f64]| {
            let mut watch = Watch::default();
            for number in 0..100 {
                watch.judge(&[at(0.0, 1.0)], Some(fits[number % fits.len()]), false);
            }
            watch.least_usual()
        };
        let steady = least_of(&[0.94, 0.96]);
        assert!(steady > 0.8 && steady < 0.86, "{steady}");
        let unsteady = least_of(&[0.95, 0.65]);
        assert!(unsteady < 0.5, "{unsteady}");
    }
}
