//! Agents: people as discs.

use glam::DVec2;

use crate::error::CrowdError;

/// Number of an agent, in the order in which agents were added.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PersonId(pub usize);

/// Number of a goal, in the order in which goals were added.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PersonGoalId(pub usize);

/// Number of a group, in the order in which groups were added.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct GroupId(pub usize);

/// Body and pace of an agent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PersonSettings {
    /// Position \[m\].
    pub position: DVec2,
    /// Radius of the body (default 0.2 m: shoulders of 0.45 m, a chest of 0.3 m) \[m\].
    pub radius_m: f64,
    /// Speed without others (default 1.34 m/s, Weidmann 1993) \[m/s\].
    pub preferred_speed_m_per_s: f64,
    /// Limit of the speed (default 1.3 times the preferred speed, Helbing and Molnar 1995) \[m/s\].
    pub max_speed_m_per_s: f64,
}

impl PersonSettings {
    /// Agent of the default size and pace at a position \[m\].
    #[must_use]
    pub fn at(position: DVec2) -> Self {
        Self { position, radius_m: 0.2, preferred_speed_m_per_s: 1.34, max_speed_m_per_s: 1.742 }
    }

    /// The same agent with another preferred speed, and the limit that belongs to it \[m/s\].
    #[must_use]
    pub fn with_speed(self, preferred_speed_m_per_s: f64) -> Self {
        let max_speed_m_per_s = 1.3 * preferred_speed_m_per_s;
        Self { preferred_speed_m_per_s, max_speed_m_per_s, ..self }
    }

    pub(crate) fn check(&self) -> Result<(), CrowdError> {
        let check = |name, value: f64, low: f64, high: f64| {
            if (low..=high).contains(&value) {
                Ok(())
            } else {
                Err(CrowdError::Person(name, value))
            }
        };
        check("position x", self.position.x, -1e6, 1e6)?;
        check("position y", self.position.y, -1e6, 1e6)?;
        check("radius_m", self.radius_m, 0.05, 1.0)?;
        check("preferred_speed_m_per_s", self.preferred_speed_m_per_s, 0.0, 5.0)?;
        check("max_speed_m_per_s", self.max_speed_m_per_s, self.preferred_speed_m_per_s, 10.0)
    }
}

/// Plan of an agent or a group.
#[derive(Clone, Debug, PartialEq)]
pub enum PersonPlan {
    /// Stay at the start; step aside for others.
    Stand,
    /// Walk in a direction (a unit vector) for ever, as on the corridors of experiments.
    Direction(DVec2),
    /// Visit goals in their order.
    Visit {
        /// The goals.
        goals: Vec<PersonGoalId>,
        /// True to start again after the last; otherwise remain there.
        repeats: bool,
    },
    /// Visit all goals of the crowd at random, for ever.
    Wander,
}

/// State of an agent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PersonState {
    /// Walking to a goal.
    Walking,
    /// At a goal, for a while.
    Waiting,
    /// In front of a closed door.
    Queueing,
    /// Without a goal.
    Standing,
}

impl PersonState {
    /// Name in messages and files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Walking => "walking",
            Self::Waiting => "waiting",
            Self::Queueing => "queueing",
            Self::Standing => "standing",
        }
    }
}

/// Agent of a crowd.
#[derive(Clone, Debug, PartialEq)]
pub struct Person {
    pub(crate) settings: PersonSettings,
    pub(crate) group: usize,
    pub(crate) position: DVec2,
    pub(crate) velocity: DVec2,
    pub(crate) heading: DVec2,
    pub(crate) state: PersonState,
    pub(crate) walked_m: f64,
    /// Velocity without others in this step \[m/s\].
    pub(crate) preferred: DVec2,
    /// The same with regard to the people ahead \[m/s\].
    pub(crate) adapted: DVec2,
    /// Time for which the agent still counts as opposed: another directly ahead came towards it, or did not avoid it
    /// \[s\].
    pub(crate) opposed_s: f64,
    /// Point of the route to walk to.
    pub(crate) target: Option<DVec2>,
    /// Time without progress, which shrinks twice as fast as it grows \[s\].
    pub(crate) blocked_s: f64,
    /// Position from which `still_s` is counted.
    pub(crate) anchor: DVec2,
    /// Time since the agent was farther than a step from its anchor, while walking \[s\].
    pub(crate) still_s: f64,
}

impl Person {
    pub(crate) fn new(settings: PersonSettings, group: usize) -> Self {
        Self {
            settings,
            group,
            position: settings.position,
            velocity: DVec2::ZERO,
            heading: DVec2::X,
            state: PersonState::Standing,
            walked_m: 0.0,
            preferred: DVec2::ZERO,
            adapted: DVec2::ZERO,
            opposed_s: 0.0,
            target: None,
            blocked_s: 0.0,
            anchor: settings.position,
            still_s: 0.0,
        }
    }

    /// Body and pace; the position in it is that of the start.
    #[must_use]
    pub fn settings(&self) -> &PersonSettings {
        &self.settings
    }

    /// Position \[m\].
    #[must_use]
    pub fn position(&self) -> DVec2 {
        self.position
    }

    /// Velocity \[m/s\].
    #[must_use]
    pub fn velocity(&self) -> DVec2 {
        self.velocity
    }

    /// Velocity with which the agent would walk without others; zero while it waits and does not make room \[m/s\].
    #[must_use]
    pub fn preferred_velocity(&self) -> DVec2 {
        self.preferred
    }

    /// Unit vector in which the agent looks: that of its last walk.
    #[must_use]
    pub fn heading(&self) -> DVec2 {
        self.heading
    }

    /// State.
    #[must_use]
    pub fn state(&self) -> PersonState {
        self.state
    }

    /// Length of its path, which drives the legs \[m\].
    #[must_use]
    pub fn walked_m(&self) -> f64 {
        self.walked_m
    }

    /// Time for which the agent has walked without leaving a circle of 0.5 m; zero while it waits \[s\].
    #[must_use]
    pub fn still_s(&self) -> f64 {
        self.still_s
    }

    /// Time without progress: slow, or in one position \[s\].
    pub(crate) fn without_progress_s(&self) -> f64 {
        self.blocked_s.max(self.still_s)
    }

    /// Radius of the body; people who are blocked, or come no farther for long, turn sideways \[m\].
    pub(crate) fn body_radius_m(&self) -> f64 {
        /// Time without progress after which people begin to turn sideways \[s\].
        const TURN_AFTER_S: f64 = 2.0;
        /// Additional time of people that move and yet come no farther \[s\].
        const DELAY_S: f64 = 2.0;
        /// Time of the turn \[s\].
        const TURN_S: f64 = 2.0;
        /// Radius of a body that has turned, as a part of the whole: half of a chest of 0.26 m.
        const TURNED_RATIO: f64 = 0.65;
        let blocked_s = self.blocked_s.max(self.still_s - DELAY_S);
        let turned = ((blocked_s - TURN_AFTER_S) / TURN_S).clamp(0.0, 1.0);
        self.settings.radius_m * (1.0 - (1.0 - TURNED_RATIO) * turned)
    }
}
