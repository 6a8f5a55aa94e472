//! Shapes of a scene, and the ray-cast world that is built of them.

use std::sync::Arc;

use periplus::geometry::Pose;
use periplus::raycast::{
    Heightfield, InstanceChangeError, InstanceError, InstanceId, RaycastShape, RaycastWorld,
    RaycastWorldBuilder, Tags, TriangleMesh,
};

/// Triangles as they were given.
pub(super) struct FixedMesh {
    pub(super) positions_m: Vec<[f64; 3]>,
    pub(super) triangles: Vec<[u32; 3]>,
}

/// Geometry of a shape.
pub(super) enum Geometry {
    /// Triangles, among those that never move until they do.
    Fixed(Arc<FixedMesh>),
    Shape(RaycastShape),
    Heights(Arc<Heightfield>),
    /// Shape of a file, which is in the world already.
    OfFile {
        name: String,
    },
}

struct Item {
    geometry: Geometry,
    /// None for a shape of a file that has not been moved.
    pose: Option<Pose>,
    instance: Option<InstanceId>,
    /// True if the instance is among the triangles that never move.
    is_fixed: bool,
    is_removed: bool,
}

/// Shapes, and the world of those that are built.
#[derive(Default)]
pub(super) struct SceneState {
    items: Vec<Item>,
    /// Shapes that are not in the world yet.
    pending: Vec<usize>,
    world: Option<Arc<RaycastWorld>>,
    /// Id of the shape of each instance.
    ids: Arc<Vec<i64>>,
    labels: Arc<Vec<i64>>,
}

/// World at one time, which later changes do not touch.
pub(super) struct Snapshot {
    pub(super) world: Arc<RaycastWorld>,
    pub(super) ids: Arc<Vec<i64>>,
    pub(super) labels: Arc<Vec<i64>>,
}

/// Reason for which a shape cannot change.
pub(super) enum ChangeError {
    Unknown(i64),
    Refused(String),
}

impl SceneState {
    /// Scene of a world that was read from a file; `names` of its instances.
    pub(super) fn of_file(world: RaycastWorld, names: Vec<String>) -> Self {
        let ids = (0_i64..).zip(&names).map(|(id, _)| id).collect();
        let labels = vec![0; names.len()];
        let item = |(instance, name)| Item {
            geometry: Geometry::OfFile { name },
            pose: None,
            instance: Some(InstanceId(instance)),
            is_fixed: false,
            is_removed: false,
        };
        Self {
            items: (0..).zip(names).map(item).collect(),
            pending: Vec::new(),
            world: Some(Arc::new(world)),
            ids: Arc::new(ids),
            labels: Arc::new(labels),
        }
    }

    pub(super) fn add(&mut self, geometry: Geometry, pose: Pose, label: i64) -> i64 {
        let index = self.items.len();
        let (pose, instance) = (Some(pose), None);
        self.items.push(Item { geometry, pose, instance, is_fixed: false, is_removed: false });
        self.pending.push(index);
        Arc::make_mut(&mut self.labels).push(label);
        i64::try_from(index).unwrap_or(i64::MAX)
    }

    pub(super) fn len(&self) -> usize {
        self.items.iter().filter(|item| !item.is_removed).count()
    }

    pub(super) fn names(&self) -> Vec<(usize, String)> {
        let present = self.items.iter().enumerate().filter(|(_, item)| !item.is_removed);
        present
            .filter_map(|(id, item)| match &item.geometry {
                Geometry::OfFile { name } => Some((id, name.clone())),
                _ => None,
            })
            .collect()
    }

    pub(super) fn pose(&self, id: i64) -> Result<Option<Pose>, ChangeError> {
        Ok(self.items[self.index(id)?].pose)
    }

    fn index(&self, id: i64) -> Result<usize, ChangeError> {
        let index = usize::try_from(id).ok();
        index
            .filter(|index| self.items.get(*index).is_some_and(|item| !item.is_removed))
            .ok_or(ChangeError::Unknown(id))
    }

    pub(super) fn move_to(&mut self, id: i64, pose: Pose) -> Result<(), ChangeError> {
        let index = self.index(id)?;
        let item = &mut self.items[index];
        if let (Some(instance), Some(world)) = (item.instance, &mut self.world) {
            let world = Arc::make_mut(world);
            if item.is_fixed {
                world.remove(&[instance]).map_err(refused)?;
                item.instance = None;
                item.is_fixed = false;
                self.pending.push(index);
            } else {
                world.move_to(&[(instance, pose)]).map_err(refused)?;
            }
        }
        item.pose = Some(pose);
        Ok(())
    }

    pub(super) fn remove(&mut self, id: i64) -> Result<(), ChangeError> {
        let index = self.index(id)?;
        let item = &mut self.items[index];
        if let (Some(instance), Some(world)) = (item.instance.take(), &mut self.world) {
            Arc::make_mut(world).remove(&[instance]).map_err(refused)?;
        }
        item.is_removed = true;
        if let Geometry::Fixed(mesh) = &mut item.geometry {
            *mesh = Arc::new(FixedMesh { positions_m: Vec::new(), triangles: Vec::new() });
        }
        self.pending.retain(|pending| *pending != index);
        Ok(())
    }

    /// The world, if nothing is left to build.
    pub(super) fn built(&self) -> Option<Snapshot> {
        let world = self.world.as_ref().filter(|_| self.pending.is_empty())?;
        Some(Snapshot {
            world: Arc::clone(world),
            ids: Arc::clone(&self.ids),
            labels: Arc::clone(&self.labels),
        })
    }

    /// Builds what is left to build.
    pub(super) fn build(&mut self, threads: usize) -> Result<Snapshot, InstanceError> {
        if self.built().is_none() {
            let mut builder = RaycastWorld::builder();
            let is_first = self.world.is_none();
            for &index in &self.pending {
                put(&mut builder, &self.items[index], is_first, threads)?;
            }
            let first = match &mut self.world {
                Some(world) => Arc::make_mut(world).insert(builder, threads)?.0,
                None => {
                    self.world = Some(Arc::new(builder.build(threads)?));
                    0
                }
            };
            let ids = Arc::make_mut(&mut self.ids);
            for (instance, index) in (first..).zip(std::mem::take(&mut self.pending)) {
                let item = &mut self.items[index];
                item.instance = Some(InstanceId(instance));
                item.is_fixed = is_first && matches!(item.geometry, Geometry::Fixed(_));
                ids.push(i64::try_from(index).unwrap_or(i64::MAX));
            }
        }
        let missing = InstanceError::Mesh(periplus::raycast::TriangleMeshError::TooMany);
        self.built().ok_or(missing)
    }
}

fn refused(error: InstanceChangeError) -> ChangeError {
    ChangeError::Refused(match error {
        InstanceChangeError::Fixed(_) => {
            "a mesh of a static model of a file cannot move".to_owned()
        }
        other => other.to_string(),
    })
}

fn put(
    builder: &mut RaycastWorldBuilder,
    item: &Item,
    is_first: bool,
    threads: usize,
) -> Result<InstanceId, InstanceError> {
    let pose = item.pose.unwrap_or(Pose::IDENTITY);
    let tags = Tags::default();
    match &item.geometry {
        Geometry::Fixed(mesh) if is_first => {
            builder.add_fixed(&mesh.positions_m, &mesh.triangles, &pose, tags)
        }
        Geometry::Fixed(mesh) => {
            let tree = TriangleMesh::new(&mesh.positions_m, &mesh.triangles, threads)
                .map_err(InstanceError::Mesh)?;
            builder.add_mesh(Arc::new(tree), &pose, tags)
        }
        Geometry::Shape(shape) => builder.add_shape(shape, &pose, tags),
        Geometry::Heights(heights) => builder.add_heightfield(Arc::clone(heights), &pose, tags),
        // It is in the world from the start.
        Geometry::OfFile { .. } => Err(InstanceError::Pose),
    }
}
