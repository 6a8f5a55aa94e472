//! Likelihood field of an occupancy grid: distances to the nearest obstacle (*Probabilistic
//! Robotics*, section 6.4).

use periplus_diagnostics::{Diagnostic, DiagnosticCause};
use periplus_geometry::{Pose2, Stream};
use periplus_grid::{Grid, GridInfo, OccupancyGrid, occupancy, squared_distances};

/// Maximum number of cells to either side in [`LikelihoodMap::is_free_near`].
const MAX_NEARBY_CELL_COUNT: f64 = 60.0;

/// Occupancy of a cell as AMCL uses it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CellState {
    /// Value 0: free space.
    Free,
    /// Value 100: an obstacle that scanners see.
    Occupied,
    /// Any other value.
    Unknown,
}

impl CellState {
    /// Converts a value of `nav_msgs/OccupancyGrid`.
    #[must_use]
    pub fn from_occupancy(value: i8) -> Self {
        match value {
            occupancy::FREE => Self::Free,
            occupancy::OCCUPIED => Self::Occupied,
            _ => Self::Unknown,
        }
    }

    /// Value of Nav2's `map_cell_t::occ_state`: -1 free, 0 unknown, 1 occupied.
    #[must_use]
    pub fn amcl_value(self) -> i8 {
        match self {
            Self::Free => -1,
            Self::Unknown => 0,
            Self::Occupied => 1,
        }
    }
}

/// Position of cell `(i, j)` relative to its grid point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CellAlignment {
    /// The grid point is the lower left corner of the cell, as in `nav_msgs/OccupancyGrid`.
    #[default]
    Corner,
    /// The grid point is the center of the cell, as in Nav2's AMCL: half a cell too low and too far
    /// left.
    Centered,
}

/// Occupancy grid with the distance from each cell to the nearest obstacle.
#[derive(Clone, Debug, PartialEq)]
pub struct LikelihoodMap {
    info: GridInfo,
    alignment: CellAlignment,
    states: Vec<CellState>,
    /// Distance to the center of the nearest occupied cell, at most `distance_max_m` \[m\].
    distances_m: Vec<f32>,
    distance_max_m: f64,
    /// Indices of the free cells.
    free: Vec<u32>,
    occupied: usize,
}

/// Settings of a [`LikelihoodMap`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LikelihoodMapSettings {
    /// Maximum distance to obstacles: `laser_likelihood_max_dist` \[m\].
    pub distance_max_m: f64,
    /// Position of cells relative to their grid points.
    pub alignment: CellAlignment,
    /// Use every second row and column of free cells for random poses: `freespace_downsampling`.
    pub downsamples_free_space: bool,
}

impl LikelihoodMap {
    /// Computes the distances of a map.
    ///
    /// # Errors
    /// A map without cells, or without occupied cells.
    pub fn new(
        map: &OccupancyGrid,
        settings: LikelihoodMapSettings,
    ) -> Result<Self, Box<Diagnostic>> {
        let info = map.info;
        if let Err(error) = GridInfo::new(info.resolution_m, info.width, info.height, info.origin) {
            let message = format!("the map cannot be used: {error}");
            return Err(Diagnostic::error("bad-map", message).into());
        }
        if info.is_empty() || map.cells.len() != info.len() {
            let (width, height, values) = (info.width, info.height, map.cells.len());
            return Err(Diagnostic::error(
                "empty-map",
                format!("the map has {width} by {height} cells, but {values} values"),
            )
            .help("give a map with cells: check the image that the map server loads")
            .into());
        }
        let states: Vec<CellState> =
            map.cells.iter().map(|&value| CellState::from_occupancy(value)).collect();
        let occupied = states.iter().filter(|state| **state == CellState::Occupied).count();
        if occupied == 0 {
            return Err(Diagnostic::error(
                "map-without-walls",
                "no cell of the map is occupied, so scans cannot be matched",
            )
            .caused_by(DiagnosticCause::MapWithoutWalls)
            .note("only cells of value 100 are occupied; 1 to 99 count as unknown")
            .help("load the map in `trinary` mode, or lower its `occupied_thresh`")
            .into());
        }
        let distance_max = settings.distance_max_m as f32;
        let resolution = info.resolution_m as f32;
        let distances_m = squared_distances(map, |&value| value == occupancy::OCCUPIED)
            .cells
            .iter()
            .map(|&squared| (resolution * (squared as f32).sqrt()).min(distance_max))
            .collect();
        let free = states.iter().enumerate().filter(|&(index, state)| {
            let (column, row) = info.cell(index);
            let is_kept = !settings.downsamples_free_space || (column % 2 == 0 && row % 2 == 0);
            *state == CellState::Free && is_kept
        });
        // A grid has fewer cells than 32 bits count.
        let free = free.map(|(index, _)| index as u32).collect();
        let (alignment, distance_max_m) = (settings.alignment, settings.distance_max_m);
        Ok(Self { info, alignment, states, distances_m, distance_max_m, free, occupied })
    }

    /// Size, resolution and origin of the map.
    #[must_use]
    pub fn info(&self) -> &GridInfo {
        &self.info
    }

    /// Number of free cells.
    #[must_use]
    pub fn free_count(&self) -> usize {
        self.free.len()
    }

    /// Number of occupied cells.
    #[must_use]
    pub fn occupied_count(&self) -> usize {
        self.occupied
    }

    /// Maximum distance \[m\].
    #[must_use]
    pub fn distance_max_m(&self) -> f64 {
        self.distance_max_m
    }

    /// States of the cells as a grid.
    pub(crate) fn states(&self) -> Grid<CellState> {
        Grid { info: self.info, cells: self.states.clone() }
    }

    /// Distances of all cells to the nearest obstacle \[m\].
    pub(crate) fn distances_m(&self) -> &[f32] {
        &self.distances_m
    }

    /// Returns the conversion from map coordinates to cells.
    #[must_use]
    pub fn cell_transform(&self) -> CellTransform {
        let (sine, cosine) = libm::sincos(-self.info.origin.yaw_rad);
        CellTransform {
            origin: self.info.origin,
            sine,
            cosine,
            scale: 1.0 / self.info.resolution_m,
            shift: match self.alignment {
                CellAlignment::Corner => 0.0,
                CellAlignment::Centered => 0.5,
            },
        }
    }

    /// Returns the cell at a point of the map \[m\]; the cell may be outside of the map.
    #[must_use]
    pub fn cell_at(&self, x_m: f64, y_m: f64) -> (i64, i64) {
        let (u, v) = self.cell_transform().map_to_cells(x_m, y_m);
        (libm::floor(u) as i64, libm::floor(v) as i64)
    }

    /// Returns the state of a cell, or none outside of the map.
    #[must_use]
    pub fn state(&self, (column, row): (i64, i64)) -> Option<CellState> {
        self.index((column, row)).map(|index| self.states[index])
    }

    /// True if a point \[m\] is in a free or occupied cell.
    pub(crate) fn is_known(&self, x_m: f64, y_m: f64) -> bool {
        let state = self.state(self.cell_at(x_m, y_m));
        state.is_some_and(|state| state != CellState::Unknown)
    }

    /// True if a free cell is within `distance_m` of a point along each axis of the map.
    pub(crate) fn is_free_near(&self, x_m: f64, y_m: f64, distance_m: f64) -> bool {
        let (column, row) = self.cell_at(x_m, y_m);
        let is_free = |cell| self.state(cell) == Some(CellState::Free);
        let cells = (distance_m / self.info.resolution_m).min(MAX_NEARBY_CELL_COUNT) as i64;
        is_free((column, row))
            || (-cells..=cells)
                .any(|up| (-cells..=cells).any(|right| is_free((column + right, row + up))))
    }

    /// Returns the distance from a point to the nearest obstacle \[m\]; outside of the map, the
    /// maximum distance.
    #[must_use]
    pub fn distance_m(&self, x_m: f64, y_m: f64) -> f64 {
        let index = self.index(self.cell_at(x_m, y_m));
        index.map_or(self.distance_max_m, |index| f64::from(self.distances_m[index]))
    }

    /// Returns the bilinear interpolation of the distance to obstacles at a point \[m\] and its
    /// gradient along x and y of the map. None outside of the map or where the distance is the
    /// maximum.
    pub(crate) fn distance_and_gradient(
        &self,
        cell_transform: &CellTransform,
        x_m: f64,
        y_m: f64,
    ) -> Option<(f64, [f64; 2])> {
        let (u, v) = cell_transform.map_to_cells(x_m, y_m);
        let (u, v) = (u - 0.5, v - 0.5);
        let (width, height) = (self.info.width, self.info.height);
        // NaN fails, too.
        let is_inside = u >= 0.0 && v >= 0.0 && u < (width - 1) as f64 && v < (height - 1) as f64;
        if !is_inside {
            return None;
        }
        let (column, row) = (u as usize, v as usize);
        let (a, b) = (u - column as f64, v - row as f64);
        let at = |index: usize| f64::from(self.distances_m[index]);
        let low = row * width + column;
        let (p, q, r, s) = (at(low), at(low + 1), at(low + width), at(low + width + 1));
        let (bottom, top) = (p + a * (q - p), r + a * (s - r));
        let distance = bottom + b * (top - bottom);
        if distance >= self.distance_max_m {
            return None;
        }
        let (du, dv) = ((1.0 - b) * (q - p) + b * (s - r), top - bottom);
        // From cells to metres along the axes of the map.
        let gradient = [
            cell_transform.scale * (cell_transform.cosine * du + cell_transform.sine * dv),
            cell_transform.scale * (cell_transform.cosine * dv - cell_transform.sine * du),
        ];
        Some((distance, gradient))
    }

    /// Casts a ray from a point along a direction and returns the range of the first wall \[m\], at
    /// most `range_max_m`. Unknown cells do not block the ray, nor do walls within `range_min_m`.
    ///
    /// Sphere tracing: the distance to the nearest obstacle bounds the step (Hart 1996).
    pub(crate) fn cast_ray_m(
        &self,
        cell_transform: &CellTransform,
        (x_m, y_m): (f64, f64),
        bearing_rad: f64,
        range_min_m: f64,
        range_max_m: f64,
    ) -> f64 {
        let (mut u, mut v) = cell_transform.map_to_cells(x_m, y_m);
        let (along, across) = cell_transform.direction(bearing_rad);
        let (width, height) = (self.info.width as f64, self.info.height as f64);
        let cell_m = self.info.resolution_m;
        (u, v) = (u + along * range_min_m, v + across * range_min_m);
        let mut range_m = range_min_m;
        while range_m < range_max_m {
            let is_inside = u >= 0.0 && v >= 0.0 && u < width && v < height;
            let distance_m = if is_inside {
                f64::from(self.distances_m[v as usize * self.info.width + u as usize])
            } else {
                // The ray may enter the map only across its border.
                cell_m
            };
            if distance_m <= 0.0 {
                return range_m;
            }
            // Both end points are exact to one cell.
            let step_m = (distance_m - cell_m).max(0.5 * cell_m);
            range_m += step_m;
            (u, v) = (u + along * step_m, v + across * step_m);
        }
        range_max_m
    }

    fn index(&self, (column, row): (i64, i64)) -> Option<usize> {
        let cell = (usize::try_from(column).ok()?, usize::try_from(row).ok()?);
        self.info.contains(cell).then(|| self.info.index(cell))
    }

    /// Returns the center of a cell in map coordinates \[m\], as localization uses it.
    #[must_use]
    pub fn cell_center(&self, (column, row): (i64, i64)) -> (f64, f64) {
        let half = match self.alignment {
            CellAlignment::Corner => 0.5,
            CellAlignment::Centered => 0.0,
        };
        self.info.point_at(column as f64 + half, row as f64 + half)
    }

    /// Centers of all occupied cells \[m\].
    pub fn obstacles(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.cell_centers(CellState::Occupied)
    }

    /// Centers of all cells of a state \[m\].
    pub(crate) fn cell_centers(&self, wanted: CellState) -> impl Iterator<Item = (f64, f64)> + '_ {
        let cells = self.states.iter().enumerate();
        cells.filter(move |(_, state)| **state == wanted).map(|(index, _)| {
            let (column, row) = self.info.cell(index);
            self.cell_center((column as i64, row as i64))
        })
    }

    /// Draws a pose uniformly from the free cells; none when no cell is free.
    pub fn random_pose(&self, stream: &mut Stream) -> Option<Pose2> {
        let index = (stream.unit() * self.free.len() as f64) as usize;
        let (column, row) = self.info.cell(*self.free.get(index)? as usize);
        // Nav2 uses the grid point, its center of the cell.
        let (right, up) = match self.alignment {
            CellAlignment::Corner => (stream.unit(), stream.unit()),
            CellAlignment::Centered => (0.0, 0.0),
        };
        let (x_m, y_m) = self.info.point_at(column as f64 + right, row as f64 + up);
        let yaw_rad = std::f64::consts::PI * (2.0 * stream.unit() - 1.0);
        Some(Pose2::new(x_m, y_m, yaw_rad))
    }
}

/// Conversion from map coordinates to columns and rows.
#[derive(Clone, Copy, Debug)]
pub struct CellTransform {
    origin: Pose2,
    sine: f64,
    cosine: f64,
    scale: f64,
    shift: f64,
}

impl CellTransform {
    /// Converts a point of the map \[m\] to fractional columns and rows; cell `(i, j)` begins at
    /// `i` and `j`.
    #[must_use]
    pub fn map_to_cells(&self, x_m: f64, y_m: f64) -> (f64, f64) {
        let (x_m, y_m) = (x_m - self.origin.x_m, y_m - self.origin.y_m);
        let along = (self.cosine * x_m - self.sine * y_m) * self.scale;
        let across = (self.sine * x_m + self.cosine * y_m) * self.scale;
        (along + self.shift, across + self.shift)
    }

    /// As [`CellTransform::direction`] in single precision.
    pub(crate) fn direction_f32(&self, yaw_rad: f64) -> (f32, f32) {
        let (sine, cosine) = libm::sincosf((yaw_rad - self.origin.yaw_rad) as f32);
        let scale = self.scale as f32;
        (cosine * scale, sine * scale)
    }

    /// Converts a heading in the map to columns and rows per metre.
    pub(crate) fn direction(&self, yaw_rad: f64) -> (f64, f64) {
        let (sine, cosine) = libm::sincos(yaw_rad - self.origin.yaw_rad);
        (cosine * self.scale, sine * self.scale)
    }
}
