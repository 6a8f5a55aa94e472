//! Places where a robot may be, each followed on its own until one is left over.
//!
//! Particles lose places by chance, and with them the right one as easily as a wrong one. Here each
//! place moves with odometry, is refined by every scan, and keeps account of what scans say for it.

use periplus_geometry::{Pose2, normalize_angle};

use crate::bins::Cluster;
use crate::evidence::evidence;
use crate::hunt::Completeness;
use crate::known_map::KnownMap;
use crate::particles::Covariance2;
use crate::polish::{Known, loosely, moved, polish};
use crate::scan::Beams;

/// Places nearer to each other are the same: \[m\], \[rad\].
const SAME: (f64, f64) = (0.4, 0.3);
/// A place so much less likely than the best (as a logarithm) is none any more.
pub(crate) const HOPELESS: f64 = 9.0;
/// More places than this are refined by so many ends of beams.
const MANY: usize = 8;
const FEW: usize = 50;
/// No more places are followed.
const MOST: usize = 120;
/// The best is believed when all others together are less likely than this.
const DOUBT: f64 = 0.01;
/// One place is alone where others are so much less likely (as a logarithm).
const ALONE: f64 = 4.6;
/// After so much way the scans on it are proof \[m\].
pub(crate) const PROVEN_M: f64 = 1.5;
/// After a single scan it has to be less: scans lie together.
const DOUBT_AT_ONCE: f64 = 1e-3;
/// Further on, what scans say is news \[m\].
const NEWS_M: f64 = 0.5;
/// What a scan says, as a logarithm, for a robot that is nowhere on the map: less than for any place
/// where four fifths of it are on walls.
pub(crate) const NOWHERE: f64 = -7.0;
/// Where odometry and the scan say something else, squared and in standard deviations, it counts up to
/// this: wheels have their bad moments.
const MOST_DRAWN: f64 = 4.0;

/// A place where the robot may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    pub(crate) known: Known,
    /// Natural logarithm of how likely all scans since the start are there.
    pub(crate) evidence: f64,
    /// Which part of the last scan is on walls.
    pub(crate) fit: f64,
}

/// All of them, the likeliest first; never empty.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Rivals {
    places: Vec<Place>,
    way_m: f64,
    /// The account of all of them being wrong: the robot may be off the map, or this may be another.
    nowhere: f64,
    /// How much the search has found that they come from.
    completeness: Completeness,
}

impl Rivals {
    /// From where a scan fits; none when there is nothing.
    pub(crate) fn new(
        map: &KnownMap,
        beams: &Beams,
        ends: &[[f32; 2]],
        poses: impl IntoIterator<Item = Pose2>,
        completeness: Completeness,
    ) -> Option<Self> {
        let information = loosely(0.3, 0.15);
        let poses: Vec<Pose2> = poses.into_iter().collect();
        let ends = sparse(ends, poses.len());
        let places: Vec<Place> = poses
            .into_iter()
            .map(|pose| refined(map, beams, &ends, &Known { pose, information }, 0.0))
            .collect();
        let mut rivals = Self { places, way_m: 0.0, nowhere: NOWHERE, completeness };
        rivals.sort();
        (!rivals.places.is_empty()).then_some(rivals)
    }

    /// The robot moved by odometry, and sees.
    pub(crate) fn follow(
        &mut self,
        map: &KnownMap,
        beams: &Beams,
        ends: &[[f32; 2]],
        old_from_new: Pose2,
    ) {
        let way_m = libm::hypot(old_from_new.x_m, old_from_new.y_m);
        self.way_m += way_m;
        let news = news(old_from_new);
        self.nowhere += news * NOWHERE;
        let ends = sparse(ends, self.places.len());
        for place in &mut self.places {
            let known = moved(&place.known, old_from_new);
            let seen = refined(map, beams, &ends, &known, 0.0);
            let drawn = drawn(&known, seen.known.pose).min(MOST_DRAWN);
            let said = seen.evidence - 0.5 * drawn;
            *place = Place { evidence: place.evidence + news * said, ..seen };
        }
        self.sort();
    }

    /// Adds a place that is more likely for other reasons, where the robot came to by odometry; that
    /// may have been off the map.
    pub(crate) fn add(&mut self, place: &Place, more: f64) {
        self.places.push(Place { evidence: place.evidence + more, ..*place });
        self.nowhere += more;
        self.sort();
    }

    /// Keeps some; whether there are any. If there are none, all stay.
    pub(crate) fn keep(&mut self, is_kept: impl Fn(&Place) -> bool) -> bool {
        let kept: Vec<Place> = self.places.iter().filter(|place| is_kept(place)).copied().collect();
        let are_some = !kept.is_empty();
        if are_some {
            self.places = kept;
        }
        are_some
    }

    /// The likeliest first, each once, without those that are hopeless.
    fn sort(&mut self) {
        self.places.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
        let best = self.places.first().map_or(0.0, |best| best.evidence);
        let mut kept: Vec<Place> = Vec::new();
        for place in &self.places {
            let is_hopeless = place.evidence < best - HOPELESS;
            if !is_hopeless && kept.iter().all(|it| !is_same(it.known.pose, place.known.pose)) {
                kept.push(*place);
            }
        }
        self.places = kept;
        self.places.truncate(MOST);
    }

    pub(crate) fn best(&self) -> &Place {
        &self.places[0]
    }

    /// Whether the robot is far more likely at none of them.
    pub(crate) fn are_hopeless(&self) -> bool {
        self.best().evidence < self.nowhere - HOPELESS
    }

    /// Whether a single scan has left over one place, if any.
    pub(crate) fn is_only(&self) -> bool {
        let others: f64 =
            self.places[1..].iter().map(|it| libm::exp(it.evidence - self.best().evidence)).sum();
        self.completeness > Completeness::Part && others < DOUBT_AT_ONCE && self.way_m < NEWS_M
    }

    /// Whether each other place is far less likely than the best.
    pub(crate) fn is_alone(&self) -> bool {
        self.places[1..].iter().all(|it| it.evidence < self.best().evidence - ALONE)
    }

    /// Whether scans on the way since they were found suffice to know that it is the best of them: no
    /// scan from another place would tell more.
    pub(crate) fn is_proven(&self) -> bool {
        self.completeness > Completeness::Part
            && self.way_m >= PROVEN_M
            && self.nowhere < self.best().evidence - HOPELESS
            && self.is_decided()
    }

    /// How much likelier (as a logarithm) the best is than to be nowhere on the map, and on how much way
    /// \[m\]; none where others have not been looked for.
    pub(crate) fn account(&self) -> Option<(f64, f64)> {
        let is_enough = self.completeness > Completeness::Part;
        is_enough.then(|| (self.best().evidence - self.nowhere, self.way_m))
    }

    /// How far the robot has gone since they were found \[m\].
    pub(crate) fn way_m(&self) -> f64 {
        self.way_m
    }

    /// Whether one place is left over.
    pub(crate) fn is_decided(&self) -> bool {
        let doubt = 1.0 - self.weights()[0];
        doubt < if self.way_m < NEWS_M { DOUBT_AT_ONCE } else { DOUBT }
    }

    /// How likely each is, all together one, or less where all may be wrong.
    pub(crate) fn weights(&self) -> Vec<f64> {
        let best = self.places[0].evidence;
        let mut weights: Vec<f64> =
            self.places.iter().map(|it| libm::exp(it.evidence - best)).collect();
        let nowhere = libm::exp(self.nowhere - best);
        let sum = weights.iter().sum::<f64>() + nowhere;
        weights.iter_mut().for_each(|weight| *weight /= sum);
        weights
    }

    /// As clusters of so many particles.
    pub(crate) fn clusters(&self, particles: usize) -> Vec<Cluster> {
        let weights = self.weights();
        let cluster = |(place, &weight): (&Place, &f64)| Cluster {
            weight,
            count: (weight * particles as f64) as usize,
            mean: place.known.pose,
            covariance: place.spread(),
        };
        self.places.iter().zip(&weights).map(cluster).collect()
    }
}

impl Place {
    /// How uncertain the pose is, apart from being a wrong one.
    pub(crate) fn spread(&self) -> Covariance2 {
        let inverse = self.known.information.inverse().unwrap_or_default();
        Covariance2 { xx: inverse.xx, xy: inverse.xy, yy: inverse.yy, yaw: inverse.tt }
    }
}

/// Fewer ends where there are many places: which of them it is does not hang on the last centimetre.
fn sparse(ends: &[[f32; 2]], places: usize) -> Vec<[f32; 2]> {
    let every = if places > MANY { ends.len().div_ceil(FEW).max(1) } else { 1 };
    ends.iter().step_by(every).copied().collect()
}

/// Which part of what a scan says is new after a step: the same scan again says nothing new.
pub(crate) fn news(step: Pose2) -> f64 {
    let way_m = libm::hypot(step.x_m, step.y_m);
    (way_m / NEWS_M + normalize_angle(step.yaw_rad).abs()).min(1.0)
}

/// How far a scan draws a place from where odometry has it, squared, in standard deviations.
fn drawn(carried: &Known, pose: Pose2) -> f64 {
    let off = [
        pose.x_m - carried.pose.x_m,
        pose.y_m - carried.pose.y_m,
        normalize_angle(pose.yaw_rad - carried.pose.yaw_rad),
    ];
    carried.information.quadratic(off)
}

fn refined(map: &KnownMap, beams: &Beams, ends: &[[f32; 2]], known: &Known, before: f64) -> Place {
    let polished = polish(map, ends, known);
    let evidence = before + evidence(map, beams, polished.known.pose);
    Place { known: polished.known, evidence, fit: polished.fit }
}

fn is_same(a: Pose2, b: Pose2) -> bool {
    (a.x_m - b.x_m).abs() < SAME.0
        && (a.y_m - b.y_m).abs() < SAME.0
        && normalize_angle(a.yaw_rad - b.yaw_rad).abs() < SAME.1
}
