//! People of a simulation.

use std::collections::BTreeMap;

use periplus_crowds::{CrowdSettings, DVec2, PeopleComfort, RobotComfort};
use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Pose;
use periplus_physics::{ModelId, PhysicsMode};

use super::{RunningModel, Simulation};
use crate::people::{
    FloorError, FloorSeeds, NamedRobot, People, PeopleRequest, PersonMotion, RobotShape,
    has_devices, populate,
};

/// Comfort of people near the robots of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct PeopleReport {
    /// Number of people.
    pub count: usize,
    /// Name of the model by which they steer.
    pub model: &'static str,
    /// Comfort of all people.
    pub people: PeopleComfort,
    /// Comfort near each robot, by its name.
    pub robots: BTreeMap<String, RobotComfort>,
}

/// Pose of a robot before a step.
pub(super) struct PoseBefore {
    model: ModelId,
    world_from_model: Pose,
}

impl Simulation {
    /// Adds people. With errors nothing is added.
    pub fn add_people(&mut self, request: &PeopleRequest) -> Diagnostics {
        let mut findings = Diagnostics::new();
        if self.people.is_some() {
            findings.push(Diagnostic::error("bad-people", "the world has people already"));
            return findings;
        }
        let mut shapes = BTreeMap::new();
        let robots = self.robots_with(&mut shapes);
        let obstacles: Vec<_> = robots.iter().map(|(_, robot)| *robot).collect();
        let members = request.parties.iter().flat_map(|party| &party.members);
        let starts = members.filter_map(|person| person.position_m);
        let goals = request.goals.iter().map(|goal| goal.position_m);
        let seeds = FloorSeeds {
            positions: starts.chain(goals).map(DVec2::from).collect(),
            area_m: request.spawn_area_m,
            robots: obstacles.iter().map(|robot| 0.5 * (robot.axis[0] + robot.axis[1])).collect(),
        };
        let floor =
            match self.people_floor(request.floor_m, &seeds) {
                Ok(floor) => floor,
                Err(FloorError::NotFree) => {
                    let message = "people have no floor: walls or furniture are where they start";
                    findings.push(Diagnostic::error("bad-people", message).help(
                        "move `at` or `spawn` to free floor, or set the height of the `floor`",
                    ));
                    return findings;
                }
                Err(FloorError::Crowd(error)) => {
                    findings.push(Diagnostic::error("bad-people", error.to_string()));
                    return findings;
                }
            };
        let settings = CrowdSettings {
            model: request.model,
            seed: request.seed.unwrap_or(self.options.seed),
            threads: self.options.threads,
        };
        let population = populate(floor, request, settings, &obstacles, &mut findings);
        let Some(population) = population else { return findings };
        let is_known = |name: &String| {
            self.place_of(name).is_some() || self.actors.iter().any(|actor| actor.name() == name)
        };
        if let Some(name) = population.names.iter().find(|name| is_known(name)) {
            findings.push(
                Diagnostic::error("bad-people", format!("the world has a model `{name}` already"))
                    .help("give the person another `name`"),
            );
            return findings;
        }
        let mut people = People::new(
            population,
            request,
            self.time_ns,
            &mut self.views,
            &mut self.motion,
            &*self.files,
        );
        people.shapes = shapes;
        people.begin(&robots);
        people.push_bodies(self.time_ns, &mut self.motion);
        self.people = Some(people);
        self.place_people();
        findings
    }

    /// True if the world has people.
    #[must_use]
    pub fn has_people(&self) -> bool {
        self.people.is_some()
    }

    /// Names of the people with their states.
    pub fn people_motions(&self) -> impl Iterator<Item = (&str, PersonMotion)> {
        self.people.iter().flat_map(|people| {
            people.names().iter().map(String::as_str).zip(people.motions(self.time_ns))
        })
    }

    /// Comfort of the people near the robots so far; none without people.
    #[must_use]
    pub fn people_report(&self) -> Option<PeopleReport> {
        let people = self.people.as_ref()?;
        Some(PeopleReport {
            count: people.names().len(),
            model: people.crowd().model_name(),
            people: people.comfort().people(),
            robots: people.comfort().robots().clone(),
        })
    }

    pub(crate) fn people(&self) -> Option<&People> {
        self.people.as_ref()
    }

    pub(crate) fn people_mut(&mut self) -> Option<&mut People> {
        self.people.as_mut()
    }

    pub(crate) fn names_of_people(&self) -> Vec<String> {
        self.people.as_ref().map(|people| people.names().to_vec()).unwrap_or_default()
    }

    /// Names of robots, actors and people: all that moves by itself.
    pub(crate) fn names_of_moving(&self) -> Vec<String> {
        let robots = self.running.iter().filter(|it| is_robot(it)).map(|it| it.member.name.clone());
        let actors = self.actors.iter().map(|actor| actor.name().to_owned());
        robots.chain(actors).chain(self.names_of_people()).collect()
    }

    /// Steps the crowd up to the current time.
    pub(super) fn step_people(&mut self) {
        let Some(mut people) = self.people.take() else { return };
        if people.next_ns() <= self.time_ns {
            let robots = self.robots_with(&mut people.shapes);
            while people.next_ns() <= self.time_ns {
                people.advance(&robots);
            }
            people.push_bodies(self.time_ns, &mut self.motion);
        }
        self.people = Some(people);
    }

    /// Moves the figures of people to the current time.
    pub(super) fn place_people(&mut self) {
        if let Some(people) = &self.people {
            people.place_figures(self.time_ns, &mut self.views);
        }
    }

    /// Puts people back to their start at the current time.
    pub(super) fn restart_people(&mut self) {
        let Some(mut people) = self.people.take() else { return };
        let robots = self.robots_with(&mut people.shapes);
        people.restart(self.time_ns);
        people.begin(&robots);
        people.place_bodies(self.time_ns, &mut self.motion);
        people.push_bodies(self.time_ns, &mut self.motion);
        self.people = Some(people);
        self.place_people();
    }

    /// Poses of the robots that motion without contacts could move into people.
    pub(super) fn poses_before(&self) -> Vec<PoseBefore> {
        if self.people.is_none() || self.options.mode != PhysicsMode::Kinematic {
            return Vec::new();
        }
        let robots = self.running.iter().filter(|it| is_robot(it));
        let poses = robots.filter_map(|robot| {
            let world_from_model = self.motion.model_pose(robot.model)?;
            Some(PoseBefore { model: robot.model, world_from_model })
        });
        poses.collect()
    }

    /// Puts robots that have moved into people back to their poses before the step, at rest.
    pub(super) fn hold_robots(&mut self, before: &[PoseBefore]) {
        let Some(people) = &self.people else { return };
        for PoseBefore { model, world_from_model } in before {
            let running = self.running.iter().find(|it| it.model == *model);
            let shape = running.and_then(|it| people.shapes.get(&it.build));
            let (Some(shape), Some(now)) = (shape, self.motion.model_pose(*model)) else {
                continue;
            };
            let [before, now] = [*world_from_model, now].map(|pose| shape.at(pose, DVec2::ZERO));
            if before.axis != now.axis && people.blocks(&before, &now, self.time_ns) {
                self.motion.set_pose(*model, *world_from_model);
            }
        }
    }

    /// Robots as people avoid them; shapes that are not known yet are added.
    fn robots_with(&self, shapes: &mut BTreeMap<u64, RobotShape>) -> Vec<NamedRobot> {
        let mut robots = Vec::new();
        for running in self.running.iter().filter(|it| is_robot(it)) {
            let Some(world_from_model) = self.motion.model_pose(running.model) else { continue };
            let shape = *shapes.entry(running.build).or_insert_with(|| {
                let footprint_m =
                    crate::footprint::footprint_m(&running.member.model, &*self.files);
                RobotShape::around(footprint_m.as_deref())
            });
            let link = self.motion.links(running.model).next();
            let state = link.and_then(|link| self.motion.link_state(link));
            let velocity = state.map_or(DVec2::ZERO, |state| state.linear_m_s.truncate());
            robots.push((running.member.name.clone(), shape.at(world_from_model, velocity)));
        }
        robots
    }
}

/// True for a robot: a described model, or one that moves and has plugins or sensors.
fn is_robot(running: &RunningModel) -> bool {
    let model = &running.member.model;
    (running.member.description.is_some() && !model.is_static) || has_devices(model)
}
