//! Obstacles of a kinematic robot: the areas that the shapes of a world cover at the heights of its body.

mod band;
mod index;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::DVec3;
use periplus_rendering::{RenderScene, TracedGeometry, TracedShape};

pub use band::HeightBand;

use self::band::{area_of_shape, area_of_triangle};
use self::index::AreaIndex;
use crate::footprint::PlacedFootprint;
use crate::plane::{Point2, distance_to_outline};

/// Area of the plane that an obstacle covers.
#[derive(Clone, Debug, PartialEq)]
pub enum ObstacleArea {
    /// Disc.
    Circle {
        /// Centre \[m\].
        centre: [f64; 2],
        /// Radius \[m\].
        radius_m: f64,
    },
    /// Convex polygon, counterclockwise; two corners are a wall without thickness.
    Polygon(Vec<[f64; 2]>),
}

impl ObstacleArea {
    fn bounds(&self) -> [Point2; 2] {
        match self {
            Self::Circle { centre: [x, y], radius_m } => {
                [[x - radius_m, y - radius_m], [x + radius_m, y + radius_m]]
            }
            Self::Polygon(corners) => {
                let fold = |start: f64, pick: fn(f64, f64) -> f64| {
                    corners.iter().fold([start; 2], |a, b| [pick(a[0], b[0]), pick(a[1], b[1])])
                };
                [fold(f64::INFINITY, f64::min), fold(f64::NEG_INFINITY, f64::max)]
            }
        }
    }

    /// Returns the distance from a point; zero inside \[m\].
    fn distance_to_point_m(&self, point: Point2) -> f64 {
        match self {
            Self::Circle { centre, radius_m } => {
                (libm::hypot(point[0] - centre[0], point[1] - centre[1]) - radius_m).max(0.0)
            }
            Self::Polygon(corners) => distance_to_outline(corners, point),
        }
    }
}

/// Obstacles of a world in the plane, with an index for queries near a point.
#[derive(Clone, Debug)]
pub struct Obstacles {
    areas: Vec<ObstacleArea>,
    index: AreaIndex,
}

impl Obstacles {
    /// Collects the obstacles of a scene between two heights. Shapes whose area is not known are reported and left
    /// out.
    #[must_use]
    pub fn of_scene(scene: &RenderScene, band: HeightBand) -> (Self, Diagnostics) {
        let (mut areas, mut diagnostics) = (Vec::new(), Diagnostics::new());
        for shape in scene.shapes() {
            if let Err(reason) = add_areas(&shape, band, &mut areas) {
                let TracedShape { model, link, name, .. } = shape;
                diagnostics.push(
                    Diagnostic::error(
                        "obstacle-not-supported",
                        format!("the collision `{model}::{link}::{name}` {reason}"),
                    )
                    .help("kinematic robots drive on a flat floor: use boxes, cylinders or meshes"),
                );
            }
        }
        (Self::new(areas), diagnostics)
    }

    /// Creates obstacles from areas.
    #[must_use]
    pub fn new(areas: Vec<ObstacleArea>) -> Self {
        let index = AreaIndex::new(areas.iter().map(ObstacleArea::bounds));
        Self { areas, index }
    }

    /// Returns the areas.
    #[must_use]
    pub fn areas(&self) -> &[ObstacleArea] {
        &self.areas
    }

    /// Returns the lower left and the upper right corner of all obstacles \[m\]; none without obstacles.
    #[must_use]
    pub fn bounds_m(&self) -> Option<[[f64; 2]; 2]> {
        self.areas.iter().map(ObstacleArea::bounds).reduce(|[low, high], [other, another]| {
            [
                [low[0].min(other[0]), low[1].min(other[1])],
                [high[0].max(another[0]), high[1].max(another[1])],
            ]
        })
    }

    /// Returns the distance from a point to the nearest obstacle, at most `max_m` \[m\].
    #[must_use]
    pub fn distance_to_point_m(&self, point: [f64; 2], max_m: f64) -> f64 {
        let mut nearest_m = max_m;
        self.index.visit([point, point], max_m, |area| {
            nearest_m = nearest_m.min(self.areas[area].distance_to_point_m(point));
        });
        nearest_m
    }

    /// Returns the distance from a footprint to the nearest obstacle, at most `max_m` \[m\]; zero in collision.
    #[must_use]
    pub fn distance_to_footprint_m(&self, footprint: &PlacedFootprint<'_>, max_m: f64) -> f64 {
        let mut nearest_m = max_m;
        self.index.visit(footprint.bounds(), max_m, |area| {
            if nearest_m > 0.0 {
                nearest_m = nearest_m.min(footprint.distance_to_area_m(&self.areas[area]));
            }
        });
        nearest_m
    }
}

fn add_areas(
    shape: &TracedShape<'_>,
    band: HeightBand,
    areas: &mut Vec<ObstacleArea>,
) -> Result<(), String> {
    match shape.geometry {
        TracedGeometry::Shape(form) => {
            areas.extend(area_of_shape(form, &shape.world_from_body, band)?);
        }
        TracedGeometry::Triangles { positions_m, triangles } => {
            let corner = |at: u32| {
                let position = DVec3::from_array(positions_m[at as usize]);
                shape.world_from_body.transform_point(position)
            };
            let triangles = triangles.iter().map(|corners| corners.map(corner));
            areas.extend(triangles.filter_map(|corners| area_of_triangle(corners, band)));
        }
        TracedGeometry::Heightfield(_) => return Err("is a terrain".into()),
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use periplus_geometry::{Pose2, Stream};

    use super::*;
    use crate::footprint::RobotFootprint;

    fn room() -> Obstacles {
        let wall = |x: f64, y: f64, w: f64, h: f64| {
            ObstacleArea::Polygon(vec![[x, y], [x + w, y], [x + w, y + h], [x, y + h]])
        };
        Obstacles::new(vec![
            wall(-5.0, -5.0, 10.0, 0.2),
            wall(-5.0, 4.8, 10.0, 0.2),
            wall(-5.0, -5.0, 0.2, 10.0),
            wall(4.8, -5.0, 0.2, 10.0),
            ObstacleArea::Circle { centre: [1.0, 0.0], radius_m: 0.5 },
        ])
    }

    #[test]
    fn distances_of_a_point() {
        let check = |point, max_m, expected: f64| {
            let found = room().distance_to_point_m(point, max_m);
            assert!((found - expected).abs() < 1e-12, "{point:?}: {found}");
        };
        check([0.0, 0.0], 10.0, 0.5);
        check([0.0, 0.0], 0.3, 0.3);
        check([1.0, 0.1], 10.0, 0.0);
        check([-3.0, 0.0], 10.0, 1.8);
        check([20.0, 0.0], 100.0, 15.0);
    }

    #[test]
    fn distances_of_footprints() {
        let circle = RobotFootprint::circle(0.2).expect("a radius");
        let square =
            RobotFootprint::polygon(vec![[0.3, 0.2], [-0.3, 0.2], [-0.3, -0.2], [0.3, -0.2]])
                .expect("4");
        let check = |footprint: &RobotFootprint, pose: Pose2, expected: f64| {
            let mut corners = Vec::new();
            let found = room().distance_to_footprint_m(&footprint.placed(pose, &mut corners), 10.0);
            assert!((found - expected).abs() < 1e-12, "{pose:?}: {found}");
        };
        check(&circle, Pose2::new(0.0, 0.0, 0.0), 0.3);
        check(&square, Pose2::new(0.0, 0.0, 0.0), 0.2);
        check(&square, Pose2::new(0.0, 0.0, std::f64::consts::FRAC_PI_2), 0.3);
        check(&square, Pose2::new(0.3, 0.0, 0.0), 0.0);
        check(&circle, Pose2::new(0.31, 0.0, 0.0), 0.0);
    }

    /// The index finds what a search of all areas finds.
    #[test]
    fn the_index_leaves_nothing_out() {
        let mut stream = Stream::keyed(0, "areas", 0);
        let mut draw = |scale: f64| (stream.unit() - 0.5) * scale;
        let areas: Vec<ObstacleArea> = (0..60)
            .map(|_| {
                let [x, y] = [draw(20.0), draw(20.0)];
                ObstacleArea::Polygon(vec![[x, y], [x + draw(1.0).abs(), y], [x, y + 0.3]])
            })
            .collect();
        let obstacles = Obstacles::new(areas.clone());
        for _ in 0..500 {
            let point = [draw(30.0), draw(30.0)];
            let all = areas.iter().map(|area| area.distance_to_point_m(point)).fold(3.0, f64::min);
            assert_eq!(obstacles.distance_to_point_m(point, 3.0), all, "{point:?}");
        }
    }
}
