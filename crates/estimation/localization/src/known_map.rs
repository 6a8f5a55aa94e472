//! The map on which the robot is.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{Pose2, Stream};
use periplus_grid::{Grid, Lattice, OccupancyGrid, occupancy, squared_distances};

/// What a cell says to localization.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CellState {
    /// 0: the robot may be there.
    Free,
    /// 100: scanners see it.
    Occupied,
    /// Any other number.
    Unknown,
}

impl CellState {
    /// Of a value of `nav_msgs/OccupancyGrid`.
    #[must_use]
    pub fn of(value: i8) -> Self {
        match value {
            occupancy::FREE => Self::Free,
            occupancy::OCCUPIED => Self::Occupied,
            _ => Self::Unknown,
        }
    }

    /// The number that AMCL has for it: -1 free, 0 unknown, 1 occupied.
    #[must_use]
    pub fn number(self) -> i8 {
        match self {
            Self::Free => -1,
            Self::Unknown => 0,
            Self::Occupied => 1,
        }
    }
}

/// Where cell `(i, j)` is taken to be.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CellPlace {
    /// From its lower left corner on, as everybody else has it.
    #[default]
    Corner,
    /// Around that corner: half a cell too low and too far left, as Nav2's AMCL has it.
    Centred,
}

/// A map with distances to what scanners see.
#[derive(Clone, Debug, PartialEq)]
pub struct KnownMap {
    lattice: Lattice,
    place: CellPlace,
    states: Vec<CellState>,
    /// To the centre of the nearest occupied cell, no more than `most_m` \[m\].
    distances_m: Vec<f32>,
    most_m: f64,
    /// Places of free cells.
    free: Vec<u32>,
    occupied: usize,
}

/// How a map is prepared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapSettings {
    /// Distances count up to here: `laser_likelihood_max_dist` \[m\].
    pub most_m: f64,
    /// Where cells are.
    pub place: CellPlace,
    /// Whether only every other row and column of free cells is kept for random poses.
    pub thins_free: bool,
}

impl KnownMap {
    /// Prepares a map.
    ///
    /// # Errors
    /// When it has no cells, or nothing that a scanner could see.
    pub fn new(map: &OccupancyGrid, settings: MapSettings) -> Result<Self, Box<Diagnostic>> {
        let lattice = map.lattice;
        if let Err(error) =
            Lattice::new(lattice.resolution_m, lattice.width, lattice.height, lattice.origin)
        {
            let words = format!("the map cannot be used: {error}");
            return Err(Diagnostic::error("bad-map", words).into());
        }
        if lattice.is_empty() || map.cells.len() != lattice.len() {
            let (width, height, values) = (lattice.width, lattice.height, map.cells.len());
            return Err(Diagnostic::error(
                "empty-map",
                format!("the map has {width} by {height} cells and {values} values"),
            )
            .help("give a map with cells: check the image that the map server loads")
            .into());
        }
        let states: Vec<CellState> = map.cells.iter().map(|&value| CellState::of(value)).collect();
        let occupied = states.iter().filter(|state| **state == CellState::Occupied).count();
        if occupied == 0 {
            return Err(Diagnostic::error(
                "map-without-walls",
                "no cell of the map is occupied, so no scan can tell where the robot is",
            )
            .note("only cells of value 100 are occupied; 1 to 99 count as unknown")
            .help("load the map in `trinary` mode, or lower its `occupied_thresh`")
            .into());
        }
        let most = settings.most_m as f32;
        let resolution = lattice.resolution_m as f32;
        let distances_m = squared_distances(map, |&value| value == occupancy::OCCUPIED)
            .cells
            .iter()
            .map(|&squared| (resolution * (squared as f32).sqrt()).min(most))
            .collect();
        let free = states.iter().enumerate().filter(|&(index, state)| {
            let (column, row) = lattice.cell(index);
            let is_kept = !settings.thins_free || (column % 2 == 0 && row % 2 == 0);
            *state == CellState::Free && is_kept
        });
        // A lattice has fewer cells than 32 bits count.
        let free = free.map(|(index, _)| index as u32).collect();
        let (place, most_m) = (settings.place, settings.most_m);
        Ok(Self { lattice, place, states, distances_m, most_m, free, occupied })
    }

    /// Where its cells are.
    #[must_use]
    pub fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// How many cells are free.
    #[must_use]
    pub fn free_count(&self) -> usize {
        self.free.len()
    }

    /// How many cells are occupied.
    #[must_use]
    pub fn occupied_count(&self) -> usize {
        self.occupied
    }

    /// Distances end here \[m\].
    #[must_use]
    pub fn most_m(&self) -> f64 {
        self.most_m
    }

    /// What cells say, as a grid.
    pub(crate) fn states(&self) -> Grid<CellState> {
        Grid { lattice: self.lattice, cells: self.states.clone() }
    }

    /// Distances of all cells \[m\].
    pub(crate) fn distances_m(&self) -> &[f32] {
        &self.distances_m
    }

    /// What finds cells.
    #[must_use]
    pub fn finder(&self) -> Finder {
        let (sine, cosine) = libm::sincos(-self.lattice.origin.yaw_rad);
        Finder {
            origin: self.lattice.origin,
            sine,
            cosine,
            scale: 1.0 / self.lattice.resolution_m,
            shift: match self.place {
                CellPlace::Corner => 0.0,
                CellPlace::Centred => 0.5,
            },
        }
    }

    /// The cell at a point of the map \[m\]; it may be outside of the map.
    #[must_use]
    pub fn cell_at(&self, x_m: f64, y_m: f64) -> (i64, i64) {
        let (u, v) = self.finder().cells_to(x_m, y_m);
        (libm::floor(u) as i64, libm::floor(v) as i64)
    }

    /// What a cell says; none outside of the map.
    #[must_use]
    pub fn state(&self, (column, row): (i64, i64)) -> Option<CellState> {
        self.index((column, row)).map(|index| self.states[index])
    }

    /// Whether the map says anything of a point \[m\].
    pub(crate) fn is_known(&self, x_m: f64, y_m: f64) -> bool {
        let state = self.state(self.cell_at(x_m, y_m));
        state.is_some_and(|state| state != CellState::Unknown)
    }

    /// Whether a point, or one no farther than so along an axis of the map, is in a free cell \[m\].
    pub(crate) fn is_free_near(&self, x_m: f64, y_m: f64, near_m: f64) -> bool {
        let (column, row) = self.cell_at(x_m, y_m);
        let is_free = |cell| self.state(cell) == Some(CellState::Free);
        // No more than so many cells are asked.
        let reach = (near_m / self.lattice.resolution_m).min(60.0) as i64;
        is_free((column, row))
            || (-reach..=reach)
                .any(|up| (-reach..=reach).any(|right| is_free((column + right, row + up))))
    }

    /// How far a point of the map is from what scanners see \[m\]; outside of the map as far as can be.
    #[must_use]
    pub fn distance_m(&self, x_m: f64, y_m: f64) -> f64 {
        let index = self.index(self.cell_at(x_m, y_m));
        index.map_or(self.most_m, |index| f64::from(self.distances_m[index]))
    }

    /// How far a point of the map is from walls \[m\], smoothly between the middles of cells, and how
    /// that changes along x and y of the map. Nothing where distances end, or outside.
    pub(crate) fn slope(&self, finder: &Finder, x_m: f64, y_m: f64) -> Option<(f64, [f64; 2])> {
        let (u, v) = finder.cells_to(x_m, y_m);
        let (u, v) = (u - 0.5, v - 0.5);
        let (width, height) = (self.lattice.width, self.lattice.height);
        // What is no number fails, too.
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
        if distance >= self.most_m {
            return None;
        }
        let (du, dv) = ((1.0 - b) * (q - p) + b * (s - r), top - bottom);
        // From cells back to metres along the map's axes.
        let gradient = [
            finder.scale * (finder.cosine * du + finder.sine * dv),
            finder.scale * (finder.cosine * dv - finder.sine * du),
        ];
        Some((distance, gradient))
    }

    /// How far it is from a point along a direction to the first wall \[m\], no more than `reach_m`.
    /// What is unknown or outside stops nothing. Within `near_m` of the point nothing is seen.
    ///
    /// No wall is nearer than the distance that is kept, so that is how far each step goes.
    pub(crate) fn wall_m(
        &self,
        finder: &Finder,
        (x_m, y_m): (f64, f64),
        bearing_rad: f64,
        near_m: f64,
        reach_m: f64,
    ) -> f64 {
        let (mut u, mut v) = finder.cells_to(x_m, y_m);
        let (along, across) = finder.heading(bearing_rad);
        let (width, height) = (self.lattice.width as f64, self.lattice.height as f64);
        let cell_m = self.lattice.resolution_m;
        (u, v) = (u + along * near_m, v + across * near_m);
        let mut range_m = near_m;
        while range_m < reach_m {
            let is_inside = u >= 0.0 && v >= 0.0 && u < width && v < height;
            let distance_m = if is_inside {
                f64::from(self.distances_m[v as usize * self.lattice.width + u as usize])
            } else {
                // Back in it may only come along its border.
                cell_m
            };
            if distance_m <= 0.0 {
                return range_m;
            }
            // Both ends are known to within their cells.
            let step_m = (distance_m - cell_m).max(0.5 * cell_m);
            range_m += step_m;
            (u, v) = (u + along * step_m, v + across * step_m);
        }
        reach_m
    }

    fn index(&self, (column, row): (i64, i64)) -> Option<usize> {
        let cell = (usize::try_from(column).ok()?, usize::try_from(row).ok()?);
        self.lattice.contains(cell).then(|| self.lattice.index(cell))
    }

    /// The middle of a cell in the map \[m\], as localization sees it.
    #[must_use]
    pub fn middle_of(&self, (column, row): (i64, i64)) -> (f64, f64) {
        let half = match self.place {
            CellPlace::Corner => 0.5,
            CellPlace::Centred => 0.0,
        };
        self.lattice.point_at(column as f64 + half, row as f64 + half)
    }

    /// Middles of all occupied cells \[m\].
    pub fn walls(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.places(CellState::Occupied)
    }

    /// Middles of all cells that say so \[m\].
    pub(crate) fn places(&self, wanted: CellState) -> impl Iterator<Item = (f64, f64)> + '_ {
        let cells = self.states.iter().enumerate();
        cells.filter(move |(_, state)| **state == wanted).map(|(index, _)| {
            let (column, row) = self.lattice.cell(index);
            self.middle_of((column as i64, row as i64))
        })
    }

    /// A pose in a free cell, all equally likely; none when no cell is free.
    pub fn random_pose(&self, stream: &mut Stream) -> Option<Pose2> {
        let place = (stream.unit() * self.free.len() as f64) as usize;
        let (column, row) = self.lattice.cell(*self.free.get(place)? as usize);
        // Nav2 puts it onto the point that it takes for the middle of the cell.
        let (across, up) = match self.place {
            CellPlace::Corner => (stream.unit(), stream.unit()),
            CellPlace::Centred => (0.0, 0.0),
        };
        let (x_m, y_m) = self.lattice.point_at(column as f64 + across, row as f64 + up);
        let yaw_rad = std::f64::consts::PI * (2.0 * stream.unit() - 1.0);
        Some(Pose2::new(x_m, y_m, yaw_rad))
    }
}

/// Turns points of the map into columns and rows.
#[derive(Clone, Copy, Debug)]
pub struct Finder {
    origin: Pose2,
    sine: f64,
    cosine: f64,
    scale: f64,
    shift: f64,
}

impl Finder {
    /// A point of the map \[m\] in cells and parts of them; cell `(i, j)` begins at `i` and `j`.
    #[must_use]
    pub fn cells_to(&self, x_m: f64, y_m: f64) -> (f64, f64) {
        let (x_m, y_m) = (x_m - self.origin.x_m, y_m - self.origin.y_m);
        let along = (self.cosine * x_m - self.sine * y_m) * self.scale;
        let across = (self.sine * x_m + self.cosine * y_m) * self.scale;
        (along + self.shift, across + self.shift)
    }

    /// The same to six digits, and faster.
    pub(crate) fn heading_f32(&self, yaw_rad: f64) -> (f32, f32) {
        let (sine, cosine) = libm::sincosf((yaw_rad - self.origin.yaw_rad) as f32);
        let scale = self.scale as f32;
        (cosine * scale, sine * scale)
    }

    /// A direction of the map along columns and rows, in cells for every metre.
    pub(crate) fn heading(&self, yaw_rad: f64) -> (f64, f64) {
        let (sine, cosine) = libm::sincos(yaw_rad - self.origin.yaw_rad);
        (cosine * self.scale, sine * self.scale)
    }
}
