//! The engine in a session.

use periplus_geometry::Pose2;
use periplus_scan_matching::Symmetric3;

use super::component::UnmatchedRun;
use super::live_audit::LiveAudit;
use super::work::Work;
use super::{Counts, Last, Slam};
use crate::graph::{Edge, Graph};
use crate::keyframe::{Keyframe, TrajectoryNode};
use crate::loops::Loops;
use crate::odometry_diagnostics::OdometryDiagnostics;
use crate::odometry_monitor::OdometryMonitor;
use crate::odometry_noise::OdometryNoise;
use crate::session::{Bytes, Pack, Reader, SessionError, packed, whole};
use crate::settings::Settings;

packed!(Counts { scans, kept, lost, ignored, proximity, searches, slices });
packed!(Last { time_ns, odom_from_base, keyframe, keyframe_from_base, motion, covariance });

/// The section `LAST`.
type Rest = (
    Option<Last>,
    (f64, (Counts, (Option<(Pose2, Symmetric3)>, (OdometryMonitor, (UnmatchedRun, usize))))),
);

impl Slam {
    /// All sections by name, in order.
    pub(crate) fn write_sections(&self) -> Vec<([u8; 4], Bytes)> {
        let Self {
            settings: _,
            keyframes,
            nodes,
            graph,
            odometry_noise,
            last,
            loops,
            work,
            counts,
            inlier_ratio,
            start,
            odometry_monitor,
            unmatched,
            component,
            // Remarks are not part of the map: a continued run starts without them.
            diagnostics: _,
            live_audit: _,
            is_finished: _,
        } = self;
        let Graph { poses, edges, at: _ } = graph;
        let mut rest = Bytes::default();
        last.pack(&mut rest);
        inlier_ratio.pack(&mut rest);
        counts.pack(&mut rest);
        start.pack(&mut rest);
        odometry_monitor.pack(&mut rest);
        unmatched.pack(&mut rest);
        component.pack(&mut rest);
        vec![
            (*b"KEYS", Bytes::of(keyframes)),
            (*b"POSE", Bytes::of(poses)),
            (*b"EDGE", Bytes::of(edges)),
            (*b"TRAK", Bytes::of(nodes)),
            (*b"ODOM", Bytes::of(odometry_noise)),
            (*b"LAST", rest),
            (*b"LOOP", Bytes::of(loops)),
            (*b"WORK", Bytes::of(work)),
        ]
    }

    /// From sections by name.
    pub(crate) fn read_sections<'a>(
        section: &dyn Fn(&[u8; 4]) -> Result<Reader<'a>, SessionError>,
        settings: Settings,
    ) -> Result<Self, SessionError> {
        let keyframes: Vec<Keyframe> = whole(section(b"KEYS")?)?;
        let mut graph = Graph::default();
        for pose in whole::<Vec<_>>(section(b"POSE")?)? {
            graph.add_pose(pose);
        }
        let misfit = |name: &[u8; 4], reason: &str| {
            let offset = section(name).map_or(0, |it| it.at());
            let reason = format!("{reason}; the parts of the session do not fit together");
            Err(SessionError { offset, reason })
        };
        if keyframes.len() != graph.poses.len() {
            return misfit(b"POSE", "there are more scans than poses, or fewer");
        }
        if !keyframes.windows(2).all(|pair| pair[0].travel_m <= pair[1].travel_m) {
            return misfit(b"KEYS", "the path length decreases");
        }
        let edges: Vec<Edge> = whole(section(b"EDGE")?)?;
        if !edges.iter().all(|edge| edge.from.max(edge.to) < keyframes.len()) {
            return misfit(b"EDGE", "an edge refers to a missing keyframe");
        }
        edges.into_iter().for_each(|edge| {
            graph.add_edge(edge);
        });
        let nodes: Vec<TrajectoryNode> = whole(section(b"TRAK")?)?;
        if !nodes.iter().all(|node| node.keyframe < keyframes.len()) {
            return misfit(b"TRAK", "a pose refers to a missing keyframe");
        }
        let odometry_noise: OdometryNoise = whole(section(b"ODOM")?)?;
        let (last, (inlier_ratio, (counts, (start, (odometry_monitor, (unmatched, component)))))): Rest =
            whole(section(b"LAST")?)?;
        if component >= keyframes.len().max(1) {
            return misfit(b"LAST", "a map component begins with a scan that is not there");
        }
        let is_last = match &last {
            Some(last) => last.keyframe < keyframes.len(),
            None => keyframes.is_empty(),
        };
        if !is_last || !(0.0..=1.0).contains(&inlier_ratio) {
            return misfit(b"LAST", "the last scan refers to a missing keyframe");
        }
        let loops: Loops = whole(section(b"LOOP")?)?;
        if !loops.fits(keyframes.len()) {
            return misfit(b"LOOP", "a loop refers to a missing keyframe");
        }
        let work: Work = whole(section(b"WORK")?)?;
        if !work.fits(&graph) {
            return misfit(b"WORK", "queued work refers to a missing keyframe");
        }
        let diagnostics = OdometryDiagnostics::default();
        let live_audit = LiveAudit::default();
        Ok(Self {
            settings,
            keyframes,
            nodes,
            graph,
            odometry_noise,
            last,
            loops,
            work,
            counts,
            inlier_ratio,
            start,
            odometry_monitor,
            unmatched,
            component,
            diagnostics,
            live_audit,
            is_finished: false,
        })
    }
}
