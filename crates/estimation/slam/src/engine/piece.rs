//! Pieces of map: when scans suddenly fit nothing that was seen before, the robot was carried, or a part
//! of the log is missing. Then a new piece begins, and only closures join it to the rest.

use periplus_geometry::Pose2;
use periplus_scan_matching::{Cloud, Symmetric3};

use super::{Last, Look, Slam, TURN_WAY_M, Taken, drawn};
use crate::doubts::Doubt;
use crate::graph::{Edge, Kind};
use crate::key::{Key, Track};
use crate::local::apart;
use crate::scan::{Ends, Scan};

/// The robot was set elsewhere: as far away as this from what was before, by way \[m\]. Old scans are
/// then old ones, to be tied to.
const CARRIED_M: f64 = 30.0;
/// After so long a time without scans the robot may be anywhere \[s\].
const GAP_S: f64 = 10.0;
/// Scans that fit worse than usual, and that agree on less than the first part of what both see, are of
/// other places; after such a time, or a jump of odometry, on less than the second.
const STRANGE: f64 = 0.6;
const SURE: f64 = 0.8;
/// Scans that fit nothing for so much way \[m\], and at least so many.
const STRANGE_M: f64 = 1.5;
const STRANGE_SCANS: usize = 4;

/// Scans in a row that fit nothing.
#[derive(Clone, Debug, Default)]
pub(super) struct Strange {
    scans: usize,
    way_m: f64,
}

crate::session::packed!(Strange { scans, way_m });

impl Slam {
    /// Whether a scan is of another place than those before: where the robot is now is not known.
    pub(super) fn is_carried(&mut self, look: &Look, seconds: f64, jumped: bool) -> bool {
        if look.is_blank || !self.settings.closes_loops {
            return false;
        }
        let is_interrupted = jumped || seconds > GAP_S;
        if is_interrupted && look.agreeing < SURE {
            return true;
        }
        if look.agreeing > STRANGE {
            self.strange = Strange::default();
            return false;
        }
        let (metres, radians) = apart(look.motion, Pose2::IDENTITY);
        self.strange.scans += 1;
        self.strange.way_m += metres + TURN_WAY_M * radians;
        self.strange.scans >= STRANGE_SCANS && self.strange.way_m > STRANGE_M
    }

    /// Begins a piece of map with a scan, where odometry has it.
    pub(super) fn begin_piece(
        &mut self,
        scan: &Scan,
        odom_from_base: Option<Pose2>,
        look: &Look,
    ) -> Taken {
        let Some(last) = &self.last else { return Taken::Lost };
        self.strange = Strange::default();
        let key_from_base = (last.key_from_base * look.motion).normalized();
        let before = last.key;
        let pose = (self.graph.poses[before] * key_from_base).normalized();
        let new = self.set_down((scan.time_ns, odom_from_base), (&look.cloud, &look.ends), pose);
        self.graph.add_edge(Edge::gap((before, new), key_from_base));
        self.piece = new;
        self.doubts.remark(scan.time_ns, Doubt::Carried);
        Taken::Kept
    }

    /// Keeps a scan at a place that the robot did not drive to, and goes on from there; gives its key.
    pub(super) fn set_down(
        &mut self,
        (time_ns, odom_from_base): (i64, Option<Pose2>),
        (cloud, ends): (&Cloud, &Ends),
        map_from_base: Pose2,
    ) -> usize {
        let new = self.graph.add_pose(map_from_base);
        let travel_m = self.keys[self.keys.len() - 1].travel_m + CARRIED_M;
        self.keys.push(Key::new(cloud, drawn(ends, &self.settings), travel_m));
        self.doubts.begin(odom_from_base);
        self.loops.restart(new, travel_m);
        let here = Pose2::IDENTITY;
        self.tracks.push(Track { time_ns, key: new, key_from_base: here });
        self.last = Some(Last {
            time_ns,
            odom_from_base,
            key: new,
            key_from_base: here,
            motion: None,
            covariance: Symmetric3::ZERO,
        });
        new
    }

    /// First scans of all pieces that no closure joins to those before.
    pub(super) fn unjoined(&self) -> Vec<usize> {
        let edges = &self.graph.edges;
        let starts = edges.iter().filter(|edge| edge.is_gap()).map(|edge| edge.to);
        let is_across = |start: usize| {
            move |edge: &Edge| {
                let joins = edge.kind != Kind::Chain && edge.weight > 0.5;
                joins && edge.from.min(edge.to) < start && edge.from.max(edge.to) >= start
            }
        };
        starts.filter(|&start| !edges.iter().any(is_across(start))).collect()
    }

    /// Moves the pieces that new closures join to where they say, all that came after with them: bending
    /// would not find so far.
    pub(super) fn lay_pieces(&mut self, closures: &[Edge]) {
        let starts = self.unjoined();
        for edge in closures {
            let (old, new) = (edge.from.min(edge.to), edge.from.max(edge.to));
            let Some(&start) = starts.iter().rfind(|&&start| old < start && start <= new) else {
                continue;
            };
            let poses = &mut self.graph.poses;
            let place = if edge.from < edge.to {
                poses[edge.from] * edge.from_from_to
            } else {
                poses[edge.to] * edge.from_from_to.inverse()
            };
            let to_there = (place * poses[new].inverse()).normalized();
            for pose in &mut poses[start..] {
                *pose = (to_there * *pose).normalized();
            }
            return;
        }
    }
}
