//! Footprint of the robot.
//!
//! Source: `nav2_costmap_2d/src/footprint.cpp`, `array_parser.cpp`, `footprint_collision_checker.cpp`.

use std::f64::consts::PI;

use periplus_geometry::Pose2;
use periplus_grid::{Cell, Line};

use crate::{Costmap, FootprintError, cost};

/// Number of corners of a circle; the value of Nav2.
const CIRCLE_CORNERS: usize = 16;

/// Polygon in the base frame of the robot, with the radii that follow from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Footprint {
    points: Vec<[f64; 2]>,
    /// Radius of the largest circle around the base inside the footprint \[m\].
    pub inscribed_radius_m: f64,
    /// Radius of the smallest circle around the base that contains the footprint \[m\].
    pub circumscribed_radius_m: f64,
}

impl Default for Footprint {
    /// No polygon; the radii are the initial values of a layered costmap of Nav2.
    fn default() -> Self {
        Self { points: Vec::new(), inscribed_radius_m: 0.1, circumscribed_radius_m: 1.0 }
    }
}

impl Footprint {
    /// Creates a footprint from corners \[m\], in order around the robot.
    #[must_use]
    pub fn new(points: Vec<[f64; 2]>) -> Self {
        let (inscribed_radius_m, circumscribed_radius_m) = radii(&points);
        Self { points, inscribed_radius_m, circumscribed_radius_m }
    }

    /// Creates a circle, as a polygon with 16 corners.
    #[must_use]
    pub fn circle(radius_m: f64) -> Self {
        let corner = |index: usize| {
            let (sine, cosine) = libm::sincos(index as f64 * 2.0 * PI / CIRCLE_CORNERS as f64);
            [cosine * radius_m, sine * radius_m]
        };
        Self::new((0..CIRCLE_CORNERS).map(corner).collect())
    }

    /// Parses a text such as `[[0.2, 0.1], [0.2, -0.1], [-0.2, 0]]`. As in Nav2, numbers are
    /// rounded to single precision.
    /// # Errors
    /// The first mistake.
    pub fn read(text: &str) -> Result<Self, FootprintError> {
        let points = read_points(text)?;
        match points.len() {
            3.. => Ok(Self::new(points)),
            count => Err(FootprintError::TooFewCorners(count)),
        }
    }

    /// Returns the footprint with every coordinate moved away from the base by a padding \[m\].
    #[must_use]
    pub fn padded(&self, padding_m: f64) -> Self {
        // Coordinates that are zero but for rounding are moved by the whole padding as well.
        let away = |at: f64| {
            if at == 0.0 { at } else { at + padding_m * at.signum() }
        };
        Self::new(self.points.iter().map(|[x, y]| [away(*x), away(*y)]).collect())
    }

    /// Returns the corners, in the base frame \[m\].
    #[must_use]
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// Returns the corners in the global frame \[m\] of a robot at `global_from_base`.
    #[must_use]
    pub fn placed(&self, global_from_base: Pose2) -> Vec<[f64; 2]> {
        let (sine, cosine) = libm::sincos(global_from_base.yaw_rad);
        let place = |[x, y]: &[f64; 2]| {
            [
                global_from_base.x_m + (x * cosine - y * sine),
                global_from_base.y_m + (x * sine + y * cosine),
            ]
        };
        self.points.iter().map(place).collect()
    }

    /// Returns the cost of the footprint at a pose; see [`outline_cost`].
    #[must_use]
    pub fn cost(&self, costmap: &Costmap, global_from_base: Pose2) -> u8 {
        outline_cost(costmap, &self.placed(global_from_base))
    }
}

/// Returns the cost of the outline of a polygon in the global frame \[m\]: the highest cost along
/// its sides, up to the first lethal one. A side with a lethal cell is lethal even if it has
/// unknown cells; a corner outside the grid is lethal. Cells inside the outline are ignored.
#[must_use]
pub fn outline_cost(costmap: &Costmap, corners: &[[f64; 2]]) -> u8 {
    let finder = costmap.finder();
    let cells: Option<Vec<_>> =
        corners.iter().map(|[x_m, y_m]| finder.cell_of(*x_m, *y_m)).collect();
    let Some(cells) = cells.filter(|cells| !cells.is_empty()) else { return cost::LETHAL };
    let sides = cells.iter().zip(cells.iter().cycle().skip(1));
    let mut highest = cost::FREE;
    for (start, end) in sides {
        highest = highest.max(side_cost(costmap, *start, *end));
        if highest == cost::LETHAL {
            break;
        }
    }
    highest
}

/// Returns the highest cost on a line of cells, or lethal if one of them is.
fn side_cost(costmap: &Costmap, start: Cell, end: Cell) -> u8 {
    let mut highest = cost::FREE;
    for cost in Line::between(start, end).filter_map(|cell| costmap.cost(cell)) {
        if cost == cost::LETHAL {
            return cost;
        }
        highest = highest.max(cost);
    }
    highest
}

/// Returns the distance from the base to the nearest point of the outline and to the furthest
/// corner \[m\]. With fewer than three corners they are `f64::MAX` and 0.
#[must_use]
pub fn radii(points: &[[f64; 2]]) -> (f64, f64) {
    if points.len() < 3 {
        return (f64::MAX, 0.0);
    }
    let mut nearest = f64::MAX;
    let mut furthest: f64 = 0.0;
    for (index, &start) in points.iter().enumerate() {
        let end = points[(index + 1) % points.len()];
        let corner = libm::hypot(start[0], start[1]);
        nearest = nearest.min(corner).min(distance_to_side_m([0.0, 0.0], start, end));
        furthest = furthest.max(corner);
    }
    (nearest, furthest)
}

/// Returns the distance of a point from the line between two corners \[m\].
#[must_use]
pub fn distance_to_side_m([x, y]: [f64; 2], start: [f64; 2], end: [f64; 2]) -> f64 {
    let (along_x, along_y) = (end[0] - start[0], end[1] - start[1]);
    let (from_x, from_y) = (x - start[0], y - start[1]);
    let length_squared = along_x * along_x + along_y * along_y;
    let part = (from_x * along_x + from_y * along_y) / length_squared;
    // For two equal corners the fraction is NaN, and the comparison below selects the first.
    let part = if part > 0.0 { part.min(1.0) } else { 0.0 };
    libm::hypot(from_x - part * along_x, from_y - part * along_y)
}

/// Parses lists of numbers in brackets, separated by commas, blanks and tabs.
fn read_points(text: &str) -> Result<Vec<[f64; 2]>, FootprintError> {
    let mut points = Vec::new();
    let mut numbers: Vec<f64> = Vec::new();
    let mut depth = 0;
    let mut rest = text.trim();
    while let Some(first) = rest.chars().next() {
        match first {
            '[' if depth < 2 => depth += 1,
            '[' => return Err(FootprintError::TooDeep),
            ']' if depth == 2 => {
                let [x, y] = numbers[..] else {
                    return Err(FootprintError::CornerLength(numbers.len()));
                };
                points.push([x, y]);
                numbers.clear();
                depth = 1;
            }
            ']' if depth == 1 => depth = 0,
            ']' => return Err(FootprintError::UnopenedBracket),
            ',' | ' ' | '\t' | '\n' | '\r' => {}
            _ => {
                let end = rest.find([',', ' ', '\t', '\n', '\r', '[', ']']).unwrap_or(rest.len());
                let (word, after) = rest.split_at(end);
                if depth < 2 {
                    return Err(FootprintError::OutsideCorner(word.to_owned()));
                }
                let number: f32 =
                    word.parse().map_err(|_| FootprintError::NotNumber(word.to_owned()))?;
                if !number.is_finite() {
                    return Err(FootprintError::NotFinite(word.to_owned()));
                }
                numbers.push(f64::from(number));
                rest = after;
                continue;
            }
        }
        rest = &rest[first.len_utf8()..];
    }
    if depth == 0 { Ok(points) } else { Err(FootprintError::UnclosedBracket) }
}

#[cfg(test)]
mod tests {
    use periplus_grid::GridInfo;

    use super::*;

    #[test]
    fn a_footprint_is_read_and_padded() {
        let footprint = Footprint::read("[[1, 1] [-1.0e0,1]\t[-1, -1]]").unwrap().padded(0.5);
        assert_eq!(footprint.points(), [[1.5, 1.5], [-1.5, 1.5], [-1.5, -1.5]]);
        let square = Footprint::read("[[2,1],[2,-1],[-2,-1],[-2,1]]").unwrap();
        assert_eq!(square.inscribed_radius_m, 1.0);
        assert!((square.circumscribed_radius_m - 5.0_f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn mistakes_in_a_footprint_are_reported() {
        let wrong = |text: &str| Footprint::read(text).unwrap_err().to_string();
        assert_eq!(wrong("[]"), "it has 0 corners, and a footprint needs at least three");
        assert_eq!(wrong("[[1, 2, 3]]"), "a corner needs x and y, and one has 3 numbers");
        assert_eq!(wrong("[[1, a]]"), "`a` is not a number");
        assert_eq!(wrong("[[1, nan]]"), "`nan` is not a finite number");
        assert_eq!(wrong("[1, 2]"), "`1` is outside the brackets of a corner");
        assert_eq!(wrong("[[1, 2]"), "a bracket is not closed");
        assert_eq!(wrong("]"), "a bracket closes that was not opened");
        assert!(wrong("[[[").contains("deeper"));
    }

    #[test]
    fn a_circle_is_padded_as_nav2_pads_it() {
        let circle = Footprint::circle(0.1).padded(0.01);
        assert_eq!(circle.points().len(), 16);
        assert!((circle.points()[0][0] - 0.11).abs() < 1e-12);
        assert_eq!(circle.points()[0][1], 0.0, "exactly zero is not moved");
        assert!((circle.points()[4][0] - 0.01).abs() < 1e-12, "a rounding error is");
    }

    #[test]
    fn the_outline_counts_and_not_what_it_holds() {
        let info = GridInfo::new(1.0, 9, 9, Pose2::IDENTITY).unwrap();
        let mut costmap = Costmap::new(info, 0);
        let square = Footprint::read("[[2,2],[2,-2],[-2,-2],[-2,2]]").unwrap();
        let cost = |costmap: &Costmap, x| square.cost(costmap, Pose2::new(x, 4.5, 0.0));
        costmap.set((4, 4), 254);
        assert_eq!(cost(&costmap, 4.5), 0);
        costmap.set((6, 4), 100);
        assert_eq!(cost(&costmap, 4.5), 100);
        assert_eq!(cost(&costmap, 0.5), 254, "corners are outside");
    }
}
