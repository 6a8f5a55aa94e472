//! The links of a model and its nested models, in the order of `periplus_physics`.

use periplus_geometry::Pose;
use periplus_scene::{Link, Model, Plugin};

/// A link with its scoped name.
pub(crate) struct ScopedLink<'a> {
    /// `nested::link`.
    pub(crate) name: String,
    pub(crate) link: &'a Link,
    pub(crate) model_from_link: Pose,
    /// Plugins of the enclosing models, from the outermost: they can define the label.
    pub(crate) scopes: Vec<&'a [Plugin]>,
}

pub(crate) fn scoped_links(model: &Model) -> Vec<ScopedLink<'_>> {
    let mut links = Vec::new();
    // Iterative: models can be nested deeper than the call stack allows.
    let mut open = vec![(model, String::new(), Pose::IDENTITY, vec![model.plugins.as_slice()])];
    while let Some((model, scope, outer_from_model, scopes)) = open.pop() {
        for link in &model.links {
            links.push(ScopedLink {
                name: format!("{scope}{}", link.name),
                link,
                model_from_link: outer_from_model * link.model_from_link,
                // Empty lists are dropped, or deep nests of models would need quadratic memory.
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
