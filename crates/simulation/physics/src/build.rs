//! Conversion of models to the records of a world.

mod anisotropic_friction;
mod bodies;
mod collisions;
mod gears;
mod joints;
mod stability;
mod surface;
mod world_joints;

use periplus_diagnostics::{Diagnostic, Diagnostics};
use periplus_geometry::Pose;
use periplus_scene::Model;
use rapier3d_f64::math::{Pose as RapierPose, Vector};
use rapier3d_f64::parry::mass_properties::MassProperties;
pub(crate) use world_joints::add_world_joint;

use crate::flat_model::FlatModel;
use crate::limits::{MAX_POSITION_M, is_pose};
use crate::records::{ModelRecord, Records};
use crate::shapes::Meshes;

pub(crate) fn rapier_pose(pose: Pose) -> RapierPose {
    RapierPose { rotation: pose.rotation, translation: pose.translation }
}

pub(crate) fn scene_pose(pose: &RapierPose) -> Pose {
    Pose { translation: pose.translation, rotation: pose.rotation }
}

/// Appends a model to the records; an error appends nothing.
pub(crate) fn append(
    records: &mut Records,
    model: &Model,
    world_from_model: Pose,
    meshes: &dyn Meshes,
    diagnostics: &mut Diagnostics,
) {
    let number = records.models.len() as u32;
    let before = records.mark();
    let flat = FlatModel::new(model);
    let mut builder = Builder {
        records,
        number,
        first_link: before.links,
        world_from_model,
        flat,
        without_inertia: Vec::new(),
        diagnostics,
    };
    if builder.run(model, meshes).is_none() {
        records.truncate(before);
        return;
    }
    let canonical = model.canonical_link.as_deref();
    let links = &records.links[before.links..];
    let canonical = links.iter().position(|link| Some(link.name.as_str()) == canonical);
    let since = |before: usize, now: usize| before as u32..now as u32;
    records.models.push(ModelRecord {
        name: model.name.clone(),
        world_from_model,
        links: since(before.links, records.links.len()),
        joints: since(before.joints, records.joints.len()),
        bodies: since(before.bodies, records.bodies.len()),
        canonical: (before.links + canonical.unwrap_or(0)) as u32,
        removed: false,
    });
    records.model_of_link.resize(records.links.len(), number);
}

struct Builder<'a, 'b> {
    records: &'a mut Records,
    number: u32,
    first_link: usize,
    world_from_model: Pose,
    flat: FlatModel<'b>,
    /// Bodies with a link whose inertia is assumed, after the report of it.
    without_inertia: Vec<usize>,
    diagnostics: &'a mut Diagnostics,
}

impl Builder<'_, '_> {
    /// Returns `None` for a model that cannot be simulated.
    fn run(&mut self, model: &Model, meshes: &dyn Meshes) -> Option<()> {
        let poses = self.flat.links.iter().map(|(_, _, pose)| pose);
        if !is_pose(self.world_from_model) || poses.into_iter().any(|pose| !is_pose(*pose)) {
            self.diagnostics.push(
                Diagnostic::error(
                    "pose-out-of-range",
                    format!("the pose of `{}` or of one of its links is not finite, or beyond {MAX_POSITION_M} m", model.name),
                )
                .at(model.origin)
                .help("use poses in metres and radians; the model is omitted"),
            );
            return None;
        }
        let before = self.records.mark();
        let group_of_link = self.groups(model.is_static);
        self.bodies(model, &group_of_link)?;
        self.collisions(model, meshes);
        for number in 0..self.flat.joints.len() {
            let (scope, joint) = self.flat.joints[number].clone();
            self.joint(&scope, joint)?;
        }
        self.mimics();
        self.stabilize_inertias(before.bodies, before.axes);
        self.stabilize_joints(before.bodies, before.axes);
        self.warn_of_mass_ratios();
        Some(())
    }
}

/// Returns a fraction of a body's mass with another centre of mass.
pub(crate) fn split(mass: &MassProperties, share: f64, com: Vector) -> MassProperties {
    MassProperties::with_principal_inertia_frame(
        com,
        mass.mass() * share,
        mass.principal_inertia() * share,
        mass.principal_inertia_local_frame,
    )
}
