//! Headings of a search.

use std::f64::consts::PI;

use periplus_geometry::normalize_angle;

/// Headings by bin.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Headings {
    /// Angles in [0, 2π) \[rad\], rising.
    angles_rad: Vec<f64>,
    is_uniform: bool,
}

impl Headings {
    /// Creates headings at equal distances.
    pub(crate) fn uniform(count: usize) -> Self {
        let count = count.max(1);
        let angle = |bin: usize| 2.0 * PI * bin as f64 / count as f64;
        Self { angles_rad: (0..count).map(angle).collect(), is_uniform: true }
    }

    /// Creates headings from a list of angles \[rad\].
    pub(crate) fn listed(angles_rad: Vec<f64>) -> Self {
        Self { angles_rad, is_uniform: false }
    }

    pub(crate) fn count(&self) -> usize {
        self.angles_rad.len()
    }

    /// Returns the angle of a bin \[rad\]; 0 for a bin that does not exist.
    pub(crate) fn angle_rad(&self, bin: usize) -> f64 {
        self.angles_rad.get(bin).copied().unwrap_or(0.0)
    }

    /// Returns the bin nearest to an angle \[rad\].
    pub(crate) fn nearest(&self, angle_rad: f64) -> usize {
        if self.is_uniform {
            let bin = libm::round(angle_rad / (2.0 * PI) * self.count() as f64) as i64;
            return bin.rem_euclid(self.count() as i64) as usize;
        }
        let miss = |bin: &usize| normalize_angle(angle_rad - self.angle_rad(*bin)).abs();
        (0..self.count()).min_by(|a, b| miss(a).total_cmp(&miss(b))).unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_heading_is_found_around_the_circle() {
        let uniform = Headings::uniform(72);
        assert_eq!(uniform.nearest(-0.01), 0);
        assert_eq!(uniform.nearest(-PI / 2.0), 54);
        let listed = Headings::listed(vec![0.0, 0.46, PI / 4.0, 1.1, PI / 2.0]);
        assert_eq!([0.3, 6.2, 1.5].map(|angle| listed.nearest(angle)), [1, 0, 4]);
    }
}
