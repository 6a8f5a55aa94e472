//! Resolution cells of a radar, and the rays through them.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::DVec3;
use periplus_scene::RadarSpec;

/// Number of rays across an azimuth cell; rays have the same spacing in elevation. An odd number has a ray through
/// the centre of each cell.
const RAY_COUNT_PER_CELL: f64 = 3.0;

/// Maximum number of rays of a radar; more is assumed to be a mistake.
const MAX_RAY_COUNT: f64 = 1_048_576.0;

/// Share of a cell that is attributed to rounding when cells are counted.
const ROUNDING_RATIO: f64 = 1e-9;

/// Cells of equal width that cover an interval about zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct AngleCells {
    count: f64,
    pub(super) width_rad: f64,
}

impl AngleCells {
    /// Covers a field of view exactly, with cells of at most this width.
    fn new(fov_rad: f64, resolution_rad: f64) -> Self {
        let count = (fov_rad / resolution_rad - ROUNDING_RATIO).ceil().max(1.0);
        Self { count, width_rad: fov_rad / count }
    }

    /// Index of the cell that contains an angle; angles outside count as in the first or last cell.
    pub(super) fn index(&self, angle_rad: f64) -> i32 {
        let index = (angle_rad / self.width_rad + self.count / 2.0).floor();
        whole(index.clamp(0.0, self.count - 1.0))
    }

    /// Centre of a cell [rad].
    pub(super) fn centre_rad(&self, index: i32) -> f64 {
        (f64::from(index) + 0.5 - self.count / 2.0) * self.width_rad
    }
}

/// Index of the cell nearest to a value; cells of ranges and velocities are centred on multiples of their width.
pub(super) fn nearest_cell(value: f64, width: f64) -> i32 {
    whole((value / width).round())
}

/// Folds a radial velocity into the unambiguous interval `-max..max`: the phase of a pulse-Doppler radar is known
/// only up to full turns.
pub(super) fn fold(velocity_m_per_s: f64, max_m_per_s: f64) -> f64 {
    let turns = (velocity_m_per_s / (2.0 * max_m_per_s)).round();
    velocity_m_per_s - turns * 2.0 * max_m_per_s
}

/// A direction in the frame of the sensor, with its cell and solid angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RadarRay {
    pub(super) direction: DVec3,
    pub(super) azimuth_cell: i32,
    pub(super) elevation_cell: i32,
    /// Solid angle [sr].
    pub(super) solid_angle_sr: f64,
}

/// Angular cells of a radar with the rays that sample them, row by row from the lowest.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct RadarRays {
    pub(super) azimuth: AngleCells,
    pub(super) elevation: AngleCells,
    pub(super) columns: usize,
    pub(super) rays: Vec<RadarRay>,
}

impl RadarRays {
    pub(super) fn new(spec: &RadarSpec) -> Result<Self, Box<Diagnostic>> {
        let azimuth = AngleCells::new(spec.horizontal_fov_rad, spec.azimuth_resolution_rad);
        let elevation = AngleCells::new(spec.vertical_fov_rad, spec.elevation_resolution_rad);
        let columns = azimuth.count * RAY_COUNT_PER_CELL;
        let spacing_rad = azimuth.width_rad / RAY_COUNT_PER_CELL;
        let per_cell = (elevation.width_rad / spacing_rad - ROUNDING_RATIO).ceil().max(1.0);
        // An odd number, so that a row passes through the centre.
        let rows = elevation.count * (per_cell + (per_cell + 1.0) % 2.0);
        if columns * rows > MAX_RAY_COUNT {
            return Err(Diagnostic::error(
                "out-of-range",
                format!("a radar with {columns:.0} x {rows:.0} rays is not supported"),
            )
            .help(format!(
                "at most {MAX_RAY_COUNT:.0} rays, {RAY_COUNT_PER_CELL} across each azimuth cell: use a larger \
                 `<azimuth_resolution>` or a smaller field of view"
            ))
            .into());
        }
        let (column_rad, row_rad) =
            (spec.horizontal_fov_rad / columns, spec.vertical_fov_rad / rows);
        let angle = |index: i32, count: f64, step_rad: f64| {
            (f64::from(index) + 0.5 - count / 2.0) * step_rad
        };
        let mut rays = Vec::new();
        for row in 0..whole(rows) {
            let elevation_rad = angle(row, rows, row_rad);
            let (up, level) = libm::sincos(elevation_rad);
            for column in 0..whole(columns) {
                let azimuth_rad = angle(column, columns, column_rad);
                let (left, ahead) = libm::sincos(azimuth_rad);
                rays.push(RadarRay {
                    direction: DVec3::new(level * ahead, level * left, up),
                    azimuth_cell: azimuth.index(azimuth_rad),
                    elevation_cell: elevation.index(elevation_rad),
                    solid_angle_sr: column_rad * row_rad * level,
                });
            }
        }
        Ok(Self { azimuth, elevation, columns: columns as usize, rays })
    }
}

/// Converts a whole number of moderate size.
#[expect(clippy::cast_possible_truncation, reason = "saturates, and cells are fewer")]
fn whole(number: f64) -> i32 {
    number as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1.0 rad in cells of at most 0.3 rad: four of 0.25 rad, centred at ±0.125 and ±0.375.
    #[test]
    fn cells_cover_the_field_of_view_exactly() {
        let cells = AngleCells::new(1.0, 0.3);
        assert_eq!((cells.count, cells.width_rad), (4.0, 0.25));
        let centres: Vec<f64> = (0..4).map(|index| cells.centre_rad(index)).collect();
        assert_eq!(centres, [-0.375, -0.125, 0.125, 0.375]);
        for (angle_rad, index) in [(-0.6, 0), (-0.3, 0), (-0.01, 1), (0.01, 2), (0.49, 3)] {
            assert_eq!(cells.index(angle_rad), index, "{angle_rad}");
        }
    }

    /// With ±10 m/s a target at 13 m/s shows at -7 m/s.
    #[test]
    fn velocities_beyond_the_maximum_wrap_around() {
        for (true_m_per_s, seen_m_per_s) in [(13.0, -7.0), (-13.0, 7.0), (9.0, 9.0), (25.0, 5.0)] {
            assert_eq!(fold(true_m_per_s, 10.0), seen_m_per_s);
        }
    }

    /// The solid angle of a field of view a by e is 2 a sin(e / 2).
    #[test]
    fn rays_share_the_solid_angle() {
        let spec = RadarSpec {
            horizontal_fov_rad: 0.9,
            vertical_fov_rad: 0.3,
            azimuth_resolution_rad: 0.03,
            elevation_resolution_rad: 0.1,
            ..RadarSpec::default()
        };
        let rays = RadarRays::new(&spec).unwrap();
        // 30 cells of 3 rays; 3 cells of 11 rays, which is the next odd number after 10.
        assert_eq!((rays.columns, rays.rays.len()), (90, 90 * 33));
        let sum_sr: f64 = rays.rays.iter().map(|ray| ray.solid_angle_sr).sum();
        assert!((sum_sr - 1.8 * libm::sin(0.15)).abs() < 1e-5, "{sum_sr}");
        let ahead = rays.rays[16 * 90 + 1 + 45].direction;
        assert!(ahead.z.abs() < 1e-12, "{ahead}");
    }
}
