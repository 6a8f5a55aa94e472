//! Ray-cast scenes that follow the motion of links.

use std::collections::BTreeMap;
use std::ops::Deref;
use std::sync::{Arc, Mutex, PoisonError, RwLock, RwLockReadGuard};

use periplus_diagnostics::Diagnostics;
use periplus_geometry::{DVec3, Pose};
use periplus_physics::{LinkId, LinkState, ModelId, PhysicsWorld};
use periplus_rendering::{AssetLoader, PartId, RenderScene, SensedGeometry};
use periplus_scene as scene;

/// Ray-cast scenes of the sensors, one of collisions and one of visuals. Each is built when a sensor
/// first uses it, and updated on use: a world without cameras has no visual scene. Sensors on several threads can use
/// them at once.
pub struct Views {
    shapes: Arc<dyn AssetLoader + Send + Sync>,
    threads: usize,
    /// Models in the order of insertion.
    models: Vec<(ModelId, Arc<scene::Model>)>,
    /// Models that only sensors know, such as people.
    figures: Vec<Figure>,
    /// Lights and background colours.
    sky: Arc<scene::World>,
    collision: Slot,
    visual: Slot,
    findings: Mutex<Diagnostics>,
}

/// A scene, once it is used.
type Slot = RwLock<Option<SceneView>>;

/// A scene at a time. Others can read it, too.
pub struct SceneRef<'a>(RwLockReadGuard<'a, Option<SceneView>>);

impl Deref for SceneRef<'_> {
    type Target = RenderScene;

    fn deref(&self) -> &RenderScene {
        &self.0.as_ref().expect("scenes are only handed out once built").scene
    }
}

/// Model that sensors see and physics does not know, in the order of adding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FigureId(usize);

struct Figure {
    model: Arc<scene::Model>,
    /// Pose of each link.
    world_from_links: Vec<Pose>,
    /// Poses before the last change.
    world_from_links_before: Vec<Pose>,
    /// Times of the poses, and of those before the last change \[ns\].
    times_ns: [i64; 2],
}

/// Saved models and lights of [`Views`]; they are shared, not copied.
#[derive(Clone)]
pub struct ViewsState {
    models: Vec<(ModelId, Arc<scene::Model>)>,
    sky: Arc<scene::World>,
}

/// A scene with its links.
struct SceneView {
    scene: RenderScene,
    models: Vec<(ModelId, periplus_rendering::RenderModelId)>,
    links: Vec<(LinkId, PartId)>,
    /// The same by link.
    part_of_link: BTreeMap<LinkId, PartId>,
    /// Links of each figure.
    figures: Vec<Vec<PartId>>,
    /// Time of the last update of its links \[ns\]; `None` requires an update.
    updated_ns: Option<i64>,
    poses: Vec<(PartId, Pose)>,
}

impl Views {
    /// Creates the scenes of a world without models.
    #[must_use]
    pub fn new(shapes: Arc<dyn AssetLoader + Send + Sync>, threads: usize) -> Self {
        Self {
            shapes,
            threads,
            models: Vec::new(),
            figures: Vec::new(),
            sky: Arc::new(scene::World::empty("")),
            collision: Slot::default(),
            visual: Slot::default(),
            findings: Mutex::default(),
        }
    }

    /// Sets the lights and background of a world.
    #[must_use]
    pub fn with_lights_of(self, world: &scene::World) -> Self {
        let sky = scene::World {
            ambient: world.ambient,
            background: world.background,
            shadows: world.shadows,
            lights: world.lights.clone(),
            ..scene::World::empty("")
        };
        Self { sky: Arc::new(sky), ..self }
    }

    /// Adds a light to the world or replaces the light of the same name.
    pub fn set_light(&mut self, light: &scene::Light) {
        let lights = &mut Arc::make_mut(&mut self.sky).lights;
        lights.retain(|known| known.name != light.name);
        lights.push(light.clone());
        for view in built([&mut self.collision, &mut self.visual]) {
            view.scene.set_light(light);
        }
    }

    /// Removes a light of the world.
    pub fn remove_light(&mut self, name: &str) {
        Arc::make_mut(&mut self.sky).lights.retain(|known| known.name != name);
        for view in built([&mut self.collision, &mut self.visual]) {
            view.scene.remove_light(name);
        }
    }

    /// Replaces the light of the same name on a link of an outermost model.
    pub fn set_light_on(&mut self, link: LinkId, light: &scene::Light, world: &PhysicsWorld) {
        let (Some(id), Some(name)) = (world.model_of(link), world.link_name(link)) else { return };
        // Scenes that are built later read the model.
        let model = self.models.iter_mut().find(|(model, _)| *model == id);
        let model = model.map(|(_, model)| Arc::make_mut(model));
        let links = model.into_iter().flat_map(|model| &mut model.links);
        let lights = links.filter(|link| link.name == name).flat_map(|link| &mut link.lights);
        for known in lights.filter(|known| known.name == light.name) {
            known.clone_from(light);
        }
        for view in built([&mut self.collision, &mut self.visual]) {
            if let Some(part) = view.part_of_link.get(&link) {
                view.scene.set_light_on(*part, light);
            }
        }
    }

    /// Adds a model.
    pub fn add(&mut self, model: Arc<scene::Model>, id: ModelId, world: &PhysicsWorld) {
        for view in built([&mut self.collision, &mut self.visual]) {
            let pose = world.model_pose(id).unwrap_or_default();
            let parts = view.scene.add(&model, pose, &*self.shapes);
            exclusive(&mut self.findings).append(parts.diagnostics);
            view.models.push((id, parts.model));
            for (link, part) in world.links(id).zip(parts.parts) {
                view.links.push((link, part));
                view.part_of_link.insert(link, part);
            }
            view.updated_ns = None;
        }
        self.models.push((id, model));
    }

    /// Adds a model that sensors see and physics does not know, with its links where the model has them.
    pub fn add_figure(&mut self, model: Arc<scene::Model>) -> FigureId {
        for view in built([&mut self.collision, &mut self.visual]) {
            view.add_figure(&model, &*self.shapes, exclusive(&mut self.findings));
        }
        let links = model.links.iter().map(|link| model.parent_from_model * link.model_from_link);
        let world_from_links: Vec<Pose> = links.collect();
        let world_from_links_before = world_from_links.clone();
        self.figures.push(Figure {
            model,
            world_from_links,
            world_from_links_before,
            times_ns: [0, 0],
        });
        FigureId(self.figures.len() - 1)
    }

    /// Sets the poses of the links of a figure at a time \[ns\], in their order in the model.
    pub fn set_figure(&mut self, figure: FigureId, time_ns: i64, world_from_links: &[Pose]) {
        let figure = &mut self.figures[figure.0];
        let [last_ns, _] = figure.times_ns;
        if time_ns > last_ns {
            figure.world_from_links_before.copy_from_slice(&figure.world_from_links);
            figure.times_ns = [time_ns, last_ns];
        } else {
            // The start, or a jump back: there is no motion before it.
            figure.world_from_links_before.copy_from_slice(world_from_links);
            figure.times_ns = [time_ns, time_ns];
        }
        figure.world_from_links.copy_from_slice(world_from_links);
        self.invalidate();
    }

    /// Removes a model.
    pub fn remove(&mut self, id: ModelId, world: &PhysicsWorld) {
        self.models.retain(|(model, _)| *model != id);
        for view in built([&mut self.collision, &mut self.visual]) {
            if let Some(update) = view.models.iter().position(|(model, _)| *model == id) {
                view.scene.remove(view.models.remove(update).1);
            }
            view.links.retain(|(link, _)| world.model_of(*link) != Some(id));
            view.part_of_link.retain(|link, _| world.model_of(*link) != Some(id));
        }
    }

    /// Marks the links as moved by something other than a step, such as a teleport.
    pub fn invalidate(&mut self) {
        for view in built([&mut self.collision, &mut self.visual]) {
            view.updated_ns = None;
        }
    }

    /// Saves models and lights. Poses are those of the physics world.
    #[must_use]
    pub fn save(&self) -> ViewsState {
        ViewsState { models: self.models.clone(), sky: Arc::clone(&self.sky) }
    }

    /// Restores models and lights. Scenes are built again on the next use if they differ, and
    /// otherwise updated.
    pub fn restore(&mut self, saved: &ViewsState) {
        let is_same = |((id, model), (saved_id, saved)): (&(_, Arc<_>), &(_, Arc<_>))| {
            id == saved_id && Arc::ptr_eq(model, saved)
        };
        let has_same_models = self.models.len() == saved.models.len()
            && self.models.iter().zip(&saved.models).all(is_same);
        if has_same_models && Arc::ptr_eq(&self.sky, &saved.sky) {
            return self.invalidate();
        }
        (self.collision, self.visual) = (Slot::default(), Slot::default());
        self.models.clone_from(&saved.models);
        self.sky = Arc::clone(&saved.sky);
    }

    /// Returns a scene at a time \[ns\] with the current poses of `world`.
    pub fn at(
        &mut self,
        geometry: SensedGeometry,
        time_ns: i64,
        world: &PhysicsWorld,
    ) -> &mut RenderScene {
        drop(self.seen(geometry, time_ns, world));
        let slot = match geometry {
            SensedGeometry::Collision => &mut self.collision,
            SensedGeometry::Visual => &mut self.visual,
        };
        let view = slot.get_mut().unwrap_or_else(PoisonError::into_inner);
        &mut view.as_mut().expect("built above").scene
    }

    /// Returns a scene at a time \[ns\] with the current poses of `world`, for one of several sensors that measure at
    /// the same time. The first one updates it.
    pub fn seen(
        &self,
        geometry: SensedGeometry,
        time_ns: i64,
        world: &PhysicsWorld,
    ) -> SceneRef<'_> {
        let slot = self.slot(geometry);
        let guard = slot.read().unwrap_or_else(PoisonError::into_inner);
        if guard.as_ref().is_some_and(|view| view.updated_ns == Some(time_ns)) {
            return SceneRef(guard);
        }
        drop(guard);
        let mut guard = slot.write().unwrap_or_else(PoisonError::into_inner);
        let view = guard.get_or_insert_with(|| self.build(geometry, world));
        view.update(time_ns, world, &self.figures);
        drop(guard);
        SceneRef(slot.read().unwrap_or_else(PoisonError::into_inner))
    }

    fn slot(&self, geometry: SensedGeometry) -> &Slot {
        match geometry {
            SensedGeometry::Collision => &self.collision,
            SensedGeometry::Visual => &self.visual,
        }
    }

    /// Builds a scene.
    fn build(&self, geometry: SensedGeometry, world: &PhysicsWorld) -> SceneView {
        let mut findings = Diagnostics::new();
        let mut view = SceneView::new(
            geometry,
            &self.sky,
            &self.models,
            world,
            &*self.shapes,
            self.threads,
            &mut findings,
        );
        for figure in &self.figures {
            view.add_figure(&figure.model, &*self.shapes, &mut findings);
        }
        self.findings.lock().unwrap_or_else(PoisonError::into_inner).append(findings);
        view
    }

    /// Returns the id of a link in a scene, which is built on first use and not updated.
    pub fn part(
        &self,
        geometry: SensedGeometry,
        link: LinkId,
        world: &PhysicsWorld,
    ) -> Option<PartId> {
        let slot = self.slot(geometry);
        let guard = slot.read().unwrap_or_else(PoisonError::into_inner);
        if let Some(view) = &*guard {
            return view.part_of_link.get(&link).copied();
        }
        drop(guard);
        let mut guard = slot.write().unwrap_or_else(PoisonError::into_inner);
        let view = guard.get_or_insert_with(|| self.build(geometry, world));
        view.part_of_link.get(&link).copied()
    }

    /// Returns the motions of the parts of a scene in use: those of links, and for figures the mean velocities since the
    /// last step.
    pub fn part_motions(
        &self,
        geometry: SensedGeometry,
        world: &PhysicsWorld,
    ) -> impl Iterator<Item = (PartId, LinkState)> {
        let view = self.slot(geometry).read().unwrap_or_else(PoisonError::into_inner);
        let of_links = |view: &SceneView| {
            let links = view.links.iter();
            links.filter_map(|(link, part)| Some((*part, world.link_state(*link)?))).collect()
        };
        let of_figures = |view: &SceneView| {
            let motions = |(parts, figure): (&Vec<PartId>, &Figure)| {
                let links = parts.iter().enumerate();
                links.map(|(link, part)| (*part, figure.motion(link))).collect::<Vec<_>>()
            };
            view.figures.iter().zip(&self.figures).flat_map(motions).collect()
        };
        let links: Vec<_> = view.as_ref().map(of_links).unwrap_or_default();
        let figures: Vec<_> = view.as_ref().map(of_figures).unwrap_or_default();
        links.into_iter().chain(figures)
    }

    /// Returns and clears the problems of shapes found since the last call.
    pub fn take_findings(&mut self) -> Diagnostics {
        std::mem::take(exclusive(&mut self.findings))
    }
}

/// Content of a mutex that no one else can lock.
fn exclusive<T>(mutex: &mut Mutex<T>) -> &mut T {
    mutex.get_mut().unwrap_or_else(PoisonError::into_inner)
}

/// The scenes that are in use.
fn built(slots: [&mut Slot; 2]) -> impl Iterator<Item = &mut SceneView> {
    slots
        .into_iter()
        .filter_map(|slot| slot.get_mut().unwrap_or_else(PoisonError::into_inner).as_mut())
}

impl Figure {
    /// Returns the pose of a link, and its mean velocity since the last step.
    fn motion(&self, link: usize) -> LinkState {
        let (now, before) = (self.world_from_links[link], self.world_from_links_before[link]);
        let [time_ns, before_ns] = self.times_ns;
        if time_ns <= before_ns {
            let (linear_m_s, angular_rad_s) = (DVec3::ZERO, DVec3::ZERO);
            return LinkState { world_from_link: now, linear_m_s, angular_rad_s };
        }
        #[expect(clippy::cast_precision_loss, reason = "a step is far below 2^53 ns")]
        let dt_s = (time_ns - before_ns) as f64 * 1e-9;
        let turn = now.rotation * before.rotation.conjugate();
        let turn = if turn.w < 0.0 { -turn } else { turn };
        let axis = DVec3::new(turn.x, turn.y, turn.z);
        let angle_rad = 2.0 * libm::atan2(axis.length(), turn.w);
        LinkState {
            world_from_link: now,
            linear_m_s: (now.translation - before.translation) / dt_s,
            angular_rad_s: axis.normalize_or_zero() * (angle_rad / dt_s),
        }
    }
}

impl SceneView {
    fn new(
        geometry: SensedGeometry,
        sky: &scene::World,
        models: &[(ModelId, Arc<scene::Model>)],
        world: &PhysicsWorld,
        shapes: &dyn AssetLoader,
        threads: usize,
        findings: &mut Diagnostics,
    ) -> Self {
        let placed = models.iter().map(|(id, model)| {
            let parent_from_model = world.model_pose(*id).unwrap_or(model.parent_from_model);
            scene::Model { parent_from_model, ..(**model).clone() }
        });
        // All at once: the trees of fixed shapes are built only once.
        let together = scene::World { models: placed.collect(), ..sky.clone() };
        let (scene, wrong) = RenderScene::new(&together, geometry, shapes, threads);
        findings.append(wrong);
        let seen: Vec<_> = scene.models().collect();
        let models: Vec<_> = models.iter().map(|(id, _)| *id).zip(seen).collect();
        let links = models.iter().flat_map(|(id, seen)| world.links(*id).zip(scene.parts(*seen)));
        let links: Vec<(LinkId, PartId)> = links.collect();
        let part_of_link = links.iter().copied().collect();
        Self {
            scene,
            models,
            links,
            part_of_link,
            figures: Vec::new(),
            updated_ns: None,
            poses: Vec::new(),
        }
    }

    fn add_figure(
        &mut self,
        model: &scene::Model,
        shapes: &dyn AssetLoader,
        findings: &mut Diagnostics,
    ) {
        let added = self.scene.add(model, model.parent_from_model, shapes);
        findings.append(added.diagnostics);
        self.figures.push(added.parts);
        self.updated_ns = None;
    }

    fn update(&mut self, time_ns: i64, world: &PhysicsWorld, figures: &[Figure]) {
        if self.updated_ns == Some(time_ns) {
            return;
        }
        self.updated_ns = Some(time_ns);
        self.poses.clear();
        self.poses.extend(
            self.links
                .iter()
                .filter_map(|(link, part)| Some((*part, world.link_state(*link)?.world_from_link))),
        );
        for (parts, figure) in self.figures.iter().zip(figures) {
            self.poses.extend(parts.iter().copied().zip(figure.world_from_links.iter().copied()));
        }
        self.scene.set_link_poses(&self.poses);
    }
}

#[cfg(test)]
mod tests {
    use periplus_diagnostics::SourceMap;
    use periplus_physics::{NoMeshes, PhysicsMode};
    use periplus_rendering::NoAssets;
    use periplus_sdf::{NoIncludes, SdfContext, read_document};

    use super::*;

    /// Regression test: to find the part of a sensor moved all links of the world, twice for each scan, so that a hundred
    /// robots took half of their time for it.
    #[test]
    fn a_part_is_found_without_moving_the_scene() {
        let text = "<sdf version='1.9'><world name='w'><model name='m'><link name='l'><collision name='c'><geometry><box>\
                    <size>1 1 1</size></box></geometry></collision></link></model></world></sdf>";
        let (mut sources, mut findings) = (SourceMap::new(), Diagnostics::new());
        let file = sources.add("w.sdf", text);
        let document = periplus_xml::parse(file, &sources, &mut findings).unwrap();
        let (includes, diagnostics) = (&mut NoIncludes, &mut findings);
        let mut context = SdfContext { sources: &mut sources, diagnostics, includes };
        let scene = read_document(&document, &mut context).worlds.remove(0);
        let (world, _) = PhysicsWorld::new(&scene, PhysicsMode::Kinematic, &NoMeshes);
        let mut views = Views::new(Arc::new(NoAssets), 1);
        let (model, _) = world.models().next().unwrap();
        views.add(Arc::new(scene.models[0].clone()), model, &world);
        let link = world.links(model).next().unwrap();
        drop(views.seen(SensedGeometry::Collision, 5, &world));
        assert!(views.part(SensedGeometry::Collision, link, &world).is_some());
        let view = views.collision.get_mut().unwrap().as_ref().unwrap();
        assert_eq!(view.updated_ns, Some(5));
    }
}
