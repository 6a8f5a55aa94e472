//! A changed world gives the same hits as one built in its final state.

#![allow(clippy::unwrap_used, reason = "helpers of tests")]

mod support;

use std::sync::Arc;

use periplus_geometry::{DVec3, Pose, Rpy, Stream};
use periplus_raycast::{
    Filter, InstanceChangeError, InstanceId, Ray, RaycastShape, RaycastWorld, RaycastWorldBuilder,
    Tags, TriangleMesh,
};
use proptest::prelude::*;
use support::unit;

const SHEET: [[f64; 3]; 4] =
    [[0.0, -1.0, -1.0], [0.0, 1.0, -1.0], [0.0, 1.0, 1.0], [0.0, -1.0, 1.0]];
const CORNERS: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

fn at(x: f64) -> Pose {
    Pose::from_xyz(x, 0.0, 0.0)
}

fn wall(builder: &mut RaycastWorldBuilder, x: f64) -> InstanceId {
    builder.add_fixed(&SHEET, &CORNERS, &at(x), Tags::default()).unwrap()
}

fn ball(builder: &mut RaycastWorldBuilder, x: f64) -> InstanceId {
    builder.add_shape(&RaycastShape::Sphere { radius_m: 0.5 }, &at(x), Tags::default()).unwrap()
}

/// Distance and instance of the first hit along x from the origin.
fn ahead(world: &RaycastWorld) -> Option<(f64, InstanceId)> {
    let ray = Ray::new(DVec3::new(0.0, 0.1, -0.3), DVec3::X);
    world
        .cast(&ray, Filter::default())
        .map(|hit| ((hit.distance_m * 10.0).round() / 10.0, hit.instance))
}

#[test]
fn walls_come_and_go() {
    let mut builder = RaycastWorld::builder();
    let (near, far) = (wall(&mut builder, 2.0), wall(&mut builder, 4.0));
    let mut world = builder.build(1).unwrap();
    assert_eq!(ahead(&world), Some((2.0, near)));
    world.remove(&[near]).unwrap();
    assert_eq!((ahead(&world), world.len()), (Some((4.0, far)), 1));

    let mut more = RaycastWorld::builder();
    ball(&mut more, 9.0);
    wall(&mut more, 8.0);
    wall(&mut more, 3.0);
    let first = world.insert(more, 1).unwrap();
    assert_eq!((first, world.len()), (InstanceId(2), 4));
    assert_eq!(ahead(&world), Some((3.0, InstanceId(4))));
    world.remove(&[InstanceId(4), far]).unwrap();
    assert_eq!(ahead(&world), Some((8.0, InstanceId(3))));
    world.remove(&[InstanceId(2), InstanceId(3)]).unwrap();
    assert_eq!((ahead(&world), world.is_empty()), (None, true));
}

#[test]
fn what_cannot_be_changed_is_said_and_nothing_moves() {
    let mut builder = RaycastWorld::builder();
    let (fixed, one, other) =
        (wall(&mut builder, 9.0), ball(&mut builder, 2.0), ball(&mut builder, 5.0));
    let mut world = builder.build(1).unwrap();
    let nowhere = Pose::from_xyz(f64::NAN, 0.0, 0.0);
    let moves = |world: &mut RaycastWorld, id, pose| world.move_to(&[(one, at(7.0)), (id, pose)]);
    assert_eq!(moves(&mut world, other, nowhere), Err(InstanceChangeError::Pose(other)));
    assert_eq!(moves(&mut world, fixed, at(1.0)), Err(InstanceChangeError::Fixed(fixed)));
    let unknown = InstanceId(3);
    assert_eq!(
        moves(&mut world, unknown, at(1.0)),
        Err(InstanceChangeError::NoSuchInstance(unknown))
    );
    assert_eq!(world.remove(&[one, one]), Err(InstanceChangeError::NoSuchInstance(one)));
    assert_eq!(ahead(&world).map(|(_, id)| id), Some(one));
    world.remove(&[one]).unwrap();
    assert_eq!(moves(&mut world, other, at(1.0)), Err(InstanceChangeError::NoSuchInstance(one)));
    assert_eq!(ahead(&world).map(|(_, id)| id), Some(other));
}

fn anywhere(stream: &mut Stream) -> Pose {
    let rotate_into_world =
        Rpy { roll: stream.unit(), pitch: stream.unit(), yaw: 6.0 * stream.unit() };
    Pose::from_xyz_rpy((unit(stream) * 6.0 * stream.unit()).to_array(), rotate_into_world)
}

/// One of several movable shapes.
fn thing(builder: &mut RaycastWorldBuilder, kind: u64, pose: &Pose) {
    let tags = Tags::default();
    let shape = match kind {
        0 => RaycastShape::Sphere { radius_m: 0.4 },
        1 => RaycastShape::Box { size_m: DVec3::new(0.5, 1.0, 0.2) },
        2 => RaycastShape::Cylinder { radius_m: 0.2, length_m: 1.5 },
        3 => RaycastShape::Plane { size_m: None },
        _ => {
            let mesh = TriangleMesh::new(&SHEET, &CORNERS, 1).unwrap();
            builder.add_mesh(Arc::new(mesh), pose, tags).unwrap();
            return;
        }
    };
    builder.add_shape(&shape, pose, tags).unwrap();
}

/// Planes are rare, since they hide everything else.
fn kind(stream: &mut Stream) -> u64 {
    [0, 1, 2, 4, 0, 1, 2, 4, 0, 1, 2, 4, 3][usize::try_from(stream.bits() % 13).unwrap()]
}

/// Kind and pose of each instance, by id.
type Things = Vec<Option<(u64, Pose)>>;

/// The same world built in one step: contiguous ids, with the original ids.
fn built(things: &Things) -> (RaycastWorld, Vec<InstanceId>) {
    let mut builder = RaycastWorld::builder();
    let mut ids = vec![InstanceId(0)];
    wall(&mut builder, 1.0);
    for (id, each) in (1..).map(InstanceId).zip(&things[1..]) {
        if let Some((kind, pose)) = each {
            thing(&mut builder, *kind, pose);
            ids.push(id);
        }
    }
    (builder.build(1).unwrap(), ids)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn changed_worlds_equal_built_ones(seed in any::<u64>(), many in 0_u64..80) {
        let mut stream = Stream::keyed(seed, "things", 0);
        let mut things: Things = vec![Some((99, Pose::IDENTITY))];
        things.extend((0..many).map(|_| Some((kind(&mut stream), anywhere(&mut stream)))));
        let (mut world, _) = built(&things);
        for _ in 0..12 {
            match stream.bits() % 4 {
                0 => {
                    let mut more = RaycastWorld::builder();
                    let first = things.len();
                    for _ in 0..stream.bits() % 5 {
                        let (kind, pose) = (kind(&mut stream), anywhere(&mut stream));
                        thing(&mut more, kind, &pose);
                        things.push(Some((kind, pose)));
                    }
                    prop_assert_eq!(world.insert(more, 1).unwrap().0 as usize, first);
                }
                1 => {
                    let mut gone = Vec::new();
                    for (id, thing) in (0..).map(InstanceId).zip(&mut things).skip(1) {
                        if thing.is_some() && stream.bits().is_multiple_of(10) {
                            *thing = None;
                            gone.push(id);
                        }
                    }
                    world.remove(&gone).unwrap();
                }
                _ => {
                    let mut moved = Vec::new();
                    for (id, thing) in (0..).map(InstanceId).zip(&mut things).skip(1) {
                        if let Some((_, pose)) = thing && stream.bits().is_multiple_of(3) {
                            *pose = anywhere(&mut stream);
                            moved.push((id, *pose));
                        }
                    }
                    world.move_to(&moved).unwrap();
                }
            }
            let (fresh, ids) = built(&things);
            let eye = unit(&mut stream) * 3.0;
            let rays: Vec<Ray> = (0..48).map(|_| Ray::new(eye, unit(&mut stream))).collect();
            let mut ours = vec![None; rays.len()];
            let mut theirs = ours.clone();
            world.hits_grid(&rays, 8, Filter::default(), 1, &mut ours);
            fresh.hits_grid(&rays, 8, Filter::default(), 1, &mut theirs);
            for hit in theirs.iter_mut().flatten() {
                hit.instance = ids[hit.instance.0 as usize];
            }
            prop_assert_eq!(ours, theirs);
        }
    }
}
