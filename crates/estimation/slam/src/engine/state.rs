//! The engine in a session.

use periplus_geometry::Pose2;
use periplus_scan_matching::Symmetric3;

use super::live_audit::LiveAudit;
use super::piece::Strange;
use super::work::Work;
use super::{Counts, Last, Slam};
use crate::doubts::Doubts;
use crate::graph::{Edge, Graph};
use crate::key::{Key, Track};
use crate::loops::Loops;
use crate::odometry::Trust;
use crate::session::{Bytes, Pack, Reader, SessionError, packed, whole};
use crate::settings::Settings;
use crate::wheels::Wheels;

packed!(Counts { scans, kept, lost, ignored, ties, searches, slices });
packed!(Last { time_ns, odom_from_base, key, key_from_base, motion, covariance });

/// The section `LAST`.
type Rest =
    (Option<Last>, (f64, (Counts, (Option<(Pose2, Symmetric3)>, (Wheels, (Strange, usize))))));

impl Slam {
    /// All sections by name, in order.
    pub(crate) fn write_sections(&self) -> Vec<([u8; 4], Bytes)> {
        let Self {
            settings: _,
            keys,
            tracks,
            graph,
            trust,
            last,
            loops,
            work,
            counts,
            usual,
            start,
            wheels,
            strange,
            piece,
            // What was noticed is no part of the map: who goes on begins with an open mind.
            doubts: _,
            live_audit: _,
            is_finished: _,
        } = self;
        let Graph { poses, edges, at: _ } = graph;
        let mut rest = Bytes::default();
        last.pack(&mut rest);
        usual.pack(&mut rest);
        counts.pack(&mut rest);
        start.pack(&mut rest);
        wheels.pack(&mut rest);
        strange.pack(&mut rest);
        piece.pack(&mut rest);
        vec![
            (*b"KEYS", Bytes::of(keys)),
            (*b"POSE", Bytes::of(poses)),
            (*b"EDGE", Bytes::of(edges)),
            (*b"TRAK", Bytes::of(tracks)),
            (*b"ODOM", Bytes::of(trust)),
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
        let keys: Vec<Key> = whole(section(b"KEYS")?)?;
        let mut graph = Graph::default();
        for pose in whole::<Vec<_>>(section(b"POSE")?)? {
            graph.add_pose(pose);
        }
        let misfit = |name: &[u8; 4], reason: &str| {
            let offset = section(name).map_or(0, |it| it.at());
            let reason = format!("{reason}; the parts of the session do not fit together");
            Err(SessionError { offset, reason })
        };
        if keys.len() != graph.poses.len() {
            return misfit(b"POSE", "there are more scans than poses, or fewer");
        }
        if !keys.windows(2).all(|pair| pair[0].travel_m <= pair[1].travel_m) {
            return misfit(b"KEYS", "the way grows shorter");
        }
        let edges: Vec<Edge> = whole(section(b"EDGE")?)?;
        if !edges.iter().all(|edge| edge.from.max(edge.to) < keys.len()) {
            return misfit(b"EDGE", "an edge leads to a scan that is not there");
        }
        edges.into_iter().for_each(|edge| {
            graph.add_edge(edge);
        });
        let tracks: Vec<Track> = whole(section(b"TRAK")?)?;
        if !tracks.iter().all(|track| track.key < keys.len()) {
            return misfit(b"TRAK", "a pose hangs on a scan that is not there");
        }
        let trust: Trust = whole(section(b"ODOM")?)?;
        let (last, (usual, (counts, (start, (wheels, (strange, piece)))))): Rest =
            whole(section(b"LAST")?)?;
        if piece >= keys.len().max(1) {
            return misfit(b"LAST", "a piece of map begins with a scan that is not there");
        }
        let is_last = match &last {
            Some(last) => last.key < keys.len(),
            None => keys.is_empty(),
        };
        if !is_last || !(0.0..=1.0).contains(&usual) {
            return misfit(b"LAST", "the last scan hangs on one that is not there");
        }
        let loops: Loops = whole(section(b"LOOP")?)?;
        if !loops.fits(keys.len()) {
            return misfit(b"LOOP", "a loop is about a scan that is not there");
        }
        let work: Work = whole(section(b"WORK")?)?;
        if !work.fits(&graph) {
            return misfit(b"WORK", "work is waiting for a scan that is not there");
        }
        let doubts = Doubts::default();
        let live_audit = LiveAudit::default();
        Ok(Self {
            settings,
            keys,
            tracks,
            graph,
            trust,
            last,
            loops,
            work,
            counts,
            usual,
            start,
            wheels,
            strange,
            piece,
            doubts,
            live_audit,
            is_finished: false,
        })
    }
}
