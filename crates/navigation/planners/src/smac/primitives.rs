//! Motion primitives of Hybrid-A* and the cost of a step.
//!
//! Source of the rules: `nav2_smac_planner/src/node_hybrid.cpp`; S. M. LaValle, "Planning Algorithms",
//! section 15.3.

use std::f64::consts::{PI, SQRT_2};

use periplus_params::param_choice;

use super::curve::CurveFamily;

param_choice! {
    /// Motion model of Hybrid-A*: `motion_model_for_search`.
    pub enum SmacMotionModel {
        /// A car that only drives forwards.
        #[default]
        Dubin = "DUBIN",
        /// A car that drives forwards and backwards.
        ReedsShepp = "REEDS_SHEPP",
    }
}

impl SmacMotionModel {
    /// Returns the family of its shortest curves.
    pub(crate) fn curves(self) -> CurveFamily {
        match self {
            Self::Dubin => CurveFamily::Dubins,
            Self::ReedsShepp => CurveFamily::ReedsShepp,
        }
    }
}

/// Direction of a motion primitive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TurnDirection {
    /// Straight forwards.
    Forward,
    /// Forwards to the left.
    Left,
    /// Forwards to the right.
    Right,
    /// Straight backwards.
    Reverse,
    /// Backwards with the wheels to the left.
    ReverseLeft,
    /// Backwards with the wheels to the right.
    ReverseRight,
}

impl TurnDirection {
    /// Returns true for straight motions.
    #[must_use]
    pub fn is_straight(self) -> bool {
        matches!(self, Self::Forward | Self::Reverse)
    }

    /// Returns true for motions backwards.
    #[must_use]
    pub fn is_reverse(self) -> bool {
        matches!(self, Self::Reverse | Self::ReverseLeft | Self::ReverseRight)
    }
}

/// Motion from a pose at the origin with heading 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionPrimitive {
    /// Displacement \[cells\].
    pub x: f64,
    /// Displacement \[cells\].
    pub y: f64,
    /// Change of the heading \[bins\].
    pub bins: i32,
    /// Direction.
    pub turn: TurnDirection,
    /// Length of the arc or the straight motion \[cells\].
    pub travel: f64,
}

/// Motion primitives for a turning radius and a number of headings.
#[derive(Clone, Debug, PartialEq)]
pub struct PrimitiveSet {
    /// Number of bins of a turn of minimum radius.
    pub increments: i32,
    /// All primitives: straight, turns of minimum radius, and wider turns.
    pub primitives: Vec<MotionPrimitive>,
}

impl PrimitiveSet {
    /// Creates the primitives of a model. A primitive turns by a whole number of bins and leaves its cell:
    /// its chord is at least the diagonal of a cell. With interpolation there is also a turn for each
    /// smaller number of bins, on wider arcs with the same chord.
    #[must_use]
    pub fn new(
        model: SmacMotionModel,
        min_radius_cells: f64,
        bin_count: usize,
        interpolates: bool,
    ) -> Self {
        let bin_rad = 2.0 * PI / bin_count.max(1) as f64;
        let chord_rad = 2.0 * libm::asin((SQRT_2 / (2.0 * min_radius_cells)).min(1.0));
        // Rounding up must not add a bin when the angle is a whole number of bins.
        const ROUNDING_BINS: f64 = 1e-6;
        let increments = libm::ceil(chord_rad / bin_rad - ROUNDING_BINS).max(1.0);
        let angle = increments * bin_rad;
        let (dx, dy) = (
            min_radius_cells * libm::sin(angle),
            min_radius_cells - min_radius_cells * libm::cos(angle),
        );
        let chord = libm::hypot(dx, dy);
        let straight = |x: f64, turn| MotionPrimitive { x, y: 0.0, bins: 0, turn, travel: chord };
        let turn = |bins: i32, (x, y): (f64, f64), turn| {
            let arc = f64::from(bins.abs()) * bin_rad;
            let radius = chord / (2.0 * libm::sin(arc / 2.0));
            MotionPrimitive { x, y, bins, turn, travel: radius * arc }
        };
        let mut primitives = vec![straight(chord, TurnDirection::Forward)];
        let increments = increments as i32;
        let turns = |bins: i32, (x, y): (f64, f64), is_reverse: bool| {
            if is_reverse {
                [
                    turn(-bins, (-x, y), TurnDirection::ReverseLeft),
                    turn(bins, (-x, -y), TurnDirection::ReverseRight),
                ]
            } else {
                [
                    turn(bins, (x, y), TurnDirection::Left),
                    turn(-bins, (x, -y), TurnDirection::Right),
                ]
            }
        };
        primitives.extend(turns(increments, (dx, dy), false));
        let is_reversing = model == SmacMotionModel::ReedsShepp;
        if is_reversing {
            primitives.push(straight(-chord, TurnDirection::Reverse));
            primitives.extend(turns(increments, (dx, dy), true));
        }
        for bins in 1..increments.max(1) {
            if !interpolates {
                break;
            }
            let arc = f64::from(bins) * bin_rad;
            let radius = chord / (2.0 * libm::sin(arc / 2.0));
            let end = (radius * libm::sin(arc), radius - radius * libm::cos(arc));
            primitives.extend(turns(bins, end, false));
            if is_reversing {
                primitives.extend(turns(bins, end, true));
            }
        }
        Self { increments, primitives }
    }
}

/// Weights of the cost of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepPenalties {
    /// Part of the length that is not charged, so that the search prefers later parts of the path.
    pub retrospective: f64,
    /// Weight of the costs of cells.
    pub cost: f64,
    /// Factor of turns.
    pub non_straight: f64,
    /// Addition to the factor of turns that change the direction.
    pub change: f64,
    /// Factor of motions backwards.
    pub reverse: f64,
    /// True if the costs of cells count squared.
    pub is_quadratic: bool,
}

impl StepPenalties {
    /// Returns the factor of the length of a step into a cell of this cost.
    #[must_use]
    pub fn cell_factor(&self, cell_cost: f64) -> f64 {
        let normalized = cell_cost / 252.0;
        let cost = if self.is_quadratic { normalized * normalized } else { normalized };
        1.0 - self.retrospective + self.cost * cost
    }

    /// Returns the factor of the direction of a step after another step; none before it at the start.
    #[must_use]
    pub fn turn_factor(&self, before: Option<TurnDirection>, turn: TurnDirection) -> f64 {
        let turning = match before {
            Some(before) if !turn.is_straight() => {
                self.non_straight + if before == turn { 0.0 } else { self.change }
            }
            _ => 1.0,
        };
        if turn.is_reverse() { turning * self.reverse } else { turning }
    }

    /// Returns the cost of a step of a length \[cells\].
    #[must_use]
    pub fn step_cost(
        &self,
        travel: f64,
        cell_cost: f64,
        before: Option<TurnDirection>,
        turn: TurnDirection,
    ) -> f64 {
        travel * self.cell_factor(cell_cost) * self.turn_factor(before, turn)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_have_whole_bins_and_leave_their_cell() {
        for (radius, increments) in [(4.0, 5), (8.0, 3), (40.0, 1), (1.0, 18)] {
            let set = PrimitiveSet::new(SmacMotionModel::Dubin, radius, 72, false);
            assert_eq!(set.increments, increments, "{radius}");
            assert_eq!(set.primitives.len(), 3);
            assert!(set.primitives[0].travel >= SQRT_2 - 1e-9);
        }
        let all = PrimitiveSet::new(SmacMotionModel::ReedsShepp, 8.0, 72, true);
        assert_eq!(all.primitives.len(), 14);
    }
}
