//! Poses and what is known between them.

mod cholesky;
mod order;
mod pose_clusters;
mod solve;
mod system;

use periplus_geometry::{Pose2, normalize_angle};
use periplus_scan_matching::Symmetric3;

use crate::drift::reversed;

pub(crate) use pose_clusters::pose_clusters;
pub(crate) use solve::{Outcome, Saved, Size, Solver};
pub(crate) use system::System;

/// Origin of a constraint between two keyframes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConstraintKind {
    /// Between consecutive keyframes, by scan matching and odometry.
    Sequential,
    /// Between keyframes whose relative pose was known well enough to match their scans directly.
    Proximity,
    /// A loop closure found by search.
    LoopClosure,
}

/// A constraint between two poses.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge {
    pub(crate) from: usize,
    pub(crate) to: usize,
    pub(crate) from_from_to: Pose2,
    /// Errors are a shift along the axes of `from` and a turn.
    pub(crate) information: Symmetric3,
    /// Its inverse, and that for `to_from_from`.
    pub(crate) covariances: [Symmetric3; 2],
    pub(crate) kind: ConstraintKind,
    /// 1 when it counts, 0 when it does not.
    pub(crate) weight: f64,
}

/// Information of a step of which nothing is known.
const GAP_INFORMATION_FACTOR: f64 = 1e-4;

impl Edge {
    pub(crate) fn new(
        (from, to): (usize, usize),
        from_from_to: Pose2,
        information: Symmetric3,
        kind: ConstraintKind,
    ) -> Self {
        // What is known to nothing is uncertain without bound, in numbers that can be computed with.
        let covariance = information.inverse().unwrap_or(Symmetric3::diagonal(1e6, 1e6, 1e6));
        let covariances = [covariance, reversed(&covariance, from_from_to)];
        Self { from, to, from_from_to, information, covariances, kind, weight: 1.0 }
    }

    /// A step of which nothing is known: a separate component begins after it.
    pub(crate) fn gap((from, to): (usize, usize), from_from_to: Pose2) -> Self {
        let nothing = Symmetric3::diagonal(
            GAP_INFORMATION_FACTOR,
            GAP_INFORMATION_FACTOR,
            GAP_INFORMATION_FACTOR,
        );
        Self::new((from, to), from_from_to, nothing, ConstraintKind::Sequential)
    }

    /// True if it constrains nothing: a new map component begins after it.
    pub(crate) fn is_gap(&self) -> bool {
        self.kind == ConstraintKind::Sequential && self.information.xx <= GAP_INFORMATION_FACTOR
    }

    /// The same, with another information for questions of uncertainty.
    pub(crate) fn doubting(self, information: &Symmetric3) -> Self {
        let covariances =
            Self::new((self.from, self.to), self.from_from_to, *information, self.kind);
        Self { covariances: covariances.covariances, ..self }
    }

    /// Residual: translation and rotation between the constrained and the present relative pose.
    pub(crate) fn error(&self, poses: &[Pose2]) -> [f64; 3] {
        error(poses, (self.from, self.to), self.from_from_to)
    }

    /// Squared Mahalanobis distance of the error.
    pub(crate) fn chi2(&self, poses: &[Pose2]) -> f64 {
        self.information.quadratic(self.error(poses))
    }
}

/// Shift and turn by which two poses differ from what is known between them.
pub(crate) fn error(poses: &[Pose2], (from, to): (usize, usize), known: Pose2) -> [f64; 3] {
    let found = poses[from].inverse() * poses[to];
    let turn = normalize_angle(found.yaw_rad - known.yaw_rad);
    [found.x_m - known.x_m, found.y_m - known.y_m, turn]
}

/// Poses of key scans in the map and what is known between them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Graph {
    /// `map_from_keyframe`.
    pub(crate) poses: Vec<Pose2>,
    pub(crate) edges: Vec<Edge>,
    /// For each pose the edges at it.
    pub(crate) at: Vec<Vec<u32>>,
}

impl Graph {
    pub(crate) fn add_pose(&mut self, map_from_keyframe: Pose2) -> usize {
        self.poses.push(map_from_keyframe);
        self.at.push(Vec::new());
        self.poses.len() - 1
    }

    pub(crate) fn add_edge(&mut self, edge: Edge) -> usize {
        let index = self.edges.len();
        self.at[edge.from].push(index as u32);
        self.at[edge.to].push(index as u32);
        self.edges.push(edge);
        index
    }

    /// True if a proximity constraint or a loop closure connects a pose to older ones.
    pub(crate) fn is_held(&self, keyframe: usize) -> bool {
        self.at[keyframe].iter().any(|&edge| {
            let edge = &self.edges[edge as usize];
            edge.kind != ConstraintKind::Sequential && edge.to == keyframe && edge.weight > 0.5
        })
    }

    /// Recomputes poses from `from` on along their sequential constraints.
    pub(crate) fn hang(&mut self, from: usize) {
        for keyframe in from..self.poses.len() {
            let chain = self.at[keyframe]
                .iter()
                .map(|&edge| self.edges[edge as usize])
                .find(|edge| edge.kind == ConstraintKind::Sequential && edge.to == keyframe);
            if let Some(edge) = chain {
                self.poses[keyframe] = (self.poses[edge.from] * edge.from_from_to).normalized();
            }
        }
    }

    /// `a_from_b` of two poses.
    pub(crate) fn between(&self, a: usize, b: usize) -> Pose2 {
        let pose = self.poses[a].inverse() * self.poses[b];
        pose.normalized()
    }
}
