//! Population of a floor: goals and starts that a request leaves open.

use periplus_crowds::{
    Crowd, CrowdError, CrowdSettings, DVec2, Door, Floor, MovingObstacle, PersonGoal, PersonGoalId,
    PersonPlan, PersonSettings, Wall,
};
use periplus_diagnostics::{Diagnostic, Diagnostics, Origin};
use periplus_geometry::Stream;

use super::request::{PeopleRequest, RequestedParty, RequestedPerson, RequestedPlan};

/// Smallest distance from walls of a start \[m\].
const START_CLEARANCE_M: f64 = 0.35;

/// Smallest distance from walls of a goal that is chosen \[m\].
const GOAL_CLEARANCE_M: f64 = 0.5;

/// Smallest distance from walls of a position of the request \[m\].
const MIN_CLEARANCE_M: f64 = 0.2;

/// Smallest distance of two starts \[m\].
const START_GAP_M: f64 = 0.6;

/// Smallest distance of a start from a robot \[m\].
const ROBOT_GAP_M: f64 = 1.0;

/// Distance within which the members of a group start \[m\].
const GROUP_REACH_M: f64 = 2.0;

/// Number of random positions that are tried for a start or a goal.
const MAX_TRY_COUNT: usize = 2000;

/// Area of the floor for each goal that is chosen \[m²\].
const AREA_PER_GOAL_M2: f64 = 15.0;

/// Minimum number of goals that are chosen.
const MIN_GOAL_COUNT: usize = 4;

/// Maximum number of goals that are chosen.
const MAX_GOAL_COUNT: usize = 24;

/// Stay at a goal that is chosen \[s\].
const STAY_S: [f64; 2] = [2.0, 10.0];

/// Slowest and fastest preferred speed that is drawn \[m/s\].
const SPEED_RANGE_M_PER_S: [f64; 2] = [0.6, 2.0];

/// Area of a cell of the floor's free points \[m²\].
const POINT_AREA_M2: f64 = 0.01;

/// Crowd with the names of its people.
pub(crate) struct Population {
    pub(crate) crowd: Crowd,
    pub(crate) names: Vec<String>,
}

/// Free positions of a floor, and random numbers.
struct Starts<'a> {
    request: &'a PeopleRequest,
    seed: u64,
    robots: &'a [MovingObstacle],
    /// Points with room for a start, in the spawn area.
    points: Vec<DVec2>,
    /// Points with room for a body.
    reachable: Vec<DVec2>,
    taken: Vec<DVec2>,
    draws: u64,
}

/// Makes the crowd of a request on a floor. Errors are reported; then there is no crowd.
pub(crate) fn populate(
    floor: Floor,
    request: &PeopleRequest,
    settings: CrowdSettings,
    robots: &[MovingObstacle],
    findings: &mut Diagnostics,
) -> Option<Population> {
    let mut starts = Starts {
        points: floor.free_points(START_CLEARANCE_M),
        reachable: floor.free_points(MIN_CLEARANCE_M),
        request,
        seed: settings.seed,
        robots,
        taken: Vec::new(),
        draws: 0,
    };
    let goals = starts.goals(&floor, findings)?;
    if let Some([one, two]) = request.spawn_area_m.map(|area| area.map(DVec2::from)) {
        let (low, high) = (one.min(two), one.max(two));
        starts.points.retain(|point| point.cmpge(low).all() && point.cmple(high).all());
    }
    let mut crowd = Crowd::new(floor, settings);
    let mut ids = Vec::with_capacity(goals.len());
    for (goal, origin) in goals {
        match crowd.add_goal(goal) {
            Ok(id) => ids.push(id),
            Err(error) => findings.push(refused(error, origin)),
        }
    }
    for door in &request.doors {
        let [start, end] = door.ends_m;
        let leaf = Wall::new(start, end);
        crowd.add_door(Door { leaf, is_open: door.is_open, control: door.control });
    }
    let mut names: Vec<String> = Vec::new();
    for party in &request.parties {
        add_party(&mut crowd, party, &ids, &mut starts, &mut names, findings);
    }
    let mut left = request.count;
    let mut group = 0;
    while left > 0 && !findings.has_errors() {
        let mut stream = Stream::keyed(settings.seed, "people group", group);
        group += 1;
        let size = draw(&mut stream, &request.group_sizes).copied().unwrap_or(1).clamp(1, left);
        left -= size;
        let party = RequestedParty {
            members: vec![RequestedPerson::anyone(); size],
            plan: RequestedPlan::Wander,
            origin: Origin::default(),
        };
        add_party(&mut crowd, &party, &ids, &mut starts, &mut names, findings);
    }
    (!findings.has_errors()).then_some(Population { crowd, names })
}

impl RequestedPerson {
    /// Person whose position, speed and name are chosen.
    fn anyone() -> Self {
        Self {
            name: None,
            position_m: None,
            radius_m: 0.2,
            speed_m_per_s: None,
            origin: Origin::default(),
        }
    }
}

/// Adds a party with the positions and speeds that it leaves open.
fn add_party(
    crowd: &mut Crowd,
    party: &RequestedParty,
    ids: &[PersonGoalId],
    starts: &mut Starts<'_>,
    names: &mut Vec<String>,
    findings: &mut Diagnostics,
) {
    let mut members: Vec<PersonSettings> = Vec::new();
    for person in &party.members {
        let near = members.first().map(|first| first.position);
        let Some(position) = starts.position(person, near, findings) else { return };
        let number = names.len();
        let speed_m_per_s = person.speed_m_per_s.unwrap_or_else(|| starts.speed_m_per_s(number));
        let settings = PersonSettings { radius_m: person.radius_m, ..PersonSettings::at(position) };
        members.push(settings.with_speed(speed_m_per_s));
        let name = person.name.clone().unwrap_or_else(|| format!("person_{number}"));
        if names.contains(&name) {
            findings.push(
                Diagnostic::error("bad-people", format!("two people have the name `{name}`"))
                    .at(person.origin)
                    .help("give each person another `name`"),
            );
        }
        names.push(name);
    }
    let plan = match &party.plan {
        RequestedPlan::Stand => PersonPlan::Stand,
        RequestedPlan::Wander => PersonPlan::Wander,
        RequestedPlan::Visit { goals, repeats } => PersonPlan::Visit {
            goals: goals.iter().filter_map(|goal| ids.get(*goal).copied()).collect(),
            repeats: *repeats,
        },
    };
    if let Err(error) = crowd.add_group(&members, plan) {
        findings.push(refused(error, party.origin));
    }
}

fn refused(error: CrowdError, origin: Origin) -> Diagnostic {
    Diagnostic::error("bad-people", error.to_string()).at(origin)
}

impl Starts<'_> {
    /// Goals of the request, or goals that are spread over the floor.
    fn goals(
        &mut self,
        floor: &Floor,
        findings: &mut Diagnostics,
    ) -> Option<Vec<(PersonGoal, Origin)>> {
        let mut goals = Vec::new();
        for goal in &self.request.goals {
            let centre = DVec2::from(goal.position_m);
            if !self.is_reachable(centre) {
                findings.push(
                    Diagnostic::error(
                        "bad-people",
                        format!("people cannot walk to the goal `{}`", goal.name),
                    )
                    .at(goal.origin)
                    .note("it is in or near a wall, or on another floor than the people")
                    .help("move `at` to free floor, 0.2 m from walls and furniture"),
                );
            }
            let goal = PersonGoal { centre, radius_m: goal.radius_m, stay_s: goal.stay_s };
            goals.push((goal, goal_origin(self.request, goals.len())));
        }
        let wanders = self.request.count > 0
            || self.request.parties.iter().any(|party| party.plan == RequestedPlan::Wander);
        if goals.is_empty() && wanders {
            goals = self.spread_goals(floor);
            if goals.len() < 2 {
                findings.push(
                    Diagnostic::error("bad-people", "the floor has no room for people that walk")
                        .note(format!(
                            "people walk on {:.1} m² of floor around the robots",
                            self.reachable.len() as f64 * POINT_AREA_M2
                        ))
                        .help("use a larger world, or another pose of the robot"),
                );
            }
        }
        (!findings.has_errors()).then_some(goals)
    }

    /// Goals that are apart from each other, at random positions with room around them.
    fn spread_goals(&mut self, floor: &Floor) -> Vec<(PersonGoal, Origin)> {
        let mut points = floor.free_points(GOAL_CLEARANCE_M);
        if points.len() < 100 {
            points.clone_from(&self.points);
        }
        let area_m2 = points.len() as f64 * POINT_AREA_M2;
        let count = ((area_m2 / AREA_PER_GOAL_M2) as usize).clamp(MIN_GOAL_COUNT, MAX_GOAL_COUNT);
        let gap_m = 0.6 * (area_m2 / count as f64).sqrt();
        let mut stream = Stream::keyed(self.seed, "people goals", 0);
        let mut goals: Vec<(PersonGoal, Origin)> = Vec::new();
        for _ in 0..MAX_TRY_COUNT {
            let Some(point) = draw(&mut stream, &points).filter(|_| goals.len() < count) else {
                break;
            };
            if goals.iter().all(|(goal, _)| goal.centre.distance(*point) >= gap_m) {
                let goal = PersonGoal { stay_s: STAY_S, ..PersonGoal::at(*point) };
                goals.push((goal, Origin::default()));
            }
        }
        goals
    }

    fn is_reachable(&self, position: DVec2) -> bool {
        self.reachable.iter().any(|point| point.distance(position) <= 0.1)
    }

    /// Start of a person, near the first member of its group.
    fn position(
        &mut self,
        person: &RequestedPerson,
        near: Option<DVec2>,
        findings: &mut Diagnostics,
    ) -> Option<DVec2> {
        if let Some(position) = person.position_m.map(DVec2::from) {
            let is_free = self.is_reachable(position);
            let robot = self.robots.iter().any(|it| it.distance_m(position) < person.radius_m);
            if !is_free || robot {
                let message = if robot {
                    "a person starts in a robot"
                } else {
                    "a person does not start on free floor"
                };
                findings.push(
                    Diagnostic::error("bad-people", message)
                        .at(person.origin)
                        .note("the floor has to be connected with that of the first person or goal")
                        .help("move `at` to free floor, 0.2 m from walls and furniture"),
                );
                return None;
            }
            self.taken.push(position);
            return Some(position);
        }
        let mut stream = Stream::keyed(self.seed, "people start", self.draws);
        self.draws += 1;
        let candidates: Vec<DVec2> = match near {
            Some(near) => {
                let is_near = |point: &&DVec2| point.distance(near) <= GROUP_REACH_M;
                self.points.iter().filter(is_near).copied().collect()
            }
            None => Vec::new(),
        };
        let points = if near.is_some() { &candidates } else { &self.points };
        let is_free = |point: &DVec2| {
            self.taken.iter().all(|taken| taken.distance(*point) >= START_GAP_M)
                && self.robots.iter().all(|robot| robot.distance_m(*point) >= ROBOT_GAP_M)
        };
        let found =
            (0..MAX_TRY_COUNT).map_while(|_| draw(&mut stream, points).copied()).find(is_free);
        match found {
            Some(position) => self.taken.push(position),
            None => findings.push(
                Diagnostic::error(
                    "bad-people",
                    format!("the floor has room for {} people", self.taken.len()),
                )
                .at(person.origin)
                .note("people start 0.6 m apart, 0.35 m from walls, and 1 m from robots")
                .help("ask for fewer people, or for a larger `spawn` area"),
            ),
        }
        found
    }

    /// Preferred speed of a person, from the normal distribution of the request \[m/s\].
    fn speed_m_per_s(&self, number: usize) -> f64 {
        let mut stream = Stream::keyed(self.seed, "people speed", number as u64);
        let [low, high] = SPEED_RANGE_M_PER_S;
        let (mean, deviation) =
            (self.request.mean_speed_m_per_s, self.request.speed_deviation_m_per_s);
        (mean + deviation * stream.normal()).clamp(low.min(mean), high.max(mean))
    }
}

fn goal_origin(request: &PeopleRequest, number: usize) -> Origin {
    request.goals.get(number).map(|goal| goal.origin).unwrap_or_default()
}

/// Draws an element of a list.
fn draw<'a, T>(stream: &mut Stream, from: &'a [T]) -> Option<&'a T> {
    from.get(((stream.unit() * from.len() as f64) as usize).min(from.len().saturating_sub(1)))
}
