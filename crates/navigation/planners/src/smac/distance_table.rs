//! Lengths of the shortest curves to the goal, by relative cell and heading.
//!
//! Source of the rules: `nav2_smac_planner/src/distance_heuristic.cpp`.

use periplus_geometry::Pose2;

use super::curve::CurveFamily;
use super::headings::Headings;

/// Length that was not computed yet; zeroed memory costs nothing until it is used.
const UNSET_CELLS: f32 = 0.0;

/// Table of lengths around a goal. Nav2 fills it when it starts; here an entry is computed when it is first
/// read, with the same value.
#[derive(Debug)]
pub(crate) struct DistanceTable {
    family: CurveFamily,
    radius: f64,
    headings: Headings,
    /// Half of the side length \[cells\], rounded down; the table covers `-half..half` along x and
    /// `0..half` along y, and mirrors the rest.
    half: i64,
    /// Empty until the first request.
    lengths: Vec<f32>,
}

/// Pose \[cells, bins\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BinPose {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) bin: usize,
}

impl DistanceTable {
    /// Creates a table with an odd side length \[cells\].
    pub(crate) fn new(family: CurveFamily, radius: f64, headings: Headings, side: usize) -> Self {
        Self { family, radius, headings, half: (side / 2) as i64, lengths: Vec::new() }
    }

    /// Returns the angle of a bin \[rad\].
    pub(crate) fn angle_rad(&self, bin: usize) -> f64 {
        self.headings.angle_rad(bin)
    }

    /// Returns the length of the shortest curve between two poses; none outside the table. The last argument
    /// is sine and cosine of the angle from the goal's heading to 0.
    pub(crate) fn length(
        &mut self,
        from: BinPose,
        goal: BinPose,
        (sine, cosine): (f64, f64),
    ) -> Option<f32> {
        let (dx, dy) = (from.x - goal.x, from.y - goal.y);
        let x = libm::round(dx * cosine - dy * sine) as i64;
        let y = libm::round(dx * sine + dy * cosine) as i64;
        if x.abs() >= self.half || y.abs() >= self.half {
            return None;
        }
        let bins = self.headings.count();
        let turn = (from.bin + bins - goal.bin) % bins;
        let turn = if y < 0 { (bins - turn) % bins } else { turn };
        let (column, row) = ((x + self.half) as usize, y.unsigned_abs() as usize);
        let index = (column * (self.half as usize + 1) + row) * bins + turn;
        if self.lengths.is_empty() {
            let count = (2 * self.half as usize + 1) * (self.half as usize + 1) * bins;
            self.lengths = vec![UNSET_CELLS; count];
        }
        let stored = self.lengths[index];
        if stored != UNSET_CELLS {
            return Some(stored);
        }
        let relative = Pose2::new(x as f64, row as f64, self.angle_rad(turn));
        let length = self.direct(relative, Pose2::IDENTITY);
        self.lengths[index] = length;
        Some(length)
    }

    /// Returns the length of the shortest curve between two poses \[cells, rad\].
    pub(crate) fn direct(&self, from: Pose2, to: Pose2) -> f32 {
        self.family.shortest(from, to, self.radius).length() as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_those_of_curves_and_mirrored() {
        let mut table = DistanceTable::new(CurveFamily::Dubins, 4.0, Headings::uniform(72), 41);
        let goal = BinPose { x: 30.0, y: 30.0, bin: 0 };
        let from = |x, y, bin| BinPose { x, y, bin };
        assert_eq!(table.length(from(20.0, 30.0, 0), goal, (0.0, 1.0)), Some(10.0));
        let above = table.length(from(22.0, 33.0, 5), goal, (0.0, 1.0));
        let below = table.length(from(22.0, 27.0, 67), goal, (0.0, 1.0));
        assert!(above.is_some() && above == below);
        assert_eq!(table.length(from(60.0, 30.0, 0), goal, (0.0, 1.0)), None);
    }
}
