//! Figure of a person from simple shapes: a lidar at the height of the knees sees two legs that swing.
//!
//! It is 1.75 m tall: two legs of 0.85 m with a radius of 0.07 m, 0.2 m apart, a torso of 0.6 m, a neck and a head. The
//! legs swing about the hips by the walked distance: a stride, of two steps, has 1.5 m.

use periplus_geometry::{DVec3, Pose, Rpy};
use periplus_scene::{Collision, Colour, Link, Material, Shape, Visual};

/// Number of links: the upper body, the left leg, the right leg.
pub(crate) const FIGURE_LINK_COUNT: usize = 3;

/// Height of the hips, which is the length of the legs \[m\].
pub(crate) const HIP_M: f64 = 0.85;

/// Distance of each leg from the middle \[m\].
pub(crate) const LEG_OFFSET_M: f64 = 0.1;

/// Radius of a leg \[m\].
pub(crate) const LEG_RADIUS_M: f64 = 0.07;

/// Length of two steps \[m\].
pub(crate) const STRIDE_M: f64 = 1.5;

/// Greatest angle of a leg: the sole is a quarter of a stride ahead of the hip, `asin(0.375 / 0.85)` \[rad\].
pub(crate) const MAX_SWING_RAD: f64 = 0.456_9;

/// Speed from which on the legs swing fully; slower people make smaller steps \[m/s\].
const FULL_SWING_M_PER_S: f64 = 0.5;

/// Colours of clothes: the name of a person chooses that of the upper body; the last is for the legs. Red, green
/// and blue from 0 to 1.
const CLOTHES_RATIO: [[f64; 3]; 6] = [
    [0.75, 0.20, 0.20],
    [0.20, 0.40, 0.75],
    [0.20, 0.60, 0.30],
    [0.85, 0.65, 0.15],
    [0.50, 0.30, 0.60],
    [0.30, 0.30, 0.35],
];

/// Colour of skin: red, green and blue from 0 to 1.
const SKIN_RATIO: [f64; 3] = [0.85, 0.65, 0.55];

/// Returns the links of a figure with the soles at the model's origin, looking along x.
pub(crate) fn figure_links(name: &str) -> Vec<Link> {
    let letters = name.bytes().fold(0_usize, |sum, letter| sum * 31 % 997 + usize::from(letter));
    let (shirt, trousers) = (CLOTHES_RATIO[letters % 5], CLOTHES_RATIO[5]);
    let mut body = Link::new("upper_body");
    add(&mut body, "torso", Shape::Box { size_m: DVec3::new(0.24, 0.42, 0.6) }, 1.15, shirt);
    add(&mut body, "neck", Shape::Cylinder { radius_m: 0.05, length_m: 0.1 }, 1.5, SKIN_RATIO);
    add(&mut body, "head", Shape::Sphere { radius_m: 0.12 }, 1.63, SKIN_RATIO);
    let leg = |name: &str, side: f64| {
        let mut leg = Link::new(name);
        leg.model_from_link = Pose::from_xyz(0.0, side * LEG_OFFSET_M, HIP_M);
        let shape = Shape::Cylinder { radius_m: LEG_RADIUS_M, length_m: HIP_M };
        add(&mut leg, "leg", shape, -HIP_M / 2.0, trousers);
        leg
    };
    vec![body, leg("left_leg", 1.0), leg("right_leg", -1.0)]
}

/// Returns the poses of the links of a figure that has walked a distance \[m\] and has a speed \[m/s\].
pub(crate) fn figure_poses(
    world_from_soles: Pose,
    walked_m: f64,
    speed_m_per_s: f64,
) -> [Pose; FIGURE_LINK_COUNT] {
    let phase_rad = std::f64::consts::TAU * (walked_m / STRIDE_M).fract();
    let swing_ratio = (speed_m_per_s / FULL_SWING_M_PER_S).min(1.0);
    let swing_rad = MAX_SWING_RAD * swing_ratio * libm::sin(phase_rad);
    let leg = |side: f64| {
        // A leg that hangs down moves ahead by a negative pitch.
        let rpy = Rpy { roll: 0.0, pitch: -side * swing_rad, yaw: 0.0 };
        world_from_soles * Pose::from_xyz_rpy([0.0, side * LEG_OFFSET_M, HIP_M], rpy)
    };
    [world_from_soles, leg(1.0), leg(-1.0)]
}

/// Adds a shape to a link, for cameras and for lidars that sense collisions.
fn add(link: &mut Link, name: &str, shape: Shape, height_m: f64, [red, green, blue]: [f64; 3]) {
    let pose = Pose::from_xyz(0.0, 0.0, height_m);
    let colour = Some(Colour([red, green, blue, 1.0]));
    let material = Material { ambient: colour, diffuse: colour, ..Material::default() };
    link.collisions
        .push(Collision { link_from_collision: pose, ..Collision::new(name, shape.clone()) });
    link.visuals.push(Visual {
        link_from_visual: pose,
        material: Some(material),
        ..Visual::new(name, shape)
    });
}
