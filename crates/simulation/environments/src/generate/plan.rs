//! Floor plans: rectangles and discs.

use super::WorldGeneratorParams;

/// Obstacles of a generated world, seen from above.
#[derive(Clone, Debug, Default)]
pub(super) struct FloorPlan {
    pub(super) boxes: Vec<PlanBox>,
    pub(super) cylinders: Vec<PlanCylinder>,
}

/// A box on the floor.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlanBox {
    pub(super) centre: [f64; 2],
    pub(super) size_m: [f64; 2],
    pub(super) yaw_rad: f64,
    pub(super) height_m: f64,
}

/// A cylinder on the floor.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlanCylinder {
    pub(super) centre: [f64; 2],
    pub(super) radius_m: f64,
    pub(super) height_m: f64,
}

/// Direction of a wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum WallAxis {
    X,
    Y,
}

/// Part of a line parallel to an axis: `at` across it, `from` and `to` along it \[m\].
#[derive(Clone, Copy, Debug)]
pub(super) struct WallLine {
    pub(super) axis: WallAxis,
    pub(super) at: f64,
    pub(super) from: f64,
    pub(super) to: f64,
}

impl FloorPlan {
    /// Adds a wall along a line; both ends are extended by half of the thickness, so that corners are closed.
    pub(super) fn add_wall(&mut self, line: WallLine, params: &WorldGeneratorParams) {
        let WallLine { axis, at, from, to } = line;
        if to - from <= 1e-9 {
            return;
        }
        let along_m = to - from + params.wall_thickness_m;
        let middle = (from + to) / 2.0;
        let (centre, size_m) = match axis {
            WallAxis::X => ([middle, at], [along_m, params.wall_thickness_m]),
            WallAxis::Y => ([at, middle], [params.wall_thickness_m, along_m]),
        };
        self.boxes.push(PlanBox { centre, size_m, yaw_rad: 0.0, height_m: params.wall_height_m });
    }

    /// Adds a wall with a door, whose middle is at `door` along the line.
    pub(super) fn add_wall_with_door(
        &mut self,
        line: WallLine,
        door: f64,
        params: &WorldGeneratorParams,
    ) {
        // The ends of walls are extended, those at the door must not be.
        let half_m = (params.door_width_m + params.wall_thickness_m) / 2.0;
        self.add_wall(WallLine { to: door - half_m, ..line }, params);
        self.add_wall(WallLine { from: door + half_m, ..line }, params);
    }

    /// Adds the four outer walls.
    pub(super) fn add_outer_walls(&mut self, params: &WorldGeneratorParams) {
        let [x, y] = [params.size_x_m / 2.0, params.size_y_m / 2.0];
        for at in [-y, y] {
            self.add_wall(WallLine { axis: WallAxis::X, at, from: -x, to: x }, params);
        }
        for at in [-x, x] {
            self.add_wall(WallLine { axis: WallAxis::Y, at, from: -y, to: y }, params);
        }
    }
}
