//! Motion of a model as one piece.

use periplus_geometry::{DQuat, DVec3, Pose};

use crate::engine::BodyMotion;
use crate::kinematic::{Kinematic, Twist};

/// Commanded motion of a model.
#[derive(Clone, Copy, Debug)]
pub(super) enum BaseMotion {
    /// No motion.
    Nowhere,
    /// Along the arc of a twist, in the plane.
    Along { at: Kinematic, twist: Twist },
    /// With a velocity of its frame, in world axes.
    Flying { linear_m_s: DVec3, angular_rad_s: DVec3 },
}

impl BaseMotion {
    pub(super) fn along(twist: Twist) -> Self {
        Self::Along { at: Kinematic::default(), twist }
    }
}

/// A moving frame and the bodies that it carries.
#[derive(Clone, Debug)]
pub(super) struct Base {
    pub(super) model: u32,
    centre_in_model_m: DVec3,
    going: BaseMotion,
    world_from_frame: Pose,
    roots: Vec<(usize, Pose)>,
    moves: bool,
}

impl Base {
    pub(super) fn new(
        model: u32,
        world_from_model: Pose,
        centre_in_model_m: DVec3,
        mut going: BaseMotion,
        roots: &[(usize, Pose)],
    ) -> Self {
        let centre_m = world_from_model.transform_point(centre_in_model_m);
        let world_from_frame = if let BaseMotion::Along { at, .. } = &mut going {
            // The plane at height zero under the centre; poses above it are those of the root
            // bodies.
            *at =
                Kinematic { x_m: centre_m.x, y_m: centre_m.y, yaw_rad: world_from_model.rpy().yaw };
            at.pose()
        } else {
            Pose { translation: centre_m, rotation: world_from_model.rotation }
        };
        let frame_from_world = world_from_frame.inverse();
        let roots = roots.iter().map(|&(body, pose)| (body, frame_from_world * pose)).collect();
        Self { model, centre_in_model_m, going, world_from_frame, roots, moves: true }
    }

    /// Changes the twist of a base that already moves about the same centre.
    pub(super) fn steer(&mut self, centre_in_model_m: DVec3, twist: Twist) -> bool {
        match &mut self.going {
            BaseMotion::Along { twist: now, .. } if self.centre_in_model_m == centre_in_model_m => {
                self.moves |= *now != twist;
                *now = twist;
                true
            }
            _ => false,
        }
    }

    /// Advances by a time [s].
    pub(super) fn advance(&mut self, dt_s: f64, motions: &mut [BodyMotion], changed: &mut [bool]) {
        if !self.moves {
            return;
        }
        let frame = match &mut self.going {
            BaseMotion::Nowhere => BodyMotion::resting(self.world_from_frame),
            BaseMotion::Along { at, twist } => {
                *at = at.advanced(*twist, dt_s);
                let world_from_body = at.pose();
                BodyMotion {
                    world_from_body,
                    linear_m_s: world_from_body.rotation
                        * DVec3::new(twist.x_m_s, twist.y_m_s, 0.0),
                    angular_rad_s: DVec3::new(0.0, 0.0, twist.yaw_rad_s),
                }
            }
            BaseMotion::Flying { linear_m_s, angular_rad_s } => {
                let Pose { translation, rotation } = self.world_from_frame;
                let world_from_body = Pose {
                    translation: translation + *linear_m_s * dt_s,
                    rotation: (turn(*angular_rad_s * dt_s) * rotation).normalize(),
                };
                BodyMotion {
                    world_from_body,
                    linear_m_s: *linear_m_s,
                    angular_rad_s: *angular_rad_s,
                }
            }
        };
        self.world_from_frame = frame.world_from_body;
        self.moves = frame.linear_m_s != DVec3::ZERO || frame.angular_rad_s != DVec3::ZERO;
        for &(body, frame_from_body) in &self.roots {
            let world_from_body = frame.world_from_body * frame_from_body;
            motions[body] = BodyMotion {
                world_from_body,
                linear_m_s: frame.velocity_at(world_from_body.translation),
                angular_rad_s: frame.angular_rad_s,
            };
            changed[body] = true;
        }
    }
}

/// Returns the rotation about a vector by its length [rad].
fn turn(angle_rad: DVec3) -> DQuat {
    let length = angle_rad.length();
    if length == 0.0 {
        return DQuat::IDENTITY;
    }
    let (sine, cosine) = libm::sincos(length / 2.0);
    let along = angle_rad * (sine / length);
    DQuat::from_xyzw(along.x, along.y, along.z, cosine)
}
