//! What rays see, kept where motion has it.

use std::sync::Arc;

use periplus_diagnostics::Diagnostics;
use periplus_geometry::Pose;
use periplus_physics::{LinkId, ModelId, World};
use periplus_rendering::{AssetLoader, PartId, RenderScene, SensedGeometry};
use periplus_scene as scene;

/// The surroundings of sensors, one for what touches and one for what is seen. Each is made when a
/// sensor first looks, and moved when one looks again: a world without cameras has no pictures.
pub struct Views {
    shapes: Arc<dyn AssetLoader + Send + Sync>,
    threads: usize,
    /// Models that are there, in the order of coming.
    models: Vec<(ModelId, Arc<scene::Model>)>,
    /// Lights and colours of the sky.
    sky: scene::World,
    collision: Option<View>,
    visual: Option<View>,
    findings: Diagnostics,
}

/// One of the two.
struct View {
    scene: RenderScene,
    models: Vec<(ModelId, periplus_rendering::RenderModelId)>,
    links: Vec<(LinkId, PartId)>,
    /// When its links were put where they are \[ns\]; none when it is to be done again.
    placed_ns: Option<i64>,
    poses: Vec<(PartId, Pose)>,
}

impl Views {
    /// Of a world without models yet.
    #[must_use]
    pub fn new(shapes: Arc<dyn AssetLoader + Send + Sync>, threads: usize) -> Self {
        Self {
            shapes,
            threads,
            models: Vec::new(),
            sky: scene::World::empty(""),
            collision: None,
            visual: None,
            findings: Diagnostics::new(),
        }
    }

    /// Under the sky and in the light of a world.
    #[must_use]
    pub fn under(self, world: &scene::World) -> Self {
        let sky = scene::World {
            ambient: world.ambient,
            background: world.background,
            shadows: world.shadows,
            lights: world.lights.clone(),
            ..scene::World::empty("")
        };
        Self { sky, ..self }
    }

    /// Adds a light to the world, or puts it in place of the one of its name.
    pub fn set_light(&mut self, light: &scene::Light) {
        self.sky.lights.retain(|known| known.name != light.name);
        self.sky.lights.push(light.clone());
        for view in [&mut self.collision, &mut self.visual].into_iter().flatten() {
            view.scene.set_light(light);
        }
    }

    /// Takes a light of the world away.
    pub fn remove_light(&mut self, name: &str) {
        self.sky.lights.retain(|known| known.name != name);
        for view in [&mut self.collision, &mut self.visual].into_iter().flatten() {
            view.scene.remove_light(name);
        }
    }

    /// Puts a light in place of the one of its name on a link of an outermost model.
    pub fn set_light_on(&mut self, link: LinkId, light: &scene::Light, world: &World) {
        let (Some(id), Some(name)) = (world.model_of(link), world.link_name(link)) else { return };
        // Views that are made later read the model.
        let model = self.models.iter_mut().find(|(model, _)| *model == id);
        let model = model.map(|(_, model)| Arc::make_mut(model));
        let links = model.into_iter().flat_map(|model| &mut model.links);
        let lights = links.filter(|link| link.name == name).flat_map(|link| &mut link.lights);
        for known in lights.filter(|known| known.name == light.name) {
            known.clone_from(light);
        }
        for view in [&mut self.collision, &mut self.visual].into_iter().flatten() {
            if let Some((_, part)) = view.links.iter().find(|(known, _)| *known == link) {
                view.scene.set_light_on(*part, light);
            }
        }
    }

    /// A model has come.
    pub fn add(&mut self, model: Arc<scene::Model>, id: ModelId, world: &World) {
        for view in [&mut self.collision, &mut self.visual].into_iter().flatten() {
            let pose = world.model_pose(id).unwrap_or_default();
            let parts = view.scene.add(&model, pose, &*self.shapes);
            self.findings.append(parts.diagnostics);
            view.models.push((id, parts.model));
            view.links.extend(world.links(id).zip(parts.parts));
            view.placed_ns = None;
        }
        self.models.push((id, model));
    }

    /// A model has gone.
    pub fn remove(&mut self, id: ModelId, world: &World) {
        self.models.retain(|(model, _)| *model != id);
        for view in [&mut self.collision, &mut self.visual].into_iter().flatten() {
            if let Some(place) = view.models.iter().position(|(model, _)| *model == id) {
                view.scene.remove(view.models.remove(place).1);
            }
            view.links.retain(|(link, _)| world.model_of(*link) != Some(id));
        }
    }

    /// Something moved otherwise than by a step.
    pub fn moved(&mut self) {
        for view in [&mut self.collision, &mut self.visual].into_iter().flatten() {
            view.placed_ns = None;
        }
    }

    /// The surroundings at a time \[ns\], where `world` has everything now.
    pub fn at(
        &mut self,
        geometry: SensedGeometry,
        time_ns: i64,
        world: &World,
    ) -> &mut RenderScene {
        let slot = match geometry {
            SensedGeometry::Collision => &mut self.collision,
            SensedGeometry::Visual => &mut self.visual,
        };
        let view = slot.get_or_insert_with(|| {
            View::new(
                geometry,
                &self.sky,
                &self.models,
                world,
                &*self.shapes,
                self.threads,
                &mut self.findings,
            )
        });
        view.place(time_ns, world);
        &mut view.scene
    }

    /// The part of a link in one of the surroundings, which is made if it was not there.
    pub fn part(
        &mut self,
        geometry: SensedGeometry,
        link: LinkId,
        world: &World,
    ) -> Option<PartId> {
        self.at(geometry, i64::MIN, world);
        let view = match geometry {
            SensedGeometry::Collision => &self.collision,
            SensedGeometry::Visual => &self.visual,
        };
        let links = &view.as_ref()?.links;
        links.iter().find(|(known, _)| *known == link).map(|(_, part)| *part)
    }

    /// What was found wrong with shapes since this was last asked.
    pub fn take_findings(&mut self) -> Diagnostics {
        std::mem::take(&mut self.findings)
    }
}

impl View {
    fn new(
        geometry: SensedGeometry,
        sky: &scene::World,
        models: &[(ModelId, Arc<scene::Model>)],
        world: &World,
        shapes: &dyn AssetLoader,
        threads: usize,
        findings: &mut Diagnostics,
    ) -> Self {
        let placed = models.iter().map(|(id, model)| {
            let parent_from_model = world.model_pose(*id).unwrap_or(model.parent_from_model);
            scene::Model { parent_from_model, ..(**model).clone() }
        });
        // All at once: the trees of fixed shapes are then built only once.
        let together = scene::World { models: placed.collect(), ..sky.clone() };
        let (scene, wrong) = RenderScene::new(&together, geometry, shapes, threads);
        findings.append(wrong);
        let seen: Vec<_> = scene.models().collect();
        let models: Vec<_> = models.iter().map(|(id, _)| *id).zip(seen).collect();
        let links = models.iter().flat_map(|(id, seen)| world.links(*id).zip(scene.parts(*seen)));
        let links = links.collect();
        Self { scene, models, links, placed_ns: None, poses: Vec::new() }
    }

    fn place(&mut self, time_ns: i64, world: &World) {
        if self.placed_ns == Some(time_ns) {
            return;
        }
        self.placed_ns = Some(time_ns);
        self.poses.clear();
        self.poses.extend(
            self.links
                .iter()
                .filter_map(|(link, part)| Some((*part, world.link_state(*link)?.world_from_link))),
        );
        self.scene.set_link_poses(&self.poses);
    }
}
