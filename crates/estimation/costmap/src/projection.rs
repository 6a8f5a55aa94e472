//! Projection of laser scans to points.
//!
//! Source of the rules: `laser_geometry.cpp`, and `ObstacleLayer::laserScanValidInfCallback`.

use periplus_geometry::Pose;

/// Distance below the maximum range at which an infinite range is assumed \[m\].
const INF_RANGE_MARGIN_M: f32 = 1e-4;

/// Beam geometry of a laser scanner.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ScanGeometry {
    /// Angle of the first beam \[rad\].
    pub angle_min_rad: f32,
    /// Angle between beams \[rad\].
    pub angle_increment_rad: f32,
    /// Minimum range; shorter ones are invalid \[m\].
    pub range_min_m: f32,
    /// Maximum range; ranges from here on are invalid \[m\].
    pub range_max_m: f32,
}

/// Converter from scans to points that caches the beam directions.
#[derive(Clone, Debug, Default)]
pub struct Projector {
    beams: ScanGeometry,
    directions: Vec<[f64; 2]>,
}

impl Projector {
    /// Iterates over the points of a scan, in the frame of the scanner \[m\]. Valid ranges are from
    /// `range_min_m` up to and excluding `range_max_m`. With `inf_is_valid` an infinite range
    /// becomes one just below the maximum.
    pub fn points<'a>(
        &'a mut self,
        beams: ScanGeometry,
        ranges_m: &'a [f32],
        inf_is_valid: bool,
    ) -> impl Iterator<Item = [f32; 3]> + 'a {
        self.returns(beams, ranges_m, inf_is_valid).map(|(_, point)| point)
    }

    /// Iterates over the points of a scanner that moves during the scan, in the frame of the two
    /// poses, those at the first and at the last beam.
    pub fn points_in_motion<'a>(
        &'a mut self,
        beams: ScanGeometry,
        ranges_m: &'a [f32],
        inf_is_valid: bool,
        global_from_first: Pose,
        global_from_last: Pose,
    ) -> impl Iterator<Item = [f32; 3]> + 'a {
        let last = ranges_m.len().saturating_sub(1).max(1) as f64;
        let (from, to) = (global_from_first, global_from_last);
        self.returns(beams, ranges_m, inf_is_valid).map(move |(index, [x, y, z])| {
            let part = index as f64 / last;
            let global_from_now = Pose {
                translation: from.translation.lerp(to.translation, part),
                rotation: from.rotation.lerp(to.rotation, part),
            };
            let in_scanner = periplus_geometry::DVec3::new(x.into(), y.into(), z.into());
            let point = global_from_now.transform_point(in_scanner);
            [point.x as f32, point.y as f32, point.z as f32]
        })
    }

    fn returns<'a>(
        &'a mut self,
        beams: ScanGeometry,
        ranges_m: &'a [f32],
        inf_is_valid: bool,
    ) -> impl Iterator<Item = (usize, [f32; 3])> + 'a {
        self.aim(beams, ranges_m.len());
        let ScanGeometry { range_min_m, range_max_m, .. } = beams;
        let pairs = ranges_m.iter().zip(&self.directions).enumerate();
        pairs.filter_map(move |(index, (&range_m, [cosine, sine]))| {
            let is_replaced = inf_is_valid && range_m == f32::INFINITY;
            let range_m = if is_replaced { range_max_m - INF_RANGE_MARGIN_M } else { range_m };
            (range_m >= range_min_m && range_m < range_max_m).then(|| {
                let range_m = f64::from(range_m);
                (index, [(range_m * cosine) as f32, (range_m * sine) as f32, 0.0])
            })
        })
    }

    /// Recomputes the directions if the beam geometry has changed.
    fn aim(&mut self, beams: ScanGeometry, count: usize) {
        let is_same = self.directions.len() >= count
            && self.beams.angle_min_rad.to_bits() == beams.angle_min_rad.to_bits()
            && self.beams.angle_increment_rad.to_bits() == beams.angle_increment_rad.to_bits();
        if is_same {
            return;
        }
        self.beams = beams;
        self.directions.clear();
        let (start, step) = (f64::from(beams.angle_min_rad), f64::from(beams.angle_increment_rad));
        self.directions.extend((0..count).map(|index| {
            let (sine, cosine) = libm::sincos(start + index as f64 * step);
            [cosine, sine]
        }));
    }
}

#[cfg(test)]
mod tests {
    use std::f32::consts::FRAC_PI_2;

    use super::*;

    const BEAMS: ScanGeometry = ScanGeometry {
        angle_min_rad: 0.0,
        angle_increment_rad: FRAC_PI_2,
        range_min_m: 0.5,
        range_max_m: 10.0,
    };

    #[test]
    fn ranges_within_the_limits_have_points() {
        let ranges_m = [0.5, 10.0, f32::INFINITY, 0.4, f32::NAN, 2.0];
        let mut projector = Projector::default();
        let points: Vec<_> = projector.points(BEAMS, &ranges_m, false).collect();
        assert_eq!(points.len(), 2);
        assert_eq!(points[0], [0.5, 0.0, 0.0]);
        let points: Vec<_> = projector.points(BEAMS, &ranges_m, true).collect();
        assert_eq!(points.len(), 3);
        assert!((points[1][0] + 9.9999).abs() < 1e-5, "{:?}", points[1]);
    }

    #[test]
    fn a_scanner_in_motion() {
        let mut projector = Projector::default();
        let beams = ScanGeometry { angle_increment_rad: 0.0, ..BEAMS };
        let to = Pose::from_xyz(2.0, 0.0, 0.3);
        let points: Vec<_> = projector
            .points_in_motion(beams, &[1.0, 1.0, 1.0], false, Pose::IDENTITY, to)
            .collect();
        assert_eq!(points, [[1.0, 0.0, 0.0], [2.0, 0.0, 0.15], [3.0, 0.0, 0.3]]);
    }
}
