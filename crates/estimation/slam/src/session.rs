//! Sessions: the whole state of a mapping run as bytes, for resuming it exactly.
//!
//! The format is described in `docs/formats/session.md`: a magic number, a version, sections with name and
//! length, a checksum. Unknown sections are skipped. Any input ends in a consistent map or an error, and
//! uses no more memory than a small multiple of its size.

mod bytes;

use std::fmt;

use periplus_geometry::Pose2;
use periplus_scan_matching::{Cloud, PackedPlaces, Point, Symmetric3};

use crate::engine::Slam;
use crate::graph::{ConstraintKind, Edge};
use crate::keyframe::{Keyframe, TrajectoryNode};
use crate::settings::Settings;

pub(crate) use bytes::{Bytes, Fault, Pack, Reader, packed};

/// Magic number at the start of a session file.
pub const SESSION_MAGIC: [u8; 8] = *b"PERISLAM";
/// The version that is written, and the only one that is read.
pub const SESSION_VERSION: u32 = 3;

/// Bytes before the first section: magic and version.
const HEADER_BYTES: usize = 12;
/// Bytes after the last one: the checksum.
const CHECKSUM_BYTES: usize = 4;
/// Coordinates beyond are not of a building \[m\], and turns beyond not of a robot \[rad\].
const FARTHEST_M: f64 = 1e6;
const MOST_RAD: f64 = 1e3;
/// Farthest distance of a point from the robot in a valid session \[m\].
const FARTHEST_SEEN_M: f32 = 1e4;

/// Error while reading a session.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SessionError {
    /// Offset of the error \[bytes\].
    pub offset: usize,
    /// Cause and remedy.
    pub reason: String,
}

impl fmt::Display for SessionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "byte {}: {}", self.offset, self.reason)
    }
}

impl std::error::Error for SessionError {}

impl Slam {
    /// Everything that is known, as bytes of a session. Settings are not part of it: with the same
    /// ones [`Slam::resume`] goes on to the bit as if nothing had been saved.
    #[must_use]
    pub fn save(&self) -> Vec<u8> {
        let mut out = Bytes(SESSION_MAGIC.to_vec());
        SESSION_VERSION.pack(&mut out);
        for (name, section) in self.write_sections() {
            out.0.extend_from_slice(&name);
            section.0.len().pack(&mut out);
            out.0.extend_from_slice(&section.0);
        }
        crc32fast::hash(&out.0).pack(&mut out);
        out.0
    }

    /// The map of a session, to go on with.
    ///
    /// # Errors
    /// When the bytes are no session, of another version, damaged, or their parts do not fit
    /// together.
    pub fn resume(bytes: &[u8], settings: Settings) -> Result<Self, SessionError> {
        let sections = sections(bytes)?;
        let section = |name: &[u8; 4]| {
            let found = sections.iter().find(|it| &it.0 == name).map(|it| it.1.clone());
            found.ok_or_else(|| SessionError {
                offset: bytes.len(),
                reason: format!(
                    "there is no section {}: the file is not whole; take another copy",
                    String::from_utf8_lossy(name)
                ),
            })
        };
        Self::read_sections(&section, settings)
    }
}

/// Sections by name, in file order.
fn sections(bytes: &[u8]) -> Result<Vec<([u8; 4], Reader<'_>)>, SessionError> {
    let fault = |offset: usize, reason: String| Err(SessionError { offset, reason });
    if !bytes.starts_with(&SESSION_MAGIC) {
        return fault(
            0,
            "this is no session of periplus slam: those begin with `PERISLAM`. Graphs of \
             slam_toolbox (.posegraph, .data) cannot be read; map again from the log"
                .into(),
        );
    }
    if bytes.len() < HEADER_BYTES + CHECKSUM_BYTES {
        return fault(bytes.len(), "the file ends here; take another copy".into());
    }
    let (all, sum) = bytes.split_at(bytes.len() - CHECKSUM_BYTES);
    let mut head = Reader::new(all, SESSION_MAGIC.len());
    let version = u32::unpack(&mut head).unwrap_or_default();
    if version != SESSION_VERSION {
        return fault(
            SESSION_MAGIC.len(),
            format!(
                "the session is of version {version}, and this program reads {SESSION_VERSION}; \
                 use the program that wrote it, or map again from the log"
            ),
        );
    }
    if crc32fast::hash(all).to_le_bytes() != sum {
        let reason = "the checksum is wrong: the file is damaged or cut short; take another copy";
        return fault(all.len(), reason.into());
    }
    let mut found = Vec::new();
    while !head.is_empty() {
        let named = head.take(4).map(|name| [name[0], name[1], name[2], name[3]]);
        let length = u64::unpack(&mut head);
        let (Ok(name), Ok(length)) = (named, length) else {
            return fault(head.at(), "a section begins here and has no length".into());
        };
        let at = head.at();
        let Ok(body) = head.take(usize::try_from(length).unwrap_or(usize::MAX)) else {
            return fault(at, format!("a section of {length} bytes is longer than the file"));
        };
        found.push((name, Reader::within(body, at)));
    }
    Ok(found)
}

/// Reads a whole section.
pub(crate) fn whole<T: Pack>(mut section: Reader<'_>) -> Result<T, SessionError> {
    let read = T::unpack(&mut section);
    let rest = !section.is_empty();
    let offset = section.at();
    match read {
        Ok(_) if rest => {
            let reason = "the section goes on where its content has ended".into();
            Err(SessionError { offset, reason })
        }
        Ok(value) => Ok(value),
        Err(Fault(reason)) => Err(SessionError { offset, reason }),
    }
}

packed!(TrajectoryNode { time_ns, keyframe, keyframe_from_base });

impl Pack for Pose2 {
    fn pack(&self, out: &mut Bytes) {
        (self.x_m, (self.y_m, self.yaw_rad)).pack(out);
    }

    fn unpack(from: &mut Reader<'_>) -> Result<Self, Fault> {
        let (x_m, (y_m, yaw_rad)) = Pack::unpack(from)?;
        let is_near = |value: f64| value.abs() <= FARTHEST_M;
        if is_near(x_m) && is_near(y_m) && f64::abs(yaw_rad) <= MOST_RAD {
            Ok(Self::new(x_m, y_m, yaw_rad))
        } else {
            Err(Fault(format!("({x_m}, {y_m}, {yaw_rad}) is no pose in a building")))
        }
    }
}

impl Pack for Symmetric3 {
    fn pack(&self, out: &mut Bytes) {
        [self.xx, self.xy, self.xt, self.yy, self.yt, self.tt].iter().for_each(|it| it.pack(out));
    }

    fn unpack(from: &mut Reader<'_>) -> Result<Self, Fault> {
        let mut next = || f64::unpack(from);
        let it =
            Self { xx: next()?, xy: next()?, xt: next()?, yy: next()?, yt: next()?, tt: next()? };
        let all = [it.xx, it.xy, it.xt, it.yy, it.yt, it.tt];
        let is_one = all.iter().all(|it| it.is_finite()) && it.xx.min(it.yy).min(it.tt) >= 0.0;
        is_one.then_some(it).ok_or_else(|| Fault("a matrix is no covariance".into()))
    }
}

impl Pack for Keyframe {
    fn pack(&self, out: &mut Bytes) {
        let Self { cloud, ends, travel_m } = self;
        let (cloud, ends) = (cloud.cloud(), ends.as_ref().map(|it| it.iter().collect::<Vec<_>>()));
        let points: Vec<[f32; 4]> = cloud.points().iter().map(|p| [p.x, p.y, p.nx, p.ny]).collect();
        points.pack(out);
        cloud.followed().to_vec().pack(out);
        cloud.origin().pack(out);
        ends.pack(out);
        travel_m.pack(out);
    }

    fn unpack(from: &mut Reader<'_>) -> Result<Self, Fault> {
        let points: Vec<[f32; 4]> = Pack::unpack(from)?;
        let points = points.into_iter().map(|[x, y, nx, ny]| Point { x, y, nx, ny }).collect();
        let is_followed = Pack::unpack(from)?;
        let cloud = Cloud::restored(points, is_followed, Pack::unpack(from)?).ok_or_else(|| {
            Fault("the points of a scan are not in order of their bearing".into())
        })?;
        let (ends, travel_m): (Option<Vec<[f32; 2]>>, f64) = Pack::unpack(from)?;
        let is_near = |it: &f32| it.abs() <= FARTHEST_SEEN_M;
        let seen = cloud.points().iter().all(|point| is_near(&point.x) && is_near(&point.y));
        if !seen || !cloud.origin().iter().all(is_near) {
            return Err(Fault("a scan saw farther than any scanner".into()));
        }
        if !ends.iter().flatten().flatten().all(is_near) || !(0.0..=1e12).contains(&travel_m) {
            return Err(Fault("beam ends or the path length are not finite".into()));
        }
        let ends = ends.map(|ends| PackedPlaces::new(&ends, cloud.origin()));
        Ok(Self::new(&cloud, ends, travel_m))
    }
}

impl Pack for ConstraintKind {
    fn pack(&self, out: &mut Bytes) {
        let code = match self {
            Self::Sequential => 0_u8,
            Self::Proximity => 1,
            Self::LoopClosure => 2,
        };
        code.pack(out);
    }

    fn unpack(from: &mut Reader<'_>) -> Result<Self, Fault> {
        Ok(match u8::unpack(from)? {
            0 => Self::Sequential,
            1 => Self::Proximity,
            2 => Self::LoopClosure,
            other => return Err(Fault(format!("there is no kind {other} of edges"))),
        })
    }
}

impl Pack for Edge {
    fn pack(&self, out: &mut Bytes) {
        let Self { from, to, from_from_to, information, covariances, kind, weight } = self;
        from.pack(out);
        to.pack(out);
        from_from_to.pack(out);
        information.pack(out);
        covariances.pack(out);
        kind.pack(out);
        weight.pack(out);
    }

    fn unpack(reader: &mut Reader<'_>) -> Result<Self, Fault> {
        let (from, to) = Pack::unpack(reader)?;
        let edge = Self {
            from,
            to,
            from_from_to: Pack::unpack(reader)?,
            information: Pack::unpack(reader)?,
            covariances: Pack::unpack(reader)?,
            kind: Pack::unpack(reader)?,
            weight: Pack::unpack(reader)?,
        };
        if from == to || !(0.0..=1.0).contains(&edge.weight) {
            return Err(Fault("an edge leads nowhere or weighs more than all".into()));
        }
        Ok(edge)
    }
}
