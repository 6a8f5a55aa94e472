//! Models of a simulation: truth, and changes to it.

use std::collections::BTreeMap;

use numpy::{PyArray1, PyArrayDyn};
use periplus::geometry::{DVec3, Pose};
use periplus::msgs::builtin_interfaces::Duration;
use periplus::msgs::gazebo_msgs::{ApplyLinkWrench, ApplyLinkWrenchRequest};
use periplus::msgs::geometry_msgs::Vector3;
use periplus::physics::{LinkState, ModelId, PhysicsWorld};
use periplus::sim::{InsertionSource, ModelInsertion};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;

use super::PySimulation;
use crate::arrays::{input, moved, require_finite};
use crate::errors::{FileError, require_file, value_error};
use crate::poses::{PyPose, pose_argument};

/// A model of a simulation, by its name: its true state, and changes to it.
///
/// >>> from periplus import Simulation, World
/// >>> sim = Simulation(World.demo())
/// >>> robot = sim.model("sam_bot")
/// >>> robot.set_pose((1.0, 0.0, 0.0, 0.0, 0.0, 0.0))
/// >>> robot.pose.x
/// 1.0
#[pyclass(name = "Model", module = "periplus", frozen)]
pub(crate) struct PyModel {
    simulation: Py<PySimulation>,
    #[pyo3(get)]
    /// Name of the model.
    name: String,
}

#[pymethods]
impl PyModel {
    /// Pose of its frame in the world.
    #[getter]
    fn pose(&self, py: Python<'_>) -> PyResult<PyPose> {
        self.ask(py, |world, model| world.model_pose(model)).map(PyPose)
    }

    /// Velocity of its frame's origin in world axes [m/s], shape (3,).
    #[getter]
    fn linear_velocity<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let state = self.ask(py, canonical)?;
        Ok(PyArray1::from_slice(py, &state.linear_m_s.to_array()))
    }

    /// Angular velocity in world axes [rad/s], shape (3,).
    #[getter]
    fn angular_velocity<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let state = self.ask(py, canonical)?;
        Ok(PyArray1::from_slice(py, &state.angular_rad_s.to_array()))
    }

    /// Poses of its links in the world, by name.
    #[getter]
    fn links(&self, py: Python<'_>) -> PyResult<BTreeMap<String, PyPose>> {
        self.ask(py, |world, model| {
            let links = world.links(model).filter_map(|link| {
                let name = world.link_name(link)?.to_owned();
                Some((name, PyPose(world.link_state(link)?.world_from_link)))
            });
            Some(links.collect())
        })
    }

    /// Convex polygon around its collisions, seen from above, in its frame [m], shape (N, 2); none if they define none.
    #[getter]
    fn footprint<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArrayDyn<f64>>>> {
        self.ask(py, |world, model| world.model_pose(model))?;
        let corners = self
            .simulation
            .get()
            .with(py, |running| running.simulation().model_footprint_m(&self.name))?;
        corners.map(|corners| moved(py, corners.concat(), &[corners.len(), 2])).transpose()
    }

    /// Positions of its joints [m or rad], by name; joints that cannot move are left out.
    #[getter]
    fn joint_positions(&self, py: Python<'_>) -> PyResult<BTreeMap<String, f64>> {
        self.ask(py, |world, model| Some(joints(world, model, |axis| axis.0)))
    }

    /// Velocities of its joints [m/s or rad/s], by name; joints that cannot move are left out.
    #[getter]
    fn joint_velocities(&self, py: Python<'_>) -> PyResult<BTreeMap<String, f64>> {
        self.ask(py, |world, model| Some(joints(world, model, |axis| axis.1)))
    }

    /// Move the model to a pose in the world, at rest. Joints keep their positions.
    ///
    /// Raises ``ValueError`` for a pose that is too far away.
    fn set_pose(&self, py: Python<'_>, pose: &Bound<'_, PyAny>) -> PyResult<()> {
        let pose = pose_argument(pose, "pose")?;
        let name = self.name.clone();
        self.change(py, "the pose is out of range", move |simulation| {
            simulation.set_pose(&name, pose)
        })
    }

    /// Set the velocities of the model as one rigid piece, in world axes: ``linear`` [m/s] of its frame's origin and
    /// ``angular`` [rad/s], each of shape (3,). Forces and drives change them in the next step.
    ///
    /// Raises ``ValueError`` for values that are too large.
    fn set_velocity(
        &self,
        py: Python<'_>,
        linear: &Bound<'_, PyAny>,
        angular: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let (linear, angular) = (vector(linear, "linear")?, vector(angular, "angular")?);
        let name = self.name.clone();
        self.change(py, "the model cannot move so fast", move |simulation| {
            simulation.set_velocity(&name, linear, angular)
        })
    }

    /// Apply a force [N] and a torque [N m] in world axes, at the origin of a link, for a time from now.
    ///
    /// Parameters
    /// ----------
    /// force, torque : array of shape (3,)
    ///     In world axes.
    /// link : str, optional
    ///     Name of the link; default: the first.
    /// duration_s : float, optional
    ///     Simulated time [s]; default: one step.
    ///
    /// Raises ``ValueError`` with the reason if it cannot be applied.
    #[pyo3(signature = (force, torque=None, *, link=None, duration_s=None))]
    fn apply_wrench(
        &self,
        py: Python<'_>,
        force: &Bound<'_, PyAny>,
        torque: Option<&Bound<'_, PyAny>>,
        link: Option<String>,
        duration_s: Option<f64>,
    ) -> PyResult<()> {
        let force = vector(force, "force")?;
        let torque = torque.map_or(Ok(DVec3::ZERO), |torque| vector(torque, "torque"))?;
        if duration_s.is_some_and(|it| !(0.0..=MAX_DURATION_S).contains(&it)) {
            return Err(PyValueError::new_err(format!(
                "`duration_s` must be from 0 to {MAX_DURATION_S}"
            )));
        }
        let first = self.ask(py, |world, model| {
            let link = world.links(model).next()?;
            world.link_name(link).map(str::to_owned)
        })?;
        let link = link.unwrap_or(first);
        let three = |it: DVec3| Vector3 { x: it.x, y: it.y, z: it.z };
        let mut request = ApplyLinkWrenchRequest {
            link_name: format!("{}::{link}", self.name),
            reference_frame: "world".to_owned(),
            ..Default::default()
        };
        request.wrench.force = three(force);
        request.wrench.torque = three(torque);
        let simulation = self.simulation.get();
        let answer = simulation.with(py, |running| {
            let step_ns = running.simulation().step_ns();
            let duration_ns = duration_s.map_or(step_ns, |it| (it * 1e9).round() as i64);
            request.duration = duration(duration_ns);
            let client = running.node.client::<ApplyLinkWrench>("/apply_link_wrench");
            let client = client.map_err(|error| error.to_string())?;
            let pending = client.call(request);
            running.settle();
            match pending.take() {
                Some(Ok(response)) if response.success => Ok(()),
                Some(Ok(response)) => Err(response.status_message.clone()),
                Some(Err(error)) => Err(error.to_string()),
                None => Err("the simulation did not answer".to_owned()),
            }
        })?;
        answer.map_err(value_error)
    }

    fn __repr__(&self) -> String {
        format!("<periplus.Model {}>", self.name)
    }
}

/// Longest duration of a wrench \[s\].
const MAX_DURATION_S: f64 = 1e6;

fn duration(nanoseconds: i64) -> Duration {
    let sec = i32::try_from(nanoseconds / 1_000_000_000).unwrap_or(i32::MAX);
    Duration { sec, nanosec: (nanoseconds % 1_000_000_000) as u32 }
}

/// State of a model's first link, moved to the origin of the model.
fn canonical(world: &PhysicsWorld, model: ModelId) -> Option<LinkState> {
    let link = world.links(model).next()?;
    let state = world.link_state(link)?;
    let origin = world.model_pose(model)?;
    let arm = origin.translation - state.world_from_link.translation;
    let linear_m_s = state.linear_m_s + state.angular_rad_s.cross(arm);
    Some(LinkState { world_from_link: origin, linear_m_s, ..state })
}

fn joints(
    world: &PhysicsWorld,
    model: ModelId,
    value: impl Fn((f64, f64)) -> f64,
) -> BTreeMap<String, f64> {
    let joints = world.joints(model).filter_map(|joint| {
        let name = world.joint_name(joint)?.to_owned();
        let axis = world.axis_state(joint)?;
        Some((name, value((axis.position, axis.velocity))))
    });
    joints.collect()
}

impl PyModel {
    /// Asks the world about the model.
    fn ask<T: Send>(
        &self,
        py: Python<'_>,
        ask: impl FnOnce(&PhysicsWorld, ModelId) -> Option<T> + Send,
    ) -> PyResult<T> {
        let answer = self.simulation.get().with(py, |running| {
            let world = running.simulation().motion();
            world.find_model(&self.name).and_then(|model| ask(world, model))
        })?;
        answer.ok_or_else(|| self.gone())
    }

    fn change(
        &self,
        py: Python<'_>,
        refusal: &str,
        change: impl FnOnce(&mut periplus::sim::Simulation) -> bool + Send,
    ) -> PyResult<()> {
        // Distinguishes an unknown model from a refused value.
        self.ask(py, |world, model| world.model_pose(model))?;
        let is_done =
            self.simulation.get().with(py, |running| change(running.session.simulation_mut()))?;
        if is_done {
            return Ok(());
        }
        Err(PyValueError::new_err(format!("model {:?}: {refusal}, or it is static", self.name)))
    }

    fn gone(&self) -> PyErr {
        PyKeyError::new_err(format!("no model {:?} in the world", self.name))
    }
}

fn vector(argument: &Bound<'_, PyAny>, name: &str) -> PyResult<DVec3> {
    let array = input::<f64>(argument, name, &[Some(3)])?;
    let values = array.as_slice()?;
    require_finite(values, name)?;
    Ok(DVec3::new(values[0], values[1], values[2]))
}

/// Two collisions in contact.
#[pyclass(name = "Contact", module = "periplus", frozen)]
pub(crate) struct PyContact {
    #[pyo3(get)]
    /// First collision: model, link, collision.
    one: (String, String, String),
    #[pyo3(get)]
    /// Second collision: model, link, collision.
    two: (String, String, String),
    #[pyo3(get)]
    /// Normal force on the second collision [N].
    force_n: f64,
    normal: [f64; 3],
    points: Vec<f64>,
    depths: Vec<f64>,
}

#[pymethods]
impl PyContact {
    /// Unit normal from the first to the second, in world axes, shape (3,).
    #[getter]
    fn normal<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.normal)
    }

    /// Points in the world [m], shape (N, 3).
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(moved(py, self.points.clone(), &[self.depths.len(), 3])?.into_any())
    }

    /// Depths of the points [m], shape (N,).
    #[getter]
    fn depths<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.depths)
    }

    fn __repr__(&self) -> String {
        let (one, two) = (&self.one, &self.two);
        format!(
            "<periplus.Contact {}::{} with {}::{}, {:.3} N>",
            one.0, one.1, two.0, two.1, self.force_n
        )
    }
}

#[pymethods]
impl PySimulation {
    /// Names of the models, in the order of insertion.
    #[getter]
    fn models(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        self.with(py, |running| running.simulation().models().map(str::to_owned).collect())
    }

    /// The model of a name.
    ///
    /// Raises ``KeyError`` for an unknown name.
    fn model(slf: Bound<'_, Self>, name: &str) -> PyResult<PyModel> {
        let names = slf.get().models(slf.py())?;
        if !names.iter().any(|known| known == name) {
            let near = periplus::diagnostics::closest(name, names.iter().map(String::as_str));
            let near = near.map(|near| format!("; did you mean {near:?}?")).unwrap_or_default();
            return Err(PyKeyError::new_err(format!("no model {name:?} in the world{near}")));
        }
        Ok(PyModel { simulation: slf.unbind(), name: name.to_owned() })
    }

    /// Insert a model: a file (URDF, xacro, SDF), or a text of URDF or SDF. Returns its name in the world.
    ///
    /// Parameters
    /// ----------
    /// source : path or str
    ///     Path or URI of a file, or a text that begins with ``<``.
    /// pose : Pose or tuple, optional
    ///     Pose of insertion; the pose in the file is relative to it.
    /// name : str, optional
    ///     Name; default: that of the file, with a number if it is in use.
    /// namespace : str, optional
    ///     Namespace of its topics.
    ///
    /// Raises ``FileNotFoundError``, or ``FileError`` if it cannot be read or simulated.
    #[pyo3(signature = (source, pose=None, *, name=None, namespace=""))]
    fn insert(
        &self,
        py: Python<'_>,
        source: &Bound<'_, PyAny>,
        pose: Option<&Bound<'_, PyAny>>,
        name: Option<&str>,
        namespace: &str,
    ) -> PyResult<String> {
        let pose = pose.map_or(Ok(Pose::IDENTITY), |pose| pose_argument(pose, "pose"))?;
        let text = match source.extract::<String>() {
            Ok(text) => text,
            Err(_) => source.extract::<std::path::PathBuf>()?.display().to_string(),
        };
        let is_text = text.trim_start().starts_with('<');
        if !is_text && !text.contains("://") {
            require_file(text.as_ref())?;
        }
        let from = match is_text {
            true => InsertionSource::Text(&text, ""),
            false => InsertionSource::File(&text),
        };
        let insertion = ModelInsertion {
            from,
            name: name.unwrap_or_default(),
            may_rename: name.is_none(),
            namespace,
            world_from_here: pose,
            with_frames: true,
        };
        let inserted = self.with(py, |running| {
            let search = running.search.clone();
            insertion.bring(running.session.simulation_mut(), &search).map_err(|it| it.to_string())
        })?;
        inserted.map(|result| result.name).map_err(FileError::new_err)
    }

    /// Remove a model.
    ///
    /// Raises ``KeyError`` for an unknown name.
    fn remove(&self, py: Python<'_>, name: &str) -> PyResult<()> {
        if self.with(py, |running| running.session.simulation_mut().delete(name))? {
            return Ok(());
        }
        Err(PyKeyError::new_err(format!("no model {name:?} in the world")))
    }

    /// Contacts at the end of the last step, in a fixed order; none in kinematic motion.
    fn contacts(&self, py: Python<'_>) -> PyResult<Vec<PyContact>> {
        self.with(py, |running| {
            let world = running.simulation().motion();
            let models: BTreeMap<ModelId, &str> = world.models().collect();
            let named = |id: periplus::physics::CollisionId| {
                let model = world.model_of(id.link).and_then(|model| models.get(&model));
                let link = world.link_name(id.link);
                let collision = world.collision_name(id.link, id.collision);
                let text = |name: Option<&str>| name.unwrap_or_default().to_owned();
                (text(model.copied()), text(link), text(collision))
            };
            let contacts = world.contacts().into_iter().map(|contact| PyContact {
                one: named(contact.one),
                two: named(contact.two),
                force_n: contact.force_n,
                normal: contact.normal.to_array(),
                points: contact.points.iter().flat_map(|(point, _)| point.to_array()).collect(),
                depths: contact.points.iter().map(|(_, depth)| *depth).collect(),
            });
            contacts.collect()
        })
    }
}
