//! Iteration over the shapes of a scene.

use periplus_diagnostics::Origin;
use periplus_scene::{Link, Model, Scene, Shape};

/// Visits the shapes of all models, then of all actors, each with the origin of its collision or visual.
pub(crate) fn for_each_shape(scene: &mut Scene, visit: &mut dyn FnMut(&mut Shape, Origin)) {
    let models = scene.worlds.iter_mut().flat_map(|world| &mut world.models);
    models.chain(&mut scene.models).for_each(|model| in_model(model, visit));
    let actors = scene.worlds.iter_mut().flat_map(|world| &mut world.actors);
    let links = actors.chain(&mut scene.actors).flat_map(|actor| &mut actor.links);
    links.for_each(|link| in_link(link, visit));
}

fn in_model(model: &mut Model, visit: &mut dyn FnMut(&mut Shape, Origin)) {
    model.links.iter_mut().for_each(|link| in_link(link, visit));
    model.models.iter_mut().for_each(|inner| in_model(inner, visit));
}

fn in_link(link: &mut Link, visit: &mut dyn FnMut(&mut Shape, Origin)) {
    for collision in &mut link.collisions {
        visit(&mut collision.shape, collision.origin);
    }
    for visual in &mut link.visuals {
        visit(&mut visual.shape, visual.origin);
    }
}
