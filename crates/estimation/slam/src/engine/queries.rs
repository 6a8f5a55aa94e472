//! State of the map: trajectory, constraints, remarks, counters.

use periplus_geometry::Pose2;
use periplus_grid::OccupancyGrid;
use periplus_scan_matching::{Cloud, Symmetric3};

use super::{ConstraintResidual, Counts, ROTATION_ARM_M, Slam};
use crate::graph::{ConstraintKind, Edge, Graph};
use crate::keyframe::{Keyframe, TrajectoryNode};
use crate::local::apart;
use crate::loops::Closure;
use crate::map::MapSnapshot;
use crate::memory::on_64_bits;
use crate::remark::Remark;
use crate::settings::Settings;

impl Slam {
    /// Pose of the robot at the last scan.
    #[must_use]
    pub fn map_from_base(&self) -> Pose2 {
        self.last.as_ref().map_or(Pose2::IDENTITY, |last| {
            (self.graph.poses[last.keyframe] * last.keyframe_from_base).normalized()
        })
    }

    /// Stamp of a keyframe \[ns\].
    pub(super) fn time_of(&self, keyframe: usize) -> Option<i64> {
        let first = self.nodes.partition_point(|node| node.keyframe < keyframe);
        self.nodes.get(first).map(|node| node.time_ns)
    }

    /// Returns the pose of the robot at each scan, with its stamp \[ns\], in the order of arrival.
    #[must_use]
    pub fn trajectory(&self) -> Vec<(i64, Pose2)> {
        self.nodes.iter().map(|node| (node.time_ns, self.pose_of(node))).collect()
    }

    /// Pose of a scan that need not be a keyframe.
    ///
    /// The scan was matched relative to the keyframe before it. The correction that optimization has since
    /// given to the step between that keyframe and the next is distributed along the path in proportion to
    /// its length, so that a scan just before the next keyframe moves with that one.
    pub(crate) fn pose_of(&self, node: &TrajectoryNode) -> Pose2 {
        let pose = |keyframe_from_base: Pose2| {
            (self.graph.poses[node.keyframe] * keyframe_from_base).normalized()
        };
        let next = node.keyframe + 1;
        let edges = self.graph.at.get(next).into_iter().flatten();
        let step = edges.map(|&edge| &self.graph.edges[edge as usize]).find(|edge| {
            edge.kind == ConstraintKind::Sequential && edge.from == node.keyframe && edge.to == next
        });
        let Some(step) = step else { return pose(node.keyframe_from_base) };
        let path_m = |pose: Pose2| {
            let (distance_m, rotation_rad) = apart(pose, Pose2::IDENTITY);
            distance_m + ROTATION_ARM_M * rotation_rad
        };
        let (done_m, whole_m) = (path_m(node.keyframe_from_base), path_m(step.from_from_to));
        let part = if whole_m > 0.0 { (done_m / whole_m).min(1.0) } else { 0.0 };
        let [x_m, y_m, yaw_rad] = step.error(&self.graph.poses);
        let here = node.keyframe_from_base;
        // The error is a shift along the axes of the keyframe before and a rotation about the one after.
        let turn = part * yaw_rad;
        pose(Pose2::new(here.x_m + part * x_m, here.y_m + part * y_m, here.yaw_rad + turn))
    }

    /// Last scan relative to its keyframe; [`Slam::pose_of`] gives its pose at any later time.
    pub(crate) fn newest(&self) -> Option<TrajectoryNode> {
        let last = self.last.as_ref()?;
        Some(TrajectoryNode {
            time_ns: last.time_ns,
            keyframe: last.keyframe,
            keyframe_from_base: last.keyframe_from_base,
        })
    }

    /// Covariance of the motion from a scan to the newest one, along the axes of the former, by the sequential
    /// constraints between them. `None` if the chain is interrupted or longer than 64 keyframes.
    pub(crate) fn covariance_since(&self, from: &TrajectoryNode) -> Option<Symmetric3> {
        const MAX_KEYFRAMES: usize = 64;
        let last = self.last.as_ref()?;
        if last.keyframe < from.keyframe || last.keyframe - from.keyframe > MAX_KEYFRAMES {
            return None;
        }
        let mut motion = Pose2::IDENTITY;
        let mut sum = Symmetric3::ZERO;
        for next in from.keyframe + 1..=last.keyframe {
            let edges = self.graph.at[next].iter().map(|&edge| &self.graph.edges[edge as usize]);
            let step = edges.into_iter().find(|edge| {
                edge.kind == ConstraintKind::Sequential && edge.from + 1 == next && edge.to == next
            })?;
            let covariance = step.information.inverse()?;
            sum = sum.compounded(motion, step.from_from_to, &covariance);
            motion = motion * step.from_from_to;
        }
        if last.keyframe_from_base != Pose2::IDENTITY {
            sum = sum.compounded(motion, last.keyframe_from_base, &last.covariance.turned(0.0));
        }
        Some(sum.turned(-from.keyframe_from_base.yaw_rad))
    }

    /// Indices into [`Slam::trajectory`] of the keyframes; closures refer to keyframes by their index here.
    #[must_use]
    pub fn kept(&self) -> Vec<usize> {
        let mut kept = Vec::with_capacity(self.keyframes.len());
        for (index, node) in self.nodes.iter().enumerate() {
            if node.keyframe == kept.len() {
                kept.push(index);
            }
        }
        kept
    }

    /// Returns the current map; `None` if it would be too large.
    #[must_use]
    pub fn map(&self) -> Option<OccupancyGrid> {
        self.snapshot().draw()
    }

    /// Returns a snapshot from which the current map can be rasterized on another thread.
    #[must_use]
    pub fn snapshot(&self) -> MapSnapshot {
        MapSnapshot::new(&self.keyframes, &self.graph.poses, self.settings.resolution_m)
    }

    /// Covariance of the last pose relative to the surrounding scans, along the axes of the map \[m, rad\].
    #[must_use]
    pub fn covariance(&self) -> Symmetric3 {
        self.last.as_ref().map_or(Symmetric3::ZERO, |last| {
            last.covariance.turned(self.graph.poses[last.keyframe].yaw_rad)
        })
    }

    /// Poses of the keyframes in the map.
    #[must_use]
    pub fn poses(&self) -> &[Pose2] {
        &self.graph.poses
    }

    /// Constraints between keyframes in the graph: from, to, origin.
    pub fn links(&self) -> impl Iterator<Item = (usize, usize, ConstraintKind)> {
        let counts = |edge: &&Edge| edge.weight > 0.0;
        self.graph.edges.iter().filter(counts).map(|edge| (edge.from, edge.to, edge.kind))
    }

    /// Constraints in the graph with their residuals.
    pub fn edges(&self) -> impl Iterator<Item = ConstraintResidual> {
        self.links().zip(self.graph.edges.iter().filter(|edge| edge.weight > 0.0)).map(
            |((from, to, link), edge)| {
                let [x_m, y_m, yaw_rad] = edge.error(&self.graph.poses);
                let (residual_m, residual_rad) = (libm::hypot(x_m, y_m), yaw_rad.abs());
                ConstraintResidual { keyframes: (from, to), link, residual_m, residual_rad }
            },
        )
    }

    /// Revision of the map: increases whenever poses of earlier keyframes change.
    #[must_use]
    pub fn map_revision(&self) -> usize {
        self.work.map_revision
    }

    /// Loop closure candidates that passed the search, accepted or rejected, with the reason.
    #[must_use]
    pub fn closures(&self) -> &[Closure] {
        &self.loops.closures
    }

    pub(crate) fn settings(&self) -> &Settings {
        &self.settings
    }

    pub(crate) fn cloud(&self, keyframe: usize) -> Cloud {
        self.keyframes[keyframe].cloud()
    }

    pub(crate) fn graph(&self) -> &Graph {
        &self.graph
    }

    /// Warnings and notices in the order of detection. The list only grows.
    #[must_use]
    pub fn remarks(&self) -> &[Remark] {
        &self.diagnostics.remarks
    }

    /// Counters of the run.
    #[must_use]
    pub fn counts(&self) -> Counts {
        Counts {
            slices: self.work.slices,
            proximity: self.work.proximity_count,
            searches: self.work.searches,
            ..self.counts
        }
    }

    /// Drops the scans before the last `kept` keyframes and the trajectory, and stops loop closure: for use as
    /// scan-matching odometry.
    pub(crate) fn forget(&mut self, kept: usize) {
        let old = self.keyframes.len().saturating_sub(kept);
        let nothing = Cloud::new([], [0.0; 2], 0.0, &self.settings.cloud);
        let is_known = |keyframe: &&mut Keyframe| !keyframe.cloud.places().is_empty();
        for keyframe in self.keyframes[..old].iter_mut().rev().take_while(is_known) {
            *keyframe = Keyframe::new(&nothing, None, keyframe.travel_m);
        }
        self.work.proximity.clear();
        self.nodes.clear();
        self.settings.closes_loops = false;
    }

    /// Approximate memory in use \[bytes\].
    #[must_use]
    pub fn size(&self) -> usize {
        let keyframes: usize = self.keyframes.iter().map(Keyframe::size).sum();
        keyframes
            + self.graph.edges.len() * (on_64_bits::<Edge>(200) + 8)
            + self.nodes.len() * on_64_bits::<TrajectoryNode>(40)
            + self.loops.size()
    }
}
