//! Frontier exploration of a robot.

use periplus_geometry::Pose2;
use periplus_grid::OccupancyGrid;

use crate::follow::{Velocity, follow};
use crate::frontier::{Frontier, frontiers};
use crate::reach::{Reach, Robot};

/// Settings of the exploration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Geometry of the robot.
    pub robot: Robot,
    /// Maximum velocities.
    pub most: Velocity,
    /// Minimum length of a frontier \[m\].
    pub shortest_m: f64,
    /// Path length that one metre of frontier is worth \[m/m\].
    pub worth: f64,
    /// Distance at which a goal counts as reached \[m\].
    pub tolerance_m: f64,
    /// Distance of an obstacle straight ahead at which a path is aborted \[m\].
    pub stop_m: f64,
    /// Time without progress after which a goal is abandoned \[ns\].
    pub patience_ns: i64,
    /// Duration of the initial rotation \[ns\].
    pub look_ns: i64,
}

impl Default for Settings {
    /// Settings for a robot of half a metre indoors.
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

/// State of the exploration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mood {
    /// Waits for a map, or rotates to complete it.
    Looks,
    /// Drives to a frontier.
    Goes,
    /// No reachable frontier is left: drives back to the start.
    Returns,
    /// The exploration is complete.
    Done,
}

/// Frontier explorer.
#[derive(Clone, Debug)]
pub struct Explorer {
    settings: Settings,
    mood: Mood,
    way: Vec<[f64; 2]>,
    home_m: Option<[f64; 2]>,
    /// Goals that could not be reached \[m\].
    given_up: Vec<[f64; 2]>,
    began_ns: Option<i64>,
    /// Position and time of the last progress.
    came_on: Option<([f64; 2], i64)>,
    backs_until_ns: i64,
}

/// Distance below which two goals are the same \[m\].
const SAME_M: f64 = 0.5;

/// Distance that counts as progress \[m\].
const ON_M: f64 = 0.15;

/// Duration of driving backwards from an obstacle \[ns\].
const BACK_NS: i64 = 1_000_000_000;

impl Explorer {
    /// Creates an explorer without a map.
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

    /// Returns the state.
    #[must_use]
    pub fn mood(&self) -> Mood {
        self.mood
    }

    /// Returns the path that it follows \[m\].
    #[must_use]
    pub fn way(&self) -> &[[f64; 2]] {
        &self.way
    }

    /// Selects a goal on a new map.
    pub fn see(&mut self, map: &OccupancyGrid, map_from_base: Pose2) {
        let here = [map_from_base.x_m, map_from_base.y_m];
        let home_m = *self.home_m.get_or_insert(here);
        let Some(reach) = Reach::new(map, &self.settings.robot, here[0], here[1]) else { return };
        if reach.count() == 0 {
            // The robot is in an unknown cell: it rotates until the map covers it.
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

    /// Returns the velocity command. `ahead_m` is the distance to the nearest obstacle ahead.
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
            // New space comes into view; the next map selects the goal.
            return turn;
        }
        let velocity = follow(&mut self.way, map_from_base, settings.most);
        if velocity.forward_m_s > 0.0 && ahead_m < settings.stop_m {
            self.give_up();
            self.backs_until_ns = time_ns + BACK_NS;
            return Velocity::default();
        }
        // Limits the speed to the braking distance before an obstacle.
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

    /// Abandons the current goal as unreachable.
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
