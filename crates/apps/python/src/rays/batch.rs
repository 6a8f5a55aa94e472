//! Batches of rays from arrays.

use std::cell::Cell;
use std::sync::Mutex;

use numpy::{
    Element, PyArrayDyn, PyArrayMethods as _, PyReadonlyArrayDyn, PyReadwriteArrayDyn,
    PyUntypedArrayMethods as _,
};
use periplus::geometry::DVec3;
use periplus::raycast::{Filter, Hit, Ray};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::scene::Snapshot;
use crate::arrays::{contiguous, require_finite};
use crate::work::{lock, released};

/// Number of rays that are converted at a time: rays and hits of a chunk stay in the cache.
const CHUNK_RAYS: usize = 4096;
/// Rows of an image that are traced together, as in the crate.
const BAND_ROWS: usize = 4;
/// Number of chunks after which Ctrl-C is checked: some 0.1 s of work.
const SLICE_CHUNKS: usize = 64;
/// Minimum number of rays for which a second thread pays off.
const MIN_PARALLEL_RAYS: usize = 8192;

/// Rays and hits of a chunk.
#[derive(Default)]
struct Buffers {
    rays: Vec<Ray>,
    hits: Vec<Option<Hit>>,
}

thread_local! {
    /// Buffers of the last batch of this thread.
    static BUFFERS: Cell<Buffers> = Cell::default();
}

/// Rays of arrays that are broadcast against each other.
pub(super) struct RayBatch<'py> {
    shape: Vec<usize>,
    count: usize,
    columns: usize,
    origins: Broadcast<'py>,
    directions: Broadcast<'py>,
    max_distances: Option<Broadcast<'py>>,
}

/// Array of vectors or numbers; one for all rays where `is_one`.
struct Broadcast<'py> {
    array: PyReadonlyArrayDyn<'py, f64>,
    is_one: bool,
}

/// Hits of a batch as arrays.
pub(super) struct HitArrays<'py> {
    pub(super) distances: Bound<'py, PyAny>,
    pub(super) normals: Bound<'py, PyAny>,
    pub(super) ids: Bound<'py, PyAny>,
    pub(super) primitives: Bound<'py, PyAny>,
}

/// Slices of the arrays.
#[derive(Clone, Copy)]
struct RayReader<'a> {
    origins: Slots<'a, [f64; 3]>,
    directions: Slots<'a, [f64; 3]>,
    /// None for no limit.
    max_distances: Option<Slots<'a, f64>>,
}

/// Values of all rays, or one for all.
#[derive(Clone, Copy)]
struct Slots<'a, T> {
    values: &'a [T],
    is_one: bool,
}

impl Broadcast<'_> {
    fn numbers(&self) -> PyResult<Slots<'_, f64>> {
        Ok(Slots { values: self.array.as_slice()?, is_one: self.is_one })
    }

    fn vectors(&self) -> PyResult<Slots<'_, [f64; 3]>> {
        Ok(Slots { values: self.array.as_slice()?.as_chunks::<3>().0, is_one: self.is_one })
    }
}

impl<'py> RayBatch<'py> {
    pub(super) fn new(
        origins: &Bound<'py, PyAny>,
        directions: &Bound<'py, PyAny>,
        max_distance_m: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Self> {
        let origins = vectors(origins, "origins")?;
        let directions = vectors(directions, "directions")?;
        let max_distances = max_distance_m
            .map(|argument| contiguous::<f64>(argument, "max_distance_m"))
            .transpose()?;
        let lead = |array: &PyReadonlyArrayDyn<'py, f64>| {
            let shape = array.shape();
            shape[..shape.len() - 1].to_vec()
        };
        let named = [("origins", lead(&origins)), ("directions", lead(&directions))];
        let limit = max_distances.as_ref().map(|array| ("max_distance_m", array.shape().to_vec()));
        let shape = common_shape(named.into_iter().chain(limit))?;
        let count = shape.iter().product();
        let (origins, directions) =
            (expand(origins, &shape, count, true)?, expand(directions, &shape, count, true)?);
        let max_distances =
            max_distances.map(|array| expand(array, &shape, count, false)).transpose()?;
        if let Some(limits) = &max_distances
            && limits.array.as_slice()?.iter().any(|limit| limit.is_nan())
        {
            return Err(PyValueError::new_err("`max_distance_m` must not be NaN"));
        }
        let columns = if shape.len() > 1 { shape[shape.len() - 1] } else { count };
        Ok(Self { shape, count, columns, origins, directions, max_distances })
    }

    fn reader(&self) -> PyResult<RayReader<'_>> {
        let max_distances = self.max_distances.as_ref();
        Ok(RayReader {
            origins: self.origins.vectors()?,
            directions: self.directions.vectors()?,
            max_distances: max_distances.map(Broadcast::numbers).transpose()?,
        })
    }

    /// All rays at once, and the number of columns.
    pub(super) fn rays(&self) -> PyResult<(Vec<Ray>, usize)> {
        let mut rays = Vec::new();
        self.reader()?.fill(0, self.count, &mut rays);
        Ok((rays, self.columns))
    }

    fn not_finite(&self) -> PyErr {
        let check = |array: &Broadcast<'_>, name| match array.array.as_slice() {
            Ok(values) => require_finite(values, name).err(),
            Err(error) => Some(error.into()),
        };
        check(&self.origins, "origins")
            .or_else(|| check(&self.directions, "directions"))
            .unwrap_or_else(|| PyValueError::new_err("the rays must be finite"))
    }

    /// Number of rays of a chunk, and the columns of its rays.
    fn chunk(&self) -> (usize, usize) {
        let columns = self.columns.max(1);
        if columns >= self.count {
            return (CHUNK_RAYS, CHUNK_RAYS);
        }
        let rows = CHUNK_RAYS.div_ceil(columns).next_multiple_of(BAND_ROWS);
        (rows * columns, columns)
    }

    pub(super) fn cast(
        &self,
        py: Python<'py>,
        scene: &Snapshot,
        threads: usize,
        out: Option<[Bound<'py, PyAny>; 4]>,
    ) -> PyResult<HitArrays<'py>> {
        let vectors_shape: Vec<usize> = self.shape.iter().copied().chain([3]).collect();
        let [distances, normals, ids, primitives] = match out {
            Some(arrays) => arrays.map(Some),
            None => [const { None }; 4],
        };
        let mut distances = result::<f64>(py, distances, &self.shape)?;
        let mut normals = result::<f64>(py, normals, &vectors_shape)?;
        let mut ids = result::<i64>(py, ids, &self.shape)?;
        let mut primitives = result::<i32>(py, primitives, &self.shape)?;
        let (size, columns) = self.chunk();
        let jobs = distances
            .as_slice_mut()?
            .chunks_mut(size)
            .zip(normals.as_slice_mut()?.chunks_mut(3 * size))
            .zip(ids.as_slice_mut()?.chunks_mut(size))
            .zip(primitives.as_slice_mut()?.chunks_mut(size));
        self.run(py, threads, size, jobs, |rays, hits, job| {
            let (((distances, normals), ids), primitives) = job;
            hits.resize(rays.len(), None);
            scene.world.hits_grid(rays, columns.min(rays.len()), Filter::default(), 1, hits);
            let normals = normals.as_chunks_mut::<3>().0;
            write_hits(hits, &scene.ids, distances, normals, ids, primitives);
            has_unsound(rays, hits.iter().map(Option::is_none))
        })?;
        Ok(HitArrays {
            distances: object(&distances),
            normals: object(&normals),
            ids: object(&ids),
            primitives: object(&primitives),
        })
    }

    pub(super) fn distances(
        &self,
        py: Python<'py>,
        scene: &Snapshot,
        threads: usize,
        out: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let mut found = result::<f32>(py, out, &self.shape)?;
        let (size, columns) = self.chunk();
        let jobs = found.as_slice_mut()?.chunks_mut(size);
        self.run(py, threads, size, jobs, |rays, _, distances| {
            scene.world.cast_grid(rays, columns.min(rays.len()), Filter::default(), 1, distances);
            has_unsound(rays, distances.iter().map(|distance| !distance.is_finite()))
        })?;
        Ok(object(&found))
    }

    pub(super) fn occluded(
        &self,
        py: Python<'py>,
        scene: &Snapshot,
        threads: usize,
        out: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let mut found = result::<bool>(py, out, &self.shape)?;
        let (size, columns) = self.chunk();
        let jobs = found.as_slice_mut()?.chunks_mut(size);
        self.run(py, threads, size, jobs, |rays, _, occluded| {
            scene.world.occluded_grid(
                rays,
                columns.min(rays.len()),
                Filter::default(),
                1,
                occluded,
            );
            has_unsound(rays, occluded.iter().map(|is_occluded| !is_occluded))
        })?;
        Ok(object(&found))
    }

    /// Calls `work` with the rays and slots of each chunk, on several threads, and checks for Ctrl-C in between.
    /// `work` returns true if a ray is not finite.
    fn run<J: Send>(
        &self,
        py: Python<'_>,
        threads: usize,
        size: usize,
        jobs: impl Iterator<Item = J>,
        work: impl Fn(&[Ray], &mut Vec<Option<Hit>>, J) -> bool + Sync,
    ) -> PyResult<()> {
        let reader = self.reader()?;
        let count = self.count;
        let threads = if count < MIN_PARALLEL_RAYS { 1 } else { threads };
        let mut jobs = jobs.enumerate();
        loop {
            let slice: Vec<(usize, J)> = jobs.by_ref().take(SLICE_CHUNKS * threads).collect();
            if slice.is_empty() {
                return Ok(());
            }
            let done = released(py, "ray casting", || {
                let workers = threads.min(slice.len());
                let queue = Mutex::new(slice.into_iter());
                let failed = Mutex::new(false);
                let next = || lock(&queue).next();
                let help = || {
                    let Buffers { mut rays, mut hits } = BUFFERS.take();
                    rays.clear();
                    while let Some((number, job)) = next() {
                        let start = number * size;
                        let end = (start + size).min(count);
                        reader.fill(start, end, &mut rays);
                        if work(&rays, &mut hits, job) {
                            *lock(&failed) = true;
                            return;
                        }
                    }
                    BUFFERS.set(Buffers { rays, hits });
                };
                std::thread::scope(|scope| {
                    for _ in 1..workers {
                        scope.spawn(help);
                    }
                    help();
                });
                !*lock(&failed)
            })?;
            if !done {
                return Err(self.not_finite());
            }
            py.check_signals()?;
        }
    }
}

impl RayReader<'_> {
    /// Makes `rays` those from `start` to `end`. All rays in it are of this batch, so that values that are the same for
    /// all rays are written only once.
    fn fill(&self, start: usize, end: usize, rays: &mut Vec<Ray>) {
        let first = |slots: Slots<'_, [f64; 3]>| slots.values.first().copied().unwrap_or_default();
        let limit = self.max_distances.and_then(|limits| limits.values.first());
        rays.resize(
            end - start,
            Ray {
                origin_m: DVec3::from_array(first(self.origins)),
                direction: DVec3::from_array(first(self.directions)),
                min_m: 0.0,
                max_m: limit.copied().unwrap_or(f64::INFINITY),
            },
        );
        match (self.origins.part(start, end), self.directions.part(start, end)) {
            (None, None) => {}
            (None, Some(directions)) => {
                for (ray, direction) in rays.iter_mut().zip(directions) {
                    ray.direction = DVec3::from_array(*direction);
                }
            }
            (Some(origins), None) => {
                for (ray, origin) in rays.iter_mut().zip(origins) {
                    ray.origin_m = DVec3::from_array(*origin);
                }
            }
            (Some(origins), Some(directions)) => {
                for (ray, (origin, direction)) in
                    rays.iter_mut().zip(origins.iter().zip(directions))
                {
                    ray.origin_m = DVec3::from_array(*origin);
                    ray.direction = DVec3::from_array(*direction);
                }
            }
        }
        if let Some(limits) = self.max_distances.and_then(|limits| limits.part(start, end)) {
            for (ray, limit) in rays.iter_mut().zip(limits) {
                ray.max_m = *limit;
            }
        }
    }
}

/// Returns true if a ray without a hit is not finite. Those with a hit are: others hit nothing in the crate.
fn has_unsound(rays: &[Ray], misses: impl Iterator<Item = bool>) -> bool {
    let is_finite = |ray: &Ray| ray.origin_m.is_finite() && ray.direction.is_finite();
    rays.iter().zip(misses).any(|(ray, is_miss)| is_miss && !is_finite(ray))
}

impl<'a, T> Slots<'a, T> {
    /// Values of some rays; none if there is one for all.
    fn part(&self, start: usize, end: usize) -> Option<&'a [T]> {
        (!self.is_one).then(|| &self.values[start..end])
    }
}

/// Array for results: the given one, or a new one without values. A vector of zeros would be written twice.
fn result<'py, T: Element>(
    py: Python<'py>,
    out: Option<Bound<'py, PyAny>>,
    shape: &[usize],
) -> PyResult<PyReadwriteArrayDyn<'py, T>> {
    let array = match out {
        Some(out) => out,
        None => {
            let numpy = py.import(pyo3::intern!(py, "numpy"))?;
            let empty = numpy.getattr(pyo3::intern!(py, "empty"))?;
            empty.call1((PyTuple::new(py, shape)?, T::get_dtype(py)))?
        }
    };
    let wrong = || {
        PyValueError::new_err(format!(
            "`out` must be a contiguous, writable array of {} of the shape {shape:?}",
            T::get_dtype(py)
        ))
    };
    let array = array.cast_into::<PyArrayDyn<T>>().map_err(|_| wrong())?;
    if array.shape() != shape || !array.is_c_contiguous() {
        return Err(wrong());
    }
    array.try_readwrite().map_err(|_| wrong())
}

fn object<'py, T: Element>(array: &PyReadwriteArrayDyn<'py, T>) -> Bound<'py, PyAny> {
    (***array).clone().into_any()
}

/// Writes hits to their arrays.
#[inline(never)]
fn write_hits(
    hits: &[Option<Hit>],
    ids_of_instances: &[i64],
    distances: &mut [f64],
    normals: &mut [[f64; 3]],
    ids: &mut [i64],
    primitives: &mut [i32],
) {
    // One length for all, so that one check of bounds is enough.
    let count = hits.len();
    let (distances, normals) = (&mut distances[..count], &mut normals[..count]);
    let (ids, primitives) = (&mut ids[..count], &mut primitives[..count]);
    for index in 0..count {
        let [x, y, z] = &mut normals[index];
        match &hits[index] {
            Some(hit) => {
                let instance = hit.instance.0 as usize;
                distances[index] = hit.distance_m;
                // One by one: an array would be copied over the stack.
                (*x, *y, *z) = (hit.normal.x, hit.normal.y, hit.normal.z);
                ids[index] = ids_of_instances.get(instance).copied().unwrap_or(-1);
                primitives[index] = hit.primitive.cast_signed();
            }
            None => {
                distances[index] = f64::INFINITY;
                (*x, *y, *z) = (0.0, 0.0, 0.0);
                (ids[index], primitives[index]) = (-1, -1);
            }
        }
    }
}

fn vectors<'py>(
    argument: &Bound<'py, PyAny>,
    name: &str,
) -> PyResult<PyReadonlyArrayDyn<'py, f64>> {
    let array = contiguous::<f64>(argument, name)?;
    if array.shape().last() == Some(&3) {
        return Ok(array);
    }
    Err(PyValueError::new_err(format!(
        "`{name}` must have the shape (..., 3), not {:?}",
        array.shape()
    )))
}

/// Shape to which shapes broadcast.
fn common_shape(shapes: impl Iterator<Item = (&'static str, Vec<usize>)>) -> PyResult<Vec<usize>> {
    let mut common: Vec<usize> = Vec::new();
    for (name, shape) in shapes {
        let axes = common.len().max(shape.len());
        let at = |shape: &[usize], axis: usize| {
            (axis + shape.len()).checked_sub(axes).map_or(1, |axis| shape[axis])
        };
        let mut joined = Vec::with_capacity(axes);
        for axis in 0..axes {
            match (at(&common, axis), at(&shape, axis)) {
                (1, other) | (other, 1) => joined.push(other),
                (a, b) if a == b => joined.push(a),
                _ => {
                    return Err(PyValueError::new_err(format!(
                        "`{name}` of {shape:?} rays does not broadcast to {common:?} rays"
                    )));
                }
            }
        }
        common = joined;
    }
    if common
        .iter()
        .try_fold(1_usize, |count, side| count.checked_mul(*side))
        .is_none_or(|it| it > MAX_RAYS)
    {
        return Err(PyValueError::new_err(format!("{common:?} are more than {MAX_RAYS} rays")));
    }
    Ok(common)
}

/// Largest batch: its results would fill 100 GB.
const MAX_RAYS: usize = 1 << 31;

/// Fits an array to the shape of the batch: as it is, one for all, or copied by numpy.
fn expand<'py>(
    array: PyReadonlyArrayDyn<'py, f64>,
    shape: &[usize],
    count: usize,
    is_vector: bool,
) -> PyResult<Broadcast<'py>> {
    let found = array.shape();
    let lead = if is_vector { &found[..found.len() - 1] } else { found };
    let own: usize = lead.iter().product();
    if own == 1 && count > 0 {
        return Ok(Broadcast { array, is_one: true });
    }
    if own == count {
        return Ok(Broadcast { array, is_one: false });
    }
    let py = array.py();
    let numpy = py.import(pyo3::intern!(py, "numpy"))?;
    let wanted: Vec<usize> = shape.iter().copied().chain(is_vector.then_some(3)).collect();
    let wide =
        numpy.getattr("broadcast_to")?.call1(((*array).clone(), PyTuple::new(py, wanted)?))?;
    Ok(Broadcast { array: contiguous::<f64>(&wide, "the rays")?, is_one: false })
}
