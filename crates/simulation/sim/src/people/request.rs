//! Requests for people in a world.

use periplus_crowds::{DoorControl, SteeringModel};
use periplus_diagnostics::{Origin, SourceMap};

/// Mean preferred speed of people (Weidmann 1993) \[m/s\].
pub(crate) const MEAN_SPEED_M_PER_S: f64 = 1.34;

/// Standard deviation of the preferred speed (Weidmann 1993) \[m/s\].
pub(crate) const SPEED_DEVIATION_M_PER_S: f64 = 0.26;

/// People to add to a world.
#[derive(Clone, Debug, PartialEq)]
pub struct PeopleRequest {
    /// Model by which they steer.
    pub model: SteeringModel,
    /// Seed of all random choices; by default that of the simulation.
    pub seed: Option<u64>,
    /// Number of people at random positions that wander between all goals, besides those of `parties`.
    pub count: usize,
    /// Two corners of the area in which they start \[m\]; by default the whole floor.
    pub spawn_area_m: Option<[[f64; 2]; 2]>,
    /// Mean of their preferred speed \[m/s\].
    pub mean_speed_m_per_s: f64,
    /// Standard deviation of their preferred speed \[m/s\].
    pub speed_deviation_m_per_s: f64,
    /// Sizes of their groups; each group draws one of them.
    pub group_sizes: Vec<usize>,
    /// Height of the floor on which people walk \[m\].
    pub floor_m: f64,
    /// Goals; without any they are spread over the free floor.
    pub goals: Vec<RequestedGoal>,
    /// Doors.
    pub doors: Vec<RequestedDoor>,
    /// People that are given one by one, in their groups.
    pub parties: Vec<RequestedParty>,
}

impl PeopleRequest {
    /// People that wander over the floor of a world.
    #[must_use]
    pub fn wandering(count: usize) -> Self {
        Self {
            model: SteeringModel::SocialForce(periplus_crowds::SocialForceParams::default()),
            seed: None,
            count,
            spawn_area_m: None,
            mean_speed_m_per_s: MEAN_SPEED_M_PER_S,
            speed_deviation_m_per_s: SPEED_DEVIATION_M_PER_S,
            group_sizes: vec![1],
            floor_m: 0.0,
            goals: Vec::new(),
            doors: Vec::new(),
            parties: Vec::new(),
        }
    }
}

/// Goal in a request.
#[derive(Clone, Debug, PartialEq)]
pub struct RequestedGoal {
    /// Its name.
    pub name: String,
    /// Centre in the frame of the world \[m\].
    pub position_m: [f64; 2],
    /// Distance at which it is reached \[m\].
    pub radius_m: f64,
    /// Shortest and longest stay \[s\].
    pub stay_s: [f64; 2],
    /// Source location.
    pub origin: Origin,
}

/// Door in a request.
#[derive(Clone, Debug, PartialEq)]
pub struct RequestedDoor {
    /// Its name.
    pub name: String,
    /// Ends of the leaf when closed, in the frame of the world \[m\].
    pub ends_m: [[f64; 2]; 2],
    /// Operation.
    pub control: DoorControl,
    /// True if it is open at the start.
    pub is_open: bool,
    /// Source location.
    pub origin: Origin,
}

/// People with one plan: a group, or a single person.
#[derive(Clone, Debug, PartialEq)]
pub struct RequestedParty {
    /// Its members.
    pub members: Vec<RequestedPerson>,
    /// Plan.
    pub plan: RequestedPlan,
    /// Source location.
    pub origin: Origin,
}

/// Plan of a party.
#[derive(Clone, Debug, PartialEq)]
pub enum RequestedPlan {
    /// Remain at the start, and step aside for others.
    Stand,
    /// Visit all goals at random.
    Wander,
    /// Visit goals in their order.
    Visit {
        /// Indices of the goals.
        goals: Vec<usize>,
        /// True to start again after the last.
        repeats: bool,
    },
}

/// Person in a request.
#[derive(Clone, Debug, PartialEq)]
pub struct RequestedPerson {
    /// Name; by default `person_N`.
    pub name: Option<String>,
    /// Position in the frame of the world \[m\]; by default a random one.
    pub position_m: Option<[f64; 2]>,
    /// Radius of the body \[m\].
    pub radius_m: f64,
    /// Preferred speed \[m/s\]; by default a random one.
    pub speed_m_per_s: Option<f64>,
    /// Source location.
    pub origin: Origin,
}

/// Request from a file, with the text to which its findings refer.
#[derive(Debug)]
pub struct PeopleFile {
    /// Request.
    pub request: PeopleRequest,
    /// Text of the file.
    pub sources: SourceMap,
}

impl PeopleFile {
    /// Request without a file.
    #[must_use]
    pub fn wandering(count: usize) -> Self {
        Self { request: PeopleRequest::wandering(count), sources: SourceMap::new() }
    }
}
