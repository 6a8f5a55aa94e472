//! The links of a model and of the models in it, in the order that `periplus_physics` gives them.

use periplus_geometry::Pose;
use periplus_scene::{Link, Model, Plugin};

/// A link with its scoped name.
pub(crate) struct Walked<'a> {
    /// `nested::link`.
    pub(crate) name: String,
    pub(crate) link: &'a Link,
    pub(crate) model_from_link: Pose,
    /// The models that it is in, from the outermost on: their plugins label it.
    pub(crate) scopes: Vec<&'a [Plugin]>,
}

pub(crate) fn walk(model: &Model) -> Vec<Walked<'_>> {
    let mut links = Vec::new();
    // A list instead of recursion: models may be nested deeper than the stack.
    let mut open = vec![(model, String::new(), Pose::IDENTITY, vec![model.plugins.as_slice()])];
    while let Some((model, scope, outer_from_model, scopes)) = open.pop() {
        for link in &model.links {
            links.push(Walked {
                name: format!("{scope}{}", link.name),
                link,
                model_from_link: outer_from_model * link.model_from_link,
                // Deep nests of many models would else hold lists of the square of their number.
                scopes: scopes.iter().copied().filter(|plugins| !plugins.is_empty()).collect(),
            });
        }
        for nested in model.models.iter().rev() {
            let mut inner = scopes.clone();
            if !nested.plugins.is_empty() {
                inner.push(nested.plugins.as_slice());
            }
            let pose = outer_from_model * nested.parent_from_model;
            open.push((nested, format!("{scope}{}::", nested.name), pose, inner));
        }
    }
    links
}
