//! Steering models by name.

use glam::DVec2;

use crate::headway::Headway;
use crate::orca::{self, OrcaParams};
use crate::perception::Perception;
use crate::social_force::{self, SocialForceParams};

/// Model by which agents choose their velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SteeringModel {
    /// Social force model.
    SocialForce(SocialForceParams),
    /// Optimal reciprocal collision avoidance.
    Orca(OrcaParams),
}

impl SteeringModel {
    /// Names of the models.
    pub const NAMES: [&'static str; 2] = ["social_force", "orca"];

    /// Returns the model of a name with its default parameters; none for other names.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        match name {
            "social_force" => Some(Self::SocialForce(SocialForceParams::default())),
            "orca" => Some(Self::Orca(OrcaParams::default())),
            _ => None,
        }
    }

    /// Name of the model.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::SocialForce(_) => "social_force",
            Self::Orca(_) => "orca",
        }
    }

    /// Longest step of the integration \[s\].
    pub(crate) fn max_step_s(&self) -> f64 {
        match self {
            Self::SocialForce(_) => social_force::MAX_STEP_S,
            Self::Orca(_) => orca::MAX_STEP_S,
        }
    }

    /// Range within which others are seen \[m\].
    pub(crate) fn range_m(&self) -> f64 {
        match self {
            Self::SocialForce(_) => social_force::RANGE_M,
            Self::Orca(params) => params.neighbour_range_m,
        }
    }

    /// Maximum number of others that are considered.
    pub(crate) fn max_neighbours(&self) -> usize {
        match self {
            Self::SocialForce(_) => usize::MAX,
            Self::Orca(params) => params.max_neighbours,
        }
    }

    /// Overlap of two bodies that the model resolves by its forces; a greater one is corrected at once \[m\].
    pub(crate) fn allowed_overlap_m(&self) -> f64 {
        match self {
            Self::SocialForce(_) => 0.05,
            Self::Orca(_) => 0.0,
        }
    }

    /// Time without progress after which people who are opposed give way or squeeze through. Forces part people more
    /// slowly than ORCA, and with 1 s a bottleneck lets a tenth fewer through \[s\].
    pub(crate) fn deadlock_after_s(&self) -> f64 {
        match self {
            Self::SocialForce(_) => 2.0,
            Self::Orca(_) => 1.0,
        }
    }

    /// Distance that people keep to the one ahead.
    fn headway(&self) -> Option<Headway> {
        match self {
            Self::SocialForce(params) => params.headway,
            Self::Orca(params) => params.headway,
        }
    }

    /// Returns the preferred velocity with regard to the people ahead \[m/s\].
    pub(crate) fn adapt(&self, view: &Perception<'_>) -> DVec2 {
        self.headway().map_or(view.preferred, |headway| headway.adapt(view, view.preferred))
    }

    /// Returns the velocity after a step, with the adapted preferred velocity in the view \[m/s\].
    pub(crate) fn steer(&self, view: &Perception<'_>) -> DVec2 {
        match self {
            Self::SocialForce(params) => params.steer(view),
            Self::Orca(params) => params.steer(view),
        }
    }
}
