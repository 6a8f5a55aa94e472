//! Height maps.

#![allow(clippy::unwrap_used, reason = "helpers of tests")]

use std::sync::Arc;

use periplus_geometry::{DVec3, Pose, Stream};
use periplus_raycast::{
    Filter, Heightfield, HeightfieldError, Ray, RaycastWorld, Tags, TriangleMesh,
};
use proptest::prelude::*;

fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

fn world(columns: usize, rows: usize, size_m: [f64; 2], heights: Vec<f64>) -> RaycastWorld {
    let field = Heightfield::new(columns, rows, size_m, heights).unwrap();
    let mut builder = RaycastWorld::builder();
    builder.add_heightfield(Arc::new(field), &Pose::IDENTITY, Tags::default()).unwrap();
    builder.build(1).unwrap()
}

fn distance(world: &RaycastWorld, origin: DVec3, direction: DVec3) -> Option<f64> {
    world
        .cast(&Ray::new(origin, direction.normalize()), Filter::default())
        .map(|hit| hit.distance_m)
}

#[test]
fn a_ramp() {
    // Two cells along x, rising from 0 to 2 over 4 m.
    let ramp = world(3, 2, [4.0, 2.0], vec![0.0, 1.0, 2.0, 0.0, 1.0, 2.0]);
    assert_eq!(distance(&ramp, v(1.0, 0.3, 5.0), DVec3::NEG_Z), Some(3.5));
    assert_eq!(distance(&ramp, v(-1.0, -0.3, -5.0), DVec3::Z), Some(5.5));
    assert_eq!(distance(&ramp, v(-5.0, 0.2, 1.5), DVec3::X), Some(6.0));
    assert_eq!(distance(&ramp, v(2.1, 0.0, 5.0), DVec3::NEG_Z), None);
    assert_eq!(distance(&ramp, v(-5.0, 0.2, 2.5), DVec3::X), None);
    let hit = ramp.cast(&Ray::new(v(1.0, 0.3, 5.0), DVec3::NEG_Z), Filter::default()).unwrap();
    assert!(hit.normal.distance(v(-1.0, 0.0, 2.0).normalize()) < 1e-12);
    // The second cell's triangle with the corner of high y.
    assert_eq!(hit.primitive, 3);
}

#[test]
fn no_grid_no_ground() {
    let new = |columns, rows, size: f64, heights: Vec<f64>| {
        Heightfield::new(columns, rows, [size; 2], heights).map(drop)
    };
    assert_eq!(new(1, 4, 1.0, vec![0.0; 4]), Err(HeightfieldError::Count));
    assert_eq!(new(2, 2, 1.0, vec![0.0; 5]), Err(HeightfieldError::Count));
    assert_eq!(new(usize::MAX, 2, 1.0, vec![]), Err(HeightfieldError::Count));
    assert_eq!(new(2, 2, 0.0, vec![0.0; 4]), Err(HeightfieldError::Size));
    let wrong = vec![0.0, 0.0, f64::NAN, 0.0];
    assert_eq!(new(2, 2, 1.0, wrong), Err(HeightfieldError::Height { sample: 2 }));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Hits equal those of its triangles, and no ray passes through, not even on grid lines.
    #[test]
    fn as_its_triangles(columns in 2_usize..12, rows in 2_usize..12, seed in any::<u64>()) {
        let mut stream = Stream::keyed(seed, "ground", 0);
        let heights: Vec<f64> = (0..columns * rows).map(|_| stream.unit()).collect();
        let (width, depth) = (4.0, 3.0);
        let field = world(columns, rows, [width, depth], heights.clone());
        let mut positions = Vec::new();
        let mut triangles = Vec::new();
        for row in 0..rows {
            for column in 0..columns {
                let x = (column as f64 / (columns - 1) as f64 - 0.5) * width;
                let y = (row as f64 / (rows - 1) as f64 - 0.5) * depth;
                positions.push([x, y, heights[row * columns + column]]);
                if row + 1 < rows && column + 1 < columns {
                    let a = u32::try_from(row * columns + column).unwrap();
                    let up = u32::try_from(columns).unwrap();
                    triangles.push([a, a + 1, a + up + 1]);
                    triangles.push([a, a + up + 1, a + up]);
                }
            }
        }
        let mut builder = RaycastWorld::builder();
        let mesh = TriangleMesh::new(&positions, &triangles, 1).unwrap();
        builder.add_mesh(Arc::new(mesh), &Pose::IDENTITY, Tags::default()).unwrap();
        let mesh = builder.build(1).unwrap();
        for _ in 0..100 {
            let mut inside = || (stream.unit() - 0.5) * 0.98;
            let target = v(inside() * width, inside() * depth, 0.0);
            let origin = v(inside() * width, inside() * depth, 3.0);
            let direction = (target - origin).normalize();
            let (ours, theirs) = (
                distance(&field, origin, direction).unwrap(),
                distance(&mesh, origin, direction).unwrap(),
            );
            // One may just miss a crest that the other meets: then the crest is near the ray.
            let crest = origin + direction * ours.min(theirs);
            let on_edge = (0..2).any(|axis| {
                let (size, n) = ([width, depth][axis], [columns, rows][axis] - 1);
                let cells = (crest[axis] / size + 0.5) * n as f64;
                (cells - cells.round()).abs() < 1e-4
            });
            prop_assert!((ours - theirs).abs() < 1e-4 || on_edge, "{ours} {theirs}");
        }
        // Straight down on samples and on the lines between: a height map has no gaps there.
        for pair in positions.windows(2) {
            let [a, b] = [pair[0], pair[1]].map(DVec3::from_array);
            for target in [a, a + (b - a) * stream.unit()] {
                if target.x.abs() > 0.49 * width || target.y.abs() > 0.49 * depth {
                    continue;
                }
                let down = distance(&field, v(target.x, target.y, 3.0), DVec3::NEG_Z).unwrap();
                if (b - a).x > 0.0 {
                    prop_assert!((down - (3.0 - target.z)).abs() < 1e-9);
                }
            }
        }
    }
}

/// Regression test: a cell across a grid line was skipped when the ray's projection is a point on
/// that line.
#[test]
fn straight_down_on_a_grid_line() {
    let field = world(7, 3, [4.0, 3.0], vec![0.5; 21]);
    for column in 1..6 {
        let x = f64::from(column) / 6.0 * 4.0 - 2.0;
        for x in [x, x.next_up(), x.next_down()] {
            assert_eq!(distance(&field, v(x, 0.3, 3.0), DVec3::NEG_Z), Some(2.5));
        }
    }
}
