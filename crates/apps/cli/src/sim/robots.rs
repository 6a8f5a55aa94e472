//! `--robot`, and the options that apply to the preceding robot.

use std::path::PathBuf;

use clap::{Arg, ArgAction, ArgMatches, Args, Command, Error, FromArgMatches, error::ErrorKind};
use periplus_geometry::{Pose, Rpy};
use periplus_sim::{PlacementPose, RobotPlacement};

use crate::error::CliError;
use crate::options::split;
use crate::run_options::finite_numbers;

/// Robots of a command line, in order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Robots {
    pub(crate) placements: Vec<RobotPlacement>,
    /// Words after a robot that are not its arguments: one may be the world.
    pub(crate) others: Vec<String>,
}

impl Robots {
    /// Returns the only world among the words of a command and those after a robot, and its xacro arguments.
    ///
    /// # Errors
    /// Without a world, or with several.
    pub(crate) fn world(
        &self,
        words: &[String],
        command: &str,
    ) -> Result<(PathBuf, Vec<(String, String)>), CliError> {
        let (mut files, arguments) = split(words);
        // `--robot FILE WORLD`: a word that is not an argument of the robot is the world.
        files.extend(self.others.iter().map(PathBuf::from));
        match files.as_slice() {
            [world] => Ok((world.clone(), arguments)),
            [] => Err(CliError::Usage(format!(
                "no world given; add robots with --robot; see `periplus {command} --help`"
            ))),
            several => {
                let names: Vec<_> = several.iter().map(|it| it.display().to_string()).collect();
                Err(CliError::Usage(format!(
                    "expected one world, got {}: {}; give each robot a separate --robot",
                    names.len(),
                    names.join(", ")
                )))
            }
        }
    }
}

const ROBOT: &str = "robot";
const NAME: &str = "name";
const NAMESPACE: &str = "namespace";
const POSE: &str = "pose";

impl Args for Robots {
    fn augment_args(command: Command) -> Command {
        let option = |id: &'static str| Arg::new(id).long(id).action(ArgAction::Append);
        command
            .arg(
                option(ROBOT)
                    .value_names(["FILE", "NAME:=VALUE"])
                    .num_args(1..)
                    .help("Robot to add to the world: URDF, xacro with `name:=value`, or SDF; repeatable. The next three options apply to the robot before them"),
            )
            .arg(
                option(NAME)
                    .value_name("NAME")
                    .help("Name of the robot [default: the name in its file]"),
            )
            .arg(option(NAMESPACE).value_name("NAMESPACE").help(
                "Namespace of the robot's topics [default for several robots: the robot's name]",
            ))
            .arg(
                option(POSE)
                    .value_name("X,Y,YAW")
                    .allow_hyphen_values(true)
                    .help("Initial pose on the floor [m, rad]: X,Y (yaw 0), X,Y,YAW, or X,Y,Z,ROLL,PITCH,YAW"),
            )
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for Robots {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        // Files with their positions on the command line, then the options of the nearest preceding
        // one.
        let mut robots: Vec<(usize, RobotPlacement)> = Vec::new();
        let mut others = Vec::new();
        for (group, index) in groups(matches, ROBOT) {
            let mut words = group.into_iter();
            let file = words.next().map(PathBuf::from).unwrap_or_default();
            let mut arguments = Vec::new();
            for word in words {
                match word.split_once(":=") {
                    Some((name, value)) => arguments.push((name.to_owned(), value.to_owned())),
                    None => others.push(word),
                }
            }
            robots.push((index, RobotPlacement { file, arguments, ..RobotPlacement::default() }));
        }
        let mut told =
            |id: &'static str,
             tell: &mut dyn FnMut(&mut RobotPlacement, &str) -> Result<(), String>| {
                for (group, index) in groups(matches, id) {
                    let before = robots.iter_mut().rev().find(|(place, _)| *place < index);
                    let Some((_, robot)) = before else {
                        return Err(wrong(format!("--{id} must follow a --robot")));
                    };
                    tell(robot, &group.concat()).map_err(wrong)?;
                }
                Ok(())
            };
        told(NAME, &mut |robot, word| {
            robot.name = Some(word.to_owned());
            Ok(())
        })?;
        told(NAMESPACE, &mut |robot, word| {
            robot.namespace = Some(word.to_owned());
            Ok(())
        })?;
        told(POSE, &mut |robot, word| {
            robot.pose = standing(word)?;
            Ok(())
        })?;
        let placements = robots.into_iter().map(|(_, robot)| robot).collect();
        Ok(Self { placements, others })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// Values of each use of an option, with the index of the first.
fn groups(matches: &ArgMatches, id: &str) -> Vec<(Vec<String>, usize)> {
    let Some(uses) = matches.get_occurrences::<String>(id) else { return Vec::new() };
    let mut indices = matches.indices_of(id).into_iter().flatten();
    uses.map(|values| {
        let values: Vec<String> = values.cloned().collect();
        let places: Vec<usize> = indices.by_ref().take(values.len()).collect();
        (values, places.first().copied().unwrap_or_default())
    })
    .collect()
}

fn standing(word: &str) -> Result<PlacementPose, String> {
    match finite_numbers(word).as_deref() {
        Some(&[x, y]) => Ok(PlacementPose::OnGround([x, y, 0.0])),
        Some(&[x, y, yaw]) => Ok(PlacementPose::OnGround([x, y, yaw])),
        Some(&[x, y, z, roll, pitch, yaw]) => {
            Ok(PlacementPose::At(Pose::from_xyz_rpy([x, y, z], Rpy { roll, pitch, yaw })))
        }
        _ => Err(format!("`{word}` is not a pose; write X,Y,YAW or X,Y,Z,ROLL,PITCH,YAW")),
    }
}

fn wrong(words: String) -> Error {
    Error::raw(ErrorKind::ValueValidation, words + "\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(line: &str) -> Result<Vec<RobotPlacement>, String> {
        let command = Robots::augment_args(Command::new("sim").arg(Arg::new("world")));
        let matches = command.try_get_matches_from(line.split(' ')).map_err(|e| e.to_string())?;
        Robots::from_arg_matches(&matches)
            .map(|robots| robots.placements)
            .map_err(|e| e.to_string())
    }

    #[test]
    fn options_belong_to_the_robot_before_them() {
        let robots = read(
            "sim world --robot a.urdf x:=1 y:=2 --pose -1,2,0.5 --robot b.urdf --name r2 --namespace /b",
        )
        .unwrap();
        assert_eq!(robots.len(), 2);
        assert_eq!(robots[0].file, PathBuf::from("a.urdf"));
        assert_eq!(robots[0].arguments[1], ("y".to_owned(), "2".to_owned()));
        assert_eq!(robots[0].pose, PlacementPose::OnGround([-1.0, 2.0, 0.5]));
        assert_eq!((robots[0].name.as_deref(), robots[1].name.as_deref()), (None, Some("r2")));
        assert_eq!(robots[1].namespace.as_deref(), Some("/b"));
    }

    #[test]
    fn a_world_behind_a_robot_is_no_argument_of_it() {
        let command = Robots::augment_args(Command::new("sim").arg(Arg::new("world")));
        let words = "sim --robot a.urdf x:=1 room.sdf --pose 0,0,1".split(' ');
        let robots = Robots::from_arg_matches(&command.get_matches_from(words)).unwrap();
        assert_eq!(robots.others, ["room.sdf"]);
        assert_eq!(robots.placements[0].arguments, [("x".to_owned(), "1".to_owned())]);
    }

    #[test]
    fn slips_are_told() {
        assert!(
            read("sim world --pose 1,2,3").unwrap_err().contains("--pose must follow a --robot")
        );
        assert!(read("sim world --robot a.urdf --pose 1,x").unwrap_err().contains("X,Y,YAW"));
    }
}
