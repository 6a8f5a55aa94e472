//! Composition of a world and robots from files.

use std::path::{Path, PathBuf};

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{Pose, Pose2};
use periplus_loader::{
    LoadContext, LoadedFile, load, load_bytes, settle_images, settle_parameter_files,
};
use periplus_scene::{Model, Scene, World};
use periplus_xml::write_document;

use crate::default_world;

/// A robot to add to a world.
#[derive(Clone, Debug, Default)]
pub struct RobotPlacement {
    /// File of the robot: URDF, xacro, or an SDF with one model.
    pub file: PathBuf,
    /// Xacro arguments, `name:=value`.
    pub arguments: Vec<(String, String)>,
    /// Name of the robot; by default that of its file, with a number appended when it is in use.
    pub name: Option<String>,
    /// Namespace of its topics; by default none for a single robot, and its name for one of several.
    pub namespace: Option<String>,
    /// Pose of the robot.
    pub pose: PlacementPose,
}

/// Pose of a robot.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum PlacementPose {
    /// At the pose of its file, or above the origin so that it touches the floor.
    #[default]
    AsWritten,
    /// On the plane z = 0, at x, y \[m\] and yaw \[rad\].
    OnGround([f64; 3]),
    /// `world_from_model`.
    At(Pose),
}

/// A model to simulate, and its source.
#[derive(Clone, Debug)]
pub struct ModelInstance {
    /// The model.
    pub model: Model,
    /// Name in the world.
    pub name: String,
    /// Namespace of its nodes; `/` is none.
    pub namespace: String,
    /// True for one of several copies: absolute names of its description are in its namespace too.
    pub is_copy: bool,
    /// Pose of its frame in the world.
    pub world_from_model: Pose,
    /// Text that `robot_description` publishes, for a URDF or for the SDF of one robot.
    pub description: Option<String>,
    /// Index of its file in [`Composition::files`].
    pub file: usize,
}

/// A world with all of its models.
#[derive(Debug)]
pub struct Composition {
    /// The world without its models, which are in `members`.
    pub world: World,
    /// Models, those of the world first.
    pub members: Vec<ModelInstance>,
    /// Files with their findings; the world file comes first.
    pub files: Vec<LoadedFile>,
    /// True if the world is the default plane, since none of the files has one.
    pub is_default_world: bool,
}

impl Composition {
    /// Returns true if any file has an error, so that something is missing.
    #[must_use]
    pub fn has_errors(&self) -> bool {
        self.files.iter().any(|file| file.diagnostics.has_errors())
    }

    /// Returns the first file that could not be used.
    #[must_use]
    pub fn missing(&self) -> Option<&Path> {
        let from = |file: usize| self.members.iter().any(|member| member.file == file);
        let empty =
            |(file, loaded): &(usize, &LoadedFile)| loaded.diagnostics.has_errors() && !from(*file);
        self.files.iter().enumerate().find(empty).map(|(_, loaded)| loaded.path.as_path())
    }

    /// Puts the last robot at the first of these poses on the plane z = 0, and a copy of it at each other one. They
    /// are named like it with numbers, and each has its name as namespace, in which its absolute names are too.
    pub fn spread_last(&mut self, poses: &[Pose2]) {
        let Some(robot) = self.members.pop() else { return };
        let stand =
            |pose: &Pose2| default_world::standing(&robot.model, pose.x_m, pose.y_m, pose.yaw_rad);
        for (number, pose) in poses.iter().enumerate() {
            let name = format!("{}_{number}", robot.name);
            self.members.push(ModelInstance {
                namespace: absolute(&name),
                is_copy: true,
                name,
                world_from_model: stand(pose),
                ..robot.clone()
            });
        }
    }

    /// Returns the real-time factor of the world; `None` if it is unlimited.
    #[must_use]
    pub fn real_time_factor(&self) -> Option<f64> {
        let factor = self.world.physics.first().map_or(1.0, |physics| physics.real_time_factor);
        (factor.is_finite() && factor > 1e-9).then_some(factor)
    }
}

/// Reads a world and robots. A world file that is a robot or a model is placed on a plane with a
/// sun. Findings are in [`Composition::files`]; files that cannot be read are omitted.
#[must_use]
pub fn compose(world: &Path, robots: &[RobotPlacement], setting: &LoadContext<'_>) -> Composition {
    let mut first = load(world, setting);
    for name in first.unknown_arguments(&setting.arguments) {
        first.warn_of_argument(name);
    }
    compose_loaded(first, robots, setting)
}

/// Returns an empty plane with a sun, and robots on it.
#[must_use]
pub fn compose_plain(robots: &[RobotPlacement], setting: &LoadContext<'_>) -> Composition {
    let composition = compose_loaded(plain_world(setting), robots, setting);
    Composition { is_default_world: true, ..composition }
}

/// Reads a world from the text of its file.
pub(crate) fn compose_text(path: &Path, text: &str, setting: &LoadContext<'_>) -> Composition {
    compose_loaded(load_bytes(path, text.as_bytes(), setting), &[], setting)
}

fn compose_loaded(
    mut first: LoadedFile,
    robots: &[RobotPlacement],
    setting: &LoadContext<'_>,
) -> Composition {
    settle(&mut first, setting);
    if first.scene.is_none() && !first.diagnostics.has_errors() {
        let what = first.language.name();
        let told = Diagnostic::error("no-world", format!("a {what} contains no world to simulate"));
        let told = first.language.advice().into_iter().fold(told, Diagnostic::help);
        let told = told.help("use an SDF world, or a robot, which is placed on a plane with a sun");
        first.diagnostics.push(told);
    }
    let mut scene = first.scene.take().unwrap_or_default();
    if scene.worlds.len() > 1 {
        let others: Vec<&str> = scene.worlds[1..].iter().map(|world| world.name.as_str()).collect();
        first.diagnostics.push(
            Diagnostic::warning("several-worlds", "only the first world of the file is simulated")
                .note(format!("omitted: {}", others.join(", "))),
        );
    }
    let lonely = scene.worlds.is_empty();
    let description = description_of(&first);
    let mut files = vec![first];
    let mut world = if lonely {
        // A separate file, since its findings refer to its own text.
        let mut plain = plain_world(setting);
        let world = plain.scene.as_mut().and_then(|scene| scene.worlds.pop());
        files.push(plain);
        world.unwrap_or_else(|| World::empty("default"))
    } else {
        scene.worlds.remove(0)
    };
    let file_of_world = files.len() - 1;
    let mut members: Vec<ModelInstance> = Vec::new();
    let add = |model: Model, placed: Placed<'_>, file: usize, members: &mut Vec<ModelInstance>| {
        let taken = |name: &str| members.iter().any(|member| member.name == name);
        let wanted = placed.name.unwrap_or(&model.name).to_owned();
        let mut name = wanted.clone();
        let mut number = 0;
        while taken(&name) {
            number += 1;
            name = format!("{wanted}_{number}");
        }
        let world_from_model = match placed.standing {
            PlacementPose::At(pose) => pose,
            PlacementPose::OnGround([x, y, yaw]) => default_world::standing(&model, x, y, yaw),
            PlacementPose::AsWritten if placed.is_robot => {
                default_world::standing(&model, 0.0, 0.0, 0.0)
            }
            PlacementPose::AsWritten => model.parent_from_model,
        };
        // Two copies of a robot have their names in this run.
        let namespace = match placed.namespace {
            Some(namespace) => absolute(namespace),
            None if placed.is_one_of_several => absolute(&name),
            None => "/".to_owned(),
        };
        let description = placed.description;
        let is_copy = false;
        members.push(ModelInstance {
            model,
            name,
            namespace,
            is_copy,
            world_from_model,
            description,
            file,
        });
    };
    for model in std::mem::take(&mut world.models) {
        add(model, Placed::default(), file_of_world, &mut members);
    }
    // A file with an actor alone is placed on the plane too.
    world.actors.append(&mut scene.actors);
    for model in std::mem::take(&mut scene.models) {
        let is_robot = description.is_some();
        let description = description.clone();
        add(model, Placed { is_robot, description, ..Placed::default() }, 0, &mut members);
    }
    for robot in robots {
        let own = LoadContext { arguments: robot.arguments.clone(), ..setting.clone() };
        let mut loaded = load(&robot.file, &own);
        settle(&mut loaded, &own);
        for name in loaded.unknown_arguments(&robot.arguments) {
            loaded.warn_of_argument(name);
        }
        let scene = loaded.scene.take().unwrap_or_default();
        let is_urdf = loaded.robot.is_some();
        let models = models_of(scene);
        // As with `sdformat_urdf`, the SDF of one robot describes it.
        let description = match (is_urdf, models.len()) {
            (true, _) => description_of(&loaded),
            (false, 1) => loaded.document.as_ref().map(write_document),
            (false, _) => None,
        };
        if models.is_empty() && !loaded.diagnostics.has_errors() {
            loaded.diagnostics.push(
                Diagnostic::error(
                    "no-robot",
                    format!("{} contains no robot", robot.file.display()),
                )
                .help("use a URDF, a xacro file, or an SDF with a model"),
            );
        }
        for model in models {
            let placed = Placed {
                name: robot.name.as_deref(),
                namespace: robot.namespace.as_deref(),
                is_one_of_several: robots.len() > 1,
                standing: robot.pose,
                is_robot: is_urdf,
                description: description.clone(),
            };
            add(model, placed, files.len(), &mut members);
        }
        files.push(loaded);
    }
    Composition { world, members, files, is_default_world: lonely }
}

/// Returns the plane with a sun.
fn plain_world(setting: &LoadContext<'_>) -> LoadedFile {
    load_bytes("plain.world".as_ref(), default_world::DEFAULT_WORLD_SDF.as_bytes(), setting)
}

#[derive(Default)]
struct Placed<'a> {
    name: Option<&'a str>,
    namespace: Option<&'a str>,
    is_one_of_several: bool,
    standing: PlacementPose,
    is_robot: bool,
    description: Option<String>,
}

fn settle(loaded: &mut LoadedFile, setting: &LoadContext<'_>) {
    if let Some(scene) = &mut loaded.scene {
        settle_images(scene, &loaded.sources, setting, &mut loaded.diagnostics);
        settle_parameter_files(scene, &loaded.sources, setting, &mut loaded.diagnostics);
    }
}

fn absolute(namespace: &str) -> String {
    format!("/{}", namespace.trim_matches('/'))
}

/// Returns the models of a file, at any depth.
pub(crate) fn models_of(scene: Scene) -> Vec<Model> {
    scene.worlds.into_iter().flat_map(|world| world.models).chain(scene.models).collect()
}

/// Returns the URDF of a file, with macros expanded.
pub(crate) fn description_of(loaded: &LoadedFile) -> Option<String> {
    loaded.robot.as_ref()?;
    loaded.document.as_ref().map(write_document)
}
