//! Rays against meshes, primitives and worlds.

mod batch;
pub(crate) mod file;
mod scene;

use std::num::NonZeroUsize;
use std::sync::{Arc, Mutex};

use numpy::PyUntypedArrayMethods as _;
use periplus::geometry::{DVec3, Pose};
use periplus::os::Stopwatch;
use periplus::raycast::{Filter, Heightfield, InstanceError, RaycastShape};
use pyo3::exceptions::{PyIndexError, PyKeyError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::arrays::{contiguous, input, moved, require_finite};
use crate::errors::value_error;
use crate::poses::{PyPose, pose_argument};
use crate::work::{lock, released, with_locked};
use batch::RayBatch;
use scene::{FixedMesh, Geometry, SceneState, Snapshot};

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyRayScene>()?;
    module.add_class::<PyRayHits>()
}

/// First hits of a batch of rays.
///
/// Unpacks into the three arrays ``distances, normals, ids``. All arrays have the shape of the batch: that of the
/// origins and directions, broadcast against each other, without the last axis.
///
/// >>> import periplus
/// >>> scene = periplus.RayScene()
/// >>> ball = scene.add_sphere(0.5, (3.0, 0.0, 0.0, 0.0, 0.0, 0.0))
/// >>> distances, normals, ids = scene.cast([0.0, 0.0, 0.0], [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
/// >>> distances.tolist(), ids.tolist(), normals[0].tolist()
/// ([2.5, inf], [0, -1], [-1.0, 0.0, 0.0])
#[pyclass(name = "RayHits", module = "periplus", frozen)]
pub(crate) struct PyRayHits {
    distances: Py<PyAny>,
    normals: Py<PyAny>,
    ids: Py<PyAny>,
    primitives: Py<PyAny>,
    labels: Arc<Vec<i64>>,
}

#[pymethods]
impl PyRayHits {
    /// Distances in multiples of the length of each direction, float64, shape (...); inf for a miss. Metres for
    /// directions of length 1.
    #[getter]
    fn distances(&self, py: Python<'_>) -> Py<PyAny> {
        self.distances.clone_ref(py)
    }

    /// Unit normals of the surfaces, on the side of the origins, float64, shape (..., 3); zero for a miss.
    #[getter]
    fn normals(&self, py: Python<'_>) -> Py<PyAny> {
        self.normals.clone_ref(py)
    }

    /// Ids of the shapes that were hit, as returned by ``add_mesh`` and the like, int64, shape (...); -1 for a miss.
    #[getter]
    fn ids(&self, py: Python<'_>) -> Py<PyAny> {
        self.ids.clone_ref(py)
    }

    /// Indices of the triangles of a mesh in the order of input, or of the faces of a primitive, int32, shape (...);
    /// -1 for a miss. A box has the faces -x 0, +x 1, -y 2, +y 3, -z 4, +z 5.
    #[getter]
    fn primitives(&self, py: Python<'_>) -> Py<PyAny> {
        self.primitives.clone_ref(py)
    }

    /// Labels of the shapes that were hit, int64, shape (...); -1 for a miss.
    #[getter]
    fn labels<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let ids = contiguous::<i64>(self.ids.bind(py), "ids")?;
        let label = |id: &i64| {
            usize::try_from(*id).ok().and_then(|id| self.labels.get(id)).copied().unwrap_or(-1)
        };
        let labels: Vec<i64> = ids.as_slice()?.iter().map(label).collect();
        Ok(moved(py, labels, ids.shape())?.into_any())
    }

    fn __len__(&self) -> usize {
        3
    }

    fn __getitem__(&self, py: Python<'_>, index: isize) -> PyResult<Py<PyAny>> {
        match index {
            0 | -3 => Ok(self.distances.clone_ref(py)),
            1 | -2 => Ok(self.normals.clone_ref(py)),
            2 | -1 => Ok(self.ids.clone_ref(py)),
            _ => Err(PyIndexError::new_err("ray hits have three arrays: distances, normals, ids")),
        }
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let all = [&self.distances, &self.normals, &self.ids];
        Ok(PyTuple::new(py, all)?.try_iter()?.into_any())
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let shape = self.ids.bind(py).getattr("shape")?.repr()?;
        Ok(format!("RayHits(shape={shape})"))
    }
}

/// Scene of meshes, primitives and height fields for exact ray casting.
///
/// Parameters
/// ----------
/// meshes : sequence of (vertices, triangles), optional
///     Meshes to add; their ids are 0, 1, ...
///
/// Lengths are in metres. Results do not depend on the number of threads nor on the order of changes. Meshes that
/// never move share one tree, the fastest to trace; the first ``move`` of a mesh takes it out. Vertices are single
/// precision about the middle of a mesh, primitives and height fields double precision.
///
/// >>> import numpy as np
/// >>> import periplus
/// >>> scene = periplus.RayScene()
/// >>> floor, box = scene.add_plane(), scene.add_box((1.0, 1.0, 1.0), periplus.Pose(4.0, 0.0, 0.5))
/// >>> angles = np.linspace(-0.5, 0.5, 5)
/// >>> beams = np.stack([np.cos(angles), np.sin(angles), np.zeros(5)], axis=-1)
/// >>> scene.cast((0.0, 0.0, 0.3), beams).ids.tolist()
/// [-1, -1, 1, -1, -1]
#[pyclass(name = "RayScene", module = "periplus", frozen)]
pub(crate) struct PyRayScene {
    state: Mutex<SceneState>,
}

#[pymethods]
impl PyRayScene {
    #[new]
    #[pyo3(signature = (meshes=None))]
    fn new(meshes: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let mut state = SceneState::default();
        for mesh in meshes.map(|meshes| meshes.try_iter()).transpose()?.into_iter().flatten() {
            let mesh = mesh?;
            let (vertices, triangles): (Bound<'_, PyAny>, Bound<'_, PyAny>) =
                mesh.extract().map_err(|_| {
                    PyTypeError::new_err("`meshes` must be pairs (vertices, triangles)")
                })?;
            let geometry = mesh_geometry(&vertices, &triangles)?;
            state.add(geometry, Pose::IDENTITY, 0);
        }
        Ok(Self { state: Mutex::new(state) })
    }

    /// Reads a world, a robot (URDF, xacro, SDF) or a mesh file (STL, OBJ, COLLADA, glTF).
    ///
    /// Parameters
    /// ----------
    /// path : path
    ///     File. ``model://`` and ``package://`` are searched as ``periplus`` does.
    /// geometry : {"visual", "collision"}
    ///     Shapes to use: those of cameras, or those of contacts.
    /// arguments : dict, optional
    ///     Arguments of a xacro file.
    /// search_paths : sequence of paths, optional
    ///     Folders to search for packages and models first.
    ///
    /// ``names`` has the name of each shape. Joints are at zero; links of a URDF without inertia are left out, as in
    /// Gazebo. Raises ``FileNotFoundError``, or ``FileError`` with
    /// file, line and column.
    ///
    /// >>> import pathlib, tempfile
    /// >>> import periplus
    /// >>> file = pathlib.Path(tempfile.mkdtemp()) / "ball.sdf"
    /// >>> _ = file.write_text('''<sdf version="1.9"><model name="ball"><link name="base"><visual name="skin">
    /// ... <geometry><sphere><radius>1</radius></sphere></geometry></visual></link></model></sdf>''')
    /// >>> scene = periplus.RayScene.from_file(file)
    /// >>> scene.names
    /// {0: 'ball::base::skin'}
    /// >>> float(scene.distances([5, 0, 0], [-1, 0, 0]))
    /// 4.0
    #[staticmethod]
    #[pyo3(signature = (path, geometry="visual", arguments=None, search_paths=None))]
    fn from_file(
        py: Python<'_>,
        path: std::path::PathBuf,
        geometry: &str,
        arguments: Option<&Bound<'_, PyDict>>,
        search_paths: Option<Vec<std::path::PathBuf>>,
    ) -> PyResult<Self> {
        let state = file::read(py, &path, geometry, arguments, search_paths.unwrap_or_default())?;
        Ok(Self { state: Mutex::new(state) })
    }

    /// Adds a triangle mesh and returns its id.
    ///
    /// Parameters
    /// ----------
    /// vertices : array_like, shape (V, 3)
    ///     Positions [m] in the frame of the mesh.
    /// triangles : array_like of int, shape (T, 3)
    ///     Indices of the corners. Degenerate triangles are never hit.
    /// pose : Pose, optional
    ///     Pose of the mesh in the scene.
    /// label : int, optional
    ///     Label for ``RayHits.labels``, any number.
    ///
    /// >>> import periplus
    /// >>> scene = periplus.RayScene()
    /// >>> scene.add_mesh([[2, -1, -1], [2, 1, -1], [2, 0, 1]], [[0, 1, 2]])
    /// 0
    /// >>> float(scene.distances([0, 0, 0], [1, 0, 0]))
    /// 2.0
    #[pyo3(signature = (vertices, triangles, pose=None, label=0))]
    fn add_mesh(
        &self,
        vertices: &Bound<'_, PyAny>,
        triangles: &Bound<'_, PyAny>,
        pose: Option<&Bound<'_, PyAny>>,
        label: i64,
    ) -> PyResult<i64> {
        let geometry = mesh_geometry(vertices, triangles)?;
        self.add(vertices.py(), geometry, pose, label)
    }

    /// Adds a box with edges of these lengths [m], centred on its frame, and returns its id.
    ///
    /// >>> import periplus
    /// >>> scene = periplus.RayScene()
    /// >>> scene.add_box((1, 2, 3))
    /// 0
    #[pyo3(signature = (size, pose=None, label=0))]
    fn add_box(
        &self,
        size: &Bound<'_, PyAny>,
        pose: Option<&Bound<'_, PyAny>>,
        label: i64,
    ) -> PyResult<i64> {
        let shape = RaycastShape::Box { size_m: vector(size, "size")? };
        self.add_shape(size.py(), shape, pose, label)
    }

    /// Adds a sphere of this radius [m] and returns its id.
    ///
    /// >>> import periplus
    /// >>> scene = periplus.RayScene()
    /// >>> scene.add_sphere(0.5, periplus.Pose(1.0))
    /// 0
    #[pyo3(signature = (radius, pose=None, label=0))]
    fn add_sphere(
        &self,
        py: Python<'_>,
        radius: f64,
        pose: Option<&Bound<'_, PyAny>>,
        label: i64,
    ) -> PyResult<i64> {
        self.add_shape(py, RaycastShape::Sphere { radius_m: radius }, pose, label)
    }

    /// Adds a cylinder with both ends, its axis along z, centred on its frame; radius and length [m]. Returns its id.
    ///
    /// >>> import periplus
    /// >>> scene = periplus.RayScene()
    /// >>> scene.add_cylinder(0.5, 2.0)
    /// 0
    #[pyo3(signature = (radius, length, pose=None, label=0))]
    fn add_cylinder(
        &self,
        py: Python<'_>,
        radius: f64,
        length: f64,
        pose: Option<&Bound<'_, PyAny>>,
        label: i64,
    ) -> PyResult<i64> {
        let shape = RaycastShape::Cylinder { radius_m: radius, length_m: length };
        self.add_shape(py, shape, pose, label)
    }

    /// Adds a capsule along z; ``length`` is that of the cylinder without the half spheres [m]. Returns its id.
    ///
    /// >>> import periplus
    /// >>> scene = periplus.RayScene()
    /// >>> _ = scene.add_capsule(0.5, 1.0)
    /// >>> float(scene.distances([0, 0, 3], [0, 0, -1]))
    /// 2.0
    #[pyo3(signature = (radius, length, pose=None, label=0))]
    fn add_capsule(
        &self,
        py: Python<'_>,
        radius: f64,
        length: f64,
        pose: Option<&Bound<'_, PyAny>>,
        label: i64,
    ) -> PyResult<i64> {
        let shape = RaycastShape::Capsule { radius_m: radius, length_m: length };
        self.add_shape(py, shape, pose, label)
    }

    /// Adds a cone along z, its base at -length/2, its tip at length/2 [m]. Returns its id.
    ///
    /// >>> import periplus
    /// >>> scene = periplus.RayScene()
    /// >>> scene.add_cone(0.5, 1.0)
    /// 0
    #[pyo3(signature = (radius, length, pose=None, label=0))]
    fn add_cone(
        &self,
        py: Python<'_>,
        radius: f64,
        length: f64,
        pose: Option<&Bound<'_, PyAny>>,
        label: i64,
    ) -> PyResult<i64> {
        let shape = RaycastShape::Cone { radius_m: radius, length_m: length };
        self.add_shape(py, shape, pose, label)
    }

    /// Adds an ellipsoid with these half axes [m] and returns its id.
    ///
    /// >>> import periplus
    /// >>> scene = periplus.RayScene()
    /// >>> scene.add_ellipsoid((1, 2, 3))
    /// 0
    #[pyo3(signature = (radii, pose=None, label=0))]
    fn add_ellipsoid(
        &self,
        radii: &Bound<'_, PyAny>,
        pose: Option<&Bound<'_, PyAny>>,
        label: i64,
    ) -> PyResult<i64> {
        let shape = RaycastShape::Ellipsoid { radii_m: vector(radii, "radii")? };
        self.add_shape(radii.py(), shape, pose, label)
    }

    /// Adds the plane z = 0 of its frame: infinite, or a rectangle of ``size`` (x, y) [m] about the origin. Returns
    /// its id.
    ///
    /// >>> import periplus
    /// >>> scene = periplus.RayScene()
    /// >>> _ = scene.add_plane()
    /// >>> float(scene.distances([0, 0, 2], [0, 0, -1]))
    /// 2.0
    #[pyo3(signature = (size=None, pose=None, label=0))]
    fn add_plane(
        &self,
        py: Python<'_>,
        size: Option<[f64; 2]>,
        pose: Option<&Bound<'_, PyAny>>,
        label: i64,
    ) -> PyResult<i64> {
        self.add_shape(py, RaycastShape::Plane { size_m: size }, pose, label)
    }

    /// Adds terrain over a regular grid and returns its id.
    ///
    /// Parameters
    /// ----------
    /// heights : array_like, shape (rows, columns)
    ///     Heights [m]; row 0 has the lowest y, column 0 the lowest x. At least 2 by 2.
    /// size : (float, float)
    ///     Extent along x and y [m]; the grid is centred on its frame.
    ///
    /// >>> import periplus
    /// >>> scene = periplus.RayScene()
    /// >>> _ = scene.add_heightfield([[0, 0], [1, 1]], (2, 2))
    /// >>> float(scene.distances([0, 0, 2], [0, 0, -1]))
    /// 1.5
    #[pyo3(signature = (heights, size, pose=None, label=0))]
    fn add_heightfield(
        &self,
        heights: &Bound<'_, PyAny>,
        size: [f64; 2],
        pose: Option<&Bound<'_, PyAny>>,
        label: i64,
    ) -> PyResult<i64> {
        let array = input::<f64>(heights, "heights", &[None, None])?;
        let values = array.as_slice()?;
        require_finite(values, "heights")?;
        let (rows, columns) = (array.shape()[0], array.shape()[1]);
        let field = Heightfield::new(columns, rows, size, values.to_vec()).map_err(value_error)?;
        self.add(heights.py(), Geometry::Heights(Arc::new(field)), pose, label)
    }

    /// Moves a shape to a pose in the scene. Raises ``KeyError`` for an unknown id, and ``ValueError`` for a static
    /// mesh of a file.
    ///
    /// >>> import periplus
    /// >>> scene = periplus.RayScene()
    /// >>> ball = scene.add_sphere(1.0)
    /// >>> scene.move(ball, periplus.Pose(5.0))
    /// >>> float(scene.distances([0, 0, 0], [1, 0, 0]))
    /// 4.0
    fn r#move(&self, id: i64, pose: &Bound<'_, PyAny>) -> PyResult<()> {
        let to = pose_argument(pose, "pose")?;
        let moved = with_locked(pose.py(), "move", &self.state, |state| state.move_to(id, to))?;
        moved.map_err(change_error)
    }

    /// Removes a shape. Its id is never used again. Raises ``KeyError`` for an unknown id.
    ///
    /// >>> import periplus
    /// >>> scene = periplus.RayScene()
    /// >>> ball = scene.add_sphere(1.0)
    /// >>> scene.remove(ball)
    /// >>> len(scene)
    /// 0
    fn remove(&self, py: Python<'_>, id: i64) -> PyResult<()> {
        with_locked(py, "remove", &self.state, |state| state.remove(id))?.map_err(change_error)
    }

    /// Returns the pose of a shape in the scene. Raises ``KeyError`` for an unknown id and ``ValueError`` for a shape
    /// of a file that has not been moved.
    fn pose(&self, id: i64) -> PyResult<PyPose> {
        let found = lock(&self.state).pose(id).map_err(change_error)?;
        found
            .map(PyPose)
            .ok_or_else(|| PyValueError::new_err("the pose of a shape of a file is not known"))
    }

    /// Names of the shapes of a file by id: ``model::link::shape``. Empty for a scene made in code.
    #[getter]
    fn names<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let names = PyDict::new(py);
        for (id, name) in lock(&self.state).names() {
            names.set_item(id, name)?;
        }
        Ok(names)
    }

    fn __len__(&self) -> usize {
        lock(&self.state).len()
    }

    fn __repr__(&self) -> String {
        format!("RayScene({} shapes)", lock(&self.state).len())
    }

    /// Casts rays and returns the first hits: distances, normals and ids.
    ///
    /// Parameters
    /// ----------
    /// origins, directions : array_like, shape (..., 3)
    ///     Origins [m] and directions of any length, broadcast against each other: one origin for many directions,
    ///     or one direction for many origins. Pass the rays of scans and images in order, since neighbours with a common origin are
    ///     traced together; arrays of shape (rows, columns, 3) are traced as images.
    /// max_distance_m : float or array_like of shape (...)
    ///     Maximum distance. A distance is a multiple of the length of its direction: metres for directions of
    ///     length 1.
    /// threads : int, optional
    ///     Number of threads (default: all cores). Results are the same for any number.
    /// out : RayHits, optional
    ///     Result of an earlier call with rays of the same shape, whose arrays are overwritten: saves the time for new
    ///     memory in a loop.
    ///
    /// Faces are hit from both sides; a ray that starts inside a solid hits its far wall. A direction of length zero
    /// hits nothing. Raises ``ValueError`` for NaN, infinite values, and shapes that do not broadcast.
    ///
    /// >>> import periplus
    /// >>> scene = periplus.RayScene()
    /// >>> _ = scene.add_box((2, 2, 2))
    /// >>> hits = scene.cast([[-3, 0, 0], [0, 0, 5]], [[1, 0, 0], [0, 0, -1]])
    /// >>> hits.distances.tolist(), hits.primitives.tolist()
    /// ([2.0, 4.0], [0, 5])
    #[pyo3(signature = (origins, directions, max_distance_m=None, threads=None, out=None))]
    fn cast(
        &self,
        origins: &Bound<'_, PyAny>,
        directions: &Bound<'_, PyAny>,
        max_distance_m: Option<&Bound<'_, PyAny>>,
        threads: Option<usize>,
        out: Option<&Bound<'_, PyRayHits>>,
    ) -> PyResult<PyRayHits> {
        let py = origins.py();
        let rays = RayBatch::new(origins, directions, max_distance_m)?;
        let scene = self.snapshot(py)?;
        let out = out.map(|out| {
            let PyRayHits { distances, normals, ids, primitives, .. } = out.get();
            [distances, normals, ids, primitives].map(|array| array.bind(py).clone())
        });
        let found = rays.cast(py, &scene, thread_count(threads)?, out)?;
        Ok(PyRayHits {
            distances: found.distances.unbind(),
            normals: found.normals.unbind(),
            ids: found.ids.unbind(),
            primitives: found.primitives.unbind(),
            labels: Arc::clone(&scene.labels),
        })
    }

    /// Casts rays and returns only distances, as float32, inf for a miss: cheaper than ``cast``. Parameters and errors
    /// as ``cast``; ``out`` is a float32 array that is overwritten. Single precision as in laser scans; ``cast`` has double precision.
    ///
    /// >>> import periplus
    /// >>> scene = periplus.RayScene()
    /// >>> _ = scene.add_sphere(1.0)
    /// >>> scene.distances([3, 0, 0], [[-1, 0, 0], [1, 0, 0]]).tolist()
    /// [2.0, inf]
    #[pyo3(signature = (origins, directions, max_distance_m=None, threads=None, out=None))]
    fn distances<'py>(
        &self,
        origins: &Bound<'py, PyAny>,
        directions: &Bound<'py, PyAny>,
        max_distance_m: Option<&Bound<'py, PyAny>>,
        threads: Option<usize>,
        out: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let py = origins.py();
        let rays = RayBatch::new(origins, directions, max_distance_m)?;
        let scene = self.snapshot(py)?;
        rays.distances(py, &scene, thread_count(threads)?, out)
    }

    /// Returns whether each ray hits anything, as a bool array: the cheapest query, for shadows and lines of sight.
    /// Parameters and errors as ``cast``; ``out`` is a bool array that is overwritten.
    ///
    /// >>> import periplus
    /// >>> scene = periplus.RayScene()
    /// >>> _ = scene.add_sphere(1.0)
    /// >>> scene.occluded([3, 0, 0], [-1, 0, 0], max_distance_m=[1.0, 2.5]).tolist()
    /// [False, True]
    #[pyo3(signature = (origins, directions, max_distance_m=None, threads=None, out=None))]
    fn occluded<'py>(
        &self,
        origins: &Bound<'py, PyAny>,
        directions: &Bound<'py, PyAny>,
        max_distance_m: Option<&Bound<'py, PyAny>>,
        threads: Option<usize>,
        out: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let py = origins.py();
        let rays = RayBatch::new(origins, directions, max_distance_m)?;
        let scene = self.snapshot(py)?;
        rays.occluded(py, &scene, thread_count(threads)?, out)
    }

    /// Seconds that the batch functions of the crate need for these rays on one thread, the best of `turns`, with rays
    /// and results allocated before: the reference of the benchmark. `what` is `cast` or `distances`.
    fn _batch_time_s(
        &self,
        origins: &Bound<'_, PyAny>,
        directions: &Bound<'_, PyAny>,
        what: &str,
        turns: usize,
    ) -> PyResult<f64> {
        let py = origins.py();
        let rays = RayBatch::new(origins, directions, None)?;
        let scene = self.snapshot(py)?;
        let (rays, columns) = rays.rays()?;
        let is_cast = what == "cast";
        released(py, "the benchmark", || {
            let (mut hits, mut distances_m) = (vec![None; rays.len()], vec![0.0; rays.len()]);
            let mut best_s = f64::INFINITY;
            for _ in 0..turns {
                let start = Stopwatch::start();
                if is_cast {
                    scene.world.hits_grid(&rays, columns, Filter::default(), 1, &mut hits);
                } else {
                    scene.world.cast_grid(&rays, columns, Filter::default(), 1, &mut distances_m);
                }
                best_s = best_s.min(start.elapsed().as_secs_f64());
            }
            best_s
        })
    }
}

impl PyRayScene {
    fn add_shape(
        &self,
        py: Python<'_>,
        shape: RaycastShape,
        pose: Option<&Bound<'_, PyAny>>,
        label: i64,
    ) -> PyResult<i64> {
        // The builder checks sizes.
        let mut check = periplus::raycast::RaycastWorld::builder();
        check.add_shape(&shape, &Pose::IDENTITY, Default::default()).map_err(value_error)?;
        self.add(py, Geometry::Shape(shape), pose, label)
    }

    fn add(
        &self,
        py: Python<'_>,
        geometry: Geometry,
        pose: Option<&Bound<'_, PyAny>>,
        label: i64,
    ) -> PyResult<i64> {
        let pose = pose.map_or(Ok(Pose::IDENTITY), |pose| pose_argument(pose, "pose"))?;
        with_locked(py, "add", &self.state, |state| state.add(geometry, pose, label))
    }

    /// The scene with all trees built.
    fn snapshot(&self, py: Python<'_>) -> PyResult<Snapshot> {
        if let Some(snapshot) = lock_if_free(&self.state).and_then(|state| state.built()) {
            return Ok(snapshot);
        }
        let threads = thread_count(None)?;
        let built = with_locked(py, "the trees", &self.state, |state| state.build(threads))?;
        built.map_err(|error: InstanceError| value_error(error))
    }
}

/// Locks a mutex if no other thread holds it: then no time is spent on releasing the interpreter.
fn lock_if_free<T>(mutex: &Mutex<T>) -> Option<std::sync::MutexGuard<'_, T>> {
    mutex.try_lock().ok()
}

/// Argument `threads`: all cores if it is none.
fn thread_count(threads: Option<usize>) -> PyResult<usize> {
    match threads {
        Some(0) => Err(PyValueError::new_err("`threads` must be at least 1")),
        Some(count) => Ok(count.min(1024)),
        None => Ok(std::thread::available_parallelism().map_or(1, NonZeroUsize::get)),
    }
}

fn change_error(error: scene::ChangeError) -> PyErr {
    match error {
        scene::ChangeError::Unknown(id) => PyKeyError::new_err(id),
        scene::ChangeError::Refused(text) => PyValueError::new_err(text),
    }
}

fn vector(argument: &Bound<'_, PyAny>, name: &str) -> PyResult<DVec3> {
    let array = input::<f64>(argument, name, &[Some(3)])?;
    let values = array.as_slice()?;
    require_finite(values, name)?;
    Ok(DVec3::from_slice(values))
}

fn mesh_geometry(vertices: &Bound<'_, PyAny>, triangles: &Bound<'_, PyAny>) -> PyResult<Geometry> {
    let vertices = input::<f64>(vertices, "vertices", &[None, Some(3)])?;
    let triangles = integers(triangles, "triangles")?;
    let triangles = input::<i64>(&triangles, "triangles", &[None, Some(3)])?;
    require_finite(vertices.as_slice()?, "vertices")?;
    let (positions_m, _) = vertices.as_slice()?.as_chunks::<3>();
    let count = positions_m.len();
    let corner = |corner: i64| u32::try_from(corner).ok().filter(|it| (*it as usize) < count);
    let mut indices = Vec::with_capacity(triangles.as_slice()?.len() / 3);
    for (number, &[a, b, c]) in triangles.as_slice()?.as_chunks::<3>().0.iter().enumerate() {
        let (Some(a), Some(b), Some(c)) = (corner(a), corner(b), corner(c)) else {
            return Err(PyValueError::new_err(format!(
                "`triangles[{number}]` is [{a}, {b}, {c}], and there are {count} vertices"
            )));
        };
        indices.push([a, b, c]);
    }
    if let Some(at) = vertices.as_slice()?.iter().position(|value| value.abs() > MAX_COORDINATE_M) {
        return Err(PyValueError::new_err(format!(
            "`vertices[{}]` is beyond {MAX_COORDINATE_M:e} m",
            at / 3
        )));
    }
    if indices.len() > MAX_TRIANGLE_COUNT {
        return Err(PyValueError::new_err(format!(
            "`triangles` has more than {MAX_TRIANGLE_COUNT} triangles"
        )));
    }
    Ok(Geometry::Fixed(Arc::new(FixedMesh {
        positions_m: positions_m.to_vec(),
        triangles: indices,
    })))
}

/// Largest coordinate of a vertex \[m\]; far below the limit of the crate, which applies after the pose.
const MAX_COORDINATE_M: f64 = 1e10;
/// Limit of the crate.
const MAX_TRIANGLE_COUNT: usize = 1 << 28;

/// Argument as an array of integers: floats are refused rather than cut off.
fn integers<'py>(argument: &Bound<'py, PyAny>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    let numpy = argument.py().import(pyo3::intern!(argument.py(), "numpy"))?;
    let array = numpy.getattr("asarray")?.call1((argument,))?;
    let kind: String = array.getattr("dtype")?.getattr("kind")?.extract()?;
    let size: usize = array.getattr("size")?.extract()?;
    if matches!(kind.as_str(), "i" | "u") || size == 0 {
        return Ok(array);
    }
    Err(PyTypeError::new_err(format!("`{name}` must be integers, not {}", array.getattr("dtype")?)))
}
