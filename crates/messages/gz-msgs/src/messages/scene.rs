//! Visual description of a world. Fields that this program does not use are left out.

use super::{Color, Header, Pose, Vector2d, Vector3d};
use crate::message::{kinds, messages};

messages! {
    /// Scene of a world.
    Scene {
        1 header: Option<Header>,
        2 name: String,
        3 ambient: Option<Color>,
        4 background: Option<Color>,
        6 shadows: bool,
        8 grid: bool,
        9 model: Vec<Model>,
        10 light: Vec<Light>,
        11 joint: Vec<Joint>,
        12 origin_visual: bool,
    }
    /// Model, with the states of its joints.
    Model {
        1 header: Option<Header>,
        2 name: String,
        3 id: u32,
        4 is_static: bool,
        5 pose: Option<Pose>,
        6 joint: Vec<Joint>,
        7 link: Vec<Link>,
        8 deleted: bool,
        9 visual: Vec<Visual>,
        10 scale: Option<Vector3d>,
        11 self_collide: bool,
        12 model: Vec<Model>,
    }
    /// Joint.
    Joint {
        1 header: Option<Header>,
        2 name: String,
        3 id: u32,
        4 r#type: JointKind,
        5 parent: String,
        6 parent_id: u32,
        7 child: String,
        8 child_id: u32,
        9 pose: Option<Pose>,
        10 axis1: Option<Axis>,
        11 axis2: Option<Axis>,
    }
    /// Axis of a joint, with its state.
    Axis {
        1 header: Option<Header>,
        2 xyz: Option<Vector3d>,
        3 limit_lower: f64,
        4 limit_upper: f64,
        5 limit_effort: f64,
        6 limit_velocity: f64,
        7 damping: f64,
        8 friction: f64,
        10 position: f64,
        11 velocity: f64,
        12 force: f64,
        13 acceleration: f64,
        14 xyz_expressed_in: String,
    }
    /// Rigid body.
    Link {
        1 header: Option<Header>,
        2 id: u32,
        3 name: String,
        4 self_collide: bool,
        5 gravity: bool,
        6 kinematic: bool,
        7 enabled: bool,
        10 pose: Option<Pose>,
        11 visual: Vec<Visual>,
        15 canonical: bool,
        17 light: Vec<Light>,
    }
    /// Visual shape.
    Visual {
        1 header: Option<Header>,
        2 name: String,
        3 id: u32,
        4 parent_name: String,
        5 parent_id: u32,
        6 cast_shadows: bool,
        7 transparency: f64,
        8 laser_retro: f64,
        9 pose: Option<Pose>,
        10 geometry: Option<Geometry>,
        11 material: Option<Material>,
        12 visible: bool,
        13 delete_me: bool,
        14 is_static: bool,
        16 scale: Option<Vector3d>,
    }
    /// Shape.
    Geometry {
        1 header: Option<Header>,
        2 r#type: GeometryKind,
        3 r#box: Option<BoxGeom>,
        4 cylinder: Option<CylinderGeom>,
        5 plane: Option<PlaneGeom>,
        6 sphere: Option<SphereGeom>,
        9 mesh: Option<MeshGeom>,
        10 cone: Option<ConeGeom>,
        13 capsule: Option<CapsuleGeom>,
        14 ellipsoid: Option<EllipsoidGeom>,
    }
    /// Box \[m\].
    BoxGeom { 1 header: Option<Header>, 2 size: Option<Vector3d> }
    /// Cylinder \[m\].
    CylinderGeom { 1 header: Option<Header>, 2 radius: f64, 3 length: f64 }
    /// Cone \[m\].
    ConeGeom { 1 header: Option<Header>, 2 radius: f64, 3 length: f64 }
    /// Capsule \[m\].
    CapsuleGeom { 1 header: Option<Header>, 2 radius: f64, 3 length: f64 }
    /// Ellipsoid \[m\].
    EllipsoidGeom { 1 header: Option<Header>, 2 radii: Option<Vector3d> }
    /// Sphere \[m\].
    SphereGeom { 1 header: Option<Header>, 2 radius: f64 }
    /// Plane \[m\].
    PlaneGeom {
        1 header: Option<Header>,
        2 normal: Option<Vector3d>,
        3 size: Option<Vector2d>,
        4 d: f64,
    }
    /// Mesh.
    MeshGeom {
        1 header: Option<Header>,
        2 filename: String,
        3 scale: Option<Vector3d>,
        4 submesh: String,
        5 center_submesh: bool,
    }
    /// Material of a surface.
    Material {
        1 header: Option<Header>,
        5 ambient: Option<Color>,
        6 diffuse: Option<Color>,
        7 specular: Option<Color>,
        8 emissive: Option<Color>,
        9 lighting: bool,
        11 render_order: f64,
        12 double_sided: bool,
    }
    /// Light.
    Light {
        1 header: Option<Header>,
        2 name: String,
        3 r#type: LightKind,
        4 pose: Option<Pose>,
        5 diffuse: Option<Color>,
        6 specular: Option<Color>,
        7 attenuation_constant: f32,
        8 attenuation_linear: f32,
        9 attenuation_quadratic: f32,
        10 direction: Option<Vector3d>,
        11 range: f32,
        12 cast_shadows: bool,
        13 spot_inner_angle: f32,
        14 spot_outer_angle: f32,
        15 spot_falloff: f32,
        16 id: u32,
        17 parent_id: u32,
        18 intensity: f32,
        19 is_light_off: bool,
        20 visualize_visual: bool,
    }
}

kinds! {
    /// Type of a joint.
    JointKind {
        REVOLUTE = 0, REVOLUTE2 = 1, PRISMATIC = 2, UNIVERSAL = 3, BALL = 4, SCREW = 5,
        GEARBOX = 6, FIXED = 7, CONTINUOUS = 8,
    }
    /// Type of a shape.
    GeometryKind {
        BOX = 0, CYLINDER = 1, SPHERE = 2, PLANE = 3, IMAGE = 4, HEIGHTMAP = 5, MESH = 6,
        TRIANGLE_FAN = 7, LINE_STRIP = 8, POLYLINE = 9, CONE = 10, EMPTY = 11, ARROW = 12,
        AXIS = 13, CAPSULE = 14, ELLIPSOID = 15,
    }
    /// Type of a light.
    LightKind { POINT = 0, SPOT = 1, DIRECTIONAL = 2 }
}
