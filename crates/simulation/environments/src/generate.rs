//! Generators of worlds: the same name, parameters and seed give the same world.

mod assemble;
mod caves;
mod cellular;
mod cylinders;
mod maze;
mod offices;
mod plan;
mod rooms;

use periplus_geometry::Stream;
use periplus_params::{param_choice, params};
use periplus_scene::World;

use self::plan::FloorPlan;

param_choice! {
    /// Kind of a generated world.
    pub enum WorldKind {
        /// Rooms with doors and furniture, by recursive division of a rectangle.
        #[default]
        Rooms = "rooms",
        /// Offices with furniture on both sides of a corridor.
        Offices = "offices",
        /// Maze of corridors.
        Maze = "maze" | "mazes",
        /// Field of thin cylinders, similar to the worlds of the BARN challenge.
        Cylinders = "cylinders" | "barn",
        /// Caves with irregular walls.
        Caves = "caves" | "cave",
    }
}

params! {
    /// A generated world.
    #[table(WORLD_GENERATOR, "a world generator")]
    pub struct WorldGeneratorParams {
        /// Kind of the world: `rooms`, `offices`, `maze`, `cylinders` or `caves`.
        #[param("kind")]
        kind: WorldKind = "rooms",
        /// Length along x, between the middles of the outer walls.
        #[param("size_x", unit("m"), within(3.0, 200.0))]
        size_x_m: f64 = 12,
        /// Length along y, between the middles of the outer walls.
        #[param("size_y", unit("m"), within(3.0, 200.0))]
        size_y_m: f64 = 10,
        /// Amount of obstacles, from 0 to 1: furniture, cylinders, rock, dead ends.
        #[param("clutter", within(0.0, 1.0))]
        clutter: f64 = 0.5,
        /// Width of doors; corridors are 0.5 m wider.
        #[param("door_width", unit("m"), within(0.4, 10.0))]
        door_width_m: f64 = 1,
        /// Thickness of walls.
        #[param("wall_thickness", unit("m"), within(0.02, 1.0))]
        wall_thickness_m: f64 = 0.15,
        /// Height of walls.
        #[param("wall_height", unit("m"), within(0.05, 20.0))]
        wall_height_m: f64 = 1.5,
    }
}

/// Generates a world with its centre at the origin: a floor, static walls and obstacles, and a light. The ordinary
/// simulation loads it as well, also as SDF.
#[must_use]
pub fn generate_world(params: &WorldGeneratorParams, seed: u64) -> World {
    let name = periplus_params::ParamChoice::word(params.kind);
    let mut stream = Stream::keyed(seed, name, 0);
    let mut plan = FloorPlan::default();
    match params.kind {
        WorldKind::Rooms => rooms::build(params, &mut stream, &mut plan),
        WorldKind::Offices => offices::build(params, &mut stream, &mut plan),
        WorldKind::Maze => maze::build(params, &mut stream, &mut plan),
        WorldKind::Cylinders => cylinders::build(params, &mut stream, &mut plan),
        WorldKind::Caves => caves::build(params, &mut stream, &mut plan),
    }
    assemble::world(&plan, params, &format!("{name}_{seed}"))
}

/// Draws a number from a range.
fn between(stream: &mut Stream, low: f64, high: f64) -> f64 {
    low + (high - low) * stream.unit()
}

/// Draws a whole number below a limit.
fn below(stream: &mut Stream, limit: usize) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "limits are small"
    )]
    let drawn = (stream.unit() * limit as f64) as usize;
    drawn.min(limit.saturating_sub(1))
}

/// Returns the number of whole cells in a length.
fn count_of(length_m: f64, cell_m: f64) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "lengths are limited"
    )]
    let count = (length_m / cell_m).round().max(1.0) as usize;
    count
}

/// Returns a count as a number.
fn real(count: usize) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "counts are small")]
    let value = count as f64;
    value
}

#[cfg(test)]
mod tests {
    use periplus_params::ParamChoice as _;
    use periplus_rendering::NoAssets;
    use periplus_scene::Shape;

    use super::*;
    use crate::parameters::EnvironmentRobotParams;
    use crate::robot::EnvironmentRobot;
    use crate::world::NavigationWorld;

    const KINDS: [WorldKind; 5] = [
        WorldKind::Rooms,
        WorldKind::Offices,
        WorldKind::Maze,
        WorldKind::Cylinders,
        WorldKind::Caves,
    ];

    fn params(kind: WorldKind) -> WorldGeneratorParams {
        WorldGeneratorParams { kind, ..WorldGeneratorParams::default() }
    }

    #[test]
    fn the_table_has_no_faults() {
        assert_eq!(WORLD_GENERATOR.faults(), Vec::<String>::new());
    }

    #[test]
    fn a_seed_gives_one_world() {
        for kind in KINDS {
            let [one, again, other] =
                [7, 7, 8].map(|seed| generate_world(&params(kind), seed).models);
            assert_eq!(one, again, "{}", kind.word());
            assert!(one != other, "{}", kind.word());
        }
    }

    /// A robot with a radius of 0.2 m reaches most of every world, and nothing outside of it.
    #[test]
    fn most_of_each_world_is_connected() {
        let robot = EnvironmentRobot::new(EnvironmentRobotParams::default()).expect("a robot");
        for kind in KINDS {
            let mut total_m2 = 0.0;
            for seed in 0..12 {
                let world = generate_world(&params(kind), seed);
                let (world, diagnostics) = NavigationWorld::new(&world, &robot, &NoAssets, 1);
                assert!(!diagnostics.has_errors(), "{} {seed}", kind.word());
                let free = world.free_space();
                assert!(!free.contains([6.5, 0.0]) && !free.contains([0.0, 5.5]), "outside");
                let minimum_m2 = match kind {
                    WorldKind::Cylinders => 8.0,
                    WorldKind::Caves => 20.0,
                    _ => 40.0,
                };
                assert!(
                    free.area_m2() > minimum_m2,
                    "{} {seed}: {} m²",
                    kind.word(),
                    free.area_m2()
                );
                total_m2 += free.area_m2();
            }
            assert!(total_m2 / 12.0 < 100.0, "{}: there are obstacles", kind.word());
        }
    }

    /// More clutter leaves less space.
    #[test]
    fn clutter_takes_space() {
        let robot = EnvironmentRobot::new(EnvironmentRobotParams::default()).expect("a robot");
        for kind in [WorldKind::Rooms, WorldKind::Cylinders, WorldKind::Caves] {
            let [little, much] = [0.1, 0.9].map(|clutter| {
                let params = WorldGeneratorParams { clutter, ..params(kind) };
                let areas = (0..4).map(|seed| {
                    let world = generate_world(&params, seed);
                    NavigationWorld::new(&world, &robot, &NoAssets, 1).0.free_space().area_m2()
                });
                areas.sum::<f64>()
            });
            assert!(little > much, "{}: {little} {much}", kind.word());
        }
    }

    #[test]
    fn the_outer_walls_have_the_size_that_was_asked_for() {
        let world = generate_world(&params(WorldKind::Offices), 0);
        let walls = &world.models[1].links[0].collisions;
        let half_m = |one: &periplus_scene::Collision| {
            let Shape::Box { size_m } = &one.shape else { return 0.0 };
            one.link_from_collision.translation.x.abs() + size_m.x / 2.0
        };
        // Half of 12 m, and half of the thickness of 0.15 m.
        let widest_m = walls.iter().map(half_m).fold(0.0, f64::max);
        assert!((widest_m - 6.075).abs() < 1e-9, "{widest_m}");
    }
}
