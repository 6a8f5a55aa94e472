//! One who explores.

use periplus_geometry::Pose2;
use periplus_grid::OccupancyGrid;

use crate::follow::{Velocity, follow};
use crate::frontier::{Frontier, frontiers};
use crate::reach::{Reach, Robot};

/// How somebody explores.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// The robot.
    pub robot: Robot,
    /// At most this fast.
    pub most: Velocity,
    /// A frontier shorter than this is let be \[m\].
    pub shortest_m: f64,
    /// How much way one metre of frontier is worth \[m\].
    pub worth: f64,
    /// There is near enough \[m\].
    pub tolerance_m: f64,
    /// A wall straight ahead that is nearer than this ends a way \[m\].
    pub stop_m: f64,
    /// Without coming on for so long it gives a place up \[ns\].
    pub patience_ns: i64,
    /// At the beginning it looks around for so long \[ns\].
    pub look_ns: i64,
}

impl Default for Settings {
    /// For a robot of half a metre indoors.
    fn default() -> Self {
        Self {
            robot: Robot { radius_m: 0.25, comfort_m: 0.6 },
            most: Velocity { forward_m_s: 0.5, left_rad_s: 1.0 },
            shortest_m: 0.3,
            worth: 0.5,
            tolerance_m: 0.3,
            stop_m: 0.3,
            patience_ns: 6_000_000_000,
            look_ns: 4_000_000_000,
        }
    }
}

/// What an explorer is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mood {
    /// It waits for a map, or looks around.
    Looks,
    /// It is on its way to something new.
    Goes,
    /// There is nothing new that it could reach: it goes back to where it began.
    Returns,
    /// All is seen.
    Done,
}

/// One who explores.
#[derive(Clone, Debug)]
pub struct Explorer {
    settings: Settings,
    mood: Mood,
    way: Vec<[f64; 2]>,
    home_m: Option<[f64; 2]>,
    /// Places that it could not reach \[m\].
    given_up: Vec<[f64; 2]>,
    began_ns: Option<i64>,
    /// Where and when it last came on.
    came_on: Option<([f64; 2], i64)>,
    backs_until_ns: i64,
}

/// Places nearer to each other than this are one \[m\].
const SAME_M: f64 = 0.5;

/// It has come on when it is so far from where it was \[m\].
const ON_M: f64 = 0.15;

/// Before a wall it goes back for so long \[ns\].
const BACK_NS: i64 = 1_000_000_000;

impl Explorer {
    /// One who has seen nothing yet.
    #[must_use]
    pub fn new(settings: Settings) -> Self {
        Self {
            settings,
            mood: Mood::Looks,
            way: Vec::new(),
            home_m: None,
            given_up: Vec::new(),
            began_ns: None,
            came_on: None,
            backs_until_ns: 0,
        }
    }

    /// What it is about.
    #[must_use]
    pub fn mood(&self) -> Mood {
        self.mood
    }

    /// The way that it follows \[m\].
    #[must_use]
    pub fn way(&self) -> &[[f64; 2]] {
        &self.way
    }

    /// Looks at a new map and chooses where to go.
    pub fn see(&mut self, map: &OccupancyGrid, map_from_base: Pose2) {
        let here = [map_from_base.x_m, map_from_base.y_m];
        let home_m = *self.home_m.get_or_insert(here);
        let Some(reach) = Reach::new(map, &self.settings.robot, here[0], here[1]) else { return };
        if reach.count() == 0 {
            // The map says nothing yet of where it stands: it looks around until it does.
            self.mood = Mood::Looks;
            self.way.clear();
            return;
        }
        let found = frontiers(&reach, self.settings.shortest_m);
        let open =
            |one: &&Frontier| !self.given_up.iter().any(|it| apart(*it, one.place_m) < SAME_M);
        let price = |one: &Frontier| one.cost_m - self.settings.worth * one.length_m;
        let best = found.iter().filter(open).min_by(|a, b| price(a).total_cmp(&price(b)));
        if let Some(best) = best {
            self.way = reach.way(best.cell);
            self.mood = Mood::Goes;
            return;
        }
        let home = map.info.cell_of(home_m[0], home_m[1]).map(|cell| map.info.index(cell));
        let way = home.map(|home| reach.way(home)).unwrap_or_default();
        let is_there = apart(here, home_m) < self.settings.tolerance_m || way.is_empty();
        self.mood = if is_there { Mood::Done } else { Mood::Returns };
        self.way = if is_there { Vec::new() } else { way };
    }

    /// The velocity now. `ahead_m` is how far it is to what stands in the way.
    pub fn drive(&mut self, time_ns: i64, map_from_base: Pose2, ahead_m: f64) -> Velocity {
        let settings = self.settings;
        let began_ns = *self.began_ns.get_or_insert(time_ns);
        let turn = Velocity { forward_m_s: 0.0, left_rad_s: settings.most.left_rad_s };
        if self.mood == Mood::Done {
            return Velocity::default();
        }
        if time_ns < began_ns + settings.look_ns {
            return turn;
        }
        if time_ns < self.backs_until_ns {
            return Velocity { forward_m_s: -0.3 * settings.most.forward_m_s, left_rad_s: 0.0 };
        }
        let here = [map_from_base.x_m, map_from_base.y_m];
        if self.is_stuck(time_ns, here) {
            self.give_up();
        }
        let Some(end) = self.way.last() else { return turn };
        if apart(*end, here) < settings.tolerance_m {
            // Something new comes into view; the next map says where to go.
            return turn;
        }
        let velocity = follow(&mut self.way, map_from_base, settings.most);
        if velocity.forward_m_s > 0.0 && ahead_m < settings.stop_m {
            self.give_up();
            self.backs_until_ns = time_ns + BACK_NS;
            return Velocity::default();
        }
        // Not faster than it can stop before what stands there.
        let most = (ahead_m - settings.stop_m).max(0.0) + 0.1;
        Velocity { forward_m_s: velocity.forward_m_s.min(most), ..velocity }
    }

    fn is_stuck(&mut self, time_ns: i64, here: [f64; 2]) -> bool {
        match self.came_on {
            Some((place, since_ns)) if apart(place, here) < ON_M => {
                time_ns - since_ns > self.settings.patience_ns
            }
            _ => {
                self.came_on = Some((here, time_ns));
                false
            }
        }
    }

    /// The place that it is on the way to cannot be reached.
    fn give_up(&mut self) {
        self.came_on = None;
        if let Some(end) = self.way.last() {
            self.given_up.push(*end);
        }
        self.way.clear();
    }
}

fn apart(one: [f64; 2], other: [f64; 2]) -> f64 {
    libm::hypot(one[0] - other[0], one[1] - other[1])
}
