//! From files to one world with robots in it.

use std::path::{Path, PathBuf};

use periplus_diagnostics::Diagnostic;
use periplus_geometry::Pose;
use periplus_loader::{Loaded, Setting, load, load_bytes, settle_images};
use periplus_scene::{Model, Scene, World};
use periplus_xml::write_document;

use crate::ground;

/// A robot that is put into a world.
#[derive(Clone, Debug, Default)]
pub struct Placement {
    /// Its file: URDF, xacro, or an SDF with one model.
    pub file: PathBuf,
    /// `name:=value` for xacro.
    pub arguments: Vec<(String, String)>,
    /// What it is called; without it as in its file, with a number when that is taken.
    pub name: Option<String>,
    /// The namespace of its topics; without it none for a single robot, and its name for one of
    /// several.
    pub namespace: Option<String>,
    /// Where it stands.
    pub pose: Standing,
}

/// Where a robot stands.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Standing {
    /// At the pose in its file, or above the origin so that it touches the ground.
    #[default]
    AsWritten,
    /// On the ground z = 0, at x, y \[m\] and yaw \[rad\].
    OnGround([f64; 3]),
    /// `world_from_model`.
    At(Pose),
}

/// A model that is to be simulated, and where it came from.
#[derive(Clone, Debug)]
pub struct Member {
    /// The model.
    pub model: Model,
    /// What it is called in the world.
    pub name: String,
    /// Namespace of its nodes; `/` is none.
    pub namespace: String,
    /// Its frame in the world.
    pub world_from_model: Pose,
    /// The text that `robot_description` publishes, of a URDF.
    pub description: Option<String>,
    /// Which file of [`Composition::files`] it came from.
    pub file: usize,
}

/// A world and all that stands in it.
#[derive(Debug)]
pub struct Composition {
    /// The world without its models, which are all in `members`.
    pub world: World,
    /// Models, those of the world first.
    pub members: Vec<Member>,
    /// The files with what is wrong in them; the one that was given as the world comes first.
    pub files: Vec<Loaded>,
}

impl Composition {
    /// Whether any file has an error, so that something is missing.
    #[must_use]
    pub fn has_errors(&self) -> bool {
        self.files.iter().any(|file| file.diagnostics.has_errors())
    }

    /// The first file of which nothing came.
    #[must_use]
    pub fn missing(&self) -> Option<&Path> {
        let from = |file: usize| self.members.iter().any(|member| member.file == file);
        let empty =
            |(file, loaded): &(usize, &Loaded)| loaded.diagnostics.has_errors() && !from(*file);
        self.files.iter().enumerate().find(empty).map(|(_, loaded)| loaded.path.as_path())
    }

    /// Simulated seconds per second of the wall that the world asks for; none when it wants all
    /// that the machine has.
    #[must_use]
    pub fn real_time_factor(&self) -> Option<f64> {
        let factor = self.world.physics.first().map_or(1.0, |physics| physics.real_time_factor);
        (factor.is_finite() && factor > 1e-9).then_some(factor)
    }
}

/// Reads a world and robots. A world file that is a robot or a model stands on a plane in the sun.
/// Findings are in [`Composition::files`]; what could not be read is missing.
#[must_use]
pub fn compose(world: &Path, robots: &[Placement], setting: &Setting<'_>) -> Composition {
    let mut first = load(world, setting);
    for name in first.unknown_arguments(&setting.arguments) {
        first.warn_of_argument(name);
    }
    compose_loaded(first, robots, setting)
}

/// A plane in the sun with nothing on it.
#[must_use]
pub fn compose_plain(setting: &Setting<'_>) -> Composition {
    compose_loaded(plain_world(setting), &[], setting)
}

fn compose_loaded(mut first: Loaded, robots: &[Placement], setting: &Setting<'_>) -> Composition {
    settle(&mut first, setting);
    if first.scene.is_none() && !first.diagnostics.has_errors() {
        let what = first.language.name();
        let told = Diagnostic::error("no-world", format!("a {what} holds no world to simulate"));
        let told = first.language.advice().into_iter().fold(told, Diagnostic::help);
        let told = told.help("give an SDF world, or a robot: it will stand on a plane in the sun");
        first.diagnostics.push(told);
    }
    let mut scene = first.scene.take().unwrap_or_default();
    if scene.worlds.len() > 1 {
        let others: Vec<&str> = scene.worlds[1..].iter().map(|world| world.name.as_str()).collect();
        first.diagnostics.push(
            Diagnostic::warning("several-worlds", "only the first world of the file is simulated")
                .note(format!("left out: {}", others.join(", "))),
        );
    }
    let lonely = scene.worlds.is_empty();
    let description = description_of(&first);
    let mut files = vec![first];
    let mut world = if lonely {
        // A file of its own, for its findings point into its own text.
        let mut plain = plain_world(setting);
        let world = plain.scene.as_mut().and_then(|scene| scene.worlds.pop());
        files.push(plain);
        world.unwrap_or_else(|| World::empty("default"))
    } else {
        scene.worlds.remove(0)
    };
    let file_of_world = files.len() - 1;
    let mut members: Vec<Member> = Vec::new();
    let add = |model: Model, placed: Placed<'_>, file: usize, members: &mut Vec<Member>| {
        let taken = |name: &str| members.iter().any(|member| member.name == name);
        let wanted = placed.name.unwrap_or(&model.name).to_owned();
        let mut name = wanted.clone();
        let mut number = 0;
        while taken(&name) {
            number += 1;
            name = format!("{wanted}_{number}");
        }
        let world_from_model = match placed.standing {
            Standing::At(pose) => pose,
            Standing::OnGround([x, y, yaw]) => ground::standing(&model, x, y, yaw),
            Standing::AsWritten if placed.is_robot => ground::standing(&model, 0.0, 0.0, 0.0),
            Standing::AsWritten => model.parent_from_model,
        };
        // One of several has the name that it has here: two copies have two.
        let namespace = match placed.namespace {
            Some(namespace) => absolute(namespace),
            None if placed.is_one_of_several => absolute(&name),
            None => "/".to_owned(),
        };
        let description = placed.description;
        members.push(Member { model, name, namespace, world_from_model, description, file });
    };
    for model in std::mem::take(&mut world.models) {
        add(model, Placed::default(), file_of_world, &mut members);
    }
    for model in std::mem::take(&mut scene.models) {
        let is_robot = description.is_some();
        let description = description.clone();
        add(model, Placed { is_robot, description, ..Placed::default() }, 0, &mut members);
    }
    for robot in robots {
        let own = Setting { arguments: robot.arguments.clone(), ..setting.clone() };
        let mut loaded = load(&robot.file, &own);
        settle(&mut loaded, &own);
        for name in loaded.unknown_arguments(&robot.arguments) {
            loaded.warn_of_argument(name);
        }
        let scene = loaded.scene.take().unwrap_or_default();
        let description = description_of(&loaded);
        let models = models_of(scene);
        if models.is_empty() && !loaded.diagnostics.has_errors() {
            loaded.diagnostics.push(
                Diagnostic::error("no-robot", format!("{} holds no robot", robot.file.display()))
                    .help("give a URDF, a xacro file, or an SDF with a model"),
            );
        }
        for model in models {
            let placed = Placed {
                name: robot.name.as_deref(),
                namespace: robot.namespace.as_deref(),
                is_one_of_several: robots.len() > 1,
                standing: robot.pose,
                is_robot: description.is_some(),
                description: description.clone(),
            };
            add(model, placed, files.len(), &mut members);
        }
        files.push(loaded);
    }
    Composition { world, members, files }
}

/// The plane in the sun.
fn plain_world(setting: &Setting<'_>) -> Loaded {
    load_bytes("plain.world".as_ref(), ground::PLAIN_WORLD.as_bytes(), setting)
}

#[derive(Default)]
struct Placed<'a> {
    name: Option<&'a str>,
    namespace: Option<&'a str>,
    is_one_of_several: bool,
    standing: Standing,
    is_robot: bool,
    description: Option<String>,
}

fn settle(loaded: &mut Loaded, setting: &Setting<'_>) {
    if let Some(scene) = &mut loaded.scene {
        settle_images(scene, &loaded.sources, setting, &mut loaded.diagnostics);
    }
}

fn absolute(namespace: &str) -> String {
    format!("/{}", namespace.trim_matches('/'))
}

/// The models of a file, wherever they stand in it.
pub(crate) fn models_of(scene: Scene) -> Vec<Model> {
    scene.worlds.into_iter().flat_map(|world| world.models).chain(scene.models).collect()
}

/// The URDF that a file is, macros expanded.
pub(crate) fn description_of(loaded: &Loaded) -> Option<String> {
    loaded.robot.as_ref()?;
    loaded.document.as_ref().map(write_document)
}
