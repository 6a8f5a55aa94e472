//! Limits of the resources that a mesh file may use, so that a small hostile file stays small.

use crate::error::MeshError;

/// Limits for one file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MeshLimits {
    /// Maximum number of triangles over all parts, after instancing.
    pub triangles_max: usize,
    /// Maximum number of scene nodes, geometry instances and primitives.
    pub visits_max: usize,
    /// Maximum nesting depth of scene nodes.
    pub depth_max: usize,
    /// Maximum memory for reading, the finished mesh included \[bytes\]. The limit of a small file is
    /// lower: 128 MiB, plus 24 bytes per byte of the file.
    pub bytes_max: usize,
}

/// Memory for reading the smallest file \[bytes\]: instances and implied values expand valid files of a few
/// kilobytes to megabytes.
const BYTES_OF_ANY_FILE: usize = 128 << 20;

/// Memory for each further byte of a file. The most compact valid vertex is three 16-bit numbers, six
/// bytes, and takes about 110 bytes while it is read.
const BYTES_PER_BYTE: usize = 24;

impl Default for MeshLimits {
    /// Ten million triangles, a million visits, 128 levels, 2 GiB: far above the needs of a simulator and
    /// far below harm.
    fn default() -> Self {
        MeshLimits {
            triangles_max: 10_000_000,
            visits_max: 1_000_000,
            depth_max: 128,
            bytes_max: 2 << 30,
        }
    }
}

/// Maximum number of corners of one polygon.
const MAX_CORNERS: usize = 1_000_000;

/// Remaining [`Limits`] while a file is read.
pub(crate) struct Budget {
    limits: MeshLimits,
    triangles: usize,
    visits: usize,
    bytes: usize,
    /// Memory that has been allowed so far [bytes].
    granted: usize,
    /// Remaining steps of ear clipping for concave polygons, which takes quadratic to cubic time in the
    /// number of corners.
    pub(crate) ear_steps: usize,
}

impl Budget {
    pub(crate) fn new(limits: MeshLimits) -> Self {
        let MeshLimits { triangles_max, visits_max, bytes_max, .. } = limits;
        let ear_steps = 40usize.saturating_mul(triangles_max);
        let bytes = bytes_max.min(BYTES_OF_ANY_FILE);
        Budget {
            limits,
            triangles: triangles_max,
            visits: visits_max,
            bytes,
            granted: bytes,
            ear_steps,
        }
    }

    /// Allows more memory for the bytes of another file of the mesh, up to the limit.
    pub(crate) fn grant(&mut self, file_bytes: usize) {
        let more = file_bytes.saturating_mul(BYTES_PER_BYTE);
        let more = more.min(self.limits.bytes_max - self.granted);
        self.granted += more;
        self.bytes += more;
    }

    pub(crate) fn triangles(&mut self, count: usize) -> Result<(), MeshError> {
        spend(&mut self.triangles, count, || {
            MeshError::new(
                format!("the mesh has more than {} triangles", self.limits.triangles_max),
                "decimate it, or check for instances of instances",
            )
        })
    }

    pub(crate) fn visit(&mut self) -> Result<(), MeshError> {
        spend(&mut self.visits, 1, || {
            MeshError::new(
                format!("the scene unfolds to more than {} nodes", self.limits.visits_max),
                "look for nodes that instance each other many times over",
            )
        })
    }

    pub(crate) fn bytes(&mut self, count: usize) -> Result<(), MeshError> {
        let granted = self.granted;
        spend(&mut self.bytes, count, || {
            MeshError::new(
                format!("the mesh unfolds to more than {} MiB", granted >> 20),
                "decimate it, or check for instances of instances",
            )
        })
    }

    /// Checks the number of corners of one polygon, which are all in memory at once.
    pub(crate) fn corners(&self, count: usize) -> Result<(), MeshError> {
        if count <= MAX_CORNERS {
            return Ok(());
        }
        Err(MeshError::new(
            format!("a polygon has more than {MAX_CORNERS} corners"),
            "triangulate the mesh before export",
        ))
    }

    pub(crate) fn depth(&self, depth: usize) -> Result<(), MeshError> {
        if depth <= self.limits.depth_max {
            return Ok(());
        }
        Err(MeshError::new(
            format!("scene nodes are nested more than {} deep", self.limits.depth_max),
            "look for a node that contains or instances itself",
        ))
    }
}

fn spend(
    left: &mut usize,
    count: usize,
    error: impl FnOnce() -> MeshError,
) -> Result<(), MeshError> {
    *left = left.checked_sub(count).ok_or_else(error)?;
    Ok(())
}
